"""What a relation needs to be defined, shown first where it does not stand among the assumptions."""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.checker import CertificateError, read_goal
from workbench.proof.claim import Goal, Relation, at_least, greater
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.search import search
from workbench.proof.text import assumptions, goal_text, relation_text

Proof = dict[str, Any]


def defined_first(goal: Goal, shown: Relation, proof: Proof | None) -> Proof | None:
    """The proof, or one that first shows that denominators are not zero and arguments of log and sqrt have a value.

    So 1/x <= x, where x >= 1 is assumed, is shown after x > 0.
    """
    try:
        _, given = read_goal(goal_text(goal))
        given.require_defined(relation_text(shown))
    except CertificateError:
        pass
    else:
        return proof
    known = assumptions(goal)
    steps: list[tuple[Relation, Proof]] = []
    for lemma, opposite in _needed(shown):
        for relation in (lemma, opposite):
            found = None if relation is None else find_combination(goal, relation, (*known, *(r for r, _ in steps)))
            if relation is not None and found is not None:
                steps.append((relation, found))
                break
    final = search(goal, shown, (*known, *(r for r, _ in steps)), goal.lemmas) if steps else None
    if final is None:
        return proof
    for lemma, found in reversed(steps):
        final = {"rule": "cut", "lemma": relation_text(lemma), "proof": found, "then": final}
    return final


def _needed(shown: Relation) -> list[tuple[Relation, Relation | None]]:
    """Relations that would give each part a value, innermost first, and what would do as well."""
    found: list[tuple[Relation, Relation | None]] = []
    for part in (p for side in (shown.left, shown.right) for p in sp.postorder_traversal(side)):
        if isinstance(part, sp.log):
            found.append((greater(part.args[0], 0), None))
        elif isinstance(part, sp.Pow) and not part.exp.is_Integer and part.base != sp.E:
            found.append((at_least(part.base, 0), None))
        if isinstance(part, sp.Pow) and part.exp.is_negative:
            found.append((greater(part.base, 0), greater(-part.base, 0)))
    return [pair for pair in found if not pair[0].left.has(sp.Indexed)]
