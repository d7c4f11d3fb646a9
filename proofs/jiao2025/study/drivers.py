"""jiao2025's laws and MPC with one tuning budget: in a reading, as stated and as tuned."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from workbench.files.numbers import NOTHING, number
from workbench.mpc.controller import KINDS
from workbench.paper.drivers import MPC_NAMES, Drivers, entries, tuning_words
from workbench.paper.mpc_comparison import best_words
from workbench.paper.results import Curve, Plot, ResultTable
from workbench.simulate.closed_loop import NOMINAL, Factors

from ..laws import TRIAL_LAWS
from ..simulation.trials import run_trials
from .cases import PRINTED_LAWS, Case, JiaoStudy
from .mpc_comparison import jerk_rms, run_one, true_plan

LAW_NAMES = {law.partition(".")[2]: law for law in PRINTED_LAWS}
TITLES = {name: TRIAL_LAWS[law].title for name, law in LAW_NAMES.items()} | {
    name: KINDS[kind].title for name, kind in MPC_NAMES.items()}
STARTS = ("first_input", "first_estimate")

# (reading, controller, whether it is tuned)
Task = tuple[str, str, bool]


def places(study: JiaoStudy) -> tuple[str, ...]:
    """The readings."""
    return tuple(study.readings)


def stated(study: JiaoStudy, name: str) -> dict[str, float]:
    """Learning parameters of a law, and what it starts from; an estimate that is a word is no number to tune."""
    keys = (*map(str, TRIAL_LAWS[LAW_NAMES[name]].parameters), *STARTS)
    values = {key: getattr(study.learning, key) for key in keys}
    return {key: float(value) for key, value in values.items() if not isinstance(value, str)}


def given(study: JiaoStudy, name: str, values: Mapping[str, float]) -> JiaoStudy:
    """The study with other learning parameters; the laws share what they start from."""
    return study.model_copy(update={"learning": study.learning.model_copy(update=dict(values))})


def drive(study: JiaoStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """One run in a reading: MPC's only trip, or all trials of a law, of which the last is measured."""
    if name in MPC_NAMES:
        one = run_one(study, (place, MPC_NAMES[name]), factors)
        return {"failed": None, "speed_rms": one.mse**0.5, "jerk_rms": one.jerk, "largest_mps": one.largest_mps,
                "step_us": one.step_us}
    last = study.trials.count
    made = replace(true_plan(study, Case(place, LAW_NAMES[name], study.trials.seed), factors), kept=(last,))
    run = run_trials(made)
    if run.failed is not None:
        return {"failed": run.failed, "step_us": run.step_us}
    trials = np.sqrt(run.column("mse"))
    return {"failed": None, "speed_rms": float(trials[-1]), "trials": {"speed_rms": trials},
            "jerk_rms": jerk_rms(run.sample(last, "speed"), made.step_s),
            "largest_mps": float(run.column("largest_error")[-1]), "step_us": run.step_us}


DRIVERS = Drivers(TITLES, places, stated, given, drive)


def tuned_tasks(study: JiaoStudy) -> list[Task]:
    """Every controller, as stated and as tuned, in the readings of the tuning."""
    chosen = study.tuning.places if study.tuning else ()
    return [(place, *entry) for place in chosen for entry in entries(study, DRIVERS)]


def run_tuned(study: JiaoStudy, task: Task) -> tuple[Task, dict[str, Any]]:
    """The run of a task."""
    place, name, tuned = task
    return task, drive(DRIVERS.tuned(study, name) if tuned else study, name, place)


def title_of(name: str, tuned: bool) -> str:
    """A controller as tables have it."""
    return TITLES[name] + (", tuned" if tuned else "")


def ahead_from(trials: np.ndarray[Any, np.dtype[np.float64]], rival: float) -> int | None:
    """The trial, from 0, from which on all errors are below a rival's, None where there is none."""
    above = np.nonzero(trials >= rival)[0]
    first = int(above[-1]) + 1 if len(above) else 0
    return first if first < len(trials) else None


Rows = Sequence[tuple[Task, Mapping[str, Any]]]


def tuned_table(study: JiaoStudy, runs: Rows) -> Iterator[ResultTable]:
    """A row per reading and controller, stated and tuned; nothing without tuning."""
    if not runs or study.tuning is None:
        return
    rows = []
    for (place, name, tuned), row in runs:
        words = ["fails" if row["failed"] is not None else number(row["speed_rms"]),
                 *(number(row.get(key)) for key in ("largest_mps", "jerk_rms", "step_us"))]
        for rival in MPC_NAMES:
            words.append(_overtakes(row, dict(runs).get((place, rival, tuned))))
        rows.append((study.readings[place].title, title_of(name, tuned), *words))
    yield ResultTable(
        "Beside MPC, stated and tuned", "comparison",
        ("reading", "controller", "speed RMS (m/s)", "largest |speed error| (m/s)", "jerk RMS (m/s³)", "µs a step",
         *(f"ahead of {KINDS[kind].title} in speed RMS from" for kind in MPC_NAMES.values())), tuple(rows),
        f"Of laws that learn the last of {study.trials.count} trials. {tuning_words(study.tuning)} A law is held "
        "against MPC in the same state, stated or tuned.")


def _overtakes(row: Mapping[str, Any], rival: Mapping[str, Any] | None) -> str:
    if rival is None or "trials" not in row:
        return NOTHING
    trial = ahead_from(row["trials"]["speed_rms"], rival["speed_rms"])
    return "no trial" if trial is None else f"trial {trial}"


def tuned_findings(study: JiaoStudy, runs: Rows) -> Iterator[str]:
    """Who is best, stated and tuned, and when the learners get ahead."""
    for place in dict.fromkeys(task[0] for task, _ in runs):
        for tuned in (False, True):
            rows = [(TITLES[name], row) for (at, name, state), row in runs if (at, state) == (place, tuned)]
            if not rows:
                continue
            learned = list(_learned(rows, study.trials.count))
            yield (f"Reading {place}, {'tuned' if tuned else 'as stated'}: "
                   f"{best_words(rows, 'speed_rms', 'speed RMS')} m/s; {best_words(rows, 'jerk_rms', 'jerk RMS')} "
                   f"m/s³; {'; '.join(learned)}.")


def _learned(rows: Sequence[tuple[str, Mapping[str, Any]]], count: int) -> Iterator[str]:
    for name, row in rows:
        for rival, other in rows:
            if "trials" in row and "trials" not in other and other["failed"] is None:
                trial = ahead_from(row["trials"]["speed_rms"], other["speed_rms"])
                yield (f"{name} is ahead of {rival} from trial {trial} on" if trial is not None else
                       f"{name} does not get ahead of {rival} in {count} trials")


def tuned_plots(study: JiaoStudy, runs: Rows) -> Iterator[Plot]:
    """Speed RMS along the trials, stated and tuned, and MPC's as level lines; a figure per reading."""
    for place in dict.fromkeys(task[0] for task, _ in runs):
        curves = []
        for (at, name, tuned), row in runs:
            if at != place or row["failed"] is not None:
                continue
            errors = row["trials"]["speed_rms"] if "trials" in row else np.full(2, row["speed_rms"])
            last = float(study.trials.count)
            curves.append(Curve(title_of(name, tuned), np.linspace(0.0, last, len(errors)), errors))
        if curves:
            yield Plot("Learning beside MPC, stated and tuned", f"not in the paper; {study.readings[place].title}",
                       "trial", "speed RMS (m/s)", tuple(curves), "MPC drives once: level lines.", log_y=True)
