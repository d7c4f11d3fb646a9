"""Lemmas by which a set is not left: Nagumo with a rate that points inwards, Darboux with a cofactor."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.proof.claim import D, Relation, equal, greater
from workbench.proof.latex.write import latex
from workbench.proof.lemmas.lemma import Hypothesis, Lemma, exact, goal_of, taken
from workbench.proof.lemmas.regular import regular
from workbench.proof.lemmas.requirements import (
    Flow,
    Inputs,
    require_closed,
    require_continuous_rates,
    require_moving,
    require_of_no_state,
    require_system,
)


def nagumo(h: sp.Expr, flow: Flow, assume: Sequence[Relation] = (), inputs: Inputs = ()) -> Lemma:
    """h' > 0 wherever h = 0: the set h >= 0 is not left.

    Blanchini, Automatica 35 (1999), section 3; strict, so that nothing is asked of the gradient of h. assume: of
    inputs and constants alone, as the bounds of a disturbance, which are closed. Raises ClaimError where h does not
    move, a state is declared positive or assumed to be, or a rate jumps.
    """
    (h,) = exact(h)
    _require("nagumo", h, flow, assume, inputs)
    return Lemma("Nagumo's theorem", (
        Hypothesis("border", "The rate on the border points inwards",
                   goal_of(greater(D(h), 0), flow, (*assume, equal(h, 0)), inputs)),
    ), rf"h(0) \ge 0 \Rightarrow h \ge 0 \text{{ at all times, with }} h = {latex(h)}",
        taken("Inputs are bounded over every bounded time.", assume))


def darboux(h: sp.Expr, cofactor: sp.Expr, flow: Flow, assume: Sequence[Relation] = (), inputs: Inputs = ()) -> Lemma:
    """h' = cofactor h, the cofactor continuous everywhere: the sets h = 0, h > 0 and h < 0 are not left while solutions
    exist.

    Goriely, Integrability and Nonintegrability of Dynamical Systems, section 2.5. A cofactor that need not be defined
    everywhere, as h'/h is not, is one more hypothesis. assume, ClaimError: see `nagumo`.
    """
    h, cofactor = exact(h, cofactor)
    _require("darboux", h, flow, assume, inputs)
    return Lemma("Darboux's lemma", (
        Hypothesis("rate", "The rate is a multiple", goal_of(equal(D(h), cofactor * h), flow, assume, inputs)),
        *regular("darboux", "continuous", "The cofactor is defined everywhere", (cofactor,), flow, assume, inputs),
    ), rf"h(0) > 0 \Rightarrow h > 0 \text{{ at all times, with }} h = {latex(h)}",
        taken("Inputs are bounded over every bounded time.", assume))


def _require(name: str, h: sp.Expr, flow: Flow, assume: Sequence[Relation], inputs: Inputs) -> None:
    require_system(name, flow, assume, inputs)
    require_of_no_state(name, flow, assume)
    require_closed(name, assume, inputs)
    require_continuous_rates(name, flow, inputs)
    require_moving(name, flow, h)
