"""Points at which all that is assumed holds and a relation shown is undefined: no proof of such a goal is sought."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError
from workbench.proof.claim import Goal, Relation, at_least, differ, greater
from workbench.proof.decide.exact_look import Exact
from workbench.proof.decide.first_lemmas import seen_at_once
from workbench.proof.decide.proposals import Point, first_proposals
from workbench.proof.text import assumptions, goal_text, relation_text


def undefined_somewhere(goal: Goal) -> str | None:
    """Where a relation shown is undefined, in words; None where no such point was met, and of motions, which need not
    come there."""
    if goal.initial or goal.always or goal.eventually is not None:
        return None
    given = assumptions(goal)
    for wanted in dict.fromkeys(_wanted(goal)):
        point = None if seen_at_once(wanted, given) else _broken(replace(goal, show=(wanted,)))
        if point is not None:
            where = ", ".join(f"{name} = {value}" for name, value in sorted(point.items()))
            return f"undefined at {where}, where all that is assumed holds: there not {relation_text(wanted)}"
    return None


def _broken(goal: Goal) -> Point | None:
    try:
        exact = Exact(goal_text(goal))
        return next((point for point in first_proposals(goal.evaluated()) if exact.breaks(point)), None)
    except (CertificateError, ClaimError):  # nothing exact can be said of it
        return None


def _wanted(goal: Goal) -> Iterator[Relation]:
    """What must hold for all that a goal shows to be defined; nothing of what stands in sums, where it is no number."""
    for side in (side for relation in goal.show for side in (relation.left, relation.right)):
        for part in sorted(side.atoms(sp.Pow, sp.log), key=sp.default_sort_key):
            inner = part.args[0]
            if not inner.free_symbols or inner.has(sp.Sum, sp.Indexed):
                continue
            if isinstance(part, sp.log):
                yield greater(inner, 0)
            elif part.exp.is_Rational and part.exp < 0:
                yield differ(inner, 0) if part.exp.is_Integer else greater(inner, 0)
            elif part.exp.is_Rational and not part.exp.is_Integer:
                yield at_least(inner, 0)
