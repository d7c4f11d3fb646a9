"""Lemmas by which a set is not left: Nagumo with a rate that points inwards, Darboux with a cofactor."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.proof.claim import D, Relation, equal, greater
from workbench.proof.latex.write import latex
from workbench.proof.lemmas.bounds import Inputs
from workbench.proof.lemmas.lemma import Flow, Hypothesis, Lemma, goal_of, require_moving


def nagumo(h: sp.Expr, flow: Flow, assume: Sequence[Relation] = (), inputs: Inputs = ()) -> Lemma:
    """h' > 0 wherever h = 0: the set h >= 0 is not left.

    Blanchini, Automatica 35 (1999), section 3; strict, so that nothing is asked of the gradient of h. assume: what
    holds at all times besides, as the bounds of a disturbance. Raises ClaimError where h does not move.
    """
    require_moving("nagumo", flow, h)
    return Lemma("Nagumo's theorem", (
        Hypothesis("border", "The rate on the border points inwards",
                   goal_of(greater(D(h), 0), flow, (*assume, equal(h, 0)), inputs)),
    ), rf"h(0) \ge 0 \Rightarrow h \ge 0 \text{{ at all times, with }} h = {latex(h)}")


def darboux(h: sp.Expr, cofactor: sp.Expr, flow: Flow, assume: Sequence[Relation] = (), inputs: Inputs = ()) -> Lemma:
    """h' = cofactor h, the cofactor continuous: the sets h = 0, h > 0 and h < 0 are not left while solutions exist.

    Goriely, Integrability and Nonintegrability of Dynamical Systems, section 2.5. Raises ClaimError where h does not
    move.
    """
    require_moving("darboux", flow, h)
    return Lemma("Darboux's lemma", (
        Hypothesis("rate", "The rate is a multiple", goal_of(equal(D(h), cofactor * h), flow, assume, inputs)),
    ), rf"h(0) > 0 \Rightarrow h > 0 \text{{ at all times, with }} h = {latex(h)}")
