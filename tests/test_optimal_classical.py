"""The optimiser against Pontryagin's principle: regimes, speeds and energies of a method without any mesh."""

from dataclasses import replace

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.optimal.classical import brake_speed, classical_run, steep_climb, steep_descent
from workbench.optimal.course import Course
from workbench.optimal.profile import WEIGHT, forces
from workbench.optimal.reference import find_reference
from workbench.optimal.regimes import regimes
from workbench.optimal.vehicle import ForceLimit, Vehicle

INTERCITY = Vehicle("intercity", 391e3, (5854.0, 74.0, 13.0), ForceLimit(213.9e3), friction_brake_n=250e3,
                    rotating_fraction=0.06, traction_efficiency=0.85)
METRO = Vehicle("metro", 192e3, (2100.0, 160.0, 9.0), ForceLimit(240e3), friction_brake_n=190e3, rotating_fraction=0.1)
FREIGHT = Vehicle("freight", 1.6e6, (16e3, 200.0, 60.0), ForceLimit(400e3), friction_brake_n=500e3)
POWERED = replace(INTERCITY, name="with power limit", traction=ForceLimit(213.9e3, 2.2e6))
# Long enough to hold a speed below the limit.
HOLDING = [(INTERCITY, 40e3, 1700.0), (INTERCITY, 25e3, 900.0), (METRO, 6e3, 420.0), (METRO, 12e3, 620.0),
           (FREIGHT, 50e3, 2900.0), (POWERED, 40e3, 1600.0)]
# No room to hold, and a limit below V.
OTHERS = [(METRO, 1500.0, 110.0, 60.0), (INTERCITY, 5e3, 270.0, 60.0), (METRO, 6e3, 420.0, 16.0),
          (INTERCITY, 25e3, 1000.0, 28.0)]


def level(length_m: float, limit_mps: float = 70.0) -> Course:
    return Course(np.array([0.0, length_m]), np.array([limit_mps]), np.zeros((1, 2)), np.zeros((1, 2)))


def start_of_braking(vehicle, profile) -> float:
    """Speed where the lines of half the squared speed before and after the switch from coasting to braking meet."""
    names, x, b = regimes(vehicle, profile), profile.position_m, profile.half_square
    last = int(np.flatnonzero(names == "coast")[-1])
    before, after = last - 10, last + 30
    slopes = np.diff(b) / np.diff(x)
    place = ((b[after] - slopes[after] * x[after] - b[before] + slopes[before] * x[before])
             / (slopes[before] - slopes[after]))
    return float(np.sqrt(2 * (b[before] + slopes[before] * (place - x[before]))))


def held_speed(vehicle, profile) -> float:
    """Speed in the middle of what is cruised."""
    cruise = np.flatnonzero(regimes(vehicle, profile) == "cruise")
    return float(np.median(profile.speed_mps[cruise]))


@pytest.mark.parametrize("intervals", [None, 2000], ids=["default", "2000"])
@pytest.mark.parametrize(("vehicle", "length_m", "time_s"), HOLDING)
def test_speeds_and_energy_are_the_classical_ones(vehicle, length_m, time_s, intervals):
    theory = classical_run(vehicle, length_m, time_s, 70.0)
    found = find_reference(vehicle, level(length_m), time_s, intervals=intervals)
    assert theory.hold_m > 0 and not theory.limited
    assert held_speed(vehicle, found.profile) == pytest.approx(theory.top_mps, rel=1e-3)
    assert start_of_braking(vehicle, found.profile) == pytest.approx(theory.brake_mps, rel=1e-3)
    assert found.energy_j == pytest.approx(theory.energy_j, rel=1e-4)
    assert found.lower_bound_j <= theory.energy_j * (1 + 1e-9) <= found.energy_j * (1 + 1e-6)
    assert found.certificate.time_price_w == pytest.approx(theory.time_price_w, rel=1e-3)


@pytest.mark.parametrize(("vehicle", "length_m", "time_s", "limit_mps"), OTHERS)
def test_without_room_or_at_a_limit_too(vehicle, length_m, time_s, limit_mps):
    theory = classical_run(vehicle, length_m, time_s, limit_mps)
    found = find_reference(vehicle, level(length_m, limit_mps), time_s, intervals=2000)
    assert theory.limited or theory.hold_m == 0
    assert found.profile.speed_mps.max() == pytest.approx(theory.top_mps, rel=1e-3)
    assert start_of_braking(vehicle, found.profile) == pytest.approx(theory.brake_mps, rel=2e-3)
    assert found.energy_j == pytest.approx(theory.energy_j, rel=1e-4)
    assert found.lower_bound_j <= theory.energy_j * (1 + 1e-9)


