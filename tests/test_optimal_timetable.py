"""Runs by timetable: against one trip time, against glued runs, against random runs, and what no run can meet."""

import functools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from optimal_instances import numbers
from scipy.optimize import minimize_scalar

from workbench.errors import InputError, WorkbenchError
from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.profile import energy_j
from workbench.optimal.reference import find_reference, find_timed_reference, least_time
from workbench.optimal.schedule import Miss, leg_times, require_possible, schedule
from workbench.optimal.smooth import smooth_reference
from workbench.optimal.socp import COARSE_FIRST
from workbench.optimal.timetable import TOUCH_S, Timetable, TimingPoint, Window, as_timetable
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("regenerating", 3e5, (4e3, 80.0, 9.0), ForceLimit(2e5, 2.2e6), ForceLimit(1.2e5, 2.5e6), 2e5,
                rotating_fraction=0.06, traction_efficiency=0.85, regenerative_efficiency=0.7)
MIDDLE_M, END_M = 6000.0, 12000.0


def line() -> Course:
    force = np.array([[0.0, 0.0], [1.2e4, 1.2e4], [0.0, -8e3]])
    return Course(np.array([0.0, 4000.0, 8000.0, END_M]), np.array([35.0, 28.0, 35.0]), force, np.zeros((3, 2)))


COURSE = line()
TIME_S = 585.8  # 1.35 times the least


@functools.cache
def free():
    """The run of least energy in that time without any window, made when a test first asks for it."""
    return find_reference(TRAIN, COURSE, TIME_S)


def free_s():
    """When it passes the middle."""
    return float(np.interp(MIDDLE_M, free().profile.position_m, free().profile.time_s))


def by(middle: Window, end: Window | None = None, **more: float | bool) -> Timetable:
    return Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)), TimingPoint(MIDDLE_M, middle, **more),
                      TimingPoint(END_M, arrival=end or Window(latest_s=TIME_S))))


def require_kept(found, timetable):
    """Every window, by the run's own times and by the simulation's."""
    for clock in (found.clock_s, found.clock_s + np.array([
            (found.check.clock_s(found.profile) - found.profile.time_s)[
                np.searchsorted(found.profile.position_m, timetable.points[e.point].position_m)]
            for e in timetable.events])):
        slack = TOUCH_S if clock is found.clock_s else 1e-3
        for time, event in zip(clock, timetable.events, strict=True):
            assert event.window.earliest_s - slack <= time <= event.window.latest_s + slack
    legs = leg_times(timetable, found.profile)
    at = 0
    for k, event in enumerate(timetable.events):
        if k and event.waits:
            assert found.clock_s[k] - found.clock_s[k - 1] >= event.dwell_s - TOUCH_S
        elif k:
            assert found.clock_s[k] - found.clock_s[k - 1] == pytest.approx(legs[at], abs=1e-6)
            at += 1


def test_the_time_leaves_room_for_coasting():
    assert pytest.approx(1.35 * least_time(TRAIN, COURSE).trip_time_s, rel=1e-3) == TIME_S


def test_one_window_at_the_end_is_a_trip_time():
    only = Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)),
                      TimingPoint(END_M, arrival=Window(latest_s=TIME_S))))
    found = find_timed_reference(TRAIN, COURSE, only)
    assert found.energy_j == pytest.approx(free().energy_j, rel=1e-6)
    assert found.lower_bound_j == pytest.approx(free().lower_bound_j, rel=1e-6)
    assert found.certificate.time_price_w == pytest.approx(free().certificate.time_price_w, rel=1e-4)


def test_a_clock_that_begins_later_changes_nothing():
    later = Timetable((TimingPoint(0.0, departure=Window(1000.0, 1000.0)),
                       TimingPoint(END_M, arrival=Window(latest_s=1000.0 + TIME_S))))
    found = find_timed_reference(TRAIN, COURSE, later)
    assert found.lower_bound_j == pytest.approx(free().lower_bound_j, rel=1e-6)
    assert found.clock_s[0] == 1000.0


