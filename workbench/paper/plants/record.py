"""What the file of a plant's study states: names and values, no expression; what they belong to lies beside it."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Discriminator, Field, Strict, Tag, model_validator

from workbench.files.toml import Count, Name, NonNegative, Number, Positive, SourcedRecord, Text
from workbench.model.tuning import Searched, Seed
from workbench.paper.study import Study
from workbench.systems.setting import Integrator
from workbench.systems.signals import Signal

MPC = ("mpc.tracking", "mpc.economic")
Values = dict[str, Number]
Weights = dict[str, NonNegative]


def _reference_named(value: object) -> object:
    """What is tracked, which a newcomer may give as a number; ValueError then."""
    if isinstance(value, int | float):
        raise ValueError(f"is a number, {value:g}, and names no reference: state one, such as reference.rest = "
                         f"{{ kind = 'constant', value = {float(value)} }}, and name it here")
    return value


Tracked = Annotated[Text, BeforeValidator(_reference_named)]


class LawEntry(SourcedRecord):
    """A law of the folder: its name, sampling period, parameters that are not the plant's own, initial states."""

    law: Text
    period_s: Positive
    parameters: Values = Field(default_factory=dict)
    initial: Values = Field(default_factory=dict)


class MpcEntry(SourcedRecord):
    """MPC made from the plant's expressions; the fields are those of `PlantMpc`. Economic MPC minimises metrics."""

    law: Literal["mpc.tracking", "mpc.economic"]
    period_s: Positive
    horizon: Count
    weights: Weights = Field(default_factory=dict)
    objective: Values = Field(default_factory=dict)
    input_weights: Weights = Field(default_factory=dict)
    change_weights: Weights = Field(default_factory=dict)
    input_targets: Values = Field(default_factory=dict)
    rate_limits: Weights = Field(default_factory=dict)
    terminal_weight: NonNegative = 1.0
    excess_price: NonNegative = 1e3
    substeps: Count = 1
    solver: Literal["fatrop", "ipopt"] = "fatrop"
    disturbance_gain: Annotated[float, Strict(), Field(ge=0, le=1)] = 0.0
    one_iteration: bool = False
    observer: Weights = Field(default_factory=dict)
    first_estimate: Values = Field(default_factory=dict)
    first_spread: Weights = Field(default_factory=dict)
    predictor: bool = False

    @model_validator(mode="after")
    def _minimises_something(self) -> Self:
        if self.law == "mpc.tracking" and not self.weights:
            raise ValueError("weights: is missing or empty: weigh the outputs that shall follow a reference")
        if (self.law == "mpc.economic") != bool(self.objective):
            raise ValueError("objective: weighs metrics for mpc.economic, and for that alone: add it or take it out")
        return self


def _which(data: Any) -> str:
    law = data.get("law") if isinstance(data, dict) else getattr(data, "law", None)
    return "mpc" if law in MPC else "law"


Controller = Annotated[Annotated[LawEntry, Tag("law")] | Annotated[MpcEntry, Tag("mpc")], Discriminator(_which)]


class Sensing(SourcedRecord):
    """Of each output: the standard deviation of its measurement's noise, and how old a measurement is."""

    noise: Weights = Field(default_factory=dict)
    late_s: Weights = Field(default_factory=dict)
    seed: Seed = 0


class Actuators(SourcedRecord):
    """Of each input: the time constant of its lag, and its delay."""

    lag_s: Weights = Field(default_factory=dict)
    delay_s: Weights = Field(default_factory=dict)


class Uncertainty(SourcedRecord):
    """The Monte Carlo: which parameters are drawn, each from 1 - spread to 1 + spread times its value.

    Without a spread they are drawn from the intervals in which the plant says they are known to lie.
    """

    runs: Count
    seed: Seed
    factors: Annotated[tuple[Text, ...], Field(min_length=1)]
    spread: Annotated[float, Strict(), Field(gt=0, lt=1, allow_inf_nan=False)] | None = None


class PlantTuning(Searched):
    """The tuning of a plant's study: objective is metric -> its unit; a failed run costs `failed` for each."""

    objective: Annotated[dict[str, Positive], Field(min_length=1)]
    failed: Positive


class PlantStudy(Study):
    """A study of a plant: everything with its unit in the name or in the plant's own declaration.

    plant: its id, needed where the folder has several; plant_step_s: left out where it moves in steps of its own.
    """

    kind: Literal["plant"]
    plant: Text | None = None
    duration_s: Positive
    plant_step_s: Positive | None = None
    log_every_s: Positive | None = None
    integrator: Integrator = "rk4"
    parameters: Values = Field(default_factory=dict)
    initial: Values = Field(default_factory=dict)
    reference: dict[Name, Signal] = Field(default_factory=dict)
    disturbance: dict[Text, Signal] = Field(default_factory=dict)
    tracks: dict[str, Tracked] = Field(default_factory=dict)
    sensing: Sensing = Sensing()
    actuators: Actuators = Actuators()
    controllers: Annotated[dict[Name, Controller], Field(min_length=1)]
    uncertainty: Uncertainty | None = None
    tuning: PlantTuning | None = None
    source: dict[str, Text] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _tunes_what_there_is(self) -> Self:
        for name in self.tuning.ranges if self.tuning else ():
            if name not in self.controllers:
                raise ValueError(f"tuning.ranges.{name}: is no controller: name one of {', '.join(self.controllers)}")
        return self
