"""Laws that learn from trial to trial beside MPC, which drives once: stated and tuned, and from which trial ahead."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np

from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.comparison import STEP
from workbench.paper.drivers import Drivers, tuning_words
from workbench.paper.mpc_comparison import JERK, best_words, counters_words
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


def _no_words(study: Any) -> str:
    return ""


@dataclass(frozen=True)
class LearningComparison:
    """How the learning laws of a paper are held against MPC, all driven alike by `drivers`.

    A row of `drivers.drive` has SI numbers by the keys of `columns`; of a law that learns, `trials`, metric -> its
    value in every trial, and, where that is shown, `first`, the row of its first trial; of MPC, what it counted as
    `counters`. metrics: those of the errors by which a learner is ahead or not; place_word: what a place is, `reading`,
    empty where there is only one. own_rows(results): rows that the study's own runs give, of own_tasks(study), which
    are not run again. note(study): for the table, who samples how often and knows what.
    """

    drivers: Drivers
    columns: Mapping[str, Column]
    metrics: tuple[str, ...]
    place_word: str = ""
    own_tasks: Callable[[Any], Sequence[Task]] = _none
    own_rows: Callable[[Any], Rows] = _no_rows
    note: Callable[[Any], str] = _no_words

    def tasks(self, study: Any, full: bool = False) -> list[Task]:
        """Every controller as stated in every place, and as tuned in those of the tuning; none without MPC.

        full: also what a short report leaves out.
        """
        tuned = study.tuning is not None and (full or not study.leaves_out(study.tuning))
        return [] if study.mpc is None else [
            (place, name, state) for place in self.drivers.places(study) for name in self.drivers.titles
            for state in (False, True)
            if not state or (tuned and place in study.tuning.places and name in study.tuning.found)]

    def studied(self, study: Any) -> tuple[str, ...]:
        """The places that sentences and figures are about one by one: those of the tuning, else the first."""
        return study.tuning.places if study.tuning else tuple(self.drivers.places(study))[:1]

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
        plots = (shortened(plot, fewer // len(self.studied(study))) for plot in self.plots(study, rows))
        return Shown(tables, plots, self.findings(study, rows))

    def title(self, name: str, tuned: bool) -> str:
        """A controller as tables have it."""
        return self.drivers.titles[name] + (", tuned" if tuned else "")

    @property
    def _rivals(self) -> list[str]:
        return [name for name in self.drivers.titles if name.startswith("mpc")]

    def tables(self, study: Any, rows: Rows) -> Iterator[ResultTable]:
        """A row per place and controller, stated and tuned, and one of its first trial; nothing without rows."""
        if not rows:
            return
        titles, lines = self.drivers.places(study), list[tuple[Cell, ...]]()
        for (place, name, tuned), row in rows.items():
            ahead = [self._ahead(row, rows.get((place, rival, tuned)), metric)
                     for rival in self._rivals for metric in self.metrics]
            place_cells, title = (titles[place],) if self.place_word else (), self.title(name, tuned)
            if "first" in row:
                lines.append((*place_cells, f"{title}, trial {self.drivers.first_trial}",
                              *row_cells(row["first"], self.columns), *(None for _ in ahead)))
            lines.append((*place_cells, title, *row_cells(row, self.columns), *ahead))
        heading = [f"ahead of {self.drivers.titles[rival]} in {METRIC_NAMES[metric][0]} from"
                   for rival in self._rivals for metric in self.metrics]
        yield ResultTable(
            f"Beside MPC, {self._states(study)}", "comparison",
            (*((self.place_word,) if self.place_word else ()), "controller", *self.columns.values(), *heading),
            tuple(lines), self._note(study, rows))

    @staticmethod
    def _states(study: Any) -> str:
        return "stated and tuned" if study.tuning else "stated"

    def _note(self, study: Any, rows: Rows) -> str:
        counted = [row["counters"] for row in rows.values() if row.get("counters")]
        tuned = (f"{tuning_words(study.tuning)} A law is held against MPC in the same state, stated or tuned."
                 if study.tuning else "")
        return " ".join(part for part in (
            f"Of laws that learn the last of {study.trials.count} trials.", self.note(study),
            f"MPC counted {counters_words(counted)}." if counted else "", tuned) if part)

    def _ahead(self, row: Mapping[str, Any], rival: Mapping[str, Any] | None, metric: str) -> Cell:
        if rival is None or rival["failed"] is not None or "trials" not in row:
            return None
        trial = ahead_from(row["trials"][metric], rival[metric], self.drivers.first_trial)
        return "no trial" if trial is None else Phrase("trial {}", (trial,))

    def findings(self, study: Any, rows: Rows) -> Iterator[str]:
        """Who is best, stated and tuned, and when the learners get ahead, a sentence per place of `studied` and state.

        Then one per learner and metric over all places, where there are several.
        """
        for place in self.studied(study):
            for tuned, state in STATES.items():
                here = [(self.drivers.titles[name], row) for (at, name, of), row in rows.items()
                        if (at, of) == (place, tuned)]
                if here:
                    best = (best_words(here, metric, *METRIC_NAMES[metric])
                            for metric in (*self.metrics, *(name for name in JERK if name in self.columns)))
                    where = f"{self.place_word} {place}, {state}" if self.place_word else state
                    words = "; ".join((*best, *self._learned(here, study.trials.count)))
                    yield f"{where[0].upper()}{where[1:]}: {words}."
        places = self.drivers.places(study)
        for name in self.drivers.titles if rows and len(places) > 1 else ():
            for metric in self.metrics if name not in self._rivals else ():
                yield self._everywhere(study, rows, name, metric)

    def _everywhere(self, study: Any, rows: Rows, name: str, metric: str) -> str:
        """In how many places a learner as stated gets ahead of each MPC, and when."""
        places, words = self.drivers.places(study), []
        ended = [place for place in places if rows[place, name, False]["failed"] is None]
        for rival in self._rivals:
            when = (ahead_from(rows[place, name, False]["trials"][metric], rows[place, rival, False][metric],
                               self.drivers.first_trial)
                    for place in ended if rows[place, rival, False]["failed"] is None)
            ahead = sorted(trial for trial in when if trial is not None)
            words.append(f"{self.drivers.titles[rival]} in {len(ahead)}" + (
                f" (at trials {', '.join(map(str, ahead))})" if ahead else ""))
        return (f"Beside MPC, which knows the train and drives it once, in {METRIC_NAMES[metric][0]}: "
                f"{self.drivers.titles[name]} finishes in {len(ended)} of {len(places)} {self.place_word}s and "
                f"overtakes {' and '.join(words)} of them within {study.trials.count} trials.")

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
        for place in self.studied(study):
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
                    yield Plot(f"Learning beside MPC{error}, {self._states(study)}",
                               f"not in the paper; {titles[place]}" if self.place_word else "not in the paper", "trial",
                               f"{name} ({unit})", tuple(curves), "MPC drives once: level lines.", log_y=True)


def _drive(shared: tuple[Drivers, Any], task: Task) -> Mapping[str, Any]:
    (drivers, study), (place, name, tuned) = shared, task
    return drivers.drive(drivers.tuned(study, name) if tuned else study, name, place, NOMINAL)
