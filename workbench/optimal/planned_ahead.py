"""The timetable of a run whose moving average shall meet another: the average is late by half its window."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from workbench.optimal.course import Array, Course
from workbench.optimal.timetable import Timetable, TimingPoint, Window

# The average of a run that speeds up or slows down passes a point a little beside half a window later: a share of the
# squared window by which windows of passing are narrowed on both sides, at most a quarter of their width each.
BESIDE_PER_S = 0.05


def planned_ahead(timetable: Timetable, window_s: float, margin_mps: float, course: Course) -> Timetable:
    """What a run must meet so that its average over window_s meets the timetable; its ends are those of the course.

    A stop is reached a window sooner and stood at a window longer, a point is passed half a window sooner, at a speed
    that lies margin_mps within its limits where they leave room.
    """
    first, *inner, last = timetable.points
    start, end = course.position_m[[0, -1]].tolist()
    return replace(timetable, points=(
        replace(first, position_m=start), *(_ahead(point, window_s, margin_mps) for point in inner),
        replace(last, position_m=end, arrival=_sooner(last.arrival, window_s))))


def waits(timetable: Timetable, clock_s: Array) -> Array:
    """What the train waits at each stop on the way, s, in the order of stops."""
    return np.array([clock_s[k] - clock_s[k - 1] for k, event in enumerate(timetable.events) if event.waits and k])


def _ahead(point: TimingPoint, window_s: float, margin_mps: float) -> TimingPoint:
    if point.stands:
        return replace(point, arrival=_sooner(point.arrival, window_s), dwell_s=point.dwell_s + window_s)
    arrival = _sooner(point.arrival, window_s / 2)
    narrow = min(BESIDE_PER_S * window_s**2, (arrival.latest_s - arrival.earliest_s) / 4)
    fastest = max(point.fastest_mps - margin_mps, (point.fastest_mps + point.slowest_mps) / 2)
    return replace(point, arrival=Window(arrival.earliest_s + narrow, arrival.latest_s - narrow), fastest_mps=fastest,
                   slowest_mps=min(point.slowest_mps + margin_mps, fastest) if point.slowest_mps else 0.0)


def _sooner(window: Window, by_s: float) -> Window:
    return Window(window.earliest_s - by_s, window.latest_s - by_s)
