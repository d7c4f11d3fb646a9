"""The same statement turned round: what is shown and what is assumed change places, and symbols count from a centre.

A, B => C says as well that A and not C exclude B. Sums of squares are sought for one polynomial, and which one
it is decides how large programs are and whether multipliers of high degree are needed. Where a statement speaks of
(y - 20)**20, numbers stay small only if y is counted from 20.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.centres import (
    Centre,
    carried_along,
    centre_of,
    shifted,
    shifted_back,
    squares_completed,
)
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.squares import find_squares
from workbench.proof.text import assumptions, text
from workbench.proof.typed import evaluated

Proof = dict[str, Any]
Term = dict[str, Any]
PLACES = ("assume", "inverse", "square_of")  # the keys by which a factor names an assumption
MOST_TURNS = 4


@dataclass(frozen=True)
class Exclusion:
    """Relations of which at least one does not hold: all that a goal assumes, and its opposite at the end."""

    relations: tuple[Relation, ...]

    def without(self, turned: int, kept: list[int]) -> tuple[Goal, list[int]]:
        """The goal that the others kept exclude one of them, and the places of its assumptions and of that one."""
        others = [place for place in kept if place != turned]
        return (Goal((self.relations[turned].negation,), tuple(self.relations[place] for place in others)),
                [*others, turned])


def exclusion_of(goal: Goal) -> Exclusion:
    """What a goal that shows one relation says to exclude each other."""
    return Exclusion((*assumptions(goal), goal.show[0].negation))


def contradictory(proof: Proof, negation: int, shown: Relation) -> list[Term] | None:
    """The terms by which the assumptions and the goal's opposite, at its place, add up to 0 > 0; None if not known."""
    if proof["rule"] == "cases" and proof.get("negative", proof)["rule"] == "contradiction":
        proof = proof["negative"]
    if proof["rule"] == "contradiction":
        return list(proof["terms"])
    if proof["rule"] not in ("combination", "identity"):
        return None
    scale = proof.get("multiplier", [])
    if shown.operator == "==":  # m v is a sum of zeros: were v not zero, m v**2 - v (sum of zeros) = 0 > 0
        value = {"any": text(sp.Add(shown.left, sp.Mul(-1, shown.right, evaluate=False), evaluate=False))}
        return [{"coefficient": "1", "factors": [*scale, {"square_of": negation}]},
                *({"coefficient": str(-Fraction(term["coefficient"])), "factors": [*term["factors"], value]}
                  for term in proof.get("terms", []))]
    return [*proof.get("terms", []), {"coefficient": "1", "factors": [*scale, {"assume": negation}]}]


def renumbered(terms: list[Term], new: dict[int, int]) -> list[Term]:
    """The terms with every assumption at its new place."""
    return [{"coefficient": term["coefficient"], "factors": [
        {key: new[value] if key in PLACES else value for key, value in item.items()} for item in term["factors"]]}
        for term in terms]


def find_turned(goal: Goal, stated: bool = False) -> Proof | None:
    """A proof of a goal that shows one relation, sought for what it assumes instead, or from a centre; None if none.

    Polynomials of low degree first: their programs are small. stated: also for what the goal shows, without a centre.
    """
    centre = centre_of(goal)
    found = _turned(goal, centre, stated)
    if found is None and (squared := squares_completed(goal)) and squared != centre:
        found = _turned(goal, squared, stated)
    return found


def find_carried(goal: Goal) -> Proof | None:
    """A proof of a goal of one relation that speaks of distances alone: in fewer symbols, counted from another one."""
    along = carried_along(goal)
    return _turned(goal, along, True) if along else None


def _turned(goal: Goal, centre: Centre, stated: bool) -> Proof | None:
    whole = exclusion_of(goal)
    degrees = {place: _degree(relation) for place, relation in enumerate(whole.relations)}
    last = len(whole.relations) - 1
    places = sorted((p for p in degrees if degrees[p] > 1 and whole.relations[p].operator != "=="),
                    key=degrees.__getitem__)[:MOST_TURNS]
    for turned in places:
        if turned == last and not (centre or stated):
            continue
        form, order = whole.without(turned, list(range(last + 1)))
        found = _sought(shifted(form, centre))
        terms = None if found is None else contradictory(found, last, form.show[0])
        if terms is not None:
            return {"rule": "contradiction",
                    "terms": renumbered(shifted_back(terms, centre), dict(enumerate(order)))}
    return None


def _sought(goal: Goal) -> Proof | None:
    shown, given = goal.show[0], assumptions(goal)
    return find_combination(goal, shown, given, quick=True) or find_squares(goal, shown, given)


def _degree(relation: Relation) -> int:
    margin = evaluated(relation.margin)
    if not margin.free_symbols or not margin.is_polynomial(*margin.free_symbols):
        return 0
    return int(sp.Poly(margin, *margin.free_symbols).total_degree())
