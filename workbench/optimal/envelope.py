"""What a train can drive at most: a forward pass with traction, a backward pass with the brakes.

With the speed limits as the target it gives the fastest run. With a planned run as the target it gives the nearest
run below it that keeps every limit at every point, not only on average over an interval.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from workbench.errors import WorkbenchError
from workbench.optimal.course import Array, Course
from workbench.optimal.profile import Profile
from workbench.optimal.vehicle import Vehicle
from workbench.trains.train import davis_resistance

# By this share more than a run's last speed is aimed at where full traction leads to it, for the steps' error.
RUN_UP = 1e-5
NO_TABLE = np.zeros((0, 2))
compiled_resistance = njit(cache=True)(davis_resistance)


class InfeasibleRunError(WorkbenchError):
    """No run meets the request: says which limit binds, where, and what would be feasible.

    least_time_s: the least feasible trip time where there is one, else None.
    """

    def __init__(self, message: str, least_time_s: float | None = None) -> None:
        self.least_time_s = least_time_s
        super().__init__(message)


@njit(cache=True)
def _force(limit: Array, table: Array, v: float) -> float:
    """The least of force limit[0], power limit[1] and the table, at speed v."""
    force = limit[0] if v * limit[0] <= limit[1] else limit[1] / v
    if len(table):
        force = min(force, np.interp(v, table[:, 0], table[:, 1]))
    return float(force)


@njit(cache=True)
def _slope(b: float, sign: float, line: float, drag: float, numbers: Array, limits: tuple[Array, Array],
           tables: tuple[Array, Array]) -> float:
    """db/ds with full traction (sign 1), or its negative with full brakes (sign -1), within the comfort limit."""
    inertia, a, b_1, c, friction, fastest, hardest = numbers
    v = np.sqrt(2.0 * max(b, 0.0))
    resistance = compiled_resistance(v, a, b_1, c + drag) + line
    if sign > 0:
        return float(min((_force(limits[0], tables[0], v) - resistance) / inertia, fastest))
    return float(min((_force(limits[1], tables[1], v) + friction + resistance) / inertia, hardest))


@njit(cache=True)
def _pass(target: Array, start: float, step: Array, line: Array, drag: Array, stands: Array, sign: float,
          numbers: Array, limits: tuple[Array, Array], tables: tuple[Array, Array]) -> tuple[Array, int]:
    """Largest b below the target that `_slope` allows, from the first node on; and where it cannot go on, or -1."""
    b = target.copy()
    b[0] = min(start, target[0])
    for k in range(len(step)):
        first = _slope(b[k], sign, line[k, 0], drag[k, 0], numbers, limits, tables)
        middle = max(b[k] + step[k] / 2 * first, 0.0)
        slope = _slope(middle, sign, (line[k, 0] + line[k, 1]) / 2, (drag[k, 0] + drag[k, 1]) / 2, numbers, limits,
                       tables)
        reached = b[k] + step[k] * slope
        if reached <= 0.0 and not (stands[k + 1] and reached > -1e-9):
            return b, k
        b[k + 1] = min(target[k + 1], reached)
    return b, -1


@njit(cache=True)
def _run_up(target: Array, top: Array, end: float, step: Array, line: Array, drag: Array, numbers: Array,
            limits: tuple[Array, Array], tables: tuple[Array, Array]) -> Array:
    """The target, raised at the end to what full traction needs in order to reach `end`; below top everywhere."""
    raised = target.copy()
    b = end * (1.0 + RUN_UP)
    for k in range(len(step) - 1, -1, -1):
        raised[k + 1] = min(max(raised[k + 1], b), top[k + 1])
        first = _slope(b, 1.0, line[k, 1], drag[k, 1], numbers, limits, tables)
        middle = max(b - step[k] / 2 * first, 0.0)
        slope = _slope(middle, 1.0, (line[k, 0] + line[k, 1]) / 2, (drag[k, 0] + drag[k, 1]) / 2, numbers, limits,
                       tables)
        b -= step[k] * slope
        if b <= 0.0 or (b <= raised[k] and slope > 0.0):
            break
    return raised


def drivable(vehicle: Vehicle, course: Course, target: Array, start_mps: float = 0.0, end_mps: float = 0.0) -> Profile:
    """The largest run below `target` (half the squared speed at each border of the course).

    A target too low to reach end_mps is raised there. Raises InfeasibleRunError naming the place where traction does
    not climb or the brakes do not hold.
    """
    numbers = np.array([vehicle.inertia_kg, *vehicle.davis_n, vehicle.friction_brake_n, vehicle.max_acceleration_mps2,
                        vehicle.max_deceleration_mps2])
    limits, tables = device_limits(vehicle)
    step = np.diff(course.position_m)
    top = np.minimum(target, _top(course))
    stands = np.isin(course.position_m, course.stops_m)
    top[stands] = 0.0
    stands[[0, -1]] = start_mps == 0, end_mps == 0
    if end_mps > 0:
        most = np.where(stands, 0.0, _top(course))
        top = _run_up(top, most, end_mps**2 / 2, step, course.force_n, course.drag, numbers, limits, tables)
    forward, stuck = _pass(top, start_mps**2 / 2, step, course.force_n, course.drag, stands, 1.0, numbers, limits,
                           tables)
    if stuck >= 0:
        raise InfeasibleRunError(_stall(vehicle, course, stuck))
    found, stuck = _pass(forward[::-1].copy(), end_mps**2 / 2, step[::-1].copy(), course.force_n[::-1, ::-1].copy(),
                         course.drag[::-1, ::-1].copy(), stands[::-1].copy(), -1.0, numbers, limits, tables)
    if stuck >= 0:
        raise InfeasibleRunError(_runaway(vehicle, course, len(step) - 1 - stuck))
    found = found[::-1].copy()
    for speed, reached, what in ((start_mps, found[0], "start"), (end_mps, found[-1], "end")):
        if reached < speed**2 / 2 * (1 - 1e-9):
            raise InfeasibleRunError(f"the run cannot {what} at {speed:g} m/s: {np.sqrt(2 * reached):.4g} m/s is the "
                                     "most that limits, traction and brakes allow there: lower that speed")
    return Profile(course, found)


def fastest(vehicle: Vehicle, course: Course, start_mps: float = 0.0, end_mps: float = 0.0) -> Profile:
    """The run of least time; raises InfeasibleRunError where the train cannot drive the course at all."""
    return drivable(vehicle, course, _top(course), start_mps, end_mps)


def device_limits(vehicle: Vehicle) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Traction and electric brake for compiled code: (force, power) each, and the table of each, shape (k, 2)."""
    both = (vehicle.traction, vehicle.regenerative)
    pairs = [np.array([limit.force_n, limit.power_w]) for limit in both]
    tables = [np.array(limit.table, dtype=float) if limit.table else NO_TABLE for limit in both]
    return (pairs[0], pairs[1]), (tables[0], tables[1])


