"""What the errata of a paper say, as blocks: made from the decisions alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from workbench.files.numbers import counted
from workbench.proof.verdict import FAILED, VERDICTS, Decision, Fate, FateWord
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Heading, Item, Items, Paragraph
from workbench.report.errata.context import Context, context_of
from workbench.report.errata.corrections import evidence
from workbench.report.errata.in_short import causes_told, in_short
from workbench.report.errata.letters import with_dots
from workbench.report.errata.mended import mended_statements
from workbench.report.errata.rechecking import rechecking
from workbench.report.errata.referred import lines_referred_to, referred_to
from workbench.report.errata.what_holds import what_holds
from workbench.report.finding import Finding, findings
from workbench.report.finding_sentences import PRINTED, fate_sentence
from workbench.report.worded import worded

COMMON = "As commonly stated"
NOT_AT_HAND = """The paper's own text was not at hand: its lines stand as the result is commonly stated, and nothing \
here is charged to the paper itself."""
GRAVEST_FIRST: tuple[FateWord, ...] = ("falls", "stands with corrections", "open", "stands")
ABOUT = """Every line was stated as mathematics, as it stands here, and decided by a machine. Each verdict \
below but “assumed” comes with a certificate, a proof or a counterexample in exact arithmetic, that one short program, \
checker.py, re-checks with Python's standard library alone. Numbers in brackets are those of the paper; words in \
quotation marks say which part of a line is meant."""


def errata(decisions: Sequence[Decision], citation: str, at_hand: bool = True) -> list[Block]:
    """The errata of one paper: fates, causes, what rests on them, what holds, the evidence of each numbered correction,
    open readings, mended statements with their proofs, the lines that these name, and how to re-check all of it.

    All claims of the paper must be among the decisions, as `judged` leaves them; at_hand: whether the lines stand as
    the paper's own text has them.
    """
    found = findings(decisions)
    titles = {d.claim.equation: d.claim.title for d in decisions}
    context = context_of(found, decisions, PRINTED if at_hand else COMMON)
    mended, proofs = mended_statements(decisions, titles)
    referred = referred_to(decisions, found, proofs)
    failing = any(f.verdict in FAILED for f in found)
    blocks = [Heading(1, "Corrections" if failing else "Corrections: none"), Paragraph(citation, "Paper"),
            Paragraph(ABOUT if at_hand else f"{ABOUT} {NOT_AT_HAND}"),
            Paragraph(_counts(decisions, [f.equation for f in found if f.gravity == "reading"], at_hand)),
            *_fates(decisions, found, context), *in_short(found, context), *what_holds(decisions, context.numbers),
            *evidence(found, context), *mended, *lines_referred_to(referred, bool(mended)),
            *rechecking(decisions, found, proofs, referred, context.numbers)]
    return with_dots(blocks)


def _counts(decisions: Sequence[Decision], readings: Sequence[str], at_hand: bool) -> str:
    own = [d for d in decisions if d.claim.origin != "ours"]
    counts = Counter(d.verdict for d in own if d.claim.equation not in readings)
    words = listed([f"{counts[v]} {_verb(v, counts[v])}" for v in VERDICTS if counts[v]])
    under = sum(bool(d.proved_under) for d in own)
    only = f", {under} of them only where lines hold that are not shown" if under else ""
    implied = sum(d.claim.origin == "implied" for d in own)
    implies = "the text implies and does not print" if at_hand else "the others imply"
    said = f", {implied} of which {implies}" if implied else ""
    meant = {"proved": f"true for all values of its domain{only}", "refuted": "false, or assumed and not met",
             "violated": "a condition that does not hold at the printed numbers",
             "gap": "it does not follow from what the text uses to get there", "undecided": "not decided",
             "assumed": "a cited result or a definition, taken as given"}
    told = " ".join(f"{verdict.capitalize()}: {meant[verdict]}." for verdict in VERDICTS if counts[verdict])
    return f"Of {counted(len(own), 'line')}{said}, {words}{_open_readings(len(readings))}. {told}"


def _open_readings(count: int) -> str:
    """How many of the lines that fail are the extracted text's, perhaps, and not the paper's."""
    if not count:
        return ""
    return (f"; {'one more fails' if count == 1 else f'{count} more fail'} only as extracted from the page and "
            f"hold{'s' if count == 1 else ''} in another reading, so that the paper is not charged with "
            f"{'it' if count == 1 else 'them'}")


def _verb(verdict: str, count: int) -> str:
    """A verdict behind the number of its lines, as words of a sentence."""
    verb = "is" if count == 1 else "are"
    what = "a gap" if count == 1 else "gaps"
    return f"{verb} {what}" if verdict == "gap" else f"{verb} {verdict}"


def _fates(decisions: Sequence[Decision], found: Sequence[Finding], context: Context) -> list[Block]:
    """Those that fall first, after how many there are of each, with their corrections and what these rest on."""
    told_of = {f.equation: f for f in found}
    fated = [(d.fate, d.claim) for d in decisions if d.fate is not None]
    told = sorted(fated, key=lambda pair: GRAVEST_FIRST.index(pair[0].word))
    counts = Counter(fate.word for fate, _ in told)
    words = listed([f"{counts[word]} {_verb_of(word, counts[word])}" for word in GRAVEST_FIRST if counts[word]])
    lines = tuple(Item(worded(fate_sentence(claim.equation, fate.word, fate.why, claim.title))
                       + _see(told_of.get(claim.equation), fate, context)) for fate, claim in told)
    summary = [Paragraph(f"Of {len(told)} headline statements, {words}.")] if len(told) > 1 else []
    return [Heading(2, "What becomes of the headline statements"), *summary, Items(lines)] if lines else []


def _see(found: Finding | None, fate: Fate, context: Context) -> str:
    """Where more is said of a statement; what was only not checked has no correction to see."""
    number = None if found is None else context.numbers.get(found.equation)
    if found is None or number is None or (fate.word == "open" and found.verdict not in FAILED):
        return ""
    way = causes_told(found, context)
    return f" See correction {number}{f'; {way}' if way else ''}."


def _verb_of(word: FateWord, count: int) -> str:
    """A fate behind the number of its statements."""
    if word == "open":
        return "is open" if count == 1 else "are open"
    return word if count == 1 else {"falls": "fall", "stands": "stand"}.get(word, word.replace("stands", "stand"))
