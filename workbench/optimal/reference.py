"""The energy-optimal run of a train on a course: planned, made drivable, bounded from below, and checked."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from workbench.errors import InputError
from workbench.optimal.adapt import finer_grid, growth
from workbench.optimal.bound import lower_bound
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array, Course
from workbench.optimal.envelope import InfeasibleRunError, fastest, with_fine_cells
from workbench.optimal.grid import Grid, graded_grid, grid_near, kept_borders
from workbench.optimal.planning import Asked, Planned, Planner, cone_plan, nonlinear_plan, planned
from workbench.optimal.profile import Profile
from workbench.optimal.schedule import SLOWER, SLOWEST_MEAN_MPS, Miss, require_plausible, require_possible
from workbench.optimal.tight_grid import tight_grid
from workbench.optimal.timed_run import TimedRun, not_found, timed_run
from workbench.optimal.timetable import Timetable, counted, in_time
from workbench.optimal.vehicle import Vehicle
from workbench.optimal.verify import Check, check

Solver = Literal["auto", "socp", "nlp"]
INTERVALS, STOP_INTERVALS = 500, 100
# Of the first mesh; of finer ones GAP_OF_CONES is enough.
ROUNDS, GAP_WANTED = 5, 5e-4
# Meshes on which no plan was found, before a request is given up; a finer one has so many times the intervals.
FAILURES, FINER = 4, 2
# A round that leaves more than this share of a gap is the last. Above the other gap `auto` turns to the nonlinear
# program.
NO_GAIN, GAP_OF_CONES = 0.9, 1e-3
# A mesh with so many times the intervals of a first one was refined: one to begin a like request with.
REFINED = 1.3
# Cells of the fastest run.
FASTEST_CELLS = 4000
# A run whose energy is proven to lie within this share above the least possible one is called optimal.
OPTIMAL_GAP = 0.01
# A run that takes less than the bound by more than this share of it is none.
CELLS_ERROR = 1e-6
# What is found before any solver has found something.
FASTEST = "the fastest run"


@dataclass(frozen=True)
class Reference:
    """A run, its energy at the supply in J, and a proven lower bound on that of every run in the same timetable.

    clock_s: the time of each event of the timetable. solver: what planned it; solve_s: its time. least_time_s: of the
    fastest run, without waiting. waits_j: what auxiliaries draw at stops where only a trip time was asked: part of both
    energies, not of what the certificate proves. planned: the plan below the run, None where that is the fastest one.
    status: 'optimal' where the gap is at most 1 per cent, else 'feasible'.
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
    waits_j: float = 0.0
    planned: Planned | None = None

    @property
    def gap(self) -> float:
        """How much of the energy could still be saved at most, as a share of it; absolute where it is not positive."""
        return _gap(self.energy_j, self.lower_bound_j)

    @property
    def status(self) -> str:
        """'optimal' or 'feasible'."""
        return "optimal" if self.gap <= OPTIMAL_GAP else "feasible"


def find_reference(vehicle: Vehicle, course: Course, trip_time_s: float, start_mps: float = 0.0, end_mps: float = 0.0,
                   intervals: int | None = None, solver: Solver = "auto", waited_s: float = 0.0,
                   like: Reference | None = None) -> Reference:
    """The run of least energy that arrives within trip_time_s, on about so many intervals.

    waited_s: how much of that time it waits at its stops, while auxiliaries draw. like: one of nearly this request,
    to begin with: on its mesh where that was refined, and by its plan where all that differs is `Course.usable`.

    Where no number is given the mesh is refined, up to ROUNDS times, until the gap is at most GAP_OF_CONES, unless the
    first mesh leaves GAP_WANTED. `auto` plans by the cone program, and by the nonlinear one too where more is left.

    Raises InputError for a time that is no time, InfeasibleRunError where no run meets the request.
    """
    if not (math.isfinite(trip_time_s) and trip_time_s > 0):
        raise InputError("", "time", f"{trip_time_s:g} s is no trip time: give a positive number of seconds")
    running_s = trip_time_s - waited_s
    if running_s <= 0:
        least_s = least_time(vehicle, course, start_mps, end_mps).trip_time_s + waited_s
        raise InputError("", "time", f"{trip_time_s:g} s is no more than the {waited_s:g} s of waiting at stops, with "
                         f"which the least feasible trip time is {least_s:.1f} s: allow more time or shorter waits")
    if course.length_m / running_s < SLOWEST_MEAN_MPS and (
            running_s > SLOWER * least_time(vehicle, course, start_mps, end_mps).trip_time_s):
        raise InputError("", "time", f"{trip_time_s:g} s for {course.length_m:.0f} m is less than {SLOWEST_MEAN_MPS:g} "
                         "m/s on average: is it in seconds?")
    try:
        found = find_timed_reference(vehicle, course, in_time(course, running_s), start_mps, end_mps, intervals, solver,
                                     like)
    except InfeasibleRunError as trouble:
        if trouble.least_time_s is None or not waited_s:
            raise
        raise InfeasibleRunError(
            f"{trip_time_s:g} s is too short: with {waited_s:g} s of waiting at stops the least feasible trip time is "
            f"{trouble.least_time_s + waited_s:.1f} s; the run alone: {trouble}", trouble.least_time_s) from None
    drawn = vehicle.auxiliary_w * waited_s
    return replace(found, energy_j=found.energy_j + drawn, lower_bound_j=found.lower_bound_j + drawn,
                   check=replace(found.check, energy_j=found.check.energy_j + drawn), waits_j=drawn)


