"""The best run as a second-order-cone program in position: fast, convex, and its dual gives the bound.

Half the squared speed b is the state, so that motion is linear in it: inertia db/ds = force - resistance. With constant
acceleration on an interval of length h the time is exactly 2 h / (v_k + v_k+1), at a start from standstill too. Relaxed
are v <= sqrt(2 b) and the time from below; both are tight where the trip time binds. A limit of power is force h <=
power x time.
"""

from __future__ import annotations

import time
import warnings
from dataclasses import dataclass, replace
from itertools import pairwise

import cvxpy as cp
import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from workbench.errors import SolverError
from workbench.optimal.clock_rows import clock_rows
from workbench.optimal.course import Array
from workbench.optimal.force_pieces import force_pieces
from workbench.optimal.grid import Grid
from workbench.optimal.open_rows import Mask, OpenRows, all_open, open_rows, rightly_closed, thinned
from workbench.optimal.timetable import Timetable, as_timetable, counted
from workbench.optimal.vehicle import ForceLimit, Vehicle

# Accuracy asked of clarabel; what it returns is checked again by everything that follows.
SETTINGS = {"tol_gap_abs": 1e-8, "tol_gap_rel": 1e-8, "tol_feas": 1e-8}
# Without refining each step's linear equations a program takes half the time; some then end inaccurately, and are
# solved again with it.
QUICK = {"iterative_refinement_enable": False}
# From so many intervals on a coarser program comes first.
COARSE_FIRST = 2000
# A plan keeps this far above a least speed, so that the driven run, which may be a little slower, does.
LEAST_MARGIN = 1.0001


@dataclass(frozen=True)
class Plan:
    """A solved program on a grid of n intervals.

    half_square: shape (n + 1,), b in m^2/s^2. force_n: shape (n,), mean force at the wheel. adjoint: shape (n,),
    J/m per N: what a newton of resistance on the interval costs; prices_w: what a second costs at each event of the
    timetable, without what auxiliaries draw, auxiliary_w. energy_j: at the supply, with auxiliaries.
    """

    grid: Grid
    half_square: Array
    force_n: Array
    adjoint: Array
    timetable: Timetable
    prices_w: Array
    energy_j: float
    solve_s: float
    status: str
    auxiliary_w: float = 0.0

    @property
    def time_price_w(self) -> float:
        """What a second less on the way to the end costs, auxiliaries included."""
        return float(self.prices_w[-1]) + self.auxiliary_w

    @property
    def interval_prices_w(self) -> Array:
        """What a second less costs on each interval, auxiliaries included, shape (n,)."""
        drawn = counted(self.auxiliary_w)
        return self.timetable.cell_prices(self.timetable.fair(self.prices_w, drawn), self.grid.position_m, drawn)


class NoPlanError(SolverError):
    """The cone program has no solution; the message names the solver's status."""


def solve_socp(vehicle: Vehicle, grid: Grid, asked: Timetable | float, start_mps: float = 0.0,
               end_mps: float = 0.0, extra_s: Array | None = None) -> Plan:
    """The run of least energy in a timetable or a trip time in s; raises NoPlanError where clarabel finds none.

    extra_s: seconds that each leg between timing points takes beyond what the program knows; none where not given.
    A large program is solved on a coarser mesh first, and then without what that leaves no use for.
    """
    ends, spent = (start_mps, end_mps), 0.0
    if len(grid.limit_mps) >= COARSE_FIRST:
        try:
            coarse, price = _solve(vehicle, thinned(grid), asked, ends, extra_s=extra_s)
            spent = coarse.solve_s
            rows = open_rows(vehicle, grid, coarse.grid, coarse.half_square, coarse.force_n, price)
            plan, price = _solve(vehicle, grid, asked, ends, rows, extra_s)
            spent += plan.solve_s
            if rightly_closed(vehicle, grid, rows, plan.half_square, plan.force_n, price):
                return replace(plan, solve_s=spent)
        except NoPlanError:
            pass  # the whole program says whether there is none
    plan, _ = _solve(vehicle, grid, asked, ends, extra_s=extra_s)
    return replace(plan, solve_s=spent + plan.solve_s)


