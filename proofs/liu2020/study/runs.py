"""The runs of liu2020's study: which there are, and what each of them leaves."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.reproduced import STATED, Results
from workbench.paper.tracked import Tracked, of_run
from workbench.simulate.closed_loop import Array, Run

from ..laws import LAWS
from ..simulation.trip import run_under, setting_of
from ..steady_run import Implied, implied
from .record import COLUMNS, LiuStudy, Printed

ALL_COLUMNS = tuple(range(1, COLUMNS + 1))
CORRECTED, BY_RATE, PRINTED, FEEDBACK = (
    f"liu2020.{name}" for name in ("corrected", "corrected_rate", "printed", "feedback"))
# Laws that run through all columns of Table 2, those whose curves are drawn, and those of Table 4.
TABLE_LAWS = (CORRECTED, BY_RATE, PRINTED, "liu2020.printed_rate", FEEDBACK, "liu2020.feedback_rate",
              "liu2020.position_only_speed", "liu2020.position_only")
DRAWN_LAWS = (CORRECTED, BY_RATE)
TABLE_4_LAWS = (CORRECTED, BY_RATE, PRINTED, FEEDBACK)
# Where the signs of (19), (21), (32) and (35) are wrong, one by one.
SIGN_LAWS = (PRINTED, "liu2020.wrong_leakage", "liu2020.wrong_learning", CORRECTED)
# One row in so many of the log is drawn.
DRAWN = 5
# What a row of the study has of a run's numbers, by the names of `workbench compare` where it has one.
ROW = {"position_m_min": "position_error_min", "position_m_max": "position_error_max",
       "speed_mps_min": "speed_error_min", "speed_mps_max": "speed_error_max", "position_m": "position_rms",
       "speed_mps": "speed_rms", "s_tilde_m": "s_tilde_rms", "v_tilde_mps": "v_tilde_rms"} | {
    name: name for name in ("energy_J", "energy_both_J", "input_n_min", "input_n_max", "reversals")}


@dataclass(frozen=True)
class RunCase:
    """A run: column of Table 2, law, disturbance; change: number of the study's changes.

    drawn: whether its curves are wanted; leak_rate_per_s: in place of the stated one.
    """

    column: int
    law: str
    disturbance: str
    change: int = STATED
    drawn: bool = False
    leak_rate_per_s: float | None = None


@dataclass(frozen=True)
class RunResult:
    """A run as numbers (SI units); curves by name of a thinned log, empty unless asked for.

    The numbers of a run that failed are None, but for the time and the largest position error until then.
    """

    case: RunCase
    numbers: dict[str, float | None]
    end_s: float
    largest_position_error_m: float
    failed: str | None
    step_us: float
    curves: dict[str, Array]


def table_3_case(study: LiuStudy, column: int, law: str) -> RunCase:
    """A column of Table 2 as Table 3 runs it."""
    return RunCase(column, law, study.runs.table_3_disturbance, drawn=law in DRAWN_LAWS)


def table_4_case(study: LiuStudy, disturbance: str, law: str) -> RunCase:
    """The column of Table 4 under one of its disturbances."""
    return RunCase(study.table_4_column, law, disturbance, drawn=law in DRAWN_LAWS)


def divergence_case(study: LiuStudy, column: int, law: str, leak_rate_per_s: float) -> RunCase:
    """A column under a leak rate, with the adaptation of `runs.divergence_change`."""
    number = [change.title for change in study.changes].index(study.runs.divergence_change)
    return RunCase(column, law, study.runs.table_3_disturbance, number, leak_rate_per_s=leak_rate_per_s)


def run_cases(study: LiuStudy) -> list[RunCase]:
    """All runs, each once."""
    found = [table_3_case(study, column, law) for law in TABLE_LAWS for column in ALL_COLUMNS]
    found += [table_4_case(study, name, law) for law in TABLE_4_LAWS for name in study.disturbances]
    if study.changes:
        found += [divergence_case(study, column, law, rate) for column in study.runs.divergence_columns
                  for law in SIGN_LAWS for rate in study.runs.divergence_leak_rates_per_s]
    found += [RunCase(column, change.law or study.runs.sensitivity_law, study.runs.table_3_disturbance, number)
              for number, change in enumerate(study.changes)
              for column in change.columns or study.runs.sensitivity_columns]
    return list(dict.fromkeys(found))


def title_of(study: LiuStudy, case: RunCase) -> str:
    """A run in words: law, column, and what is not as in Table 3."""
    as_table_3 = case.disturbance == study.runs.table_3_disturbance
    words = (f"{case.law}, Value {case.column}", None if as_table_3 else study.disturbances[case.disturbance].title,
             None if case.leak_rate_per_s is None else f"leak rate {case.leak_rate_per_s:g} 1/s",
             study.change_title(case.change))
    return ", ".join(filter(None, words))


def run_case(study: LiuStudy, case: RunCase) -> RunResult:
    """Run a case and measure it; a run that diverges is reported failed."""
    changed = study.changed(case.change)
    run = run_under(LAWS[case.law], changed, case.column, setting_of(changed, case.disturbance), case.leak_rate_per_s)
    return _measured(case, run, changed.train.mass_kg)


def _measured(case: RunCase, run: Run, mass_kg: float) -> RunResult:
    total, samples = run.totals, max(1.0, run.totals["samples"])
    largest = max(abs(total["position_error_min"]), abs(total["position_error_max"]))
    errors = {"s_tilde_m": run.column("s_tilde"), "v_tilde_mps": run.column("v_tilde"),
              "position_m": run.column("s_m") - run.column("s_desired_m"),
              "speed_mps": run.column("v_mps") - run.column("v_desired_mps"), "input_n": mass_kg * run.column("u_mps2")}
    numbers: dict[str, Any] = {}
    if run.failed is None:
        numbers = {f"{name}_min": float(values.min()) for name, values in errors.items()}
        numbers |= {f"{name}_max": float(values.max()) for name, values in errors.items()}
        numbers |= {name: float(np.sqrt(np.mean(errors[name] ** 2))) for name in ("s_tilde_m", "v_tilde_mps")}
        numbers |= {
            "position_m": math.sqrt(total["position_error_square_sum"] / samples),
            "speed_mps": math.sqrt(total["speed_error_square_sum"] / samples),
            "energy_both_J": total["traction_work_j"] + total["braking_work_j"],
            "energy_J": total["traction_work_j"], "reversals": total["command_reversals"]}
    curves: dict[str, Array] = {}
    if case.drawn:
        curves = {name: values[::DRAWN] for name, values in errors.items()}
        curves |= {name: run.column(name)[::DRAWN] for name in (
            "t_s", "s_m", "v_mps", "s_desired_m", "v_desired_mps")}
    return RunResult(case, numbers, run.end_s, largest, run.failed, float(np.median(run.step_us)), curves)


@dataclass(frozen=True)
class LiuResults(Results[LiuStudy, RunCase, RunResult]):
    """The runs by what tables, figures and findings ask for, and what the paper prints of them."""

    def table_3(self, column: int, law: str) -> RunResult:
        """The run of a column of Table 3."""
        return self.runs[table_3_case(self.study, column, law)]

    def table_4(self, disturbance: str, law: str) -> RunResult:
        """The run of a column of Table 4."""
        return self.runs[table_4_case(self.study, disturbance, law)]

    def divergence(self, column: int, law: str, leak_rate_per_s: float) -> RunResult:
        """The run of a column under a leak rate."""
        return self.runs[divergence_case(self.study, column, law, leak_rate_per_s)]

    def inferred(self) -> list[RunResult]:
        """The runs of the changes under which the paper's numbers seem to have been computed."""
        return [run for case, run in self.changing(leak_rate_per_s=None).items()
                if self.study.changes[case.change].title in self.study.runs.inferred_changes]

    def rms(self, column: int, law: str, name: str) -> float | None:
        """A number of a column's run of Table 3; None where it failed."""
        return self.table_3(column, law).numbers.get(name)

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


def run_row(study: LiuStudy, case: RunCase, result: RunResult) -> dict[str, Any]:
    """A run as data, SI units; inputs in N."""
    return {
        "controller": case.law, "column": case.column, "disturbance": case.disturbance,
        "change": study.change_title(case.change),
        "leak_rate_per_s": case.leak_rate_per_s, **{key: result.numbers.get(name) for name, key in ROW.items()},
        "largest_position_error": result.largest_position_error_m, "end_s": result.end_s,
        "step_us_median": result.step_us, "failed": result.failed}


def track(study: LiuStudy, curve: DesiredCurve | None) -> Tracked:
    """The last column of Table 2 with the signs corrected, on a curve or on the study's own.

    The networks stay where the study puts them.
    """
    law, setting = LAWS[CORRECTED], setting_of(study, study.runs.table_3_disturbance)
    if curve:
        setting = replace(setting, curve=curve, end_s=curve.trip_time_s)
    run = run_under(law, study, study.table_4_column, setting)
    return of_run("liu2020", replace(run, controller=f"{law.id}, Value {study.table_4_column}"), setting.curve)
