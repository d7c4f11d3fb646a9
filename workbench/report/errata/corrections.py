"""The numbered corrections, the gravest first, and the readings that the extracted text leaves open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from workbench.proof.places import section_of_place, subject_of, whole_of
from workbench.proof.verdict import Decision
from workbench.report.counterexample import Counterexample
from workbench.report.errata.blocks import Block, Code, Formula, Heading, Paragraph
from workbench.report.errata.chain import consequence, resting_lines
from workbench.report.errata.conditions import LONGEST, listed_conditions
from workbench.report.errata.letters import Letters, letters_of
from workbench.report.errata.mended import CHECKER
from workbench.report.errata.names import noted
from workbench.report.finding import GRAVITIES, Finding
from workbench.report.finding_sentences import (
    HEADINGS,
    IMPLIED,
    condition_sentence,
    reading_sentence,
    verdict_sentence,
)
from workbench.report.worded import worded

READINGS = ("The text of the paper was extracted by a machine, which may lose a sign, a power or an index. These lines "
            "fail as extracted and hold in another reading; the printed page decides which it is.")


@dataclass(frozen=True)
class _Paper:
    """What all corrections of a paper are told with, by equation: what its lines say, and say in their other readings,
    the letters of their goals, what rests on them, their numbers; what stands in front of a line that the paper prints,
    and in which correction a counterexample, or what is assumed at one, is written out."""

    titles: Mapping[str, str]
    readings: Mapping[str, str]
    letters: Mapping[str, Letters]
    resting: Mapping[str, Sequence[str]]
    numbers: Mapping[str, int]
    printed: str
    told: dict[object, int] = field(default_factory=dict)


def correction_numbers(found: Sequence[Finding]) -> dict[str, int]:
    """The number of each correction, by the equation of its line; readings have none."""
    told = [f for gravity in GRAVITIES[:-1] for f in found if f.gravity == gravity]
    return {f.equation: number for number, f in enumerate(told, 1)}


def corrections_of(found: Sequence[Finding], decisions: Sequence[Decision],
                   letters: Mapping[str, str], printed: str) -> list[Block]:
    """All corrections below the headings of their kinds, then the open readings; letters: what letters that are not the
    paper's stand for, by their names; printed: what stands in front of a line that is not only implied."""
    titles = {d.claim.id: d.claim.title for d in decisions}
    paper = _Paper({d.claim.equation: d.claim.title for d in decisions},
                   {d.claim.equation: titles.get(d.claim.glyph or "", "") for d in decisions},
                   {d.claim.equation: letters_of(d.certificate, letters) for d in decisions},
                   resting_lines(decisions), correction_numbers(found), printed)
    blocks: list[Block] = []
    for gravity in GRAVITIES:
        of_it = [f for f in found if f.gravity == gravity]
        if of_it:
            blocks += [Heading(2, HEADINGS[gravity]), *([Paragraph(READINGS)] if gravity == "reading" else [])]
        for f in of_it:
            blocks += _reading(f, paper) if gravity == "reading" else _correction(f, paper)
    return blocks or [Paragraph("No line of the paper was found to fail.")]


def _correction(found: Finding, paper: _Paper) -> list[Block]:
    number = paper.numbers[found.equation]
    blocks: list[Block] = [Heading(3, f"{number}. {_heading(found)}"),
                           Formula(found.printed, paper.printed if found.origin == "printed" else IMPLIED)]
    if found.should_read:
        label = {"violated": "Holds with", "gap": "What does follow"}.get(found.verdict, "Should read")
        blocks.append(Formula(found.should_read, label))
    if found.mended_under:
        blocks.append(Paragraph(condition_sentence(found), "Not shown"))
    blocks += [*_labelled(("Read as", noted(found.reading, paper.titles))), *_found(found, paper)]
    blocks += _labelled(
        ("Other reading", reading_sentence(found)),
        ("Consequence", consequence(found, paper.numbers, paper.resting.get(found.equation, ()), paper.titles)),
        ("Note", noted(found.note, paper.titles)))
    for shown in () if found.counterexample is None else (found.counterexample, _where(found.counterexample)):
        paper.told.setdefault(shown, number)
    return [*blocks, *_command(found)]


