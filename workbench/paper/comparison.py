"""Laws and MPC side by side in all places of a study, as stated and as tuned: their runs, table, findings, plot."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.files.numbers import number
from workbench.files.units import KWH_J
from workbench.mpc.controller import KINDS
from workbench.paper.cells import Cell, Column
from workbench.paper.drivers import MPC_NAMES, Drivers, tuning_words
from workbench.paper.mpc_comparison import best_words, counters_words
from workbench.paper.only_full import shortened
from workbench.paper.results import Curve, Plot, ResultTable, Shown
from workbench.paper.stages import Stage
from workbench.simulate.closed_loop import NOMINAL

STEP = Column("time a step", "µs", 1e-6)
COLUMNS = (Column("position RMS", "m"), Column("speed RMS", "m/s"), Column("largest |position error|", "m"),
           Column("stopping error", "m"), Column("energy", "kWh", KWH_J), Column("jerk RMS", "m/s³"),
           Column("saturated"), STEP)
# Points of an error over time that is drawn.
DRAWN = 200


@dataclass(frozen=True)
class Task:
    """A controller in a place: in a variant of what is stated (see `Drivers.variants`), or as tuned."""

    place: str
    name: str
    variant: str = ""
    tuned: bool = False


@dataclass(frozen=True)
class ComparedRun:
    """A run of the comparison: whose it is, and its row with the keys of `workbench compare`.

    title: the controller as sentences have it; row: also `curve`, its position error, and `counters`, what MPC counted.
    """

    task: Task
    title: str
    row: Mapping[str, Any]

    @property
    def label(self) -> str:
        """The controller as tables and figures have it."""
        return f"{self.title}, tuned" if self.task.tuned else self.title


def _no_cases(study: Any) -> Mapping[Task, Hashable]:
    return {}


def _no_words(study: Any) -> str:
    return ""


def _as_run(results: Any, runs: Sequence[ComparedRun]) -> list[ComparedRun]:
    return list(runs)


@dataclass(frozen=True)
class TripComparison:
    """How the laws of a paper that drive a trip once are held against MPC, all driven alike by `drivers`.

    heading: what a place is; period_s(study): how often laws sample; drawn(study, runs): which of them a figure shows,
    and where they drive, in words; told: see `comparison_table`; note(study): what else its note says;
    with_own(results, runs): the runs, and what the study itself has run beside them; own_cases(study): those of
    `comparison_tasks` that the study itself runs, by its cases, whose runs are `TripRun`.
    """

    drivers: Drivers
    heading: str
    period_s: Callable[[Any], float]
    drawn: Callable[[Any, Sequence[ComparedRun]], tuple[list[ComparedRun], str]]
    told: Mapping[str, str] | None = None
    note: Callable[[Any], str] = _no_words
    with_own: Callable[[Any, Sequence[ComparedRun]], list[ComparedRun]] = _as_run
    own_cases: Callable[[Any], Mapping[Task, Hashable]] = _no_cases

    def stage(self, study: Any) -> Stage:
        """The runs of `comparison_tasks` but those of `own_cases`."""
        return comparison_stage(self.drivers, study, self.own_cases(study))

    def shown(self, results: Any, found: Mapping[Task, Mapping[str, Any]]) -> Shown:
        """Table, figure and findings; nothing without MPC."""
        study, drivers = results.study, self.drivers
        rows = {**found, **{task: results.runs[case].compared for task, case in self.own_cases(study).items()}}
        tasks = comparison_tasks(drivers, study)
        fewer = compared_runs(drivers, {task: {} for task in comparison_tasks(drivers, study, full=True)
                                        if task not in tasks})
        runs = self.with_own(results, compared_runs(drivers, {task: rows[task] for task in tasks}))
        note = comparison_note(study, runs, self.period_s(study), self.note(study)) if runs else ""
        tables = comparison_table(drivers, study, runs, self.heading, note, self.told)
        undrawn = len(self.drawn(study, fewer)[0])
        return Shown((shortened(table, len(fewer)) for table in tables),
                     (shortened(plot, undrawn) for plot in comparison_plot(*self.drawn(study, runs))),
                     comparison_findings(drivers, study, runs))


def _none(*_: Any) -> dict[str, Any]:
    return {}


# Of a study that holds no law against MPC.
ALONE = TripComparison(Drivers({}, _none, _none, _none), "", lambda study: 0.0, lambda study, runs: ([], ""))


def comparison_tasks(drivers: Drivers, study: Any, full: bool = False) -> list[Task]:
    """In every place every controller as stated and, where anything was found for it, as tuned; none without MPC.

    full: also what a short report leaves out.
    """
    found = study.tuning.found if study.tuning and (full or not study.leaves_out(study.tuning)) else {}
    return [] if study.mpc is None else [
        task for place in drivers.places(study) for name in drivers.titles
        for task in (*(Task(place, name, variant) for variant in drivers.variants(study, name)),
                     *((Task(place, name, tuned=True),) if name in found else ()))]


def comparison_stage(drivers: Drivers, study: Any, done: Collection[Task] = ()) -> Stage:
    """The runs of `comparison_tasks` but those that are done, as a stage of the study; MPC, of which most is to be
    compiled, begins."""
    places = drivers.places(study)
    return Stage(_drive, (drivers, study), [task for task in comparison_tasks(drivers, study) if task not in done],
                 lambda task, _: f"{places[task.place]}, {drivers.titles[task.name]}",
                 work=lambda task: float(task.name in MPC_NAMES))


def _drive(shared: tuple[Drivers, Any], task: Task) -> Mapping[str, Any]:
    drivers, study = shared
    driven = drivers.tuned(study, task.name) if task.tuned else drivers.variants(study, task.name)[task.variant]
    return drivers.drive(driven, task.name, task.place, NOMINAL)


def compared_runs(drivers: Drivers, results: Mapping[Task, Mapping[str, Any]]) -> list[ComparedRun]:
    """The rows of tasks as runs, in their order."""
    return [ComparedRun(task, drivers.titles[task.name] + task.variant, row) for task, row in results.items()]


def comparison_table(drivers: Drivers, study: Any, runs: Sequence[ComparedRun], heading: str, note: str,
                     told: Mapping[str, str] | None = None) -> Iterator[ResultTable]:
    """A row per run; nothing without runs. heading: what a place is, left out of the words for it.

    told: controller -> what it may know, of the laws, for a column of its own.
    """
    if not runs:
        return
    informed = {name: KINDS[kind].information for name, kind in MPC_NAMES.items()} | dict(told or {})
    places = drivers.places(study)
    rows = [(places[run.task.place].removeprefix(f"{heading} "), run.label,
             *((informed[run.task.name],) if told else ()), *_cells(run.row)) for run in runs]
    yield ResultTable("Beside MPC", "comparison",
                      (heading, "controller", *(("is told",) if told else ()), *COLUMNS), tuple(rows), note)


def _cells(row: Mapping[str, Any]) -> tuple[Cell, ...]:
    step_s = row["step_us_median"] * STEP.si
    if row["failed"] is not None:
        return ("fails", *(None for _ in COLUMNS[1:-1]), step_s)
    largest = max(abs(row["position_error_min"]), abs(row["position_error_max"]))
    return (row["position_rms"], row["speed_rms"], largest, row["stopping_error"], row["energy_J"], row["jerk_rms"],
            row["saturated_fraction"], step_s)


def comparison_note(study: Any, runs: Sequence[ComparedRun], law_period_s: float, told: str = "") -> str:
    """For the table: what MPC plans with and counted, how often laws without limits sample, what was tuned.

    told: who knows what, a sentence.
    """
    data = study.mpc
    parts = (f"MPC every {data.period_s:g} s, {data.horizon} samples ahead, limits of {data.max_traction_mps2:g} m/s², "
             f"the laws every {law_period_s:g} s, without limits as in the paper.", told,
             f"MPC counted {counters_words([run.row.get('counters', {}) for run in runs])}.",
             tuning_words(study.tuning) if study.tuning else "")
    return " ".join(part for part in parts if part)


def comparison_findings(drivers: Drivers, study: Any, runs: Sequence[ComparedRun]) -> Iterator[str]:
    """Who is nearest where, a sentence a place for all as stated and one for all as tuned; what a step of MPC takes."""
    for place, where in drivers.places(study).items():
        for tuned, state in ((False, "as stated"), (True, "tuned")):
            rows = [(run.title, run.row) for run in runs if (run.task.place, run.task.tuned) == (place, tuned)]
            if rows:
                yield (f"Beside MPC, {where}, {state}: {best_words(rows, 'position_rms', 'position RMS', 'm')}; "
                       f"{best_words(rows, 'speed_rms', 'speed RMS', 'm/s')}; "
                       f"{best_words(rows, 'jerk_rms', 'jerk RMS', 'm/s³')}.")
    steps = [run.row["step_us_median"] for run in runs if run.task.name in MPC_NAMES]
    if steps:
        yield f"A step of MPC takes {number(min(steps))} to {number(max(steps))} µs here."


def comparison_plot(runs: Sequence[ComparedRun], where: str) -> Iterator[Plot]:
    """|Position error| over time of all runs that finish; nothing without any.

    The largest of each stretch is drawn: on a logarithmic scale all zeros between would hide the rest.
    """
    curves = []
    for run in runs:
        if run.row["failed"] is None:
            time, error = run.row["curve"].x, run.row["curve"].y
            parts = np.array_split(np.arange(len(error)), min(len(error), DRAWN))
            largest = np.array([np.abs(error[part]).max() for part in parts])
            curves.append(Curve(run.label, np.array([time[part[0]] for part in parts]), largest))
    if curves:
        yield Plot(f"Position error beside MPC, {where}", "not in the paper", "time (s)", "|position error| (m)",
                   tuple(curves), f"The largest of each of {DRAWN} stretches.", log_y=True)
