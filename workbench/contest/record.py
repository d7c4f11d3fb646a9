"""What a contest's file states: the scenario, the conditions, seeds, tuning, each value with its source."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import Field, PrivateAttr, Strict, model_validator

from workbench.errors import InputError
from workbench.files.toml import Count, Name, NonNegative, Positive, SourcedRecord, Text
from workbench.model.sensing import SpeedFrom
from workbench.model.tuning import Searched, Seed
from workbench.paper.study import Study
from workbench.trains.actuator import Actuator
from workbench.trains.periods import at_periods, for_all_periods
from workbench.trains.scenario import ControllerSpec, Interval, Scenario

Spread = Annotated[float, Strict(), Field(ge=0, lt=1, allow_inf_nan=False)]
Share = Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)]


class Condition(SourcedRecord):
    """One way in which the world differs from what controllers know; all else is the scenario's.

    spread: mass, Davis coefficients and the line's resistance are drawn from 1 - spread to 1 + spread; level: the line
    has no grades. failed_share of the motors give failure_n (in all) from failure_from_s on. Noise, delays and odometer
    are those of `sensing.py`, with the odometer's scale drawn from 1 - odometer_spread to 1 + odometer_spread; what is
    not stated is as in the scenario. force_share: of traction and braking limits that is left, known to the
    controllers. period_s: at which all sample, instead of each at its own; a multiple of the plant's step. actuator:
    instead of the scenario's; direct: with none, whatever the scenario states.
    """

    title: Text
    spread: Spread = 0.0
    level: Annotated[bool, Strict()] = False
    failed_share: Annotated[float, Strict(), Field(ge=0, lt=1, allow_inf_nan=False)] = 0.0
    failure_n: float = 0.0
    failure_from_s: NonNegative = 0.0
    position_noise_m: NonNegative = 0.0
    speed_noise_mps: NonNegative = 0.0
    measurement_delay_s: NonNegative = 0.0
    command_delay_s: NonNegative = 0.0
    position_quantum_m: NonNegative = 0.0
    odometer_spread: Annotated[float, Strict(), Field(ge=0, le=0.2, allow_inf_nan=False)] = 0.0
    balise_spacing_m: NonNegative = 0.0
    speed_from: SpeedFrom = "tachometer"
    actuator: Actuator | None = None
    direct: Annotated[bool, Strict()] = False
    force_share: Share = 1.0
    period_s: Interval | None = None

    @property
    def random(self) -> bool:
        """Whether a run depends on its seed."""
        return bool(self.spread or self.position_noise_m or self.speed_noise_mps or self.odometer_spread)

    @model_validator(mode="after")
    def _one_actuator_or_none(self) -> Self:
        if self.direct and self.actuator is not None:
            raise ValueError("direct = true has no actuator: leave one of the two out")
        return self

    def acting(self, scenario: Scenario) -> Actuator | None:
        """The actuator under this condition."""
        return None if self.direct else self.actuator or scenario.actuator


class Objective(SourcedRecord):
    """What tuning minimises: the sum of each root mean square over its unit; a failed run costs `failed`."""

    position_m: Positive
    speed_mps: Positive
    jerk_mps3: Positive
    failed: Positive


class WithoutCurve(SourcedRecord):
    """What tuning minimises for who follows no curve: the sum of each over its unit; a failed run costs `failed`."""

    energy_j: Positive
    stopping_m: Positive
    late_s: Positive
    overspeed_mps: Positive
    jerk_mps3: Positive
    failed: Positive


class Tuning(Searched):
    """The budget that every controller gets: runs, seed of the search, condition and draws of the runs.

    ranges: of initial values too. without_curve: the objective of who follows no curve, needed where there is one.
    """

    condition: Name
    draws: Count
    objective: Objective
    without_curve: WithoutCurve | None = None


class Contest(Study):
    """A contest: its scenario's file (relative to this one), seeds, conditions and tuning.

    entrants: who takes part beside the scenario's controllers; absent: laws that do not, and why.
    """

    scenario: Text
    seeds: Count
    seed: Seed
    resamples: Count
    confidence: Annotated[float, Strict(), Field(gt=0.5, lt=1, allow_inf_nan=False)]
    source: dict[str, Text]
    conditions: dict[Name, Condition]
    tuning: Tuning
    entrants: dict[Name, ControllerSpec] = Field(default_factory=dict)
    absent: dict[Name, Text] = Field(default_factory=dict)
    _world: Scenario | None = PrivateAttr(default=None)

    @model_validator(mode="before")
    @classmethod
    def _an_entrant_at_each_of_its_periods(cls, data: Any) -> Any:
        if not (isinstance(data, dict) and "entrants" in data):
            return data
        return data | {"entrants": at_periods(data["entrants"], "entrants")}

    @property
    def world(self) -> Scenario:
        """The scenario with all who take part; InputError before `with_world` has given it."""
        if self._world is None:
            raise InputError("", "scenario", "has not been read: load the contest from its file")
        return self._world

    def with_world(self, world: Scenario) -> Self:
        """The contest with its scenario and all who take part in it; ranges hold for all periods of a name."""
        ranges = for_all_periods(self.tuning.ranges, world.controllers)
        found = self.model_copy(update={"tuning": self.tuning.model_copy(update={"ranges": ranges})})
        found._world = world
        return found

    @model_validator(mode="after")
    def _names_exist(self) -> Self:
        if not self.conditions:
            raise ValueError("conditions: none given: add a [conditions.<name>] table")
        if self.tuning.condition not in self.conditions:
            raise ValueError(f"tuning.condition: '{self.tuning.condition}' is no condition: choose one of "
                             f"{', '.join(self.conditions)}")
        return self


