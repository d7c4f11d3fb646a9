"""The best run as a nonlinear program with constant acceleration an interval: every limit as it is, no relaxation.

The time of an interval is exactly 2 h / (v_k + v_k+1). Its motion is that of the mean force: inertia
(v_k+1^2 - v_k^2) / 2h = force - resistance, with the resistance's mean of both ends, which is exact but for the term
linear in v. Limits of power and tables hold at the mean speed (v_k + v_k+1) / 2, where force times speed is the
interval's mean power.
Stage by stage (speed and time so far; then next speed, traction, both brakes) it has the structure that fatrop wants;
ipopt solves the same program, and alone the one whose clock waits at stops and has windows. Hessians are exact. The
duals of the motion give the same p as the cone program's.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any, Literal

import casadi as ca
import numpy as np

from workbench.compile.kernel import casadi_function
from workbench.optimal.clock_nodes import ClockNodes, clock_nodes
from workbench.optimal.course import Array
from workbench.optimal.grid import Grid
from workbench.optimal.socp import LEAST_MARGIN, NoPlanError, Plan
from workbench.optimal.timetable import Timetable, as_timetable
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance
from workbench.trains.train import a_0, b_0, c_0, v

NlpSolver = Literal["fatrop", "ipopt"]
# What is tried in turn: a solver, from the best run known (True) or from the fastest one.
ATTEMPTS: tuple[tuple[NlpSolver, bool], ...] = (("fatrop", True), ("ipopt", True), ("ipopt", False))
# A free node is no slower than this share of the fastest limit, so that no time is divided by zero.
SLOWEST_SHARE = 1e-3
# Violation of a constraint, in units of its scale, up to which a solution counts.
FEASIBLE = 1e-6
# Of one stage: speed and time at its start; next speed, traction, electric and friction brake.
STATES, CONTROLS = 2, 4
ITERATIONS = 500
# The rows of a stage that hold the windows of arrival and departure begin here.
WINDOW_ROWS = 4


@dataclass(frozen=True)
class _Scales:
    """What the variables are measured in, so that they are around one: m/s, N, s and the objective's J."""

    speed_mps: float
    force_n: float
    time_s: float
    work_j: float


@dataclass(frozen=True)
class _Program:
    """Variables, cost and constraints of all stages in their order, with bounds of both."""

    problem: dict[str, Any]
    lower: Array
    upper: Array
    low_row: Array
    high_row: Array
    rows: tuple[int, ...]
    scales: _Scales


def solve_nlp(vehicle: Vehicle, grid: Grid, asked: Timetable | float, guess: Array, start_mps: float = 0.0,
              end_mps: float = 0.0, solver: NlpSolver = "fatrop", extra_s: Array | None = None) -> Plan:
    """The run of least energy in a timetable or a trip time near `guess`, half the squared speed at the nodes.

    extra_s: what each leg between timing points takes beyond the program. With windows on the way only by ipopt.
    A local optimum: the bound, not the solver, says how good it is. Raises NoPlanError where the solver finds none or
    returns one that breaks a constraint.
    """
    timetable = as_timetable(grid.course, asked)
    extra = np.zeros(len(timetable.points) - 1) if extra_s is None else extra_s
    clock = clock_nodes(timetable, grid.position_m, extra)
    program = _program(vehicle, grid, clock, start_mps, end_mps)
    first = _first_guess(vehicle, grid, guess, program.scales)
    run = ca.nlpsol("optimal_run", solver, program.problem, _options(solver, program))
    started = time.perf_counter()
    answer = run(x0=first, lbx=program.lower, ubx=program.upper, lbg=program.low_row, ubg=program.high_row)
    seconds = time.perf_counter() - started
    stats = run.stats()
    x, rows = np.array(answer["x"]).ravel(), np.array(answer["g"]).ravel()
    with np.errstate(invalid="ignore"):
        violation = float(np.max(np.concatenate((program.low_row - rows, rows - program.high_row,
                                                 program.lower - x, x - program.upper))))
    status = str(stats.get("return_status", "failed"))
    if not stats["success"] or not violation <= FEASIBLE:
        raise NoPlanError(f"{solver} says '{status}' of the nonlinear program and breaks a constraint by "
                          f"{violation:.2g}: try other intervals")
    return _plan(vehicle, grid, program, x, np.array(answer["lam_g"]).ravel(), float(answer["f"]), seconds, status,
                 clock)


