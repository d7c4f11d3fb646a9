"""The energy-optimal run of a train on a course: planned, made drivable, bounded from below, and checked."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from workbench.errors import InputError
from workbench.optimal.adapt import finer_grid
from workbench.optimal.adjoint import NEAR_LIMIT, certificate_from
from workbench.optimal.bound import Certificate, auxiliary_part, lower_bound
from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError, drivable, fastest
from workbench.optimal.grid import Grid, graded_grid, kept_borders
from workbench.optimal.profile import Profile, energy_j
from workbench.optimal.refine import refined
from workbench.optimal.regimes import binding
from workbench.optimal.socp import NoPlanError, Plan, solve_socp
from workbench.optimal.vehicle import Vehicle
from workbench.optimal.verify import Check, check

Solver = Literal["auto", "socp", "nlp"]
INTERVALS, STOP_INTERVALS = 500, 100
ROUNDS, GAP_WANTED = 5, 5e-4
# A round that leaves more than this share of a gap above OPTIMAL_GAP is the last. Above the other gap `auto` turns to
# the nonlinear program.
NO_GAIN, GAP_OF_CONES = 0.9, 1e-3
# Cells of the driven run on each interval of the plan, and of the fastest run in all.
PARTS, FASTEST_CELLS = 8, 4000
# A run whose energy is proven to lie within this share above the least possible one is called optimal.
OPTIMAL_GAP = 0.01
# Share of the trip time by which a drivable run may be late before the plan itself is made again for less time.
LATE = 2e-5
# A run that takes less than the bound by more than this share of it is none.
CELLS_ERROR = 1e-6
# What is found before any solver has found something.
FASTEST = "the fastest run"
# Slower than this on average, and so many times slower than the fastest run, is no train.
SLOWEST_MEAN_MPS, SLOWER = 0.5, 10.0


@dataclass(frozen=True)
class Reference:
    """A run, its energy at the supply in J, and a proven lower bound on the energy of every run in the same time.

    solver: what planned it; solve_s: its time. least_time_s: of the fastest run. status: 'optimal' where the gap is at
    most 1 per cent, else 'feasible'.
    """

    vehicle: Vehicle
    profile: Profile
    energy_j: float
    lower_bound_j: float
    certificate: Certificate
    asked_time_s: float
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
    quickest = least_time(vehicle, course, start_mps, end_mps)
    if course.length_m / trip_time_s < SLOWEST_MEAN_MPS and trip_time_s > SLOWER * quickest.trip_time_s:
        raise InputError("", "time", f"{trip_time_s:g} s for {course.length_m:.0f} m is less than {SLOWEST_MEAN_MPS:g} "
                         "m/s on average: is it in seconds?")
    if trip_time_s < quickest.trip_time_s:
        raise InfeasibleRunError(
            f"{trip_time_s:g} s is too short: the least feasible trip time is {quickest.trip_time_s:.1f} s, "
            f"{binding(vehicle, quickest)}: allow more time", quickest.trip_time_s)
    borders = kept_borders(course)
    nothing = Certificate(borders, np.zeros(len(borders) - 1), np.zeros(len(borders) - 1), 0.0)
    asked = _Asked(vehicle, trip_time_s, start_mps, end_mps, quickest)
    best = _Found(quickest, _bound(asked, course, nothing), nothing, 0.0, FASTEST)
    grid = graded_grid(course, intervals or INTERVALS + STOP_INTERVALS * len(course.stops_m))
    if solver != "nlp":
        best = _rounds(asked, _cone_plan, grid, best, 1 if intervals else ROUNDS)
    if solver == "nlp" or (solver == "auto" and best.gap(vehicle) > GAP_OF_CONES):
        best = _rounds(asked, _nonlinear_plan, grid, best, 1)
    energy = energy_j(vehicle, best.profile)
    return Reference(vehicle, best.profile, energy, best.bound_j, best.certificate, trip_time_s, quickest.trip_time_s,
                     best.solver, best.solve_s, check(vehicle, best.profile))


def least_time(vehicle: Vehicle, course: Course, start_mps: float = 0.0, end_mps: float = 0.0) -> Profile:
    """The fastest run, on a fine mesh; raises InfeasibleRunError where the train cannot drive the course."""
    fine = graded_grid(course, FASTEST_CELLS)
    return fastest(vehicle, course.split(fine.position_m[1:-1]), start_mps, end_mps)


@dataclass(frozen=True)
class _Asked:
    """What every plan must meet, and the run that arrives first."""

    vehicle: Vehicle
    trip_time_s: float
    start_mps: float
    end_mps: float
    quickest: Profile


@dataclass(frozen=True)
class _Found:
    """The best run so far with what planned it, and the best bound, which need not come from the same mesh."""

    profile: Profile
    bound_j: float
    certificate: Certificate
    solve_s: float
    solver: str

    def gap(self, vehicle: Vehicle) -> float:
        return _gap(energy_j(vehicle, self.profile), self.bound_j)

    def improved(self, vehicle: Vehicle, profile: Profile, bound: float, certificate: Certificate, solve_s: float,
                 solver: str) -> _Found:
        new, old, proven = energy_j(vehicle, profile), energy_j(vehicle, self.profile), max(bound, self.bound_j)
        # On a coarse mesh a run may pass its limits within cells, and seem to take less than any run can.
        floor = proven - CELLS_ERROR * abs(proven)
        less = new < old if (new >= floor) == (old >= floor) else new >= floor
        return _Found(profile if less else self.profile, proven,
                      certificate if bound > self.bound_j else self.certificate, self.solve_s + solve_s,
                      solver if less else self.solver)


# Of a request, a mesh, a trip time and a first guess: a plan and its solver's name.
_Planner = Callable[["_Asked", Grid, float, Profile], tuple[Plan, str]]


def _gap(energy: float, bound: float) -> float:
    return (energy - bound) / abs(energy) if energy else energy - bound


def _bound(asked: _Asked, course: Course, certificate: Certificate) -> float:
    """The bound with auxiliaries."""
    return (lower_bound(asked.vehicle, course, certificate, asked.trip_time_s, asked.start_mps, asked.end_mps)
            + auxiliary_part(asked.vehicle, course, certificate, asked.trip_time_s))


def _rounds(asked: _Asked, planner: _Planner, grid: Grid, best: _Found, rounds: int) -> _Found:
    """The best after planning on finer and finer meshes, until the gap is small or finer ones do not help."""
    vehicle, course = asked.vehicle, grid.course
    for number in range(rounds):
        before = best.gap(vehicle)
        found = _planned(asked, planner, grid, best.profile)
        if found is None:
            if best.solver != FASTEST:
                break
            # Every mesh drives a little worse than the line allows: a time near the least one needs a finer mesh.
            grid = graded_grid(course, 2 * len(grid.limit_mps))
            continue
        bound, certificate = max(((_bound(asked, course, made), made) for made in (
            certificate_from(vehicle, found.plan, near) for near in NEAR_LIMIT)), key=lambda pair: pair[0])
        best = best.improved(vehicle, found.in_time, bound, certificate, found.solve_s, found.solver)
        if best.gap(vehicle) <= GAP_WANTED or (
                number and best.gap(vehicle) > max(NO_GAIN * before, OPTIMAL_GAP)):
            break
        if number + 1 < rounds:
            grid = finer_grid(vehicle, found.plan, certificate, found.run)
    return best


def _cone_plan(asked: _Asked, grid: Grid, trip_time_s: float, _: Profile) -> tuple[Plan, str]:
    return solve_socp(asked.vehicle, grid, trip_time_s, asked.start_mps, asked.end_mps), "clarabel"


def _nonlinear_plan(asked: _Asked, grid: Grid, trip_time_s: float, guess: Profile) -> tuple[Plan, str]:
    from workbench.optimal.nlp import ATTEMPTS, solve_nlp  # noqa: PLC0415 - casadi, which most runs do not need

    trouble = ""
    for name, from_best in ATTEMPTS:
        run = guess if from_best else asked.quickest
        start = np.interp(grid.position_m, run.position_m, run.half_square)
        try:
            return solve_nlp(asked.vehicle, grid, trip_time_s, start, asked.start_mps, asked.end_mps, name), name
        except NoPlanError as error:
            trouble = str(error)
    raise NoPlanError(trouble)


@dataclass(frozen=True)
class _Planned:
    """The plan for the asked time and its run, which may be late; a run in time; the solver's time and name."""

    plan: Plan
    run: Profile
    in_time: Profile
    solve_s: float
    solver: str


