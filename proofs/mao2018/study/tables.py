"""The tables of mao2018's study."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from workbench.paper.cells import FORCES, Cell, Column, Quantity, Scaled
from workbench.paper.reproduced import STATED
from workbench.paper.results import ResultTable
from workbench.paper.study_tables import ColumnOf, run_table, sensitivity_table

from .runs import MaoResults, RunCase, RunResult, event_times

FIGURES = {1: "Figure 1", 2: "Figure 2 (a)", 3: "Figure 2 (b)", 4: "Figure 2 (c)", 5: "Figure 2 (d)"}
SIGNS_LEFT = "wrong signs left"


def _printed(results: MaoResults) -> ResultTable:
    study, rows = results.study, []
    for number, case in enumerate(study.cases, start=1):
        said = "follows the desired curve" if number == 1 else "transients at changes and failures, then settles"
        rows.append((FIGURES.get(number, f"case {number}"), case.title, said, *(
            run.summary for tuning in study.tunings
            for run in (results.printed(number, tuning), results.corrected(number, tuning)))))
    tunings = " ".join(f"{name}: {tuning.title}, r_1 = {tuning.r_1_per_s:g}/s, r_2 = {tuning.r_2_per_s:g}/s, "
                       f"{1e3 * tuning.period_s:g} ms." for name, tuning in study.tunings.items())
    return ResultTable(
        "Tracking errors, printed and obtained", "paper, section VIII, Figures 1 and 2",
        ("figure", "case", "the paper says", *(f"{law}, {tuning}" for tuning in study.tunings
                                              for law in ("law as printed", "corrected"))), tuple(rows),
        f"The paper prints curves and no numbers. Obtained: the largest position error after "
        f"{event_times(study)[1]:.0f} s, when the error of the start is over, and the largest to which it settles "
        f"before an event. {tunings}")


def _cases(results: MaoResults) -> Iterator[ResultTable]:
    """Every law of every case, from event to event, in every tuning."""
    times = event_times(results.study)[:-1]
    for name, tuning in results.study.tunings.items():
        rows: list[tuple[Cell, ...]] = []
        for run in results.stated(name):
            start, missing = (run.case.number, results.left(run), run.ended), [None] * (len(times) - len(run.stretches))
            rows.append((*start, "largest", *(Scaled(one.largest_m) for one in run.stretches), *missing))
            if run.stretches:
                rows.append((*start, "settled", *(Scaled(one.settled_m) for one in run.stretches), *missing))
        yield ResultTable(
            f"The cases, {tuning.title}", "paper, section VIII, cases 1 to 5",
            ("case", SIGNS_LEFT, "end", "position error", *(f"from {time:.0f} s" for time in times)), tuple(rows),
            "From each event to the next: the largest position error, and what it has settled to, the largest of the "
            f"last {results.study.horizon.settled_window_s:g} s. 400 s: tunnel; 600 s: a motor gives 200 kN; 800 s: "
            "curve and slope; 1000 s: its force varies; 1200 s: it stops; 1400 s: open, level track.")


def _sampling(results: MaoResults) -> ResultTable:
    study = results.study
    fastest = max(study.reference.speeds_mps)
    frequency = (study.law.gain * fastest**4) ** 0.5

    def turned(run: RunResult) -> Cell:
        period, gain = run.row["period_s"], run.row["loop_gain"]
        return None if run.failed else period * (gain * study.law.gain * fastest**4) ** 0.5

    columns: tuple[ColumnOf[RunResult], ...] = (
        (Column("period", "ms", 1e-3, None), lambda run: run.row["period_s"]),
        (Column("r_2", "1/s", digits=None), lambda run: run.case.r_2_per_s),
        (Column("period × √2 v²", decimals=2), lambda run: run.row["period_s"] * frequency),
        ("diverged", lambda run: run.ended or "none"),
        (Column("m k_ν ρ̂ at the end", decimals=2), lambda run: None if run.failed else run.row["loop_gain"]),
        (Column("period × √(2 m k_ν ρ̂) v²", decimals=2), turned),
        ("largest error", lambda run: None if run.failed else Scaled(run.largest_m)))
    return run_table(
        "Which sampling the stated gains bear", "sampling, not in the paper", (),
        (((), run) for run in results.sampled()), columns,
        f"Case {study.sampling.case}, corrected, until {study.sampling.end_s:g} s, regressors in SI units. With a gain "
        f"of {study.law.gain:g} the loop of z_2 and the estimate of c oscillates at √{study.law.gain:g} v² rad/s, "
        f"{frequency:.0f} rad/s at {fastest:g} m/s, times √(m k_ν ρ̂), where m k_ν ρ̂ = 1 "
        "for a right estimate; an Euler step bears at most 2 rad a period. Beyond it the growing oscillation pushes "
        "the estimate ρ̂ down until 2 rad are met, or the run is lost, as where a new mode brings its own ρ̂.")


def _commands(results: MaoResults) -> ResultTable:
    """Chattering and the forces that are asked for, of the runs that ended."""
    study = results.study
    runs = [(study.law.layer_mps, run) for tuning in study.tunings for run in results.stated(tuning)]
    runs += [(change.set["law.layer_mps"], run) for change, run in results.changed_runs()
             if "law.layer_mps" in change.set]
    mass, rows = 1e3 * study.train.mass_t, []
    for layer, run in runs:
        if not run.failed:
            row = run.row
            rows.append((run.case.number, results.left(run), run.case.tuning,
                         Quantity(layer, "mm/s", 1e-3, None) if layer else "sgn", row["command_reversals_per_s"],
                         row["command_change_mps2"], Scaled(mass * row["command_min"], FORCES),
                         Scaled(mass * row["command_max"], FORCES), Scaled(run.settled_m)))
    return ResultTable(
        "What the command does", "chattering and forces, not in the paper",
        ("case", SIGNS_LEFT, "gains", "sign", Column("reversals a second", decimals=0),
         Column("mean change a sample", "m/s²", digits=2), "least force", "largest force", "settles to"), tuple(rows),
        f"A reversal: the command rises after it fell, or falls after it rose. The force is what all "
        f"{study.train.motors} motors would give; nothing limits it.")


def _sensitivity(results: MaoResults) -> ResultTable:
    def compared(case: RunCase, run: RunResult) -> tuple[Cell, ...]:
        as_stated = results.runs.get(replace(case, change=STATED))
        return case.number, results.left(run), run.summary, as_stated.summary if as_stated else None

    return sensitivity_table(
        "How much the assumed values matter", ("case", SIGNS_LEFT, "obtained", "without the change"),
        [(title, [compared(*run) for run in runs.items()]) for title, runs in results.by_change()],
        "The largest error after the first event and what it settles to, as above.")


TABLES = (_printed, _cases, _sampling, _commands, _sensitivity)