def _solve(vehicle: Vehicle, grid: Grid, asked: Timetable | float, ends_mps: tuple[float, float],
           rows: OpenRows | None = None, extra_s: Array | None = None) -> tuple[Plan, Array]:
    """The plan, and what a newton more at the wheel is worth on each interval, J/m per N."""
    h, n = grid.step_m, len(grid.limit_mps)
    rows = rows or all_open(grid)
    inertia, (a, b_1, c) = vehicle.inertia_kg, vehicle.davis_n
    # Scales: variables are around one.
    speed = float(grid.limit_mps.max())
    force = max(vehicle.traction.at(0.0), vehicle.braking_n)
    clock = clock_rows(as_timetable(grid.course, asked), grid.position_m, extra_s)
    mean_time = clock.horizon_s / n
    half = speed**2
    work = force * grid.course.length_m

    b, v, tau = cp.Variable(n + 1), cp.Variable(n + 1), cp.Variable(n)
    pull = _where(rows.pull)
    # A brake that the train does not have costs time all the same.
    brake, grip = (_where(rows.brake) if most > 0 else cp.Constant(np.zeros(n))
                   for most in (vehicle.regenerative.force_n, vehicle.friction_brake_n))
    b_mean, v_mean = (b[1:] + b[:-1]) / 2, (v[1:] + v[:-1]) / 2
    # Newton's law, in units between force and work: as force its numbers would be large on short intervals.
    row = np.sqrt(h / h.mean())
    motion = (cp.multiply(row * inertia * half / (2 * h * force), b[1:] - b[:-1])
              + cp.multiply(row, brake + grip - pull) + row * (a + grid.force_n) / force
              + cp.multiply(row * (grid.drag + c) * half / force, b_mean)
              + cp.multiply(row * b_1 * speed / force, v_mean) == 0)
    fixed = grid.stands.copy()
    fixed[[0, -1]] = True
    value = np.zeros(n + 1)
    value[[0, -1]] = (np.array(ends_mps) / speed) ** 2
    top = (grid.node_limit_mps / speed) ** 2
    free = ~fixed
    fast = free & rows.top
    least = (np.minimum(grid.node_least_mps * LEAST_MARGIN, grid.node_limit_mps) / speed) ** 2
    held = free & (least > 0)
    late, soon, windows, between_ends = clock.rules(tau, mean_time)
    rules = [motion, b[fixed] == value[fixed], v[fixed] == np.sqrt(value[fixed]), b[fast] <= top[fast],
             *windows, *([b[held] >= least[held]] if held.any() else []),
             # v^2 <= b and tau (v_k + v_k+1) >= 2 h, in units of the scales
             cp.SOC(b[free] + 1, cp.vstack([2 * v[free], b[free] - 1])),
             cp.SOC(tau + 2 * v_mean, cp.vstack([tau - 2 * v_mean, 2 * np.sqrt(2 * h / (mean_time * speed))])),
             *([grip <= vehicle.friction_brake_n / force] if vehicle.friction_brake_n > 0 else [])]
    sides = [(pull, vehicle.traction, rows.pull_limit)]
    if vehicle.regenerative.force_n > 0:
        sides.append((brake, vehicle.regenerative, rows.brake))
    for side, limit, near in sides:
        rules += _force_rules(side, limit, grid, v_mean, tau, (force, speed, mean_time), np.flatnonzero(near))
    if b_1 > 0:  # else the resistance would fall with a speed that the relaxation lets go
        rules.append(v[free] >= cp.multiply(1 / np.sqrt(top[free]), b[free]))
    comfort = [(sign, sign * (b[1:] - b[:-1]) <= 2 * limit * h / half)
               for limit, sign in ((vehicle.max_acceleration_mps2, 1), (vehicle.max_deceleration_mps2, -1))
               if np.isfinite(limit)]
    rules += [rule for _, rule in comfort]
    used = cp.sum(cp.multiply(h, pull)) / vehicle.traction_efficiency
    returned = vehicle.regenerative_efficiency * cp.sum(cp.multiply(h, brake))
    drawn = vehicle.auxiliary_w * mean_time / work * between_ends
    problem = cp.Problem(cp.Minimize((used - returned) / grid.course.length_m + drawn), rules)
    solve_s = _solved(problem, f"the cone program of {n} intervals for {clock.horizon_s:g} s")
    price = row * motion.dual_value * work / (force * h)
    # Limits of the acceleration act on db/ds itself: they belong to the price of what changes b.
    adjoint = price
    for sign, rule in comfort:
        adjoint = adjoint + sign * rule.dual_value * 2 * work / (half * inertia)
    half_square = np.where(fixed, value, np.maximum(b.value, 0.0)) * half / 2
    plan = Plan(grid, half_square, (pull.value - brake.value - grip.value) * force, adjoint,
                clock.timetable, clock.prices(late, soon, windows) * work / mean_time,
                float(problem.value) * work + vehicle.auxiliary_w * clock.fixed_between_ends_s,
                solve_s, str(problem.status), vehicle.auxiliary_w)
    return plan, price


