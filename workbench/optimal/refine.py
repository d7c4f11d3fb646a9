"""From a plan on a mesh to a run on a finer one that every point of the line allows.

On an interval the plan knows a mean force. Driving with constant acceleration instead would need some traction and some
braking where the plan coasts, and more than the limit where it is at its limit. So the finer run follows the motion
under the plan's force, or under the limit itself, and meets the plan's speed at every node.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array, Course
from workbench.optimal.envelope import drivable, with_fine_cells
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
from workbench.optimal.socp import Plan
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance

# From this share of its limit on, a mean force is taken for the limit itself.
NEAR_LIMIT = 0.96
# Half the squared speed this share below the limit's is the limit: a solver leaves it a little below.
AT_LIMIT = 1e-6
# An interval at the limit of a force has so many times the cells: each gives up what its worst point asks for.
AT_LIMIT_PARTS = 4
# Points closer than this are one.
SLIVER_M = 1e-6


def refined(vehicle: Vehicle, plan: Plan, parts: int, start_mps: float = 0.0, end_mps: float = 0.0) -> Profile:
    """The run on `parts` cells an interval or more; raises InfeasibleRunError when the train cannot drive it.

    Where the plan goes at the speed limit and traction alone, or the brakes alone, can hold it there, the run does so,
    instead of losing time on a climb under the mean force.
    """
    s, step = plan.grid.position_m, plan.grid.step_m
    count = np.where(_at_limit(vehicle, plan), AT_LIMIT_PARTS, 1) * parts
    number = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    inner = (np.repeat(s[:-1], count) + np.repeat(step / count, count) * number)[number > 0]
    # The borders of the line's force are nodes of the split course too; a point beside one would make a sliver.
    borders = plan.grid.course.position_m
    after = np.clip(np.searchsorted(borders, inner), 1, len(borders) - 1)
    apart = np.minimum(inner - borders[after - 1], borders[after] - inner) > SLIVER_M
    course = plan.grid.course.split(np.concatenate((s[1:-1], inner[apart])))
    target = _target(vehicle, plan, course)
    fine = with_fine_cells(vehicle, course, target)
    if fine is not course:
        course, target = fine, _target(vehicle, plan, fine)
    return drivable(vehicle, course, target, start_mps, end_mps)


def _target(vehicle: Vehicle, plan: Plan, course: Course) -> Array:
    """Half the squared speed at a course's borders: cell by cell on all intervals, then drawn to the plan's nodes."""
    x = course.position_m
    s, b_plan = plan.grid.position_m, plan.half_square
    owner = np.searchsorted(s, (x[1:] + x[:-1]) / 2) - 1
    first = np.searchsorted(x, s)
    b = np.empty(len(x))
    _followed(b, x, course.force_n, course.drag, first, b_plan, plan.force_n, resistance_numbers(vehicle),
                  *device_limits(vehicle))
    missed = b_plan[1:] - b[first[1:]]
    share = (x[1:] - s[owner]) / (s[owner + 1] - s[owner])
    b[1:] += missed[owner] * share
    # Near a standstill the correction may be as large as b itself: there the plan's straight line serves.
    straight = np.interp(x, s, b_plan)
    poor = np.append(False, (np.abs(missed) > 0.2 * np.maximum(b_plan[1:], b_plan[:-1]))[owner]) | (b <= 0)
    poor[1:] |= _held(vehicle, plan, course, owner)[owner]
    return np.where(poor, straight, b)


def _at_limit(vehicle: Vehicle, plan: Plan) -> NDArray[np.bool_]:
    """The intervals on which the plan is at full traction or full brakes."""
    speed = np.sqrt(2 * plan.half_square)
    mean = (speed[1:] + speed[:-1]) / 2
    return np.asarray((plan.force_n > NEAR_LIMIT * largest_force(vehicle.traction, mean))
                      | (plan.force_n < -NEAR_LIMIT * largest_braking(vehicle, mean)))


def _held(vehicle: Vehicle, plan: Plan, course: Course, owner: NDArray[np.intp]) -> NDArray[np.bool_]:
    """The intervals on which the plan goes at the limit, and what holds it there is traction or braking all along."""
    grid, b = plan.grid, plan.half_square
    top = grid.limit_mps**2 / 2
    at_top = np.minimum(b[1:], b[:-1]) >= (1 - AT_LIMIT) * top
    a, b_1, c = vehicle.davis_n
    count = len(top)
    most, least = np.full(count, -np.inf), np.full(count, np.inf)
    resisted = davis_resistance(grid.limit_mps[owner, None], a, b_1, c + course.drag) + course.force_n
    np.maximum.at(most, owner, resisted.max(axis=1))
    np.minimum.at(least, owner, resisted.min(axis=1))
    return np.asarray(at_top & ((least >= 0) | (most <= 0)))


@compiled(error_model="numpy", _nrt=False)
def _followed(b: Array, x: Array, line: Array, drag: Array, first: NDArray[np.intp], b_plan: Array, planned: Array,
              numbers: tuple[float, ...], limits: Limits, tables: Tables) -> None:
    """Fill b with half the squared speed at x, where each interval is driven from the plan's speed at its start on.

    first: where the plan's nodes are in x; planned: its forces, N.
    """
    b[0] = b_plan[0]
    for k in range(len(planned)):
        mean_speed = np.sqrt(b_plan[k] + b_plan[k + 1])
        at_mean = (force_within(limits[0], tables[0], mean_speed), force_within(limits[1], tables[1], mean_speed),
                   braking_within(limits, tables, numbers[4], mean_speed))
        now = b_plan[k]
        for cell in range(first[k], first[k + 1]):
            width = x[cell + 1] - x[cell]
            slope = _slope(now, line[cell, 0], drag[cell, 0], planned[k], at_mean, numbers, limits, tables)
            middle = max(now + width / 2 * slope, 0.0)
            slope = _slope(middle, (line[cell, 0] + line[cell, 1]) / 2, (drag[cell, 0] + drag[cell, 1]) / 2,
                           planned[k], at_mean, numbers, limits, tables)
            now += width * slope
            b[cell + 1] = now


@compiled(error_model="numpy", _nrt=False)
def _slope(b: float, line: float, drag: float, planned: float, at_mean: tuple[float, float, float],
           numbers: tuple[float, ...], limits: Limits, tables: Tables) -> float:
    """db/ds under the plan's force, or under the limit where the plan is at it.

    at_mean: the limits of traction, of the electric brake and of both brakes at the interval's mean speed, N.
    """
    inertia, a, b_1, c, friction = numbers
    v = np.sqrt(2.0 * max(b, 0.0))
    most, electric, both = at_mean
    force, electric_now = planned, force_within(limits[1], tables[1], v)
    if planned > NEAR_LIMIT * most:
        force = planned * force_within(limits[0], tables[0], v) / max(most, 1e-9)
    elif planned < -NEAR_LIMIT * both:
        force = planned * braking_within(limits, tables, friction, v) / max(both, 1e-9)
    elif -electric / NEAR_LIMIT < planned < -NEAR_LIMIT * electric:
        # At the limit of the electric brake too: what it cannot give friction would have to.
        force = planned * electric_now / max(electric, 1e-9)
    return float((force - compiled_resistance(v, a, b_1, c + drag) - line) / inertia)
