"""The bound against every run that can be driven: none may take less, whatever the certificate, train or line."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from optimal_instances import certificate_values, courses, numbers, random_runs, vehicles
from scipy.optimize import minimize_scalar

from workbench.errors import WorkbenchError
from workbench.optimal import bound as bound_module
from workbench.optimal.bound import Certificate, Terms, cell_bounds, lower_bound, minima
from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.grid import kept_borders
from workbench.optimal.profile import Profile, energy_j, forces, largest_force
from workbench.optimal.reference import find_reference
from workbench.optimal.timetable import as_timetable
from workbench.optimal.vehicle import ForceLimit, Vehicle

# Share of the work done by which a cell of constant acceleration may pass a limit between its ends.
EXCESS = 1e-9


def own_energy(vehicle, run):
    """Energy without auxiliaries, less what force beyond a limit could have returned or replaced."""
    found = forces(vehicle, run)
    step = np.diff(run.position_m)
    work = float(step @ (found.traction_n + found.regenerative_n + found.friction_n).mean(axis=1))
    beyond = float(step @ found.excess_n.max(axis=1))
    used = energy_j(vehicle, run) - vehicle.auxiliary_w * run.trip_time_s
    return used + 2 * beyond / vehicle.traction_efficiency, EXCESS * (work + 1.0)


@settings(max_examples=60)  # of twelve runs each
@given(vehicles(), courses(), st.data(), st.integers(0, 2**31))
def test_no_run_takes_less_than_any_certificate_proves(vehicle, course, data, seed):
    runs = random_runs(vehicle, course, seed, 12)
    extra = np.array(data.draw(st.lists(numbers(1.0, float(course.position_m[-1]) - 1.0), max_size=4)))
    positions = np.unique(np.concatenate((kept_borders(course), extra)))
    positions = positions[np.insert(np.diff(positions) > 1e-3, 0, True)]
    if not set(kept_borders(course)) <= set(positions):
        return
    left, right, price = data.draw(certificate_values(len(positions) - 1))
    certificate = Certificate(positions, left, right, price)
    for run in runs:
        bound = lower_bound(vehicle, course, certificate, run.trip_time_s)
        energy, tolerance = own_energy(vehicle, run)
        assert bound <= energy + tolerance


@settings(max_examples=60)  # of eight runs each
@given(vehicles(), courses(), st.data(), st.integers(0, 2**31), numbers(0.0, 12.0), numbers(0.0, 12.0))
def test_cells_need_not_know_the_limits_nor_the_stops(vehicle, course, data, seed, start_mps, end_mps):
    """Certificates on cells of their own, at runs that start and end at a speed; without tunnels."""
    course = replace(course, drag=np.zeros_like(course.drag))
    start_mps, end_mps = min(start_mps, course.limit_mps[0]), min(end_mps, course.limit_mps[-1])
    length = float(course.position_m[-1])
    inner = sorted({round(x, 3) for x in data.draw(st.lists(numbers(1.0, length - 1.0), max_size=5))})
    positions = np.array([0.0, *inner, length])
    left, right, price = data.draw(certificate_values(len(positions) - 1))
    certificate = Certificate(positions, left, right, price)
    for run in random_runs(vehicle, course, seed, 8, start_mps, end_mps):
        bound = lower_bound(vehicle, course, certificate, run.trip_time_s, start_mps, end_mps)
        energy, tolerance = own_energy(vehicle, run)
        assert bound <= energy + tolerance


@settings(max_examples=12)  # of thirty runs each
@given(vehicles(), courses(4), st.integers(0, 2**31), st.sampled_from([1.03, 1.15, 1.5]))
def test_no_run_in_time_takes_less_than_the_bound_of_a_reference(vehicle, course, seed, factor):
    runs = random_runs(vehicle, course, seed, 30)
    if not runs:
        return
    asked = factor * min(run.trip_time_s for run in runs)
    try:
        found = find_reference(vehicle, course, asked, intervals=80)
    except InfeasibleRunError:  # below the least feasible time on its own finer mesh: never by much
        assert factor < 1.1
        return
    assert found.lower_bound_j <= found.energy_j
    assert found.profile.trip_time_s <= asked * (1 + 1e-9)
    certificate, drawn = found.certificate, found.certificate.auxiliary_w
    rng = np.random.default_rng(seed)
    own, tolerance = own_energy(vehicle, found.profile)
    for size in (0.0, 1e-3, 1e-2, 0.1):  # near its best a bound is nearly sharp, so that a wrong term would show
        noise = rng.normal(0.0, size, (2, len(certificate.left)))
        price = (certificate.time_price_w - drawn) * (1 + rng.normal(0.0, size / 10))
        near = Certificate(certificate.position_m, certificate.left + noise[0], certificate.right + noise[1],
                           price + drawn, auxiliary_w=drawn)
        time = found.profile.trip_time_s
        assert lower_bound(vehicle, course, near, time) <= own + drawn * time + tolerance
    for run in runs:
        # A bound holds for runs of its trip time: each run is held against the bound at its own.
        bound = lower_bound(vehicle, course, certificate, max(asked, run.trip_time_s))
        energy, tolerance = own_energy(vehicle, run)
        assert bound <= energy + drawn * run.trip_time_s + tolerance


@settings(max_examples=20)
@given(vehicles(), courses(), st.integers(1, 9), st.data())
def test_cells_are_bounded_alike_in_blocks_of_any_size(vehicle, course, block, data):
    left, right, price = data.draw(certificate_values(len(kept_borders(course)) - 1))
    certificate = Certificate(kept_borders(course), left, right, price)
    whole = cell_bounds(vehicle, course, certificate, as_timetable(course, 600.0))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bound_module, "BLOCK", block)
        assert np.array_equal(cell_bounds(vehicle, course, certificate, as_timetable(course, 600.0)), whole)


def test_a_jump_of_the_price_inside_a_cell_of_two_limits_proves_nothing_false():
    """A train that comes fast and coasts needs no energy, so a positive bound would be wrong."""
    vehicle = Vehicle("coaster", 2e5, (3000.0, 80.0, 8.0), ForceLimit(1.5e5), friction_brake_n=1.6e5)
    course = Course(np.array([0.0, 9000.0, 10000.0]), np.array([40.0, 10.0]), np.zeros((2, 2)), np.zeros((2, 2)))
    jumping = Certificate(np.array([0.0, 4000.0, 10000.0]), np.array([0.0, 1.0]), np.array([0.0, 1.0]), 0.0)
    assert lower_bound(vehicle, course, jumping, 900.0, 40.0, 0.0) <= 0.0


def test_a_cell_across_a_change_of_the_drag_is_refused():
    vehicle = Vehicle("digger", 2e5, (3000.0, 80.0, 8.0), ForceLimit(1.5e5), friction_brake_n=1.6e5)
    drag = np.array([[60.0, 60.0], [0.0, 0.0], [60.0, 60.0]])
    course = Course(np.array([0.0, 1.0, 9999.0, 10000.0]), np.full(3, 40.0), np.zeros((3, 2)), drag)
    across = Certificate(np.array([0.0, 10000.0]), np.ones(1), np.ones(1), 1e5)
    with pytest.raises(WorkbenchError, match="crosses a change of the tunnels' drag"):
        lower_bound(vehicle, course, across, 600.0)
    assert set(kept_borders(course)) == set(course.position_m)


def test_teeth_of_a_saw_have_borders():
    drag = np.array([[0.0, 60.0], [0.0, 60.0]])
    course = Course(np.array([0.0, 500.0, 1000.0]), np.full(2, 40.0), np.zeros((2, 2)), drag)
    assert 500.0 in kept_borders(course)


@settings(max_examples=300)
@given(numbers(-1e6, 1e6), numbers(-1e5, 1e5), numbers(-1e4, 1e4), numbers(-300.0, 300.0), numbers(0.0, 30.0),
       numbers(0.1, 40.0))
def test_minima_are_the_least_values(inverse, constant, slope, square, low, width):
    if inverse < 0:
        low = max(low, 0.1)  # else -inf, which a bound may say
    high = low + width
    terms = Terms(*(np.array([value]) for value in (0.0, 0.0, low, high, inverse, constant, slope, square)))
    least = float(minima(terms)[0])
    v = np.concatenate((np.linspace(max(low, 1e-6), high, 4000), np.geomspace(max(low, 1e-6), high, 4000)))
    sampled = inverse / v + constant + slope * v + square * v * v
    if low == 0 and inverse == 0:
        v, sampled = np.append(v, 0.0), np.append(sampled, constant)
    scale = 1.0 + abs(constant) + np.abs(sampled).min()
    assert least <= sampled.min() + 1e-9 * scale
    best = int(np.argmin(sampled))
    near = minimize_scalar(lambda x: inverse / x + constant + slope * x + square * x * x,
                           bounds=(max(v[best] * 0.99, low, 1e-6), min(max(v[best] * 1.01, 1e-3), high)),
                           method="bounded", options={"xatol": 1e-10})
    assert least >= min(float(near.fun), sampled.min()) - 1e-6 * scale


@settings(max_examples=60)
@given(vehicles(), courses(), st.integers(0, 2**31))
def test_redundant_borders_change_nothing(vehicle, course, seed):
    rng = np.random.default_rng(seed)
    cut = course.split(rng.uniform(course.position_m[0] + 1, course.position_m[-1] - 1, 5))
    x = kept_borders(course)
    certificate = Certificate(x, rng.uniform(0, 1.5, len(x) - 1), rng.uniform(0, 1.5, len(x) - 1), 1e5)
    one, two = (lower_bound(vehicle, c, certificate, 500.0) for c in (course, cut))
    assert one == pytest.approx(two, rel=1e-9, abs=1.0)


def test_the_random_runs_are_runs():
    """What the others rest on: enough runs, in order, of different speeds, that end where they should."""
    vehicle = Vehicle("any", 3e5, (3000.0, 60.0, 8.0), ForceLimit(2e5, 2e6), friction_brake_n=2e5)
    course = Course(np.array([0.0, 3000.0, 6000.0]), np.array([30.0, 20.0]), np.array([[0.0, 2e4], [2e4, -2e4]]),
                    np.zeros((2, 2)))
    runs = random_runs(vehicle, course, 7, 40)
    assert len(runs) > 30
    assert len({round(run.trip_time_s) for run in runs}) > 15
    assert all(isinstance(run, Profile) and run.half_square[-1] == 0.0 for run in runs)


COMFORT = Vehicle("with comfort limits", 3e5, (4e3, 80.0, 9.0), ForceLimit(2.5e5, 2.2e6), ForceLimit(2e5, 2.5e6), 2e5,
                  max_acceleration_mps2=0.4, max_deceleration_mps2=0.7, traction_efficiency=0.85,
                  regenerative_efficiency=0.7)


@pytest.mark.parametrize("p", [-0.4, 0.3, 1.6])
@pytest.mark.parametrize("line_n", [-2e4, 3e4])
@pytest.mark.parametrize("price_w", [1e4, 3e6])
def test_a_limit_of_the_acceleration_binds_up_to_the_speed_where_another_does(p, line_n, price_w):
    """Against the least value over a lattice of speeds with the forces that the train has at each; where p does not
    change nothing else is lost. Equal ranges of speed lost up to a per cent where two limits crossed within one."""
    course = Course(np.array([0.0, 1000.0]), np.array([35.0]), np.full((1, 2), line_n), np.zeros((1, 2)))
    speeds = np.linspace(1e-3, 35.0, 200_001)
    a, b_1, c = COMFORT.davis_n
    resistance = a + b_1 * speeds + c * speeds**2
    most = np.minimum(largest_force(COMFORT.traction, speeds), 3e5 * 0.4 + resistance + line_n)
    electric = largest_force(COMFORT.regenerative, speeds)
    hardest = np.minimum(electric + 2e5, 3e5 * 0.7 - resistance - line_n)
    costs = [u * (1 / 0.85 - p) for u in (0.0 * most, most)]  # at corners of the cost of a force
    costs += [0.7 * -np.minimum(u, electric) + p * u for u in (np.minimum(electric, hardest), hardest)]
    expected = 1000.0 * np.min(np.min(costs, axis=0) + price_w / speeds + p * resistance)
    certificate = Certificate(course.position_m, np.array([p]), np.array([p]), price_w)
    found = float(cell_bounds(COMFORT, course, certificate, as_timetable(course, 100.0))[0])
    assert found == pytest.approx(expected, rel=1e-6)
    assert found <= expected + 1e-9 * abs(expected)
