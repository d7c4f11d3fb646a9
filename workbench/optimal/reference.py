"""The energy-optimal run of a train on a course: planned, made drivable, bounded from below, and checked."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from workbench.errors import InputError
from workbench.optimal.adapt import finer_grid
from workbench.optimal.adjoint import NEAR_LIMIT, certificate_from
from workbench.optimal.bound import lower_bound
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array, Course
from workbench.optimal.envelope import InfeasibleRunError, fastest, with_fine_cells
from workbench.optimal.fit_times import fitted
from workbench.optimal.grid import Grid, graded_grid, kept_borders
from workbench.optimal.profile import Profile
from workbench.optimal.refine import refined
from workbench.optimal.schedule import Miss, leg_times, nearest_legs, require_possible
from workbench.optimal.socp import NoPlanError, Plan, solve_socp
from workbench.optimal.tight_grid import tight_grid
from workbench.optimal.timed_run import TimedRun, not_found, timed_run
from workbench.optimal.timetable import Timetable, counted, in_time
from workbench.optimal.vehicle import Vehicle
from workbench.optimal.verify import Check, check

Solver = Literal["auto", "socp", "nlp"]
INTERVALS, STOP_INTERVALS = 500, 100
ROUNDS, GAP_WANTED = 5, 5e-4
# Meshes on which no plan was found, before a request is given up; a finer one has so many times the intervals.
FAILURES, FINER = 3, 4
# A round that leaves more than this share of a gap above OPTIMAL_GAP is the last. Above the other gap `auto` turns to
# the nonlinear program.
NO_GAIN, GAP_OF_CONES = 0.9, 1e-3
# Cells of the driven run on each interval of the plan, and of the fastest run in all.
PARTS, FASTEST_CELLS = 8, 4000
# A run whose energy is proven to lie within this share above the least possible one is called optimal.
OPTIMAL_GAP = 0.01
# Share of the trip time by which a drivable run may be off before the plan itself is made again, so many times.
OFF, PLANS = 2e-5, 3
# A run that takes less than the bound by more than this share of it is none.
CELLS_ERROR = 1e-6
# What is found before any solver has found something.
FASTEST = "the fastest run"
# Slower than this on average, and so many times slower than the fastest run, is no train.
SLOWEST_MEAN_MPS, SLOWER = 0.5, 10.0


@dataclass(frozen=True)
class Reference:
    """A run, its energy at the supply in J, and a proven lower bound on that of every run in the same timetable.

    clock_s: the time of each event of the timetable. solver: what planned it; solve_s: its time. least_time_s: of the
    fastest run, without waiting. status: 'optimal' where the gap is at most 1 per cent, else 'feasible'.
    """

    vehicle: Vehicle
    profile: Profile
    energy_j: float
    lower_bound_j: float
    certificate: Certificate
    timetable: Timetable
    clock_s: Array
    least_time_s: float
    solver: str
    solve_s: float
    check: Check

    @property
    def gap(self) -> float:
        """How much of the energy could still be saved at most, as a share of it; absolute where it is not positive."""
        return _gap(self.energy_j, self.lower_bound_j)

    @property
    def status(self) -> str:
        """'optimal' or 'feasible'."""
        return "optimal" if self.gap <= OPTIMAL_GAP else "feasible"


def find_reference(vehicle: Vehicle, course: Course, trip_time_s: float, start_mps: float = 0.0, end_mps: float = 0.0,
                   intervals: int | None = None, solver: Solver = "auto") -> Reference:
    """The run of least energy that arrives within trip_time_s, on about so many intervals.

    Where no number is given the mesh is refined, up to ROUNDS times, until the gap is at most GAP_WANTED. `auto` plans
    by the cone program, and by the nonlinear one too where that leaves more than GAP_OF_CONES.

    Raises InputError for a time that is no time, InfeasibleRunError where no run meets the request.
    """
    if not (math.isfinite(trip_time_s) and trip_time_s > 0):
        raise InputError("", "time", f"{trip_time_s:g} s is no trip time: give a positive number of seconds")
    if course.length_m / trip_time_s < SLOWEST_MEAN_MPS and (
            trip_time_s > SLOWER * least_time(vehicle, course, start_mps, end_mps).trip_time_s):
        raise InputError("", "time", f"{trip_time_s:g} s for {course.length_m:.0f} m is less than {SLOWEST_MEAN_MPS:g} "
                         "m/s on average: is it in seconds?")
    return find_timed_reference(vehicle, course, in_time(course, trip_time_s), start_mps, end_mps, intervals, solver)


def find_timed_reference(vehicle: Vehicle, course: Course, timetable: Timetable, start_mps: float = 0.0,
                         end_mps: float = 0.0, intervals: int | None = None, solver: Solver = "auto") -> Reference:
    """The run of least energy that meets every window of a timetable, as `find_reference`.

    Raises InfeasibleRunError where no run meets the timetable, and where none was found that does.
    """
    course = timetable.on(course)
    quickest, ideal = _quickest(vehicle, course, start_mps, end_mps)
    require_possible(vehicle, timetable, quickest, ideal)
    borders = kept_borders(course)
    drawn = counted(vehicle.auxiliary_w)
    nothing = Certificate(borders, np.zeros(len(borders) - 1), np.zeros(len(borders) - 1), drawn, auxiliary_w=drawn)
    asked = _Asked(vehicle, timetable, start_mps, end_mps, quickest)
    run = timed_run(vehicle, timetable, quickest)
    best = _Found(None if isinstance(run, Miss) else run,
                  lower_bound(vehicle, course, nothing, timetable, start_mps, end_mps), nothing, 0.0, FASTEST)
    grid = graded_grid(course, intervals or INTERVALS + STOP_INTERVALS * len(course.stops_m))
    if solver != "nlp":
        best = _rounds(asked, _cone_plan, grid, best, 1 if intervals else ROUNDS)
    # Where the cones have no plan on a mesh the nonlinear program, which has all of their limits, has none either.
    if solver == "nlp" or (solver == "auto" and best.gap(vehicle) > GAP_OF_CONES and not best.tight):
        best = _rounds(asked, _nonlinear_plan, grid, best, 1)
    if best.run is None:
        raise InfeasibleRunError(not_found(timetable, best.miss))
    profile, simulated = best.run.profile, check(vehicle, best.run.profile)
    simulated = replace(simulated, energy_j=simulated.energy_j + vehicle.auxiliary_w * best.run.waited_s)
    return Reference(vehicle, profile, best.run.energy_j(vehicle), best.bound_j, best.certificate, timetable,
                     best.run.clock_s, quickest.trip_time_s, best.solver, best.solve_s, simulated)


def least_time(vehicle: Vehicle, course: Course, start_mps: float = 0.0, end_mps: float = 0.0) -> Profile:
    """The fastest run, on a fine mesh; raises InfeasibleRunError where the train cannot drive the course."""
    return _quickest(vehicle, course, start_mps, end_mps)[0]


def _quickest(vehicle: Vehicle, course: Course, start_mps: float, end_mps: float) -> tuple[Profile, Profile]:
    """The fastest run whose every point keeps the limits, and one that may pass them a little within cells."""
    cells = course.split(graded_grid(course, FASTEST_CELLS).position_m[1:-1])
    ideal = fastest(vehicle, cells, start_mps, end_mps, is_strict=False)
    return fastest(vehicle, with_fine_cells(vehicle, cells, ideal.half_square), start_mps, end_mps), ideal


@dataclass(frozen=True)
class _Asked:
    """What every plan must meet, and the run that arrives first."""

    vehicle: Vehicle
    timetable: Timetable
    start_mps: float
    end_mps: float
    quickest: Profile


@dataclass(frozen=True)
class _Found:
    """The best run so far with what planned it, and the best bound, which need not come from the same mesh.

    run: None as long as none meets the timetable; miss: what the last one missed. tight: whether the first mesh was too
    coarse for the times.
    """

    run: TimedRun | None
    bound_j: float
    certificate: Certificate
    solve_s: float
    solver: str
    miss: Miss | None = None
    tight: bool = False

    def gap(self, vehicle: Vehicle) -> float:
        return math.inf if self.run is None else _gap(self.run.energy_j(vehicle), self.bound_j)

    def improved(self, vehicle: Vehicle, run: TimedRun | Miss, bound: float, certificate: Certificate, solve_s: float,
                 solver: str) -> _Found:
        proven = max(bound, self.bound_j)
        more = replace(self, bound_j=proven, solve_s=self.solve_s + solve_s,
                       certificate=certificate if bound > self.bound_j else self.certificate)
        if isinstance(run, Miss):
            return replace(more, miss=run)
        new, old = run.energy_j(vehicle), math.inf if self.run is None else self.run.energy_j(vehicle)
        # On a coarse mesh a run may pass its limits within cells, and seem to take less than any run can.
        floor = proven - CELLS_ERROR * abs(proven)
        less = new < old if (new >= floor) == (old >= floor) else new >= floor
        return replace(more, run=run, solver=solver) if less or self.run is None else more


# Of a request, a mesh, what each leg takes beyond the plan and a first guess: a plan and its solver's name.
_Planner = Callable[["_Asked", Grid, Array, Profile], tuple[Plan, str]]


def _gap(energy: float, bound: float) -> float:
    return (energy - bound) / abs(energy) if energy else energy - bound


def _rounds(asked: _Asked, planner: _Planner, grid: Grid, best: _Found, rounds: int) -> _Found:
    """The best after planning on finer and finer meshes, until the gap is small or finer ones do not help."""
    vehicle, course = asked.vehicle, grid.course
    number = failures = 0
    while number < rounds:
        before = best.gap(vehicle)
        found = _planned(asked, planner, grid, best.run.profile if best.run else asked.quickest)
        if found is None:
            failures += 1
            if best.solver != FASTEST or failures == FAILURES or rounds == 1:
                break
            # Every mesh drives a little worse than the line allows: a time near the least one needs a finer mesh.
            best = replace(best, tight=planner is _cone_plan)
            grid = tight_grid(course, asked.quickest, FINER * len(grid.limit_mps))
            continue
        bound, certificate = max(((lower_bound(vehicle, course, made, asked.timetable, asked.start_mps, asked.end_mps),
                                   made) for made in (certificate_from(vehicle, found.plan, near)
                                                      for near in NEAR_LIMIT)), key=lambda pair: pair[0])
        best = best.improved(vehicle, found.timed, bound, certificate, found.solve_s, found.solver)
        if best.gap(vehicle) <= GAP_WANTED or (
                number and best.gap(vehicle) > max(NO_GAIN * before, OPTIMAL_GAP) and best.run):
            break
        number += 1
        if number < rounds:
            grid = finer_grid(vehicle, found.plan, certificate, found.run)
    return best


def _cone_plan(asked: _Asked, grid: Grid, extra_s: Array, _: Profile) -> tuple[Plan, str]:
    return solve_socp(asked.vehicle, grid, asked.timetable, asked.start_mps, asked.end_mps, extra_s), "clarabel"


def _nonlinear_plan(asked: _Asked, grid: Grid, extra_s: Array, guess: Profile) -> tuple[Plan, str]:
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


@dataclass(frozen=True)
class _Planned:
    """The plan for the asked times and its run, which may be off; a run in time or its miss; the solver's seconds."""

    plan: Plan
    run: Profile
    timed: TimedRun | Miss
    solve_s: float
    solver: str