def _top(course: Course) -> Array:
    """Half the square of the speed limit at each border: of its lower side, or of the point that is passed there."""
    limit = np.minimum(np.append(course.limit_mps, np.inf), np.insert(course.limit_mps, 0, np.inf))
    for point in course.points:
        at = course.position_m == point.position_m
        limit[at] = np.minimum(limit[at], point.fastest_mps)
    return np.asarray(limit**2 / 2)


def _needed(vehicle: Vehicle, course: Course, cell: int) -> float:
    return vehicle.davis_n[0] + float(course.force_n[cell].max())


def _stall(vehicle: Vehicle, course: Course, cell: int) -> str:
    position = course.position_m[cell]
    return (f"the train cannot climb beyond {position:.0f} m: it needs {_needed(vehicle, course, cell) / 1e3:.4g} kN "
            f"to move there and its traction gives {vehicle.traction.at(0.0) / 1e3:.4g} kN at most: take more "
            "traction, less mass or an easier line")


def _runaway(vehicle: Vehicle, course: Course, cell: int) -> str:
    downhill = -float(course.force_n[cell].min()) - vehicle.davis_n[0]
    return (f"the brakes cannot hold the train at {course.position_m[cell]:.0f} m: the slope pulls with "
            f"{downhill / 1e3:.4g} kN and the brakes give {vehicle.braking_n / 1e3:.4g} kN: take more braking force, "
            "less mass or an easier line")