def find_timed_reference(vehicle: Vehicle, course: Course, timetable: Timetable, start_mps: float = 0.0,
                         end_mps: float = 0.0, intervals: int | None = None, solver: Solver = "auto",
                         like: Reference | None = None) -> Reference:
    """The run of least energy that meets every window of a timetable, as `find_reference`.

    Where a limit is a curve, the bound is that of a train which can do all that the curve allows (`Vehicle.bounded`).

    Raises InputError for windows in another unit, InfeasibleRunError where no run meets the timetable, and where none
    was found that does.
    """
    found = _driven_reference(vehicle, course, timetable, start_mps, end_mps, intervals, solver, like)
    if vehicle.bounded is None:
        return found
    # What proves a bound of the one train proves one of the other too; by how much less is seen.
    proven, of = lower_bound(vehicle.bounded, timetable.on(course), found.certificate, timetable, start_mps,
                             end_mps), found.certificate
    if like is None and _gap(found.energy_j, proven) > GAP_OF_CONES:
        try:
            other = _driven_reference(vehicle.bounded, course, timetable, start_mps, end_mps, intervals, solver, None)
        except InfeasibleRunError:
            pass  # none was found, although there is one: the bound stays
        else:
            if other.lower_bound_j > proven:
                proven, of = other.lower_bound_j, other.certificate
            found = replace(found, solve_s=found.solve_s + other.solve_s)
    return replace(found, lower_bound_j=proven, certificate=of)


def _driven_reference(vehicle: Vehicle, course: Course, timetable: Timetable, start_mps: float, end_mps: float,
                      intervals: int | None, solver: Solver, like: Reference | None) -> Reference:
    """The run of least energy and a bound of the train that drives it."""
    course = timetable.on(course)
    quickest, ideal = _quickest(vehicle, course, start_mps, end_mps)
    require_plausible(timetable, quickest)
    require_possible(vehicle, timetable, quickest, ideal)
    borders = kept_borders(course)
    drawn = counted(vehicle.auxiliary_w)
    nothing = Certificate(borders, np.zeros(len(borders) - 1), np.zeros(len(borders) - 1), drawn, auxiliary_w=drawn)
    asked = Asked(vehicle, timetable, start_mps, end_mps, quickest)
    run = timed_run(vehicle, timetable, quickest)
    best = _Found(None if isinstance(run, Miss) else run,
                  lower_bound(vehicle, course, nothing, timetable, start_mps, end_mps), nothing, 0.0, FASTEST)
    grid = graded_grid(course, intervals or INTERVALS + STOP_INTERVALS * len(course.stops_m))
    rounds, known, enough = 1 if intervals else ROUNDS, None, 0.0 if intervals else GAP_WANTED
    if like is not None and like.planned is not None:
        known = _known(asked, course, like, like.planned)
        if known is not None:  # what differs is how it is driven: a run that is near enough needs no other plan
            grid, rounds, enough = known.plan.grid, 1, GAP_WANTED
        elif intervals is None and len(like.planned.plan.force_n) > REFINED * len(grid.limit_mps):
            grid, enough = grid_near(course, like.planned.plan.grid.position_m), GAP_OF_CONES
    if solver != "nlp":
        best = _rounds(asked, cone_plan, grid, best, rounds, known, enough)
    # Where the cones have no plan on a mesh the nonlinear program, which has all of their limits, has none either.
    if solver == "nlp" or (solver == "auto" and best.gap > GAP_OF_CONES and not best.tight):
        best = _rounds(asked, nonlinear_plan, grid, best, 1, known if solver == "nlp" else None, 0.0)
    if best.run is None:
        raise InfeasibleRunError(not_found(timetable, best.miss))
    profile, simulated = best.run.profile, check(vehicle, best.run.profile)
    simulated = replace(simulated, energy_j=simulated.energy_j + vehicle.auxiliary_w * best.run.waited_s)
    return Reference(vehicle, profile, best.run.energy_j, best.bound_j, best.certificate, timetable,
                     best.run.clock_s, quickest.trip_time_s, best.solver, best.solve_s, simulated, planned=best.planned)


