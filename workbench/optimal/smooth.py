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
from workbench.files.numbers import counted
from workbench.optimal.course import Array, Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.force_reserve import ForceSamples, Reserve, force_samples, more_reserves, with_reserves
from workbench.optimal.planned_ahead import planned_ahead, waits
from workbench.optimal.planning import PARTS
from workbench.optimal.profile import Profile
from workbench.optimal.reference import Reference, Solver, find_reference, find_timed_reference
from workbench.optimal.smooth_run import SmoothRun
from workbench.optimal.timetable import Timetable, as_timetable
from workbench.optimal.vehicle import Vehicle

WINDOW_S = 1.0
# Times a window is made longer until the jerk keeps its limit.
JERK_ROUNDS = 12
# Times more of the forces is kept back until the smooth run keeps their limits.
FORCE_ROUNDS = 10
# A run of so many intervals' cells is driven anew by the plan at hand; of fewer, plans are made anew, on as many.
MANY_INTERVALS = 2000
# Borders closer than this are one.
SLIVER_M = 0.01


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
    it misses a window at most. usable: the least shares of traction and of the brakes that the plan was allowed so that
    the smooth run keeps their limits; unreserved_energy_j: of the run smoothed without that, which passes them.
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
    usable: tuple[float, float]
    unreserved_energy_j: float


def smooth_reference(vehicle: Vehicle, course: Course, asked: Timetable | float, window_s: float = WINDOW_S,
                     max_jerk_mps3: float | None = None, dwell_s: float = 0.0, start_mps: float = 0.0,
                     end_mps: float = 0.0, intervals: int | None = None, solver: Solver = "auto",
                     like: Reference | None = None) -> SmoothReference:
    """A smooth run in a timetable, or in a trip time in s that includes dwell_s at each inner stop.

    A run that begins or ends at a speed keeps it for half a window there. With a limit of the jerk the window is made
    as long as it takes. like: the run of least energy of this request, where that is known. Raises InputError,
    InfeasibleRunError.
    """
    if not window_s > 0 or (max_jerk_mps3 is not None and not max_jerk_mps3 > 0):
        raise InputError("", "window", "the smoothing window and the limit of the jerk must be positive: correct them")
    wait = max(dwell_s, window_s) if course.stops_m else 0.0
    for _ in range(JERK_ROUNDS):
        request = _Request(vehicle, course, asked, window_s, wait, start_mps, end_mps, intervals, solver,
                           like)
        found = _within_limits(request)
        jerk = found.max_jerk_mps3
        if max_jerk_mps3 is None or jerk <= max_jerk_mps3:
            return _with_clock(found, as_timetable(course, asked))
        window_s *= max(1.02 * jerk / max_jerk_mps3, 1.05)
        wait = max(wait, window_s) if course.stops_m else 0.0
    raise InfeasibleRunError(f"no window keeps the jerk below {max_jerk_mps3:g} m/s^3: allow more")


@dataclass(frozen=True)
class _Request:
    """What is asked of a smooth run for one window; wait_s: at each inner stop of a trip time. like: a reference of
    nearly this request."""

    vehicle: Vehicle
    course: Course
    asked: Timetable | float
    window_s: float
    wait_s: float
    start_mps: float
    end_mps: float
    intervals: int | None
    solver: Solver
    like: Reference | None


def _within_limits(request: _Request) -> SmoothReference:
    """Planned with more and more kept back where the smooth run passes the limits of force, until it passes none.

    The nearest one where that does not end: its `force_excess` says by how much.
    """
    vehicle, course, window_s = request.vehicle, request.course, request.window_s
    reserves: tuple[Reserve, ...] = ()
    first = 0.0
    best: SmoothReference | None = None
    for number in range(FORCE_ROUNDS):
        try:
            run, optimal = _averaged(request, reserves)
            if not number:  # cones from now on: a bound that knows no reserves says nothing of it
                mesh = request.intervals or (len(optimal.profile.half_square) - 1) // PARTS
                few = mesh < MANY_INTERVALS
                request = replace(request, intervals=mesh if few else request.intervals, like=None if few else optimal,
                                  solver="nlp" if request.solver == "nlp" else "socp")
            elif request.like is not None:
                request = replace(request, like=optimal)
        except InfeasibleRunError as trouble:
            if not number:
                raise
            least = trouble.least_time_s
            raise InfeasibleRunError(f"{trouble} (with what smoothing must keep back of traction and brakes, "
                                     f"{_shares(reserves)})", least) from None
        samples = force_samples(vehicle, course, run)
        found = _judged(vehicle, course, run, samples, optimal, window_s)
        first = found.energy_j if not number else first
        found = replace(found, unreserved_energy_j=first, usable=_least_shares(reserves))
        if best is None or found.force_excess < best.force_excess:
            best = found
        more = more_reserves(samples, reserves, window_s) if found.force_excess > 0 else ()
        if not more:
            break
        reserves = more
    assert best is not None
    return best


def _least_shares(reserves: tuple[Reserve, ...]) -> tuple[float, float]:
    of = [min((r.share for r in reserves if r.side == side), default=1.0) for side in (0, 1)]
    return of[0], of[1]


def _shares(reserves: tuple[Reserve, ...]) -> str:
    pull, brake = _least_shares(reserves)
    return f"up to {100 * (1 - pull):.2g} % and {100 * (1 - brake):.2g} %"


