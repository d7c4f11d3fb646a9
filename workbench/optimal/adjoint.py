"""From the dual of the cone program to the function p(s) of a bound."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array
from workbench.optimal.grid import kept_borders
from workbench.optimal.socp import Plan
from workbench.optimal.timetable import counted
from workbench.optimal.vehicle import Vehicle

# Cells are as many as leave this share of the energy, since p is a line on each instead of 1/v; so many a half interval
# at most, below a speed of zero too.
CELLS_SHARE, MOST_PARTS = 5e-5, 150
# From one of these shares of it on a speed is at its limit. Just below it a jump of p costs the bound what a run at the
# limit would gain by it; and a solver leaves a speed that is at its limit a little below.
NEAR_LIMIT = (0.995, 1 - 1e-6)
# Between two middles p is linear in 1/v where half the squared speed changes by more than one of these shares, else in
# position. Near a stop a line in position is poor. Where a run leaves its limit, or reaches it, all of the change lies
# on one side of a border, and in 1/v all of p's would lie there too.
BENT_FROM = (1e-3, 0.15)
# A rise of p from one interval to the next that is a jump, and from which share of its limit on a run is at it then.
RISE, NEAR_FOR_RISES = 1e-2, 0.9999
# Cells are no shorter.
SHORTEST_M = 1e-9
# Half the squared speed below this share of an interval's is a standstill that rounding has touched.
STANDSTILL = 1e-12


def certificate_from(vehicle: Vehicle, plan: Plan, near_limit: float = NEAR_LIMIT[0],
                     bent_from: float = BENT_FROM[0]) -> Certificate:
    """p through the dual values at the middles of the intervals, linear in 1/v between them; jumps at borders.

    p may jump at a stop and where the run meets another limit; there it is continued from each side on its own, towards
    a standstill by the adjoint equation, by which p rises with mu / (inertia acceleration) times 1/v. near_limit,
    bent_from: one of NEAR_LIMIT and of BENT_FROM; which proves more is seen from the bound.
    """
    return certificates_from(vehicle, plan, near_limit, (bent_from,))[0]


def certificates_from(vehicle: Vehicle, plan: Plan, near_limit: float, bent_from: Sequence[float] = BENT_FROM, *,
                      rises: bool = False) -> list[Certificate]:
    """One for each of bent_from, on the same cells.

    rises: p may also jump upwards wherever the run is at its limit, which costs the bound nothing there: as it does
    where the line, from down to up, asks for traction instead of braking.
    """
    grid = plan.grid
    s, b = grid.position_m, plan.half_square
    reached = b >= (near_limit * grid.node_limit_mps) ** 2 / 2
    reached |= (grid.node_least_mps > 0) & (b <= (grid.node_least_mps / near_limit) ** 2 / 2)
    breaks = np.isin(s, kept_borders(grid.course)) & (reached | grid.stands)
    rise = np.zeros(len(s), dtype=bool)
    if rises:
        rise[1:-1] = reached[1:-1] & ~breaks[1:-1] & (np.diff(plan.adjoint) > RISE)
        breaks |= rise
    breaks[[0, -1]] = True
    halves = _halves(plan, breaks, rise)
    points, of = _points(halves, plan)
    first = np.insert(np.diff(of) > 0, 0, True)
    drawn = counted(vehicle.auxiliary_w)
    *earlier, last = plan.timetable.fair(plan.prices_w, drawn).tolist()
    found = (_values(vehicle, plan, halves, points, of, bent) for bent in bent_from)
    return [Certificate(np.append(s[0], points[~first]), values[np.append(~first[1:], False)], values[~first],
                        last + drawn, tuple(earlier), drawn) for values in found]


@dataclass(frozen=True)
class _Halves:
    """The halves of the plan's intervals in order, each shape (m,).

    k: of which interval. start_m, end_m: between its border and its middle. far: the interval whose middle gives the
    line on that side: beyond a border the one behind, or k itself. stands: whether the train stands at its border.
    """

    k: NDArray[np.intp]
    start_m: Array
    end_m: Array
    far: NDArray[np.intp]
    stands: NDArray[np.bool_]


def _halves(plan: Plan, breaks: NDArray[np.bool_], rises: NDArray[np.bool_]) -> _Halves:
    """Where p rises at the limit it is as it is in the middle on either side: what it costs to hold the speed there."""
    s, count = plan.grid.position_m, len(plan.adjoint)
    k, later = np.repeat(np.arange(count), 2), np.tile([False, True], count)
    middle = middles(plan)[k]
    near, behind = np.where(later, k + 1, k), np.where(later, k, k + 1)
    next_one, one_behind = np.where(later, k + 1, k - 1), np.where(later, k - 1, k + 1)
    inside = (one_behind >= 0) & (one_behind < count) & ~breaks[behind] & ~rises[near]
    far = np.where(breaks[near], np.where(inside, one_behind, k), next_one)
    return _Halves(k, np.where(later, middle, s[k]), np.where(later, s[k + 1], middle), far,
                   breaks[near] & (plan.half_square[near] == 0.0))


def middles(plan: Plan) -> Array:
    """Where each interval's dual is the value of p: in the middle of its time, at the mean of its ends' speeds."""
    v = np.sqrt(2 * plan.half_square)
    share = (3 * v[:-1] + v[1:]) / (4 * (v[:-1] + v[1:]))
    return np.asarray(plan.grid.position_m[:-1] + share * plan.grid.step_m)


def _half_square(points: Array, plan: Plan, k: NDArray[np.intp]) -> Array:
    """Half the squared speed at points, each of interval k."""
    s, b = plan.grid.position_m, plan.half_square
    found = b[k] + (b[k + 1] - b[k]) * (points - s[k]) / (s[k + 1] - s[k])
    return np.where(found > STANDSTILL * np.maximum(b[k], b[k + 1]), found, 0.0)


def _points(halves: _Halves, plan: Plan) -> tuple[Array, NDArray[np.intp]]:
    """Positions from start to end of each half in turn, and of which half each is."""
    ends = np.stack((halves.start_m, halves.end_m), axis=1)
    b = _half_square(ends, plan, halves.k[:, None])
    parts = _parts(plan, halves, b)
    of = np.repeat(np.arange(len(parts)), parts + 1)
    number = np.arange(len(of)) - np.repeat(np.cumsum(parts + 1) - parts - 1, parts + 1)
    # Equal differences of the cube root of the speed.
    root = np.sqrt(np.cbrt(b))
    level = (root[of, 0] + number * ((root[:, 1] - root[:, 0]) / parts)[of]) ** 6
    start, end = ends[of, 0], ends[of, 1]
    is_end, inner = number == parts[of], (number > 0) & (number < parts[of])
    change = np.where(inner, b[of, 1] - b[of, 0], 1.0)
    points = np.where(is_end, end, start + np.where(inner, (level - b[of, 0]) / change, 0.0) * (end - start))
    kept = ~inner | ((points > start + SHORTEST_M) & (points < end - SHORTEST_M))
    return points[kept], of[kept]


def _parts(plan: Plan, halves: _Halves, b: Array) -> NDArray[np.intp]:
    """Of how many cells each half is.

    Where the acceleration is constant p is mu / (inertia acceleration) times 1/v. On a cell that takes t, on which v
    changes by the factor exp(d), the line instead costs the bound d^2/8 mu t. Summed over cells of equal differences of
    the cube root of v, of which a given number costs least, that is loss / number^2.
    """
    v = np.sqrt(2 * b)
    root = np.abs(np.diff(np.cbrt(v), axis=1)[:, 0])
    second = 2 * (halves.end_m - halves.start_m) / v.sum(axis=1)
    change = np.abs(np.diff(v, axis=1)[:, 0])
    loss = 27 / 8 * plan.interval_prices_w[halves.k] * second * root**3 / np.maximum(change, 1e-300)
    # With so many cells that one more is worth the same on all halves.
    cubic = np.cbrt(loss)
    worth = (CELLS_SHARE * abs(plan.energy_j) / max(float(cubic.sum()), 1e-300)) ** 0.5
    return np.asarray(np.clip(np.ceil(cubic / max(worth, 1e-300)), 1, MOST_PARTS), dtype=np.intp)


def _values(vehicle: Vehicle, plan: Plan, halves: _Halves, points: Array, of: NDArray[np.intp],
            bent_from: float) -> Array:
    """p at points of halves: by the adjoint equation towards a standstill, else by the line through the middles of its
    interval and of the far one, in 1/v where the speed rises or falls from one to the other, else in position."""
    k, far = halves.k, halves.far
    p, b, middle = plan.adjoint, plan.half_square, middles(plan)
    inverse = _inverse_speeds(points, of, plan, halves)
    here, there = (_half_square(middle[j], plan, j) for j in (k, far))
    border = b[np.maximum(k, far)]
    rising = (far != k) & (np.minimum(here, there) < border) & (border < np.maximum(here, there)) & (
        np.abs(here - there) > bent_from * np.maximum(here, there))
    values = p[k[of]]

    def on(where: NDArray[np.bool_]) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
        """Of the halves for which it holds: which points are theirs, and the half of each of these."""
        return where[of], of[where[of]]

    chosen, half = on(halves.stands)
    acceleration = (b[k + 1] - b[k])[half] / plan.grid.step_m[k[half]]
    rise = plan.interval_prices_w[k[half]] / (vehicle.inertia_kg * acceleration)
    values[chosen] += rise * (inverse[chosen] - 1 / np.sqrt(2 * here[half]))
    change = p[far] - p[k]
    chosen, half = on(rising & ~halves.stands)
    one, two = 1 / np.sqrt(2 * here[half]), 1 / np.sqrt(2 * there[half])
    values[chosen] += change[half] * (inverse[chosen] - one) / (two - one)
    chosen, half = on((far != k) & ~rising & ~halves.stands)
    values[chosen] += change[half] * (points[chosen] - middle[k[half]]) / (middle[far] - middle[k])[half]
    return values


def _inverse_speeds(points: Array, of: NDArray[np.intp], plan: Plan, halves: _Halves) -> Array:
    """1/v; at a standstill that of the next point, since p times b vanishes there whatever a finite p is."""
    b = _half_square(points, plan, halves.k[of])
    least = np.minimum.reduceat(np.where(b > 0, b, np.inf), np.flatnonzero(np.diff(of, prepend=-1)))
    return np.asarray(1 / np.sqrt(2 * np.where(b > 0, b, least[of])))
