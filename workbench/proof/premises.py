"""How claims rest on each other: what is wrong with the premises, and how failures travel along them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from graphlib import CycleError, TopologicalSorter

from workbench.proof.verdict import FAILED, Decision, Stated


def premises_problem(claims: Sequence[Stated]) -> tuple[str, str] | None:
    """The id of the first claim whose id or premises cannot be used, and what is wrong in one line; else None."""
    by_id: dict[str, Stated] = {}
    for claim in claims:
        if claim.id in by_id:
            return claim.id, f"claim ids used twice: {claim.id}: give each claim its own id"
        by_id[claim.id] = claim
    for claim in claims:
        for premise in claim.premises:
            if premise not in by_id:
                near = get_close_matches(premise, by_id, n=3)
                meant = f" (near it: {', '.join(near)})" if near else ""
                return claim.id, (f"claim {claim.id}: premise '{premise}' is no claim{meant}: "
                                  "state it, correct the id or name its proof file too")
    try:
        _sorter(claims).prepare()
    except CycleError as trouble:
        circle = set(trouble.args[1])
        first = next(claim.id for claim in claims if claim.id in circle)
        return first, (f"claim {first}: rests on itself through its premises "
                       f"({' -> '.join(reversed(trouble.args[1]))}): break the circle")
    return None


def below(ids: Iterable[str], claims: Mapping[str, Stated]) -> set[str]:
    """The claims named and all that they rest on, directly or not."""
    seen: set[str] = set()
    waiting = list(ids)
    while waiting:
        current = waiting.pop()
        if current not in seen:
            seen.add(current)
            waiting += claims[current].premises
    return seen


def with_taint(decisions: Sequence[Decision]) -> list[Decision]:
    """The decisions, each with the failed claims that it rests on, in the order of the decisions.

    Every premise must be among the decisions, and none may rest on itself.
    """
    by_id = {d.claim.id: d for d in decisions}
    tainted: dict[str, set[str]] = {}
    for name in _sorter([d.claim for d in decisions]).static_order():
        premises = by_id[name].claim.premises
        tainted[name] = {p for p in premises if by_id[p].verdict in FAILED}.union(*(tainted[p] for p in premises))
    return [replace(d, tainted_by=tuple(name for name in by_id if name in tainted[d.claim.id])) for d in decisions]


def _sorter(claims: Sequence[Stated]) -> TopologicalSorter[str]:
    return TopologicalSorter({claim.id: claim.premises for claim in claims})
