"""The sine near zero: x sin(x) >= x**2 - x**4/6, which is not negative where abs(x) is at most 2.4, as pendulums, droop
and oscillators have it.

Shown first, so that what else stands beside it need only add up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least
from workbench.proof.derive import expand_derivatives

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Prove = Callable[[Goal, Relation, Given], Proof | None]


def sine_lemmas(goal: Goal, shown: Relation, given: Given, prove: Prove) -> list[tuple[Relation, Proof]]:
    """The bound for each symbol that stands beside its sine in an inequality and is bounded by what is given, with its
    proof."""
    if shown.operator in ("==", "!="):
        return []
    margin = sp.expand(expand_derivatives(shown.margin, goal.flow))
    found: list[tuple[Relation, Proof]] = []
    for sine in sorted(margin.atoms(sp.sin), key=sp.default_sort_key):
        x = sine.args[0]
        share = sp.cancel(margin.coeff(sine) / x) if x.is_Symbol else sp.S.Zero
        if share == 0 or not sp.denom(share).free_symbols.isdisjoint({x}) or not any(
                x in r.margin.free_symbols and not r.margin.has(sp.sin, sp.cos) for r in given):
            continue
        lemma = at_least(x * sine, x**2 - x**4 / 6)
        if sp.cancel(margin / lemma.margin).free_symbols.isdisjoint({x}):
            continue  # it is the bound itself, for the search
        if (proof := prove(goal, lemma, (*given, *(other for other, _ in found)))) is not None:
            found.append((lemma, proof))
    return found
