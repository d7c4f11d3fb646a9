"""What an editor reads first: the causes with their corrections, what falls with them, and what fails besides."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.proof.places import places_of
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Heading, Item, Items, Paragraph
from workbench.report.errata.causes import Cause
from workbench.report.errata.chain import consequence, corrections
from workbench.report.errata.context import Context, corrected, heading_of, labelled, line_of
from workbench.report.errata.letters import legend
from workbench.report.errata.names import noted
from workbench.report.finding import Finding
from workbench.report.finding_sentences import verdict_sentence
from workbench.report.worded import worded

FALLING = "With the numbers of their corrections; a gap does not follow from what the paper uses, the others are false."


def in_short(found: Sequence[Finding], context: Context) -> list[Block]:
    """Each cause in full but for its evidence; a line for each other one that has a number and no fate, which stands
    among the headline statements. Empty where no line falls with another one: there the corrections themselves are
    short."""
    if not context.causes:
        return []
    first = {f.equation for cause in context.causes for f in cause}
    others = [f for f in found if f.equation in context.numbers and f.equation not in first and f.fate is None]
    falling, alone = [f for f in others if f.because], [f for f in others if not f.because]
    falls = sum(bool(f.because) for f in found if f.equation in context.numbers)
    blocks: list[Block] = [Heading(2, "The causes"), Paragraph(_how_many(len(context.causes), len(first), falls)),
                           *([Items(tuple(_at_a_glance(cause, context) for cause in context.causes))]
                             if len(context.causes) > 1 else [])]
    for cause in context.causes:
        blocks += _told(cause, context)
    if falling:
        blocks += [Heading(2, "Lines that fall with them"), Paragraph(FALLING), Items(_falling(falling, context))]
    if alone:
        blocks += [Heading(2, "Lines that fail by themselves"),
                   Items(tuple(Item(f"{context.numbers[f.equation]}. {verdict_sentence(f)}") for f in alone))]
    return blocks


def falls_by(found: Finding, context: Context) -> str:
    """By which corrections a line falls, and by which lines that hold in another reading."""
    roots = corrections(found.roots, context.numbers)
    read = [equation for equation in found.roots if equation not in context.numbers]
    extracted = f"what fails as extracted, {worded(listed(places_of(read)))}" if read else ""
    return f"by {', and by '.join(filter(None, (roots, extracted)))}" if found.roots else ""


def _falling(falling: Sequence[Finding], context: Context) -> tuple[Item, ...]:
    """An item for all that fall by the same lines."""
    groups: dict[str, list[str]] = {}
    for f in sorted(falling, key=lambda one: context.numbers[one.equation]):
        gap = " (gap)" if f.verdict == "gap" else ""
        groups.setdefault(falls_by(f, context), []).append(f"{worded(f.place)}, {context.numbers[f.equation]}{gap}")
    return tuple(Item(f"{by[:1].upper()}{by[1:]}: {'; '.join(named)}.") for by, named in groups.items())


def _how_many(causes: int, lines: int, falls: int) -> str:
    these = ("One line fails and rests on no other line that does" if lines == 1 else
             f"{lines} lines fail and rest on no other line that does")
    kinds = f", {causes} different ones but for their letters" if causes < lines else ""
    them = "it" if lines == 1 else "them"
    fall = f"one more line falls with {them}" if falls == 1 else f"{falls} more lines fall with {them}"
    return f"{these}{kinds}; {fall}. What shows it all follows behind, by the numbers of the corrections."


def _at_a_glance(cause: Cause, context: Context) -> Item:
    """A cause in a line: what it is, and how much rests on it."""
    found = cause[0]
    with_it = corrections([f.equation for f in cause], context.numbers)
    headlines, lines = (f"{n} {word}{'s' * (n > 1)}" if n else "" for n, word in (
        (len(found.headlines), "headline statement"), (found.lines, "other line" if found.headlines else "line")))
    rest = "rests" if len(found.headlines) + found.lines == 1 else "rest"
    verdict = {"gap": "does not follow", "violated": "is broken by the printed numbers"}.get(found.verdict, "is false")
    return Item(f"{with_it[:1].upper()}{with_it[1:]}: {worded(found.place)} {verdict}; "
                f"{' and '.join(filter(None, (headlines, lines)))} {rest} on it.")


def _told(cause: Cause, context: Context) -> list[Block]:
    """A cause, and the lines that say the same in other letters."""
    found, *alike = cause
    finding = Paragraph(verdict_sentence(found), "Finding")
    resting = context.resting.get(found.equation, ())
    blocks = [Heading(3, f"{context.numbers[found.equation]}. {heading_of(found)}"), line_of(found, context),
              *corrected(found), finding, *labelled(
                  ("Letters", legend([finding], context.letters[found.equation])),
                  ("Consequence", consequence(found, context.numbers, resting, context.titles)),
                  ("Note", noted(found.note, context.titles)))]
    for other in alike:
        blocks += [Paragraph(f"{worded(other.place)} says the same in other letters and fails alike (correction "
                             f"{context.numbers[other.equation]}).", "Likewise"), line_of(other, context)]
    return blocks
