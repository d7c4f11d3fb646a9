"""A train's own TOML file: the train of a scenario, and what an optimal run asks beyond it."""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import Field, Strict, model_validator

from workbench.files.toml import NonNegative, Positive, Record
from workbench.optimal.inputs.adhesion import with_adhesion
from workbench.optimal.inputs.cars_file import CarsTable
from workbench.optimal.inputs.etcs_table import EtcsTable
from workbench.optimal.inputs.plausible import plausible
from workbench.optimal.vehicle import ForceLimit, Vehicle
from workbench.trains.actuator import Adhesion
from workbench.trains.train_record import Train

Efficiency = Annotated[float, Strict(), Field(ge=0, le=1, allow_inf_nan=False)]


class ForcePoint(Record):
    """A point of a curve of the largest force over speed."""

    speed_mps: NonNegative
    force_n: NonNegative


class TrainFile(Train):
    """A train with its source for every value; what is not stated is as in `Vehicle`.

    max_braking_n is what all brakes give at standstill, regenerative_force_n the part of it that is electric; the
    remainder returns nothing. max_power_w limits traction. traction_curve: the largest force between its points (a
    motor's), constant beyond them, beside max_traction_n and max_power_w. adhesion: what wheels and rail pass on at
    most, of traction and of both brakes together; runs keep below that curve, bounds hold of all that it allows.
    cars: of a train of several cars. etcs: how it brakes, for `--etcs`.
    """

    rotating_fraction: NonNegative = 0.0
    max_speed_mps: Positive | None = None
    max_acceleration_mps2: Positive | None = None
    max_deceleration_mps2: Positive | None = None
    traction_curve: tuple[ForcePoint, ...] = ()
    adhesion: Adhesion | None = None
    traction_efficiency: Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)] = 1.0
    regenerative_force_n: NonNegative = 0.0
    regenerative_power_w: Positive | None = None
    regenerative_efficiency: Efficiency = 0.0
    auxiliary_w: NonNegative = 0.0
    cars: CarsTable | None = None
    etcs: EtcsTable | None = None

    @model_validator(mode="after")
    def _brakes_fit_together(self) -> Self:
        if self.regenerative_force_n > self.max_braking_n:
            raise ValueError(f"regenerative_force_n = {self.regenerative_force_n:g} is part of max_braking_n = "
                             f"{self.max_braking_n:g} and cannot exceed it: raise max_braking_n")
        needs_it = {"regenerative_power_w", "regenerative_efficiency"} & self.model_fields_set
        if self.regenerative_force_n == 0 and needs_it:
            raise ValueError("regenerative_force_n is missing where the power or efficiency of that brake is given: "
                             "add it")
        return self


def vehicle(train: TrainFile, name: str) -> Vehicle:
    """The train as the optimiser knows it; raises InputError where a value is implausible."""
    curve = tuple((point.speed_mps, point.force_n) for point in train.traction_curve)
    traction = ForceLimit(train.max_traction_n, _or_none(train.max_power_w), curve)
    electric = ForceLimit(train.regenerative_force_n, _or_none(train.regenerative_power_w))
    friction = train.max_braking_n - train.regenerative_force_n
    dry = Vehicle(
        name=name, mass_kg=train.mass_kg, davis_n=train.davis_newton,
        traction=traction, regenerative=electric, friction_brake_n=friction,
        rotating_fraction=train.rotating_fraction,
        max_acceleration_mps2=_or_none(train.max_acceleration_mps2),
        max_deceleration_mps2=_or_none(train.max_deceleration_mps2),
        max_speed_mps=_or_none(train.max_speed_mps),
        traction_efficiency=train.traction_efficiency,
        regenerative_efficiency=train.regenerative_efficiency,
        length_m=train.length_m or 0.0,
        auxiliary_w=train.auxiliary_w,
    )
    return plausible(dry if train.adhesion is None else with_adhesion(train.adhesion, dry))


def _or_none(limit: float | None) -> float:
    return math.inf if limit is None else limit
