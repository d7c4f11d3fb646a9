"""Lemmas on a function with a bound on its rate: comparison, ultimate bound, finite time, input-to-state stability."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.proof.claim import D, Relation, at_least, at_most, greater, less
from workbench.proof.latex.write import latex
from workbench.proof.lemmas.lemma import EXIST, Hypothesis, Lemma, exact, goal_of, square_norm, taken
from workbench.proof.lemmas.requirements import (
    Flow,
    Inputs,
    require_constant,
    require_continuous_rates,
    require_moving,
    require_system,
)


def comparison(v: sp.Expr, rate: sp.Expr, offset: sp.Expr, flow: Flow, assume: Sequence[Relation] = (),
               inputs: Inputs = ()) -> Lemma:
    """v' <= -rate v + offset with constants gives v(t) <= (v(0) - offset/rate) e^(-rate t) + offset/rate.

    Khalil, Nonlinear Systems, lemma 3.4. rate, offset: constant; assume: what holds at all times. Raises ClaimError
    where v does not move, or a state is declared positive.
    """
    v, rate, offset = exact(v, rate, offset)
    require_system("comparison", flow, assume, inputs)
    require_moving("comparison", flow, v)
    require_constant("comparison", flow, inputs, rate, offset)
    a, b = latex(rate), latex(offset)
    return Lemma("the comparison lemma", (
        Hypothesis("rate", "The bound on the rate", goal_of(at_most(D(v), -rate * v + offset), flow, assume, inputs)),
        Hypothesis("decay", "The rate of decay is positive", goal_of(greater(rate, 0), {})),
    ), rf"v(t) \le \left(v(0) - \frac{{{b}}}{{{a}}}\right) e^{{-{a} t}} + \frac{{{b}}}{{{a}}}",
        taken("It holds for as long as the solution exists.", assume))


def ultimate_bound(V: sp.Expr, rate: sp.Expr, offset: sp.Expr, flow: Flow, assume: Sequence[Relation] = (),
                   inputs: Inputs = ()) -> Lemma:
    """V >= 0 and V' <= -rate V + offset give a V that ends up no larger than offset/rate, at each margin.

    Khalil, section 4.8. Raises ClaimError where V does not move, or a state is declared positive.
    """
    V, rate, offset = exact(V, rate, offset)
    found = comparison(V, rate, offset, flow, assume, inputs)
    lower = Hypothesis("lower", "V is not negative", goal_of(at_least(V, 0), flow, assume, inputs))
    return Lemma("the ultimate bound by comparison", (lower, *found.hypotheses),
                 rf"\limsup_{{t \to \infty}} V(t) \le \frac{{{latex(offset)}}}{{{latex(rate)}}}",
                 taken(EXIST, assume))


def finite_time(V: sp.Expr, rate: sp.Expr, power: sp.Expr, flow: Flow, assume: Sequence[Relation] = (),
                inputs: Inputs = ()) -> Lemma:
    """V >= 0 and V' <= -rate V^power, 0 < power < 1, reach V = 0 by V(0)^(1 - power)/(rate (1 - power)).

    Bhat and Bernstein, SIAM Journal on Control and Optimization 38 (2000), theorem 4.2. Raises ClaimError where V does
    not move, or a state is declared positive.
    """
    V, rate, power = exact(V, rate, power)
    require_system("finite_time", flow, assume, inputs)
    require_moving("finite_time", flow, V)
    require_constant("finite_time", flow, inputs, rate, power)
    q, c = latex(1 - power), latex(rate)
    return Lemma("the finite-time theorem of Bhat and Bernstein", (
        Hypothesis("lower", "V is not negative", goal_of(at_least(V, 0), flow, assume, inputs)),
        Hypothesis("rate", "The bound on the rate where V is positive",
                   goal_of(at_most(D(V), -rate * V**power), flow, (*assume, greater(V, 0)), inputs)),
        Hypothesis("factor", "The factor is positive", goal_of(greater(rate, 0), {})),
        Hypothesis("power.above", "The power is above zero", goal_of(greater(power, 0), {})),
        Hypothesis("power.below", "The power is below one", goal_of(less(power, 1), {})),
    ), rf"V(t) = 0 \text{{ for }} t \ge \frac{{V(0)^{{{q}}}}}{{{c} ({q})}}", taken(EXIST, assume))


def input_to_state(V: sp.Expr, state: Sequence[sp.Expr], lower: sp.Expr, upper: sp.Expr, rate: sp.Expr, gain: sp.Expr,
                   disturbance: Sequence[sp.Symbol | sp.Indexed], flow: Flow, assume: Sequence[Relation] = ()) -> Lemma:
    """lower x'x <= V <= upper x'x and V' <= -rate V + gain d'd make the state stable from the disturbance d.

    Sontag and Wang, Systems & Control Letters 24 (1995), theorem 1, with quadratic bounds. Raises ClaimError where V
    does not move, a state is declared positive, or a rate jumps.
    """
    V, lower, upper, rate, gain = exact(V, lower, upper, rate, gain)
    require_system("input_to_state", flow, assume, disturbance)
    require_continuous_rates("input_to_state", flow, disturbance)
    require_moving("input_to_state", flow, V)
    require_constant("input_to_state", flow, disturbance, lower, upper, rate, gain)
    x, d = square_norm(state), square_norm(disturbance)
    k = latex(lower)
    return Lemma("input-to-state stability by a Lyapunov function", (
        *quadratic_bounds(V, state, lower, upper, flow, assume, disturbance),
        Hypothesis("rate", "The bound on the rate",
                   goal_of(at_most(D(V), -rate * V + gain * d), flow, assume, disturbance)),
        Hypothesis("decay", "The rate of decay is positive", goal_of(greater(rate, 0), {})),
        Hypothesis("gain", "The gain is not negative", goal_of(at_least(gain, 0), {})),
    ), rf"{latex(x)} \le \frac{{{latex(upper)}}}{{{k}}} e^{{-{latex(rate)} t}} \|x(0)\|^2 + "
       rf"\frac{{{latex(gain)}}}{{{k} \cdot {latex(rate)}}} \sup_{{\tau \le t}} \|d(\tau)\|^2",
        taken("It holds for as long as the solution exists.", assume))


def quadratic_bounds(V: sp.Expr, state: Sequence[sp.Expr], lower: sp.Expr, upper: sp.Expr, flow: Flow,
                     assume: Sequence[Relation] = (), inputs: Inputs = ()) -> tuple[Hypothesis, ...]:
    """V between two positive multiples of x'x, so that it is positive definite, decrescent and radially unbounded."""
    x = square_norm(state)
    asked = [("lower", "V from below", at_least(V, lower * x)), ("upper", "V from above", at_most(V, upper * x))]
    told = [Hypothesis(name, title, goal_of(relation, flow, assume, inputs)) for name, title, relation in asked
            if relation.margin != 0]  # a bound that is V itself states nothing
    return (*told, Hypothesis("bounds", "The lower multiple is positive", goal_of(greater(lower, 0), {})))
