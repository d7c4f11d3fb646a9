"""What a train can drive at most: a forward pass with traction, a backward pass with the brakes.

With the speed limits as the target it gives the fastest run. With a planned run as the target it gives the nearest
run below it that keeps every limit at every point, not only on average over an interval: a cell's constant acceleration
is what the limit leaves at the worst of its points, found from the extremes of limit, resistance and line on it.
"""

from __future__ import annotations

import numpy as np

from workbench.compile.package_kernels import compiled
from workbench.errors import WorkbenchError
from workbench.optimal.course import Array, Course
from workbench.optimal.force_limits import (
    Limits,
    Tables,
    braking_within,
    compiled_resistance,
    device_limits,
    force_within,
    resistance_numbers,
)
from workbench.optimal.profile import Profile, largest_braking, largest_force
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance

# By the least of these shares that serves more than half the square of a run's last speed is aimed at where full
# traction leads to it, and than that of its first where full brakes lead away from it: for the steps' error, and for
# what cells give up that keep their limits at every point.
RUN_UPS = (1e-5, 1e-4, 1e-3, 4e-3, 1.6e-2, 6.4e-2)
# Over these lengths b follows from one slope, whatever the train; and as many at most.
PART_M, MOST_PARTS = 20.0, 100_000
# Times a cell's acceleration is lowered until every point of the cell allows it, and what rounding may add to b.
STRICT_ROUNDS, ROUNDING = 12, 5e-16
# A cell on which the limit of the force changes by more than this share is divided, into so many at most.
FINE, MOST_DIVIDED, SHORTEST_CELL_M = 1e-3, 16, 1e-2


class InfeasibleRunError(WorkbenchError):
    """No run meets the request: says which limit binds, where, and what would be feasible.

    least_time_s: the least feasible trip time where there is one, else None.
    """

    def __init__(self, message: str, least_time_s: float | None = None) -> None:
        self.least_time_s = least_time_s
        super().__init__(message)


@compiled(error_model="numpy", _nrt=False)
def _slope(b: float, sign: float, line: float, drag: float, numbers: tuple[float, ...], limits: Limits,
           tables: Tables) -> float:
    """db/ds with full traction (sign 1), or its negative with full brakes (sign -1), within the comfort limit."""
    inertia, a, b_1, c, friction, fastest, hardest = numbers
    v = np.sqrt(2.0 * max(b, 0.0))
    resistance = compiled_resistance(v, a, b_1, c + drag) + line
    if sign > 0:
        return float(min((force_within(limits[0], tables[0], v) - resistance) / inertia, fastest))
    return float(min((braking_within(limits, tables, friction, v) + resistance) / inertia, hardest))


@compiled(error_model="numpy", _nrt=False)
def _least_force(limit: tuple[float, float], table: Array, slow: float, fast: float) -> float:
    """The least of the limit over speeds from slow to fast."""
    least = min(force_within(limit, table, slow), force_within(limit, table, fast))
    for k in range(len(table)):
        if slow < table[k, 0] < fast:
            least = min(least, force_within(limit, table, table[k, 0]))
    return least


@compiled(error_model="numpy", _nrt=False)
def _allowed(b: float, reached: float, sign: float, line: tuple[float, float], drag: tuple[float, float], share: float,
             numbers: tuple[float, ...], limits: Limits, tables: Tables) -> float:
    """What `_slope` allows at every point of a cell on which b changes linearly to `reached`."""
    inertia, a, b_1, c, friction, fastest, hardest = numbers
    v, w = np.sqrt(2.0 * max(b, 0.0)), np.sqrt(2.0 * max(reached, 0.0))
    here = compiled_resistance(v, a, b_1, c + drag[0]) + line[0]
    there = compiled_resistance(w, a, b_1, c + drag[1]) + line[1]
    # What bends between both ends: b_1 v lies above its chord, a drag that changes times b above or below.
    bend = 0.5 * (drag[1] - drag[0]) * (reached - b)
    if sign > 0:
        arch = b_1 * (w - v)**2 / (4.0 * (v + w)) if v + w > 0.0 else 0.0
        most = max(here, there) + arch + max(-bend, 0.0)
        force = share * _least_force(limits[0], tables[0], min(v, w), max(v, w))
        return float(min((force - most) / inertia, fastest))
    least = min(here, there) - max(bend, 0.0)
    force = _least_force(limits[1], tables[1], min(v, w), max(v, w)) + friction
    if len(tables[2]):
        force = min(force, _least_force((np.inf, np.inf), tables[2], min(v, w), max(v, w)))
    force *= share
    return float(min((force + least) / inertia, hardest))


