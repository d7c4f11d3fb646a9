"""What an editor reads first: the causes with their corrections, what falls with them, and what fails besides."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.report.errata.blocks import Block, Heading, Item, Items, Paragraph
from workbench.report.errata.causes import Cause
from workbench.report.errata.chain import consequence, corrections
from workbench.report.errata.context import READ_AS, Context, corrected, heading_of, labelled, line_of
from workbench.report.errata.letters import legend
from workbench.report.errata.names import noted
from workbench.report.finding import Finding
from workbench.report.finding_sentences import short_verdict, verdict_sentence
from workbench.report.worded import worded

RESTING = ("With the numbers of their corrections. A gap does not follow from what the text uses, the others are "
           "false; that they would stand without the causes is not said.")


def in_short(found: Sequence[Finding], context: Context) -> list[Block]:
    """Each cause in full but for its evidence; a line for each other one that has a number and no fate, which stands
    among the headline statements. Empty where no line rests on another one that fails: there the corrections themselves
    are short."""
    if not context.causes:
        return []
    first = {f.equation for cause in context.causes for f in cause}
    others = [f for f in found if f.equation in context.numbers and f.equation not in first and f.fate is None]
    resting, alone = [f for f in others if f.causes], [f for f in others if not f.causes]
    rest = [f for f in found if f.equation in context.numbers and f.equation not in first and f.causes]
    blocks: list[Block] = [Heading(2, "The causes"), Paragraph(_how_many(len(context.causes), len(first), rest)),
                           *([Items(tuple(_at_a_glance(cause, context) for cause in context.causes))]
                             if len(context.causes) > 1 else [])]
    for cause in context.causes:
        blocks += _told(cause, context)
    if resting:
        blocks += [Heading(2, "Lines that fail and rest on them"), Paragraph(RESTING),
                   Items(_resting(resting, context))]
    if alone:
        blocks += [Heading(2, "Other lines that fail"),
                   Items(tuple(Item(f"{context.numbers[f.equation]}. {short_verdict(f)}.") for f in alone))]
    return blocks


def causes_told(found: Finding, context: Context) -> str:
    """On which corrections a headline statement rests in the text; empty where on none."""
    causes = corrections(found.causes, context.numbers)
    return f"in the text it rests on {causes}" if causes else ""


def _resting(resting: Sequence[Finding], context: Context) -> tuple[Item, ...]:
    """An item for all that rest on the same causes."""
    groups: dict[str, list[str]] = {}
    for f in sorted(resting, key=lambda one: context.numbers[one.equation]):
        gap = " (gap)" if f.verdict == "gap" else ""
        on = corrections(f.causes, context.numbers)
        groups.setdefault(on, []).append(f"{worded(f.place)}, {context.numbers[f.equation]}{gap}")
    return tuple(Item(f"On {on}: {'; '.join(named)}.") for on, named in groups.items())


def _how_many(causes: int, lines: int, rest: Sequence[Finding]) -> str:
    these = ("One line fails by itself, and others rest on it" if lines == 1 else
             f"{lines} lines fail by themselves, and others rest on them")
    kinds = f"; but for their letters they are {causes} different ones" if causes < lines else ""
    holding = sum(f.verdict == "proved" for f in rest)
    failing, through = len(rest) - holding, "it" if lines == 1 else "one of them"
    more = {0: "", 1: f" One more line fails and rests on {through}."}.get(
        failing, f" {failing} more lines fail and rest on {through if lines == 1 else 'them'}.")
    passes = {0: "", 1: f" One headline statement holds, but the text's way to it passes through {through}."}.get(
        holding, f" {holding} headline statements hold, but the text's way to them passes through {through}.")
    return f"{these}{kinds}.{more}{passes} What shows it all follows behind, by the numbers of the corrections."


def _at_a_glance(cause: Cause, context: Context) -> Item:
    """A cause in a line: what it is, and how much rests on it."""
    found = cause[0]
    with_it = corrections([f.equation for f in cause], context.numbers)
    headlines, lines = (f"{n} {word}{'s' * (n > 1)}" if n else "" for n, word in (
        (len(found.headlines), "headline statement"), (found.lines, "other line" if found.headlines else "line")))
    rest = "rests" if len(found.headlines) + found.lines == 1 else "rest"
    return Item(f"{with_it[:1].upper()}{with_it[1:]}: {short_verdict(found)}; "
                f"{' and '.join(filter(None, (headlines, lines)))} {rest} on it.")


def _told(cause: Cause, context: Context) -> list[Block]:
    """A cause, and the lines that say the same in other letters."""
    found, *alike = cause
    finding = Paragraph(verdict_sentence(found), "Finding")
    resting = context.resting.get(found.equation, ())
    blocks = [Heading(3, f"{context.numbers[found.equation]}. {heading_of(found)}"), line_of(found, context),
              *labelled((READ_AS, noted(found.reading, context.titles))), *corrected(found), finding, *labelled(
                  ("Letters", legend([finding], context.letters[found.equation], found.needs)),
                  ("Consequence", consequence(found, context.numbers, resting, context.titles)),
                  ("Note", noted(found.note, context.titles)))]
    for other in alike:
        blocks += [Paragraph(f"{worded(other.place)} says the same in other letters and fails alike (correction "
                             f"{context.numbers[other.equation]}).", "Likewise"), line_of(other, context)]
    return blocks
