"""What the runs of jiao2025 gave, by reading and law, and what of it counts as learning."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from workbench.files.numbers import NOTHING, number

from ..laws import TRIAL_LAWS
from ..simulation.trials import Array, TrialRun
from .cases import Case, JiaoStudy, Shown

# By what part of the first mean squared error a law is said to have learned, or hardly to learn.
LEARNED, HARDLY = 0.01, 0.5
# By what factor the error has to come back to be said to grow again.
AGAIN = 10.0


@dataclass(frozen=True)
class Found:
    """The study and its runs."""

    study: JiaoStudy
    runs: Mapping[Case, TrialRun]

    def run(self, reading: str, law: str, opposed: bool = False) -> TrialRun:
        """The run of a law in a reading, all else as stated."""
        return self.runs[Case(reading, law, self.study.trials.seed, opposed=opposed)]

    def of_seeds(self, entry: Shown) -> list[TrialRun]:
        """The runs of a shown law over all seeds."""
        first = self.study.trials.seed
        return [self.runs[Case(entry.reading, entry.law, first + more)] for more in range(self.study.trials.seeds)]

    def title(self, reading: str, law: str) -> str:
        """A run as texts name it."""
        return f"{TRIAL_LAWS[law].title}, u in {self.study.readings[reading].label}"

    def short_readings(self) -> list[str]:
        """The readings in which k counts the samples of T_s, as (1) has it."""
        stated = min(reading.step_s for reading in self.study.readings.values())
        return [name for name, reading in self.study.readings.items()
                if reading.step_s == stated and reading.per_k == 1]


def mse(run: TrialRun) -> Array:
    """Mean squared error of every trial that ended, in m^2/s^2."""
    return run.column("mse")


def at(run: TrialRun, trial: int) -> str:
    """Mean squared error of a trial as a text; a dash where the run had ended."""
    return number(float(mse(run)[trial])) if trial < len(run.rows) else NOTHING


def ended(run: TrialRun) -> int:
    """The trial in which a run diverged, or how many there are."""
    return len(run.rows)


def rises(run: TrialRun) -> int:
    """In how many trials the mean squared error is larger than in the one before."""
    return int(np.sum(np.diff(mse(run)) > 0))


def peak(run: TrialRun) -> tuple[int, float]:
    """The trial with the largest mean squared error, and its ratio to that of trial 0."""
    trial = int(np.argmax(mse(run)))
    return trial, float(mse(run)[trial] / mse(run)[0])


def outcome(run: TrialRun) -> str:
    """What became of a run, in a few words; the borders are LEARNED, HARDLY and AGAIN."""
    if run.failed is not None:
        return f"diverges in trial {ended(run)}"
    first, last, least = float(mse(run)[0]), float(mse(run)[-1]), float(mse(run).min())
    if last > first:
        words = "ends worse than it began"
    elif last <= LEARNED * first:
        words = "learns"
    elif last > AGAIN * least:
        words = "falls, then grows again"
    else:
        words = "hardly learns" if last > HARDLY * first else "learns a part"
    return words
