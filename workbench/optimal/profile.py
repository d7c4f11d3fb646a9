"""A run as half the squared speed over position, linear between its nodes: exact in time, its forces by Newton."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from workbench.optimal.course import Array, Course
from workbench.optimal.vehicle import ForceLimit, Vehicle
from workbench.trains.resistance import davis_resistance

_NODES, _WEIGHTS = leggauss(3)
# Points of the quadrature within a cell, from 0 to 1, and their weights.
WITHIN, WEIGHT = (_NODES + 1) / 2, _WEIGHTS / 2
# Parts of a cell on which what the force costs is no smooth function: traction turns to braking, or friction joins in.
KINKED_PARTS = 16
IN_PARTS = ((np.arange(KINKED_PARTS)[:, None] + WITHIN) / KINKED_PARTS).ravel()
PART_WEIGHT = np.tile(WEIGHT, KINKED_PARTS) / KINKED_PARTS


@dataclass(frozen=True)
class Profile:
    """position_m, half_square: shape (n + 1,); the acceleration is constant on each of the n cells.

    course: has every position as a border, so that on a cell limits are constant and forces linear.
    """

    course: Course
    half_square: Array

    @property
    def position_m(self) -> Array:
        """Borders of the cells."""
        return self.course.position_m

    @property
    def speed_mps(self) -> Array:
        """Speed at each node."""
        return np.sqrt(2 * self.half_square)

    @property
    def acceleration_mps2(self) -> Array:
        """Acceleration on each cell."""
        return np.diff(self.half_square) / np.diff(self.position_m)

    @cached_property
    def time_s(self) -> Array:
        """Time at which each node is reached, shape (n + 1,), read-only; infinite beyond a cell that stands still."""
        speed = self.speed_mps
        found = np.zeros(len(speed))
        with np.errstate(divide="ignore"):
            np.cumsum(2 * np.diff(self.position_m) / (speed[1:] + speed[:-1]), out=found[1:])
        found.flags.writeable = False
        return found

    @property
    def trip_time_s(self) -> float:
        """Time of the whole run."""
        return float(self.time_s[-1])


@dataclass(frozen=True)
class Forces:
    """Forces in N at the points of the quadrature, shape (n, 3): traction, electric and friction brake, all >= 0.

    excess_n: by how much the needed force passes what traction or both brakes can give.
    """

    speed_mps: Array
    traction_n: Array
    regenerative_n: Array
    friction_n: Array
    excess_n: Array


def largest_force(limit: ForceLimit, speed_mps: Array) -> Array:
    """`limit.at` for an array of speeds in m/s."""
    with np.errstate(divide="ignore", invalid="ignore"):
        force = np.where(speed_mps * limit.force_n <= limit.power_w, limit.force_n, limit.power_w / speed_mps)
    if limit.table:
        speeds, forces = zip(*limit.table, strict=True)
        force = np.minimum(force, np.interp(speed_mps, speeds, forces))
    return np.asarray(force, dtype=float)


def forces(vehicle: Vehicle, profile: Profile, within: Array = WITHIN, cells: NDArray[np.intp] | None = None) -> Forces:
    """What the run needs at the wheel; what electric braking cannot give is left to friction.

    within: the points of each cell, from 0 to 1; cells: of which cells, by their numbers, else of all.
    """
    course, b, of = profile.course, profile.half_square, slice(None) if cells is None else cells
    along = b[:-1][of, None] + within * np.diff(b)[of, None]
    speed = np.sqrt(2 * along)
    a, b_1, c = vehicle.davis_n
    line = course.force_n[of, :1] + within * np.diff(course.force_n[of])
    drag = course.drag[of, :1] + within * np.diff(course.drag[of])
    needed = vehicle.inertia_kg * profile.acceleration_mps2[of, None] + davis_resistance(
        speed, a, b_1, c + drag) + line
    traction, braking = np.maximum(needed, 0.0), np.maximum(-needed, 0.0)
    regenerative = np.minimum(braking, largest_force(vehicle.regenerative, speed))
    friction = braking - regenerative
    excess = np.maximum(np.maximum(traction - largest_force(vehicle.traction, speed),
                                   friction - vehicle.friction_brake_n), 0.0)
    return Forces(speed, traction, regenerative, friction, excess)


def energy_j(vehicle: Vehicle, profile: Profile) -> float:
    """Energy at the supply for the run, with auxiliaries: exact but for the quadrature of order 6 in a cell, or in
    KINKED_PARTS of it where the cost of the force has a kink."""
    return float(cell_energy_j(vehicle, profile).sum()) + vehicle.auxiliary_w * profile.trip_time_s


def cell_energy_j(vehicle: Vehicle, profile: Profile) -> Array:
    """Energy at the supply on each cell without auxiliaries, shape (n,)."""
    length = np.diff(profile.position_m)
    found = length * (_supplied_n(vehicle, forces(vehicle, profile)) @ WEIGHT)
    if len(kinked := np.flatnonzero(_kinked(vehicle, profile))):
        in_parts = forces(vehicle, profile, IN_PARTS, kinked)
        found[kinked] = length[kinked] * (_supplied_n(vehicle, in_parts) @ PART_WEIGHT)
    return np.asarray(found)


def _supplied_n(vehicle: Vehicle, found: Forces) -> Array:
    """Energy at the supply for each metre, J/m."""
    return found.traction_n / vehicle.traction_efficiency - vehicle.regenerative_efficiency * found.regenerative_n


def _kinked(vehicle: Vehicle, profile: Profile) -> NDArray[np.bool_]:
    """The cells at whose ends and middle not all forces that act are the same ones."""
    found = forces(vehicle, profile, np.array([0.0, 0.5, 1.0]))
    kinked = np.zeros(len(found.traction_n), dtype=bool)
    for acts in (found.traction_n > 0, found.friction_n > 0):
        kinked |= acts.any(axis=1) & ~acts.all(axis=1)
    return kinked
