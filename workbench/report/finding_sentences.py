"""A finding in the sentences of a referee; formulas stand between dollar signs, as LaTeX."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from workbench.proof.fate import NAMED
from workbench.proof.places import place_of, places_of, subject_of, whole_of
from workbench.proof.wording import listed
from workbench.report.counterexample import Counterexample
from workbench.report.finding import Finding, Gravity
from workbench.report.worded import INNER, math, worded

HEADINGS: dict[Gravity, str] = {
    "falls": "Headline statements that fall", "corrected": "Headline statements that stand with corrections",
    "open": "Headline statements that stay open", "step": "Lines that fail and that others rest on",
    "gap": "Lines that do not follow", "alone": "Lines that fail and that nothing else rests on",
    "cosmetic": "Slips that change no result", "reading": "Readings that the extracted text leaves open"}


PRINTED, IMPLIED = "Printed", "Implied, not printed"
NUMBERS = 7  # values up to which those of letters in what is given are named too
SHORT = 70  # characters of LaTeX up to which a relation is repeated beside its numbers
CONDITIONS = 400  # characters of LaTeX up to which what a true statement needs stands in a sentence
APPROX = r"\approx "
_SMALL = ("Equation", "The ", "Statement")


def verdict_sentence(found: Finding) -> str:
    """What is wrong, in one sentence, with the numbers that show it."""
    where = "" if found.counterexample is None else f": {breaks_at(found.counterexample)}"
    return f"{short_verdict(found)}{where}."


def short_verdict(found: Finding) -> str:
    """What is wrong, in one clause without its numbers."""
    name = worded(found.place)
    if found.verdict == "proved":
        if found.gravity == "corrected" and found.mended_by not in found.fate_by:
            return f"{name} {worded(found.fate_why)}"
        lines = f", {_named(found, found.fate_by)}" if found.gravity != "corrected" else ""
        return f"{name} is shown only from lines that are not shown{lines}"
    if found.origin == "implied":
        place = worded(whole_of(found.equation, found.title))
        says = f", “{worded(subject_of(found.title))}”," if subject_of(found.title) not in place else ""
        place = place[:1].lower() + place[1:] if place.startswith(_SMALL) else place
        name = f"What the text implies at {place}{says}"
    return f"{name} {_words(found)}"


def _named(found: Finding, equations: Sequence[str]) -> str:
    """The lines of that name as a reader calls them, their parts told by what they say."""
    return worded(listed(places_of(equations, found.titles)))


def is_assumption(found: Finding) -> bool:
    """Whether a line assumes something of a system, which is not false but may not be met."""
    return found.place.startswith("Assumption")


def _words(found: Finding) -> str:
    motion = found.counterexample is not None and found.counterexample.motion
    by_motion = " by a motion of the printed closed loop"
    if is_assumption(found):
        return ({**_verdicts("", ""), "refuted": f"is not met{by_motion if motion else ''}",
                 "violated": "is not met at the printed numbers", "gap": "does not give what the paper takes from it"}
                [found.verdict])
    printed = " as extracted" if found.gravity == "reading" else " as printed" if found.origin == "printed" else ""
    if found.origin == "implied" and found.verdict in ("refuted", "violated"):
        numbers = " at the printed numbers" if found.verdict == "violated" else ""
        return f"does not hold{numbers}{f',{by_motion}' if motion else ''}"
    return _verdicts(printed, f",{by_motion}" if motion else "")[found.verdict]


def _verdicts(printed: str, motion: str) -> dict[str, str]:
    return {"refuted": f"is false{printed}{motion}", "violated": "is broken by the printed numbers",
            "gap": "does not follow from what the text uses to get there", "undecided": "is not decided",
            "assumed": "is taken as given: its proof was not checked", "proved": "holds"}


def breaks_at(point: Counterexample) -> str:
    """The numbers put in, and what the line says there."""
    few = not point.motion and point.others is None and len(point.values) + len(point.beside) <= NUMBERS
    named = ", ".join(f"${value}$" for value in (*point.values, *(point.beside if few else ())))
    letters = f"all {'other ' if named else ''}letters{' on which its sides depend' if point.beside else ''}"
    others = f"{'and ' if named else ''}{letters} equal to ${point.others}$"
    at = " ".join(filter(None, (named, others if point.others is not None else "")))
    short = len(point.relation) <= SHORT
    if point.unbounded is not None:
        says = f"${point.unbounded}$ stays greater than the time itself, so that it is not bounded"
    elif point.left is None or point.right is None:
        says = f"{f'${point.relation}$' if short else 'the line'} fails"
    else:
        says = _sides(point, short)
    if point.motion:
        return f"with {at}, everything assumed holds at all times, but {says}"
    return f"with {at}, {says}" if at else says


def _sides(point: Counterexample, short: bool) -> str:
    """What both sides of a line are."""
    left, right = (f"${(side or '').removeprefix(APPROX)}$" for side in (point.left, point.right))
    rounded = ", rounded" if APPROX in f"{point.left}{point.right}" else ""
    of = f" of ${point.relation}$" if short else ""
    if left == right:
        return f"both sides{of} are {left}{rounded}"
    return f"the left side{of} is {left} and the right side {right}{rounded}"


def correction_sentence(found: Finding) -> str:
    """The nearest true statement; empty where there is none."""
    if not found.should_read:
        return ""
    what = {"violated": "It holds with", "gap": "What does follow:"}.get(found.verdict, "It should read")
    if found.mended_by is not None and found.fate is not None:
        what = "Beside it is proved:" if found.verdict == "proved" else "Mended, it is proved:"
    return _ended(f"{what} {math(found.should_read)}", found.should_read)


def needs_sentence(found: Finding) -> str:
    """For what the nearest true statement is proved, or where that is written out; empty where that is nothing."""
    if not found.needs:
        return ""
    need = found.needs[0]
    told = {"": need.conditions, "along ": need.rates}
    parts = [f"{word}{', '.join(map(math, formulas))}" for word, formulas in told.items() if formulas]
    text = f"That is proved for {', '.join(parts)}."
    more = any(one.conditions or one.rates for one in found.needs[1:])
    if more or len(text) > CONDITIONS:
        return f"Under which conditions that is proved, workbench errata {found.paper} writes out."
    return text if parts else ""


def condition_sentence(found: Finding) -> str:
    """From which lines that are not shown the nearest true statement is proved; empty where it needs none."""
    under = found.mended_under
    if not under:
        return ""
    holds, are = ("holds", "is") if len(under) == 1 else ("hold", "are")
    return f"That is proved only where {_named(found, under)} {holds}, which {are} not shown."


def consequence_sentence(found: Finding) -> str:
    """What rests on the line, and on which lines that fail it rests; empty where neither is."""
    resting = [worded(place) for place in places_of(found.headlines, found.titles)]
    if found.lines:
        count = "one" if found.lines == 1 else str(found.lines)
        resting.append(f"{count} {'other ' if resting else ''}line{'s' if found.lines > 1 else ''}")
    one = len(found.headlines) + found.lines == 1
    text = f"{listed(resting)} rest{'s' if one else ''} on it." if resting else ""
    if found.gravity != "corrected":
        text = f"{text} {_way(found)}".strip()
    return text[:1].upper() + text[1:]


def _way(found: Finding) -> str:
    """On which lines that fail it rests in the text, of many the causes; none of those at which its own counterexample
    leaves nothing to find fault with, nor of those that hold in their other reading."""
    failing = [line for line in found.because if line not in {*found.otherwise, *found.kept}]
    if not failing:
        kept = [line for line in found.kept if line in found.because]
        told = found.alone and 0 < len(kept) <= NAMED
        holds = "holds" if len(kept) == 1 else "hold"
        return f"It fails by itself: at its counterexample {_named(found, kept)} {holds}." if told else ""
    named = list(found.causes) if found.causes and len(failing) > NAMED else failing
    others = len(failing) - len(named)
    fail, these = ("fails", "it") if len(named) == 1 else ("fail", "these")
    many = f"{others} more that fail and rest" if others > 1 else "one more that fails and rests"
    more = f", and on {many} on {these}" if others else ""
    return f"In the text it rests on {_named(found, named)}, which {fail}{more}."


def reading_sentence(found: Finding) -> str:
    """How else the line may be read, where its extracted text leaves that open; empty where it does not."""
    if not found.other_reading:
        return ""
    return f"Read as {math(found.other_reading)} it {'holds' if found.other_holds else 'fails too'}."


def printed_sentence(found: Finding) -> str:
    """The line as printed, or what the paper implies."""
    return _ended(f"{origin_label(found)}: {math(found.printed)}", found.printed)


def origin_label(found: Finding) -> str:
    """What stands in front of the line: a step that is taken without words is not called printed."""
    return PRINTED if found.origin == "printed" else IMPLIED


def _ended(sentence: str, formula: str) -> str:
    """The sentence with a full stop, where the formula at its end has none of its own."""
    return sentence if formula.rstrip("} ").endswith(".") else f"{sentence}."


def sentences(found: Finding) -> list[str]:
    """All that a referee would write of it."""
    return [s for s in (verdict_sentence(found), printed_sentence(found), correction_sentence(found),
                        needs_sentence(found), condition_sentence(found), reading_sentence(found),
                        consequence_sentence(found)) if s]


def findings_document(found: Sequence[Finding]) -> dict[str, Any]:
    """The findings for programs: all their fields, formulas as LaTeX, and their sentences, in which formulas stand
    between dollar signs."""
    return {"findings": [{"place": f.place, "heading": HEADINGS[f.gravity], **asdict(f),
                          "sentences": [s.replace(INNER, "$") for s in sentences(f)]} for f in found]}


def fate_sentence(equation: str, word: str, why: str, title: str = "") -> str:
    """What becomes of a headline statement, in one sentence; title: what it says, where the reader is to be told."""
    place = place_of(equation, title or None)
    says = f" ({subject_of(title)})" if title and "“" not in place and subject_of(title) != place else ""
    first = {"falls": "falls: ", "open": "stays open: it "}.get(word, "")
    return f"{place}{says} {first}{why}."
