"""What the command line shows of findings: the fates of headline statements, then a paragraph a finding."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from rich.padding import Padding
from rich.text import Text

from workbench.cli.console import out_console
from workbench.cli.terminal import COLOURS, verdict_colour
from workbench.proof.places import section_of_place
from workbench.proof.verdict import Decision, FateWord, verdict_words
from workbench.report.finding import Finding, Gravity, findings
from workbench.report.finding_sentences import (
    HEADINGS,
    condition_sentence,
    consequence_sentence,
    correction_sentence,
    fate_sentence,
    needs_sentence,
    printed_sentence,
    reading_sentence,
    verdict_sentence,
)
from workbench.report.plain_formulas import plain_formula
from workbench.report.worded import show, worded

FATE_COLOURS: dict[FateWord, str] = {"falls": "red", "stands with corrections": "yellow", "open": "yellow",
                                     "stands": "green"}
# What is told in full unless more is asked for; of the others the number.
GRAVE: tuple[Gravity, ...] = ("falls", "corrected", "open", "step", "gap", "alone")


def print_findings(decisions: Sequence[Decision], every: bool = False, verbose: bool = False) -> None:
    """Paper by paper the fates of the headline statements, and the findings by gravity; every: slips and open readings
    too; verbose: each with its printed line and note."""
    found = findings(decisions)
    for paper in dict.fromkeys(d.claim.paper for d in decisions):
        _print_paper(paper, [d for d in decisions if d.claim.paper == paper], [f for f in found if f.paper == paper],
                     every, verbose)


def _print_paper(paper: str, decisions: Sequence[Decision], found: Sequence[Finding], every: bool,
                 verbose: bool) -> None:
    _paragraph(Text(paper, "bold"), 0)
    for word, colour in FATE_COLOURS.items():  # those that fall first
        for d in decisions:
            if d.fate is None or d.fate.word != word:
                continue
            said = worded(fate_sentence(d.claim.equation, word, d.fate.why, d.claim.title))
            _paragraph(Text(show(said, plain_formula), colour), 2)
    left_out: Counter[Gravity] = Counter()
    heading = None
    for f in found:
        if not every and f.gravity not in GRAVE:
            left_out[f.gravity] += 1
            continue
        if f.gravity != heading:
            heading = f.gravity
            _paragraph(Text(HEADINGS[heading], "bold"), 2)
        _paragraph(_finding(f, verbose), 4)
    if left_out:
        words = ", ".join(f"{HEADINGS[g][0].lower()}{HEADINGS[g][1:]}: {n}" for g, n in left_out.items())
        _paragraph(Text(f"{words} (--failed tells them)", "dim"), 2)


def _finding(found: Finding, verbose: bool) -> Text:
    section = section_of_place(found.equation, found.section)
    place = f"({section}) " if section else ""
    parts = [verdict_sentence(found)]
    if verbose or found.fate is None:
        parts.append(printed_sentence(found))
    parts += [correction_sentence(found), needs_sentence(found), condition_sentence(found), reading_sentence(found),
              consequence_sentence(found)]
    if verbose:
        parts.append(worded(found.note))
    text = " ".join(show(part, plain_formula) for part in parts if part)
    return Text.assemble((f"{found.paper}:{found.equation} ", COLOURS[found.verdict]), (place, "dim"), text)


def print_rows(decisions: Sequence[Decision]) -> None:
    """Every row in a line: its id, its verdict, what it is, and what shows it."""
    for d in decisions:
        shown = d.computed or d.method
        verdict = verdict_words(d.verdict, d.proved_under), verdict_colour(d.verdict, d.proved_under)
        _paragraph(Text.assemble(f"{d.claim.id}  ", verdict, f"  {d.claim.title}", (f"  ({shown})", "dim")), 0)


def _paragraph(text: Text, indent: int) -> None:
    """A paragraph, wrapped between words in a terminal, one line where it is read by another program; never cut."""
    if out_console.is_terminal:
        out_console.print(Padding(text, (0, 0, 0, indent)), highlight=False)
    else:
        out_console.print(Text(" " * indent).append_text(text), soft_wrap=True, highlight=False)
