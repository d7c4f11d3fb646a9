"""The lines of a paper that its headline statements rest on, and the paths on which they fail."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from workbench.proof.verdict import FAILED
from workbench.report.claims import ClaimView


@dataclass(frozen=True)
class PremiseGraph:
    """Lines and what rests on what: an edge (a, b) says that b rests on a; both are places in `lines`.

    broken: the edges along which a failure travels; whole: whether all lines below the headline statements are here,
    or those on broken paths alone.
    """

    lines: tuple[ClaimView, ...]
    edges: tuple[tuple[int, int], ...]
    broken: frozenset[tuple[int, int]]
    whole: bool


def premise_graphs(claims: Sequence[ClaimView]) -> list[PremiseGraph]:
    """The broken paths, then all that the headline statements rest on; none where no headline statement is known."""
    by_id = {claim.id: claim for claim in claims}
    used = {claim.id: [ref.id for ref in claim.rests_on if ref.id in by_id] for claim in claims}
    headlines = [claim.id for claim in claims if claim.fate]
    below: set[str] = set()
    asked = list(headlines)
    while asked:
        name = asked.pop()
        if name not in below:
            below.add(name)
            asked += used[name]
    failing = {name for name in below if _fails(by_id[name])}
    graphs = [_graph([c for c in claims if c.id in failing], used, whole=False),
              _graph([c for c in claims if c.id in below], used, whole=True)]
    return [graph for graph in graphs if graph.lines and (graph.edges or not graph.whole)]


def _fails(claim: ClaimView) -> bool:
    return claim.verdict in FAILED or bool(claim.tainted_by)


def _graph(lines: Sequence[ClaimView], used: Mapping[str, Sequence[str]], whole: bool) -> PremiseGraph:
    place = {claim.id: i for i, claim in enumerate(lines)}
    edges = _without_shortcuts([(place[name], i) for i, claim in enumerate(lines)
                                for name in dict.fromkeys(used[claim.id]) if name in place and name != claim.id])
    broken = frozenset((a, b) for a, b in edges if _fails(lines[a]) and lines[b].tainted_by)
    return PremiseGraph(tuple(lines), tuple(edges), broken, whole)


def _without_shortcuts(edges: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """The edges without those that a longer way says too."""
    onward: dict[int, set[int]] = {}
    for a, b in edges:
        onward.setdefault(a, set()).add(b)
    reached: dict[int, set[int]] = {}

    def beyond(a: int) -> set[int]:
        if a not in reached:
            reached[a] = set()  # a circle, which no paper's chain has, would end here
            reached[a] = {c for b in onward.get(a, ()) for c in (b, *beyond(b))}
        return reached[a]

    return [(a, b) for a, b in edges if not any(b in beyond(other) for other in onward[a] - {b})]
