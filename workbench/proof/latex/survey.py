"""Which printed lines of papers were parsed and equal their goals."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from workbench.errors import ClaimError
from workbench.proof.building import built
from workbench.proof.claim import Claim
from workbench.proof.latex.match import Match, match
from workbench.proof.paper import Paper, collect_papers


@dataclass(frozen=True)
class Survey:
    """A paper's claims, each with the match of its line."""

    paper: str
    rows: tuple[tuple[Claim, Match], ...]

    @property
    def formulas(self) -> list[Match]:
        """The matches of the printed rows that are formulas throughout."""
        return [found for claim, found in self.rows if claim.origin == "printed" and not found.words]

    def text(self) -> str:
        """One line a claim, and the share of printed formulas that are parsed."""
        lines = [f"{claim.id}  {'parsed' if found.parsed else 'words' if found.words else 'not parsed'}"
                 f"{'' if claim.origin == 'printed' else f' ({claim.origin})'}: {found.why}"
                 for claim, found in self.rows]
        parsed = sum(found.parsed for found in self.formulas)
        share = f" ({100 * parsed // len(self.formulas)} %)" if self.formulas else ""
        return "\n".join([*lines, f"{self.paper}: {parsed} of {len(self.formulas)} printed formulas parsed{share}, "
                                  f"{sum(found.words for _, found in self.rows)} lines are words"])


def survey(paths: list[Path]) -> Iterator[Survey]:
    """The papers of some folders, one after the other; raises InputError where there is none."""
    for paper in collect_papers(paths):
        yield _of(paper)


def _of(paper: Paper) -> Survey:
    return Survey(paper.name, tuple((claim, matched(claim)) for claim in paper.claims))


def matched(claim: Claim) -> Match:
    """The match of a claim's line with its goal; a cited result has no goal."""
    if claim.build is None:
        return Match(False, "a cited result is decided by no goal", words=True)
    try:
        return match(claim.printed, claim.notation, built(claim, claim.build))
    except ClaimError as trouble:
        return Match(False, str(trouble))