def test_a_window_that_the_free_run_meets_anyway_changes_nothing():
    timetable = by(Window(free_s() - 20, free_s() + 20))
    found = find_timed_reference(TRAIN, COURSE, timetable)
    assert found.energy_j == pytest.approx(free().energy_j, rel=2e-4)
    assert found.lower_bound_j == pytest.approx(free().lower_bound_j, rel=3e-4)
    prices = found.certificate.prices_w(timetable)
    assert abs(prices[1]) < 2e-3 * prices[2]
    require_kept(found, timetable)


def glued(first_s: float, second_s: float) -> tuple[float, float]:
    """The least energy of two runs of so many seconds, one up to the middle and one from it, and its speed there."""
    def energy(speed: float) -> float:
        try:
            first = find_reference(TRAIN, COURSE.cut(0.0, MIDDLE_M), first_s, 0.0, speed, intervals=300)
            second = find_reference(TRAIN, COURSE.cut(MIDDLE_M, END_M), second_s, speed, 0.0, intervals=300)
            return first.energy_j + second.energy_j
        except InfeasibleRunError:
            return 1e12

    best = minimize_scalar(energy, bounds=(8.0, 28.0), method="bounded", options={"xatol": 0.05})
    return float(best.fun), float(best.x)


@pytest.mark.parametrize(("shift_s", "sign"), [(-20.0, 1), (20.0, -1)])
def test_a_tight_window_costs_what_two_glued_runs_cost(shift_s, sign):
    """Sooner than free, so that the latest time binds; later, so that the earliest does."""
    at = free_s() + shift_s
    timetable = by(Window(latest_s=at) if sign > 0 else Window(at))
    found = find_timed_reference(TRAIN, COURSE, timetable)
    require_kept(found, timetable)
    energy, speed = glued(at, TIME_S - at)
    assert found.energy_j > free().energy_j * 1.0005
    assert found.energy_j == pytest.approx(energy, rel=1e-3)
    assert found.lower_bound_j <= energy
    assert found.gap <= 1e-3
    middle = np.searchsorted(found.profile.position_m, MIDDLE_M)
    assert found.profile.speed_mps[middle] == pytest.approx(speed, abs=0.6)
    prices = found.certificate.prices_w(timetable)
    assert sign * prices[1] > 0.01 * prices[2]


def test_a_large_mesh_gives_the_same_with_what_it_leaves_out():
    timetable = by(Window(latest_s=free_s() - 20), fastest_mps=21.0)
    large, small = (find_timed_reference(TRAIN, COURSE, timetable, intervals=count)
                    for count in (COARSE_FIRST + 200, 600))
    require_kept(large, timetable)
    assert large.energy_j == pytest.approx(small.energy_j, rel=3e-4)
    assert large.certificate.window_prices_w[1] == pytest.approx(small.certificate.window_prices_w[1], rel=0.02)
    assert large.gap <= small.gap


def test_the_price_of_a_window_is_the_slope_of_the_energy():
    at = free_s() - 20.0
    one, two, three = (find_timed_reference(TRAIN, COURSE, by(Window(latest_s=at + d))) for d in (-1.0, 0.0, 1.0))
    price = two.certificate.window_prices_w[1]
    assert (one.energy_j - three.energy_j) / 2 == pytest.approx(price, rel=0.1)


@pytest.mark.parametrize("more", [{"fastest_mps": 15.0}, {"slowest_mps": 27.0}, {"slowest_mps": 18.0,
                                                                                "fastest_mps": 18.0}])
def test_a_window_of_speed_holds_and_is_priced(more):
    timetable = by(Window(), **more)
    found = find_timed_reference(TRAIN, COURSE, timetable)
    speed = found.profile.speed_mps[np.searchsorted(found.profile.position_m, MIDDLE_M)]
    assert more.get("slowest_mps", 0.0) - 1e-6 <= speed <= more.get("fastest_mps", 99.0) + 1e-9
    assert found.gap <= 1e-3
    assert found.energy_j >= free().lower_bound_j
    assert found.energy_j > free().energy_j


