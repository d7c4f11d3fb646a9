"""A proven lower bound on the energy of every run of a course, not only of those on a mesh.

Let J be the energy, u the force at the wheel, c(u) its cost, G the line's force and b half the squared speed. A run
passes its timing points at times t_j within lo_j to hi_j, and auxiliaries draw A from its first departure to its last
arrival. For any prices r_j of these events (timetable.py) and any piecewise linear p(s), with mu(s) the sum of A and of
the prices of the events that lie ahead of s, every such run obeys

    J >= integral of min over v and u of [ c(u) - p u + mu / v + p r(v) - p' inertia v^2 / 2 ] + p G  ds
         + inertia [p b] at the ends and at jumps of p  +  time part

because what was added to J is not positive: p times the equation of motion, which is zero, integrated by parts, and
the sum of r_j (t_j - hi_j) where r_j > 0 and of r_j (t_j - lo_j) where r_j < 0. In it t_j is the earliest departure, a
wait there, and what was run and waited since, so that running through ds at v adds ds / v to every event ahead:
mu / v, in total, since auxiliaries are a price A of the last arrival and -A of the first departure without limits. A
wait adds its length times the level of the next event, which is at least that level times the least wait where it is
not negative; on the way a train may stand wherever it likes, and then v = 0 in the integral. So

    time part = earliest departure x first level + sum of least wait x level - sum of r_j (hi_j or lo_j)

where all levels but the first hold A. One time T for the whole run is one event with r = mu - A at hi = T: time part
-r T; what is counted of A may be less than what is drawn. Cells that cross a timing point
take the least mu there, since 1 / v is positive. A jump of p costs what the worst speed allowed there makes of it: the
limit's where p rises with position, and the least speed asked of a timing point, else 0, where it falls.

For each v the bracket is concave in s on a cell, where p is linear, so its minimum over v and u is concave too and lies
above its chord: the ends of each cell are all that need be looked at. Nothing is assumed of the run, and no convexity:
the limits of force, power and speed enter as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.compile.package_kernels import compiled
from workbench.errors import WorkbenchError
from workbench.optimal.bound_fixed import fixed_part, owner_of
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array, Course
from workbench.optimal.speed_ranges import Coefficients, Ranges, cut_at_crossings, force_at, speed_ranges
from workbench.optimal.timetable import Timetable, as_timetable
from workbench.optimal.vehicle import Vehicle

# A tunnel's drag is linear along a cell up to this share.
DRAG_TOLERANCE = 1e-9
# As near as this share to where a term is least, its value is the least one: it rises with the square of the distance.
CLOSE = 1e-9
# So many cells at a time: what is worked out of them then stays in the processor's cache.
BLOCK = 1024


@dataclass(frozen=True)
class Terms:
    """One minimisation: of inverse / v + constant + slope v + square v^2 for v from low to high, each shape (m,).

    cell: which cell it belongs to; its value is the least over all terms of a cell's end. end: 0 left, 1 right.
    """

    cell: Array
    end: Array
    low: Array
    high: Array
    inverse: Array
    constant: Array
    slope: Array
    square: Array


def lower_bound(vehicle: Vehicle, course: Course, certificate: Certificate, asked: Timetable | float,
                start_mps: float = 0.0, end_mps: float = 0.0) -> float:
    """The bound in J of all runs in a timetable or a time in s; -inf where it proves nothing.

    Auxiliaries count as far as the certificate counts them. Raises WorkbenchError where a cell crosses a change of the
    tunnels' drag, so that it is no line there, and where more auxiliaries are counted than the train draws.
    """
    timetable = as_timetable(course, asked)
    cells = cell_bounds(vehicle, course, certificate, timetable)
    return float(cells.sum()) + fixed_part(vehicle, course, certificate, timetable, start_mps, end_mps).total_j


def cell_bounds(vehicle: Vehicle, course: Course, certificate: Certificate, timetable: Timetable) -> Array:
    """What each cell adds to the bound without the line's force, J: its length times the mean of the least values."""
    return cell_bounds_of(vehicle, course, [certificate], timetable)[0]


def cell_bounds_of(vehicle: Vehicle, course: Course, forms: Sequence[Certificate], timetable: Timetable) -> Array:
    """The same for several certificates on the same cells, at the same prices: shape (forms, n)."""
    first = forms[0]
    if first.auxiliary_w > vehicle.auxiliary_w:
        raise WorkbenchError(f"certificate of a bound: counts {first.auxiliary_w:g} W of auxiliaries, more "
                             f"than the train's {vehicle.auxiliary_w:g} W: solve again")
    cells, price, length = _cells(course, first), first.cell_prices_w(timetable), np.diff(first.position_m)
    found = np.empty((len(forms), len(length)))
    for k, form in enumerate(forms):
        new = np.ones(len(length), dtype=bool)
        for known, values in zip(forms[:k], found[:k], strict=True):
            same = new & (known.left == form.left) & (known.right == form.right)
            found[k, same] = values[same]  # most forms differ on few cells
            new &= ~same
        where = np.flatnonzero(new)
        for begin in range(0, len(where), BLOCK):
            block = where[begin:begin + BLOCK]
            terms = bound_terms(vehicle, cells.part(block), np.stack((form.left[block], form.right[block])),
                                price[block], length[block])
            least = np.full((2, len(block)), np.inf)
            _gather(least, terms.end, terms.cell, minima(terms))
            found[k, block] = length[block] * least.mean(axis=0)
    return found


