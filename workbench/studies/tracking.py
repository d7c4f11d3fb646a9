"""Each paper's main controller on a reference that is given, or on the study's own: errors and energy side by side."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from workbench.curve_table import Row, TableCurve, curve_through
from workbench.desired_curve import DesiredCurve
from workbench.errors import InputError
from workbench.metrics import measure
from workbench.scenario import Scenario, load_scenario
from workbench.simulate.cars_trials import run_cars
from workbench.simulate.closed_loop import Run, run_law, simulate
from workbench.simulate.trials import TrialPlan, TrialRun, run_trials
from workbench.studies import chen2019_runs, jiao2025_cases, liu2020_runs, mao2018_numbers, mao2018_runs
from workbench.studies.chen2019_record import ChenStudy
from workbench.studies.jiao2025_cases import Case as JiaoCase
from workbench.studies.jiao2025_cases import JiaoStudy
from workbench.studies.liu2020_record import LiuStudy
from workbench.studies.mao2018_record import MaoStudy
from workbench.studies.registry import is_study, load_study

Rows = tuple[Row, ...] | None


@dataclass(frozen=True)
class Tracked:
    """How a controller follows a reference, its own where rows are None.

    Position errors in m (None where the paper's law tracks speed alone), speed errors in m/s, root mean squares over
    the run and over all cars; energy_j: work of traction at the wheel. Of laws that learn, the last trial counts.
    failed: why the run ended early, else None; its numbers are NaN then.
    """

    paper: str
    controller: str
    trip_time_s: float
    length_m: float
    largest_position_m: float | None
    position_rms_m: float | None
    largest_speed_mps: float
    speed_rms_mps: float
    energy_j: float
    failed: str | None


def track(path: Path, rows: Rows = None) -> Tracked:
    """Run the main controller of a scenario or study on its own reference, or on that of the rows of a table.

    Raises InputError for a file of a paper that has no run here.
    """
    if not is_study(path):
        return _scenario(load_scenario(path), rows)
    study = load_study(path)
    curve = curve_through(rows) if rows else None
    for record, run in _STUDIES.items():
        if isinstance(study, record):
            return run(study, curve)
    raise InputError(path, "paper", f"has no main controller here: choose one of {', '.join(_PAPERS)}")


def _scenario(scenario: Scenario, rows: Rows) -> Tracked:
    if rows:
        why = dict.fromkeys(("kind", "file"), "convention: given")
        table = TableCurve(kind="table", file="given", source=why).model_copy(update={"rows": rows})
        scenario = scenario.model_copy(update={"reference": table})
    name = next(iter(scenario.controllers))
    run, curve = simulate(scenario, name), scenario.desired_curve()
    found = measure(run, scenario)
    largest = max(abs(found.speed_error_min), abs(found.speed_error_max))
    return Tracked(scenario.paper, name, curve.trip_time_s, curve.length_m, found.largest_position_error,
                   found.position_rms, largest, found.speed_rms, found.energy_J, run.failed)


def _of_run(paper: str, run: Run, curve: DesiredCurve, work_unit: float = 1.0) -> Tracked:
    total, samples = run.totals, max(1.0, run.totals["samples"])
    whole = math.nan if run.failed else 1.0

    def largest(name: str) -> float:
        return max(abs(total[f"{name}_error_min"]), abs(total[f"{name}_error_max"]))

    def rms(name: str) -> float:
        return whole * math.sqrt(total[f"{name}_error_square_sum"] / samples)

    return Tracked(paper, run.controller, curve.trip_time_s, curve.length_m, whole * largest("position"),
                   rms("position"), whole * largest("speed"), rms("speed"),
                   whole * work_unit * total["traction_work_j"], run.failed)


def _mao(study: MaoStudy, curve: DesiredCurve | None) -> Tracked:
    """The healthy train of case 1 under the first tuning."""
    case, tuning = study.cases[0], next(iter(study.tunings.values()))
    setting = mao2018_numbers.setting_of(study, case, tuning)
    setting = replace(setting, curve=curve or setting.curve)
    law = mao2018_runs.law_of(case, ())
    run = run_law(law, mao2018_runs.values_of(law, study, case, tuning), setting, tuning.period_s,
                  study.law.estimates, title=law.title, plant=mao2018_runs.laws.train)
    return _of_run("mao2018", replace(run, controller=law.id), setting.curve)


def _liu(study: LiuStudy, curve: DesiredCurve | None) -> Tracked:
    """The last column of Table 2 with the signs corrected; the networks stay where the study puts them."""
    law = liu2020_runs.paper.LAWS["liu2020.corrected"]
    setting = liu2020_runs.setting_of(study, study.runs.table_3_disturbance)
    if curve:
        setting = replace(setting, curve=curve, end_s=curve.trip_time_s)
    run = run_law(law, liu2020_runs.law_values(study, law, study.table_4_column), setting, study.sampling.period_s,
                  "explicit", plant=liu2020_runs.of_train.model())
    return _of_run("liu2020", replace(run, controller=f"{law.id}, Value {study.table_4_column}"), setting.curve)


def _chen(study: ChenStudy, curve: DesiredCurve | None) -> Tracked:
    """The stated run; the last of its trials."""
    curve = curve or study.reference.curve()
    times = np.arange(study.samples, dtype=float) * study.sampling.period_s
    plan = replace(chen2019_runs.plan(study), reference=np.stack(curve.at(times), axis=1), kept=())
    run = run_cars(plan)
    if run.failed:
        nan = math.nan
        return Tracked("chen2019", "AILC", curve.trip_time_s, curve.length_m, nan, nan, nan, nan, nan, run.failed)
    whole = study.reference.trip_time_s * study.train.cars

    def largest(name: str) -> float:
        return float(max(np.abs(run.of_cars(f"{name}_error_{end}")[-1]).max() for end in ("min", "max")))

    def rms(name: str) -> float:
        return math.sqrt(run.total(f"{name}_error_square_s")[-1] / whole)

    return Tracked("chen2019", f"AILC, trial {plan.trials}", curve.trip_time_s, curve.length_m, largest("position"),
                   rms("position"), largest("speed"), rms("speed"), float(run.total("traction_work_j")[-1]), None)


def _jiao(study: JiaoStudy, curve: DesiredCurve | None) -> Tracked:
    """iCFDL in steps of 1 s, in which (16) asks for what trains can do; the last trial.

    The paper states no unit of u, and none of the study's readings follows (16) there: it is the one of the study's
    sweep in which the study's own reference is followed best.
    """
    every = [_jiao_plan(study, float(unit)) for unit in study.unit_sweep.units_mps2]
    made = min(every, key=lambda plan: _last_error(run_trials(plan)))
    if curve:
        _, desired, _ = curve.at(np.arange(len(made.desired), dtype=float) * made.step_s)
        places = np.concatenate(([0.0], np.cumsum(desired[:-1]))) * made.step_s
        made = replace(made, desired=desired, desired_positions=places,
                       edges=made.edges / made.edges[-1] * places[-1])
    run = run_trials(made)
    length, time_s = float(made.desired_positions[-1]), (len(made.desired) - 1) * made.step_s
    name = f"iCFDL, trial {study.trials.count}"
    if run.failed:
        return Tracked("jiao2025", name, time_s, length, None, None, math.nan, math.nan, math.nan, run.failed)
    speed, command = (run.sample(study.trials.count, column) for column in ("speed", "input"))
    error = speed - made.desired[: len(speed)]
    work = np.maximum(command * made.unit_n, 0.0) * speed * made.step_s
    return Tracked("jiao2025", name, time_s, length, None, None, float(np.abs(error).max()),
                   math.sqrt(np.mean(error**2)), float(np.nansum(work)), None)


def _jiao_plan(study: JiaoStudy, unit_mps2: float) -> TrialPlan:
    case = JiaoCase("N_1s", "jiao2025.icfdl", study.trials.seed, unit_mps2=unit_mps2)
    return replace(jiao2025_cases.plan(study, case), kept=(study.trials.count,))


def _last_error(run: TrialRun) -> float:
    return math.inf if run.failed else float(run.column("mse")[-1])


_STUDIES: dict[type, Callable[..., Tracked]] = {
    ChenStudy: _chen, JiaoStudy: _jiao, LiuStudy: _liu, MaoStudy: _mao}
_PAPERS = ("chen2019", "jiao2025", "liu2020", "mao2018", "yang2021")
