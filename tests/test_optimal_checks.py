"""What the optimiser's answers are made of, each part against another method; and requests that no run meets."""

import copy
import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from optimal_instances import certificate_values, courses, limits, numbers, random_runs, vehicles
from scipy.integrate import quad

from workbench.errors import InputError, WorkbenchError
from workbench.optimal.bound import lower_bound
from workbench.optimal.bound_checker import checked_bound, proven_bound, stated_digests
from workbench.optimal.bound_document import bound_document
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.force_pieces import force_pieces
from workbench.optimal.profile import Profile, cell_energy_j, energy_j, largest_force
from workbench.optimal.reference import find_reference, least_time
from workbench.optimal.timetable import in_time
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("regenerating", 3e5, (4e3, 80.0, 9.0), ForceLimit(2e5, 2.2e6), ForceLimit(1.2e5, 2.5e6), 2e5,
                rotating_fraction=0.06, traction_efficiency=0.85, regenerative_efficiency=0.7, auxiliary_w=3e4)


def line(grade_n: float = 0.0, limit_mps: float = 30.0, length_m: float = 8000.0) -> Course:
    force = np.array([[0.0, 0.0], [grade_n, grade_n], [0.0, 0.0]])
    return Course(np.array([0.0, 0.4, 0.7, 1.0]) * length_m, np.array([limit_mps, 0.8 * limit_mps, limit_mps]), force,
                  np.zeros((3, 2)))


@settings(max_examples=200)
@given(limits(2e5), numbers(0.0, 60.0))
def test_pieces_of_a_limit_are_the_limit(limit, speed):
    pieces = force_pieces(limit, 60.0)
    assert pieces[0].low_mps == 0.0 and pieces[-1].high_mps == 60.0
    assert all(one.high_mps == two.low_mps for one, two in pairwise(pieces))
    holding = [piece for piece in pieces if piece.low_mps <= speed <= piece.high_mps]
    for piece in holding if speed > 0 else holding[:1]:
        assert piece.at(speed) == pytest.approx(limit.at(speed), rel=1e-9)
    assert largest_force(limit, np.array([speed]))[0] == pytest.approx(limit.at(speed), rel=1e-12)


def test_energy_is_counted_on_both_sides_of_where_traction_turns_to_braking():
    """Within cells over summits, where three points alone were a hundredth of the cell's energy wrong."""
    course = Course(np.array([0.0, 40.0, 80.0]), np.full(2, 30.0), np.array([[4e4, -5e4], [2e4, -6e4]]),
                    np.zeros((2, 2)))
    run = Profile(course, np.array([150.0, 150.0, 150.4]))
    a, b_1, c = TRAIN.davis_n

    def supplied(x: float) -> float:
        cell = int(x >= 40.0)
        speed = math.sqrt(2 * np.interp(x, course.position_m, run.half_square))
        force = (TRAIN.inertia_kg * run.acceleration_mps2[cell] + a + b_1 * speed + c * speed**2
                 + np.interp(x - 40 * cell, [0.0, 40.0], course.force_n[cell]))
        electric = min(-force, TRAIN.regenerative.at(speed))
        return force / TRAIN.traction_efficiency if force > 0 else -TRAIN.regenerative_efficiency * electric

    signs = [supplied(x) > 0 for x in np.linspace(0.0, 80.0, 801)]
    assert np.count_nonzero(np.diff(signs)) == 3  # within both cells, and at their border
    cells = [quad(supplied, low, high, points=np.linspace(low, high, 50)[1:-1], limit=500)[0]
             for low, high in ((0.0, 40.0 - 1e-9), (40.0, 80.0 - 1e-9))]
    assert cell_energy_j(TRAIN, run) == pytest.approx(cells, abs=5e-5 * 40 * 4e4)