def test_a_stop_with_two_windows_waits_for_its_departure():
    stop = TimingPoint(MIDDLE_M, Window(250.0, 330.0), Window(400.0, 420.0), stands=True)
    timetable = Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)), stop,
                           TimingPoint(END_M, arrival=Window(latest_s=760.0))))
    found = find_timed_reference(TRAIN, COURSE, timetable)
    require_kept(found, timetable)
    parts = sum(find_reference(TRAIN, COURSE.cut(*part), time).energy_j
                for part, time in (((0.0, MIDDLE_M), 330.0), ((MIDDLE_M, END_M), 360.0)))
    assert found.energy_j == pytest.approx(parts, rel=1e-3)
    assert found.lower_bound_j <= parts
    smooth = smooth_reference(TRAIN, COURSE, timetable, 1.0)
    assert smooth.miss_s == 0.0
    at, v, _ = smooth.run.at(np.linspace(smooth.clock_s[1] + 1e-3, smooth.clock_s[2] - 1e-3, 5) - smooth.clock_s[0])
    np.testing.assert_allclose(at, MIDDLE_M, atol=1e-3)
    np.testing.assert_allclose(v, 0.0, atol=1e-6)


def test_a_stop_without_windows_is_a_stop_of_the_line_with_its_dwell():
    timetable = by(Window(), Window(latest_s=TIME_S + 140), stands=True, dwell_s=40.0)
    found = find_timed_reference(TRAIN, COURSE, timetable)
    require_kept(found, timetable)
    stopped = find_reference(TRAIN, replace(COURSE.split(np.array([MIDDLE_M])), stops_m=(MIDDLE_M,)), TIME_S + 100)
    assert found.energy_j == pytest.approx(stopped.energy_j, rel=1e-5)
    assert found.lower_bound_j == pytest.approx(stopped.lower_bound_j, rel=1e-5)


def test_the_smooth_run_passes_within_its_window():
    timetable = by(Window(free_s() - 21, free_s() - 20))
    smooth = smooth_reference(TRAIN, COURSE, timetable, 1.0)
    assert smooth.miss_s == 0.0
    position = smooth.run.at(smooth.clock_s[1:2] - smooth.clock_s[0])[0][0]
    assert position == pytest.approx(MIDDLE_M, abs=1e-3)


IMPOSSIBLE = [
    (by(Window(latest_s=100.0)), r"timing point 2 at 6000 m cannot be met: passing by 100 s asked, .* is the earliest, "
                                 r".* s later, as fast as can be after departure at 0 m not before 0 s \(.*limit"),
    (by(Window(500.0), Window(latest_s=600.0)), "timing point 3 at 12000 m cannot be met: arrival by 600 s .* after "
                                                "passing at 6000 m not before 500 s"),
    (by(Window(700.0), Window(latest_s=600.0)), "timing point 3 at 12000 m cannot be met"),
    (by(Window(), slowest_mps=30.0), "timing point 2 at 6000 m asks for 30 m/s at least: .* allow 28 m/s there"),
    (Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)),
                TimingPoint(MIDDLE_M, Window(300.0), Window(latest_s=310.0), True, dwell_s=30.0),
                TimingPoint(END_M, arrival=Window(latest_s=900.0)))),
     "departure by 310 s asked, 330.0 s is the earliest, 20.0 s later, because .* the least dwell is 30 s"),
]


@pytest.mark.parametrize(("timetable", "words"), IMPOSSIBLE)
def test_what_no_run_meets_is_refused_in_one_line(timetable, words):
    with pytest.raises(InfeasibleRunError, match=words) as caught:
        find_timed_reference(TRAIN, COURSE, timetable)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("stands", [False, True])
def test_the_nonlinear_program_finds_the_same(stands):
    late = Window(latest_s=free_s() - 15)
    stop = TimingPoint(MIDDLE_M, late, Window(free_s() + 30) if stands else Window(), stands, 20.0 if stands else 0.0)
    timetable = Timetable((TimingPoint(0.0, departure=Window(0.0, 10.0)), stop,
                           TimingPoint(END_M, arrival=Window(latest_s=TIME_S + 90))))
    cone, other = (find_timed_reference(TRAIN, COURSE, timetable, intervals=200, solver=name)
                   for name in ("socp", "nlp"))
    require_kept(other, timetable)
    assert other.solver == "ipopt"
    assert other.energy_j == pytest.approx(cone.energy_j, rel=1e-3)
    np.testing.assert_allclose(other.certificate.window_prices_w[1], cone.certificate.window_prices_w[1], rtol=0.05)
    assert max(cone.lower_bound_j, other.lower_bound_j) <= min(cone.energy_j, other.energy_j)


