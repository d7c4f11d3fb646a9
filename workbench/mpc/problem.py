"""A tracking problem of one train as data: horizon, limits, weights and the prices of what may be exceeded."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import InputError
from workbench.mpc.model import ACTUATORS, SOFT, Actuator

Array = NDArray[np.float64]

LONGEST_HORIZON = 1000
SMALLEST_WEIGHT, LARGEST_WEIGHT = 1e-9, 1e12


@dataclass(frozen=True)
class Weights:
    """What the squares cost: position (1/m^2), speed, force, command and its change (in their units), each stage.

    Raises InputError for one that is negative, not finite or without which no feedback follows.
    """

    position: float
    speed: float
    command: float
    force: float = 0.0
    change: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            lowest = SMALLEST_WEIGHT if name in ("position", "command") else 0.0
            if not lowest <= value <= LARGEST_WEIGHT:
                raise InputError("", f"{name}_weight", f"{value:g} is outside {lowest:g} to {LARGEST_WEIGHT:g}: "
                                 "choose a weight within")

    def array(self) -> Array:
        """As the kernels read them."""
        return np.array([self.position, self.speed, self.force, self.command, self.change])


@dataclass(frozen=True)
class Problem:
    """A tracking problem; per unit of mass, so that forces are in m/s^2 and powers in W/kg.

    davis: a (m/s^2), b (1/s), c (1/m); limits that are infinite are none. prices: per soft row of `model.SOFT`, of the
    excess and of its square. terminal_speed_mps: where the model is linearised for the cost beyond the horizon.
    Raises InputError for a horizon, period, limit or price that cannot be used.
    """

    horizon: int
    period_s: float
    davis: tuple[float, float, float]
    lowest_command_mps2: float
    highest_command_mps2: float
    weights: Weights
    actuator: Actuator = "direct"
    lag_s: float = 0.5
    power_w_per_kg: float = math.inf
    band_m: float = math.inf
    price: tuple[tuple[float, float], ...] = ((1e3, 0.0),) * len(SOFT)
    terminal_speed_mps: float = 15.0

    def __post_init__(self) -> None:
        if not (2 <= self.horizon <= LONGEST_HORIZON and self.horizon == int(self.horizon)):
            raise InputError("", "horizon", f"{self.horizon:g} is no whole number from 2 to {LONGEST_HORIZON}: "
                             "give the number of samples predicted")
        if self.actuator not in ACTUATORS:
            raise InputError("", "actuator", f"unknown '{self.actuator}': choose one of {', '.join(ACTUATORS)}")
        if not 0 < self.period_s < math.inf or not 0 < self.lag_s < math.inf:
            raise InputError("", "period_s", f"period {self.period_s:g} s and lag {self.lag_s:g} s must be positive: "
                             "correct them")
        if self.actuator == "lag" and self.period_s > 2.5 * self.lag_s:
            raise InputError("", "lag_s", f"{self.lag_s:g} s is too short for Runge-Kutta at a period of "
                             f"{self.period_s:g} s: take actuator = 'direct'")
        if not self.lowest_command_mps2 < 0 < self.highest_command_mps2 < math.inf or math.isinf(
                self.lowest_command_mps2):
            raise InputError("", "command", f"limits {self.lowest_command_mps2:g} and {self.highest_command_mps2:g} "
                             "m/s^2 must be finite and on both sides of zero: correct them")
        if len(self.price) != len(SOFT) or not all(0 <= x < math.inf for row in self.price for x in row):
            raise InputError("", "price", f"give two finite numbers, not negative, for each of {', '.join(SOFT)}")
        if not (self.band_m > 0 and self.power_w_per_kg > 0):
            raise InputError("", "band_m", "band and power must be positive, or infinite for none: correct them")

    @property
    def parameters(self) -> Array:
        """Of the model, in its order."""
        return self.parameters_over(self.period_s)

    def parameters_over(self, seconds: float) -> Array:
        """Of the model, for a step of so many seconds instead of a period."""
        return np.array([*self.davis, seconds, self.lag_s])

    def limits(self) -> Array:
        """As the kernels read them."""
        return np.array([self.lowest_command_mps2, self.highest_command_mps2, self.band_m, self.power_w_per_kg])

    def rows(self, ahead: Array) -> NDArray[np.int64]:
        """Which soft rows there are, for what lies ahead."""
        there = (self.power_w_per_kg, self.band_m, self.band_m, float(np.min(ahead[:, 4])))
        return np.array([i for i, limit in enumerate(there) if math.isfinite(limit)], dtype=np.int64)