def bound_terms(vehicle: Vehicle, cells: Cells, p: Array, price: Array, length_m: Array) -> Terms:
    """Every minimisation that the bounds of cells need: for both ends of each, on each range of speeds.

    p: at both ends, shape (2, n); price: of the cells' running time, W.
    """
    left, right = p
    # p times a drag that changes along the cell bends: below its chord by a quarter of the product at most.
    bend = np.maximum((right - left) * (cells.drag[1] - cells.drag[0]), 0.0) / 4
    a, b_1, c = vehicle.davis_n
    ranges, way = _cheapest(vehicle, cells, p, (left + right) / 2)
    square = p * (c + cells.drag) - bend - vehicle.inertia_kg * ((right - left) / length_m) / 2 + way[3]
    shape = (len(ranges.low), *p.shape)
    high = np.minimum(ranges.high, cells.limit_mps)
    inside = np.broadcast_to(high > ranges.low, shape)
    every = (np.arange(p.shape[1], dtype=float), np.array([[0.0], [1.0]]), ranges.low, high, price + way[0],
             p * a + way[1], p * b_1 + way[2], square)
    return Terms(*(np.broadcast_to(values, shape)[inside] for values in every))


@dataclass(frozen=True)
class Cells:
    """On each cell: the speed limit, the drag at both ends, and the extremes of the line's force.

    top_mps: the highest limit of all cells, those of other blocks too.
    """

    top_mps: float
    limit_mps: Array
    drag: Array
    least_force: Array
    most_force: Array

    def part(self, of: NDArray[np.intp]) -> Cells:
        """Those of these numbers."""
        return Cells(self.top_mps, self.limit_mps[of], self.drag[:, of], self.least_force[of], self.most_force[of])


def _cells(course: Course, certificate: Certificate) -> Cells:
    x, fine = certificate.position_m, course.split(certificate.position_m[1:-1])
    owner, count = owner_of(x, fine.position_m), len(certificate.left)
    limit, least, most = np.zeros(count), np.full(count, np.inf), np.full(count, -np.inf)
    np.maximum.at(limit, owner, fine.limit_mps)
    np.minimum.at(least, owner, fine.force_n.min(axis=1))
    np.maximum.at(most, owner, fine.force_n.max(axis=1))
    first = np.searchsorted(fine.position_m, x[:-1])
    last = np.searchsorted(fine.position_m, x[1:]) - 1
    drag = np.stack((fine.drag[first, 0], fine.drag[last, 1]))
    share = (fine.position_m[:-1] - x[owner]) / np.diff(x)[owner], (fine.position_m[1:] - x[owner]) / np.diff(x)[owner]
    for end in (0, 1):
        chord = drag[0, owner] + share[end] * (drag[1] - drag[0])[owner]
        if np.any(np.abs(fine.drag[:, end] - chord) > DRAG_TOLERANCE * (1e-3 + chord)):
            raise WorkbenchError("certificate of a bound: a cell crosses a change of the tunnels' drag: give the "
                                 "change a border")
    return Cells(float(limit.max()), limit, drag, least, most)


