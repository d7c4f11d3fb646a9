"""A plan on a mesh, the run that is driven by it in the asked times, and the bound that its multipliers prove."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from workbench.optimal.adjoint import NEAR_FOR_RISES, NEAR_LIMIT, certificates_from, middles
from workbench.optimal.best_forms import best_forms
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array
from workbench.optimal.envelope import fastest
from workbench.optimal.fit_times import fitted
from workbench.optimal.grid import Grid
from workbench.optimal.profile import Profile
from workbench.optimal.refine import refined
from workbench.optimal.schedule import Miss, leg_times, nearest_legs
from workbench.optimal.socp import NoPlanError, Plan, solve_socp
from workbench.optimal.timed_run import TimedRun, timed_run
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import Vehicle

# Cells of the driven run on each interval of the plan.
PARTS = 8
# Shares of the trip time, and of the energy at the price of time, by which a drivable run may be off before the plan
# itself is made again, so many times: to mix it with the fastest run costs more than its price.
OFF, LATE, PLANS = 2e-5, 2e-4, 3
# By which a run may be slower at a timing point than asked, m/s.
SPEED_ERROR_MPS = 1e-6


@dataclass(frozen=True)
class Asked:
    """What every plan must meet, and the run that arrives first."""

    vehicle: Vehicle
    timetable: Timetable
    start_mps: float
    end_mps: float
    quickest: Profile


# Of a request, a mesh, what each leg takes beyond the plan and a first guess: a plan and its solver's name.
Planner = Callable[[Asked, Grid, Array, Profile], tuple[Plan, str]]


@dataclass(frozen=True)
class Planned:
    """The plan for the asked times and its run, which may be off; a run in time or its miss, None where it passes a
    timing point below its least speed; the best bound, J, of the plan's multipliers and what proves it; the solver's
    seconds and name; the plan of the run in time, and what that was told its legs take longer, s.
    """

    plan: Plan
    run: Profile
    timed: TimedRun | Miss | None
    bound_j: float
    certificate: Certificate
    solve_s: float
    solver: str
    last: Plan
    extra_s: Array


def planned(asked: Asked, planner: Planner, grid: Grid, guess: Profile, near: float, enough: float = 0.0, *,
            is_last: bool, known: Planned | None = None) -> Planned | None:
    """What comes of planning on a mesh; None where the solver found no plan.

    known: what came of it on this mesh for a train that may use more of its forces. Plans and bounds do not count on
    what a run keeps back, so that its plan is driven anew, and made anew only where that is off.

    Where the run is off, the plan is made again with what the run takes longer, or less where more time would save,
    unless a finer mesh is to follow, because the plan's energy lies apart from its bound by more than the share `near`,
    or the run in time takes no more than the share `enough` above the bound.
    """
    timetable = asked.timetable
    least = leg_times(timetable, asked.quickest)
    allowed = OFF * (timetable.points[-1].arrival.latest_s - timetable.origin_s)
    extra, spent = np.zeros(len(timetable.points) - 1) if known is None else known.extra_s, 0.0
    first: tuple[Plan, Profile, str, float, Certificate] | None = None
    for number in range(PLANS):
        try:
            tried, solver = (known.last, known.solver) if known and not number else planner(asked, grid, extra, guess)
        except NoPlanError:
            break
        plan, spent = tried, spent + (0.0 if known and not number else tried.solve_s)
        told = extra
        profile, now, legs = _driven(asked, plan, least)
        off = now - (now if legs is None else legs)
        first = first or ((known.plan, profile, solver, known.bound_j, known.certificate) if known
                          else (plan, profile, solver, *_best_bound(asked, plan)))
        priced = LATE * abs(plan.energy_j) / max(float(plan.interval_prices_w.max()), 1e-300)
        early = _early(timetable, now)
        is_early = early * float(plan.prices_w[-1]) > LATE * abs(plan.energy_j)
        if (not is_early and float(np.abs(off).sum()) <= min(allowed, priced)) or not (
                is_last or abs(first[0].energy_j - first[3]) <= near * abs(first[0].energy_j)):
            break
        if now.sum() > (timetable.trip_time_s or np.inf) and _too_late(asked, profile):
            break
        timed = _in_time(asked, profile, legs) if enough else None
        if isinstance(timed, TimedRun) and timed.energy_j - first[3] <= enough * abs(timed.energy_j):
            return Planned(first[0], first[1], timed, first[3], first[4], spent, first[2], plan, told)
        extra = extra + off - (early if is_early else 0.0)
    if first is None:
        return None
    timed = _in_time(asked, profile, legs)
    return Planned(first[0], first[1], timed, first[3], first[4], spent, first[2], plan, told)


def _in_time(asked: Asked, profile: Profile, legs_s: Array | None) -> TimedRun | Miss | None:
    """The run made to take what its timetable leaves its legs; None where it is too slow at a timing point."""
    if legs_s is not None:
        profile = fitted(asked.vehicle, profile, asked.quickest, asked.timetable, legs_s, asked.start_mps,
                         asked.end_mps)
    if _too_slow(asked.timetable, profile):
        return None
    return timed_run(asked.vehicle, asked.timetable, profile)


def _too_late(asked: Asked, profile: Profile) -> bool:
    """Whether the fastest run on the cells of a run is too late as well: then other plans are no help."""
    quick = fastest(asked.vehicle, profile.course, asked.start_mps, asked.end_mps)
    return quick.trip_time_s > (asked.timetable.trip_time_s or np.inf)


def _too_slow(timetable: Timetable, profile: Profile) -> bool:
    """Whether a run is slower at a timing point than the point asks for."""
    speed = profile.speed_mps[np.searchsorted(profile.position_m, timetable.position_m)]
    return any(v < point.slowest_mps - SPEED_ERROR_MPS for v, point in zip(speed, timetable.points, strict=True))


def _best_bound(asked: Asked, plan: Plan) -> tuple[float, Certificate]:
    """The highest bound, J, that the plan's multipliers give, and what proves it."""
    of_each = [certificates_from(asked.vehicle, plan, near) for near in NEAR_LIMIT]
    of_each.append(certificates_from(asked.vehicle, plan, NEAR_FOR_RISES, rises=True))
    forms = [form for same in zip(*of_each, strict=True) for form in same]  # of equals the first one is taken
    return best_forms(asked.vehicle, plan.grid.course, forms, middles(plan), asked.timetable, asked.start_mps,
                      asked.end_mps)


