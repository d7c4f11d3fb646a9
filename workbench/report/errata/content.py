"""What the errata of a paper say, as blocks: made from the decisions alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from workbench.proof.places import section_of_place, subject_of, whole_of
from workbench.proof.verdict import VERDICTS, Decision, FateWord
from workbench.proof.wording import listed
from workbench.report.counterexample import Counterexample
from workbench.report.errata.blocks import Block, Code, Formula, Heading, Item, Items, Paragraph
from workbench.report.errata.conditions import LONGEST, listed_conditions
from workbench.report.errata.mended import CHECKER, mended_statements
from workbench.report.errata.names import legend, noted
from workbench.report.finding import GRAVITIES, Finding, findings
from workbench.report.finding_sentences import (
    HEADINGS,
    condition_sentence,
    consequence_sentence,
    fate_sentence,
    origin_label,
    reading_sentence,
    verdict_sentence,
)
from workbench.report.worded import math, worded

GRAVEST_FIRST: tuple[FateWord, ...] = ("falls", "stands with corrections", "open", "stands")
ABOUT = """Every line was stated as mathematics, as it stands here, and decided by a machine. Each verdict \
below comes with a certificate, a proof or a counterexample in exact arithmetic, that one short program, checker.py, \
re-checks with Python's standard library alone. Numbers in brackets are those of the paper; words in quotation marks \
say which part of a line is meant."""


def errata(decisions: Sequence[Decision], citation: str, letters: Mapping[str, str] | None = None) -> list[Block]:
    """The errata of one paper: fates, numbered corrections, open readings, mended statements with their proofs, and
    how to re-check all of it. All claims of the paper must be among the decisions, as `judged` leaves them; letters:
    what letters that are not the paper's stand for, by their names."""
    found = findings(decisions)
    titles = {d.claim.equation: d.claim.title for d in decisions}
    return [Heading(1, "Corrections"), Paragraph(citation, "Paper"), Paragraph(ABOUT), Paragraph(
                _counts(decisions, sum(f.gravity == "reading" for f in found))),
            *_fates(decisions), *_corrections(found, titles, _legends(decisions, letters or {})),
            *_readings(found), *mended_statements(decisions, titles, letters or {}),
            *_rechecking(decisions)]


def _counts(decisions: Sequence[Decision], readings: int) -> str:
    counts = Counter(d.verdict for d in decisions if d.claim.origin != "ours")
    words = listed([f"{counts[v]} {_verb(v, counts[v])}" for v in VERDICTS if counts[v]])
    under = sum(bool(d.proved_under) for d in decisions if d.claim.origin != "ours")
    only = f", {under} of them only where lines hold that are not shown" if under else ""
    implied = sum(d.claim.origin == "implied" for d in decisions)
    said = f", {implied} of which the text implies and does not print" if implied else ""
    open_ = f" {_open_readings(readings)}" if readings else ""
    return (f"Of {counts.total()} lines{said}, {words}.{open_} Proved: true for all values of its domain{only}. "
            "Refuted: false. Violated: a printed condition that the printed numbers break. Gap: it does not follow "
            "from what the paper uses to get there. Assumed: a cited result or a definition, taken as given.")


def _open_readings(count: int) -> str:
    """How many of the lines that fail are the extracted text's, perhaps, and not the paper's."""
    if count == 1:
        return "Of those that fail, one fails only as its text was extracted and holds in another reading."
    return f"Of those that fail, {count} fail only as their text was extracted and hold in another reading."


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


def _legends(decisions: Sequence[Decision], letters: Mapping[str, str]) -> dict[str, str]:
    """What the letters of each line's goal stand for that are not the paper's, by the line's equation."""
    return {d.claim.equation: legend(d.certificate, letters) for d in decisions if d.certificate}


def _corrections(found: Sequence[Finding], titles: Mapping[str, str], legends: Mapping[str, str]) -> list[Block]:
    blocks: list[Block] = []
    number, told = 0, dict[object, int]()
    for gravity in GRAVITIES[:-1]:
        of_it = [f for f in found if f.gravity == gravity]
        if of_it:
            blocks.append(Heading(2, HEADINGS[gravity]))
        for f in of_it:
            number += 1
            blocks += _correction(number, f, titles, told, legends)
            for shown in () if f.counterexample is None else (f.counterexample, _where(f.counterexample)):
                told.setdefault(shown, number)
    return blocks or [Paragraph("No line of the paper was found to fail.")]


def _correction(number: int, found: Finding, titles: Mapping[str, str], told: Mapping[object, int],
                legends: Mapping[str, str]) -> list[Block]:
    """One finding; told: in which correction before it a counterexample, or what is assumed at one, is written out;
    legends: what letters stand for, by equation."""
    section = section_of_place(found.equation, found.section)
    where = f" ({section})" if section else ""
    title = subject_of(found.title)
    blocks: list[Block] = [Heading(3, f"{number}. {whole_of(found.equation, found.title)}{where}: {worded(title)}"),
                           Formula(found.printed, origin_label(found))]
    if found.should_read:
        label = {"violated": "Holds with", "gap": "What does follow"}.get(found.verdict, "Should read")
        blocks.append(Formula(found.should_read, label))
    if found.mended_under:
        blocks.append(Paragraph(condition_sentence(found), "Not shown"))
    for label, text in (("Read as", noted(found.reading, titles)), ("Finding", verdict_sentence(found)),
                        ("Letters", legends.get(found.equation, "") if found.counterexample else "")):
        if text:
            blocks.append(Paragraph(text, label))
    if found.counterexample is not None:
        before = told.get(found.counterexample)
        blocks += _worked(found.counterexample, told) if before is None else [
            Paragraph(f"The counterexample is that of correction {before}, where it is written out.")]
    for label, text in (("Other reading", reading_sentence(found)), ("Consequence", consequence_sentence(found)),
                        ("Note", noted(found.note, titles))):
        if text:
            blocks.append(Paragraph(text, label))
    if found.digest is not None:
        blocks.append(Code(f"python {CHECKER} certificates/{found.equation}.json --claim-digest {found.digest}"))
    return blocks


def _worked(point: Counterexample, told: Mapping[object, int]) -> list[Block]:
    """The relation, what is assumed there, its numbers put in, and both sides evaluated."""
    if point.motion:
        return [Formula(point.relation, "What fails at all times"), *_conditions(point, told)]
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
        return [Paragraph(f"What is assumed there, and where, is written out in correction {before}.")]
    given = "What holds at all times" if point.motion else "Given"
    return listed_conditions({given: point.given, "Along": point.along}, point.beside)


def _readings(found: Sequence[Finding]) -> list[Block]:
    of_it = [f for f in found if f.gravity == "reading"]
    lines = tuple(Item(f"{worded(f.place)}: {math(f.printed)}. {verdict_sentence(f)} {reading_sentence(f)}")
                  for f in of_it)
    if not lines:
        return []
    intro = ("The text of the paper was extracted by a machine, which may lose a sign, a power or an index. These "
             "lines fail as extracted and hold in another reading; the printed page decides which it is.")
    return [Heading(2, HEADINGS["reading"]), Paragraph(intro), Items(lines)]


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