@compiled(error_model="numpy", _nrt=False)
def _slope_in_parts(b: float, most: float, step: float, sign: float, line: Array, drag: Array,
                    numbers: tuple[float, ...], limits: Limits, tables: Tables) -> float:
    """The mean `_slope` of a cell, in parts of PART_M and never above `most`; what ends below 0 stands still.

    A cell may be so long that one step over it passes every speed limit and falls back below a standstill.
    """
    count = min(max(int(np.ceil(step / PART_M)), 1), MOST_PARTS)
    part, now = step / count, b
    for i in range(count):
        line_0, line_1 = line[0] + i / count * (line[1] - line[0]), line[0] + (i + 1) / count * (line[1] - line[0])
        drag_0, drag_1 = drag[0] + i / count * (drag[1] - drag[0]), drag[0] + (i + 1) / count * (drag[1] - drag[0])
        first = _slope(now, sign, line_0, drag_0, numbers, limits, tables)
        middle = min(max(now + part / 2 * first, 0.0), most)
        now = min(now + part * _slope(middle, sign, (line_0 + line_1) / 2, (drag_0 + drag_1) / 2, numbers, limits,
                                      tables), most)
        if now <= 0.0:
            return -b / step - 1.0
    return (now - b) / step


@compiled(error_model="numpy", _nrt=False)
def _pass(b: Array, target: Array, start: float, step: Array, line: Array, drag: Array, usable: Array, stands: Array,
          sign: float, numbers: tuple[float, ...], limits: Limits, tables: Tables,
          is_strict: bool) -> int:
    """Lower b, a copy of the target, to the largest that the limits allow; where it cannot go on, or -1.

    Strictly at every point of each cell, else to the second order of its length. Most cells reach their target, which
    is looked at first.
    """
    b[0] = min(start, target[0])
    for k in range(len(step)):
        aimed = target[k + 1]
        if is_strict and aimed > 0.0 and aimed - b[k] + ROUNDING * max(b[k], aimed) <= step[k] * _allowed(
                b[k], aimed, sign, (line[k, 0], line[k, 1]), (drag[k, 0], drag[k, 1]), usable[k], numbers, limits,
                tables):
            b[k + 1] = aimed
            continue
        first = _slope(b[k], sign, line[k, 0], drag[k, 0], numbers, limits, tables)
        middle = max(b[k] + step[k] / 2 * first, 0.0)
        slope = _slope(middle, sign, (line[k, 0] + line[k, 1]) / 2, (drag[k, 0] + drag[k, 1]) / 2, numbers, limits,
                       tables)
        if b[k] + step[k] * slope <= 0.0:
            slope = _slope_in_parts(b[k], max(target[k], target[k + 1]), step[k], sign, line[k], drag[k], numbers,
                                    limits, tables)
        if is_strict:
            for number in range(STRICT_ROUNDS):
                allowed = _allowed(b[k], max(b[k] + step[k] * slope, 0.0), sign, (line[k, 0], line[k, 1]),
                                   (drag[k, 0], drag[k, 1]), usable[k], numbers, limits, tables)
                if allowed >= slope:
                    break
                slope = allowed - number * abs(slope - allowed)
        reached = b[k] + step[k] * slope
        if reached <= 0.0 and not (stands[k + 1] and reached > -1e-9):
            return k
        if is_strict:
            reached -= ROUNDING * max(b[k], reached)
        b[k + 1] = min(target[k + 1], reached)
    return -1


@compiled(error_model="numpy", _nrt=False)
def _run_up(raised: Array, top: Array, end: float, more: float, step: Array, line: Array, drag: Array, sign: float,
            numbers: tuple[float, ...], limits: Limits, tables: Tables) -> None:
    """Raise a target at the end to what full traction needs in order to reach `end`; below top everywhere.

    With sign -1, and everything in the opposite order, to what full brakes need after a start at `end`.
    """
    b = end * (1.0 + more)
    for k in range(len(step) - 1, -1, -1):
        raised[k + 1] = min(max(raised[k + 1], b), top[k + 1])
        first = _slope(b, sign, line[k, 1], drag[k, 1], numbers, limits, tables)
        middle = max(b - step[k] / 2 * first, 0.0)
        slope = _slope(middle, sign, (line[k, 0] + line[k, 1]) / 2, (drag[k, 0] + drag[k, 1]) / 2, numbers, limits,
                       tables)
        b -= step[k] * slope
        if b <= 0.0 or (b <= raised[k] and slope > 0.0):
            break


