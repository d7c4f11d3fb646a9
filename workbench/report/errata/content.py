"""What the errata of a paper say, as blocks: made from the decisions alone."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

from workbench.proof.checker import goal_digest
from workbench.proof.places import place_of, subject_of
from workbench.proof.verdict import VERDICTS, Decision, FateWord, verdict_words
from workbench.proof.wording import listed
from workbench.report.counterexample import Counterexample
from workbench.report.errata.blocks import Block, Code, Formula, Heading, Item, Items, Paragraph
from workbench.report.errata.proof_steps import proof_steps
from workbench.report.finding import GRAVITIES, Finding, findings
from workbench.report.finding_sentences import (
    HEADINGS,
    consequence_sentence,
    fate_sentence,
    reading_sentence,
    verdict_sentence,
)
from workbench.report.worded import math, worded

MOST_STEPS = 120  # lines of a proof beyond which a reader is sent to the certificate
LONGEST = 900  # characters of a condition beyond which a reader is sent to the certificate
COMMA = r",\ "
CHECKER = "checker.py"
GRAVEST_FIRST: tuple[FateWord, ...] = ("falls", "stands with corrections", "open", "stands")
ABOUT = """Every line was stated as mathematics, as it stands here, and decided by a machine. Each verdict \
below comes with a certificate, a proof or a counterexample in exact arithmetic, that one short program, checker.py, \
re-checks with Python's standard library alone. Numbers in brackets are those of the paper; words in quotation marks \
say which part of a line is meant."""


def errata(decisions: Sequence[Decision], citation: str) -> list[Block]:
    """The errata of one paper: fates, numbered corrections, open readings, mended statements with their proofs, and
    how to re-check all of it. All claims of the paper must be among the decisions, as `judged` leaves them."""
    found = findings(decisions)
    titles = {d.claim.equation: d.claim.title for d in decisions}
    return [Heading(1, "Corrections"), Paragraph(citation, "Paper"), Paragraph(ABOUT), Paragraph(_counts(decisions)),
            *_fates(decisions), *_corrections(found, titles), *_readings(found), *_mended(decisions, titles),
            *_rechecking(decisions)]


def _counts(decisions: Sequence[Decision]) -> str:
    counts = Counter(d.verdict for d in decisions if d.claim.origin != "ours")
    words = listed([f"{counts[v]} {_verb(v, counts[v])}" for v in VERDICTS if counts[v]])
    under = sum(bool(d.proved_under) for d in decisions if d.claim.origin != "ours")
    only = f", {under} of them only where lines hold that are not shown" if under else ""
    return (f"Of {counts.total()} lines, {words}. Proved: true for all values of its domain{only}. Refuted: false as "
            "printed. Violated: a printed condition that the printed numbers break. Gap: it does not follow from what "
            "the paper uses to get there. Assumed: a cited result or a definition, taken as given.")


def _verb(verdict: str, count: int) -> str:
    """A verdict behind the number of its lines, as words of a sentence."""
    verb = "is" if count == 1 else "are"
    what = "a gap" if count == 1 else "gaps"
    return f"{verb} {what}" if verdict == "gap" else f"{verb} {verdict}"


def _fates(decisions: Sequence[Decision]) -> list[Block]:
    """Those that fall first, after how many there are of each."""
    fated = [(d.fate, d.claim) for d in decisions if d.fate is not None]
    told = sorted(fated, key=lambda pair: GRAVEST_FIRST.index(pair[0].word))
    counts = Counter(fate.word for fate, _ in told)
    words = listed([f"{counts[word]} {_verb_of(word, counts[word])}" for word in GRAVEST_FIRST if counts[word]])
    lines = tuple(Item(worded(fate_sentence(claim.equation, fate.word, fate.why, claim.title))) for fate, claim in told)
    summary = [Paragraph(f"Of {len(told)} headline statements, {words}.")] if len(told) > 1 else []
    return [Heading(2, "What becomes of the headline statements"), *summary, Items(lines)] if lines else []


def _verb_of(word: FateWord, count: int) -> str:
    """A fate behind the number of its statements."""
    if word == "open":
        return "is open" if count == 1 else "are open"
    return word if count == 1 else {"falls": "fall", "stands": "stand"}.get(word, word.replace("stands", "stand"))


def _noted(note: str, titles: Mapping[str, str]) -> str:
    """A note with the lines that it names as a reader of the paper calls them: 51.whole is a name of ours alone."""
    names = [name for name in titles if not name.isdigit() and ("." in name or name[-1].isdigit())]
    if not names:
        return worded(note)
    told = re.compile(rf"(?<![\w.])(?:{'|'.join(map(re.escape, sorted(names, key=len, reverse=True)))})(?!\.?\w)")
    return worded(told.sub(lambda found: _in_sentence(place_of(found[0], titles[found[0]])), note))


def _in_sentence(place: str) -> str:
    small = ("Equation", "The ")
    return place[0].lower() + place[1:] if place.startswith(small) else place


def _corrections(found: Sequence[Finding], titles: Mapping[str, str]) -> list[Block]:
    blocks: list[Block] = []
    number = 0
    for gravity in GRAVITIES[:-1]:
        of_it = [f for f in found if f.gravity == gravity]
        if of_it:
            blocks.append(Heading(2, HEADINGS[gravity]))
        for f in of_it:
            number += 1
            blocks += _correction(number, f, titles)
    return blocks or [Paragraph("No line of the paper was found to fail.")]


