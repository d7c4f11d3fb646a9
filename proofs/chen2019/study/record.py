"""chen2019's file as a record: train, law, reference, trials, and the runs that differ from the stated one."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from workbench.files.toml import Number, Positive, SourcedRecord, Text, Whole
from workbench.model.desired_curve import TimedCruise
from workbench.paper.checks import LearningTrials, at_most
from workbench.paper.only_full import ExtraTable
from workbench.paper.reproduced import Change, ReproducedStudy

Mass = Annotated[Number, Field(ge=1e3, le=2e5)]
Force = Annotated[Number, Field(ge=1e3, le=1e6)]
Gain = Annotated[Number, Field(gt=0, le=1e6)]
Trial = Annotated[Whole, Field(ge=1, le=1000)]
Cars = Annotated[Whole, Field(ge=2, le=256)]
# So many learned numbers fit into the memory of a small computer: 4 GB.
MOST_LEARNED = 500_000_000


class Train(SourcedRecord):
    """Table 1, and which cars have motors: a pattern of 1 (motor car) and 0 (trailer), repeated along the train."""

    cars: Cars
    motor_pattern: Text = Field(pattern=r"^[01]+$", max_length=256)
    car_mass_kg: Mass
    c_0_n_per_kg: Number = Field(ge=0, le=0.2)
    c_v_n_s_per_m_kg: Number = Field(ge=0, le=0.01)
    c_a_n_s2_per_m2_kg: Number = Field(ge=0, le=1e-3)
    coupler_n_per_m: Number = Field(ge=1e4, le=1e9)
    coupler_n_s_per_m: Number = Field(ge=0, le=1e8)
    traction_n: Force
    braking_n: Force

    def has_motor(self, car: int) -> bool:
        """Whether a car, counted from 0, is a motor car."""
        return self.motor_pattern[car % len(self.motor_pattern)] == "1"


class MassBounds(SourcedRecord):
    """Assumption 1: between what the estimates of a car's mass are kept; they start at the lower bound."""

    low_kg: Mass
    high_kg: Mass

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        at_most("low_kg", self.low_kg, "high_kg", self.high_kg)
        return self


class Gains(SourcedRecord):
    """Controller parameters and learning gains of section IV."""

    c_1: Gain
    c_2: Gain
    c_3: Gain
    gamma_v: Gain
    gamma_a: Gain
    gamma_k: Gain
    gamma_d: Gain
    gamma_eta: Gain
    gamma_M: Gain


class Trials(LearningTrials):
    """How many iterations, which of them the figures show, and where the auxiliary state starts in each."""

    count: Trial
    shown: Annotated[tuple[Trial, ...], Field(min_length=1, max_length=6)]
    lambda_1_m: Number = Field(ge=-1e3, le=1e3)
    lambda_2_mps: Number = Field(ge=-100, le=100)


class Sampling(SourcedRecord):
    """How the continuous law runs: period, the rule for the acceleration, and which error corrects an estimate."""

    period_s: Number = Field(ge=1e-5, le=0.1)
    acceleration: Literal["exact", "sampled", "filtered"]
    filter_s: Number = Field(ge=1e-5, le=10)
    memory: Literal["same_sample", "next_sample"]
    log_every_s: Number = Field(ge=1e-3, le=60)


class Line(SourcedRecord):
    """The additional resistance: a wave of slopes, and where it is read (`SLOPE_SEEN` of the trials)."""

    seen_by: Literal["nowhere", "reference", "train"]
    slope_permille: Number = Field(ge=0, le=100)
    wave_m: Number = Field(ge=100, le=1e6)
    gravity_mps2: Number = Field(ge=9.7, le=9.9)


class Variation(SourcedRecord):
    """How the coefficients of resistance and couplers vary in time: by which part of their mean, how fast."""

    swing: Number = Field(ge=0, lt=1)
    beat_s: Number = Field(ge=1, le=1e6)


class ChenChange(Change):
    """A run that differs from the stated one; group: the table in which it stands."""

    group: Literal["rules", "gains", "masses", "assumed"]


class Cost(ExtraTable):
    """Trains whose time per sample is measured."""

    cars: Annotated[tuple[Cars, ...], Field(min_length=2, max_length=20)]
    end_s: Positive
    trials: Trial


class ChenStudy(ReproducedStudy):
    """Everything that the runs of chen2019 need, with the source of every value."""

    train: Train
    mass_bounds: MassBounds
    reference: TimedCruise
    gains: Gains
    trials: Trials
    sampling: Sampling
    line: Line
    variation: Variation
    cost: Cost
    changes: tuple[ChenChange, ...] = ()

    @property
    def samples(self) -> int:
        """Samples of a trial."""
        return round(self.reference.trip_time_s / self.sampling.period_s)

    @property
    def learned(self) -> int:
        """Numbers that are learned: three per car and three for all cars, in every sample."""
        return self.samples * (3 * self.train.cars + 3)

    def check(self) -> None:
        """The trip and the log are whole numbers of samples, and what is learned fits into the memory."""
        period = self.sampling.period_s
        for key, value_s in (("reference.trip_time_s", self.reference.trip_time_s),
                             ("sampling.log_every_s", self.sampling.log_every_s)):
            if round(value_s / period) < 1 or abs(round(value_s / period) * period - value_s) > 1e-6 * period:
                raise ValueError(f"{key} = {value_s:g} is not a whole number of samples of {period:g} s: choose a "
                                 "multiple")
        if self.learned > MOST_LEARNED:
            raise ValueError(f"sampling.period_s = {period:g} asks for {self.learned / 1e6:.0f} million learned "
                             f"numbers, {8e-9 * self.learned:.1f} GB: sample more coarsely or shorten the trip")
        at_most("cost.end_s", self.cost.end_s, "reference.trip_time_s", self.reference.trip_time_s)
