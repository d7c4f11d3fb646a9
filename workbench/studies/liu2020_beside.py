"""liu2020's trip driven by MPC: the same train, line and disturbances beside the paper's laws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.controllers.liu2020 import LAWS
from workbench.metrics import measure_run
from workbench.mpc.controller import KINDS
from workbench.report.numbers import number
from workbench.simulate.closed_loop import run_law
from workbench.studies.base import ResultTable
from workbench.studies.beside_mpc import HEADER, KINDS_BESIDE, best_words, cells, counters_words, known, run_beside
from workbench.studies.liu2020_record import LiuStudy
from workbench.studies.liu2020_runs import davis_newton, law_values, of_train, setting_of

# What stands beside MPC: the laws with their signs corrected, by speed and by the position alone.
BESIDE = ("liu2020.corrected", "liu2020.position_only")


@dataclass(frozen=True)
class Task:
    """A controller (an MPC's kind or a law, with its column of Table 2) under a disturbance."""

    controller: str
    disturbance: str
    column: int | None = None

    @property
    def title(self) -> str:
        """As tables have it."""
        if self.column is None:
            return KINDS[self.controller].title
        return f"{LAWS[self.controller].title}, Value {self.column}"

    @property
    def information(self) -> str:
        """What it may know."""
        return (KINDS[self.controller] if self.column is None else LAWS[self.controller]).information


Beside = tuple[Task, dict[str, Any], dict[str, int]]


def beside_tasks(study: LiuStudy) -> list[Task]:
    """Every controller under every disturbance; none where the file states no MPC."""
    if study.mpc is None:
        return []
    columns = dict.fromkeys((study.table_4_column - 1 or 1, study.table_4_column))
    laws = [(law, column) for law in BESIDE for column in columns]
    return [Task(name, push, column) for push in study.disturbances
            for name, column in (*laws, *((kind, None) for kind in KINDS_BESIDE))]


def run_one(study: LiuStudy, task: Task) -> Beside:
    """One run; MPC knows mass and general resistance, chi among them, and neither slopes nor disturbances."""
    setting, plant = setting_of(study, task.disturbance), of_train.model()
    if task.column is not None:
        law = LAWS[task.controller]
        run = run_law(law, law_values(study, law, task.column), setting, study.sampling.period_s, "explicit",
                      plant=plant)
    else:
        data, mass = study.mpc, study.train.mass_kg / study.train.chi
        assert data is not None
        nominal = known(data, setting.curve, mass, davis_newton(study.train), setting.end_s)
        run = run_beside(nominal, task.controller, setting, plant)
    return task, measure_run(run, study.line.length_m).row(), run.counters


def beside_table(study: LiuStudy, runs: Sequence[Beside]) -> Iterator[ResultTable]:
    """A row per disturbance and controller; nothing where no MPC ran."""
    if not runs or study.mpc is None:
        return
    data = study.mpc
    rows = [(study.disturbances[task.disturbance].title, task.title, task.information, *cells(row))
            for task, row, _ in runs]
    yield ResultTable(
        "Beside MPC", "comparison", ("disturbance", "controller", "is told", *HEADER), tuple(rows),
        f"MPC every {data.period_s:g} s, {data.horizon} samples ahead, limits of {data.max_traction_mps2:g} m/s², "
        f"the laws without limits as in the paper. MPC counted "
        f"{counters_words([counters for *_, counters in runs])}.")


def beside_findings(study: LiuStudy, runs: Sequence[Beside]) -> Iterator[str]:
    """Who is nearest where, a sentence a disturbance."""
    for push, stated in study.disturbances.items() if runs else ():
        rows = [(task.title, row) for task, row, _ in runs if task.disturbance == push]
        yield (f"Beside MPC, {stated.title}: {best_words(rows, 'position_rms', 'position RMS')} m; "
               f"{best_words(rows, 'jerk_rms', 'jerk RMS')} m/s³.")
    steps = [row["step_us_median"] for task, row, _ in runs if task.column is None]
    if steps:
        yield f"A step of MPC takes {number(min(steps))} to {number(max(steps))} µs here."