def _correction(number: int, found: Finding, titles: Mapping[str, str]) -> list[Block]:
    where = f" (section {found.section})" if found.section else ""
    title = subject_of(found.title)
    blocks: list[Block] = [Heading(3, f"{number}. {place_of(found.equation, '')}{where}: {worded(title)}"),
                           Formula(found.printed, "Printed")]
    if found.should_read:
        label = {"violated": "Holds with", "gap": "What does follow"}.get(found.verdict, "Should read")
        blocks.append(Formula(found.should_read, label))
    blocks.append(Paragraph(verdict_sentence(found), "Finding"))
    if found.counterexample is not None:
        blocks += _worked(found.counterexample)
    for label, text in (("Other reading", reading_sentence(found)), ("Consequence", consequence_sentence(found)),
                        ("Note", _noted(found.note, titles))):
        if text:
            blocks.append(Paragraph(text, label))
    if found.digest is not None:
        blocks.append(Code(f"python {CHECKER} certificates/{found.equation}.json --claim-digest {found.digest}"))
    return blocks


def _worked(point: Counterexample) -> list[Block]:
    """The relation, what is assumed there, its numbers put in, and both sides evaluated."""
    if point.motion:
        return [Formula(point.relation, "What fails at all times")]
    if point.left is None or point.right is None:
        return []
    short = point.put_in is not None or len(point.relation) <= LONGEST
    found: list[Block] = [Formula(point.relation, "Decided as")] if short else []
    conditions = [COMMA.join(part) for part in (point.given, point.along) if part]
    at = rf"\quad\text{{where}}\ {COMMA.join(point.beside)}" if point.beside else ""
    if conditions and sum(map(len, conditions)) + len(at) <= LONGEST:
        found.append(Formula(r"\quad\text{along}\ ".join(conditions) + at if point.given else conditions[0] + at,
                             "Given" if point.given else "Along"))
    elif conditions:
        found.append(Paragraph("What else is assumed holds there too; the certificate spells it out."))
    sides, label = [point.left, point.right], "At these numbers"
    if point.put_in is not None:
        label = "Numbers put in"
        sides = [put_in if put_in == value else
                 f"{put_in} {value}" if value.startswith(r"\approx") else f"{put_in} = {value}"
                 for put_in, value in zip(point.put_in, (point.left, point.right), strict=True)]
    return [*found, Formula(rf"\text{{left}}:\ {sides[0]}", label), Formula(rf"\text{{right}}:\ {sides[1]}")]


def _readings(found: Sequence[Finding]) -> list[Block]:
    of_it = [f for f in found if f.gravity == "reading"]
    lines = tuple(Item(f"{worded(f.place)}: {math(f.printed)}. {verdict_sentence(f)} {reading_sentence(f)}")
                  for f in of_it)
    if not lines:
        return []
    intro = ("The text of the paper was extracted by a machine, which may lose a sign, a power or an index. These "
             "lines fail as extracted and hold in another reading; the printed page decides which it is.")
    return [Heading(2, HEADINGS["reading"]), Paragraph(intro), Items(lines)]


def _mended(decisions: Sequence[Decision], titles: Mapping[str, str]) -> list[Block]:
    """The mended headline statements, each with its proof."""
    by_id = {d.claim.id: d for d in decisions}
    headlines = {d.claim.id: d for d in decisions if d.fate is not None}
    blocks: list[Block] = []
    for d in decisions:
        if d.claim.mends not in headlines or d.verdict != "proved" or d.certificate is None:
            continue
        blocks.append(Heading(3, f"{_told(headlines[d.claim.mends])}, mended"))
        blocks.append(Formula(d.claim.printed, "Statement"))
        if d.claim.note:
            blocks.append(Paragraph(_noted(d.claim.note, titles), "Note"))
        used = [f"{_told(by_id[name])} ({verdict_words(by_id[name].verdict, by_id[name].proved_under)})"
                for name in d.claim.premises if name in by_id]
        if used:
            blocks.append(Paragraph(f"{listed(used)}.", "It uses"))
        if d.proved_under:
            under = listed([_told(by_id[name]) for name in d.proved_under])
            blocks.append(Paragraph(f"{under}: what rests on them is proved only where they hold.", "Not shown"))
        if d.goal:
            blocks.append(Formula(d.goal, "Decided as"))
        steps = proof_steps(d.certificate)
        blocks.append(Items(tuple(steps[:MOST_STEPS])))
        if len(steps) > MOST_STEPS:
            blocks.append(Paragraph(f"{len(steps) - MOST_STEPS} more steps stand in the certificate."))
        blocks.append(Code(f"python {CHECKER} certificates/{d.claim.equation}.json --claim-digest "
                           f"{goal_digest(d.certificate)}"))
    return [Heading(2, "The headline statements, mended and proved"), *blocks] if blocks else []


def _told(d: Decision) -> str:
    """The name of a line, its part told by what it says."""
    return worded(place_of(d.claim.equation, d.claim.title))


def _rechecking(decisions: Sequence[Decision]) -> list[Block]:
    paper = decisions[0].claim.paper if decisions else ""
    return [Heading(2, "How to re-check"),
            Paragraph("checker.py is one file that imports Python's standard library alone and knows nothing of the "
                      "programs that found the proofs. With it and the folder of certificates, all of them are "
                      "re-checked by:"),
            Code(f"python {CHECKER} certificates"),
            Paragraph(f"Each command above re-checks one, and that it is for the line named. The workbench writes the "
                      f"certificates by 'workbench prove {paper} --write' and these corrections by 'workbench errata "
                      f"{paper}'.")]
