"""A second opinion on a run: its force, as a function of time, drives the train in a fine simulation.

The simulation shares nothing with the plan but the train's resistance and the line's numbers: it integrates position
and speed over time by RK4, and energy as power. Over a summit a force in time alone holds no train, since rounding
grows there; so a weak correction is added, whose largest value is told: if mesh, time or force of the plan were wrong,
it would be large.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array
from workbench.optimal.force_limits import (
    Limits,
    Tables,
    braking_within,
    compiled_resistance,
    device_limits,
    force_in,
    resistance_numbers,
)
from workbench.optimal.profile import Profile
from workbench.optimal.vehicle import Vehicle

# The correction's gains, 1/s^2 and 1/s: it acts within some ten seconds.
POSITION_GAIN, SPEED_GAIN = 0.01, 0.2
# As near to a border of the line as this, a train may be on either side of it.
TOUCHING_M = 1e-3
# Slower than this a lag says nothing of time.
STILL_MPS = 0.1


@dataclass(frozen=True)
class Check:
    """What the simulation says of a run.

    correction_n: the largest force that was added to keep to the plan.

    energy_j: at the supply, with auxiliaries. position_drift_m, speed_drift_mps: largest distance from the plan.
    force_excess: the plan's largest force beyond traction or both brakes, as a share of the limit there, before
    corrections. speed_excess_mps:
    above the speed limit. lag_m: shape (n + 1,), by how much the train is behind the plan at each node of the run.
    """

    energy_j: float
    position_drift_m: float
    speed_drift_mps: float
    force_excess: float
    speed_excess_mps: float
    correction_n: float
    lag_m: Array

    def clock_s(self, profile: Profile) -> Array:
        """When the simulated train passes the run's nodes, s, shape (n + 1,); at a standstill the plan's own time."""
        speed = profile.speed_mps
        moving = speed > STILL_MPS
        return np.asarray(profile.time_s + np.where(moving, self.lag_m / np.where(moving, speed, 1.0), 0.0))


@compiled(error_model="numpy", _nrt=False)
def _against(speed: float, share: float, cell: int, line: Array, drag: Array, a: float, b: float, c: float) -> float:
    """What slows the train down at a share of a cell, N: resistance, tunnel and line."""
    tunnel = drag[cell, 0] + share * (drag[cell, 1] - drag[cell, 0])
    return float(compiled_resistance(speed, a, b, c + tunnel) + line[cell, 0] + share * (line[cell, 1] - line[cell, 0]))


@compiled(error_model="numpy", _nrt=False)
def device_forces(v: float, limits: Limits, tables: Tables) -> tuple[float, float]:
    """What traction and the electric brake give at a speed, N."""
    most = limits[0][0] if v * limits[0][0] <= limits[0][1] else limits[0][1] / v
    brake = limits[1][0] if v * limits[1][0] <= limits[1][1] else limits[1][1] / v
    if len(tables[0]):
        most = min(most, force_in(tables[0], v))
    if len(tables[1]):
        brake = min(brake, force_in(tables[1], v))
    return most, brake


@compiled(error_model="numpy", _nrt=False)
def _drive(time: Array, position: Array, speed: Array, acceleration: Array, limit: Array, line: Array, drag: Array,
           numbers: tuple[float, ...], limits: Limits, tables: Tables,
           step_s: float, lag: Array, slope: Array) -> tuple[float, float, float, float, float, float]:
    """Energy without auxiliaries, drift of position and speed, excess of force and speed, largest correction.

    The arrays are those of a profile; `lag` is filled with the way that is missing at each node.
    """
    inertia, a, b, c, friction, efficiency, regain = numbers
    s, v = position[0], speed[0]
    energy, off_s, off_v, over_force, over_speed, corrected = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    v_plan, s_plan, planned = v, s, 0.0
    cell = 0
    for k in range(len(acceleration)):
        steps = max(1, int(np.ceil((time[k + 1] - time[k]) / step_s)))
        dt = (time[k + 1] - time[k]) / steps
        for i in range(steps):
            for stage in range(4):
                ahead = 0.0 if stage == 0 else (1.0 if stage == 3 else 0.5)
                ds = slope[stage - 1, 0] * ahead * dt if stage else 0.0
                dv = slope[stage - 1, 1] * ahead * dt if stage else 0.0
                # The command: what the plan needs at this time, from the plan's own position and speed. Two stages are
                # at the same time, and a step begins when the last one ends.
                if stage in (1, 3) or (stage == 0 and i == 0):
                    t = (i + ahead) * dt
                    v_plan = speed[k] + acceleration[k] * t
                    s_plan = position[k] + (speed[k] + acceleration[k] * t / 2) * t
                    share = min(max((s_plan - position[k]) / (position[k + 1] - position[k]), 0.0), 1.0)
                    planned = inertia * acceleration[k] + _against(v_plan, share, k, line, drag, a, b, c)
                    plan_most = device_forces(max(v_plan, 0.0), limits, tables)[0]
                    if planned > 0:
                        over_force = max(over_force, planned / plan_most - 1.0)
                    else:
                        over_force = max(over_force,
                                         -planned / braking_within(limits, tables, friction, max(v_plan, 0.0)) - 1.0)
                u = planned
                # The train: where it really is.
                at, fast = s + ds, v + dv
                push = inertia * (POSITION_GAIN * (s_plan - at) + SPEED_GAIN * (v_plan - fast))
                corrected = max(corrected, abs(push))
                u += push
                cell = min(cell, len(acceleration) - 1)
                if position[k] - TOUCHING_M <= at <= position[k + 1] + TOUCHING_M:
                    cell = k  # at a border the plan's own side, so that rounding does not decide
                while cell < len(acceleration) - 1 and at > position[cell + 1] + TOUCHING_M:
                    cell += 1
                while cell > 0 and at < position[cell] - TOUCHING_M:
                    cell -= 1
                share = min(max((at - position[cell]) / (position[cell + 1] - position[cell]), 0.0), 1.0)
                resistance = _against(fast, share, cell, line, drag, a, b, c)
                slope[stage, 0], slope[stage, 1] = fast, (u - resistance) / inertia
                weight = dt / 6 if stage in (0, 3) else dt / 3
                pull = max(fast, 0.0)
                brake = device_forces(pull, limits, tables)[1]
                energy += weight * fast * (u / efficiency if u > 0 else regain * max(u, -brake))
            s += dt / 6 * (slope[0, 0] + 2 * slope[1, 0] + 2 * slope[2, 0] + slope[3, 0])
            v += dt / 6 * (slope[0, 1] + 2 * slope[1, 1] + 2 * slope[2, 1] + slope[3, 1])
            t = (i + 1) * dt
            off_s = max(off_s, abs(s - position[k] - (speed[k] + acceleration[k] * t / 2) * t))
            off_v = max(off_v, abs(v - speed[k] - acceleration[k] * t))
            over_speed = max(over_speed, v - limit[cell])
        lag[k + 1] = position[k + 1] - s
    return energy, off_s, off_v, over_force, over_speed, corrected


def check(vehicle: Vehicle, profile: Profile, step_s: float = 0.1) -> Check:
    """Drive the run's force over time in steps of at most step_s, aligned with its cells."""
    numbers = (*resistance_numbers(vehicle), float(vehicle.traction_efficiency), float(vehicle.regenerative_efficiency))
    limits, tables = device_limits(vehicle)
    course = profile.course
    lag = np.zeros(len(profile.half_square))
    energy, off_s, off_v, force, speed, push = _drive(
        profile.time_s, profile.position_m, profile.speed_mps, profile.acceleration_mps2, course.limit_mps,
        course.force_n, course.drag, numbers, limits, tables, step_s, lag, np.empty((4, 2)))
    return Check(energy + vehicle.auxiliary_w * profile.trip_time_s, off_s, off_v, max(force, 0.0),
                 max(speed, 0.0) if math.isfinite(speed) else math.inf, push, lag)
