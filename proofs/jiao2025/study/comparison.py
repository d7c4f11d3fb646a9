"""jiao2025's laws beside MPC, which knows the train and drives it once: as stated, and both tuned with one budget."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from workbench.mpc.controller import KINDS
from workbench.paper.cells import Column
from workbench.paper.comparison import STEP
from workbench.paper.drivers import MPC_NAMES, MPC_TITLES, Drivers, keys_in
from workbench.paper.learning_comparison import LearningComparison, Task, jerk_rms
from workbench.paper.mpc_comparison import MPC_KINDS
from workbench.simulate.closed_loop import NOMINAL, Factors

from ..laws import TRIAL_LAWS
from ..simulation.mpc_trip import run_mpc
from ..simulation.plans import Case, plan_on
from ..simulation.trials import TrialRun, run_trials
from .record import JiaoStudy
from .runs import PRINTED_LAWS, JiaoResults

LAW_NAMES = {law.partition(".")[2]: law for law in PRINTED_LAWS}
TITLES = {name: TRIAL_LAWS[law].title for name, law in LAW_NAMES.items()} | MPC_TITLES
STARTS = ("first_input", "first_estimate")
COLUMNS = {"speed_rms": Column("speed RMS", "m/s"), "largest_mps": Column("largest |speed error|", "m/s"),
           "jerk_rms": Column("jerk RMS", "m/s³"), "step_s": STEP}


def keys(study: JiaoStudy, name: str) -> dict[str, str]:
    """Learning parameters of a law, and what it starts from, which the laws share."""
    return keys_in("learning", (*map(str, TRIAL_LAWS[LAW_NAMES[name]].parameters), *STARTS))


def drive(study: JiaoStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """One run in a reading: MPC's only trip, or all trials of a law, of which the last is measured."""
    if name in MPC_NAMES:
        return run_mpc(study, place, MPC_NAMES[name], factors)
    made = plan_on(study, Case(place, LAW_NAMES[name], study.trials.seed), factors)
    return law_row(study, place, run_trials(replace(made, kept=(study.trials.count,))))


def law_row(study: JiaoStudy, place: str, run: TrialRun) -> dict[str, Any]:
    """The last trial of a run in a reading, and its error trial by trial; of one that failed only why."""
    row = {"failed": run.failed, "step_s": run.step_us * 1e-6}
    if run.failed is not None:
        return row
    trials = np.sqrt(run.mse)
    jerk = jerk_rms(run.sample(study.trials.count, "speed"), study.readings[place].step_s)
    return row | {"speed_rms": float(trials[-1]), "trials": {"speed_rms": trials},
                  "jerk_rms": jerk, "logged_jerk_rms": jerk,  # every sample is logged
                  "largest_mps": float(run.column("largest_error")[-1])}


def own_tasks(study: JiaoStudy) -> list[Task]:
    """What the comparison need not run again: the study's own runs of both laws as stated."""
    return [(place, name, False) for place in study.readings for name in LAW_NAMES]


def own_rows(results: JiaoResults) -> dict[Task, dict[str, Any]]:
    """The rows of `own_tasks`."""
    return {(place, name, tuned): law_row(results.study, place, results.run(place, LAW_NAMES[name]))
            for place, name, tuned in own_tasks(results.study)}


def note(study: JiaoStudy) -> str:
    """Who samples how often and knows what."""
    return (f"MPC drives the same train once, at T_s, {study.mpc.horizon} samples ahead: "
            f"{KINDS[MPC_KINDS[0]].information}; the laws: speeds of earlier trials, model unknown. Neither has limits."
            ) if study.mpc else ""


def places(study: JiaoStudy) -> dict[str, str]:
    """The readings in few words, as conditions of a comparison are called."""
    return {name: reading.condition for name, reading in study.readings.items()}


DRIVERS = Drivers(TITLES, places, keys, drive, first_trial=0)
COMPARISON = LearningComparison(DRIVERS, COLUMNS, ("speed_rms",), "reading", own_tasks, own_rows, note)
