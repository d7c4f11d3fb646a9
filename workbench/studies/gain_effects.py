"""Found gains in their paper's own simulation, beside the stated ones, with the same metrics."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from workbench.controllers import mao2018_leakage
from workbench.controllers.mao2018_laws import KINDS, failure_law, train
from workbench.gains.registry import gains_of
from workbench.gains.result import GainReport
from workbench.metrics import measure, measure_run
from workbench.scenario import Variant, load_scenario, load_variant
from workbench.simulate.cars_trials import run_cars
from workbench.simulate.closed_loop import run_law, simulate
from workbench.simulate.trials import run_trials
from workbench.studies import chen2019_found, jiao2025_cases, jiao2025_found
from workbench.studies.base import Progress, with_values
from workbench.studies.chen2019_record import ChenStudy
from workbench.studies.chen2019_runs import plan as cars_plan
from workbench.studies.jiao2025_cases import JiaoStudy
from workbench.studies.liu2020_record import LiuStudy
from workbench.studies.liu2020_runs import Case as LiuCase
from workbench.studies.liu2020_runs import run_case
from workbench.studies.mao2018_numbers import initial, parameters, setting_of
from workbench.studies.mao2018_record import MaoStudy
from workbench.studies.registry import is_study, load_study
from workbench.workers import cores, run_tasks

Row = dict[str, float | str | None]


@dataclass(frozen=True)
class Task:
    """One run: of which gains (`stated`, or a found set's name), in which setting, with which keys of the file changed.

    setting: in words what else decides the run; values: what its paper's runner needs beside the changes.
    """

    gains: str
    setting: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Effect:
    """What a run gave: SI units; None for a number that a failed run does not have, which `failed` explains."""

    gains: str
    setting: str
    numbers: Row
    failed: str | None


def checked_gains(path: Path, proofs: Path | None = None) -> GainReport:
    """The gains of a paper's file, once the file is known to be whole; InputError naming file, key and remedy."""
    if is_study(path):
        load_study(path)
    else:
        load_scenario(path)
    return gains_of(path, proofs)


def effects(path: Path, report: GainReport, workers: int | None = None,
            on_progress: Progress = lambda done, total, what: None) -> tuple[Effect, ...]:
    """Every found set of gains beside the stated ones, in the order of `tasks_of`."""
    tasks = tasks_of(report)
    found: dict[int, Effect] = {}

    def record(result: tuple[int, Effect]) -> None:
        found[result[0]] = result[1]
        on_progress(len(found), len(tasks), result[1].gains)

    run_tasks(_run, (report.paper, path), list(enumerate(tasks)), workers or cores(), record)
    return tuple(found[number] for number in range(len(tasks)))


def tasks_of(report: GainReport) -> list[Task]:
    """The runs of a paper: each setting first with the stated gains, then with those found for it."""
    return _TASKS[report.paper](report)


def _run(shared: tuple[str, Path], numbered: tuple[int, Task]) -> tuple[int, Effect]:
    (paper, path), (number, task) = shared, numbered
    numbers, failed = _RUNS[paper](path, task)
    kept: Row = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in numbers.items()}
    return number, Effect(task.gains, task.setting, kept, failed)


def _plainly(report: GainReport, setting: str) -> list[Task]:
    return [Task("stated", setting), *(Task(s.name, setting, s.changes) for s in report.found)]


def _of(report: GainReport, name: str) -> Mapping[str, Any]:
    return next(s.changes for s in report.found if s.name == name)


# --- chen2019 -------------------------------------------------------------------------------------------------------


def _chen(path: Path, task: Task) -> tuple[Row, str | None]:
    study = load_study(path)
    assert isinstance(study, ChenStudy)
    changed = with_values(study.model_copy(update={"changes": ()}), task.changes, str(path))
    run = run_cars(replace(cars_plan(changed), kept=()))
    if not len(run.totals):
        return {}, run.failed
    position, speed = chen2019_found.position_error(run), chen2019_found.speed_error(run)
    whole = changed.reference.trip_time_s * changed.train.cars
    return {
        "position_error_first": float(position[0]), "position_error_last": float(position[-1]),
        "speed_error_first": float(speed[0]), "speed_error_last": float(speed[-1]),
        "position_rms": float(np.sqrt(run.total("position_error_square_s")[-1] / whole)),
        "speed_rms": float(np.sqrt(run.total("speed_error_square_s")[-1] / whole)),
        "bound_used": bound_used(run, changed), "outcome": chen2019_found.outcome(run)}, run.failed


def bound_used(run: Any, study: ChenStudy) -> float:
    """The largest part, over all trials, that the position errors fill of 2 int z_1^2 + 2 gain^2 int Delta u^2."""
    gains = study.gains
    gain = gains.c_3 / (gains.c_1 * gains.c_2)
    bound = 2 * run.total("z_1_square_s") + 2 * gain**2 * run.total("difference_square_s")
    return float(np.max(run.total("position_error_square_s") / bound))


# --- yang2021 -------------------------------------------------------------------------------------------------------

_CONTROLLER = "rbfnn_pocrac"


def _yang_tasks(report: GainReport) -> list[Task]:
    tasks = []
    for period_s in (0.001, 0.02, 0.1):
        sampled = {f"controllers.{_CONTROLLER}.period_s": period_s}
        setting = f"sampled at {1e3 * period_s:g} ms"
        tasks += [replace(t, changes={**t.changes, **sampled}) for t in _plainly(report, setting)]
    return tasks


