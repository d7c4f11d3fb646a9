"""The runs of liu2020's study: which there are, and what each of them leaves."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from workbench.paper.reproduced import STATED, Results, in_words
from workbench.paper.trip_run import ERROR, TripRun, signal_numbers, thinned_log, trip_numbers

from ..laws import LAWS
from ..simulation.trip import run_under, setting_of
from ..steady_run import Implied, implied
from .record import COLUMNS, LiuChange, LiuStudy, Printed

ALL_COLUMNS = tuple(range(1, COLUMNS + 1))
CORRECTED, BY_RATE, PRINTED, FEEDBACK = (
    f"liu2020.{name}" for name in ("corrected", "corrected_rate", "printed", "feedback"))
# Laws that run through all columns of Table 2, those whose curves are drawn, and those of Table 4.
TABLE_LAWS = (CORRECTED, BY_RATE, PRINTED, "liu2020.printed_rate", FEEDBACK, "liu2020.feedback_rate",
              "liu2020.position_only_speed", "liu2020.position_only")
# Those that are held against MPC, by speed and by the position alone.
COMPARED_LAWS = (CORRECTED, "liu2020.position_only")
DRAWN_LAWS = (*COMPARED_LAWS, BY_RATE)
TABLE_4_LAWS = (CORRECTED, BY_RATE, PRINTED, FEEDBACK)
# Where the signs of (19), (21), (32) and (35) are wrong, one by one.
SIGN_LAWS = (PRINTED, "liu2020.wrong_leakage", "liu2020.wrong_learning", CORRECTED)
# What rows call the RMS values of Tables 3 and 4.
RMS = {"s_tilde_m": "s_tilde_rms", "v_tilde_mps": "v_tilde_rms", "position_m": "position_rms", "speed_mps": "speed_rms"}


@dataclass(frozen=True)
class RunCase:
    """A run: column of Table 2, law, disturbance; change: number of the study's changes.

    leak_rate_per_s: in place of the stated one.
    """

    column: int
    law: str
    disturbance: str
    change: int = STATED
    leak_rate_per_s: float | None = None

    @property
    def drawn(self) -> bool:
        """Whether figures show its curves."""
        return self.change == STATED and self.law in DRAWN_LAWS


RunResult = TripRun[RunCase]


def number_of(run: RunResult, name: str) -> float | None:
    """A number of a run by the name that it has in Tables 3 and 4 or in rows; None of one that failed."""
    value: float | None = run.row[RMS.get(name, name)]
    return value


def run_cases(study: LiuStudy) -> list[RunCase]:
    """All runs, each once."""
    runs, of_table_3 = study.runs, study.runs.table_3_disturbance
    found = [RunCase(column, law, of_table_3) for law in TABLE_LAWS for column in ALL_COLUMNS]
    found += [RunCase(study.table_4_column, law, name) for law in TABLE_4_LAWS for name in study.disturbances]
    if study.changes:
        found += [RunCase(column, law, of_table_3, study.number_titled(runs.divergence_change), rate)
                  for column in runs.divergence_columns for law in SIGN_LAWS
                  for rate in runs.divergence_leak_rates_per_s]
    found += [RunCase(column, change.law or runs.sensitivity_law, of_table_3, number)
              for number, change in enumerate(study.changes) for column in change.columns or runs.sensitivity_columns]
    return list(dict.fromkeys(found))


def left_out(study: LiuStudy, case: RunCase) -> bool:
    """Whether a short report leaves out a law beside the printed and the corrected one."""
    return case.change == STATED and case.law in study.further_laws.laws and study.leaves_out(study.further_laws)


def title_of(study: LiuStudy, case: RunCase) -> str:
    """A run in words: law, column, and what is not as in Table 3."""
    as_table_3 = case.disturbance == study.runs.table_3_disturbance
    return in_words(f"{case.law}, Value {case.column}",
                    None if as_table_3 else study.disturbances[case.disturbance].title,
                    None if case.leak_rate_per_s is None else f"leak rate {case.leak_rate_per_s:g} 1/s",
                    study.change_title(case.change))


def run_case(study: LiuStudy, case: RunCase) -> RunResult:
    """Run a case and measure it; a run that diverges is reported failed."""
    changed = study.changed(case.change)
    setting = setting_of(changed, case.disturbance)
    run = run_under(LAWS[case.law], changed, case.column, setting, case.leak_rate_per_s)
    signals = {"s_tilde": run.column("s_tilde"), "v_tilde": run.column("v_tilde"),
               "input_n": changed.train.mass_kg * run.column("u_mps2")}
    drawn = signals | {ERROR: run.position_error, "speed": run.column("v_mps") - run.column("v_desired_mps"),
                       **{name: run.column(name) for name in ("s_m", "v_mps", "s_desired_m", "v_desired_mps")}}
    whole = math.nan if run.failed else 1.0
    row = trip_numbers(
        run, setting.curve.length_m, reversals=whole * run.totals["command_reversals"],
        energy_both_J=whole * (run.totals["traction_work_j"] + run.totals["braking_work_j"]),
        **signal_numbers(run, signals))
    return TripRun(case, row, thinned_log(run, drawn) if case.drawn else {})


@dataclass(frozen=True)
class LiuResults(Results[LiuStudy, RunCase, RunResult]):
    """The runs by what tables, figures and findings ask for, and what the paper prints of them."""

    def table_3(self, column: int, law: str) -> RunResult:
        """The run of a column of Table 3."""
        return self.runs[RunCase(column, law, self.study.runs.table_3_disturbance)]

    def table_4(self, disturbance: str, law: str) -> RunResult:
        """The run of a column of Table 4."""
        return self.runs[RunCase(self.study.table_4_column, law, disturbance)]

    def divergence(self, column: int, law: str, leak_rate_per_s: float) -> RunResult:
        """The run of a column under a leak rate, with the adaptation of `runs.divergence_change`."""
        runs, study = self.study.runs, self.study
        return self.runs[RunCase(column, law, runs.table_3_disturbance, study.number_titled(runs.divergence_change),
                                 leak_rate_per_s)]

    def laws(self, among: Sequence[str], **case: object) -> list[str]:
        """Those laws of which there are runs as stated; a short report has fewer. case: which runs, see `select`."""
        there = {of.law for of in self.fitting(lambda of: of.law in among and (of.change, of.leak_rate_per_s) == (
            STATED, None) and all(getattr(of, key) == value for key, value in case.items()))}
        return [law for law in among if law in there]

    def inferred(self) -> list[RunResult]:
        """The runs of the changes under which the paper's numbers seem to have been computed."""
        return [run for _, run in self.assumed(lambda change: change.title in self.study.runs.inferred_changes)]

    def assumed(self, which: Callable[[LiuChange], bool]) -> list[tuple[LiuChange, RunResult]]:
        """The runs under changes of assumed values for which that holds, without those that compare the signs."""
        return self.under(which, leak_rate_per_s=None)

    def rms(self, column: int, law: str, name: str) -> float | None:
        """A number of a column's run of Table 3; None where it failed."""
        return number_of(self.table_3(column, law), name)

    def printed(self, table: Printed, column: int, name: str) -> float:
        """A value of Table 3 for its column, or of Table 4 for the disturbance that Table 3 is run with."""
        study = self.study
        disturbance = list(study.disturbances).index(study.runs.table_3_disturbance)
        return float(getattr(table, name)[column - 1 if table is study.table_3 else disturbance])

    def implied(self) -> dict[str, Implied]:
        """What every printed column implies, by where it is printed."""
        study = self.study
        where = [(study.table_3, "Table 3", column) for column in ALL_COLUMNS]
        where.append((study.table_4, "Table 4", study.table_4_column))
        return {f"{name}, Value {column}": implied(study, column, *(
            self.printed(table, column, key) for key in ("s_tilde_m", "v_tilde_mps", "position_m")))
            for table, name, column in where}
