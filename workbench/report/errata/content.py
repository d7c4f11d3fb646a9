"""What the errata of a paper say, as blocks: made from the decisions alone."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from workbench.proof.checker import goal_digest
from workbench.proof.places import place_of, subject_of
from workbench.proof.verdict import VERDICTS, Decision, FateWord, verdict_words
from workbench.proof.wording import listed
from workbench.report.certificate_latex import expression_latex, name_latex, rate_latex, relation_latex
from workbench.report.counterexample import Counterexample
from workbench.report.errata.blocks import Block, Code, Formula, Heading, Item, Items, Paragraph
from workbench.report.errata.proof_steps import proof_steps
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

MOST_STEPS = 120  # lines of a proof beyond which a reader is sent to the certificate
LONGEST = 900  # characters of a formula beyond which its parts stand below each other
LINE = 150  # characters of LaTeX up to which short formulas share a line
MOST_GIVEN = 6000  # characters of all conditions beyond which a reader is sent to the certificate
COMMA = r",\ "
_NAME = re.compile(r"[A-Za-z_]\w*")
CHECKER = "checker.py"
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
    return [Heading(1, "Corrections"), Paragraph(citation, "Paper"), Paragraph(ABOUT), Paragraph(_counts(decisions)),
            *_fates(decisions), *_corrections(found, titles, _legends(decisions, letters or {})),
            *_readings(found), *_mended(decisions, titles, letters or {}),
            *_rechecking(decisions)]


def _counts(decisions: Sequence[Decision]) -> str:
    counts = Counter(d.verdict for d in decisions if d.claim.origin != "ours")
    words = listed([f"{counts[v]} {_verb(v, counts[v])}" for v in VERDICTS if counts[v]])
    under = sum(bool(d.proved_under) for d in decisions if d.claim.origin != "ours")
    only = f", {under} of them only where lines hold that are not shown" if under else ""
    implied = sum(d.claim.origin == "implied" for d in decisions)
    said = f", {implied} of which the text implies and does not print" if implied else ""
    return (f"Of {counts.total()} lines{said}, {words}. Proved: true for all values of its domain{only}. Refuted: "
            "false. Violated: a printed condition that the printed numbers break. Gap: it does not follow from what "
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


def _legends(decisions: Sequence[Decision], letters: Mapping[str, str]) -> dict[str, str]:
    """What the letters of each line's goal stand for that are not the paper's, by the line's equation."""
    return {d.claim.equation: _legend(d.certificate, letters) for d in decisions if d.certificate}


def _legend(certificate: Mapping[str, Any], letters: Mapping[str, str]) -> str:
    named = set(_NAME.findall(json.dumps(certificate["goal"])))
    told = [f"${name_latex(name)}$ is {worded(text)}" for name, text in letters.items() if name in named]
    return f"{'; '.join(told)}." if told else ""


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
    where = f" (section {found.section})" if found.section else ""
    title = subject_of(found.title)
    blocks: list[Block] = [Heading(3, f"{number}. {place_of(found.equation, '')}{where}: {worded(title)}"),
                           Formula(found.printed, origin_label(found))]
    if found.should_read:
        label = {"violated": "Holds with", "gap": "What does follow"}.get(found.verdict, "Should read")
        blocks.append(Formula(found.should_read, label))
    if found.mended_under:
        blocks.append(Paragraph(condition_sentence(found), "Not shown"))
    for label, text in (("Read as", _noted(found.reading, titles)), ("Finding", verdict_sentence(found)),
                        ("Letters", legends.get(found.equation, "") if found.counterexample else "")):
        if text:
            blocks.append(Paragraph(text, label))
    if found.counterexample is not None:
        before = told.get(found.counterexample)
        blocks += _worked(found.counterexample, told) if before is None else [
            Paragraph(f"The counterexample is that of correction {before}, where it is written out.")]
    for label, text in (("Other reading", reading_sentence(found)), ("Consequence", consequence_sentence(found)),
                        ("Note", _noted(found.note, titles))):
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
    return _listed({given: point.given, "Along": point.along}, point.beside)


def _premises(goal: Mapping[str, Any]) -> dict[str, list[str]]:
    """What a goal assumes, by when it is assumed, as LaTeX."""
    return {"Given": [relation_latex(text) for text in goal.get("assume", ())],
            "At all times": [relation_latex(text) for text in goal.get("always", ())],
            "At first": [f"{name_latex(name)} = {expression_latex(text)}"
                         for name, text in goal.get("initial", {}).items()],
            "Along": [rate_latex(name, rate) for name, rate in goal.get("flow", {}).items()]}


def _listed(conditions: Mapping[str, Sequence[str]], beside: Sequence[str]) -> list[Block]:
    parts = [(label, part) for label, part in conditions.items() if part]
    if not parts:
        return []
    at = COMMA.join(beside)
    size = sum(len(text) for _, part in parts for text in (*part, COMMA)) + len(at)
    if size > MOST_GIVEN:
        return [Paragraph("What else is assumed holds there too; the certificate spells it out.")]
    if size > LONGEST:
        return [*(Formula(text, "" if i else label) for label, part in parts for i, text in enumerate(_packed(part))),
                *([Formula(at, "Where")] if at else [])]
    (first, given), *others = [(label, COMMA.join(part)) for label, part in parts]
    others += [("Where", at)] if at else []
    return [Formula(given + "".join(rf"\quad\text{{{label.lower()}}}\ {text}" for label, text in others), first)]


def _packed(texts: Sequence[str]) -> list[str]:
    """Formulas in lines, short ones beside each other."""
    lines: list[str] = []
    for text in texts:
        if lines and len(lines[-1]) + len(text) <= LINE:
            lines[-1] += COMMA + text
        else:
            lines.append(text)
    return lines


def _readings(found: Sequence[Finding]) -> list[Block]:
    of_it = [f for f in found if f.gravity == "reading"]
    lines = tuple(Item(f"{worded(f.place)}: {math(f.printed)}. {verdict_sentence(f)} {reading_sentence(f)}")
                  for f in of_it)
    if not lines:
        return []
    intro = ("The text of the paper was extracted by a machine, which may lose a sign, a power or an index. These "
             "lines fail as extracted and hold in another reading; the printed page decides which it is.")
    return [Heading(2, HEADINGS["reading"]), Paragraph(intro), Items(lines)]


def _mended(decisions: Sequence[Decision], titles: Mapping[str, str], letters: Mapping[str, str]) -> list[Block]:
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
        if legend := _legend(d.certificate, letters):
            blocks.append(Paragraph(legend, "Letters"))
        blocks += _listed(_premises(d.certificate["goal"]), [])
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