def _program(vehicle: Vehicle, grid: Grid, nodes: ClockNodes, start_mps: float, end_mps: float) -> _Program:
    h, n = grid.step_m, len(grid.limit_mps)
    scales = _Scales(float(grid.limit_mps.max()), max(vehicle.traction.at(0.0), vehicle.braking_n), nodes.horizon_s,
                     max(vehicle.traction.at(0.0), vehicle.braking_n) * grid.course.length_m)
    free = ~grid.stands
    free[-1] = False
    one = ca.SX.sym("stage", STATES + CONTROLS, n)
    last = ca.SX.sym("last", STATES)
    now, clock, then, pull, brake, grip = (one[i, :] for i in range(STATES + CONTROLS))
    row = [np.asarray(value)[None, :] for value in (h, grid.force_n, grid.drag)]
    step, line, drag = (ca.DM(value) for value in row)
    v_0, v_1 = now * scales.speed_mps, then * scales.speed_mps
    mean = (v_0 + v_1) / 2
    davis = casadi_function("davis", (v, a_0, b_0, c_0), (davis_resistance(v, a_0, b_0, c_0),)).map(n)
    numbers = [ca.repmat(ca.DM(value), 1, n) for value in vehicle.davis_n]
    resistance = ((davis(v_0, *numbers) + davis(v_1, *numbers)) / 2 + drag * (v_0**2 + v_1**2) / 2 + line)
    inertia = vehicle.inertia_kg * (v_1**2 - v_0**2) / (2 * step)
    motion = (inertia + resistance) / scales.force_n - pull + brake + grip
    duration = step / mean / scales.time_s
    # What the next stage must start with, then what holds on this one; each a row with its bounds.
    ahead = ca.horzcat(one[:STATES, 1:], last)
    ending = np.where(free, np.inf, 0.0)[1:]
    ending[-1] = end_mps
    top = np.minimum(grid.node_limit_mps[1:], ending) / scales.speed_mps
    slowest = np.where(np.isinf(ending), SLOWEST_SHARE, top)
    slowest = np.maximum(slowest, np.minimum(grid.node_least_mps[1:] * LEAST_MARGIN / scales.speed_mps, top))
    between = nodes.between / scales.time_s
    table: list[tuple[Any, Any, Any]] = [
        (ahead[0, :] - then, 0.0, 0.0), (ahead[1, :] - clock - duration, between[:, 0], between[:, 1]),
        (motion, 0.0, 0.0),
        (then, slowest, top)]
    if nodes.timetable.trip_time_s is None:
        table += [(clock + duration, *(nodes.arrival / scales.time_s).T), (clock, *(nodes.departure / scales.time_s).T)]
    for force, limit in ((pull, vehicle.traction), (brake, vehicle.regenerative)):
        if np.isfinite(limit.power_w) and limit.force_n > 0:
            table.append((force * mean * scales.force_n / limit.power_w, -np.inf, 1.0))
        if limit.table:
            table.append((force - _table(limit.table, mean) / scales.force_n, -np.inf, 0.0))
    if vehicle.braking_table:
        table.append((brake + grip - _table(vehicle.braking_table, mean) / scales.force_n, -np.inf, 0.0))
    most, least = vehicle.max_acceleration_mps2, vehicle.max_deceleration_mps2
    if np.isfinite(min(most, least)):
        table.append((inertia / vehicle.inertia_kg, -least, most))
    cost = (ca.dot(step, pull) / vehicle.traction_efficiency - vehicle.regenerative_efficiency * ca.dot(step, brake)
            ) * scales.force_n / scales.work_j
    cost += vehicle.auxiliary_w * scales.time_s / scales.work_j * (last[1] - one[1, 0])
    rows = ca.vertcat(*(expression for expression, _, _ in table))
    low = np.stack([np.broadcast_to(bound, n) for _, bound, _ in table]).astype(float)
    high = np.stack([np.broadcast_to(bound, n) for _, _, bound in table]).astype(float)
    # A run may begin later than at zero where its departure's own row says until when.
    later = np.inf if np.isfinite(nodes.departure[0, 0]) else 0.0
    begin = ca.vertcat(one[0, 0] - start_mps / scales.speed_mps, one[1, 0])
    problem = {"x": ca.vertcat(ca.vec(one), last), "f": cost,
               "g": ca.vertcat(rows[:, 0], begin, ca.vec(rows[:, 1:]), last[1])}
    stage_low = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    stage_high = [np.inf, np.inf, np.inf, vehicle.traction.force_n / scales.force_n,
                  vehicle.regenerative.force_n / scales.force_n, vehicle.friction_brake_n / scales.force_n]
    stage_low[0] = stage_low[1] = stage_low[2] = -np.inf  # held by rows
    return _Program(problem, np.append(np.tile(stage_low, n), [-np.inf] * 2),
                    np.append(np.tile(stage_high, n), [np.inf] * 2),
                    np.concatenate((low[:, 0], [0.0, 0.0], low[:, 1:].T.ravel(), [-np.inf])),
                    np.concatenate((high[:, 0], [0.0, later], high[:, 1:].T.ravel(), [1.0])),
                    (len(table), n), scales)