def _reading(found: Finding, paper: _Paper) -> list[Block]:
    """A line that fails as it was extracted and holds in another reading."""
    other: Block = Formula(found.other_reading, "Holds when it is read as")
    if found.other_reading == found.printed:  # it is another line that is read otherwise
        other = Paragraph(f"It holds with another line read otherwise: “{worded(paper.readings[found.equation])}”.",
                          "Other reading")
    return [Heading(3, _heading(found)), Formula(found.printed, "As extracted"), other, *_found(found, paper),
            *_labelled(("Note", noted(found.note, paper.titles))), *_command(found)]


def _heading(found: Finding) -> str:
    """Where a line stands and what it says."""
    section = section_of_place(found.equation, found.section)
    where = f" ({section})" if section else ""
    whole, title = whole_of(found.equation, found.title), subject_of(found.title)
    return f"{whole}{where}" + (f": {worded(title)}" if title != whole else "")


def _labelled(*texts: tuple[str, str]) -> list[Block]:
    return [Paragraph(text, label) for label, text in texts if text]


def _command(found: Finding) -> list[Block]:
    return [] if found.digest is None else [
        Code(f"python {CHECKER} certificates/{found.equation}.json --claim-digest {found.digest}")]


def _found(found: Finding, paper: _Paper) -> list[Block]:
    """What is wrong, what letters are, and the counterexample, unless a correction above has written it out."""
    own = paper.letters[found.equation]
    finding = Paragraph(verdict_sentence(found), "Finding")
    worked: list[Block] = []
    if found.counterexample is not None and found.counterexample not in paper.told:
        worked = _worked(found.counterexample, paper.told)
    legend = own.legend([finding, *worked]) if worked else ""
    blocks = [*own.in_blocks([finding]), *_labelled(("Letters", legend)), *own.in_blocks(worked)]
    if found.counterexample in paper.told and found.counterexample is not None:
        blocks.append(Paragraph(f"The counterexample is that of correction {paper.told[found.counterexample]}, where "
                                "it is written out."))
    return blocks


def _worked(point: Counterexample, told: Mapping[object, int]) -> list[Block]:
    """The relation, what is assumed there, its numbers put in, and both sides evaluated."""
    if point.motion:
        return [Formula(point.relation, "What fails throughout"), *_conditions(point, told)]
    if point.left is None or point.right is None:
        return []
    short = point.put_in is not None or len(point.relation) <= LONGEST
    found: list[Block] = [Formula(point.relation, "Decided as")] if short else []
    found += _conditions(point, told)
    sides, label = [point.left, point.right], "At these numbers"
    if point.put_in is not None:
        label = "Numbers put in"
        sides = [put_in if put_in == value else
                 f"{put_in} {value}" if value.startswith(r"\approx") else f"{put_in} = {value}"
                 for put_in, value in zip(point.put_in, (point.left, point.right), strict=True)]
    return [*found, Formula(rf"\text{{left}}:\ {sides[0]}", label), Formula(rf"\text{{right}}:\ {sides[1]}")]


def _where(point: Counterexample) -> tuple[object, ...]:
    """What is assumed at a point or along a motion, and its numbers."""
    return point.given, point.along, point.everything


def _conditions(point: Counterexample, told: Mapping[object, int]) -> list[Block]:
    """What is assumed at a point or along a motion, and the values of the letters that stand in it alone: in one
    formula where it is short, each condition on a line of its own where it is not."""
    if (point.given or point.along) and (before := told.get(_where(point))):
        return [Paragraph(f"What is assumed, and all numbers, are those of correction {before}.")]
    given = "What holds throughout" if point.motion else "Given"
    return listed_conditions({given: point.given, "Along": point.along}, point.beside)