@settings(max_examples=20)
@given(vehicles(), st.integers(0, 2**31))
def test_the_energy_of_a_run_is_its_power_over_time(vehicle, seed):
    """By quadrature over time, cell by cell, of force times speed."""
    course = line(1.5e4)
    for run in random_runs(vehicle, course, seed, 2):
        total = vehicle.auxiliary_w * run.trip_time_s
        for k in range(len(run.acceleration_mps2)):
            v_0, rate = run.speed_mps[k], run.acceleration_mps2[k]
            force = float(run.course.force_n[k, 0])  # constant on each section of this line

            def power(t, v_0=v_0, rate=rate, force=force):
                v = v_0 + rate * t
                a, b, c = vehicle.davis_n
                u = vehicle.inertia_kg * rate + a + b * v + c * v * v + force
                electric = vehicle.regenerative.at(v)
                return v * (u / vehicle.traction_efficiency if u > 0
                            else vehicle.regenerative_efficiency * max(u, -electric))

            total += quad(power, 0.0, run.time_s[k + 1] - run.time_s[k], epsabs=1.0, epsrel=1e-6)[0]
        assert energy_j(vehicle, run) == pytest.approx(total, rel=2e-3, abs=5e4)


def test_more_time_takes_less_energy_and_the_price_of_time_falls():
    """Without auxiliaries; the time price is the slope of energy over time."""
    vehicle = replace(TRAIN, auxiliary_w=0.0)
    least = least_time(vehicle, line()).trip_time_s
    asked = least * np.array([1.05, 1.1, 1.2, 1.4, 1.8])
    found = [find_reference(vehicle, line(), float(time)) for time in asked]
    energy = np.array([one.energy_j for one in found])
    price = np.array([one.certificate.time_price_w for one in found])
    assert np.all(np.diff(energy) < 0) and np.all(np.diff(price) < 0)
    slopes = -np.diff(energy) / np.diff(asked)
    assert np.all((slopes < price[:-1] * 1.01) & (slopes > price[1:] * 0.99))


def test_ten_times_as_heavy_takes_ten_times_the_energy():
    scale = 10.0
    heavy = replace(TRAIN, mass_kg=scale * TRAIN.mass_kg, davis_n=tuple(scale * x for x in TRAIN.davis_n),
                    traction=ForceLimit(scale * 2e5, scale * 2.2e6), auxiliary_w=scale * 3e4,
                    regenerative=ForceLimit(scale * 1.2e5, scale * 2.5e6), friction_brake_n=scale * 2e5)
    one, ten = line(1e4), line(1e5)
    asked = 1.2 * least_time(TRAIN, one).trip_time_s
    light, found = find_reference(TRAIN, one, asked), find_reference(heavy, ten, asked)
    assert found.energy_j == pytest.approx(scale * light.energy_j, rel=1e-6)
    assert found.lower_bound_j == pytest.approx(scale * light.lower_bound_j, rel=1e-5)


DOCUMENT: dict = {}


def document() -> dict:
    if not DOCUMENT:
        course = line(1.5e4)
        found = find_reference(TRAIN, course, 1.2 * least_time(TRAIN, course).trip_time_s, intervals=20)
        DOCUMENT.update(bound_document(TRAIN, course, found, 0.0, 0.0))
    return copy.deepcopy(DOCUMENT)


def test_the_untouched_certificate_proves_its_bound():
    assert checked_bound(document()) >= Fraction(document()["lower_bound_J"])


STRONGER = {"resistance": ("davis_n", [0.0, 0.0, 0.0]), "traction": ("traction_efficiency", 1.0),
            "brakes": ("regenerative_efficiency", 1.0)}


@pytest.mark.parametrize("name", STRONGER)
def test_a_train_that_takes_less_does_not_bear_the_bound(name):
    made = document()
    key, value = STRONGER[name]
    assert made["train"][key] != value
    made["train"][key] = value
    with pytest.raises(ValueError, match="digests"):
        checked_bound(made)
    made["digests"] = stated_digests(made)
    with pytest.raises(ValueError, match="it proves"):
        proven_bound(made)


@settings(max_examples=3)
@given(vehicles(), courses(3))
def test_certificates_of_any_train_hold(vehicle, course):
    """With limits of the acceleration, tables, tunnels and stops: each limit that is named is the train's."""
    try:
        found = find_reference(vehicle, course, 1.3 * least_time(vehicle, course).trip_time_s, intervals=12)
    except WorkbenchError:
        return
    made = bound_document(vehicle, course, found, 0.0, 0.0)
    assert made["lower_bound_J"] == pytest.approx(found.lower_bound_j, rel=1e-6, abs=agreement(vehicle, course))


