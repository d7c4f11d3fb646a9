"""Break a claim of "from some time on" by functions of time that meet every assumption and never do as shown."""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Goal, Relation, Verdict, at_least, name_of
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.identity import find_identity
from workbench.proof.text import goal_text, text

NEGATED = {"<=": ">", "<": ">=", ">=": "<", ">": "<="}


def find_model(goal: Goal, verdict: Verdict) -> dict[str, Any] | None:
    """A certificate made of the model that the goal proposes, or None when it is none."""
    time = goal.eventually
    if time is None or not goal.model:
        return None
    moving = [s for s in goal.flow if s != time]
    constants = {s: v for s, v in goal.model.items() if s not in moving}
    values = {s: goal.model[s] for s in moving}
    values |= {goal.flow[s]: sp.diff(goal.model[s], time) for s in moving}
    later = (at_least(time, 0),)

    def along(relation: Relation) -> Relation:
        return relation.subs(values).subs(constants)

    def proof(relation: Relation) -> dict[str, Any] | None:
        if relation.operator in ("==", "<=", ">=") and find_identity(Goal((relation,)), relation):
            return {"rule": "identity"}
        return find_combination(Goal((relation,)), relation, later)

    shown = along(goal.show[0])
    fails = proof(Relation(shown.left, NEGATED[shown.operator], shown.right))  # type: ignore[arg-type]
    always = [proof(along(r)) for r in goal.always]
    if fails is None or None in always:
        return None
    certificate = {"version": 1, "verdict": verdict, "goal": goal_text(goal),
                   "functions": {name_of(s): text(goal.model[s]) for s in moving},
                   "point": {name_of(s): str(v) for s, v in constants.items()}, "always": always, "fails": fails}
    try:
        check(certificate)
    except CertificateError:
        return None
    return certificate
