"""A train of several cars for an optimal run: which cars drive, which couplers tie them, what each car can give."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.profile import largest_braking, largest_force
from workbench.optimal.vehicle import Vehicle
from workbench.trains.multi_particle import c_0, c_a, c_d, c_k, c_v, m_total

# Of the couplers and resistances, as the cars' expressions name them.
VALUES = (c_0, c_v, c_a, c_k, c_d, m_total)


@dataclass(frozen=True)
class CarTrain:
    """A vehicle made of equal cars, car 1 leading; motors: for each car whether it has one.

    Traction and the electric brake are the motor cars' in equal parts, the friction brake every car's in equal parts.
    The first car pushes the air of the whole train. coupler_n_per_m, coupler_n_s_per_m: stiffness and
    damping of a coupler.
    """

    vehicle: Vehicle
    motors: tuple[bool, ...]
    coupler_n_per_m: float
    coupler_n_s_per_m: float

    @property
    def cars(self) -> int:
        """How many cars."""
        return len(self.motors)

    @property
    def car_inertia_kg(self) -> float:
        """Mass of a car with its rotating part."""
        return self.vehicle.inertia_kg / self.cars

    @property
    def one_car(self) -> Vehicle:
        """A car as what meets the line: its mass and length."""
        return replace(self.vehicle, name=f"a car of {self.vehicle.name}", mass_kg=self.vehicle.mass_kg / self.cars,
                       length_m=self.vehicle.length_m / self.cars)

    @property
    def behind_first_m(self) -> Array:
        """How far the front of each car is behind that of the first, shape (cars,), couplers unstretched."""
        return np.arange(self.cars) * self.vehicle.length_m / self.cars

    def values(self) -> dict[str, float]:
        """Numbers of the symbols VALUES, for cars whose m is their inertia: only weight resists, all mass is moved."""
        a, b, c = self.vehicle.davis_n
        inertia = self.vehicle.inertia_kg
        numbers = (a / inertia, b / inertia, c / inertia, self.coupler_n_per_m, self.coupler_n_s_per_m, inertia)
        return {str(symbol): value for symbol, value in zip(VALUES, numbers, strict=True)}

    def data(self) -> Array:
        """Rows m and first of each car, shape (2, cars)."""
        return np.array([[self.car_inertia_kg] * self.cars, [1.0] + [0.0] * (self.cars - 1)])


@dataclass(frozen=True)
class CarLimits:
    """What each car can give at a speed, N, all >= 0, shape (times, cars): traction, electric and friction brake."""

    traction_n: Array
    electric_n: Array
    friction_n: Array


def car_limits(train: CarTrain, speed_mps: Array) -> CarLimits:
    """The limits of each car at speeds in m/s, shape (times,) or (times, cars)."""
    speed = speed_mps[:, None] if speed_mps.ndim == 1 else speed_mps
    share = np.array(train.motors, dtype=float) / sum(train.motors)
    vehicle, even = train.vehicle, np.ones((len(speed), train.cars))
    friction = np.maximum(largest_braking(vehicle, speed) - largest_force(vehicle.regenerative, speed), 0.0)
    return CarLimits(even * share * largest_force(vehicle.traction, speed),
                     even * share * largest_force(vehicle.regenerative, speed),
                     even * friction / train.cars)
