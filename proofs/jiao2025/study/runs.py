"""The runs that jiao2025's study asks for, and what counts as learning in them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.learning_comparison import rises
from workbench.paper.reproduced import Change, Results, in_words
from workbench.paper.tracked import Tracked

from .. import laws
from ..laws import TRIAL_LAWS
from ..simulation.plans import Case, plan
from ..simulation.trials import TrialRun, run_trials
from .record import JiaoStudy, Shown

ICFDL, PD = PRINTED_LAWS = ("jiao2025.icfdl", "jiao2025.pd")
# By what part of the first mean squared error a law is said to have learned, or hardly to learn.
LEARNED, HARDLY = 0.01, 0.5
# By what factor the error has to come back to be said to grow again.
AGAIN = 10.0


def cases(study: JiaoStudy) -> list[Case]:
    """All runs of a study, each once: every law in every reading, changes, seeds, units."""
    seed, found = study.trials.seed, []
    for reading in study.readings:
        found += [Case(reading, law, seed) for law in TRIAL_LAWS]
        found += [Case(reading, law, seed, opposed=True) for law in PRINTED_LAWS]
    for entry in study.shown:
        found += [Case(entry.reading, entry.law, seed, number) for number, change in enumerate(study.changes)
                  if concerns(change, entry.law)]
        found += [Case(entry.reading, entry.law, seed + more) for more in range(1, study.trials.seeds)]
    found += [Case(reading, law, seed, unit_mps2=float(unit)) for reading in study.unit_sweep.readings
              for law in PRINTED_LAWS for unit in study.unit_sweep.units_mps2]
    return list(dict.fromkeys(found))


def concerns(change: Change, law_id: str) -> bool:
    """Whether a change has to do with anything that a law's run depends on."""
    law = TRIAL_LAWS[law_id]
    used = {"first_input", *map(str, law.parameters)}
    used |= {"first_estimate"} if law.next_estimate != laws.phi_first else set()
    return any(not key.startswith("learning.") or key.removeprefix("learning.") in used for key in change.set)


def run_case(study: JiaoStudy, case: Case) -> TrialRun:
    """All trials of a case."""
    return run_trials(plan(study, case))


def name_of(study: JiaoStudy, case: Case) -> str:
    """A run in words: law, reading, and what is not as stated."""
    return in_words(case.law, case.reading, "resistance against the motion" if case.opposed else None,
                    study.change_title(case.change),
                    None if case.unit_mps2 is None else f"unit of u {case.unit_mps2:.3g} m/s^2",
                    None if case.seed == study.trials.seed else f"seed {case.seed}")


@dataclass(frozen=True)
class JiaoResults(Results[JiaoStudy, Case, TrialRun]):
    """The study and its runs by what tables, figures and findings ask for."""

    def run(self, reading: str, law: str, **other: Any) -> TrialRun:
        """The run of a law in a reading; other: what of its case is not as stated."""
        return self.runs[Case(reading, law, **({"seed": self.study.trials.seed} | other))]

    def of_seeds(self, entry: Shown) -> list[TrialRun]:
        """The runs of a shown law over all seeds."""
        first = self.study.trials.seed
        return [self.run(entry.reading, entry.law, seed=first + more) for more in range(self.study.trials.seeds)]

    def title(self, entry: Shown) -> str:
        """A run as texts name it."""
        return f"{TRIAL_LAWS[entry.law].title}, u in {self.study.readings[entry.reading].label}"

    def shown(self) -> list[tuple[Shown, TrialRun]]:
        """What is shown, with its runs as stated."""
        return [(entry, self.run(entry.reading, entry.law)) for entry in self.study.shown]

    def short_readings(self) -> list[str]:
        """The readings in which k counts the samples of T_s, as (1) has it."""
        stated = min(reading.step_s for reading in self.study.readings.values())
        return [name for name, reading in self.study.readings.items()
                if reading.step_s == stated and reading.per_k == 1]


def mse_at(run: TrialRun, trial: int) -> float | None:
    """Mean squared error of a trial, m^2/s^2; None where the run had ended."""
    return float(run.mse[trial]) if trial < len(run.rows) else None


def peak(run: TrialRun) -> tuple[int, float]:
    """The trial with the largest mean squared error, and its ratio to that of trial 0."""
    trial = int(np.argmax(run.mse))
    return trial, float(run.mse[trial] / run.mse[0])


def outcome(run: TrialRun) -> str:
    """What became of a run, in a few words; the borders are LEARNED, HARDLY and AGAIN."""
    if run.failed is not None:
        return f"diverges in trial {len(run.rows)}"
    first, last, least = float(run.mse[0]), float(run.mse[-1]), float(run.mse.min())
    if last > first:
        return "ends worse than it began"
    if last <= LEARNED * first:
        return "learns"
    if last > AGAIN * least:
        return "falls, then grows again"
    return "hardly learns" if last > HARDLY * first else "learns a part"


def run_row(study: JiaoStudy, case: Case, run: TrialRun) -> dict[str, Any]:
    """A run as data; speeds in m/s, squared errors in m^2/s^2."""
    trial, ratio = peak(run) if len(run.rows) else (None, None)
    return {
        "controller": case.law, "reading": case.reading, "seed": case.seed,
        "variant": study.change_title(case.change), "unit_mps2": case.unit_mps2,
        "resistance_opposed": case.opposed, "mse_0": mse_at(run, 0),
        **{f"mse_{trial}": mse_at(run, trial) for trial in (*study.trials.compared, study.trials.count)},
        "peak_trial": trial, "peak_over_first": ratio, "trials_worse": rises(run.mse),
        "largest_speed_error": float(run.column("largest_error")[-1]) if run.failed is None else None,
        "outcome": outcome(run), "step_us_median": run.step_us, "failed": run.failed}


def track(study: JiaoStudy, curve: DesiredCurve | None) -> Tracked:
    """iCFDL in steps of 1 s, in which (16) asks for what trains can do; the last trial.

    The paper states no unit of u, and none of the study's readings follows (16) there: it is the one of the study's
    sweep in which the study's own reference is followed best.
    """
    last = study.trials.count
    every = [replace(plan(study, Case("N_1s", ICFDL, study.trials.seed, unit_mps2=float(unit))), kept=(last,))
             for unit in study.unit_sweep.units_mps2]

    def last_error(run: TrialRun) -> float:
        return math.inf if run.failed else float(run.mse[-1])

    made = min(every, key=lambda one: last_error(run_trials(one)))
    if curve:
        _, desired, _ = curve.at(np.arange(len(made.desired), dtype=float) * made.step_s)
        places = np.concatenate(([0.0], np.cumsum(desired[:-1]))) * made.step_s
        made = replace(made, desired=desired, desired_positions=places,
                       edges=made.edges / made.edges[-1] * places[-1])
    run = run_trials(made)
    length, time_s = float(made.desired_positions[-1]), (len(made.desired) - 1) * made.step_s
    name = f"iCFDL, trial {last}"
    if run.failed:
        return Tracked("jiao2025", name, time_s, length, None, None, math.nan, math.nan, math.nan, run.failed)
    speed, command = (run.sample(last, column) for column in ("speed", "input"))
    error = speed - made.desired[: len(speed)]
    work = np.maximum(command * made.unit_n, 0.0) * speed * made.step_s
    return Tracked("jiao2025", name, time_s, length, None, None, float(np.abs(error).max()),
                   math.sqrt(np.mean(error**2)), float(np.nansum(work)), None)
