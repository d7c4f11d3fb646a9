"""What is known of a paper's gains as tables and as a document: conditions, what is proved, found gains, their runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from workbench.gains.result import GainReport
from workbench.paper.cells import Cell, Phrase, Quantity
from workbench.paper.gain_effects import Effect
from workbench.paper.only_full import shortened
from workbench.paper.recorded_front import GainFront
from workbench.paper.results import ResultTable, StudyResult
from workbench.report.gain_words import column, letter, spoken, with_powers

if TYPE_CHECKING:
    from workbench.report.document_format import GainsDocument

LONG = 12  # characters of a fraction that is shown as it is
APART = 1.02  # by what factor numbers differ that are said to
NOT_ERRORS = {"energy_J", "command_max", "bound_used", "mse_0", "reversals"}  # less of these is not better tracking


def gains_result(report: GainReport, effects: Sequence[Effect], fronts: Sequence[GainFront] = (),
                 left_out: Mapping[str, int] | None = None) -> StudyResult:
    """The tables that `workbench gains` prints, its notes as findings; left_out: setting -> runs that it lacks."""
    tables = [table for table in (_conditions(report), _quantities(report), _found(report)) if table.rows]
    if effects:
        tables += _effects(effects, left_out or {})
    tables += [table for front in fronts for table in (_front(front), _front_gains(front))]
    return StudyResult(
        rows=tuple({"controller": e.gains, "setting": e.setting, **e.numbers, "failed": e.failed} for e in effects),
        tables=tuple(replace(table, letters=True) for table in tables), plots=(),
        findings=(*compared(effects), *map(front_sentence, fronts), *map(with_powers, report.notes)),
        failures=tuple((f"{e.gains}, {e.setting}", e.failed) for e in effects if e.failed))


def gains_document(report: GainReport, effects: Sequence[Effect], fronts: Sequence[GainFront] = ()) -> GainsDocument:
    """The document of `workbench gains --json`; numbers in SI units, gains as exact fractions and as floats."""
    return {
        "version": 1, "paper": report.paper,
        "conditions": [{"name": c.name, "statement": c.statement, "computed": c.computed, "met": c.met,
                        "certificate": c.certificate or None, "note": c.note} for c in report.conditions],
        "quantities": [{"name": q.name, "unit": q.unit, "papers": q.papers, "proved": q.proved, "check": q.check,
                        "certificate": q.certificate, "note": q.note} for q in report.quantities],
        "found": [{"name": s.name, "objective": s.objective, "values": {k: float(v) for k, v in s.values.items()},
                   "exact": {k: str(v) for k, v in s.values.items()}, "proved": s.proved,
                   "certificate": s.certificate, "changes": dict(s.changes), "note": s.note} for s in report.found],
        "effects": [{"gains": e.gains, "setting": e.setting, **e.numbers, "failed": e.failed} for e in effects],
        "fronts": [{"setting": front.title, "bounded": front.bounded, "unit": front.unit,
                    "evaluations": front.evaluations, "points": [
                        {"name": p.name, "gains": p.gains, "numbers": p.numbers, "cost": p.cost, "bound": p.bound,
                         "no_bound_below": p.frozen, "certificate": p.certificate} for p in front.points]}
                   for front in fronts],
        "compared": compared(effects), "certificates": [str(c["claim"]) for c in report.certificates],
        "notes": list(report.notes),
        "search_s": dict(report.seconds)}


def _conditions(report: GainReport) -> ResultTable:
    return ResultTable("conditions at the stated gains", "the paper's own, and what its conclusions need",
                       ("condition", "states", "value", "met"), tuple(
                           (c.name, c.statement, with_powers(c.computed), "yes" if c.met else "no")
                           for c in report.conditions))


def _quantities(report: GainReport) -> ResultTable:
    return ResultTable("what is proved", "certificates by the semidefinite program, re-checked exactly",
                       ("quantity", "by the paper", "proved", "check", "remark"), tuple(
                           (q.name + (f" ({q.unit})" if q.unit else ""), q.papers, _near_one(q.proved),
                            _near_one(q.check), with_powers(q.note)) for q in report.quantities))


def _front(front: GainFront) -> ResultTable:
    names = [name for name in front.points[0].numbers if name != "cost"]
    rows = tuple((_name(p.name), p.cost, *(p.numbers[name] for name in names), p.bound, p.frozen)
                 for p in front.points)
    return ResultTable(
        f"cost against what is proved: {front.title}", "runs, and certificates checked again", (
            "gains", "cost", *map(column, names), f"proved ({front.unit})",
            f"none below ({front.unit})"), rows,
        f"Proved: {front.bounded}, of the linearised sampled loop over a box of speeds and masses; none below: where a "
        f"bound cannot be, by frequency responses at the hull's vertices. Of {front.evaluations} evaluations.")


def _front_gains(front: GainFront) -> ResultTable:
    """The gains themselves, beside whose numbers they would leave a page no room."""
    return ResultTable(f"gains of that table: {front.title}", "runs, and certificates checked again",
                       ("gains", "values", "certificate"), tuple(
                           (_name(p.name), Phrase(", ".join(f"{letter(name)} = {{}}" for name in p.gains),
                                                  tuple(p.gains.values())), p.certificate) for p in front.points))


def front_sentence(front: GainFront) -> str:
    """How what was found stands to the stated gains, in both."""
    stated, found = front.points[0], front.points[1:]
    if not found:
        return f"{front.title.capitalize()}: no gains are kept of a search."
    ran = "fail in their run" if stated.cost is None else f"cost {stated.cost:.3g}"
    proved = f"{'nothing' if stated.bound is None else f'{stated.bound:.3g} {front.unit}'} is proved of them"
    better = [p for p in found if p.cost is not None and p.bound is not None
              and (stated.cost is None or p.cost <= stated.cost) and (stated.bound is None or p.bound <= stated.bound)]
    best = ", ".join(_name(p.name) for p in better)
    return (f"{front.title.capitalize()}: the stated gains {ran}, {proved}; "
            f"{f'better in both: {best}' if better else 'none that was found is better in both'}.")


def _near_one(value: float | None) -> Cell:
    """Near 1 the digits after it are what counts."""
    return Quantity(value, digits=9) if value is not None and 0 < abs(1 - value) < 1e-3 else value


def _found(report: GainReport) -> ResultTable:
    return ResultTable("gains found", "best for an objective under what is proved",
                       ("name", "objective", "gains", "proved"), tuple(
                           (_name(s.name), s.objective, _gains(s.values), s.proved) for s in report.found))


def _name(gains: str) -> str:
    """The name of a set of gains as words: it is no letter with indices."""
    return gains.replace("_", " ")


def _gains(values: Mapping[str, Fraction]) -> Cell:
    return Phrase(", ".join(f"{letter(name)} = {{}}" for name in values), tuple(map(_gain, values.values())))


def _gain(value: Fraction) -> str | Quantity:
    """As a fraction where that is short, else as a decimal."""
    if value.denominator != 1 and len(str(value)) <= LONG:
        return str(value)
    return Quantity(float(value), digits=None if value.denominator == 1 else 4)


def _effects(effects: Sequence[Effect], left_out: Mapping[str, int]) -> list[ResultTable]:
    """A table for each setting, the stated gains first; a failed run has dashes."""
    tables = []
    for setting in dict.fromkeys(e.setting for e in effects):
        own = [e for e in effects if e.setting == setting]
        names = list(dict.fromkeys(name for e in own for name in e.numbers))
        rows = tuple((_name(e.gains), *(e.numbers.get(name) for name in names), "failed" if e.failed else "to the end")
                     for e in own)
        tables.append(shortened(ResultTable(f"simulated: {setting}", "the paper's own runs", (
            "gains", *map(column, names), "run"), rows), left_out.get(setting, 0)))
    return tables


def compared(effects: Sequence[Effect]) -> list[str]:
    """For every run with found gains, a sentence in which numbers it is better and worse than with the stated ones."""
    sentences = []
    for e in effects:
        stated = next((o for o in effects if o.gains == "stated" and o.setting == e.setting), None)
        if stated is None or e is stated or e.gains == "stated":
            continue
        name = f"Simulated, the gains '{e.gains.replace('_', ' ')}' against the stated ones, {e.setting}"
        if e.failed or stated.failed:
            ends = [which for which, run in (("the found", e), ("the stated", stated)) if run.failed]
            sentences.append(f"{name}: {' and '.join(ends)} gains do not come to the end.")
            continue
        sides: dict[str, list[str]] = {"better": [], "worse": []}
        for key, value in e.numbers.items():
            other = stated.numbers.get(key)
            if key in NOT_ERRORS or not isinstance(value, int | float) or not isinstance(other, int | float):
                continue
            if abs(value) * APART < abs(other) or abs(other) * APART < abs(value):
                sides["better" if abs(value) < abs(other) else "worse"].append(spoken(key))
        words = [f"{side} in {', '.join(keys)}" for side, keys in sides.items() if keys]
        if e.numbers.get("outcome") != stated.numbers.get("outcome"):
            words.append(f"outcome '{e.numbers['outcome']}' where the stated gains have "
                         f"'{stated.numbers['outcome']}'")
        sentences.append(f"{name}: {'; '.join(words) or 'no difference to speak of'}.")
    return sentences
