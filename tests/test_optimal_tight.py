"""Times near the least one: the mesh, the run that keeps to its limit, and the bound that is near it all the same."""

from dataclasses import replace
from types import SimpleNamespace

import clarabel
import numpy as np
import pytest

from workbench.optimal.adapt import (
    AIM,
    GROWTH,
    LEAST_GROWTH,
    LONGER,
    MOST_GROWTH,
    P_CHANGE,
    _graded,
    driven_apart,
    growth,
)
from workbench.optimal.adjoint import (
    BENT_FROM,
    NEAR_FOR_RISES,
    NEAR_LIMIT,
    certificate_from,
    certificates_from,
    middles,
)
from workbench.optimal.best_forms import best_forms
from workbench.optimal.bound import lower_bound
from workbench.optimal.cone_program import ConeProgram
from workbench.optimal.course import Course
from workbench.optimal.grid import graded_grid, kept_borders
from workbench.optimal.planning import SPEED_ERROR_MPS, _too_slow
from workbench.optimal.profile import Profile
from workbench.optimal.reference import GAP_OF_CONES, find_reference, least_time
from workbench.optimal.refine import refined
from workbench.optimal.socp import NoPlanError, solve_socp
from workbench.optimal.tight_grid import tight_grid
from workbench.optimal.timetable import as_timetable
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("urban", 2e5, (6e4, 800.0, 32.0), ForceLimit(2e5), friction_brake_n=2.4e5)
LENGTH_M, GRADES, LIMITS = 80e3, 800, 80


