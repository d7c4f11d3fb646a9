"""A run as half the squared speed over position, linear between its nodes: exact in time, its forces by Newton."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial.legendre import leggauss

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array, Course
from workbench.optimal.force_limits import (
    Limits,
    Tables,
    compiled_resistance,
    device_limits,
    force_within,
    resistance_numbers,
)
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


def largest_braking(vehicle: Vehicle, speed_mps: Array) -> Array:
    """What both brakes together give, N, for an array of speeds in m/s."""
    both = largest_force(vehicle.regenerative, speed_mps) + vehicle.friction_brake_n
    if vehicle.braking_table:
        speeds, most = zip(*vehicle.braking_table, strict=True)
        both = np.minimum(both, np.interp(speed_mps, speeds, most))
    return np.asarray(both)


def forces(vehicle: Vehicle, profile: Profile, within: Array = WITHIN) -> Forces:
    """What the run needs at the wheel; what electric braking cannot give is left to friction.

    within: the points of each cell, from 0 to 1.
    """
    course, b = profile.course, profile.half_square
    along = b[:-1, None] + within * np.diff(b)[:, None]
    speed = np.sqrt(2 * along)
    a, b_1, c = vehicle.davis_n
    line = course.force_n[:, :1] + within * np.diff(course.force_n)
    drag = course.drag[:, :1] + within * np.diff(course.drag)
    needed = vehicle.inertia_kg * profile.acceleration_mps2[:, None] + davis_resistance(
        speed, a, b_1, c + drag) + line
    traction, braking = np.maximum(needed, 0.0), np.maximum(-needed, 0.0)
    regenerative = np.minimum(braking, largest_force(vehicle.regenerative, speed))
    friction = braking - regenerative
    excess = np.maximum(np.maximum(traction - largest_force(vehicle.traction, speed),
                                   braking - largest_braking(vehicle, speed)), 0.0)
    return Forces(speed, traction, regenerative, friction, excess)


def energy_j(vehicle: Vehicle, profile: Profile) -> float:
    """Energy at the supply for the run, with auxiliaries: exact but for the quadrature of order 6 in a cell, or in
    KINKED_PARTS of it where the cost of the force has a kink."""
    return float(cell_energy_j(vehicle, profile).sum()) + vehicle.auxiliary_w * profile.trip_time_s


def cell_energy_j(vehicle: Vehicle, profile: Profile) -> Array:
    """Energy at the supply on each cell without auxiliaries, shape (n,)."""
    found, course = np.empty(len(profile.half_square) - 1), profile.course
    _cell_energies(found, course.position_m, profile.half_square, course.force_n, course.drag,
                   (*resistance_numbers(vehicle)[:4], vehicle.traction_efficiency, vehicle.regenerative_efficiency),
                   *device_limits(vehicle), (WITHIN, WEIGHT), (IN_PARTS, PART_WEIGHT))
    return found


@compiled(error_model="numpy", _nrt=False)
def _needed(share: float, b: tuple[float, float], line: tuple[float, float], drag: tuple[float, float],
            numbers: tuple[float, ...]) -> tuple[float, float]:
    """Speed and force at the wheel at a share of a cell, with b, the line's force and the drag at both of its ends; and
    numbers the inertia times the acceleration, and Davis'."""
    push, a, b_1, c = numbers
    speed = np.sqrt(2.0 * (b[0] + share * (b[1] - b[0])))
    resistance = compiled_resistance(speed, a, b_1, c + (drag[0] + share * (drag[1] - drag[0])))
    return speed, push + resistance + (line[0] + share * (line[1] - line[0]))


@compiled(error_model="numpy", _nrt=False)
def _cell_energies(found: Array, position: Array, half_square: Array, line: Array, drag: Array,
                   numbers: tuple[float, ...], limits: Limits, tables: Tables,
                   whole: tuple[Array, Array], parts: tuple[Array, Array]) -> None:
    """Fill in the energy of each cell, J. whole, parts: points and weights of a quadrature, for cells at whose ends and
    middle the same forces act, and for the others."""
    inertia, a, b_1, c, efficiency, regain = numbers
    for k in range(len(found)):
        step = position[k + 1] - position[k]
        b, force, tunnel = (half_square[k], half_square[k + 1]), (line[k, 0], line[k, 1]), (drag[k, 0], drag[k, 1])
        resisted = (inertia * ((b[1] - b[0]) / step), a, b_1, c)
        pulls, rubs = 0, 0
        for point in range(3):
            speed, needed = _needed(0.5 * point, b, force, tunnel, resisted)
            pulls += needed > 0.0
            rubs += needed < 0.0 and -needed > force_within(limits[1], tables[1], speed)
        points, weights = parts if 0 < pulls < 3 or 0 < rubs < 3 else whole
        total = 0.0
        for point in range(len(points)):
            speed, needed = _needed(points[point], b, force, tunnel, resisted)
            supplied = needed / efficiency
            if not needed > 0.0:
                supplied = -regain * min(-needed, force_within(limits[1], tables[1], speed))
            total += supplied * weights[point]
        found[k] = step * total