def _where(used: Mask) -> cp.Expression:
    """A non-negative variable on some of the intervals, and zero on the others."""
    count, at = len(used), np.flatnonzero(used)
    if len(at) == count:
        return cp.Variable(count, nonneg=True)
    if not len(at):
        return cp.Constant(np.zeros(count))
    place = sparse.csr_array((np.ones(len(at)), (at, np.arange(len(at)))), shape=(count, len(at)))
    return place @ cp.Variable(len(at), nonneg=True)


def _solved(problem: cp.Problem, what: str) -> float:
    """Solve, quickly first; the seconds it took. Raises NoPlanError where neither way gives a solution."""
    spent, trouble = 0.0, ""
    for settings in (SETTINGS | QUICK, SETTINGS):
        started = time.perf_counter()
        try:
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", "Solution may be inaccurate")
                problem.solve(cp.CLARABEL, ignore_dpp=True, canon_backend="SCIPY", warm_start=False, **settings)
        except cp.SolverError as error:
            trouble = f"clarabel fails on {what} ({error}): try other intervals"
            spent += time.perf_counter() - started
            continue
        spent += float(problem.solver_stats.solve_time or time.perf_counter() - started)
        if problem.status == cp.OPTIMAL:
            return spent
        trouble = f"clarabel says '{problem.status}' of {what}: allow more time or other intervals"
    # An inaccurate solution may serve: nothing that follows takes the solver's word for it.
    if problem.status != cp.OPTIMAL_INACCURATE:
        raise NoPlanError(trouble)
    return spent


def _force_rules(force: cp.Expression, limit: ForceLimit, grid: Grid, v_mean: cp.Expression, tau: cp.Variable,
                 scales: tuple[float, float, float], at: NDArray[np.intp]) -> list[cp.Constraint]:
    """Limits of one force on intervals `at`, in scaled units; a table by the lines of its upper concave hull."""
    unit, speed, mean_time = scales
    if not len(at):
        return []
    rules = [force[at] <= limit.force_n / unit]
    if np.isfinite(limit.power_w):
        rules.append(cp.multiply(grid.step_m[at] * unit / (limit.power_w * mean_time), force[at]) <= tau[at])
    for constant, slope in _hull_lines(limit, speed):
        rules.append(force[at] <= constant / unit + slope * speed / unit * v_mean[at])
    return rules


def _hull_lines(limit: ForceLimit, top_mps: float) -> list[tuple[float, float]]:
    """Falling lines (constant in N, slope) of the upper concave hull of the table, over 0 to top_mps."""
    if not limit.table:
        return []
    pieces = force_pieces(ForceLimit(limit.force_n, table=limit.table), top_mps)
    points = [(0.0, pieces[0].at(0.0)), *((piece.high_mps, piece.at(piece.high_mps)) for piece in pieces)]
    hull: list[tuple[float, float]] = []
    for point in points:
        while len(hull) > 1 and _turns_left(hull[-2], hull[-1], point):
            hull.pop()
        hull.append(point)
    lines = []
    for (x, y), (z, w) in pairwise(hull):
        slope = (w - y) / (z - x)
        # A line that rises with the speed would bind a speed that the relaxation lets go: its end holds instead.
        lines.append((y - slope * x, slope) if slope < 0 else (max(y, w), 0.0))
    return lines


def _turns_left(one: tuple[float, float], two: tuple[float, float], three: tuple[float, float]) -> bool:
    return (two[0] - one[0]) * (three[1] - one[1]) >= (two[1] - one[1]) * (three[0] - one[0])