def _yang(path: Path, task: Task) -> tuple[Row, str | None]:
    scenario = load_variant(path, Variant(title=task.gains, set=dict(task.changes)))
    found = measure(simulate(scenario, _CONTROLLER), scenario)
    return {name: getattr(found, name) for name in (
        "largest_position_error", "speed_error_min", "speed_error_max", "position_rms", "speed_rms", "stopping_error",
        "energy_J", "jerk_rms", "command_max")}, found.failed


# --- liu2020 --------------------------------------------------------------------------------------------------------


def _liu_tasks(report: GainReport) -> list[Task]:
    tasks = []
    for found in report.found:
        column = int(found.note.removeprefix("column "))
        tasks += [Task(name, f"in place of Value {column}", changes, {"column": column})
                  for name, changes in (("stated", {}), (found.name, found.changes))]
    return tasks


def _liu(path: Path, task: Task) -> tuple[Row, str | None]:
    study = load_study(path)
    assert isinstance(study, LiuStudy)
    changed = with_values(study.model_copy(update={"changes": ()}), task.changes, str(path))
    law = "liu2020.corrected_rate"  # the observer that the certificates are of
    found = run_case(changed, LiuCase(task.values["column"], law, study.runs.table_3_disturbance))
    names = ("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps", "energy_J", "reversals")
    return {f"{n}_rms" if n not in ("energy_J", "reversals") else n: found.numbers.get(n) for n in names}, found.failed


# --- mao2018 --------------------------------------------------------------------------------------------------------

_CASE, _TUNING = 5, "scaled"
SETTLED_S = 20.0  # from when on the error at the start is over


def _mao_tasks(report: GainReport) -> list[Task]:
    leak = float(next(s.values["leak"] for s in report.found if s.name == "leakage"))
    setting = f"case {_CASE}, signs corrected"
    return [Task("stated", setting), Task("damping", setting, _of(report, "damping")),
            Task("leakage", setting, _of(report, "leakage"), {"leak": leak}),
            Task("leakage alone", setting, {}, {"leak": leak})]


def _mao(path: Path, task: Task) -> tuple[Row, str | None]:
    study = load_study(path)
    assert isinstance(study, MaoStudy)
    changed = study.changed(dict(task.changes))
    case, tuning = changed.cases[_CASE - 1], changed.tunings[_TUNING]
    law = failure_law("damped", KINDS["damped"][-1])
    named, start = parameters(changed, case, tuning), initial(changed, case)
    if "leak" in task.values:
        law, named = mao2018_leakage.leaky(law), named | {"leak": task.values["leak"]}
    values = (np.array([named[str(s)] for s in law.parameters]),
              np.array([start[str(s.symbol)] for s in law.scalar_states]), np.zeros((0, 0)), np.zeros((0, 0)))
    run = run_law(law, values, setting_of(changed, case, tuning), tuning.period_s, changed.law.estimates,
                  plant=train)
    found = measure_run(run, float(changed.reference.curve().length_m))
    late = run.column("t_s") >= SETTLED_S
    error = (run.column("s_m") - run.column("s_desired_m"))[late]
    return {"position_rms": found.position_rms, "speed_rms": found.speed_rms,
            "settled_position_rms": float(np.sqrt(np.mean(error**2))) if found.failed is None else None,
            "settled_position_error": float(np.abs(error).max()) if found.failed is None else None,
            "stopping_error": found.stopping_error, "jerk_rms": found.jerk_rms}, found.failed


# --- jiao2025 -------------------------------------------------------------------------------------------------------

_LAWS = {"monotone": "jiao2025.fixed_estimate", "monotone_any": "jiao2025.icfdl",
         "difference": "jiao2025.pd_difference"}
_READING = "kN"
_REPEATED = {"line.seen_by": "desired", "trials.shortest_length_k": 1999}  # what the certified maps suppose


def _jiao_tasks(report: GainReport) -> list[Task]:
    tasks = []
    for found in report.found:
        law = _LAWS[found.name]
        setting = f"{law}, u in {_READING}"
        tasks += [Task("stated", setting, {}, {"law": law}), Task(found.name, setting, found.changes, {"law": law})]
    difference = {"law": _LAWS["difference"]}
    setting = f"{difference['law']}, u in {_READING}, full trials with the same resistance"
    tasks += [Task(name, setting, {**changes, **_REPEATED}, difference)
              for name, changes in (("stated", {}), ("difference", _of(report, "difference")))]
    return [*tasks, Task("stated", f"jiao2025.pd, u in {_READING}", {}, {"law": "jiao2025.pd"})]


def _jiao(path: Path, task: Task) -> tuple[Row, str | None]:
    study = load_study(path)
    assert isinstance(study, JiaoStudy)
    change = jiao2025_cases.Change(title=task.gains, set=dict(task.changes))
    changed = jiao2025_cases.changed(study, change)
    run = run_trials(jiao2025_cases.plan(changed, jiao2025_cases.Case(
        _READING, task.values["law"], changed.trials.seed)))
    mse = jiao2025_found.mse(run)
    numbers: Row = {f"mse_{n}": float(mse[n]) if n < len(mse) else None
                    for n in (0, *changed.trials.compared, changed.trials.count)}
    numbers |= {"trials_worse": jiao2025_found.rises(run), "outcome": jiao2025_found.outcome(run)}
    return numbers, run.failed


_TASKS: dict[str, Callable[[GainReport], list[Task]]] = {
    "chen2019": lambda report: _plainly(report, "as stated"), "jiao2025": _jiao_tasks, "liu2020": _liu_tasks,
    "mao2018": _mao_tasks, "yang2021": _yang_tasks}
_RUNS: dict[str, Callable[[Path, Task], tuple[Row, str | None]]] = {
    "chen2019": _chen, "jiao2025": _jiao, "liu2020": _liu, "mao2018": _mao, "yang2021": _yang}
