"""Laws that learn from trial to trial beside MPC, which drives once: stated and tuned, and from which trial ahead."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np

from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.comparison import STEP
from workbench.paper.drivers import Drivers, entries, tuning_words
from workbench.paper.mpc_comparison import JERK, best_words
from workbench.paper.only_full import shortened
from workbench.paper.pairs import METRIC_NAMES, STATES
from workbench.paper.results import Array, Curve, Plot, ResultTable, Shown
from workbench.paper.stages import Stage
from workbench.paper.statistics import ahead_from
from workbench.paper.study_tables import ColumnOf
from workbench.simulate.closed_loop import NOMINAL

T = TypeVar("T")
# (place, controller, whether it is tuned)
Task = tuple[str, str, bool]
Rows = Mapping[Task, Mapping[str, Any]]


def jerk_rms(speeds: Array, spacing_s: float) -> float:
    """RMS of the second difference of speeds (m/s) at samples of equal spacing, along the first axis, m/s^3."""
    return float(np.sqrt(np.mean((np.diff(speeds, 2, axis=0) / spacing_s**2) ** 2)))


def rises(errors: Array) -> int:
    """In how many trials an error is larger than in the one before."""
    return int(np.sum(np.diff(errors) > 0))


def at_trials(values: Array, trials: Sequence[int], first_trial: int) -> tuple[float | None, ...]:
    """The values of some trials, of which the first has the number first_trial; None where the run had ended."""
    return tuple(float(values[trial - first_trial]) if trial - first_trial < len(values) else None for trial in trials)


def trial_columns(heading: Column, errors: Callable[[T], Array], trials: Iterable[int], first_trial: int
                  ) -> Iterator[ColumnOf[T]]:
    """For `run_table`: a column for the error of each of some trials, `at_trials`.

    errors(run): of every trial that ended, of which the first has the number first_trial.
    """
    def said(trial: int, run: T) -> Cell:
        return at_trials(errors(run), (trial,), first_trial)[0]

    for trial in trials:
        yield replace(heading, title=f"{heading.title}, trial {trial}"), partial(said, trial)


def trial_curve(label: str, errors: Array, first_trial: int) -> Curve:
    """An error along the trials, of which the first has the number first_trial."""
    return Curve(label, np.arange(len(errors), dtype=float) + first_trial, errors)


def row_cells(row: Mapping[str, Any], columns: Mapping[str, Column]) -> tuple[Cell, ...]:
    """A run's row as cells under columns by its keys; of one that failed only that it did, and the time of a step."""
    if row["failed"] is None:
        return tuple(row.get(key) for key in columns)
    return ("fails", *(row.get(key) if column is STEP else None for key, column in list(columns.items())[1:]))


def _none(study: Any) -> Sequence[Task]:
    return ()


def _no_rows(results: Any) -> Rows:
    return {}


