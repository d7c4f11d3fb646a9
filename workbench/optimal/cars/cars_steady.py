"""The coupled train at a steady state: all cars at one speed on one slope, couplers stretched by what they carry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import sympy as sp

from workbench.compile.kernel import numeric
from workbench.errors import InputError
from workbench.optimal.cars.car_train import CarTrain, car_limits
from workbench.optimal.cars.share_forces import Rule, share_forces
from workbench.optimal.course import Array
from workbench.trains.multi_particle import basic_resistance, c_0, c_a, c_v
from workbench.trains.resistance import STANDARD_GRAVITY_MPS2

_mass, _speed, _air = sp.symbols("mass speed air", real=True)
_resists = numeric((c_0, c_v, c_a, _mass, _speed, _air), basic_resistance(_mass, _speed, _air))


@dataclass(frozen=True)
class SteadyState:
    """At speed_mps: force_n, shape (cars,), of each car's motor and brakes; coupler_n and stretch_m, shape (cars - 1,).

    coupler_n: positive where a coupler is pulled, from the first one on.
    """

    speed_mps: float
    force_n: Array
    coupler_n: Array
    stretch_m: Array


def resting_forces(train: CarTrain, speed_mps: Array) -> Array:
    """Basic resistance of each car at common speeds, N, negative; shape (times, cars)."""
    numbers = train.values()
    data = train.data()
    return np.stack([_resists(numbers["c_0"], numbers["c_v"], numbers["c_a"], mass, speed_mps,
                              first * numbers["m_total"]) * np.ones_like(speed_mps) for mass, first in data.T], axis=1)


def carried_ahead(train: CarTrain, speed_mps: Array, acceleration_mps2: Array, line_n: Array) -> Array:
    """q_k of `share_forces`: what the first k cars' resistance, line force and inertia leave to the coupler behind.

    speed_mps, acceleration_mps2: shape (times,); line_n: shape (times, cars), opposing motion.
    """
    own = resting_forces(train, speed_mps) - line_n - train.car_inertia_kg * acceleration_mps2[:, None]
    return np.asarray(np.cumsum(own, axis=1))


def steady_state(train: CarTrain, speed_mps: float, grade_permille: float = 0.0,
                 rule: Rule = "least_coupler_forces") -> SteadyState:
    """The steady state on an endless slope; raises InputError where the cars cannot hold that speed there."""
    weight = train.one_car.mass_kg * STANDARD_GRAVITY_MPS2 * grade_permille / 1000
    speed = np.array([speed_mps])
    q = carried_ahead(train, speed, np.zeros(1), np.full((1, train.cars), weight))
    shares = share_forces(rule, -q[:, -1], car_limits(train, speed), q)
    if shares.excess[0] > 1e-9:
        raise InputError("", "speed", f"{speed_mps:g} m/s cannot be held at {grade_permille:g} per mille: it takes "
                         f"{100 * (1 + shares.excess[0]):.4g} % of what the cars give: lower speed or slope")
    coupler = (np.cumsum(shares.force_n, axis=1) + q)[0, :-1]
    return SteadyState(speed_mps, shares.force_n[0], coupler, coupler / train.coupler_n_per_m)