def _known(asked: Asked, course: Course, like: Reference, of: Planned) -> Planned | None:
    """The plan of another reference with its bound on this course; None where it is of another request."""
    if like.timetable != asked.timetable or like.vehicle != asked.vehicle:
        return None
    grid = grid_near(course, of.plan.grid.position_m)
    if not of.plan.grid.is_like(grid) or not np.array_equal(
            of.plan.half_square[[0, -1]], np.array([asked.start_mps, asked.end_mps])**2 / 2):
        return None
    # What is proven is worked out anew on this course: nothing hangs on both being alike.
    bound = lower_bound(asked.vehicle, course, like.certificate, asked.timetable, asked.start_mps, asked.end_mps)
    return replace(of, plan=replace(of.plan, grid=grid), last=replace(of.last, grid=grid), bound_j=bound,
                   certificate=like.certificate)


def least_time(vehicle: Vehicle, course: Course, start_mps: float = 0.0, end_mps: float = 0.0) -> Profile:
    """The fastest run, on a fine mesh; raises InfeasibleRunError where the train cannot drive the course."""
    return _quickest(vehicle, course, start_mps, end_mps)[0]


def _quickest(vehicle: Vehicle, course: Course, start_mps: float, end_mps: float) -> tuple[Profile, Profile]:
    """The fastest run whose every point keeps the limits, and one that may pass them a little within cells."""
    cells = course.split(graded_grid(course, FASTEST_CELLS).position_m[1:-1])
    ideal = fastest(vehicle, cells, start_mps, end_mps, is_strict=False)
    return fastest(vehicle, with_fine_cells(vehicle, cells, ideal.half_square), start_mps, end_mps), ideal


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
    planned: Planned | None = None

    @property
    def gap(self) -> float:
        return math.inf if self.run is None else _gap(self.run.energy_j, self.bound_j)

    def improved(self, found: Planned) -> _Found:
        run, bound = found.timed, found.bound_j
        proven = max(bound, self.bound_j)
        more = replace(self, bound_j=proven, solve_s=self.solve_s + found.solve_s,
                       certificate=found.certificate if bound > self.bound_j else self.certificate)
        if run is None or isinstance(run, Miss):
            return replace(more, miss=run or self.miss)
        new, old = run.energy_j, math.inf if self.run is None else self.run.energy_j
        # On a coarse mesh a run may pass its limits within cells, and seem to take less than any run can.
        floor = proven - CELLS_ERROR * abs(proven)
        less = new < old if (new >= floor) == (old >= floor) else new >= floor
        return replace(more, run=run, solver=found.solver, planned=found) if less or self.run is None else more


def _gap(energy: float, bound: float) -> float:
    return (energy - bound) / abs(energy) if energy else energy - bound


def _rounds(asked: Asked, planner: Planner, grid: Grid, best: _Found, rounds: int,
            known: Planned | None, first_enough: float) -> _Found:
    """The best after planning on finer and finer meshes, until the gap is small or finer ones do not help.

    first_enough: what gap is small on the mesh given; none where the run of least energy is asked for all the same.
    """
    vehicle, course = asked.vehicle, grid.course
    number = failures = 0
    while number < rounds:
        before = best.gap
        enough = GAP_OF_CONES if rounds > 1 and (best.tight or number) else first_enough
        found = planned(asked, planner, grid, best.run.profile if best.run else asked.quickest, GAP_OF_CONES,
                        enough, is_last=number == rounds - 1, known=known)
        if found is None:
            failures += 1
            if best.solver != FASTEST or failures == FAILURES or rounds == 1:
                break
            # Every mesh drives a little worse than the line allows: a time near the least one needs a finer mesh.
            best = replace(best, tight=planner is cone_plan)
            grid = tight_grid(course, asked.quickest, FINER * len(grid.limit_mps))
            continue
        best = best.improved(found)
        # A plan that takes less than is proven of every run is one that cones allow and the train does not.
        loose = found.bound_j - found.plan.energy_j > GAP_OF_CONES * abs(found.plan.energy_j)
        if best.gap <= enough or loose or (
                number and best.gap > NO_GAIN * before and best.run):
            break
        number += 1
        if number < rounds:
            grid = finer_grid(vehicle, found.plan, found.certificate, found.run, growth(best.gap, GAP_OF_CONES))
    return best
