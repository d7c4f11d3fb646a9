"""Decide an identity: the difference of the sides is zero as a rational function, no floating point."""

from __future__ import annotations

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Atoms, flatten


def find_identity(goal: Goal, shown: Relation) -> bool:
    """Whether the relation's sides are the same rational function of symbols, logs and exps."""
    try:
        flat = flatten(shown.margin, Atoms(), goal.flow)
    except ClaimError:
        return False
    return bool(sp.expand(sp.fraction(sp.together(flat))[0]) == 0)
