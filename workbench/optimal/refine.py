"""From a plan on a mesh to a run on a finer one that every point of the line allows.

On an interval the plan knows a mean force. Driving with constant acceleration instead would need some traction and some
braking where the plan coasts, and more than the limit where it is at its limit. So the finer run follows the motion
under the plan's force, or under the limit itself, and meets the plan's speed at every node.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.course import Array, Course
from workbench.optimal.envelope import drivable, with_fine_cells
from workbench.optimal.profile import Profile, largest_force
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
    x, line, drag = course.position_m, course.force_n, course.drag
    s, b_plan = plan.grid.position_m, plan.half_square
    owner = np.searchsorted(s, (x[1:] + x[:-1]) / 2) - 1
    first = np.searchsorted(x, s)
    count = np.diff(first)
    b = np.empty(len(x))
    b[first] = b_plan
    reached = b_plan[:-1].copy()
    rows: list[tuple[NDArray[np.intp], Array]] = []
    for k in range(int(count.max())):
        live = np.flatnonzero(count > k)
        cell = first[live] + k
        width = x[cell + 1] - x[cell]
        slope = _slope(vehicle, plan, live, reached[live], line[cell, 0], drag[cell, 0])
        middle = np.maximum(reached[live] + width / 2 * slope, 0.0)
        slope = _slope(vehicle, plan, live, middle, line[cell].mean(axis=1), drag[cell].mean(axis=1))
        reached[live] += width * slope
        rows.append((cell + 1, reached[live].copy()))
    for node, value in rows:
        b[node] = value
    missed = b_plan[1:] - reached
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
    brake = largest_force(vehicle.regenerative, mean) + vehicle.friction_brake_n
    return np.asarray((plan.force_n > NEAR_LIMIT * largest_force(vehicle.traction, mean))
                      | (plan.force_n < -NEAR_LIMIT * brake))


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


def _slope(vehicle: Vehicle, plan: Plan, interval: NDArray[np.intp], b: Array, line: Array, drag: Array) -> Array:
    """db/ds under the plan's force on the given intervals, or under the limit where the plan is at it."""
    v = np.sqrt(2 * np.maximum(b, 0.0))
    ends = plan.half_square
    mean_speed = np.sqrt(ends[interval] + ends[interval + 1])
    planned = plan.force_n[interval]
    a, b_1, c = vehicle.davis_n
    most = largest_force(vehicle.traction, mean_speed)
    least = -largest_force(vehicle.regenerative, mean_speed) - vehicle.friction_brake_n
    pull = planned * largest_force(vehicle.traction, v) / np.maximum(most, 1e-9)
    brake_now = -largest_force(vehicle.regenerative, v) - vehicle.friction_brake_n
    brake = planned * brake_now / np.minimum(least, -1e-9)
    # At the limit of the electric brake too: what it cannot give friction would have to.
    electric, electric_now = (largest_force(vehicle.regenerative, speed) for speed in (mean_speed, v))
    regenerating = (planned < -NEAR_LIMIT * electric) & (planned > -electric / NEAR_LIMIT)
    force = np.where(planned > NEAR_LIMIT * most, pull,
                     np.where(planned < NEAR_LIMIT * least, brake,
                              np.where(regenerating, planned * electric_now / np.maximum(electric, 1e-9), planned)))
    return np.asarray((force - davis_resistance(v, a, b_1, c + drag) - line) / vehicle.inertia_kg)
