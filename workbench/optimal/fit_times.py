"""A driven run made to take the times that a timetable leaves it, leg by leg, at unchanged speeds at timing points."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.envelope import InfeasibleRunError, drivable, fastest
from workbench.optimal.profile import Profile
from workbench.optimal.schedule import leg_times
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import Vehicle

ROUNDS = 60
# Shares of a leg's time by which it may be shorter than asked: where that costs nothing but energy, and where the
# windows ask for the time itself.
SHORT, EXACT = 1e-6, 1e-11
# Of so many mixtures that are tried one is the middle.
BISECTED = 5
# A run is made slower on a leg by this share of half the squared speed at most.
MOST_SLOWER = 0.98

# The run at a share between the one that is there, 0, and the one that is as fast or slow as can be, 1.
_Mixed = Callable[[float], Profile]


def fitted(vehicle: Vehicle, profile: Profile, quickest: Profile, timetable: Timetable, leg_s: Array,
           start_mps: float, end_mps: float) -> Profile:
    """The run with legs of leg_s, each at most that long; where one cannot be reached, what comes nearest.

    A leg that is too long is mixed with the fastest one between the same speeds, one that is too short with a slower
    one: the speed lowered in its middle. Where the windows ask only for a time in all, a run that is early stays.
    """
    now = leg_times(timetable, profile)
    if timetable.trip_time_s is not None:
        if now[0] <= leg_s[0]:
            return profile
        same = fastest(vehicle, profile.course, start_mps, end_mps)  # on the same cells, as precise as the run
        return _quicker(vehicle, profile, (same, quickest), float(leg_s[0]), (start_mps, end_mps), SHORT)
    half_square = profile.half_square.copy()
    at = np.searchsorted(profile.position_m, timetable.position_m)
    ends = np.sqrt(2 * half_square[at])
    ends[[0, -1]] = start_mps, end_mps
    for k, (one, two) in enumerate(pairwise(at)):
        if abs(now[k] - leg_s[k]) <= EXACT * leg_s[k]:
            continue
        part = Profile(profile.course.cut(*profile.position_m[[one, two]].tolist()), half_square[one:two + 1])
        try:
            speeds = float(ends[k]), float(ends[k + 1])
            if now[k] > leg_s[k]:
                quick = fastest(vehicle, part.course, *speeds)
                part = _quicker(vehicle, part, (quick, quick), float(leg_s[k]), speeds, EXACT)
            else:
                part = _slower(vehicle, part, float(leg_s[k]), speeds)
        except InfeasibleRunError:
            continue  # the leg stays as it is, and the schedule says what is missed
        half_square[one + 1:two] = part.half_square[1:-1]
    return Profile(profile.course, half_square)


def _quicker(vehicle: Vehicle, profile: Profile, quick: tuple[Profile, Profile], asked_s: float,
             ends_mps: tuple[float, float], short: float) -> Profile:
    """The least mixture with a fast run on the same cells that takes asked_s at most; the second where none does."""
    fast = quick[0].half_square

    def mixed(share: float) -> Profile:
        return drivable(vehicle, profile.course, profile.half_square + share * (fast - profile.half_square), *ends_mps)

    return _mixture(mixed, profile, quick[1], asked_s, short)


def _slower(vehicle: Vehicle, profile: Profile, asked_s: float, ends_mps: tuple[float, float]) -> Profile:
    """A run that is slower in the leg's middle and takes asked_s; raises InfeasibleRunError where none is found."""
    s = profile.position_m
    along = (s - s[0]) / (s[-1] - s[0])
    dip = np.minimum(1.0, 8 * along * (1 - along))  # whole within the middle half

    def mixed(share: float) -> Profile:
        target = profile.half_square * (1 - (1 - share) * dip * MOST_SLOWER)
        return drivable(vehicle, profile.course, target, *ends_mps)

    # Too slow for a climb is too slow: begin with the slowest that can be driven.
    slowest = 0.0
    for _ in range(20):
        try:
            slow = mixed(slowest)
            break
        except InfeasibleRunError:
            slowest = (1 + slowest) / 2
    else:
        return profile
    if slow.trip_time_s < asked_s:
        return slow
    return _mixture(lambda share: mixed(slowest + share * (1 - slowest)), slow, profile, asked_s, EXACT)


def _mixture(mixed: _Mixed, slow: Profile, fast: Profile, asked_s: float, short: float) -> Profile:
    """The run nearest to the slow one that takes asked_s at most; fast itself where no mixture does."""
    aim, low, high, best = asked_s * (1 - short / 2), 0.0, 1.0, fast
    late, early = slow.trip_time_s - aim, aim - fast.trip_time_s  # at low and at high
    was_late: bool | None = None
    for number in range(ROUNDS):
        # The line between both times, and now and then the middle, where times are no line.
        line = low + (high - low) * late / (late + early) if late > 0 < early else low
        share = line if low < line < high and (number + 1) % BISECTED else (low + high) / 2
        run = mixed(share)
        off, is_late = run.trip_time_s - aim, run.trip_time_s > asked_s
        if is_late:
            # An end that stays counts half, else the other one alone would move.
            low, late, early = share, off, early / 2 if was_late else early
        else:
            high, early, best, late = share, -off, run, late / 2 if was_late is False else late
            if asked_s - run.trip_time_s <= short * asked_s:
                break
        was_late = is_late
        if high - low < (1e-9 if short == SHORT else 1e-15):
            break
    return best