def test_what_a_run_at_hand_does_is_possible_whatever_the_other_estimate_says():
    """The one on coarser cells may be the slower one: 10401.8 s were too short where 10400.5 s were the least."""
    quickest = least_time(TRAIN, COURSE)
    slower = replace(quickest, half_square=quickest.half_square * 0.98)
    between = as_timetable(COURSE, (quickest.trip_time_s + slower.trip_time_s) / 2)
    require_possible(TRAIN, between, quickest, slower)
    require_possible(TRAIN, between, slower, quickest)
    with pytest.raises(InfeasibleRunError, match="too short"):
        require_possible(TRAIN, between, slower, slower)


def test_a_timetable_of_another_course_or_without_limits_is_refused():
    with pytest.raises(WorkbenchError, match="cut it"):
        find_timed_reference(TRAIN, COURSE.cut(0.0, 9000.0), by(Window()))
    with pytest.raises(WorkbenchError, match="latest one"):
        by(Window(), Window(0.0))


@given(st.lists(numbers(10.0, 300.0), min_size=1, max_size=5), st.data())
def test_a_schedule_meets_every_window_or_names_one_that_is_missed(legs, data):
    points = [TimingPoint(0.0, departure=Window(0.0, data.draw(st.sampled_from([0.0, 50.0]))))]
    for k in range(1, len(legs) + 1):
        low = data.draw(numbers(0.0, 900.0))
        high = low + data.draw(numbers(0.0, 600.0))
        stands = data.draw(st.booleans()) and k < len(legs)
        points.append(TimingPoint(100.0 * k, Window(low, high), Window(low, high + 60) if stands else Window(), stands,
                                  20.0 if stands else 0.0))
    timetable = Timetable(tuple(points))
    clock = schedule(timetable, np.array(legs))
    if isinstance(clock, Miss):
        assert clock.by_s > 0
        return
    for k, event in enumerate(timetable.events):
        assert event.window.earliest_s - 1e-9 <= clock[k] <= event.window.latest_s + 1e-9
        if k:
            passed = clock[k] - clock[k - 1]
            assert passed >= event.dwell_s - 1e-9 if event.waits else passed == pytest.approx(legs[event.point - 1])


def test_a_downhill_run_that_has_more_time_than_use_for_waits_or_slows_down():
    """Down a slope and without an electric brake no second is worth anything; the window must be met all the same."""
    vehicle = replace(TRAIN, regenerative=ForceLimit(0.0), regenerative_efficiency=0.0)
    slope = Course(np.array([0.0, END_M]), np.array([30.0]), np.full((1, 2), -6e4), np.zeros((1, 2)))
    for end in (Window(1500.0, 1501.0), Window(1300.0, 1300.0)):
        timetable = by(Window(900.0, 901.0 if end.latest_s > 1300 else 900.0), end)
        found = find_timed_reference(vehicle, slope, timetable)
        require_kept(found, timetable)
        assert found.energy_j >= found.lower_bound_j
        assert math.isclose(energy_j(vehicle, found.profile), found.energy_j, rel_tol=1e-9, abs_tol=1.0)


def test_windows_that_make_a_train_crawl_all_along_are_in_another_unit():
    """Positions in km read as m: 9 m, which take 900 s; a long wait before one signal is a timetable."""
    course = Course(np.array([0.0, 4.0, 9.0]), np.full(2, 20.0), np.zeros((2, 2)), np.zeros((2, 2)))
    crawl = Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)), TimingPoint(4.0, Window(400.0, 450.0)),
                       TimingPoint(9.0, arrival=Window(900.0, 950.0))))
    with pytest.raises(InputError, match=r"timetable: its windows make 9 m take 850 s of running.*positions in m"):
        find_timed_reference(TRAIN, course, crawl)
    waits = by(Window(free_s() + 400.0, free_s() + 420.0), Window(latest_s=TIME_S + 500.0))
    assert find_timed_reference(TRAIN, COURSE, waits, intervals=40).energy_j > 0
