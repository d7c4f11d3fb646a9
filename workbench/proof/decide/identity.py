"""Decide an identity: the difference of the sides is zero as a rational function, at random
points of exact arithmetic; the checker decides."""

from __future__ import annotations

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Atoms, flatten
from workbench.proof.decide.vanishing import vanishes


def find_identity(goal: Goal, shown: Relation) -> bool:
    """Whether the relation's sides are the same rational function of symbols, logs and exps."""
    try:
        flat = flatten(shown.margin, Atoms(), goal.flow)
    except ClaimError:
        return False
    return vanishes(flat)
