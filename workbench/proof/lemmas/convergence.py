"""Lemmas by which errors vanish: Barbalat, LaSalle-Yoshizawa, Razumikhin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from workbench.proof.claim import D, Relation, at_least, at_most, greater
from workbench.proof.latex.write import latex
from workbench.proof.lemmas.bounds import quadratic_bounds
from workbench.proof.lemmas.lemma import EXIST, Hypothesis, Lemma, exact, goal_of, square_norm, taken
from workbench.proof.lemmas.regular import regular
from workbench.proof.lemmas.requirements import (
    Flow,
    Inputs,
    rates_of,
    require_bounded_in_time,
    require_bounded_inputs,
    require_closed,
    require_constant,
    require_continuous_rates,
    require_delayed,
    require_moving,
    require_of_no_state,
    require_own_symbol,
    require_system,
    require_whole_state,
)


def barbalat(V: sp.Expr, W: sp.Expr, level: sp.Symbol, steepest: sp.Expr, flow: Flow, assume: Sequence[Relation] = (),
             inputs: Inputs = ()) -> Lemma:
    """V >= 0, V' <= -W <= 0, and a W that changes no faster than `steepest` while V <= level: W vanishes.

    Barbalat's lemma as Slotine and Li, Applied Nonlinear Control, lemma 4.3, use it. level: stands for V(0), so a
    symbol of its own; steepest: constant, may have the level in it. assume: what holds at all times. Raises ClaimError
    where V or W does not move, a state is declared positive, or the level stands elsewhere.
    """
    V, W, steepest = exact(V, W, steepest)
    require_system("barbalat", flow, assume, inputs)
    require_own_symbol("barbalat", level, (V, W, *flow, *rates_of(flow), *inputs), assume)
    require_moving("barbalat", flow, V, W)
    require_constant("barbalat", flow, inputs, level, steepest)
    below = (*assume, at_most(V, level))
    return Lemma("Barbalat's lemma", (
        Hypothesis("lower", "V is not negative", goal_of(at_least(V, 0), flow, assume, inputs)),
        Hypothesis("decrease", "V falls by W", goal_of(at_most(D(V), -W), flow, assume, inputs)),
        Hypothesis("sign", "W is not negative", goal_of(at_least(W, 0), flow, assume, inputs)),
        Hypothesis("steepest.above", "W rises no faster than a bound", goal_of(at_most(D(W), steepest), flow, below,
                                                                              inputs)),
        Hypothesis("steepest.below", "W falls no faster than a bound", goal_of(at_least(D(W), -steepest), flow, below,
                                                                              inputs)),
    ), rf"\lim_{{t \to \infty}} {latex(W)} = 0", taken(EXIST, assume))


def lasalle_yoshizawa(V: sp.Expr, state: Sequence[sp.Expr], lower: sp.Expr, upper: sp.Expr, W: sp.Expr, flow: Flow,
                      assume: Sequence[Relation] = (), inputs: Inputs = ()) -> Lemma:
    """lower x'x <= V <= upper x'x and V' <= -W(x) <= 0: all states stay bounded, and W vanishes.

    Krstic, Kanellakopoulos and Kokotovic, theorem A.8, with quadratic bounds. state: all that the flow moves, time
    apart; W: of the state alone. That W is continuous and rates are Lipschitz wherever the state is is one more
    hypothesis where they have quotients, roots or logarithms. assume: what holds at all times, with a bound of each
    input. Raises ClaimError where V does not move, W is of more than the state, a state is declared positive, a rate
    jumps, or no bound of it is seen at all times alike.
    """
    V, lower, upper, W = exact(V, lower, upper, W)
    require_system("lasalle_yoshizawa", flow, assume, inputs)
    require_whole_state("lasalle_yoshizawa", flow, state)
    require_closed("lasalle_yoshizawa", assume, inputs)
    require_bounded_inputs("lasalle_yoshizawa", flow, assume, inputs)
    require_continuous_rates("lasalle_yoshizawa", flow, inputs)
    require_bounded_in_time("lasalle_yoshizawa", flow)
    require_moving("lasalle_yoshizawa", flow, V, W)
    require_constant("lasalle_yoshizawa", flow, inputs, lower, upper)
    others = {one: rate for one, rate in flow.items() if one not in state}
    require_constant("lasalle_yoshizawa", others, inputs, W)
    return Lemma("the LaSalle-Yoshizawa theorem", (
        *quadratic_bounds(V, state, lower, upper, flow, assume, inputs),
        Hypothesis("decrease", "V falls by W", goal_of(at_most(D(V), -W), flow, assume, inputs)),
        Hypothesis("sign", "W is not negative", goal_of(at_least(W, 0), flow, assume, inputs)),
        *regular("lasalle_yoshizawa", "continuous", "W is continuous", (W,), flow, assume, inputs),
        *regular("lasalle_yoshizawa", "lipschitz", "The rates are Lipschitz where the state is bounded",
                 rates_of(flow), flow, assume, inputs, lipschitz=True),
    ), rf"\lim_{{t \to \infty}} {latex(W)} = 0", taken("The inputs are measurable.", assume))


def razumikhin(V: sp.Expr, past: Mapping[sp.Expr, sp.Symbol], lower: sp.Expr, upper: sp.Expr, factor: sp.Expr,
               rate: sp.Expr, flow: Flow, assume: Sequence[Relation] = ()) -> Lemma:
    """V' <= -rate x'x wherever V of the delayed state is at most `factor` > 1 times V: the state decays.

    Hale and Verduyn Lunel, theorem 5.4.2, with quadratic bounds. past: all that the flow moves, time apart, each state
    with the real symbol of its value one and the same delay ago; V: of the state alone; assume: of constants alone.
    Raises ClaimError where V does not move, a state or a delayed value is declared positive or assumed to be, or a rate
    jumps or has no bound at all times.
    """
    V, lower, upper, factor, rate = exact(V, lower, upper, factor, rate)
    state, delayed = tuple(past), tuple(past.values())
    require_system("razumikhin", flow, assume, delayed)
    require_whole_state("razumikhin", flow, state)
    require_delayed("razumikhin", V, past, flow)
    require_of_no_state("razumikhin", flow, assume, delayed)
    require_continuous_rates("razumikhin", flow, delayed)
    require_bounded_in_time("razumikhin", flow)
    require_moving("razumikhin", flow, V)
    require_constant("razumikhin", flow, delayed, lower, upper, factor, rate)
    norm = square_norm(state)
    return Lemma("Razumikhin's theorem", (
        *quadratic_bounds(V, state, lower, upper, flow, assume),
        Hypothesis("rate", "V falls where its past is not much larger", goal_of(
            at_most(D(V), -rate * norm), flow, (*assume, at_most(V.xreplace(dict(past)), factor * V)), delayed)),
        Hypothesis("factor", "The factor is above one", goal_of(greater(factor, 1), {})),
        Hypothesis("decay", "The rate is positive", goal_of(greater(rate, 0), {})),
        *regular("razumikhin", "continuous", "The rates are continuous", rates_of(flow), flow, assume, delayed),
    ), rf"\lim_{{t \to \infty}} {latex(norm)} = 0",
        taken("The delay is bounded, and the same for all states.", assume))
