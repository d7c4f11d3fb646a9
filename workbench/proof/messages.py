"""What passes between the process that hands out the work and those that do it."""

from __future__ import annotations

from dataclasses import dataclass

from workbench.proof.verdict import Decision, Stated


@dataclass(frozen=True)
class Listing:
    """What a proof file states."""

    papers: int
    claims: tuple[Stated, ...]
    reads: frozenset[str]


@dataclass(frozen=True)
class Decided:
    """A claim decided, whether that was done now or found in the cache, and what its file has read until then.

    misstated: why there is nothing to decide, as one line that names the file; the decision is then `undecided`.
    lasting: whether it would be decided in the same way again; certified: whether a certificate that lies with the
    paper showed it.
    """

    decision: Decision
    now: bool
    reads: frozenset[str]
    misstated: str | None = None
    lasting: bool = True
    certified: bool = False