def _planned(asked: _Asked, planner: _Planner, grid: Grid, guess: Profile) -> _Planned | None:
    """What comes of planning on a mesh; None where the solver found no plan."""
    wanted, spent = asked.trip_time_s, 0.0
    first: tuple[Plan, Profile, str] | None = None
    for _ in range(3):
        try:
            plan, solver = planner(asked, grid, wanted, guess)
        except NoPlanError:
            break
        spent += plan.solve_s
        profile = refined(asked.vehicle, plan, PARTS, asked.start_mps, asked.end_mps)
        first = first or (plan, profile, solver)
        late = profile.trip_time_s - asked.trip_time_s
        if late <= LATE * asked.trip_time_s:
            break
        wanted -= late
    if first is None:
        return None
    in_time = _in_time(asked.vehicle, profile, asked.quickest, asked.trip_time_s, asked.start_mps, asked.end_mps)
    return _Planned(first[0], first[1], in_time, spent, first[2])


def _in_time(vehicle: Vehicle, profile: Profile, quickest: Profile, trip_time_s: float, start_mps: float,
             end_mps: float) -> Profile:
    """The run itself if it is in time, else the least mixture with the fastest one that is."""
    if profile.trip_time_s <= trip_time_s:
        return profile
    fast = fastest(vehicle, profile.course, start_mps, end_mps).half_square  # on the same cells, as precise as the run
    low, high, best = 0.0, 1.0, quickest
    for _ in range(40):
        share = _secant(low, high, profile, best, trip_time_s) if low == 0.0 else (low + high) / 2
        mixed = drivable(vehicle, profile.course, profile.half_square + share * (fast - profile.half_square),
                         start_mps, end_mps)
        if mixed.trip_time_s <= trip_time_s:
            high, best = share, mixed
            if trip_time_s - mixed.trip_time_s <= 1e-6 * trip_time_s:
                break
        else:
            low = share
        if high - low < 1e-9:
            break
    return best


def _secant(low: float, high: float, slow: Profile, fast: Profile, trip_time_s: float) -> float:
    """A share that is a little more than the line between both runs asks for."""
    late, early = slow.trip_time_s - trip_time_s, trip_time_s - fast.trip_time_s
    return low + (high - low) * min(0.5, 1.2 * late / (late + early))
