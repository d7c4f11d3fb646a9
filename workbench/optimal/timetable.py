"""When a run may be where: windows of time at timing points, and what a second more or less costs on the way.

A timetable is a chain of events: the departure, every passing, every arrival and departure at a stop on the way, the
last arrival. Between two events the train runs or waits. A price r of an event is what a second of it costs: positive
where it must not be later, negative where it must not be sooner. What comes before an event delays all that follow, so
that a second of it costs the sum of the prices from there on: its level. Auxiliaries, which draw from the first
departure to the last arrival, are part of every level but that of the first departure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from workbench.errors import WorkbenchError
from workbench.optimal.course import Array, Course, Passage

# A time is within a window from this near on: a thousandth of what a timetable or a clock on a train can tell.
TOUCH_S = 1e-6
GRAIN_W = 2.0**-20


@dataclass(frozen=True)
class Window:
    """From earliest_s to latest_s; infinite where there is none."""

    earliest_s: float = -math.inf
    latest_s: float = math.inf


@dataclass(frozen=True)
class TimingPoint:
    """Where a run begins, passes, stops or ends; the clock is the timetable's own.

    arrival: of the arrival or the passing. departure: of the departure, at the start and at stops. stands: whether the
    train stops there, for dwell_s at least. slowest_mps, fastest_mps: of the passing.
    """

    position_m: float
    arrival: Window = field(default_factory=Window)
    departure: Window = field(default_factory=Window)
    stands: bool = False
    dwell_s: float = 0.0
    slowest_mps: float = 0.0
    fastest_mps: float = math.inf


@dataclass(frozen=True)
class Event:
    """A moment of a run at a timing point; waits: the train waits before it, for dwell_s at least, else it runs."""

    point: int
    kind: str
    window: Window
    waits: bool = False
    dwell_s: float = 0.0


@dataclass(frozen=True)
class Timetable:
    """Timing points in order of position: the first is the departure, the last the arrival.

    trip_time_s: where it says no more than a time for the whole run, else None. Raises WorkbenchError where points are
    not in order, or the first departure or the last arrival has no limit.
    """

    points: tuple[TimingPoint, ...]
    trip_time_s: float | None = None

    def __post_init__(self) -> None:
        if len(self.points) < 2 or any(two.position_m <= one.position_m for one, two in pairwise(self.points)):
            raise WorkbenchError("timetable: needs two timing points or more, in order of position: correct it")
        if not (math.isfinite(self.points[0].departure.earliest_s) and math.isfinite(self.points[-1].arrival.latest_s)):
            raise WorkbenchError("timetable: the first departure needs an earliest time and the last arrival a latest "
                                 "one: state them")

    @property
    def events(self) -> tuple[Event, ...]:
        """The chain of moments, from the departure to the arrival."""
        last = len(self.points) - 1
        found = [Event(0, "departure", self.points[0].departure, waits=True)]
        for number, point in enumerate(self.points[1:], start=1):
            found.append(Event(number, "arrival" if point.stands or number == last else "passing", point.arrival))
            if point.stands and number < last:
                found.append(Event(number, "departure", point.departure, True, point.dwell_s))
        return tuple(found)

    @property
    def origin_s(self) -> float:
        """The earliest departure."""
        return self.points[0].departure.earliest_s

    @property
    def position_m(self) -> Array:
        """Positions of the points."""
        return np.array([point.position_m for point in self.points])

    def on(self, course: Course) -> Course:
        """The course with these points and stops; raises WorkbenchError where the ends are not its own."""
        first, last = course.position_m[[0, -1]]
        if (first, last) != (self.points[0].position_m, self.points[-1].position_m):
            raise WorkbenchError(f"timetable: goes from {self.points[0].position_m:g} m to "
                                 f"{self.points[-1].position_m:g} m, the course from {first:g} m to {last:g} m: cut it")
        inner = self.points[1:-1]
        if not inner:
            return course
        stops = {*course.stops_m, *(p.position_m for p in inner if p.stands)}
        passed = tuple(Passage(p.position_m, p.slowest_mps, p.fastest_mps) for p in inner if not p.stands)
        fine = course.split(np.array([p.position_m for p in inner]))
        return replace(fine, stops_m=tuple(sorted(stops)), points=passed)

    def levels(self, prices_w: Array, auxiliary_w: float = 0.0) -> Array:
        """What a second costs before each event, W, shape (m,): the sum of the events' prices from each one on."""
        found = np.asarray(np.cumsum(prices_w[::-1])[::-1])
        found[1:] += auxiliary_w
        return found

    def fair(self, prices_w: Array, auxiliary_w: float = 0.0) -> Array:
        """The prices nearby under which no second is worth less than nothing; none turns to a limit that is not there.

        Their levels are whole multiples of GRAIN_W, as auxiliary_w must be, so that summing them again gives no
        rounding below zero.
        """
        sums = self.levels(prices_w)
        least = np.where(np.arange(len(sums)) > 0, -auxiliary_w, 0.0)
        sums = np.round(np.maximum(sums, least) / GRAIN_W) * GRAIN_W
        for k, event in enumerate(self.events[:-1]):
            if not math.isfinite(event.window.latest_s):
                sums[k + 1] = max(sums[k + 1], sums[k])
        return np.asarray(-np.diff(np.append(sums, 0.0)))

    def cell_prices(self, prices_w: Array, position_m: Array, auxiliary_w: float = 0.0) -> Array:
        """What a second costs on each cell between positions, W: the least where a cell crosses timing points."""
        levels = self.levels(prices_w, auxiliary_w)
        runs = [level for level, event in zip(levels, self.events, strict=True) if not event.waits]
        own = self.position_m
        first = np.clip(np.searchsorted(own, position_m[:-1], side="right") - 1, 0, len(runs) - 1)
        last = np.clip(np.searchsorted(own, position_m[1:], side="left") - 1, 0, len(runs) - 1)
        found = np.array(runs)[first]
        for cell in np.flatnonzero(last > first):
            found[cell] = min(runs[first[cell]:last[cell] + 1])
        return found

    def time_part_j(self, prices_w: Array, auxiliary_w: float = 0.0) -> float:
        """What windows and least waits add to a bound, J; -inf where the prices prove nothing."""
        levels, events = self.levels(prices_w, auxiliary_w), self.events
        total = self.origin_s * float(levels[0])
        for event, level, price in zip(events, levels.tolist(), prices_w.tolist(), strict=True):
            limit = event.window.latest_s if price > 0 else event.window.earliest_s
            if (event.waits and level < 0) or (price and not math.isfinite(limit)):
                return -math.inf
            total += event.dwell_s * level - (price * limit if price else 0.0)
        return total


def in_time(course: Course, trip_time_s: float) -> Timetable:
    """The timetable of a run that has only a time in all."""
    start, end = course.position_m[[0, -1]].tolist()
    arrival = TimingPoint(end, arrival=Window(latest_s=trip_time_s))
    return Timetable((TimingPoint(start, departure=Window(0.0)), arrival), trip_time_s)


def counted(auxiliary_w: float) -> float:
    """What a bound counts of auxiliaries, W: whole multiples of GRAIN_W, so that sums with prices are exact."""
    return math.floor(auxiliary_w / GRAIN_W) * GRAIN_W


def as_timetable(course: Course, asked: Timetable | float) -> Timetable:
    """What is asked, where it may be a trip time in s."""
    return asked if isinstance(asked, Timetable) else in_time(course, asked)