def _planned(asked: _Asked, planner: _Planner, grid: Grid, guess: Profile) -> _Planned | None:
    """What comes of planning on a mesh; None where the solver found no plan."""
    timetable = asked.timetable
    least = leg_times(timetable, asked.quickest)
    allowed = OFF * (timetable.points[-1].arrival.latest_s - timetable.origin_s)
    extra, spent = np.zeros(len(timetable.points) - 1), 0.0
    first: tuple[Plan, Profile, str] | None = None
    for _ in range(PLANS):
        try:
            plan, solver = planner(asked, grid, extra, guess)
        except NoPlanError:
            break
        spent += plan.solve_s
        profile, legs, off = _driven(asked, plan, least, allowed)
        first = first or (plan, profile, solver)
        if float(np.abs(off).sum()) <= allowed:
            break
        extra = extra + off
    if first is None:
        return None
    if legs is not None:
        profile = fitted(asked.vehicle, profile, asked.quickest, timetable, legs, asked.start_mps, asked.end_mps)
    return _Planned(first[0], first[1], timed_run(asked.vehicle, timetable, profile), spent, first[2])


def _driven(asked: _Asked, plan: Plan, least_s: Array, allowed_s: float) -> tuple[Profile, Array | None, Array]:
    """The run of a plan, the legs that its timetable leaves it, s, and by how much its own are longer.

    A run that is late keeps to the limits of speed where the plan is at them, if that is less so.
    """
    found: list[tuple[Profile, Array | None, Array]] = []
    for is_held in (False, True):
        profile = refined(asked.vehicle, plan, PARTS, asked.start_mps, asked.end_mps, is_held)
        now = leg_times(asked.timetable, profile)
        legs = nearest_legs(asked.timetable, now, least_s)
        found.append((profile, legs, now - (now if legs is None else legs)))
        if float(found[0][2].sum()) <= allowed_s:
            break
    return min(found, key=lambda run: float(np.abs(run[2]).sum()))
