"""The study of chen2019: six cars that learn from trip to trip, by every rule of sampling, and what it depends on."""

from __future__ import annotations

from typing import Any

import numpy as np

from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import drawn_rows, pair_findings, pair_table, pair_tasks, pairs_of
from workbench.paper.results import StudyResult
from workbench.paper.study import Progress, StudyKind
from workbench.simulate.process_pool import run_tasks

from ..simulation.cars_trials import CarsRun
from .drivers import DRIVERS, WHERE, Task, run_tuned, stated_rows, tuned_findings, tuned_plots, tuned_table, tuned_tasks
from .findings import all_findings
from .mpc_comparison import beside_findings, beside_tables, growth, run_beside
from .outcomes import Found, difference, outcome, position_error, speed_error
from .plots import all_plots
from .record import ChenStudy
from .runs import STATED, changed, cost, run_number, title
from .tables import all_tables
from .tracking import track

# What a run that failed has no numbers for.
NUMBERS = ("position_error_min", "position_error_max", "speed_error_min", "speed_error_max", "position_rms",
           "speed_rms", "stopping_error", "energy_J", "saturated_fraction", "difference_max_N", "position_error_first",
           "speed_error_first")


def run(study: ChenStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that ends early is told and stops no other."""
    asked = range(STATED, len(study.changes))
    runs: dict[int, CarsRun] = {}
    before = len(asked) + 1 + len(tuned_tasks(study))
    total = before + len(pair_tasks(DRIVERS, study))

    def record(result: tuple[int, CarsRun]) -> None:
        runs[result[0]] = result[1]
        on_progress(len(runs), total, title(study, result[0]))

    # The longest first, so that no process is left alone with one.
    run_tasks(run_number, study, sorted(asked, key=lambda i: -changed(study, i).samples), workers, record)
    # By itself, so that nothing else takes time from what is measured.
    found = Found(study, {i: runs[i] for i in asked}, cost(study))
    trip, longer = (run_beside(study), growth(study)) if study.mpc else (None, ())
    on_progress(len(asked) + 1, total, "cost of a sample")
    tuned = stated_rows(study, found.stated, trip)
    left = [task for task in tuned_tasks(study) if task not in tuned]

    def keep(result: tuple[Task, dict[str, Any]]) -> None:
        tuned[result[0]] = result[1]
        on_progress(len(asked) + 1 + len(tuned), total, "stated and tuned")

    run_tasks(run_tuned, study, left, workers, keep)
    rows = [(task, tuned[task]) for task in tuned_tasks(study)]
    pairs = pairs_of(study, drawn_rows(DRIVERS, study, workers, on_progress, before))
    return StudyResult(
        rows=tuple(_row(study, i, runs[i]) for i in asked),
        tables=(*all_tables(found), *beside_tables(found, trip, longer), *tuned_table(study, rows),
                *pair_table(study, DRIVERS, pairs, WHERE)),
        plots=(*all_plots(found), *tuned_plots(study, rows)),
        findings=(*all_findings(found), *beside_findings(found, trip), *tuned_findings(study, rows),
                  *pair_findings(study, DRIVERS, pairs, WHERE)),
        failures=tuple((title(study, i), str(runs[i].failed)) for i in asked if runs[i].failed is not None))


def _row(study: ChenStudy, number: int, done: CarsRun) -> dict[str, Any]:
    """A run as data, of its last finished trial; SI units, over all cars."""
    of = changed(study, number)
    row: dict[str, Any] = {"controller": f"chen2019.{of.sampling.acceleration}", "run": title(study, number),
                           "memory": of.sampling.memory, "period_s": of.sampling.period_s, "trials": len(done.totals)}
    row |= dict.fromkeys(NUMBERS)
    if done.failed is None:
        whole, samples = of.reference.trip_time_s * of.train.cars, of.samples * of.train.cars
        row |= {f"{name}_error_{end}": float(values[-1].min() if end == "min" else values[-1].max())
                for name in ("position", "speed") for end in ("min", "max")
                for values in (done.of_cars(f"{name}_error_{end}"),)}
        row |= {f"{name}_rms": float(np.sqrt(done.total(f"{name}_error_square_s")[-1] / whole))
                for name in ("position", "speed")}
        row |= {"stopping_error": float(done.total("stopping_error_m")[-1]),
                "energy_J": float(done.total("traction_work_j")[-1]),
                "saturated_fraction": float(done.of_cars("saturated_samples")[-1].sum() / samples),
                "difference_max_N": float(difference(done)[-1]),
                "position_error_first": float(position_error(done)[0]),
                "speed_error_first": float(speed_error(done)[0])}
    return row | {"outcome": outcome(done), "step_us_median": float(np.median(done.step_us)), "failed": done.failed}


KIND = StudyKind(ChenStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