def broken_line():
    """Grades of 100 m and limits of 1 km by chance."""
    draw = np.random.default_rng(5)
    position = np.linspace(0.0, LENGTH_M, GRADES + 1)
    limit = np.repeat(draw.choice([25.0, 30.0, 100 / 3], LIMITS), GRADES // LIMITS)
    force = np.repeat(TRAIN.mass_kg * 9.81e-3 * draw.uniform(-8, 8, GRADES), 2).reshape(-1, 2)
    return Course(position, limit, force, np.zeros((GRADES, 2)), ())


@pytest.fixture(scope="module")
def line():
    return broken_line()


@pytest.fixture(scope="module")
def quickest(line):
    return least_time(TRAIN, line)


@pytest.fixture(scope="module")
def plan(line, quickest):
    asked = 1.001 * quickest.trip_time_s
    with pytest.raises(NoPlanError):
        solve_socp(TRAIN, graded_grid(line, 300), asked)
    return solve_socp(TRAIN, tight_grid(line, quickest, 1500), asked)


def test_the_mesh_is_fine_where_the_fastest_run_changes_its_speed(line, quickest):
    grid = tight_grid(line, quickest, 1500)
    assert np.isin(kept_borders(line), grid.position_m).all()
    assert 1200 < len(grid.limit_mps) < 1900
    b = np.interp(grid.position_m, quickest.position_m, quickest.half_square)
    changes = np.abs(np.diff(b)) > 1e-3 * b[1:]
    assert np.median(grid.step_m[changes]) < np.median(grid.step_m[~changes]) / 3


def test_a_run_keeps_to_the_limit_on_climbs_and_passes_none(plan):
    held = refined(TRAIN, plan, 4)
    speed = np.sqrt(2 * plan.half_square)
    planned_s = float(np.sum(2 * plan.grid.step_m / (speed[1:] + speed[:-1])))
    assert abs(held.trip_time_s - planned_s) < 1e-5 * planned_s
    middle = (held.position_m[1:] + held.position_m[:-1]) / 2
    limit = plan.grid.course.limit_mps[np.searchsorted(plan.grid.course.position_m, middle) - 1]
    fastest = np.maximum(held.speed_mps[1:], held.speed_mps[:-1])
    assert (fastest <= limit * (1 + 1e-12)).all()


def test_p_on_a_line_at_the_limits_proves_more_near_the_least_time(plan, quickest):
    course, timetable = plan.grid.course, as_timetable(plan.grid.course, 1.001 * quickest.trip_time_s)
    short = [plan.energy_j - lower_bound(TRAIN, course, certificate_from(TRAIN, plan, NEAR_LIMIT[0], bent), timetable)
             for bent in BENT_FROM]
    assert 0 < short[1] < short[0] / 2


def test_forms_of_p_joined_piece_by_piece_prove_more_than_each(plan, quickest):
    course, timetable = plan.grid.course, as_timetable(plan.grid.course, 1.001 * quickest.trip_time_s)
    forms = [certificate_from(TRAIN, plan, near, bent) for near in NEAR_LIMIT for bent in BENT_FROM]
    bound, joined = best_forms(TRAIN, course, forms, middles(plan), timetable, 0.0, 0.0)
    alone = [lower_bound(TRAIN, course, form, timetable) for form in forms]
    assert max(alone) < bound < plan.energy_j
    assert bound == lower_bound(TRAIN, course, joined, timetable)
    # Pieces are chosen, nothing is mixed.
    assert np.any([form.left == joined.left for form in forms], axis=0).all()


def test_an_intervals_dual_is_p_in_the_middle_of_its_time():
    """Under constant acceleration a from a standstill v^2 = 2 a s, and p' = -mu / (inertia v^3) has the solution
    p = mu / (inertia a v) and a constant: only there do the duals lie on it, in the middle of the length none does."""
    level = Course(np.array([0.0, 400.0]), np.array([30.0]), np.zeros((1, 2)), np.zeros((1, 2)), ())
    train = Vehicle("steady", 2e5, (6e3, 0.0, 0.0), ForceLimit(2e5), friction_brake_n=2.4e5)
    plan = solve_socp(train, graded_grid(level, 40), 1.01 * least_time(train, level).trip_time_s)
    acceleration = (2e5 - 6e3) / 2e5
    speed = np.sqrt(2 * acceleration * middles(plan)[:12])
    fall = -np.diff(plan.adjoint[:12])
    assert fall == pytest.approx(-np.diff(plan.time_price_w / (2e5 * acceleration * speed)), rel=2e-4)


@pytest.mark.parametrize(("length_m", "share"), [(250.0, 1.0005), (1200.0, 1.001), (4000.0, 1.01)])
def test_short_runs_near_the_least_time_have_narrow_gaps(length_m, share):
    position = np.array([0.0, 0.3, 0.6, 1.0]) * length_m
    force = np.repeat(TRAIN.mass_kg * 9.81e-3 * np.array([4.0, -8.0, 12.0]), 2).reshape(-1, 2)
    line = Course(position, np.array([15.0, 12.0, 15.0]), force, np.zeros((3, 2)), ())
    found = find_reference(TRAIN, line, share * least_time(TRAIN, line).trip_time_s)
    assert 0 < found.gap <= GAP_OF_CONES
    assert found.check.energy_j == pytest.approx(found.energy_j, rel=1e-4)


def test_a_time_near_the_least_one_is_met_with_a_narrow_gap(line, quickest):
    asked = 1.0005 * quickest.trip_time_s
    found = find_reference(TRAIN, line, asked)
    assert found.profile.trip_time_s <= asked
    assert 0 < found.gap <= GAP_OF_CONES
    assert found.check.energy_j == pytest.approx(found.energy_j, rel=1e-3)  # simulated on its own


def test_where_p_changes_no_interval_is_much_longer_than_its_neighbour():
    nodes = np.array([0.0, 1000.0, 1010.0, 1020.0, 3000.0])
    mesh = SimpleNamespace(position_m=nodes)
    p = np.array([1.0, 0.7, 0.6, 0.6])  # changes on the left of 1,010 m alone
    made = _graded(SimpleNamespace(adjoint=p, grid=mesh), nodes)
    assert np.isin(nodes, made).all()
    h = np.diff(made[made <= 1010.0])
    assert (np.maximum(h[1:] / h[:-1], h[:-1] / h[1:]) <= LONGER).all()
    steady = SimpleNamespace(adjoint=np.full(4, 1.0 + P_CHANGE / 4), grid=mesh)
    assert np.array_equal(_graded(steady, nodes), nodes)


def test_a_run_below_the_least_speed_of_a_timing_point_is_none():
    course = Course(np.array([0.0, 500.0, 1000.0]), np.full(2, 30.0), np.zeros((2, 2)), np.zeros((2, 2)), ())
    timetable = as_timetable(course, 100.0)
    points = (timetable.points[0], replace(timetable.points[0], position_m=500.0, slowest_mps=20.0),
              timetable.points[-1])
    asked = SimpleNamespace(points=points, position_m=np.array([0.0, 500.0, 1000.0]))
    for speed, expected in ((20.0, False), (20.0 - 2 * SPEED_ERROR_MPS, True), (25.0, False)):
        assert _too_slow(asked, Profile(course, np.array([0.0, speed**2 / 2, 0.0]))) == expected


# Returns what braking gives, up to a power that is reached at 17 m/s.
REGIO = Vehicle("regional", 1.5e5, (2500.0, 60.0, 8.0), ForceLimit(2e5, 2.6e6), ForceLimit(1.5e5, 2.6e6), 1e5, 0.08,
                traction_efficiency=0.85, regenerative_efficiency=0.7, max_acceleration_mps2=1.0)


@pytest.fixture(scope="module")
def waves():
    """Up and down by turns, held at the limit: braking down, pulling up."""
    count = 40
    grade = np.repeat(np.where(np.arange(count) % 2, 9.0, -15.0) * REGIO.mass_kg * 9.81e-3, 2).reshape(-1, 2)
    return Course(np.linspace(0.0, 12e3, count + 1), np.full(count, 25.0), grade, np.zeros((count, 2)), ())


def test_p_may_rise_at_once_where_a_run_is_at_its_limit(waves):
    """From braking down to pulling up it rises from what is returned to what is paid: as a jump it costs nothing."""
    asked = as_timetable(waves, 1.002 * least_time(REGIO, waves).trip_time_s)
    plan = solve_socp(REGIO, graded_grid(waves, 400), asked)
    plain, rising = ([lower_bound(REGIO, waves, form, asked) for form in certificates_from(
        REGIO, plan, NEAR_FOR_RISES, rises=rises)] for rises in (False, True))
    assert max(plain) < max(rising) < plan.energy_j
    assert plan.energy_j - max(rising) < 0.8 * (plan.energy_j - max(plain))


def test_brakes_beyond_the_power_that_returns_are_no_reason_for_a_finer_mesh(waves):
    """A plan and its run take the same while braking hard: next to nothing is apart there."""
    plan = solve_socp(REGIO, graded_grid(waves, 400), 1.002 * least_time(REGIO, waves).trip_time_s)
    apart = driven_apart(REGIO, plan, refined(REGIO, plan, 8))
    hard = plan.force_n < -REGIO.regenerative.force_n
    assert hard.sum() > 20 and apart[hard].sum() < 1e-4 * plan.energy_j


def test_a_mesh_is_as_fine_as_the_gap_asks_for():
    assert growth(np.inf, 1e-3) == GROWTH and growth(1.1e-3, 1e-3) == LEAST_GROWTH
    assert growth(AIM * 8e-3, 1e-3) == pytest.approx(1.0) and growth(1.0, 1e-3) == MOST_GROWTH


def test_what_has_no_solution_is_found_out_once(monkeypatch):
    """x <= -1 where x >= 1: multipliers show it, and more careful solving would show the same."""
    solver, calls = clarabel.DefaultSolver, []
    monkeypatch.setattr(clarabel, "DefaultSolver", lambda *program: calls.append(program) or solver(*program))
    program = ConeProgram(1)
    x = program.variables(0, 1)
    program.require_at_most(x + 1.0)
    program.require_at_most(-1.0 * x + 1.0)
    with pytest.raises(NoPlanError, match="PrimalInfeasible"):
        program.solve(np.ones(1), "a program without solution")
    assert len(calls) == 1
