"""Equalities from inequalities: what is neither positive nor negative is zero."""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation, at_least, at_most, equal
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.cuts import after
from workbench.proof.decide.laurent import goal_atoms, positive_by_terms
from workbench.proof.decide.squares import find_squares
from workbench.proof.derive import Side, Size
from workbench.proof.text import text

Proof = dict[str, Any]
Given = tuple[Relation, ...]


def find_by_two_sides(goal: Goal, shown: Relation, given: Given) -> Proof | None:
    """A proof of v == 0 from v >= 0 and v <= 0, each shown by itself; None where one is not."""
    if shown.operator != "==" or shown.margin.has(sp.Sum, sp.Indexed):
        return None
    steps: list[tuple[Relation, Proof]] = []
    for side in (at_least(shown.margin, 0), at_most(shown.margin, 0)):
        proof = find_combination(goal, side, given, quick=True) or find_squares(goal, side, given)
        if proof is None:
            return None
        steps.append((side, proof))
    return after(steps, between(len(given), len(given) + 1, len(given) + 2))


def pinched(given: Given) -> list[tuple[Relation, Proof]]:
    """v == 0 for every two assumptions v >= 0 and v <= 0, each over a denominator that is positive, with its proof."""
    atoms, seen = goal_atoms(given), dict[sp.Expr, tuple[int, sp.Expr]]()
    found: list[tuple[Relation, Proof]] = []
    for place, relation in enumerate(given):
        margin = relation.margin
        if relation.operator not in (">=", "<=") or margin.has(sp.Sum, sp.Indexed, Size, Side) or margin.is_number:
            continue
        numerator, below = sp.fraction(sp.together(margin))
        number, whole = sp.expand(numerator).primitive()
        below = below / number
        try:
            if below.free_symbols and not positive_by_terms(below, atoms):
                continue
        except ClaimError:
            continue
        if sp.expand(-whole) in seen:
            other, weight = seen[sp.expand(-whole)]
            spare: list[dict[str, Any]] = [{"positive": text(b)} for b in (below, weight) if b.free_symbols]
            scale = sp.Mul(*(b for b in (below, weight) if not b.free_symbols))
            proof = between(place, other, len(given) + len(found), spare, scale)
            found.append((equal(whole, 0), proof))
        else:
            seen[whole] = place, below
    return found


def between(one: int, other: int, negation: int, spare: list[dict[str, Any]] | None = None,
            scale: sp.Expr = sp.S.One) -> Proof:
    """A proof of v == 0 where two assumptions say v >= 0 and v <= 0: were v not zero, v**2 + v (-v) = 0 > 0.

    spare: the positive factors that the two have below, times the number scale.
    """
    return {"rule": "contradiction", "terms": [
        {"coefficient": "1", "factors": [{"square_of": negation}]},
        {"coefficient": str(scale), "factors": [{"assume": one}, {"assume": other}, *(spare or [])]}]}
