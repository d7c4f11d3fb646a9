"""From the dual of the cone program to the function p(s) of a bound."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array
from workbench.optimal.grid import kept_borders
from workbench.optimal.socp import Plan
from workbench.optimal.timetable import counted
from workbench.optimal.vehicle import Vehicle

# Speeds of neighbouring cells: p goes like 1/v near a stop, and is nearly linear in between.
RATIO, MOST_PARTS = 1.08, 60
# From one of these shares of it on a speed is at its limit. Just below it a jump of p costs the bound what a run at the
# limit would gain by it; and a solver leaves a speed that is at its limit a little below.
NEAR_LIMIT = (0.995, 1 - 1e-6)
# Cells are no shorter.
SHORTEST_M = 1e-6
# Half the squared speed below this share of an interval's is a standstill that rounding has touched.
STANDSTILL = 1e-12


def certificate_from(vehicle: Vehicle, plan: Plan, near_limit: float = NEAR_LIMIT[0]) -> Certificate:
    """p through the dual values at the middles of the intervals, linear in 1/v between them; jumps at borders.

    p may jump at a stop and where the run meets another limit; there it is continued from each side on its own, towards
    a standstill by the adjoint equation, by which p rises with mu / (inertia acceleration) times 1/v.
    """
    grid = plan.grid
    s, b = grid.position_m, plan.half_square
    middle = (s[1:] + s[:-1]) / 2
    reached = b >= (near_limit * grid.node_limit_mps) ** 2 / 2
    reached |= (grid.node_least_mps > 0) & (b <= (grid.node_least_mps / near_limit) ** 2 / 2)
    price = plan.interval_prices_w
    breaks = np.isin(s, kept_borders(grid.course)) & (reached | grid.stands)
    breaks[[0, -1]] = True
    at, left, right = [s[:1]], [], []
    for k in range(len(plan.adjoint)):
        for start, end, other, node in ((s[k], middle[k], k - 1, k), (middle[k], s[k + 1], k + 1, k + 1)):
            points = _parts(start, end, plan, k)
            if breaks[node] and b[node] == 0.0:
                values = _towards_standstill(vehicle, plan, k, points, float(price[k]))
            else:
                values = _between(points, plan, k, _neighbour(breaks, k, other), middle)
            at.append(points[1:])
            left.append(values[:-1])
            right.append(values[1:])
    drawn = counted(vehicle.auxiliary_w)
    *earlier, last = plan.timetable.fair(plan.prices_w, drawn).tolist()
    return Certificate(np.concatenate(at), np.concatenate(left), np.concatenate(right), last + drawn, tuple(earlier),
                       drawn)


def _neighbour(breaks: NDArray[np.bool_], k: int, other: int) -> int:
    """The interval whose middle gives the line on that side of interval k: beyond a border the one behind; or k."""
    near, behind = (k, k + 1) if other < k else (k + 1, k)
    if not breaks[near]:
        return other
    far = 2 * k - other
    return k if breaks[behind] or not 0 <= far < len(breaks) - 1 else far


def _half_square(points: Array, plan: Plan, k: int) -> Array:
    s, b = plan.grid.position_m, plan.half_square
    found = b[k] + (b[k + 1] - b[k]) * (points - s[k]) / (s[k + 1] - s[k])
    return np.where(found > STANDSTILL * max(b[k], b[k + 1]), found, 0.0)


def _parts(start: float, end: float, plan: Plan, k: int) -> Array:
    """Positions from start to end with about equal ratios of speed, and a short last cell at a standstill."""
    b = _half_square(np.array([start, end]), plan, k)
    low, high = float(b.min()), float(b.max())
    if high <= low * RATIO**2 or high == 0:
        return np.array([start, end])
    floor = max(low, high * RATIO ** (-2 * MOST_PARTS))
    count = int(np.ceil(np.log(high / floor) / (2 * np.log(RATIO))))
    levels = np.geomspace(floor, high, count + 1)
    levels[0], levels[-1] = floor, high
    if floor > low:
        levels = np.insert(levels, 0, low)
    points = start + np.sort((levels - b[0]) / (b[1] - b[0])) * (end - start)
    inner = points[(points > start + SHORTEST_M) & (points < end - SHORTEST_M)]
    return np.concatenate(([start], inner, [end]))


def _inverse_speed(points: Array, plan: Plan, k: int) -> Array:
    """1/v; at a standstill that of the next point, since p times b vanishes there whatever a finite p is."""
    b = _half_square(points, plan, k)
    return np.asarray(1 / np.sqrt(2 * np.where(b > 0, b, b[b > 0].min(initial=np.inf))))


def _towards_standstill(vehicle: Vehicle, plan: Plan, k: int, points: Array, price_w: float) -> Array:
    b = plan.half_square
    middle = np.array([(b[k] + b[k + 1]) / 2])
    acceleration = (b[k + 1] - b[k]) / plan.grid.step_m[k]
    rise = price_w / (vehicle.inertia_kg * acceleration)
    return np.asarray(plan.adjoint[k] + rise * (_inverse_speed(points, plan, k) - 1 / np.sqrt(2 * middle)))


def _between(points: Array, plan: Plan, k: int, far: int, middle: Array) -> Array:
    """p at points of interval k, by the line in 1/v through its middle and that of interval `far`."""
    p = plan.adjoint
    if far == k:
        return np.full(len(points), p[k])
    here, there = (float(_half_square(middle[j:j + 1], plan, j)[0]) for j in (k, far))
    border = plan.half_square[max(k, far)]
    if (here < border < there or here > border > there) and abs(here - there) > 1e-3 * max(here, there):
        one, two = 1 / np.sqrt(2 * here), 1 / np.sqrt(2 * there)
        return np.asarray(p[k] + (p[far] - p[k]) * (_inverse_speed(points, plan, k) - one) / (two - one))
    return np.asarray(p[k] + (p[far] - p[k]) * (points - middle[k]) / (middle[far] - middle[k]))
