"""Runs keep the limits of force and power at every point, not only on average over a cell."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from optimal_instances import courses, random_runs, vehicles

from workbench.optimal.course import Course
from workbench.optimal.profile import Profile
from workbench.optimal.smooth import smooth_reference
from workbench.optimal.vehicle import ForceLimit, Vehicle

WITHIN = np.linspace(0.0, 1.0, 9)


def beyond(vehicle: Vehicle, profile: Profile) -> float:
    """The largest force beyond its limit as a share of it, at nine points of every cell; written out on its own."""
    course, b = profile.course, profile.half_square
    half = b[:-1, None] + WITHIN * np.diff(b)[:, None]
    v = np.sqrt(2 * half)
    line = course.force_n[:, :1] + WITHIN * np.diff(course.force_n)
    drag = course.drag[:, :1] + WITHIN * np.diff(course.drag)
    a, b_1, c = vehicle.davis_n
    force = (vehicle.inertia_kg * (np.diff(b) / np.diff(course.position_m))[:, None]
             + a + b_1 * v + (c + drag) * v**2 + line)
    most = np.vectorize(vehicle.traction.at)(v)
    brake = np.vectorize(vehicle.regenerative.at)(v) + vehicle.friction_brake_n
    return float(np.max(np.where(force > 0, force / most, -force / brake))) - 1


@settings(max_examples=25, deadline=None)
@given(vehicles(), courses(), st.integers(0, 2**31))
def test_no_point_of_any_driven_run_passes_a_limit_of_force_or_power(vehicle, course, seed):
    for run in random_runs(vehicle, course, seed, 2):
        assert beyond(vehicle, run) <= 1e-9


def test_less_of_the_forces_is_used_where_the_course_says_so():
    from workbench.optimal.envelope import fastest

    vehicle = Vehicle("t", 2e5, (3e3, 20.0, 8.0), ForceLimit(2e5, 2e6), ForceLimit(1e5, 1e6), 1e5)
    n = 400
    course = Course(np.linspace(0, 4000.0, n + 1), np.full(n, 40.0), np.zeros((n, 2)), np.zeros((n, 2)),
                    usable=np.where(np.arange(n)[:, None] < 100, [0.5, 1.0], [1.0, 0.8]))
    whole = fastest(vehicle, Course(course.position_m, course.limit_mps, course.force_n, course.drag))
    less = fastest(vehicle, course)
    assert less.trip_time_s > whole.trip_time_s
    start = Profile(course.cut(0.0, 1000.0), less.half_square[:101])
    half = Vehicle("h", 2e5, (3e3, 20.0, 8.0), ForceLimit(1e5, 1e6), ForceLimit(1e5, 1e6), 1e5)
    assert beyond(half, start) <= 1e-9


@pytest.mark.parametrize("jump_n", [2e4, 8e4])
def test_a_smooth_run_keeps_back_what_a_jump_of_the_line_asks_for(jump_n):
    """At full traction over a jump of the line's force the average of a run would need half of the jump more."""
    vehicle = Vehicle("t", 2e5, (3e3, 20.0, 8.0), ForceLimit(2e5, 2e6), ForceLimit(0.0), 2e5, max_speed_mps=40.0)
    force = np.repeat([[-jump_n], [0.0]], 2, axis=1)
    course = Course(np.array([0.0, 150.0, 6000.0]), np.array([35.0, 35.0]), force, np.zeros((2, 2)))
    found = smooth_reference(vehicle, course, 260.0, 2.0, intervals=200)
    assert found.force_excess == 0
    assert 1 - 1.5 * jump_n / 2e5 < found.usable[0] < 1
    assert found.energy_j > found.unreserved_energy_j * (1 - 1e-4)
    # Sampled anew, apart from the instants that the search looked at.
    time = np.linspace(0.0, found.run.trip_time_s, 200_003)
    s, v, a = found.run.at(time)
    need = 2e5 * a + 3e3 + 20 * v + 8 * v**2 + np.where(s <= 150.0, -jump_n, 0.0)
    moving = v > 1e-6
    most = np.minimum(2e5, 2e6 / np.maximum(v, 1e-3))
    assert np.all(need[moving] <= most[moving] * (1 + 1e-9))
    assert np.all(-need[moving] <= 2e5 * (1 + 1e-9))
