"""The evidence of the numbered corrections, and the readings that the extracted text leaves open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from workbench.report.counterexample import Counterexample
from workbench.report.errata.blocks import Block, Formula, Heading, Paragraph
from workbench.report.errata.chain import consequence
from workbench.report.errata.conditions import ALONG, LONGEST, STATEMENT_CHECKED, UNDER, listed_conditions
from workbench.report.errata.context import READ_AS, Context, corrected, heading_of, labelled, line_of
from workbench.report.errata.letters import legend
from workbench.report.errata.names import noted
from workbench.report.finding import GRAVITIES, Finding, Gravity
from workbench.report.finding_sentences import HEADINGS, reading_sentence, verdict_sentence
from workbench.report.worded import worded

READINGS = ("The text of the paper was extracted by a machine, which may lose a sign, a power or an index. These lines "
            "fail as extracted and hold in another reading; the printed page decides which it is.")


def evidence(found: Sequence[Finding], context: Context) -> list[Block]:
    """All corrections in the order of their numbers, below the headings of their kinds, then the open readings. Of a
    cause that is told in full before, only what shows it."""
    causes = [f for cause in context.causes for f in cause]
    leading = [cause[0] for cause in context.causes]
    blocks: list[Block] = [Heading(2, "Evidence: the causes")] if causes else []
    for f in causes:
        blocks += _evidence_alone(f, context) if f in leading else _correction(f, context)
    for gravity in GRAVITIES:
        of_it = [f for f in found if f.gravity == gravity and f not in causes]
        if of_it:
            blocks += [Heading(2, _kind(gravity, bool(causes))),
                       *([Paragraph(READINGS)] if gravity == "reading" else [])]
        for f in of_it:
            blocks += _reading(f, context) if gravity == "reading" else _correction(f, context)
    return blocks or [Paragraph("No line of the paper was found to fail.")]


def _kind(gravity: Gravity, after_causes: bool) -> str:
    words = HEADINGS[gravity]
    return f"Evidence: {words[0].lower()}{words[1:]}" if after_causes and gravity != "reading" else words


def _evidence_alone(found: Finding, context: Context) -> list[Block]:
    """What shows a cause: its line and its correction stand before."""
    blocks = [Heading(3, f"{context.numbers[found.equation]}. {heading_of(found)}"),
              *labelled((READ_AS, noted(found.reading, context.titles))), *_found(found, context, False),
              *labelled(("Other reading", reading_sentence(found)))]
    _remember(found, context)
    return blocks


def _correction(found: Finding, context: Context) -> list[Block]:
    blocks = [Heading(3, f"{context.numbers[found.equation]}. {heading_of(found)}"), line_of(found, context),
              *corrected(found), *labelled((READ_AS, noted(found.reading, context.titles))),
              *_found(found, context, True),
              *labelled(("Other reading", reading_sentence(found)),
                        ("Consequence", consequence(found, context.numbers, context.resting.get(found.equation, ()),
                                                    context.titles)),
                        ("Note", noted(found.note, context.titles)))]
    _remember(found, context)
    return blocks


def _remember(found: Finding, context: Context) -> None:
    """Where a counterexample, and what is assumed at it, is written out."""
    for shown in () if found.counterexample is None else (found.counterexample, _where(found.counterexample)):
        context.told.setdefault(shown, context.numbers[found.equation])


def _reading(found: Finding, context: Context) -> list[Block]:
    """A line that fails as it was extracted and holds in another reading."""
    other: Block = Formula(found.other_reading, "Holds when it is read as")
    if found.other_reading == found.printed:  # it is another line that is read otherwise
        other = Paragraph(f"It holds with another line read otherwise: “{worded(context.readings[found.equation])}”.",
                          "Other reading")
    return [Heading(3, heading_of(found)), Formula(found.printed, "As extracted"), other,
            *labelled((READ_AS, noted(found.reading, context.titles))), *_found(found, context, True),
            *labelled(("Note", noted(found.note, context.titles)))]


def _found(found: Finding, context: Context, told: bool) -> list[Block]:
    """What is wrong, if that is to be told here, what letters are, and the counterexample, unless a correction above
    has written it out."""
    before = context.told.get(found.counterexample)
    finding: list[Block] = [Paragraph(verdict_sentence(found), "Finding")] if told else []
    worked: list[Block] = []
    if found.counterexample is not None and before is None:
        worked = _worked(found.counterexample, context.told)
    before_it = found.needs if told else ()
    told_of = legend([*finding, *worked], context.letters[found.equation], before_it) if worked else ""
    blocks = [*finding, *labelled(("Letters", told_of)), *worked]
    if found.counterexample is not None and before is not None:
        blocks.append(Paragraph(f"The counterexample is that of correction {before}, where it is written out."))
    return blocks


def _worked(point: Counterexample, told: Mapping[object, int]) -> list[Block]:
    """The relation, what is assumed there, its numbers put in, and both sides evaluated."""
    if point.motion:
        return [Formula(point.relation, "What fails at all times"), *_conditions(point, told)]
    if point.left is None or point.right is None:
        return []
    short = point.put_in is not None or len(point.relation) <= LONGEST
    found: list[Block] = [Formula(point.relation, STATEMENT_CHECKED)] if short else []
    found += _conditions(point, told)
    sides, label = [point.left, point.right], "At these values"
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
    given = "What holds at all times" if point.motion else UNDER
    return listed_conditions({given: point.given, ALONG: point.along}, point.beside)