def _cheapest(vehicle: Vehicle, cells: Cells, p: Array, middle: Array) -> tuple[Ranges, Coefficients]:
    """Ranges of speed, and on each and every cell the least of c(u) - p u from below.

    p: shape (2, n), at both ends of the cells; all that is returned can be broadcast to (ranges, 2, n). Each of several
    limits alone gives a bound. They are cut where a limit of the acceleration passes one of a force, and the one taken
    on a cell is the best in its middle, the same for both of its ends.
    """
    pull = np.maximum(p - 1 / vehicle.traction_efficiency, 0.0)
    regain = np.maximum(vehicle.regenerative_efficiency - p, 0.0)
    rub = np.maximum(-p, 0.0)
    zero = np.zeros_like(middle)
    a, b_1, c = vehicle.davis_n
    top = (zero, vehicle.inertia_kg * vehicle.max_acceleration_mps2 + a + cells.most_force, zero + b_1,
           zero + c + cells.drag.max(axis=0))
    hardest = (zero, vehicle.inertia_kg * vehicle.max_deceleration_mps2 - a - cells.least_force, zero - b_1,
               zero - c - cells.drag.min(axis=0))
    ranges = speed_ranges(vehicle, cells.top_mps)
    is_accelerated = np.isfinite(vehicle.max_acceleration_mps2)
    is_braked = np.isfinite(vehicle.max_deceleration_mps2)
    ranges = cut_at_crossings(ranges, [
        *([(top, ranges.traction)] if is_accelerated else []),
        *([(hardest, (zero, zero, zero, zero)), (hardest, ranges.brake), (hardest, _sum(ranges.brake, ranges.friction))]
          if is_braked else [])])
    traction, brake, friction = ranges.traction, ranges.brake, ranges.friction
    most, least = _times(-pull, traction), _sum(_times(-regain, brake), _times(-rub, friction))
    speed = (ranges.low + ranges.high) / 2
    if is_accelerated:
        # Where the force for it is traction's at every speed, so that the product with `pull` is concave.
        lower = (top[1] >= 0) & (force_at(top, speed) < force_at(traction, speed))
        most = _choose(lower, _times(-pull, top), most)
    if is_braked:
        # Holds where the force for the hardest braking is a brake's on all of the range: the product is concave then.
        brakes = force_at(hardest, ranges.high) >= 0
        hard, electric = force_at(hardest, speed), force_at(brake, speed)
        mid_regain = np.maximum(vehicle.regenerative_efficiency - middle, 0.0)
        mid_rub = np.maximum(-middle, 0.0)
        both, one = mid_regain * electric + mid_rub * force_at(friction, speed), mid_regain * hard
        mixed = vehicle.regenerative_efficiency * electric + mid_rub * hard
        # All that the electric brake returns, and the hardest braking at the price of friction.
        all_returned = _sum(_times(-vehicle.regenerative_efficiency * np.ones_like(p), brake), _times(-rub, hardest))
        least = _choose(brakes & (one < np.minimum(both, mixed)), _times(-regain, hardest),
                        _choose(brakes & (mixed < both), all_returned, least))
    return ranges, _sum(most, least)


def _times(factor: Array, limit: Coefficients) -> Coefficients:
    return factor * limit[0], factor * limit[1], factor * limit[2], factor * limit[3]


def _sum(one: Coefficients, other: Coefficients) -> Coefficients:
    return one[0] + other[0], one[1] + other[1], one[2] + other[2], one[3] + other[3]


def _choose(where: NDArray[np.bool_], one: Coefficients, other: Coefficients) -> Coefficients:
    inverse, constant, slope, square = (np.where(where, first, second)
                                        for first, second in zip(one, other, strict=True))
    return inverse, constant, slope, square


def minima(terms: Terms) -> Array:
    """The least value of each term on its range: at an end, or where the derivative passes zero upwards."""
    found = np.empty(len(terms.low))
    _minima(found, terms.low, terms.high, terms.inverse, terms.constant, terms.slope, terms.square)
    return found


@compiled(error_model="numpy", _nrt=False)
def _gather(least: Array, end: Array, cell: Array, found: Array) -> None:
    """Lower the least value of each cell's end to what was found of it."""
    for k in range(len(found)):
        row, column, value = int(end[k]), int(cell[k]), found[k]
        if value < least[row, column] or np.isnan(value):  # what is none stays, so that nothing is proven
            least[row, column] = value


@compiled(error_model="numpy", _nrt=False)
def _value(v: float, a: float, b: float, c: float, d: float) -> float:
    first = 0.0
    if v > 0.0:
        first = a / v
    elif a != 0.0:
        first = np.inf if a > 0.0 else -np.inf
    return first + b + c * v + d * v * v


@compiled(error_model="numpy", _nrt=False)
def _falls(v: float, a: float, c: float, d: float) -> bool:
    """Whether a / v + c v + d v^2 falls at v."""
    return bool((c + 2.0 * d * v) * v * v < a) if a != 0.0 else bool(c + 2.0 * d * v < 0.0)


@compiled(error_model="numpy", _nrt=False)
def _minima(found: Array, lows: Array, highs: Array, inverse: Array, constant: Array, slope: Array,
            square: Array) -> None:
    for k in range(len(lows)):
        low, high, a, b, c, d = lows[k], highs[k], inverse[k], constant[k], slope[k], square[k]
        least = min(_value(low, a, b, c, d), _value(high, a, b, c, d))
        # The curvature 2 a / v^3 + 2 d changes its sign once at most: the derivative is monotone on either side.
        turn = min(max(np.cbrt(-a / d), low), high) if a * d < 0.0 else low
        for side in range(2):
            one, two = (low, turn) if side == 0 else (turn, high)
            if not (two > one and _falls(one, a, c, d) and not _falls(two, a, c, d)):
                least = min(least, _value(two, a, b, c, d))
                continue
            for _ in range(60):
                middle = (one + two) / 2
                if two - one <= CLOSE * two:
                    break
                if _falls(middle, a, c, d):
                    one = middle
                else:
                    two = middle
            least = min(least, _value((one + two) / 2, a, b, c, d))
        found[k] = least
