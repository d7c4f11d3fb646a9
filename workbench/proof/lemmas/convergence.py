"""Lemmas by which errors vanish: Barbalat, LaSalle-Yoshizawa, Razumikhin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from workbench.proof.claim import D, Relation, at_least, at_most, greater
from workbench.proof.latex.write import latex
from workbench.proof.lemmas.bounds import Inputs, quadratic_bounds
from workbench.proof.lemmas.lemma import Flow, Hypothesis, Lemma, goal_of, require_constant, require_moving, square_norm


def barbalat(V: sp.Expr, W: sp.Expr, level: sp.Symbol, steepest: sp.Expr, flow: Flow, assume: Sequence[Relation] = (),
             inputs: Inputs = ()) -> Lemma:
    """V >= 0, V' <= -W <= 0, and a W that changes no faster than `steepest` while V <= level: W vanishes.

    Barbalat's lemma as Slotine and Li, Applied Nonlinear Control, lemma 4.3, use it. level: stands for V(0), so a
    symbol; steepest: constant, may have the level in it. assume: what holds at all times. Raises ClaimError where V or
    W does not move.
    """
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
    ), rf"\lim_{{t \to \infty}} {latex(W)} = 0")


def lasalle_yoshizawa(V: sp.Expr, state: Sequence[sp.Expr], lower: sp.Expr, upper: sp.Expr, W: sp.Expr, flow: Flow,
                      assume: Sequence[Relation] = (), inputs: Inputs = ()) -> Lemma:
    """lower x'x <= V <= upper x'x and V' <= -W(x) <= 0: all states stay bounded, and W vanishes.

    Krstic, Kanellakopoulos and Kokotovic, theorem A.8, with quadratic bounds. W: of the state alone, so that it is
    continuous where the state is bounded. Raises ClaimError where V does not move, or W is of more than the state.
    """
    require_moving("lasalle_yoshizawa", flow, V, W)
    require_constant("lasalle_yoshizawa", flow, inputs, lower, upper)
    others = {one: rate for one, rate in flow.items() if one not in state}
    require_constant("lasalle_yoshizawa", others, inputs, W)
    return Lemma("the LaSalle-Yoshizawa theorem", (
        *quadratic_bounds(V, state, lower, upper, flow, assume, inputs),
        Hypothesis("decrease", "V falls by W", goal_of(at_most(D(V), -W), flow, assume, inputs)),
        Hypothesis("sign", "W is not negative", goal_of(at_least(W, 0), flow, assume, inputs)),
    ), rf"\lim_{{t \to \infty}} {latex(W)} = 0",
        "The rates are locally Lipschitz in the state and bounded where it is, at all times alike.")


def razumikhin(V: sp.Expr, past: Mapping[sp.Expr, sp.Symbol], lower: sp.Expr, upper: sp.Expr, factor: sp.Expr,
               rate: sp.Expr, flow: Flow, assume: Sequence[Relation] = ()) -> Lemma:
    """V' <= -rate x'x wherever V of the delayed state is at most `factor` > 1 times V: the state decays.

    Hale and Verduyn Lunel, theorem 5.4.2, with quadratic bounds. past: each state with the symbol of its delayed value,
    which has no rate of its own. Raises ClaimError where V does not move.
    """
    state, delayed = tuple(past), tuple(past.values())
    require_moving("razumikhin", flow, V)
    require_constant("razumikhin", flow, delayed, lower, upper, factor, rate)
    norm = square_norm(state)
    return Lemma("Razumikhin's theorem", (
        *quadratic_bounds(V, state, lower, upper, flow, assume),
        Hypothesis("rate", "V falls where its past is not much larger", goal_of(
            at_most(D(V), -rate * norm), flow, (*assume, at_most(V.xreplace(dict(past)), factor * V)), delayed)),
        Hypothesis("factor", "The factor is above one", goal_of(greater(factor, 1), {})),
        Hypothesis("decay", "The rate is positive", goal_of(greater(rate, 0), {})),
    ), rf"\lim_{{t \to \infty}} {latex(norm)} = 0",
        "The delay is bounded, and the rates are continuous and bounded where the states and their past are.")
