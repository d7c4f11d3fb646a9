"""How claims rest on each other: what is wrong with the premises, and how failures travel along them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from graphlib import CycleError, TopologicalSorter

from workbench.proof.verdict import FAILED, Decision, Stated

Links = Callable[[Stated], tuple[str, ...]]


def premises_problem(claims: Sequence[Stated]) -> tuple[str, str] | None:
    """The id of the first claim whose id or premises cannot be used, and what is wrong in one line; else None."""
    by_id: dict[str, Stated] = {}
    for claim in claims:
        if claim.id in by_id:
            return claim.id, f"claim {claim.id}: its id is used twice: give each claim its own"
        by_id[claim.id] = claim
    for claim in claims:
        for what, name in _named(claim):
            if name not in by_id:
                near = get_close_matches(name, by_id, n=3)
                meant = f" (near it: {', '.join(near)})" if near else ""
                return claim.id, (f"claim {claim.id}: {what} '{name}' is no claim{meant}: "
                                  "state it, correct the id or name its proof file too")
    for what, links in (("premises", lambda claim: claim.premises), ("rests_on", lambda claim: claim.chain)):
        try:
            _sorter(claims, links).prepare()
        except CycleError as trouble:
            circle = set(trouble.args[1])
            first = next(claim.id for claim in claims if claim.id in circle)
            return first, (f"claim {first}: rests on itself through its {what} "
                           f"({' -> '.join(reversed(trouble.args[1]))}): break the circle")
    return None


def _named(claim: Stated) -> Iterator[tuple[str, str]]:
    """What a claim calls the claims that it names, and their ids."""
    for what, names in (("premise", claim.premises), ("rests_on", claim.chain), ("glyph", (claim.glyph,)),
                        ("mends", (claim.mends,))):
        yield from ((what, name) for name in names if name is not None)


def below(ids: Iterable[str], claims: Mapping[str, Stated]) -> set[str]:
    """The claims named and all that must be decided to say what becomes of them: what they rest on in the paper and
    in our proof, their other readings and their mended forms, directly or not."""
    mended: dict[str, list[str]] = {}
    for claim in claims.values():
        if claim.mends is not None:
            mended.setdefault(claim.mends, []).append(claim.id)
    seen: set[str] = set()
    waiting = list(ids)
    while waiting:
        current = waiting.pop()
        if current not in seen:
            seen.add(current)
            waiting += [name for _, name in _named(claims[current])] + mended.get(current, [])
    return seen


def counts_as_failure(decision: Decision) -> bool:
    """Whether a decision speaks against what rests on it: it fails, and something depends on it."""
    return decision.verdict in FAILED and decision.claim.severity != "cosmetic"


def holds_in_other_reading(decision: Decision, by_id: Mapping[str, Decision]) -> bool:
    """Whether the other reading of a line with an unclear glyph is proved."""
    other = by_id.get(decision.claim.glyph) if decision.claim.glyph else None
    return other is not None and other.verdict == "proved"


def with_taint(decisions: Sequence[Decision]) -> list[Decision]:
    """The decisions, each with the failed claims in the paper's chain to it, in the order of the decisions.

    Every claim that one rests on must be among the decisions, and none may rest on itself.
    """
    found = on_the_way(decisions, counts_as_failure)
    return [replace(d, tainted_by=found[d.claim.id]) for d in decisions]


def slips_on_the_way(decisions: Sequence[Decision]) -> dict[str, tuple[str, ...]]:
    """By the id of each claim the lines in the paper's chain to it that fail and on which nothing depends; without
    those that hold in their other reading."""
    by_id = {d.claim.id: d for d in decisions}
    return on_the_way(decisions, lambda d: d.verdict in FAILED and not (
        counts_as_failure(d) or holds_in_other_reading(d, by_id)))


def on_the_way(decisions: Sequence[Decision], counts: Callable[[Decision], bool]) -> dict[str, tuple[str, ...]]:
    """By the id of each claim those in the paper's chain to it that count, in the order of the decisions."""
    by_id = {d.claim.id: d for d in decisions}
    found: dict[str, set[str]] = {}
    for name in _sorter([d.claim for d in decisions], lambda claim: claim.chain).static_order():
        ids = by_id[name].claim.chain
        found[name] = {i for i in ids if counts(by_id[i])}.union(*(found[i] for i in ids))
    return {name: tuple(other for other in by_id if other in found[name]) for name in by_id}


def proved_under(decisions: Sequence[Decision]) -> dict[str, tuple[str, ...]]:
    """By the id of each claim that is proved the claims that its proof uses and that are not shown themselves, in the
    order of the decisions: it is true where these are. What such a claim in turn uses says no more."""
    by_id = {d.claim.id: d for d in decisions}
    found: dict[str, set[str]] = {}
    for name in ordered([d.claim for d in decisions]):
        known = by_id[name].verdict in ("proved", "assumed")
        found[name] = set().union(*(found[i] for i in by_id[name].claim.premises)) if known else {name}
    return {name: tuple(other for other in by_id if other in found[name]) for name, d in by_id.items()
            if d.verdict == "proved"}


def ordered(claims: Sequence[Stated]) -> list[str]:
    """The ids of claims, what a proof uses before what uses it."""
    return list(_sorter(claims, lambda claim: claim.premises).static_order())


def _sorter(claims: Sequence[Stated], links: Links) -> TopologicalSorter[str]:
    return TopologicalSorter({claim.id: links(claim) for claim in claims})
