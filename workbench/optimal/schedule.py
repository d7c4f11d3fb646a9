"""When a run with known times between its timing points meets a timetable, or how little is missing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from workbench.errors import InputError
from workbench.optimal.course import Array
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.profile import Profile
from workbench.optimal.regimes import binding
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import Vehicle

# How much more the largest change of a leg's time weighs than the sum of all.
WORST_WEIGHT = 100.0
# Slower than this on average, and so many times slower than the fastest run, is no train.
SLOWEST_MEAN_MPS, SLOWER = 0.5, 10.0
# Times are aimed at this far inside their windows, for the accuracy of the linear program that does so.
INSIDE_S = 5e-7


@dataclass(frozen=True)
class Miss:
    """The first event that cannot be within its window: by how many seconds, and whether it comes too late."""

    event: int
    by_s: float
    late: bool


def leg_times(timetable: Timetable, profile: Profile) -> Array:
    """Running time of each leg between timing points in s, shape (points - 1,)."""
    at = np.searchsorted(profile.position_m, timetable.position_m)
    return np.diff(profile.time_s[at])


def schedule(timetable: Timetable, leg_s: Array, touch_s: float = 0.0, brief: bool = False) -> Array | Miss:
    """The clock at each event, s, shape (m,), arriving as early as the windows allow; or the first one missed.

    touch_s: by how much a window may be missed. brief: arrive at stops on the way as late as the last arrival allows,
    which lets the first departure be as late as it can: nothing takes less from one to the other.
    """
    events = timetable.events
    low, high = np.empty(len(events)), np.empty(len(events))
    for k, event in enumerate(events):
        earliest, latest = event.window.earliest_s - touch_s, event.window.latest_s + touch_s
        if k == 0:
            low[0], high[0] = event.window.earliest_s, event.window.latest_s
        elif event.waits:
            low[k], high[k] = max(low[k - 1] + event.dwell_s, earliest), latest
        else:
            run = leg_s[event.point - 1]
            low[k], high[k] = max(low[k - 1] + run, earliest), min(high[k - 1] + run, latest)
        if low[k] > high[k]:
            late = low[k] > latest
            return Miss(k, float(low[k] - high[k]), bool(late))
    clock = low.copy()
    for k in range(len(events) - 1, 0, -1):
        if not events[k].waits:
            # Rounding must not take it out of its window.
            clock[k - 1] = min(max(clock[k] - leg_s[events[k].point - 1], low[k - 1]), high[k - 1])
        elif brief:
            clock[k - 1] = min(high[k - 1], clock[k] - events[k].dwell_s)
    return clock


def nearest_legs(timetable: Timetable, leg_s: Array, least_s: Array) -> Array | None:
    """The times of legs, not below least_s, nearest to leg_s in proportion, that meet the timetable; None for none."""
    if not isinstance(schedule(timetable, leg_s), Miss):
        return leg_s
    if timetable.trip_time_s is not None:
        return np.minimum(leg_s, timetable.trip_time_s)
    events, legs = timetable.events, len(leg_s)
    waits = [k for k, event in enumerate(events) if event.waits]
    # Variables: what each leg takes more, and less; each wait beyond its least; the worst change.
    count = 2 * legs + len(waits) + 1
    clock: list[Array] = []
    fixed: list[float] = []
    now, base = np.zeros(count), timetable.origin_s
    for event in events:
        now = now.copy()
        if event.waits:
            now[2 * legs + waits.index(len(clock))] = 1.0
            base += event.dwell_s
        else:
            now[event.point - 1], now[legs + event.point - 1] = 1.0, -1.0
            base += float(leg_s[event.point - 1])
        clock.append(now)
        fixed.append(base)
    rows, limits = [], []
    for row, start, event in zip(clock, fixed, events, strict=True):
        window = event.window
        inside = min(INSIDE_S, (window.latest_s - window.earliest_s) / 2)
        for sign, limit in ((1.0, window.latest_s - inside), (-1.0, window.earliest_s + inside)):
            if math.isfinite(limit):
                rows.append(sign * row)
                limits.append(sign * (limit - start))
    for place in range(2 * legs):
        row = np.zeros(count)
        row[place], row[-1] = 1.0, -leg_s[place % legs]
        rows.append(row)
        limits.append(0.0)
    cost = np.concatenate((np.tile(1 / leg_s, 2), np.zeros(len(waits)), [WORST_WEIGHT]))
    bounds = [(0.0, None)] * legs + [(0.0, max(float(x), 0.0)) for x in leg_s - least_s]
    from scipy.optimize import linprog  # noqa: PLC0415 - slow to import, and few timetables need it

    found = linprog(cost, A_ub=np.array(rows), b_ub=np.array(limits), bounds=bounds + [(0.0, None)] * (len(waits) + 1))
    if found.status != 0:
        return None
    return np.asarray(leg_s + found.x[:legs] - found.x[legs:2 * legs])


def require_plausible(timetable: Timetable, quickest: Profile) -> None:
    """Raises InputError where windows make a train crawl all along: positions or times are in another unit then."""
    least_s = leg_times(timetable, quickest)
    forced_s, before = 0.0, timetable.points[0].departure
    for point, least in zip(timetable.points[1:], least_s.tolist(), strict=True):
        forced_s += max(point.arrival.earliest_s - before.latest_s, least)
        before = point.departure if point.stands else point.arrival
    length_m = quickest.course.length_m
    if length_m < SLOWEST_MEAN_MPS * forced_s and forced_s > SLOWER * float(least_s.sum()):
        raise InputError("", "timetable", f"its windows make {length_m:g} m take {forced_s:.0f} s of running, less "
                         f"than {SLOWEST_MEAN_MPS:g} m/s on average: are its positions in m and its times in s?")


def require_possible(vehicle: Vehicle, timetable: Timetable, quickest: Profile, ideal: Profile) -> None:
    """Raises InfeasibleRunError where even the fastest run is too late for a window, or too slow at a point.

    The fastest run is the fastest at every position, so that no run takes less between any two points. `ideal` is that
    run as near as a mesh comes to it; `quickest` a little slower one that surely keeps every limit, which is told.
    """
    # On cells so long that limits cut their ends `ideal` may be the slower one: what either does can be done.
    leg_s = np.minimum(leg_times(timetable, ideal), leg_times(timetable, quickest))
    for number, point in enumerate(timetable.points):
        most = max(float(np.interp(point.position_m, run.position_m, run.half_square)) for run in (ideal, quickest))
        if point.slowest_mps**2 / 2 > most * (1 + 1e-9) and 0 < number < len(timetable.points) - 1:
            raise InfeasibleRunError(
                f"timing point {number + 1} at {point.position_m:g} m asks for {point.slowest_mps:.4g} m/s at least: "
                f"limits, traction and brakes allow {math.sqrt(2 * most):.4g} m/s there at most: lower its least speed")
    since, earliest = 0, timetable.origin_s
    for k, event in enumerate(timetable.events):
        before = earliest
        earliest += (event.dwell_s if event.waits else float(leg_s[event.point - 1])) if k else 0.0
        if earliest > event.window.latest_s:
            least_s = None if timetable.trip_time_s is None else max(quickest.trip_time_s, earliest)
            raise InfeasibleRunError(_too_late(vehicle, timetable, quickest, (since, k), earliest, before), least_s)
        if event.window.earliest_s > earliest:
            since, earliest = k, event.window.earliest_s


def _too_late(vehicle: Vehicle, timetable: Timetable, quickest: Profile, events: tuple[int, int], earliest_s: float,
              before_s: float) -> str:
    """In a line: which event is too late by what, from where on, and what binds there."""
    if timetable.trip_time_s is not None:
        return (f"{timetable.trip_time_s:g} s is too short: the least feasible trip time is "
                f"{max(quickest.trip_time_s, earliest_s):.1f} s, {binding(vehicle, quickest)}: allow more time")
    chain = timetable.events
    since, event = (chain[k] for k in events)
    point, origin = timetable.points[event.point], timetable.points[since.point]
    by = earliest_s - event.window.latest_s
    head = (f"timing point {event.point + 1} at {point.position_m:g} m cannot be met: {event.kind} by "
            f"{event.window.latest_s:g} s asked, {earliest_s:.1f} s is the earliest, {by:.1f} s later")
    begun = f"{since.kind} at {origin.position_m:g} m not before {since.window.earliest_s:g} s"
    if event.waits:
        return (f"{head}, because it is reached at {before_s:.1f} s at the earliest and the least dwell is "
                f"{event.dwell_s:g} s ({begun}): let it depart later or dwell less")
    course = quickest.course.cut(origin.position_m, point.position_m)
    at = np.searchsorted(quickest.position_m, course.position_m[[0, -1]])
    part = Profile(course, quickest.half_square[at[0]:at[1] + 1])
    return (f"{head}, as fast as can be after {begun} ({binding(vehicle, part)}): let it be later there or sooner "
            "before")