def agreement(vehicle: Vehicle, course: Course) -> float:
    """How close the checker comes to the bound, J. Where the acceleration is limited each chooses, range by range of
    the speed, the limit that it takes for the better one: both choices are sound and need not be the same."""
    chooses = math.isfinite(vehicle.max_acceleration_mps2) or math.isfinite(vehicle.max_deceleration_mps2)
    return (1e4 if chooses else 1e-2) * course.length_m


@settings(max_examples=40)
@given(vehicles(), courses(3), st.data())
def test_the_checkers_least_values_are_those_of_the_bound(vehicle, course, data):
    """Whatever p is: both say the same, and no more than any run takes."""
    try:
        quickest = least_time(vehicle, course)
    except InfeasibleRunError:
        return
    cuts = np.array([data.draw(numbers(0.01, 0.99)) for _ in range(3)]) * course.length_m
    position = np.unique(np.concatenate((course.position_m, cuts)))
    left, right, price = data.draw(certificate_values(len(position) - 1))
    trip_time_s = 1.3 * quickest.trip_time_s
    certificate, timetable = Certificate(position, left, right, price), in_time(course, trip_time_s)
    made = bound_document(vehicle, course, SimpleNamespace(certificate=certificate, timetable=timetable), 0.0, 0.0)
    rounding = 1e-8 * trip_time_s * price
    own = lower_bound(vehicle, course, certificate, trip_time_s)
    assert made["lower_bound_J"] == pytest.approx(own, abs=rounding + agreement(vehicle, course))
    assert max(made["lower_bound_J"], own) <= energy_j(vehicle, quickest) + rounding + 1e-3 * course.length_m


REFUSED = [
    (TRAIN, line(), 200.0, "too short: the least feasible trip time is"),
    (TRAIN, line(3e5), 900.0, "cannot climb beyond"),
    (replace(TRAIN, regenerative=ForceLimit(0.0), friction_brake_n=2e4), line(-1e5), 900.0, "brakes cannot hold"),
    (TRAIN, line(), math.nan, "no trip time"), (TRAIN, line(), -5.0, "no trip time"),
    (TRAIN, line(), math.inf, "no trip time"), (TRAIN, line(), 1e7, "is it in seconds"),
]


@pytest.mark.parametrize(("vehicle", "course", "time_s", "words"), REFUSED)
def test_what_no_run_meets_is_refused_in_one_line(vehicle, course, time_s, words):
    with pytest.raises((InfeasibleRunError, InputError), match=words) as caught:
        find_reference(vehicle, course, time_s)
    assert "\n" not in str(caught.value)
    assert isinstance(caught.value, WorkbenchError)


def test_the_least_feasible_time_is_feasible_and_what_is_less_is_not():
    with pytest.raises(InfeasibleRunError) as caught:
        find_reference(TRAIN, line(), 100.0)
    least = caught.value.least_time_s
    assert least is not None
    found = find_reference(TRAIN, line(), least * (1 + 1e-6), intervals=200)
    assert found.profile.trip_time_s <= least * (1 + 1e-6)
    with pytest.raises(InfeasibleRunError):
        find_reference(TRAIN, line(), least * 0.999)


def test_a_run_that_must_speed_up_at_its_end_is_planned():
    """Coasting below the last speed and full traction up to it: refused once, because a mesh's steps fell short."""
    vehicle = Vehicle("coaster", 2e5, (3000.0, 80.0, 8.0), ForceLimit(1.5e5), friction_brake_n=1.6e5)
    course = Course(np.array([0.0, 9000.0, 10000.0]), np.array([40.0, 10.0]), np.zeros((2, 2)), np.zeros((2, 2)))
    found = find_reference(vehicle, course, 900.0, 40.0, 10.0)
    assert found.profile.speed_mps[-1] == pytest.approx(10.0, abs=1e-6)
    assert found.lower_bound_j <= found.energy_j
