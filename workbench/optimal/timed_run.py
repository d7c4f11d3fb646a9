"""A driven run by the clock of its timetable, and what it takes from its first departure to its last arrival."""

from __future__ import annotations

from dataclasses import dataclass

from workbench.optimal.course import Array
from workbench.optimal.profile import Profile, energy_j
from workbench.optimal.schedule import Miss, leg_times, schedule
from workbench.optimal.timetable import TOUCH_S, Timetable
from workbench.optimal.vehicle import Vehicle


@dataclass(frozen=True)
class TimedRun:
    """A run and the clock at the events of its timetable, s, shape (m,).

    energy_j: at the supply, with auxiliaries from departure to arrival; waited_s: at stops between both.
    """

    profile: Profile
    clock_s: Array
    energy_j: float
    waited_s: float


def timed_run(vehicle: Vehicle, timetable: Timetable, profile: Profile) -> TimedRun | Miss:
    """The run with its clock, or what it misses; windows of no width are met to TOUCH_S."""
    legs, brief = leg_times(timetable, profile), vehicle.auxiliary_w > 0
    clock = schedule(timetable, legs, brief=brief)
    if isinstance(clock, Miss) and timetable.trip_time_s is None:
        clock = schedule(timetable, legs, TOUCH_S, brief)
    if isinstance(clock, Miss):
        return clock
    waited = float(clock[-1] - clock[0]) - profile.trip_time_s if len(clock) > 2 else 0.0
    return TimedRun(profile, clock, energy_j(vehicle, profile) + vehicle.auxiliary_w * waited, waited)


def not_found(timetable: Timetable, miss: Miss | None) -> str:
    """In a line: nothing is proven, but no run was found; where it fails."""
    text = "no run was found that meets every window of the timetable, though it was not proven that there is none"
    if miss is None:
        return f"{text}: widen the windows"
    event = timetable.events[miss.event]
    return (f"{text}: the best one has the {event.kind} at timing point {event.point + 1}, "
            f"{timetable.points[event.point].position_m:g} m, {miss.by_s:.3g} s too {'late' if miss.late else 'soon'}: "
            "widen the window there")
