"""The nonlinear program against the cone program, two of its solvers, and dynamic programming that knows neither."""

from dataclasses import replace

import numpy as np
import pytest
from dynamic_program import least_cost

from workbench.optimal.course import Course
from workbench.optimal.grid import graded_grid
from workbench.optimal.nlp import solve_nlp
from workbench.optimal.profile import energy_j
from workbench.optimal.reference import find_reference, least_time
from workbench.optimal.socp import NoPlanError, solve_socp
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("regenerating", 3e5, (4e3, 80.0, 9.0), ForceLimit(2e5, 2.2e6), ForceLimit(1.2e5, 2.5e6), 2e5,
                rotating_fraction=0.06, traction_efficiency=0.85, regenerative_efficiency=0.7)
COMFORT = replace(TRAIN, name="with comfort limits", max_acceleration_mps2=0.5, max_deceleration_mps2=0.6)
ADHESION = replace(TRAIN, name="with adhesion", traction=ForceLimit(
    2e5, 2.2e6, tuple((float(v), 3e5 * 9.81 * 0.25 * (7.5 / (3.6 * v + 44) + 0.161)) for v in np.linspace(0, 45, 10))))
STEPS = replace(TRAIN, name="with steps", traction=ForceLimit(
    2e5, table=((0.0, 2e5), (10.0, 2e5), (10.5, 1.1e5), (25.0, 1e5), (26.0, 0.5e5), (45.0, 0.4e5))))
DIP = replace(TRAIN, name="with a dip", traction=ForceLimit(
    2e5, 2.2e6, ((0.0, 2e5), (10.0, 0.8e5), (15.0, 0.8e5), (20.0, 1.5e5), (30.0, 0.8e5), (45.0, 0.5e5))))
TRAINS = (TRAIN, COMFORT, ADHESION, STEPS, DIP)


def hilly(stops=()) -> Course:
    """A line with climbs, a descent, a tunnel ramp and three limits."""
    force = np.array([[0.0, 0.0], [3e4, 3e4], [3e4, -2e4], [-2e4, -2e4], [0.0, 0.0]])
    drag = np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 8.0], [8.0, 8.0], [0.0, 0.0]])
    limits = np.array([25.0, 35.0, 35.0, 20.0, 35.0])
    return Course(np.array([0.0, 3e3, 6e3, 8e3, 11e3, 15e3]), limits, force, drag, stops)


@pytest.mark.parametrize("vehicle", TRAINS, ids=lambda vehicle: vehicle.name)
@pytest.mark.parametrize("stops", [(), (8e3,)])
def test_fatrop_and_ipopt_find_the_same_run(vehicle, stops):
    """Structure given by hand could be wrong without complaint: the sparse solver knows nothing of it."""
    course = hilly(stops)
    quick = least_time(vehicle, course)
    grid = graded_grid(course, 100)
    guess = np.interp(grid.position_m, quick.position_m, quick.half_square)
    plans = []
    for solver in ("fatrop", "ipopt"):
        try:
            plans.append(solve_nlp(vehicle, grid, 1.15 * quick.trip_time_s, guess, solver=solver))
        except NoPlanError:
            assert vehicle in {STEPS, DIP} or solver == "fatrop"  # kinks are hard for both
    assert plans
    if len(plans) == 2 and vehicle not in (STEPS, DIP):  # where the tables make valleys they may end in two
        one, two = plans
        assert one.energy_j == pytest.approx(two.energy_j, rel=2e-5)
        np.testing.assert_allclose(one.half_square, two.half_square, atol=0.02 * two.half_square.max())
        assert one.time_price_w == pytest.approx(two.time_price_w, rel=2e-3)


@pytest.mark.parametrize("vehicle", [TRAIN, COMFORT], ids=lambda vehicle: vehicle.name)
def test_it_agrees_with_the_cone_program_where_that_is_no_relaxation(vehicle):
    course = hilly((8e3,))
    quick = least_time(vehicle, course)
    grid = graded_grid(course, 150)
    asked = 1.2 * quick.trip_time_s
    cone = solve_socp(vehicle, grid, asked)
    guess = np.interp(grid.position_m, quick.position_m, quick.half_square)
    plan = solve_nlp(vehicle, grid, asked, guess, solver="ipopt")
    assert plan.energy_j == pytest.approx(cone.energy_j, rel=1e-5)
    assert plan.time_price_w == pytest.approx(cone.time_price_w, rel=1e-3)
    inner = slice(2, -2)
    np.testing.assert_allclose(plan.adjoint[inner], cone.adjoint[inner], atol=0.02)


@pytest.mark.parametrize("vehicle", TRAINS, ids=lambda vehicle: vehicle.name)
def test_either_way_the_run_is_drivable_in_time_and_above_the_bound(vehicle):
    course = hilly()
    asked = 1.12 * least_time(vehicle, course).trip_time_s
    found = {way: find_reference(vehicle, course, asked, intervals=150, solver=way) for way in ("auto", "socp", "nlp")}
    for run in found.values():
        assert run.profile.trip_time_s <= asked * (1 + 1e-9)
        # Within a cell that crosses the fall from 10 to 10.5 m/s the force keeps the limit at two speeds only.
        assert run.check.force_excess < (0.15 if vehicle is STEPS else 0.03)
        assert run.check.speed_excess_mps < 0.01
        assert run.lower_bound_j <= min(other.energy_j for other in found.values())
    assert found["auto"].energy_j <= found["socp"].energy_j * (1 + 1e-12)
    assert found["auto"].lower_bound_j >= found["socp"].lower_bound_j * (1 - 1e-12)


