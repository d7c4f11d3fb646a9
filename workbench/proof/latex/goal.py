"""A goal as LaTeX, for readers: made from what was decided."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy as sp

from workbench.proof.claim import Goal, Relation
from workbench.proof.latex.tidy import tidied
from workbench.proof.latex.write import latex, letters_of


def goal_latex(goal: Goal) -> str:
    """A goal in one line of LaTeX: what it shows, given what, along which rates, and since when."""
    relations = [_tidied(relation) for relation in goal.relations()]
    flow, initial = ({s: tidied(value) for s, value in found.items()} for found in (goal.flow, goal.initial))
    letters = letters_of([*(side for r in relations for side in (r.left, r.right)), *flow, *flow.values(),
                          *initial, *initial.values()])

    def listed(found: Iterable[Relation]) -> str:
        return r",\ ".join(_tidied(relation).latex(letters) for relation in found)

    def equations(left: str, found: Mapping[sp.Expr, sp.Expr]) -> str:
        return r",\ ".join(f"{left.format(latex(s, letters))} = {latex(value, letters)}" for s, value in found.items())

    parts = {"given": listed((*goal.signs(), *goal.assume)), "at all times": listed(goal.always),
             "at first": equations("{}", initial), "along": equations(r"\frac{{d}}{{dt}} {}", flow)}
    late = r"\quad\text{from some time on}" if goal.eventually is not None else ""
    return listed(goal.show) + late + "".join(rf"\quad\text{{{word}}}\ {text}" for word, text in parts.items() if text)


def _tidied(relation: Relation) -> Relation:
    return Relation(tidied(relation.left), relation.operator, tidied(relation.right))
