"""chen2019's file as a record: train, law, reference, trials, and the runs that differ from the stated one."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, Strict, model_validator

from workbench.errors import WorkbenchError
from workbench.files.toml import Positive, SourcedRecord
from workbench.model.desired_curve import DesiredCurve, start_cruise_stop
from workbench.paper.reproduced import Change, ReproducedStudy

Mass = Annotated[float, Strict(), Field(ge=1e3, le=2e5, allow_inf_nan=False)]
Force = Annotated[float, Strict(), Field(ge=1e3, le=1e6, allow_inf_nan=False)]
Rate = Annotated[float, Strict(), Field(ge=1e-2, le=2, allow_inf_nan=False)]
Gain = Annotated[float, Strict(), Field(gt=0, le=1e6, allow_inf_nan=False)]
Trial = Annotated[int, Strict(), Field(ge=1, le=1000)]
Cars = Annotated[int, Strict(), Field(ge=2, le=256)]
# So many learned numbers fit into the memory of a small computer: 4 GB.
MOST_LEARNED = 500_000_000


class Train(SourcedRecord):
    """Table 1, and which cars have motors: a pattern of 1 (motor car) and 0 (trailer), repeated along the train."""

    cars: Cars
    motor_pattern: Annotated[str, Strict(), Field(pattern=r"^[01]+$", max_length=256)]
    car_mass_kg: Mass
    c_0_n_per_kg: Annotated[float, Strict(), Field(ge=0, le=0.2, allow_inf_nan=False)]
    c_v_n_s_per_m_kg: Annotated[float, Strict(), Field(ge=0, le=0.01, allow_inf_nan=False)]
    c_a_n_s2_per_m2_kg: Annotated[float, Strict(), Field(ge=0, le=1e-3, allow_inf_nan=False)]
    coupler_n_per_m: Annotated[float, Strict(), Field(ge=1e4, le=1e9, allow_inf_nan=False)]
    coupler_n_s_per_m: Annotated[float, Strict(), Field(ge=0, le=1e8, allow_inf_nan=False)]
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
        if self.low_kg > self.high_kg:
            raise ValueError(f"low_kg = {self.low_kg:g} is above high_kg = {self.high_kg:g}: swap them")
        return self


class Reference(SourcedRecord):
    """Accelerate, cruise, brake to a stop in a given time; changes of the acceleration take ramp_s."""

    cruise_mps: Annotated[float, Strict(), Field(ge=1, le=150, allow_inf_nan=False)]
    acceleration_mps2: Rate
    braking_mps2: Rate
    ramp_s: Annotated[float, Strict(), Field(ge=0.05, le=600, allow_inf_nan=False)]
    trip_time_s: Annotated[float, Strict(), Field(ge=1, le=1e5, allow_inf_nan=False)]

    @model_validator(mode="after")
    def _a_curve_follows(self) -> Self:
        try:
            self.curve()
        except WorkbenchError as trouble:
            raise ValueError(f"{trouble}, or allow more trip_time_s") from None
        return self

    def curve(self) -> DesiredCurve:
        """The curve of this trip time."""
        start_s, stop_s = (self.cruise_mps / rate + self.ramp_s for rate in (self.acceleration_mps2, self.braking_mps2))
        # A change of speed that is symmetric in time covers mean speed times duration.
        length_m = self.cruise_mps * (self.trip_time_s - (start_s + stop_s) / 2)
        return start_cruise_stop(length_m, self.cruise_mps, self.acceleration_mps2, self.braking_mps2, self.ramp_s)


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


class Trials(SourcedRecord):
    """How many iterations, which of them the figures show, and where the auxiliary state starts in each."""

    count: Trial
    shown: Annotated[tuple[Trial, ...], Field(min_length=1, max_length=6)]
    lambda_1_m: Annotated[float, Strict(), Field(ge=-1e3, le=1e3, allow_inf_nan=False)]
    lambda_2_mps: Annotated[float, Strict(), Field(ge=-100, le=100, allow_inf_nan=False)]

    @model_validator(mode="after")
    def _shown_trials_run(self) -> Self:
        for trial in self.shown:
            if trial > self.count:
                raise ValueError(f"shown names trial {trial}, but the last one is {self.count}: correct it")
        return self


class Sampling(SourcedRecord):
    """How the continuous law runs: period, the rule for the acceleration, and which error corrects an estimate."""

    period_s: Annotated[float, Strict(), Field(ge=1e-5, le=0.1, allow_inf_nan=False)]
    acceleration: Literal["exact", "sampled", "filtered"]
    filter_s: Annotated[float, Strict(), Field(ge=1e-5, le=10, allow_inf_nan=False)]
    memory: Literal["same_sample", "next_sample"]
    log_every_s: Annotated[float, Strict(), Field(ge=1e-3, le=60, allow_inf_nan=False)]


class Line(SourcedRecord):
    """The additional resistance: a wave of slopes, and where it is read (`SLOPE_SEEN` of the trials)."""

    seen_by: Literal["nowhere", "reference", "train"]
    slope_permille: Annotated[float, Strict(), Field(ge=0, le=100, allow_inf_nan=False)]
    wave_m: Annotated[float, Strict(), Field(ge=100, le=1e6, allow_inf_nan=False)]
    gravity_mps2: Annotated[float, Strict(), Field(ge=9.7, le=9.9, allow_inf_nan=False)]


class Variation(SourcedRecord):
    """How the coefficients of resistance and couplers vary in time: by which part of their mean, how fast."""

    swing: Annotated[float, Strict(), Field(ge=0, lt=1, allow_inf_nan=False)]
    beat_s: Annotated[float, Strict(), Field(ge=1, le=1e6, allow_inf_nan=False)]


class ChenChange(Change):
    """A run that differs from the stated one; group: the table in which it stands."""

    group: Literal["rules", "gains", "masses", "assumed"]


class Cost(SourcedRecord):
    """Trains whose time per sample is measured."""

    cars: Annotated[tuple[Cars, ...], Field(min_length=2, max_length=20)]
    end_s: Positive
    trials: Trial


class ChenStudy(ReproducedStudy):
    """Everything that the runs of chen2019 need, with the source of every value."""

    train: Train
    mass_bounds: MassBounds
    reference: Reference
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
        if self.cost.end_s > self.reference.trip_time_s:
            raise ValueError("cost.end_s is beyond reference.trip_time_s: lower it")
