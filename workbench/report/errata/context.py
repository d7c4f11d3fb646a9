"""What all corrections of a paper are told with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from workbench.proof.places import section_of_place, subject_of, whole_of
from workbench.proof.verdict import Decision
from workbench.report.errata.blocks import Block, Formula, Paragraph
from workbench.report.errata.causes import Cause, causes_of, correction_numbers
from workbench.report.errata.chain import resting_lines
from workbench.report.errata.hypotheses import needed
from workbench.report.finding import Finding
from workbench.report.finding_sentences import IMPLIED, condition_sentence
from workbench.report.letters import Letters, letters_of
from workbench.report.worded import worded


@dataclass(frozen=True)
class Context:
    """What all corrections of a paper are told with, by equation: what its lines say, and say in their other readings,
    the letters of their goals, what rests on them, their numbers; its causes; what stands in front of a line that the
    paper prints, and in which correction a counterexample, or what is assumed at one, is written out."""

    titles: Mapping[str, str]
    readings: Mapping[str, str]
    letters: Mapping[str, Letters]
    resting: Mapping[str, Sequence[str]]
    causes: Sequence[Cause]
    numbers: Mapping[str, int]
    printed: str
    told: dict[object, int] = field(default_factory=dict)


def context_of(found: Sequence[Finding], decisions: Sequence[Decision], printed: str) -> Context:
    """The context of a paper's findings; printed: what stands in front of a line that is not only implied."""
    titles = {d.claim.id: d.claim.title for d in decisions}
    causes = causes_of(found, decisions)
    return Context({d.claim.equation: d.claim.title for d in decisions},
                   {d.claim.equation: titles.get(d.claim.glyph or "", "") for d in decisions},
                   {d.claim.equation: letters_of(d) for d in decisions},
                   resting_lines(decisions, found), causes, correction_numbers(found, causes), printed)


def heading_of(found: Finding) -> str:
    """Where a line stands and what it says."""
    section = section_of_place(found.equation, found.section)
    where = f" ({section})" if section else ""
    whole, title = whole_of(found.equation, found.title), subject_of(found.title)
    return f"{whole}{where}" + (f": {worded(title)}" if title != whole else "")


def line_of(found: Finding, context: Context) -> Formula:
    """The line as it stands."""
    return Formula(found.printed, context.printed if found.origin == "printed" else IMPLIED)


READ_AS = "How it is read"


def corrected(found: Finding) -> list[Block]:
    """What it should read, for what that is proved, and what of that is not shown; nothing where no true statement is
    known."""
    if not found.should_read:
        return []
    label = {"violated": "Holds with", "gap": "What does follow", "proved": "Beside it is proved"}.get(
        found.verdict, "Should read")
    under = condition_sentence(found)
    return [Formula(found.should_read, label), *needed(found.needs),
            *([Paragraph(under, "Not shown")] if under else [])]


def labelled(*texts: tuple[str, str]) -> list[Block]:
    """Paragraphs of a label and a text each; without those that have no text."""
    return [Paragraph(text, label) for label, text in texts if text]
