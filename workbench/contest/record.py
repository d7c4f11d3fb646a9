"""What a contest's file states: the scenario, the conditions, seeds, tuning, each value with its source."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Field, PrivateAttr, Strict, model_validator

from workbench.errors import InputError
from workbench.files.toml import Count, Lateness, Name, NonNegative, Positive, SourcedRecord, Text
from workbench.model.sensing import SpeedFrom
from workbench.model.tuning import Searched, SearchResult, Seed
from workbench.paper.study import Study
from workbench.trains.actuator import Actuator
from workbench.trains.periods import at_periods, for_all_periods, period_name, without_period
from workbench.trains.scenario import ControllerSpec, Interval, Scenario

Spread = Annotated[float, Strict(), Field(ge=0, lt=1, allow_inf_nan=False)]
Share = Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)]
# Fewer draws than these are never told apart at 95 per cent by a sign test.
FEWEST_DRAWS = 6
# Of a search for which no budget is stated.
EVALUATIONS = 400


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
    measurement_delay_s: Lateness = 0.0
    command_delay_s: Lateness = 0.0
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
    """What tuning minimises: the sum of each over its unit, of those that are given; a failed run costs `failed` each.

    position_m, speed_mps: root mean squares of the errors; ride_jerk_mps3: of the jerk at every plant step; jerk_mps3:
    of the log's rows alone; comfort_mps2: by ISO 2631; variation_mps3: of the command; energy_j: of traction.
    """

    failed: Positive
    position_m: Positive | None = None
    speed_mps: Positive | None = None
    jerk_mps3: Positive | None = None
    ride_jerk_mps3: Positive | None = None
    comfort_mps2: Positive | None = None
    variation_mps3: Positive | None = None
    energy_j: Positive | None = None

    @model_validator(mode="after")
    def _something_is_minimised(self) -> Self:
        if not self.units:
            raise ValueError("states no unit: give at least one of position_m, speed_mps, ride_jerk_mps3, comfort_mps2")
        return self

    @property
    def units(self) -> dict[str, float]:
        """Metric of a match -> its unit, of those that count."""
        of = {"position_rms": self.position_m, "speed_rms": self.speed_mps, "logged_jerk_rms": self.jerk_mps3,
              "jerk_rms": self.ride_jerk_mps3, "comfort_rms": self.comfort_mps2,
              "command_variation": self.variation_mps3, "energy_J": self.energy_j}
        return {name: unit for name, unit in of.items() if unit is not None}


class WithoutCurve(SourcedRecord):
    """What tuning minimises for who follows no curve: the sum of each over its unit; a failed run costs `failed`."""

    energy_j: Positive
    stopping_m: Positive
    late_s: Positive
    overspeed_mps: Positive
    ride_jerk_mps3: Positive
    failed: Positive

    @property
    def units(self) -> dict[str, float]:
        """Metric of a match -> its unit."""
        return {"energy_J": self.energy_j, "stopping_error": self.stopping_m, "late_s": self.late_s,
                "overspeed_mps": self.overspeed_mps, "jerk_rms": self.ride_jerk_mps3}


class Tuning(Searched):
    """The budget that every controller gets: seed of the search, condition and draws of the runs.

    mode: "condition" minimises the mean over the draws of one condition; "per condition" does so for each, with
    parameters of their own; "minimax" minimises the largest of these means. conditions: those of "minimax"; all without
    it. runs: of each search in all; without it EVALUATIONS evaluations, each as many runs as it needs.
    evaluations_of: of those whose runs take long, how many instead. ranges: of initial values too. without_curve: the
    objective of who follows no curve, needed where there is one. found_in, results_in: of "per condition", condition ->
    what was found.
    """

    runs: Annotated[int, Strict(), Field(ge=0)] = 0
    restarts: Count = 3
    evaluations_of: dict[Name, Count] = Field(default_factory=dict)
    condition: Name
    draws: Count
    mode: Literal["condition", "per condition", "minimax"] = "condition"
    conditions: tuple[Name, ...] = ()
    objective: Objective
    without_curve: WithoutCurve | None = None
    found_in: dict[Name, dict[Name, dict[str, Positive]]] = Field(default_factory=dict)
    results_in: dict[Name, dict[Name, SearchResult]] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _found_fits(self) -> Self:
        for condition, tables in self.found_in.items():
            self.check_found(tables, f"found_in.{condition}")
        return self


class Racing(SourcedRecord):
    """Draws are added until everyone is told apart from the best, or `seeds` are reached.

    first: draws of the first round; step: of every other; metrics: whose rankings decide.
    """

    first: Count
    step: Count
    metrics: Annotated[tuple[Text, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _enough_to_say_anything(self) -> Self:
        if self.first < FEWEST_DRAWS:
            raise ValueError(f"first: {self.first} draws tell nothing apart: give at least {FEWEST_DRAWS}")
        return self


class Pareto(SourcedRecord):
    """What tracking costs in energy and in comfort: a search for each of so many weights, of every controller.

    condition: in which; draws: of an evaluation; evaluations: of a weight's search, of the ends three times as many,
    all of them for each of both; controllers: all that have ranges
    without it; late_s: runs that still move so long after the arrival time are left out, so that energies are compared
    at equal arrival.
    """

    condition: Name
    weights: Annotated[int, Strict(), Field(ge=2, le=100)] = 12
    evaluations: Count = 10
    draws: Count = 1
    controllers: tuple[Name, ...] = ()
    late_s: Positive = 1.0


class Contest(Study):
    """A contest: its scenario's file (relative to this one), seeds, conditions and tuning.

    seeds: draws of every condition in which anything is drawn; with racing the most. controllers: those of the
    scenario that take part, all without it; entrants: who does beside them; absent: laws that do not, and why.
    periods_s: name of who takes part at other periods too -> these, each a controller of its own, called by its period
    (`pid_20ms`) and tuned apart. as_stated: who takes part with the stated parameters too, where others were found; all
    without it.
    """

    scenario: Text
    seeds: Count
    seed: Seed
    resamples: Count
    confidence: Annotated[float, Strict(), Field(gt=0.5, lt=1, allow_inf_nan=False)]
    source: dict[str, Text]
    conditions: dict[Name, Condition]
    tuning: Tuning
    controllers: tuple[Name, ...] = ()
    entrants: dict[Name, ControllerSpec] = Field(default_factory=dict)
    absent: dict[Name, Text] = Field(default_factory=dict)
    periods_s: dict[Name, tuple[Interval, ...]] = Field(default_factory=dict)
    as_stated: tuple[Name, ...] | None = None
    racing: Racing | None = None
    pareto: Pareto | None = None
    _world: Scenario | None = PrivateAttr(default=None)

    @model_validator(mode="before")
    @classmethod
    def _an_entrant_at_each_of_its_periods(cls, data: Any) -> Any:
        if not (isinstance(data, dict) and "entrants" in data):
            return data
        return data | {"entrants": at_periods(data["entrants"], "entrants")}

    @model_validator(mode="before")
    @classmethod
    def _ranges_hold_at_other_periods(cls, data: Any) -> Any:
        tuning, periods = (data.get(key) for key in ("tuning", "periods_s")) if isinstance(data, dict) else (None, None)
        if not (isinstance(tuning, dict) and isinstance(tuning.get("ranges"), dict)):
            return data
        copies = [period_name(name, period) for name, own in (periods if isinstance(periods, dict) else {}).items()
                  for period in (own if isinstance(own, list | tuple) else ()) if isinstance(period, int | float)]
        # What was found is of controllers that the scenario, which is not read yet, may have at several periods.
        by_condition = tuning.get("found_in")
        found = [tuning.get("found"), *(by_condition.values() if isinstance(by_condition, dict) else ())]
        copies += [name for table in found if isinstance(table, dict) for name in table]
        ranges = tuning["ranges"]
        more = {name: ranges[without_period(name)] for name in copies if without_period(name) in ranges}
        return data | {"tuning": tuning | {"ranges": more | ranges}}

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
        named = [("condition", self.tuning.condition), *(("conditions", name) for name in self.tuning.conditions)]
        named = [(f"tuning.{key}", name) for key, name in named]
        named += [("pareto.condition", self.pareto.condition)] if self.pareto else []
        for key, name in named:
            if name not in self.conditions:
                raise ValueError(f"{key}: '{name}' is no condition: choose one of {', '.join(self.conditions)}")
        return self

    def tuned_in(self, name: str) -> tuple[Name, ...]:
        """The conditions in which a search is run: `name` where each is tuned by itself."""
        tuning = self.tuning
        if tuning.mode == "per condition":
            return (name,)
        return (tuning.condition,) if tuning.mode == "condition" else tuning.conditions or tuple(self.conditions)

    def runs_an_evaluation(self, name: str) -> int:
        """How many runs one evaluation of a search takes."""
        return sum(self.tuning.draws if self.conditions[each].random else 1 for each in self.tuned_in(name))

    def evaluations(self, name: str, controller: str = "") -> int:
        """How often a search may try parameters, in all its restarts; name: as for `tuned_in`."""
        if controller in self.tuning.evaluations_of:
            return self.tuning.evaluations_of[controller]
        return self.tuning.runs // self.runs_an_evaluation(name) if self.tuning.runs else EVALUATIONS

    def found_for(self, controller: str, condition: str) -> dict[str, float] | None:
        """What was found for a controller and counts in a condition; None where nothing was."""
        tuning = self.tuning
        own = tuning.found_in.get(condition, {}).get(controller) if tuning.mode == "per condition" else None
        return own or tuning.found.get(controller)

    def result_for(self, controller: str, condition: str) -> SearchResult | None:
        """How that was found, where it is known."""
        tuning = self.tuning
        if tuning.mode == "per condition" and controller in tuning.found_in.get(condition, {}):
            return tuning.results_in.get(condition, {}).get(controller)
        return tuning.results.get(controller)

    def is_tuned(self, controller: str) -> bool:
        """Whether something was found for every condition."""
        return all(self.found_for(controller, condition) is not None for condition in self.conditions)