@pytest.mark.parametrize(("vehicle", "length_m", "time_s"), HOLDING)
def test_no_neighbour_of_the_classical_run_takes_less(vehicle, length_m, time_s):
    """The family of all V and U that arrive in time, by quadrature alone: the printed U is its least."""
    theory = classical_run(vehicle, length_m, time_s, 70.0)
    assert theory.brake_mps == brake_speed(vehicle, theory.top_mps)
    # Capped below V the best run holds the cap; its energy must be more.
    capped = classical_run(vehicle, length_m, time_s, 0.99 * theory.top_mps)
    assert capped.limited
    assert capped.energy_j > theory.energy_j
    assert capped.energy_j == pytest.approx(theory.energy_j, rel=1e-2)


def hill(vehicle, grade_force_n, start_m, length_m, total_m) -> Course:
    force = np.array([[0.0, 0.0], [grade_force_n] * 2, [0.0, 0.0]])
    return Course(np.array([0.0, start_m, start_m + length_m, total_m]), np.full(3, 70.0), force, np.zeros((3, 2)))


@pytest.mark.parametrize(("grade_share", "length_m"), [(1.0, 1500.0), (1.15, 800.0)])
def test_full_traction_begins_before_a_steep_climb_and_ends_after_it(grade_share, length_m):
    start, grade = 20e3, grade_share * INTERCITY.traction.force_n
    course = hill(INTERCITY, grade, start, length_m, 42e3)
    found = find_reference(INTERCITY, course, 1700.0, intervals=4000)
    profile = found.profile
    hold = np.interp([start - 4000, start + 8000], profile.position_m, profile.speed_mps)
    assert hold[0] == pytest.approx(hold[1], rel=1e-3)
    theory = steep_climb(INTERCITY, float(hold.mean()), grade, length_m)
    assert theory.begins_m < 0 and theory.ends_m > length_m
    pull = forces(INTERCITY, profile).traction_n @ WEIGHT
    near = (profile.position_m[:-1] > start - 4000) & (profile.position_m[:-1] < start + 8000)
    full = np.flatnonzero(near & (pull > 0.98 * INTERCITY.traction.force_n))
    begins, ends = profile.position_m[full[0]], profile.position_m[full[-1] + 1]
    mesh = 2 * 42e3 / 4000
    assert begins - start == pytest.approx(theory.begins_m, abs=mesh + 0.05 * abs(theory.begins_m))
    assert ends - start == pytest.approx(theory.ends_m, abs=mesh + 0.01 * theory.ends_m)
    slowest = profile.speed_mps[:-1][near].min()
    assert slowest == pytest.approx(theory.extreme_speed_mps, rel=2e-3)


@pytest.mark.parametrize(("grade_n", "length_m"), [(-40e3, 1500.0), (-60e3, 900.0)])
def test_coasting_begins_before_a_steep_descent_and_ends_after_it(grade_n, length_m):
    start = 20e3
    found = find_reference(INTERCITY, hill(INTERCITY, grade_n, start, length_m, 42e3), 1700.0, intervals=4000)
    profile = found.profile
    far = np.interp([start - 8000, start + 9000], profile.position_m, profile.speed_mps)
    assert far[0] == pytest.approx(far[1], rel=1e-3)
    theory = steep_descent(INTERCITY, float(far.mean()), grade_n, length_m)
    assert theory.begins_m < 0 and theory.ends_m > length_m
    pull = forces(INTERCITY, profile).traction_n @ WEIGHT
    near = (profile.position_m[:-1] > start - 8000) & (profile.position_m[:-1] < start + 9000)
    coast = np.flatnonzero(near & (pull < 0.02 * INTERCITY.traction.force_n))
    begins, ends = profile.position_m[coast[0]], profile.position_m[coast[-1] + 1]
    mesh = 2 * 42e3 / 4000
    assert begins - start == pytest.approx(theory.begins_m, abs=mesh + 0.03 * abs(theory.begins_m))
    assert ends - start == pytest.approx(theory.ends_m, abs=mesh + 0.03 * theory.ends_m)
    assert profile.speed_mps[:-1][near].max() == pytest.approx(theory.extreme_speed_mps, rel=2e-3)


def test_it_refuses_what_the_classical_regimes_do_not_cover():
    regenerating = replace(METRO, regenerative=ForceLimit(1e5), regenerative_efficiency=0.5)
    with pytest.raises(WorkbenchError, match="regenerates"):
        classical_run(regenerating, 5e3, 400.0, 30.0)
    with pytest.raises(WorkbenchError, match="no classical run has this trip time"):
        classical_run(METRO, 5e3, 60.0, 30.0)
    with pytest.raises(WorkbenchError, match="not steep"):
        steep_climb(METRO, 20.0, 1e3, 500.0)
    with pytest.raises(WorkbenchError, match="not steep"):
        steep_descent(METRO, 20.0, -1e3, 500.0)
