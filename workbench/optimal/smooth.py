"""A run as a reference that controllers can track: position twice continuously differentiable in time.

The run's acceleration jumps. Its moving average over a window of w seconds does not: it is piecewise linear, its jerk
is at most the change of the acceleration within the window divided by w, and distance and standstill are kept. The
average takes w seconds longer than the run, which therefore is planned for a trip time that is shorter by w.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from workbench.errors import InputError
from workbench.model.desired_curve import DEGREE, DesiredCurve
from workbench.optimal.course import Array, Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.planned_ahead import planned_ahead, waits
from workbench.optimal.profile import Profile, largest_force
from workbench.optimal.reference import Reference, Solver, find_reference, find_timed_reference
from workbench.optimal.timetable import Timetable, as_timetable
from workbench.optimal.vehicle import Vehicle
from workbench.trains.train import davis_resistance

WINDOW_S = 1.0
# Times a window is made longer until the jerk keeps its limit.
JERK_ROUNDS = 12
# Borders closer than this are one.
SLIVER_M = 0.01


@dataclass(frozen=True)
class SmoothRun:
    """A run with continuous acceleration over time: on piece k it is acceleration[k] + jerk[k] (t - breaks_s[k]).

    breaks_s: shape (n + 1,), from 0; position_m, speed_mps, acceleration_mps2, jerk: shape (n,), at the start of each
    piece. Beyond its ends the speed stays.
    """

    breaks_s: Array
    position_m: Array
    speed_mps: Array
    acceleration_mps2: Array
    jerk_mps3: Array

    @property
    def trip_time_s(self) -> float:
        """Time at which it ends."""
        return float(self.breaks_s[-1])

    def at(self, time_s: Array) -> tuple[Array, Array, Array]:
        """Position (m), speed (m/s) and acceleration (m/s^2) at times in s from 0 to the trip time."""
        time_s = np.clip(np.asarray(time_s, dtype=float), 0.0, self.trip_time_s)
        k = np.clip(np.searchsorted(self.breaks_s, time_s, side="right") - 1, 0, len(self.jerk_mps3) - 1)
        t = time_s - self.breaks_s[k]
        s, v, a, j = self.position_m[k], self.speed_mps[k], self.acceleration_mps2[k], self.jerk_mps3[k]
        return s + t * (v + t * (a / 2 + t * j / 6)), v + t * (a + t * j / 2), a + t * j

    def time_at(self, position_m: float) -> float:
        """When it passes a position, s."""
        early, late = 0.0, self.trip_time_s
        for _ in range(80):
            middle = (early + late) / 2
            if float(self.at(np.array([middle]))[0][0]) < position_m:
                early = middle
            else:
                late = middle
        return late

    def desired_curve(self) -> DesiredCurve:
        """As the reference of the adaptive laws; raises WorkbenchError unless it starts and ends at a standstill."""
        rows = np.zeros((len(self.jerk_mps3), DEGREE + 1))
        rows[:, 0], rows[:, 1] = self.position_m - self.position_m[0], self.speed_mps
        rows[:, 2], rows[:, 3] = self.acceleration_mps2 / 2, self.jerk_mps3 / 6
        return DesiredCurve(self.breaks_s, rows)


def smoothed(profile: Profile, window_s: float, dwell_s: float | Array = 0.0) -> SmoothRun:
    """The moving average of a run over window_s; at each inner stop of its course the train stands for dwell_s.

    It begins where the run begins and lasts window_s longer; before and after the run the speed stays as it is there.
    """
    stands = np.isin(profile.position_m[1:-1], profile.course.stops_m)
    duration, acceleration = np.diff(profile.time_s), profile.acceleration_mps2
    where = np.flatnonzero(stands) + 1
    duration, acceleration = np.insert(duration, where, dwell_s), np.insert(acceleration, where, 0.0)
    moving = duration > 0
    duration, acceleration = duration[moving], acceleration[moving]
    times = np.insert(np.cumsum(duration), 0, 0.0)
    last, half = times[-1], window_s / 2
    # In the average's own time, which begins half a window before the run.
    marks = np.unique(np.concatenate((times, times + window_s)))
    marks = marks[np.insert(np.diff(marks) > 1e-9, 0, True)]
    marks[-1] = last + window_s
    speeds = np.insert(np.cumsum(duration * acceleration), 0, 0.0) + profile.speed_mps[0]
    rate = np.concatenate(([0.0], acceleration, [0.0]))

    def piece(t: Array) -> NDArray[np.intp]:
        return np.searchsorted(times, t, side="right")

    def speed(t: Array) -> Array:
        k = np.clip(piece(t) - 1, 0, len(times) - 1)
        return np.asarray(speeds[k] + (np.clip(t, 0.0, last) - times[k]) * np.append(acceleration, 0.0)[k])

    start, width = marks[:-1], np.diff(marks)
    middle = start + width / 2 - half
    jerk = (rate[piece(middle + half)] - rate[piece(middle - half)]) / window_s
    at_start = start - half
    a = (speed(at_start + half) - speed(at_start - half)) / window_s
    v = np.insert(np.cumsum(width * (a + width * jerk / 2)), 0, 0.0)[:-1] + profile.speed_mps[0]
    s = np.insert(np.cumsum(width * (v + width * (a / 2 + width * jerk / 6))), 0, 0.0)[:-1]
    return SmoothRun(marks, s + profile.position_m[0] - profile.speed_mps[0] * half, v, a, jerk)


@dataclass(frozen=True)
class SmoothReference:
    """A smooth run, the optimal run below it, and what smoothing changed.

    energy_j: at the supply. force_excess: largest force beyond its limit, as a share of it; speed_excess_mps: above the
    speed limit; max_jerk_mps3: largest jerk. clock_s: when it is at each event of the timetable; miss_s: by how much
    it misses a window at most.
    """

    run: SmoothRun
    optimal: Reference
    window_s: float
    energy_j: float
    force_excess: float
    speed_excess_mps: float
    max_jerk_mps3: float
    clock_s: Array
    miss_s: float


def smooth_reference(vehicle: Vehicle, course: Course, asked: Timetable | float, window_s: float = WINDOW_S,
                     max_jerk_mps3: float | None = None, dwell_s: float = 0.0, start_mps: float = 0.0,
                     end_mps: float = 0.0, intervals: int | None = None, solver: Solver = "auto") -> SmoothReference:
    """A smooth run in a timetable, or in a trip time in s that includes dwell_s at each inner stop.

    A run that begins or ends at a speed keeps it for half a window there. With a limit of the jerk the window is made
    as long as it takes. Raises InputError, InfeasibleRunError.
    """
    if not window_s > 0 or (max_jerk_mps3 is not None and not max_jerk_mps3 > 0):
        raise InputError("", "window", "the smoothing window and the limit of the jerk must be positive: correct them")
    wait = max(dwell_s, window_s) if course.stops_m else 0.0
    for _ in range(JERK_ROUNDS):
        lowered = _lowered(vehicle, course, window_s)
        start, end = course.position_m[[0, -1]]
        if start_mps or end_mps:
            lowered = lowered.cut(start + start_mps * window_s / 2, end - end_mps * window_s / 2)
        if isinstance(asked, Timetable):
            ahead = planned_ahead(asked, window_s, _margin(vehicle, window_s), lowered)
            optimal = find_timed_reference(vehicle, lowered, ahead, start_mps, end_mps, intervals, solver)
            run = smoothed(optimal.profile, window_s, waits(optimal.timetable, optimal.clock_s))
        else:
            spare = asked - window_s - len(course.stops_m) * wait
            if spare <= 0:
                waiting = f" and {len(course.stops_m)} stops of {wait:g} s" if course.stops_m else ""
                raise InfeasibleRunError(f"smoothing over {window_s:.4g} s{waiting} leave nothing of {asked:g} s to "
                                         "run: allow more time")
            optimal = find_reference(vehicle, lowered, spare, start_mps, end_mps, intervals, solver)
            run = smoothed(optimal.profile, window_s, wait)
        jerk = float(np.abs(run.jerk_mps3).max())
        if max_jerk_mps3 is None or jerk <= max_jerk_mps3:
            found = _judged(vehicle, course, run, optimal, window_s, jerk)
            return _with_clock(found, as_timetable(course, asked))
        window_s *= max(1.02 * jerk / max_jerk_mps3, 1.05)
        wait = max(wait, window_s) if course.stops_m else 0.0
    raise InfeasibleRunError(f"no window keeps the jerk below {max_jerk_mps3:g} m/s^3: allow more")


def _margin(vehicle: Vehicle, window_s: float) -> float:
    """By what the average speed of a braking train exceeds a limit that falls, m/s."""
    return min(vehicle.max_deceleration_mps2, vehicle.braking_n / vehicle.inertia_kg) * window_s / 8


def _with_clock(found: SmoothReference, timetable: Timetable) -> SmoothReference:
    """The same with the clock of the smooth run: a stop is reached a window later, a departure is when it was."""
    planned = found.optimal.clock_s
    if timetable.trip_time_s is not None:
        clock = np.array([0.0, found.run.trip_time_s])
    else:
        passed = [found.run.time_at(point.position_m) for point in timetable.points]
        clock = np.array([planned[k] + (0.0 if event.waits else found.window_s) if event.kind != "passing"
                          else planned[0] + passed[event.point] for k, event in enumerate(timetable.events)])
    windows = [event.window for event in timetable.events]
    miss = max(max(w.earliest_s - t, t - w.latest_s) for w, t in zip(windows, clock.tolist(), strict=True))
    return replace(found, clock_s=clock, miss_s=max(miss, 0.0))


def _lowered(vehicle: Vehicle, course: Course, window_s: float) -> Course:
    """The course with limits lower by what the average of a braking train exceeds them, near where they change.

    Near is a window's way at the limit itself: farther away the average knows one limit only.
    """
    s, speed = course.position_m, course.limit_mps
    changes = np.flatnonzero(np.diff(speed)) + 1
    reach = np.concatenate((s[changes] - window_s * speed[changes - 1], s[changes] + window_s * speed[changes]))
    course = course.split(_apart(reach, s))
    limit, middle = course.limit_mps, (course.position_m[1:] + course.position_m[:-1]) / 2
    after = np.searchsorted(s[changes], middle)
    borders = np.concatenate(([-np.inf], s[changes], [np.inf]))
    near = np.minimum(middle - borders[after], borders[after + 1] - middle) < window_s * limit
    lower = np.where(near, np.maximum(limit - _margin(vehicle, window_s), limit / 2), limit)
    return replace(course, limit_mps=lower)


def _apart(points: Array, borders: Array) -> Array:
    """The points inside the borders that lie a little off each of them."""
    inside = np.sort(points[(points > borders[0]) & (points < borders[-1])])
    after = np.searchsorted(borders, inside)
    return inside[np.minimum(inside - borders[after - 1], borders[after] - inside) > SLIVER_M]


def _judged(vehicle: Vehicle, course: Course, run: SmoothRun, optimal: Reference, window_s: float,
            jerk: float) -> SmoothReference:
    """Energy and excesses by fine sampling of every piece."""
    width = np.diff(run.breaks_s)
    count = np.maximum(1, np.ceil(width / 0.1)).astype(int)
    k = np.repeat(np.arange(len(width)), count)
    step = width[k] / count[k]
    first = np.insert(np.cumsum(count), 0, 0)[:-1]
    time = run.breaks_s[k] + (np.arange(len(k)) - first[k] + 0.5) * step
    s, v, a = run.at(time)
    force = needed_force(vehicle, course, s, v, a)
    most = largest_force(vehicle.traction, v)
    electric = largest_force(vehicle.regenerative, v)
    excess = np.where(force > 0, force / most, -force / (electric + vehicle.friction_brake_n)) - 1
    limit = course.limit_mps[np.clip(np.searchsorted(course.position_m, s) - 1, 0, len(course.limit_mps) - 1)]
    power = v * np.where(force > 0, force / vehicle.traction_efficiency,
                         vehicle.regenerative_efficiency * np.maximum(force, -electric))
    return SmoothReference(run, optimal, window_s, float(power @ step) + vehicle.auxiliary_w * run.trip_time_s,
                           max(float(excess.max()), 0.0), max(float((v - limit).max()), 0.0), jerk,
                           optimal.clock_s, 0.0)


def needed_force(vehicle: Vehicle, course: Course, s: Array, v: Array, a: Array) -> Array:
    """Force at the wheel in N for positions (m), speeds (m/s) and accelerations (m/s^2)."""
    k = np.clip(np.searchsorted(course.position_m, s) - 1, 0, len(course.limit_mps) - 1)
    share = np.clip((s - course.position_m[k]) / np.diff(course.position_m)[k], 0.0, 1.0)
    line = course.force_n[k, 0] + share * (course.force_n[k, 1] - course.force_n[k, 0])
    drag = course.drag[k, 0] + share * (course.drag[k, 1] - course.drag[k, 0])
    a_0, b_1, c = vehicle.davis_n
    return np.asarray(vehicle.inertia_kg * a + davis_resistance(v, a_0, b_1, c + drag) + line)