def drivable(vehicle: Vehicle, course: Course, target: Array, start_mps: float = 0.0, end_mps: float = 0.0,
             is_strict: bool = True) -> Profile:
    """The largest run below `target` (half the squared speed at each border of the course).

    A target too low to reach end_mps is raised there. Strictly within every limit, or to the second order of the
    cells' length, which the best possible run comes nearer to from either side. Raises InfeasibleRunError naming the
    place where traction does not climb or the brakes do not hold.
    """
    numbers = (*resistance_numbers(vehicle), float(vehicle.max_acceleration_mps2), float(vehicle.max_deceleration_mps2))
    limits, tables = device_limits(vehicle)
    step = np.diff(course.position_m)
    top = np.minimum(target, _top(course))
    stands = np.isin(course.position_m, course.stops_m)
    top[stands] = 0.0
    stands[[0, -1]] = start_mps == 0, end_mps == 0
    usable = course.usable_shares

    backwards = (step[::-1].copy(), course.force_n[::-1, ::-1].copy(), course.drag[::-1, ::-1].copy())

    def from_start(below: Array) -> tuple[Array, int]:
        b = below.copy()
        return b, _pass(b, below, start_mps**2 / 2, step, course.force_n, course.drag, usable[:, 0].copy(), stands, 1.0,
                        numbers, limits, tables, is_strict)

    most = np.where(stands, 0.0, _top(course)) if start_mps > 0 or end_mps > 0 else top
    for more_at_start in RUN_UPS if start_mps > 0 else RUN_UPS[:1]:
        aimed = top
        if start_mps > 0:
            aimed = top[::-1].copy()
            _run_up(aimed, most[::-1].copy(), start_mps**2 / 2, more_at_start, *backwards, -1.0, numbers, limits,
                    tables)
            aimed = aimed[::-1].copy()
        for more in RUN_UPS if end_mps > 0 else RUN_UPS[:1]:
            raised = aimed.copy()
            if end_mps > 0:
                _run_up(raised, most, end_mps**2 / 2, more, step, course.force_n, course.drag, 1.0, numbers, limits,
                        tables)
            forward, stuck = from_start(raised)
            if forward[-1] >= end_mps**2 / 2 * (1 - 1e-10):
                break
        if stuck >= 0:
            raise InfeasibleRunError(_stall(vehicle, course, stuck))
        found = forward[::-1].copy()
        stuck = _pass(found, found.copy(), end_mps**2 / 2, *backwards, usable[::-1, 1].copy(), stands[::-1].copy(),
                      -1.0, numbers, limits, tables, is_strict)
        if stuck >= 0:
            raise InfeasibleRunError(_runaway(vehicle, course, len(step) - 1 - stuck))
        if found[-1] >= start_mps**2 / 2 * (1 - 1e-10):
            break
    found = found[::-1].copy()
    for speed, reached, what in ((start_mps, found[0], "start"), (end_mps, found[-1], "end")):
        if reached < speed**2 / 2 * (1 - 1e-9):
            raise InfeasibleRunError(f"the run cannot {what} at {speed:g} m/s: {np.sqrt(2 * reached):.4g} m/s is the "
                                     "most that limits, traction and brakes allow there: lower that speed")
    return Profile(course, found)


def fastest(vehicle: Vehicle, course: Course, start_mps: float = 0.0, end_mps: float = 0.0,
            is_strict: bool = True) -> Profile:
    """The run of least time; raises InfeasibleRunError where the train cannot drive the course at all."""
    return drivable(vehicle, course, _top(course), start_mps, end_mps, is_strict)


def changing_limits(vehicle: Vehicle, target: Array) -> Array:
    """By which share the limit of the force changes on each cell of a run, shape (n,): half the squared speed at nodes.

    A run that is at its limit gives up half of that share, since its acceleration is constant on a cell.
    """
    v = np.sqrt(2 * np.maximum(target, 0.0))
    pull = largest_force(vehicle.traction, v)
    brake = largest_braking(vehicle, v)
    limit = np.where(np.diff(target) > 0, 1.0, 0.0)
    share = [np.abs(np.diff(force)) / np.maximum(np.maximum(force[1:], force[:-1]), 1e-9) for force in (pull, brake)]
    a, b_1, c = vehicle.davis_n
    resisted = np.abs(np.diff(davis_resistance(v, a, b_1, c))) / max(float(pull[0]), 1e-9)
    return np.asarray(limit * share[0] + (1 - limit) * share[1] + resisted)


def with_fine_cells(vehicle: Vehicle, course: Course, target: Array) -> Course:
    """The course with cells divided on which the limit of the force, or the line's force, changes by more than FINE of
    the largest along a run: a cell has one acceleration, with which a train on a ramp pulls and brakes where it should
    coast."""
    line = np.abs(np.diff(course.force_n, axis=1)[:, 0]) / max(vehicle.traction.at(0.0), 1e-9)
    parts = np.clip(np.ceil((changing_limits(vehicle, target) + line) / FINE), 1, MOST_DIVIDED).astype(int)
    x, step = course.position_m, np.diff(course.position_m)
    more = np.where(step / parts > SHORTEST_CELL_M, parts, 1) - 1
    if not more.any():
        return course
    of = np.repeat(np.arange(len(more)), more)
    number = np.arange(1, len(of) + 1) - np.repeat(np.cumsum(more) - more, more)
    return course.split(x[of] + step[of] * number / (more[of] + 1))


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
