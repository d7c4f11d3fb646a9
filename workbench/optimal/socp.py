"""The best run as a second-order-cone program in position: fast, convex, and its dual gives the bound.

Half the squared speed b is the state, so that motion is linear in it: inertia db/ds = force - resistance. With constant
acceleration on an interval of length h the time is exactly 2 h / (v_k + v_k+1), at a start from standstill too. Relaxed
are v <= sqrt(2 b) and the time from below; both are tight where the trip time binds. A limit of power is force h <=
power x time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.clock_rows import clock_rows
from workbench.optimal.cone_program import ConeProgram, Linear, NoPlanError
from workbench.optimal.course import Array
from workbench.optimal.force_majorants import majorants
from workbench.optimal.grid import Grid
from workbench.optimal.open_rows import Mask, OpenRows, all_open, open_rows, rightly_closed, thinned
from workbench.optimal.timetable import Timetable, as_timetable, counted
from workbench.optimal.vehicle import ForceLimit, Vehicle

# From so many intervals on a coarser program comes first. A program of which it leaves more than this share open is
# solved whole: near the least time next to nothing can be left out, and what was would be needed after all.
COARSE_FIRST, MOSTLY_OPEN = 2000, 0.5
# With less than this share of the least time to spare next to nothing of a program can be left out.
TIGHT = 0.002
# An interval's share of the energy has about this unit, by which clarabel takes the fewest iterations; near the least
# time, where seconds are dear, a larger one. The lower and upper limit were measured, and so was the rise between them.
UNIT_SHARES, UNIT_RISE = (1 / 40, 1 / 3), 20 / 3
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

    @cached_property
    def interval_prices_w(self) -> Array:
        """What a second less costs on each interval, auxiliaries included, shape (n,)."""
        drawn = counted(self.auxiliary_w)
        return self.timetable.cell_prices(self.timetable.fair(self.prices_w, drawn), self.grid.position_m, drawn)


def solve_socp(vehicle: Vehicle, grid: Grid, asked: Timetable | float, start_mps: float = 0.0,
               end_mps: float = 0.0, extra_s: Array | None = None, *, spare: float = np.inf) -> Plan:
    """The run of least energy in a timetable or a trip time in s; raises NoPlanError where clarabel finds none.

    extra_s: seconds that each leg between timing points takes beyond what the program knows; none where not given.
    spare: by which share of the least time more is allowed, as far as that is known. A large program is solved on a
    coarser mesh first, and then without what that leaves no use for, unless next to nothing is spare.
    """
    ends, spent = (start_mps, end_mps), 0.0
    unit = cost_unit(grid, spare)
    if len(grid.limit_mps) >= COARSE_FIRST and spare >= TIGHT:
        try:
            coarse, price = _solve(vehicle, thinned(grid), asked, ends, extra_s=extra_s, unit=unit)
            spent = coarse.solve_s
            rows = open_rows(vehicle, grid, coarse.grid, coarse.half_square, coarse.force_n, price)
            if rows.share <= MOSTLY_OPEN:
                plan, price = _solve(vehicle, grid, asked, ends, rows, extra_s, unit)
                spent += plan.solve_s
                if rightly_closed(vehicle, grid, rows, plan.half_square, plan.force_n, price):
                    return replace(plan, solve_s=spent)
        except NoPlanError:
            pass  # the whole program says whether there is none
    plan, _ = _solve(vehicle, grid, asked, ends, extra_s=extra_s, unit=unit)
    return replace(plan, solve_s=spent + plan.solve_s)


def cost_unit(grid: Grid, spare: float = np.inf) -> float:
    """The unit of the cost, as a share of the largest force over the whole way, for so much time to `spare`."""
    return 1 / (len(grid.limit_mps) * float(np.clip(UNIT_RISE * spare, *UNIT_SHARES)))


def _solve(vehicle: Vehicle, grid: Grid, asked: Timetable | float, ends_mps: tuple[float, float],
           rows: OpenRows | None = None, extra_s: Array | None = None, unit: float = 1.0) -> tuple[Plan, Array]:
    """The plan, and what a newton more at the wheel is worth on each interval, J/m per N."""
    h, n = grid.step_m, len(grid.limit_mps)
    rows = rows or all_open(grid)
    inertia, (a, b_1, c) = vehicle.inertia_kg, vehicle.davis_n
    # Scales: variables are around one.
    force = max(vehicle.traction.at(0.0), vehicle.braking_n)
    speed = _largest_speed(vehicle, grid, max(ends_mps))
    clock = clock_rows(as_timetable(grid.course, asked), grid.position_m, extra_s)
    mean_time = clock.horizon_s / n
    half = speed**2
    work = force * grid.course.length_m

    program, b, v, tau, (pull, brake, grip), wait = _variables(vehicle, n, rows, clock.free_waits)
    b_mean, v_mean = 0.5 * (b[1:] + b[:-1]), 0.5 * (v[1:] + v[:-1])
    # Newton's law, in units between force and work: as force its numbers would be large on short intervals.
    row = np.sqrt(h / h.mean())
    motion = program.require_zero((row * inertia * half / (2 * h * force)) * (b[1:] - b[:-1])
                                  + row * (brake + grip - pull) + row * (a + grid.force_n) / force
                                  + (row * (grid.drag + c) * half / force) * b_mean
                                  + (row * b_1 * speed / force) * v_mean)
    fixed = grid.stands.copy()
    fixed[[0, -1]] = True
    value = np.zeros(n + 1)
    value[[0, -1]] = (np.array(ends_mps) / speed) ** 2
    top = (grid.node_limit_mps / speed) ** 2
    free = ~fixed
    fast = free & rows.top
    least = (np.minimum(grid.node_least_mps * LEAST_MARGIN, grid.node_limit_mps) / speed) ** 2
    held = free & (least > 0)
    program.require_zero(b[fixed] - value[fixed])
    program.require_zero(v[fixed] - np.sqrt(value[fixed]))
    program.require_at_most(-1.0 * program.variables(3 * n + 2, program.size - 3 * n - 2))
    program.require_at_most(b[fast] - top[fast])
    windows = clock.rules(program, tau, wait, mean_time)
    program.require_at_most(-1.0 * b[held] + least[held])
    if vehicle.friction_brake_n > 0:
        program.require_at_most(grip - vehicle.friction_brake_n / force)
    for side, limit, near in ((pull, vehicle.traction, rows.pull_limit), (brake, vehicle.regenerative, rows.brake)):
        if limit.force_n > 0:
            _require_limits(program, side, limit, grid, (tau, v_mean, b_mean), (force, speed, mean_time),
                            np.flatnonzero(near))
    if vehicle.braking_table:
        most = ForceLimit(max(force_n for _, force_n in vehicle.braking_table), table=vehicle.braking_table)
        _require_limits(program, brake + grip, most, grid, (tau, v_mean, b_mean), (force, speed, mean_time),
                        np.flatnonzero(rows.brake))
    if b_1 > 0:  # else the resistance would fall with a speed that the relaxation lets go
        program.require_at_most((1 / np.sqrt(top[free])) * b[free] - v[free])
    comfort = [(sign, program.require_at_most(sign * (b[1:] - b[:-1]) - 2 * limit * h / half))
               for limit, sign in ((vehicle.max_acceleration_mps2, 1.0), (vehicle.max_deceleration_mps2, -1.0))
               if np.isfinite(limit)]
    # v^2 <= b and tau (v_k + v_k+1) >= 2 h, in units of the scales
    program.require_cones(b[free] + 1.0, 2.0 * v[free], b[free] - 1.0)
    program.require_cones(tau + 2.0 * v_mean, tau - 2.0 * v_mean,
                          program.nothing(n) + 2 * np.sqrt(2 * h / (mean_time * speed)))
    used = program.factors(pull, h) / vehicle.traction_efficiency
    returned = vehicle.regenerative_efficiency * program.factors(brake, h)
    drawn = vehicle.auxiliary_w * mean_time / work * clock.between_ends(program, tau, wait)
    found = program.solve((used - returned) / grid.course.length_m + drawn,
                          f"the cone program of {n} intervals for {clock.horizon_s:g} s", unit)
    price = row * found.price(motion) * work / (force * h)
    # Limits of the acceleration act on db/ds itself: they belong to the price of what changes b.
    adjoint = price
    for sign, rule in comfort:
        adjoint = adjoint + sign * found.price(rule) * 2 * work / (half * inertia)
    half_square = np.where(fixed, value, np.maximum(found.of(b), 0.0)) * half / 2
    plan = Plan(grid, half_square, found.of(pull - brake - grip) * force, adjoint,
                clock.timetable, clock.prices(found, windows) * work / mean_time,
                found.cost * work + vehicle.auxiliary_w * clock.fixed_between_ends_s,
                found.solve_s, found.status, vehicle.auxiliary_w)
    return plan, price


def _largest_speed(vehicle: Vehicle, grid: Grid, ends_mps: float) -> float:
    """A speed in m/s that no run passes: the highest limit, or less where the line is too short for the train."""
    most = max(vehicle.traction.force_n - vehicle.davis_n[0] - float(grid.force_n.min()), 0.0) / vehicle.inertia_kg
    return float(min(grid.limit_mps.max(), max(np.sqrt(ends_mps**2 + 2 * most * grid.course.length_m), ends_mps)))


def _variables(vehicle: Vehicle, n: int, rows: OpenRows,
               waits: int) -> tuple[ConeProgram, Linear, Linear, Linear, list[Linear], Linear]:
    """The program with b, v, tau, the forces of traction, electric and friction brake, and the free waits.

    From the forces on no variable is negative.
    """
    # A brake that the train does not have costs time all the same.
    used = [(rows.pull, True), (rows.brake, vehicle.regenerative.force_n > 0),
            (rows.brake, vehicle.friction_brake_n > 0)]
    counts = [int(where.sum()) if is_there else 0 for where, is_there in used]
    starts = 3 * n + 2 + np.insert(np.cumsum(counts), 0, 0)
    program = ConeProgram(int(starts[-1]) + waits)
    forces = [_where(program, where, int(start), count)
              for (where, _), start, count in zip(used, starts, counts, strict=False)]
    return (program, program.variables(0, n + 1), program.variables(n + 1, n + 1), program.variables(2 * n + 2, n),
            forces, program.variables(int(starts[-1]), waits))


def _where(program: ConeProgram, used: Mask, start: int, count: int) -> Linear:
    """A force on some of the intervals, whose variables begin at `start`, and zero on the others."""
    if not count:
        return program.nothing(len(used))
    at = np.flatnonzero(used)
    return Linear(at, start + np.arange(count), np.ones(count), np.zeros(len(used)))


def _require_limits(program: ConeProgram, force: Linear, limit: ForceLimit, grid: Grid,
                    motion: tuple[Linear, Linear, Linear], scales: tuple[float, float, float],
                    at: NDArray[np.intp]) -> None:
    """Limits of one force on intervals `at`, in scaled units; a table by what lies above it.

    motion: the time of each interval, its mean speed, and the mean square of that.
    """
    (tau, v_mean, b_mean), (unit, speed, mean_time) = motion, scales
    if not len(at):
        return
    program.require_at_most(force[at] - limit.force_n / unit)
    if np.isfinite(limit.power_w):
        program.require_at_most((grid.step_m[at] * unit / (limit.power_w * mean_time)) * force[at] - tau[at])
    for constant, inverse, slope, square in majorants(limit, speed):
        rise = inverse * mean_time / (grid.step_m[at] * unit)
        row = 1 / (1 + rise)  # on a short interval its coefficient is large
        program.require_at_most(row * (force[at] - (slope * speed / unit) * v_mean[at]
                                       - (square * speed**2 / unit) * b_mean[at] - constant / unit)
                                - (row * rise) * tau[at])
