"""A goal at stated values: what a condition asks at the numbers that a paper prints."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation
from workbench.proof.derive import expand_derivatives
from workbench.proof.typed import as_typed


def pinned(goal: Goal, values: dict[Any, Fraction]) -> Goal:
    """The goal with symbols replaced by values; assumptions that become plain facts stay, to be checked."""
    if goal.initial or goal.eventually is not None:
        raise ClaimError("stated values decide a condition of one instant: it has no initial values or later times")
    for s, v in values.items():
        if (s.is_positive and v <= 0) or (s.is_nonnegative and v < 0):
            raise ClaimError(f"{s} = {v} contradicts the sign of its symbol")
    exact = {s: sp.Rational(v.numerator, v.denominator) for s, v in values.items()}

    def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        # Derivatives first: D of a symbol that has become a number would be zero.
        carried = (Relation(expand_derivatives(r.left, goal.flow), r.operator, expand_derivatives(r.right, goal.flow))
                   for r in relations)
        with as_typed():
            return tuple(r.subs(exact) for r in carried)

    return replace(goal, show=put(goal.show), assume=put(goal.assume), always=put(goal.always), flow={},
                   lemmas=put(goal.lemmas), facts=tuple(f.xreplace(exact) for f in goal.facts), inputs=())
