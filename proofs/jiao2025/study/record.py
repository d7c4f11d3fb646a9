"""jiao2025's study.toml as a record: train, line, trials, learning, the readings of its units, and what is varied."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from workbench.files.toml import Name, Number, Positive, Record, SourcedRecord, Text, Whole
from workbench.paper.checks import LearningTrials, at_most, increasing, one_of
from workbench.paper.reproduced import ReproducedStudy
from workbench.paper.results import Array

from ..laws import TRIAL_LAWS

Trial = Annotated[Whole, Field(ge=1, le=10_000)]
Share = Annotated[Number, Field(gt=0, le=1)]


def _estimate(value: Any) -> Any:
    number = isinstance(value, float) and 0 < value <= 1e6
    if not number and value != "derivative":
        raise ValueError(f"{value!r} is neither a number with a point, above 0 and up to 1e6, nor \"derivative\"")
    return value


# What (14) and (15) start from: a number in m/s per unit of u, or dv(k+1)/du(k) of the reading.
Estimate = Annotated[float | str, BeforeValidator(_estimate)]


class Train(SourcedRecord):
    """The mass, and what (17) is divided by: nothing ("newton"), or M as it is printed ("as_printed")."""

    mass_kg: Number = Field(ge=1e3, le=1e8)
    resistance: Literal["newton", "as_printed"]


class Section(Record):
    """A section of the line up to a fraction of its length."""

    end_fraction: Share
    grade_permille: Number = Field(ge=-100, le=100)


class Line(SourcedRecord):
    """Grades along the desired trip, and at which position they are met (`SEEN_BY` of the trial loop)."""

    seen_by: Literal["train", "desired", "stretched"]
    sections: Annotated[tuple[Section, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _sections_follow_each_other(self) -> Self:
        increasing("sections: end_fraction", (section.end_fraction for section in self.sections))
        if self.sections[-1].end_fraction != 1.0:
            raise ValueError("sections: the last end_fraction must be 1: correct it")
        return self


class Trials(LearningTrials):
    """How many trials, of which lengths (in the k of (16)), and which of them the figures show."""

    SHOWN = ("compared", "line_shown")
    count: Trial
    desired_length_k: Whole = Field(ge=1601, le=2000)
    shortest_length_k: Whole = Field(ge=1, le=1999)
    compared: Annotated[tuple[Trial, ...], Field(min_length=1)]
    line_shown: tuple[Trial, ...]
    seed: Whole = Field(ge=0)
    seeds: Whole = Field(ge=2, le=1000)

    @model_validator(mode="after")
    def _lengths_are_drawn_from_above_the_shortest(self) -> Self:
        at_most("shortest_length_k", self.shortest_length_k, "desired_length_k - 1", self.desired_length_k - 1)
        return self


class Learning(SourcedRecord):
    """Table 1, u(k,0) and phi_hat(k,1); all in units of u of the reading."""

    rho: Share
    lamda: Positive
    mu: Positive
    eta: Share
    epsilon: Positive
    K_p: Positive
    K_d: Positive
    first_input: Number
    first_estimate: Estimate
    kept_estimate: Estimate


class Reading(SourcedRecord):
    """A unit of u (in N) and a meaning of k: how long a step of (1) is, and how much k grows in it."""

    title: Text
    unit: Text
    unit_n: Number = Field(ge=1e-3, le=1e8)
    step_s: Number = Field(ge=1e-3, le=10)
    k_per_sample: Number = Field(ge=1e-2, le=1)

    @property
    def per_k(self) -> int:
        """Samples in one k."""
        return round(1 / self.k_per_sample)

    @property
    def label(self) -> str:
        """A few words for legends: the unit and the length of a step, and that there are more steps than k."""
        return f"{self.unit} at {self.step_s:g} s" + (f", {self.per_k} steps a k" if self.per_k > 1 else "")

    @property
    def condition(self) -> str:
        """The unit and the length of a step, as words that stand alone: `u in N, steps of 0.1 s`."""
        return f"u in {self.unit}, steps of {self.step_s:g} s" + (f", {self.per_k} a k" if self.per_k > 1 else "")

    @model_validator(mode="after")
    def _whole_samples(self) -> Self:
        if abs(self.per_k * self.k_per_sample - 1) > 1e-9:
            raise ValueError(f"k_per_sample = {self.k_per_sample:g} is no whole part of 1: choose 1, 0.5 or "
                             "0.1, for instance")
        return self


class Shown(Record):
    """A run whose curves, seeds and sensitivity are shown."""

    reading: Name
    law: Text


class UnitSweep(SourcedRecord):
    """Units of u between two accelerations per unit, evenly on a logarithmic scale."""

    readings: tuple[Name, ...]
    lowest_mps2: Positive
    highest_mps2: Positive
    count: Whole = Field(ge=2, le=1000)

    @property
    def units_mps2(self) -> Array:
        """m/s^2 per unit of u."""
        return np.geomspace(self.lowest_mps2, self.highest_mps2, self.count)


class JiaoStudy(ReproducedStudy):
    """Everything that the runs of jiao2025 need, with the source of every value."""

    train: Train
    line: Line
    trials: Trials
    learning: Learning
    readings: dict[Name, Reading]
    shown: tuple[Shown, ...]
    unit_sweep: UnitSweep

    def check(self) -> None:
        """Readings and laws that are named are there."""
        for entry in self.shown:
            one_of("shown", "reading", entry.reading, self.readings)
            one_of("shown", "law", entry.law, TRIAL_LAWS)
        for name in self.unit_sweep.readings:
            one_of("unit_sweep.readings", "reading", name, self.readings)