def _averaged(request: _Request, reserves: tuple[Reserve, ...]) -> tuple[SmoothRun, Reference]:
    """The smooth run and the one below it; raises InfeasibleRunError."""
    vehicle, course, asked, window_s = request.vehicle, request.course, request.asked, request.window_s
    lowered = with_reserves(_lowered(vehicle, course, window_s), reserves)
    start, end = course.position_m[[0, -1]]
    ends = request.start_mps, request.end_mps
    if any(ends):
        lowered = lowered.cut(start + ends[0] * window_s / 2, end - ends[1] * window_s / 2)
    if isinstance(asked, Timetable):
        ahead = planned_ahead(asked, window_s, _margin(vehicle, window_s), lowered)
        optimal = find_timed_reference(vehicle, lowered, ahead, *ends, request.intervals, request.solver,
                                       request.like)
        return smoothed(optimal.profile, window_s, waits(optimal.timetable, optimal.clock_s)), optimal
    spare = asked - window_s - len(course.stops_m) * request.wait_s
    if spare <= 0:
        waiting = f" and {counted(len(course.stops_m), 'stop')} of {request.wait_s:g} s" if course.stops_m else ""
        leave = "leave" if waiting else "leaves"
        raise InfeasibleRunError(f"smoothing over {window_s:.4g} s{waiting} {leave} nothing of {asked:g} s to run: "
                                 "allow more time")
    try:
        optimal = find_reference(vehicle, lowered, spare, *ends, request.intervals, request.solver, like=request.like)
    except InfeasibleRunError as trouble:
        if trouble.least_time_s is None:
            raise
        least_s = trouble.least_time_s + asked - spare
        raise InfeasibleRunError(f"{asked:g} s is too short: it takes {least_s:.1f} s at least, {asked - spare:g} s of "
                                 f"them for smoothing and waits; of the rest {trouble}", least_s) from None
    return smoothed(optimal.profile, window_s, request.wait_s), optimal


def _margin(vehicle: Vehicle, window_s: float) -> float:
    """By what the average speed of a braking train exceeds a limit that falls, m/s."""
    return min(vehicle.max_deceleration_mps2, vehicle.braking_n / vehicle.inertia_kg) * window_s / 8


def _margins(vehicle: Vehicle, course: Course, window_s: float) -> tuple[float, float]:
    """By what the average speed exceeds a limit that falls and one that rises, m/s, with the line's help."""
    line = course.force_n / vehicle.inertia_kg
    brake = min(vehicle.max_deceleration_mps2, vehicle.braking_n / vehicle.inertia_kg + max(float(line.max()), 0.0))
    pull = min(vehicle.max_acceleration_mps2, vehicle.traction.force_n / vehicle.inertia_kg - min(float(line.min()), 0))
    return brake * window_s / 8, pull * window_s / 8


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
    """The course with limits lower by what the average of a run exceeds them, near where they change.

    Near is a window's way at the limit itself: farther away the average knows one limit only.
    """
    s, speed = course.position_m, course.limit_mps
    changes = np.flatnonzero(np.diff(speed)) + 1
    reach = np.concatenate((s[changes] - window_s * speed[changes - 1], s[changes] + window_s * speed[changes]))
    course = course.split(_apart(reach, s))
    limit, middle = course.limit_mps, (course.position_m[1:] + course.position_m[:-1]) / 2
    after = np.searchsorted(s[changes], middle)
    borders = np.concatenate(([-np.inf], s[changes], [np.inf]))
    brake, pull = _margins(vehicle, course, window_s)
    steps = np.concatenate(([0.0], np.diff(speed)[changes - 1], [0.0]))
    way = window_s * limit
    margin = np.maximum(np.where(middle - borders[after] < way, np.where(steps[after] > 0, pull, brake), 0.0),
                        np.where(borders[after + 1] - middle < way, np.where(steps[after + 1] > 0, pull, brake), 0.0))
    lower = np.maximum(limit - margin, limit / 2)
    return replace(course, limit_mps=lower)


def _apart(points: Array, borders: Array) -> Array:
    """The points inside the borders that lie a little off each of them."""
    inside = np.sort(points[(points > borders[0]) & (points < borders[-1])])
    after = np.searchsorted(borders, inside)
    return inside[np.minimum(inside - borders[after - 1], borders[after] - inside) > SLIVER_M]


def _judged(vehicle: Vehicle, course: Course, run: SmoothRun, found: ForceSamples, optimal: Reference,
            window_s: float) -> SmoothReference:
    """Energy and excesses by fine samples of every piece."""
    s, v, force = found.position_m, found.speed_mps, found.force_n
    limit = course.limit_mps[np.clip(np.searchsorted(course.position_m, s) - 1, 0, len(course.limit_mps) - 1)]
    power = v * np.where(force > 0, force / vehicle.traction_efficiency,
                         vehicle.regenerative_efficiency * np.maximum(force, -found.electric_n))
    energy = float(power @ found.weight_s) + vehicle.auxiliary_w * run.trip_time_s
    return SmoothReference(run, optimal, window_s, energy, max(float(found.excess.max()), 0.0),
                           max(float((v - limit).max()), 0.0), float(np.abs(run.jerk_mps3).max()), optimal.clock_s, 0.0,
                           (1.0, 1.0), energy)