def _table(table: tuple[tuple[float, float], ...], speed: Any) -> Any:
    """The table's force at the speeds of all stages: linear between its points and constant beyond them."""
    speeds, values = (np.array(column, dtype=float) for column in zip(*table, strict=True))
    slopes = np.diff(values) / np.diff(speeds)
    bends = np.diff(np.concatenate(([0.0], slopes, [0.0])))
    return values[0] + sum(float(bend) * ca.fmax(speed - float(at), 0) for at, bend in zip(speeds, bends, strict=True))


def _first_guess(vehicle: Vehicle, grid: Grid, half_square: Array, scales: _Scales) -> Array:
    """The run through the given speeds, with the forces that it needs."""
    b = np.maximum(half_square, (SLOWEST_SHARE * scales.speed_mps) ** 2 / 2)
    b[grid.stands] = 0.0
    b[[0, -1]] = half_square[[0, -1]]
    speed = np.sqrt(2 * b)
    clock = np.insert(np.cumsum(2 * grid.step_m / (speed[1:] + speed[:-1])), 0, 0.0)
    a, b_1, c = vehicle.davis_n
    mean, square = (speed[1:] + speed[:-1]) / 2, b[1:] + b[:-1]
    force = vehicle.inertia_kg * np.diff(b) / grid.step_m + a + b_1 * mean + (c + grid.drag) * square + grid.force_n
    electric = np.clip(-force, 0.0, vehicle.regenerative.force_n)
    stages = np.stack((speed[:-1] / scales.speed_mps, clock[:-1] / scales.time_s, speed[1:] / scales.speed_mps,
                       np.maximum(force, 0.0) / scales.force_n, electric / scales.force_n,
                       np.maximum(-force - electric, 0.0) / scales.force_n))
    return np.concatenate((stages.T.ravel(), [speed[-1] / scales.speed_mps, clock[-1] / scales.time_s]))


def _options(solver: NlpSolver, program: _Program) -> dict[str, Any]:
    quiet = {"print_time": False, "error_on_fail": False}
    if solver == "ipopt":
        return quiet | {"ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-9, "max_iter": ITERATIONS,
                                  "mu_strategy": "adaptive"}}
    per_stage, n = program.rows
    path = per_stage - STATES
    return quiet | {
        "structure_detection": "manual", "N": n, "nx": [STATES] * (n + 1), "nu": [CONTROLS] * n + [0],
        "ng": [path + STATES, *[path] * (n - 1), 1], "equality": (program.low_row == program.high_row).tolist(),
        "fatrop": {"print_level": 0, "tol": 1e-9, "max_iter": ITERATIONS}}


def _plan(vehicle: Vehicle, grid: Grid, program: _Program, x: Array, duals: Array, cost: float, seconds: float,
          status: str, clock: ClockNodes) -> Plan:
    per_stage, n = program.rows
    stages = x[:-STATES].reshape(n, STATES + CONTROLS)
    rows = np.concatenate((duals[:per_stage], duals[per_stage + 2:-1])).reshape(n, per_stage)
    scales = program.scales
    speed = np.maximum(np.append(stages[:, 0], x[-STATES]), 0.0) * scales.speed_mps
    still = grid.stands.copy()
    still[[0, -1]] |= speed[[0, -1]] < 1e-6
    half_square = np.where(still, 0.0, speed**2 / 2)
    work = scales.work_j
    price = rows[:, 2]
    if np.isfinite(min(vehicle.max_acceleration_mps2, vehicle.max_deceleration_mps2)):
        # Limits of the acceleration, in the last row, act on db/ds itself: they belong to the price of what changes b.
        price = price + rows[:, -1] * scales.force_n / vehicle.inertia_kg
    adjoint = price * work / (scales.force_n * grid.step_m)
    price_of_time = _prices(clock, grid, rows, float(duals[-1])) * work / scales.time_s
    return Plan(grid, half_square, (stages[:, 3] - stages[:, 4] - stages[:, 5]) * scales.force_n, adjoint,
                clock.timetable, price_of_time, cost * work, seconds, status, vehicle.auxiliary_w)


def _prices(clock: ClockNodes, grid: Grid, rows: Array, at_end: float) -> Array:
    """The price of each event in scaled units: the duals of its row, and that of the last arrival in all."""
    found = np.zeros(len(clock.timetable.events))
    found[-1] = max(at_end, 0.0)
    if clock.timetable.trip_time_s is None:
        for k, (event, node) in enumerate(zip(clock.timetable.events, clock.nodes(grid.position_m), strict=True)):
            found[k] += rows[node, WINDOW_ROWS + 1] if event.waits else rows[node - 1, WINDOW_ROWS]
    return found
