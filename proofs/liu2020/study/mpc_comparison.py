"""liu2020's trip driven by MPC: the same train, line and disturbances beside the paper's laws, stated and tuned."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.files.numbers import number
from workbench.mpc.controller import KINDS
from workbench.paper.drivers import MPC_NAMES, entries, tuning_words
from workbench.paper.mpc_comparison import HEADER, best_words, cells, counters_words, error_plot
from workbench.paper.results import Plot, ResultTable

from ..laws import LAWS
from .drivers import DRIVERS, LAW_NAMES, drive_column
from .record import LiuStudy


@dataclass(frozen=True)
class Task:
    """A controller (an MPC's kind or a law, with its column of Table 2) under a disturbance.

    tuned: by what name the file states what was found for it, where it runs with that.
    """

    controller: str
    disturbance: str
    column: int | None = None
    tuned: str | None = None

    @property
    def title(self) -> str:
        """As tables have it."""
        if self.tuned:
            return f"{self.plain}, tuned"
        return self.plain if self.column is None else f"{self.plain}, Value {self.column}"

    @property
    def plain(self) -> str:
        """The controller without its gains."""
        return (KINDS if self.column is None else LAWS)[self.controller].title

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
    found = [name for name, tuned in entries(study, DRIVERS) if tuned]
    tasks = []
    for push in study.disturbances:
        for name, law in LAW_NAMES.items():
            tasks += [Task(law, push, column) for column in columns]
            tasks += [Task(law, push, study.table_4_column, name)] if name in found else []
        for name, kind in MPC_NAMES.items():
            tasks += [Task(kind, push), *([Task(kind, push, tuned=name)] if name in found else [])]
    return tasks


def run_one(study: LiuStudy, task: Task) -> Beside:
    """The run of a task."""
    driven = DRIVERS.tuned(study, task.tuned) if task.tuned else study
    return task, *drive_column(driven, task.controller, task.column, task.disturbance)


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
        f"the laws every {study.sampling.period_s:g} s, without limits as in the paper. MPC counted "
        f"{counters_words([counters for *_, counters in runs])}."
        + (f" {tuning_words(study.tuning)} The tuning's line is shorter than this one, see the file."
           if study.tuning else ""))


def beside_findings(study: LiuStudy, runs: Sequence[Beside]) -> Iterator[str]:
    """Who is nearest where, a sentence a disturbance for all as stated and one for all as tuned."""
    for push, stated in study.disturbances.items() if runs else ():
        for state, words in ((False, "as stated"), (True, "tuned")):
            rows = [(task.plain if state else task.title, row) for task, row, _ in runs
                    if task.disturbance == push and bool(task.tuned) == state]
            if rows:
                yield (f"Beside MPC, {stated.title}, {words}: {best_words(rows, 'position_rms', 'position RMS')} m; "
                       f"{best_words(rows, 'speed_rms', 'speed RMS')} m/s; "
                       f"{best_words(rows, 'jerk_rms', 'jerk RMS')} m/s³.")
    steps = [row["step_us_median"] for task, row, _ in runs if task.column is None]
    if steps:
        yield f"A step of MPC takes {number(min(steps))} to {number(max(steps))} µs here."


def beside_plots(study: LiuStudy, runs: Sequence[Beside]) -> Iterator[Plot]:
    """Position errors over time under Table 3's disturbance, stated and tuned."""
    chosen = [(task.title, row) for task, row, _ in runs if task.disturbance == study.runs.table_3_disturbance
              and task.column in (None, study.table_4_column)]
    yield from error_plot(chosen, study.disturbances[study.runs.table_3_disturbance].title)
