"""What a referee would write of a paper: one finding a line that does not stand, made from the decisions alone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from workbench.proof.checker import goal_digest
from workbench.proof.fate import is_headline
from workbench.proof.places import place_of
from workbench.proof.premises import holds_in_other_reading
from workbench.proof.verdict import FAILED, Decision, FateWord, Origin, Verdict
from workbench.report.counterexample import Counterexample
from workbench.report.counterexample_cache import cached_counterexample
from workbench.report.failing_lines import Way, ways
from workbench.report.hypotheses import Need, needs_of
from workbench.report.letters import letters_of
from workbench.report.number_style import alike, upright

# What a finding is, the gravest first: a headline statement that falls, that stands only with corrections, that stays
# open; a line that fails and that others rest on; one that does not follow; one that fails and that nothing rests on;
# one of which nothing depends; one whose extracted text leaves a sign, power or index open, where the other reading
# holds.
Gravity = Literal["falls", "corrected", "open", "step", "gap", "alone", "cosmetic", "reading"]
GRAVITIES: tuple[Gravity, ...] = ("falls", "corrected", "open", "step", "gap", "alone", "cosmetic", "reading")


@dataclass(frozen=True)
class Finding:
    """A line of a paper that does not stand as printed, and what that means.

    paper, equation, section, title: where; origin: whether the paper prints the line or takes the step without words;
    reading: how a person read it; printed, should_read: LaTeX of the line and of the nearest true statement,
    which is proved (empty where none is known); mended_by: the equation of the claim that proves it as a line of its
    own, mended_under: the equations of what that proof uses and that is not shown; counterexample: what breaks it;
    headlines: the theorems and headline statements that rest on it, lines: how many other lines do, without those that
    fail whether it holds or not; because: the lines
    that fail on the way to it, roots: those of them that rest on no other one, otherwise: those of them that hold in
    their other reading, kept and broken: those of them that hold, and that fail, at its own counterexample, causes: of
    the rest those that rest on no other one of it; alone: whether the line fails by itself; needs: what the true
    statement and its proof assume; other_reading: LaTeX of how else it may
    be read, other_holds: whether that is proved; digest: that of the goal in its certificate, None without one; titles:
    what the other lines named here say, by equation.
    """

    paper: str
    equation: str
    section: str
    title: str
    gravity: Gravity
    verdict: Verdict
    origin: Origin
    reading: str
    printed: str
    should_read: str
    mended_by: str | None
    mended_under: tuple[str, ...]
    counterexample: Counterexample | None
    headlines: tuple[str, ...]
    lines: int
    because: tuple[str, ...]
    roots: tuple[str, ...]
    otherwise: tuple[str, ...]
    kept: tuple[str, ...]
    broken: tuple[str, ...]
    causes: tuple[str, ...]
    alone: bool
    needs: tuple[Need, ...]
    fate: FateWord | None
    fate_why: str
    fate_by: tuple[str, ...]
    other_reading: str
    other_holds: bool
    note: str
    digest: str | None
    titles: dict[str, str]

    @property
    def place(self) -> str:
        """The line's name: Theorem 2, equation (44); a part of a line is told by its title."""
        return place_of(self.equation, self.title)


def findings(decisions: Sequence[Decision]) -> list[Finding]:
    """The findings on the lines of papers, paper by paper, the gravest first; questions of ours are none.

    All claims of a paper must be among the decisions, as `judged` leaves them.
    """
    by_id = {d.claim.id: d for d in decisions}
    place = {d.claim.id: i for i, d in enumerate(decisions)}
    alternatives = {d.claim.glyph for d in decisions if d.claim.glyph and place[d.claim.id] < place[d.claim.glyph]}
    mended = {d.claim.mends: d for d in decisions if d.claim.mends and d.verdict == "proved"}
    on_the_way = ways(decisions)
    found = []
    for d in decisions:
        fails = d.verdict in FAILED or (d.fate is not None and d.fate.word != "stands")
        if d.claim.origin == "ours" or not fails or d.claim.id in alternatives:
            continue
        found.append(_finding(d, by_id, mended.get(d.claim.id), decisions, on_the_way))
    papers = list(dict.fromkeys(d.claim.paper for d in decisions))
    return sorted(found, key=lambda f: (papers.index(f.paper), GRAVITIES.index(f.gravity), not f.alone,
                                        -len(f.headlines), place[f"{f.paper}:{f.equation}"]))


def _finding(d: Decision, by_id: dict[str, Decision], mended: Decision | None,
             decisions: Sequence[Decision], on_the_way: Mapping[str, Way]) -> Finding:
    way = on_the_way.get(d.claim.id, Way())
    resting = [other for other in decisions if d.claim.id in other.tainted_by and other.claim.origin != "ours"
               and d.claim.id not in on_the_way.get(other.claim.id, Way()).kept]
    headlines = tuple(other.claim.equation for other in resting if is_headline(other))
    lines = len(resting) - len(headlines)
    holds = holds_in_other_reading(d, by_id)
    fate_by = d.fate.by if d.fate else ()
    others = [by_id[name].claim for name in (*d.tainted_by, *fate_by)] + [other.claim for other in resting]
    # A line that is misstated has no decision; what is wrong with it is said apart.
    others += [by_id[name].claim for name in mended.proved_under if name in by_id] if mended else []
    return Finding(
        d.claim.paper, d.claim.equation, d.claim.section, d.claim.title,
        _gravity(d, bool(resting), holds), d.verdict, d.claim.origin, d.claim.reading, d.claim.printed,
        _correction(d, mended), mended.claim.equation if mended else None,
        _equations(mended.proved_under) if mended and not d.correction else (),
        _counterexample(d), headlines, lines,
        _equations(d.tainted_by), _equations(name for name in d.tainted_by if not by_id[name].tainted_by),
        _equations(way.otherwise), _equations(way.kept), _equations(way.broken), _equations(way.causes), way.alone,
        needs_of(d, mended, by_id),
        d.fate.word if d.fate else None,
        d.fate.why if d.fate else "",
        _equations(fate_by),
        d.other_reading or "", holds, d.claim.note, goal_digest(d.certificate) if d.certificate else None,
        {claim.equation: claim.title for claim in others})


def _counterexample(d: Decision) -> Counterexample | None:
    """What breaks a line, in the paper's letters."""
    found = cached_counterexample(d.certificate) if d.certificate else None
    return None if found is None else letters_of(d).in_counterexample(found)


def _equations(names: Iterable[str]) -> tuple[str, ...]:
    """The equations of claims, by their ids."""
    return tuple(name.partition(":")[2] for name in names)


def _correction(d: Decision, mended: Decision | None) -> str:
    """The nearest true statement; numbers at which a condition holds are written as in its counterexample."""
    if d.correction:
        return alike(upright(d.correction)) if d.verdict == "violated" else d.correction
    return mended.claim.printed if mended else ""


def _gravity(d: Decision, rested_on: bool, holds_otherwise: bool) -> Gravity:
    if d.verdict in FAILED and holds_otherwise:
        return "reading"
    if d.fate is not None:
        return {"falls": "falls", "stands with corrections": "corrected"}.get(d.fate.word, "open")  # type: ignore[return-value]
    if d.claim.severity == "cosmetic":
        return "cosmetic"
    if d.verdict == "gap":
        return "gap"
    return "step" if rested_on else "alone"
