"""A train as the optimiser knows it: inertia, resistance, what drives and brakes it, and what that costs."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from workbench.errors import InputError


@dataclass(frozen=True)
class ForceLimit:
    """The largest force at a speed: the least of a constant force, a power and a table of speed and force.

    force_n: N; power_w: W, infinite for none. table: ((speed in m/s, force in N), ...) with increasing speeds,
    linear between its points and constant beyond them (a manufacturer's curve, adhesion); empty for none.
    """

    force_n: float
    power_w: float = math.inf
    table: tuple[tuple[float, float], ...] = ()

    def at(self, speed_mps: float) -> float:
        """Force in N at a speed in m/s."""
        least = self.force_n if speed_mps * self.force_n <= self.power_w else self.power_w / speed_mps
        if not self.table:
            return least
        speeds, forces = zip(*self.table, strict=True)
        if speed_mps <= speeds[0]:
            return min(least, forces[0])
        for k in range(1, len(speeds)):
            if speed_mps <= speeds[k]:
                share = (speed_mps - speeds[k - 1]) / (speeds[k] - speeds[k - 1])
                return min(least, forces[k - 1] + share * (forces[k] - forces[k - 1]))
        return min(least, forces[-1])


@dataclass(frozen=True)
class Vehicle:
    """A train: forces in N at the wheel, speeds in m/s, efficiencies from 0 to 1.

    rotating_fraction: rotating mass as a fraction of mass_kg; it adds inertia and no weight. davis_n: (a, b, c)
    in N, N s/m and N s^2/m^2. regenerative: the electric brake, which returns `regenerative_efficiency` of its work;
    friction_brake_n: the brake that returns nothing. braking_table: what both brakes together give at most, as the
    table of a ForceLimit; empty for no such limit. bounded: a train that can do whatever the real one can, where this
    one can a little less: bounds are proved of it, runs are driven by this one. None where both are the same.
    Limits of the acceleration are infinite where there are none.
    tunnel_drag: (cross section in m^2, added c in N s^2/m^2) pairs. auxiliary_w: power drawn all the time.
    Raises InputError where the values contradict each other.
    """

    name: str
    mass_kg: float
    davis_n: tuple[float, float, float]
    traction: ForceLimit
    regenerative: ForceLimit = field(default_factory=lambda: ForceLimit(0.0))
    friction_brake_n: float = 0.0
    rotating_fraction: float = 0.0
    max_acceleration_mps2: float = math.inf
    max_deceleration_mps2: float = math.inf
    max_speed_mps: float = math.inf
    traction_efficiency: float = 1.0
    regenerative_efficiency: float = 0.0
    length_m: float = 0.0
    tunnel_drag: tuple[tuple[float, float], ...] = ()
    auxiliary_w: float = 0.0
    braking_table: tuple[tuple[float, float], ...] = ()
    bounded: Vehicle | None = None

    def __post_init__(self) -> None:
        if not 0 < self.traction_efficiency <= 1 or not 0 <= self.regenerative_efficiency <= 1:
            raise InputError("", "efficiency", f"traction {self.traction_efficiency:g} and regenerative "
                             f"{self.regenerative_efficiency:g} must lie above 0 and up to 1: is it in per cent?")
        if self.regenerative.force_n + self.friction_brake_n <= 0:
            raise InputError("", "braking", "the train has no brake: give a regenerative or another braking force")
        if self.davis_n[0] < 0 or self.davis_n[1] < 0 or self.davis_n[2] < 0:
            raise InputError("", "resistance", f"{self.davis_n} must not be negative: correct the signs")

    @property
    def inertia_kg(self) -> float:
        """Mass with its rotating part."""
        return self.mass_kg * (1 + self.rotating_fraction)

    @property
    def braking_n(self) -> float:
        """Both brakes at standstill."""
        both = self.regenerative.at(0.0) + self.friction_brake_n
        return min(both, self.braking_table[0][1]) if self.braking_table else both

    @property
    def proven(self) -> Vehicle:
        """The train of which bounds are proved."""
        return self.bounded or self
