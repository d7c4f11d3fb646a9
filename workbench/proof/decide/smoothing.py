"""The smooth switching of sliding modes: abs(s) - s tanh(s/eps) <= 0.2785 eps, which papers take from the literature.

Shown first, so that what else stands beside it, as disturbances and gains, need only add up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_most
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.derive import expand_derivatives

Proof = dict[str, Any]
Given = tuple[Relation, ...]
# The most of r - r tanh(r) is 0.27846...; papers round it up.
MOST = sp.Rational(557, 2000)
Prove = Callable[[Goal, Relation, tuple[Relation, ...]], Proof | None]


def smoothing_lemmas(goal: Goal, shown: Relation, given: Given, prove: Prove) -> list[tuple[Relation, Proof]]:
    """The bound for each s tanh(s/eps), eps > 0, beside sizes in an inequality that says more than the bound alone,
    with its proof."""
    if shown.operator in ("==", "!="):
        return []
    margin = expand_derivatives(shown.margin, goal.flow)
    if not margin.has(sp.tanh) or not any(each.has(sp.Abs, sp.sign) for each in (margin, *(r.margin for r in given))):
        return []
    found: list[tuple[Relation, Proof]] = []
    expanded = sp.expand(margin)
    for tanh in sorted(margin.atoms(sp.tanh), key=sp.default_sort_key):
        inner, width = sp.fraction(tanh.args[0])
        if tanh.args[0].has(sp.Sum, sp.Indexed) or not (
                width.is_positive or any(r.strict and vanishes(r.margin - width) for r in given)):
            continue
        lemma = at_most(sp.Abs(inner) - inner * tanh, MOST * width)
        own, share = tanh.args[0].free_symbols, sp.cancel(expanded.coeff(tanh) / inner)
        if share == 0 or not sp.denom(share).free_symbols.isdisjoint(inner.free_symbols):
            continue  # it is no factor of its argument
        if margin.free_symbols == own or sp.cancel(margin / lemma.margin).free_symbols.isdisjoint(own):
            continue  # it is the bound itself, for the search
        if (proof := prove(goal, lemma, (*given, *(other for other, _ in found)))) is not None:
            found.append((lemma, proof))
    return found
