"""A second opinion on a smooth run: its force, as a function of time, drives the train, as `verify` does for a plan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array, Course
from workbench.optimal.force_limits import (
    Limits,
    Tables,
    braking_within,
    compiled_resistance,
    device_limits,
    resistance_numbers,
)
from workbench.optimal.smooth_run import SmoothRun
from workbench.optimal.vehicle import Vehicle
from workbench.optimal.verify import POSITION_GAIN, SPEED_GAIN, device_forces

STEP_S = 0.05


@dataclass(frozen=True)
class SmoothCheck:
    """What the simulation says of a smooth run, as `verify.Check`; energy_j: at the supply, with auxiliaries."""

    energy_j: float
    position_drift_m: float
    speed_drift_mps: float
    force_excess: float
    correction_n: float


@compiled()
def _resisted(s: float, v: float, section: int, borders: Array, line: Array, drag: Array,
              numbers: tuple[float, ...]) -> float:
    """What slows the train down at a position on a section of the line, N."""
    share = min(max((s - borders[section]) / (borders[section + 1] - borders[section]), 0.0), 1.0)
    tunnel = drag[section, 0] + share * (drag[section, 1] - drag[section, 0])
    return float(compiled_resistance(v, numbers[1], numbers[2], numbers[3] + tunnel)
                 + line[section, 0] + share * (line[section, 1] - line[section, 0]))


@compiled()
def _at(s: float, section: int, borders: Array) -> int:
    """The section of a position, searched from one nearby."""
    while section < len(borders) - 2 and s > borders[section + 1]:
        section += 1
    while section > 0 and s < borders[section]:
        section -= 1
    return section


@compiled()
def _drive(breaks: Array, start: Array, borders: Array, line: Array, drag: Array, numbers: tuple[float, ...],
           limits: Limits, tables: Tables,
           step_s: float) -> tuple[float, float, float, float, float]:
    """Energy without auxiliaries, drift of position and speed, excess of force, largest correction.

    start: shape (n, 4): position, speed, acceleration and jerk at the start of each piece.
    """
    inertia, friction, efficiency, regain = numbers[0], numbers[4], numbers[5], numbers[6]
    s, v = start[0, 0], start[0, 1]
    energy, off_s, off_v, over, corrected = 0.0, 0.0, 0.0, 0.0, 0.0
    slope = np.empty((4, 2))
    here, planned = 0, 0
    for k in range(len(start)):
        s_0, v_0, a_0, jerk = start[k]
        steps = max(1, int(np.ceil((breaks[k + 1] - breaks[k]) / step_s)))
        dt = (breaks[k + 1] - breaks[k]) / steps
        for i in range(steps):
            for stage in range(4):
                ahead = 0.0 if stage == 0 else (1.0 if stage == 3 else 0.5)
                at = s + (slope[stage - 1, 0] * ahead * dt if stage else 0.0)
                fast = v + (slope[stage - 1, 1] * ahead * dt if stage else 0.0)
                t = (i + ahead) * dt
                a_plan = a_0 + jerk * t
                v_plan = max(v_0 + (a_0 + jerk * t / 2) * t, 0.0)
                s_plan = s_0 + (v_0 + (a_0 / 2 + jerk * t / 6) * t) * t
                planned, here = _at(s_plan, planned, borders), _at(at, here, borders)
                stands = v_plan <= 1e-9 and abs(a_plan) <= 1e-9
                resisted = _resisted(at, max(fast, 0.0), here, borders, line, drag, numbers)
                u = inertia * a_plan + _resisted(s_plan, v_plan, planned, borders, line, drag, numbers)
                most = device_forces(v_plan, limits, tables)[0]
                if not stands:  # else the brakes hold the train
                    over = max(over, u / most - 1.0 if u > 0 else
                               -u / braking_within(limits, tables, friction, v_plan) - 1.0)
                push = inertia * (POSITION_GAIN * (s_plan - at) + SPEED_GAIN * (v_plan - fast))
                u = push + (resisted if stands else u)
                corrected = max(corrected, abs(push))
                slope[stage, 0], slope[stage, 1] = fast, (u - resisted) / inertia
                brake = device_forces(max(fast, 0.0), limits, tables)[1]
                weight = dt / 6 if stage in (0, 3) else dt / 3
                energy += weight * fast * (u / efficiency if u > 0 else regain * max(u, -brake))
            s += dt / 6 * (slope[0, 0] + 2 * slope[1, 0] + 2 * slope[2, 0] + slope[3, 0])
            v += dt / 6 * (slope[0, 1] + 2 * slope[1, 1] + 2 * slope[2, 1] + slope[3, 1])
            t = (i + 1) * dt
            off_s = max(off_s, abs(s - s_0 - (v_0 + (a_0 / 2 + jerk * t / 6) * t) * t))
            off_v = max(off_v, abs(v - v_0 - (a_0 + jerk * t / 2) * t))
    return energy, off_s, off_v, over, corrected


def check_smooth(vehicle: Vehicle, course: Course, run: SmoothRun, step_s: float = STEP_S) -> SmoothCheck:
    """Drive a smooth run's force over time in steps of at most step_s, aligned with its pieces."""
    numbers = (*resistance_numbers(vehicle), float(vehicle.traction_efficiency), float(vehicle.regenerative_efficiency))
    start = np.column_stack((run.position_m, run.speed_mps, run.acceleration_mps2, run.jerk_mps3))
    energy, off_s, off_v, over, push = _drive(run.breaks_s, start, course.position_m, course.force_n, course.drag,
                                              numbers, *device_limits(vehicle), step_s)
    return SmoothCheck(energy + vehicle.auxiliary_w * run.trip_time_s, off_s, off_v, max(over, 0.0), push)