@dataclass(frozen=True)
class LearningComparison:
    """How the learning laws of a paper are held against MPC, all driven alike by `drivers`.

    A row of `drivers.drive` has SI numbers by the keys of `columns`, and, of a law that learns, `trials`: metric ->
    its value in every trial. metrics: those of the errors by which a learner is ahead or not; place_word: what a place
    is, `reading`, empty where there is only one. own_rows(results): rows that the study's own runs give, of
    own_tasks(study), which are not run again.
    """

    drivers: Drivers
    columns: Mapping[str, Column]
    metrics: tuple[str, ...]
    place_word: str = ""
    own_tasks: Callable[[Any], Sequence[Task]] = _none
    own_rows: Callable[[Any], Rows] = _no_rows

    def tasks(self, study: Any, full: bool = False) -> list[Task]:
        """Every controller, as stated and as tuned, in the places of the tuning; none without MPC or tuning.

        full: also what a short report leaves out.
        """
        places, stated = study.tuning.places if study.tuning else (), not full and study.leaves_out(study.tuning)
        return [(place, *entry) for place in places for entry in entries(study, self.drivers)
                if not (stated and entry[1])]

    def stage(self, study: Any) -> Stage:
        """The runs of `tasks` but those of `own_tasks`."""
        done = self.own_tasks(study)
        left = [task for task in self.tasks(study) if task not in done]
        return Stage(_drive, (self.drivers, study), left, lambda task, _: "stated and tuned")

    def shown(self, results: Any, found: Rows) -> Shown:
        """Table, figures and findings; nothing without rows."""
        study, own = results.study, self.own_rows(results)
        rows = {task: found[task] if task in found else own[task] for task in self.tasks(study)}
        fewer = len(self.tasks(study, full=True)) - len(rows)
        tables = (shortened(table, fewer) for table in self.tables(study, rows))
        places = max(1, len({place for place, _, _ in rows}))
        plots = (shortened(plot, fewer // places) for plot in self.plots(study, rows))
        return Shown(tables, plots, self.findings(study, rows))

    def title(self, name: str, tuned: bool) -> str:
        """A controller as tables have it."""
        return self.drivers.titles[name] + (", tuned" if tuned else "")

    def tables(self, study: Any, rows: Rows) -> Iterator[ResultTable]:
        """A row per place and controller, stated and tuned; nothing without rows."""
        if not rows:
            return
        rivals = [name for name in self.drivers.titles if name.startswith("mpc")]
        titles, lines = self.drivers.places(study), []
        for (place, name, tuned), row in rows.items():
            ahead = [self._ahead(row, rows.get((place, rival, tuned)), metric)
                     for rival in rivals for metric in self.metrics]
            place_cells = (titles[place],) if self.place_word else ()
            lines.append((*place_cells, self.title(name, tuned), *row_cells(row, self.columns), *ahead))
        heading = [f"ahead of {self.drivers.titles[rival]} in {METRIC_NAMES[metric][0]} from"
                   for rival in rivals for metric in self.metrics]
        shorter = " The tuning's runs are shorter than these, see the file." if study.tuning.set else ""
        yield ResultTable(
            "Beside MPC, stated and tuned", "comparison",
            (*((self.place_word,) if self.place_word else ()), "controller", *self.columns.values(), *heading),
            tuple(lines), f"Of laws that learn the last of {study.trials.count} trials. {tuning_words(study.tuning)}"
            f"{shorter} A law is held against MPC in the same state, stated or tuned.")

    def _ahead(self, row: Mapping[str, Any], rival: Mapping[str, Any] | None, metric: str) -> Cell:
        if rival is None or rival["failed"] is not None or "trials" not in row:
            return None
        trial = ahead_from(row["trials"][metric], rival[metric], self.drivers.first_trial)
        return "no trial" if trial is None else Phrase("trial {}", (trial,))

    def findings(self, study: Any, rows: Rows) -> Iterator[str]:
        """Who is best, stated and tuned, and when the learners get ahead; a sentence per place and state."""
        for place in dict.fromkeys(place for place, _, _ in rows):
            for tuned, state in STATES.items():
                here = [(self.drivers.titles[name], row) for (at, name, of), row in rows.items()
                        if (at, of) == (place, tuned)]
                if here:
                    best = (best_words(here, metric, *METRIC_NAMES[metric])
                            for metric in (*self.metrics, *(name for name in JERK if name in self.columns)))
                    where = f"{self.place_word} {place}, {state}" if self.place_word else state
                    words = "; ".join((*best, *self._learned(here, study.trials.count)))
                    yield f"{where[0].upper()}{where[1:]}: {words}."

    def _learned(self, here: Sequence[tuple[str, Mapping[str, Any]]], count: int) -> Iterator[str]:
        for name, row in here:
            for rival, other in here:
                if "trials" not in row or "trials" in other or other["failed"] is not None:
                    continue
                for metric in self.metrics:
                    trial = ahead_from(row["trials"][metric], other[metric], self.drivers.first_trial)
                    error = f" in {METRIC_NAMES[metric][0]}" if len(self.metrics) > 1 else ""
                    yield (f"{name} is ahead of {rival}{error} from trial {trial} on" if trial is not None else
                           f"{name} does not get ahead of {rival}{error} in {count} trials")

    def plots(self, study: Any, rows: Rows) -> Iterator[Plot]:
        """Errors along the trials, stated and tuned, and MPC's as level lines; a figure per place and metric."""
        titles = self.drivers.places(study)
        for place in dict.fromkeys(place for place, _, _ in rows):
            for metric in self.metrics:
                curves = []
                for (at, name, tuned), row in rows.items():
                    if at == place and row["failed"] is None:
                        errors = row["trials"][metric] if "trials" in row else np.full(2, row[metric])
                        trials = np.linspace(self.drivers.first_trial, float(study.trials.count), len(errors))
                        curves.append(Curve(self.title(name, tuned), trials, errors))
                if curves:
                    name, unit = METRIC_NAMES[metric]
                    error = f", {name.removesuffix(' RMS')}" if len(self.metrics) > 1 else ""
                    yield Plot(f"Learning beside MPC{error}, stated and tuned",
                               f"not in the paper; {titles[place]}" if self.place_word else "not in the paper", "trial",
                               f"{name} ({unit})", tuple(curves), "MPC drives once: level lines.", log_y=True)


def _drive(shared: tuple[Drivers, Any], task: Task) -> Mapping[str, Any]:
    (drivers, study), (place, name, tuned) = shared, task
    return drivers.drive(drivers.tuned(study, name) if tuned else study, name, place, NOMINAL)
