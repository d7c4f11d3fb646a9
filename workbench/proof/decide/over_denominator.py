"""Inequalities over what the circle's functions make of a denominator, as an inertia a + b cos(q): of the numerator."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Operator, Relation
from workbench.proof.decide.cuts import after
from workbench.proof.decide.first_lemmas import definedness
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Prove = Callable[[Goal, Relation, Given], Proof | None]


def find_over_denominator(goal: Goal, shown: Relation, given: Given, prove: Prove) -> Proof | None:
    """A proof that a fraction's numerator is as it should be, its denominator a product of what is known to be
    positive; None where there is no such denominator, or no proof."""
    margin = sp.together(expand_derivatives(shown.margin, goal.flow))
    numerator, denominator = sp.fraction(margin)
    if shown.operator == "!=" or not denominator.has(sp.sin, sp.cos) or margin.has(sp.Sum, sp.Indexed):
        return None
    first = definedness(goal, Relation(margin, "==", sp.S.Zero), given)
    known = (*given, *(lemma for lemma, _ in first))
    number, factors = sp.factor_terms(denominator).as_coeff_Mul()
    multiplier: list[dict[str, Any]] = []
    for base, power in (factor.as_base_exp() for factor in sp.Mul.make_args(factors)):
        places = [place for place, r in enumerate(known) if r.strict and vanishes(r.margin - base)]
        if not (places or base.is_positive) or not power.is_Integer or not number > 0:
            return None
        multiplier += [{"assume": places[0]} if places else {"positive": text(base)}] * int(power)
    operator: Operator = "==" if shown.operator == "==" else ">" if shown.strict else ">="
    lemma = Relation(sp.expand(numerator / number), operator, sp.S.Zero)
    proof = prove(goal, lemma, known)
    if proof is None:
        return None
    return after([*first, (lemma, proof)], {"rule": "combination", "multiplier": multiplier, "terms": [
        {"coefficient": "1", "factors": [{"assume": len(known)}]}]})