def test_where_the_curve_has_a_dip_cones_prove_more_and_drive_as_well():
    """The concave hull of this curve over the speed promised traction that the train lacks: its gap was 9.6 %."""
    course = Course(2e3 * np.arange(7.0), np.array([30.0, 10.0, 30.0, 8.0, 30.0, 12.0]), np.zeros((6, 2)),
                    np.zeros((6, 2)))
    asked = 1.05 * least_time(DIP, course).trip_time_s
    cone, nonlinear = (find_reference(DIP, course, asked, intervals=150, solver=way) for way in ("socp", "nlp"))
    assert cone.energy_j == pytest.approx(nonlinear.energy_j, rel=2e-3)
    assert nonlinear.lower_bound_j < cone.lower_bound_j <= min(cone.energy_j, nonlinear.energy_j)
    assert cone.gap < 0.05


def test_what_no_run_can_do_is_no_plan():
    course = hilly()
    quick = least_time(TRAIN, course)
    grid = graded_grid(course, 60)
    guess = np.interp(grid.position_m, quick.position_m, quick.half_square)
    with pytest.raises(NoPlanError, match="nonlinear program"):
        solve_nlp(TRAIN, grid, 0.8 * quick.trip_time_s, guess, solver="ipopt")


def by_tables(vehicle: Vehicle, course: Course, price_w: float, steps: int, levels: int) -> tuple[float, float]:
    """Energy and time of the best run on a lattice of speeds for a price of time, by dynamic programming."""
    x = np.linspace(course.position_m[0], course.position_m[-1], steps + 1)
    h = x[1] - x[0]
    v = np.linspace(0.0, float(course.limit_mps.max()), levels)
    a, b_1, c = vehicle.davis_n
    inertia = vehicle.inertia_kg
    mean = (v[:, None] + v[None, :]) / 2
    resistance = a + b_1 * mean + c * (v[:, None] ** 2 + v[None, :] ** 2) / 2
    motion = inertia * (v[None, :] ** 2 - v[:, None] ** 2) / (2 * h) + resistance
    value = np.where(v == 0, 0.0, np.inf)
    choice = []
    with np.errstate(divide="ignore"):
        time = h / mean
    for k in range(steps - 1, -1, -1):
        line = float(np.interp((x[k] + x[k + 1]) / 2, course.position_m, np.append(course.force_n[:, 0], 0.0)))
        force = motion + line
        most = np.minimum(vehicle.traction.force_n, vehicle.traction.power_w / np.maximum(mean, 1e-9))
        electric = np.minimum(vehicle.regenerative.force_n, vehicle.regenerative.power_w / np.maximum(mean, 1e-9))
        possible = (force <= most) & (-force <= electric + vehicle.friction_brake_n) & (mean > 0)
        cost = np.where(force > 0, force / vehicle.traction_efficiency,
                        -vehicle.regenerative_efficiency * np.minimum(-force, electric)) * h
        total = np.where(possible, cost + price_w * np.where(mean > 0, time, 0.0) + value[None, :], np.inf)
        best = total.argmin(axis=1)
        choice.append((best, cost[np.arange(levels), best], time[np.arange(levels), best]))
        value = total.min(axis=1)
    at, energy, seconds = 0, 0.0, 0.0
    for best, cost, lasts in reversed(choice):
        energy, seconds, at = energy + cost[at], seconds + lasts[at], int(best[at])
    return float(energy), float(seconds)


@pytest.mark.parametrize("price_w", [2e5, 6e5, 2e6])
def test_dynamic_programming_without_any_solver_brackets_it(price_w):
    """A run on a lattice is nearly a run: the optimum is no more than it, and no less but for the lattice's width."""
    course = Course(np.array([0.0, 4000.0]), np.array([24.0]), np.zeros((1, 2)), np.zeros((1, 2)))
    energy, seconds = by_tables(TRAIN, course, price_w, 80, 801)
    found = find_reference(TRAIN, course, seconds, intervals=300)
    assert found.lower_bound_j <= energy * (1 + 2e-3)
    assert found.energy_j <= energy * (1 + 2e-3)
    # Coasting is no path on the lattice; at 801 speeds this costs up to 3.1 per cent, at 1201 up to 3.0.
    assert found.energy_j >= energy * (1 - 0.04)
    assert energy_j(TRAIN, found.profile) == found.energy_j


@pytest.mark.parametrize("vehicle", [TRAIN, STEPS, DIP], ids=lambda vehicle: vehicle.name)
@pytest.mark.parametrize("factor", [1.05, 1.1])
def test_where_the_gap_is_wide_it_is_the_bound_that_is_loose(vehicle, factor):
    """By weak duality the least of energy + price (time - T) is below every run in time, at each price of time.

    Dynamic programming finds that least value from above: some 0.2 to 0.6 per cent too high on this mesh, less on finer
    ones. For curves that are not concave it lies as near to the run found as for a concave one, far above the bound.
    """
    course = hilly()
    asked = factor * least_time(vehicle, course).trip_time_s
    # A coarse mesh where the curve is not concave: finer ones cost the nonlinear solvers minutes and leave the gap.
    found = find_reference(vehicle, course, asked, intervals=None if vehicle is TRAIN else 150)
    prices = found.certificate.time_price_w * np.array([1.0, 1.2])  # the best of more prices is one of these
    dual = max(least_cost(vehicle, course, price, 400, 1500) - price * asked for price in prices)
    assert dual == pytest.approx(found.energy_j, rel=8e-3)
    if found.gap > 0.01:
        assert vehicle is not TRAIN
        assert dual - found.lower_bound_j > 0.7 * (found.energy_j - found.lower_bound_j)