def _early(timetable: Timetable, now_s: Array) -> float:
    """By how much a run that has only a time in all arrives too soon, s: what a plan with more time would save on."""
    return 0.0 if timetable.trip_time_s is None else max(timetable.trip_time_s - float(now_s.sum()), 0.0)


def _driven(asked: Asked, plan: Plan, least_s: Array) -> tuple[Profile, Array, Array | None]:
    """The run of a plan, what its legs take, s, and what its timetable leaves them."""
    profile = refined(asked.vehicle, plan, PARTS, asked.start_mps, asked.end_mps)
    now = leg_times(asked.timetable, profile)
    return profile, now, nearest_legs(asked.timetable, now, least_s)


def cone_plan(asked: Asked, grid: Grid, extra_s: Array, _: Profile) -> tuple[Plan, str]:
    """By the cone program."""
    spare = (asked.timetable.trip_time_s or np.inf) / asked.quickest.trip_time_s - 1
    return solve_socp(asked.vehicle, grid, asked.timetable, asked.start_mps, asked.end_mps, extra_s,
                      spare=spare), "clarabel"


def nonlinear_plan(asked: Asked, grid: Grid, extra_s: Array, guess: Profile) -> tuple[Plan, str]:
    """By the nonlinear program; raises NoPlanError where none of its solvers finds one."""
    from workbench.optimal.nlp import ATTEMPTS, solve_nlp  # noqa: PLC0415 - casadi, which most runs do not need

    trouble = ""
    for name, from_best in ATTEMPTS:
        if name == "fatrop" and asked.timetable.trip_time_s is None:
            continue  # its stages know no waiting
        run = guess if from_best else asked.quickest
        start = np.interp(grid.position_m, run.position_m, run.half_square)
        try:
            return solve_nlp(asked.vehicle, grid, asked.timetable, start, asked.start_mps, asked.end_mps, name,
                             extra_s), name
        except NoPlanError as error:
            trouble = str(error)
    raise NoPlanError(trouble)
