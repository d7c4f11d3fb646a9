"""Auxiliaries in a timetable: from the first departure to the last arrival, in the plan, in the bound and its proof."""

import copy
import math
import re
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from optimal_instances import courses, numbers, random_runs, vehicles
from scipy.optimize import linprog
from test_optimal_bound import own_energy
from test_optimal_timetable import COURSE, END_M, MIDDLE_M, TIME_S, TRAIN, by, free_s, require_kept

from workbench.errors import InputError, WorkbenchError
from workbench.optimal.bound import lower_bound
from workbench.optimal.bound_checker import checked_bound, proven_bound
from workbench.optimal.bound_document import bound_document
from workbench.optimal.certificate import Certificate
from workbench.optimal.envelope import drivable
from workbench.optimal.grid import kept_borders
from workbench.optimal.reference import find_reference, find_timed_reference, least_time
from workbench.optimal.schedule import Miss, leg_times, schedule
from workbench.optimal.timetable import TOUCH_S, Timetable, TimingPoint, Window, counted

DRAWING = replace(TRAIN, auxiliary_w=2e5)
STOP = Timetable((TimingPoint(0.0, departure=Window(0.0, 60.0)),
                  TimingPoint(MIDDLE_M, Window(latest_s=400.0), Window(430.0, 440.0), stands=True, dwell_s=30.0),
                  TimingPoint(END_M, arrival=Window(850.0, 900.0))))


@settings(max_examples=80)
@given(vehicles(), courses(4), st.data(), st.integers(0, 2**31))
def test_no_run_with_auxiliaries_takes_less_than_any_certificate_proves(vehicle, course, data, seed):
    """Runs wait at the start and at stops; levels may be as low as auxiliaries allow; counted are some of them or all.

    Windows hold the run's own times, narrowly as often as not, so that nearly every price is at its limit.
    """
    vehicle = replace(vehicle, auxiliary_w=data.draw(st.sampled_from([5e4, 6e5])))
    drawn = vehicle.auxiliary_w * data.draw(st.sampled_from([1.0, 1.0, 0.5]))
    length = float(course.position_m[-1])
    x = data.draw(st.one_of(st.none(), numbers(30.0, length - 30.0)))
    passed = [x] if x is not None and min(abs(x - stop) for stop in (0.0, *course.stops_m)) > 1 else []
    positions = kept_borders(course)
    left, right = (np.array([data.draw(numbers(-0.7, 2.5)) for _ in positions[1:]]) for _ in range(2))
    for run in random_runs(vehicle, course, seed, 4):
        rng = np.random.default_rng(seed)
        clock, points = rng.uniform(0, 100), []
        origin = clock
        clock += rng.choice([0.0, 40.0])

        def window(time: float, rng=rng) -> Window:
            early, late = rng.uniform(0, 30, 2) * rng.integers(0, 2, 2)
            return Window(time - early, time + late)

        first, waited = TimingPoint(0.0, departure=Window(origin, clock + rng.choice([0.0, 20.0]))), clock
        for at in sorted((*course.stops_m, *passed)):
            b = float(np.interp(at, run.position_m, run.half_square))
            k = max(int(np.searchsorted(run.position_m, at)) - 1, 0)
            time = waited + run.time_s[k] + 2 * (at - run.position_m[k]) / (math.sqrt(2 * b) + run.speed_mps[k])
            if at in passed:
                points.append(TimingPoint(at, window(time)))
                continue
            wait, dwell = rng.uniform(10, 60), rng.choice([0.0, 10.0])
            points.append(TimingPoint(at, window(time), window(time + wait), stands=True, dwell_s=dwell))
            waited += wait
        end = waited + run.trip_time_s
        timetable = Timetable((first, *points, TimingPoint(length, arrival=window(end))))
        levels = np.array([data.draw(st.sampled_from([0.0, 2e4, 3e5, 2e6])) - (drawn if k else 0.0)
                           for k in range(len(timetable.events))])
        *earlier, last = (-np.diff(np.append(levels, 0.0))).tolist()
        certificate = Certificate(positions, left, right, last + drawn, tuple(earlier), drawn)
        bound = lower_bound(vehicle, timetable.on(course), certificate, timetable)
        assert np.isfinite(bound)
        energy, tolerance = own_energy(vehicle, run)
        energy += vehicle.auxiliary_w * (end - clock)
        assert bound <= energy + tolerance + 1e-9 * float(np.abs(levels).sum() + drawn) * (200 + end)


@pytest.mark.parametrize("solver", ["socp", "nlp"])
def test_bound_plan_and_proof_hold_auxiliaries_between_the_ends(solver):
    """Against runs that are slower than the fastest one all along, with the shortest clock that the windows leave."""
    found = find_timed_reference(DRAWING, COURSE, STOP, solver=solver)
    require_kept(found, STOP)
    assert 0 <= found.gap <= 2e-3
    assert found.check.energy_j == pytest.approx(found.energy_j, rel=1e-4)
    kept = 0
    quick = least_time(DRAWING, STOP.on(COURSE))
    for one, two in product(np.linspace(0.35, 1.0, 6), np.linspace(0.18, 0.3, 7)):
        share = np.where(quick.position_m < MIDDLE_M, one, two)
        run = drivable(DRAWING, quick.course, share * quick.half_square)
        clock = schedule(STOP, leg_times(STOP, run), brief=True)
        if not isinstance(clock, Miss):
            own, tolerance = own_energy(DRAWING, run)
            assert found.lower_bound_j <= own + 2e5 * (clock[-1] - clock[0]) + tolerance
            kept += 1
    assert kept >= 5
    made = bound_document(DRAWING, COURSE, found, 0.0, 0.0)
    proven = float(checked_bound(made))
    assert proven == pytest.approx(found.lower_bound_j, rel=1e-6)
    assert proven <= found.lower_bound_j * (1 + 1e-12)


def test_a_time_of_its_own_for_both_ends_adds_what_auxiliaries_draw_in_it():
    """Where a run can be neither shorter nor longer, they are a constant, in the energy and in the bound."""
    ends = Timetable((TimingPoint(0.0, departure=Window(10.0, 10.0)),
                      TimingPoint(MIDDLE_M, Window(latest_s=10.0 + free_s() - 15)),
                      TimingPoint(END_M, arrival=Window(10.0 + TIME_S, 10.0 + TIME_S))))
    without, drawing = (find_timed_reference(vehicle, COURSE, ends) for vehicle in (TRAIN, DRAWING))
    constant = 2e5 * TIME_S
    assert drawing.energy_j - constant == pytest.approx(without.energy_j, rel=2e-4)
    assert drawing.lower_bound_j - constant == pytest.approx(without.lower_bound_j, rel=5e-4)
    assert drawing.lower_bound_j <= without.energy_j + constant


def test_a_departure_that_may_be_later_is_so_where_the_arrival_must_not_be_sooner():
    """The run would rather take less than the 740 s that the windows leave, which are 800 s from the first departure.

    In a time that is given a train with auxiliaries drives as one without.
    """
    ends = Timetable((TimingPoint(0.0, departure=Window(0.0, 60.0)), TimingPoint(END_M, arrival=Window(800.0, 900.0))))
    found = find_timed_reference(DRAWING, COURSE, ends)
    assert find_reference(DRAWING, COURSE, 900.0).profile.trip_time_s < 735
    apart = find_reference(TRAIN, COURSE, 740.0)
    assert found.energy_j == pytest.approx(apart.energy_j + 2e5 * 740, rel=2e-4)
    assert found.lower_bound_j <= apart.energy_j + 2e5 * 740
    assert found.gap <= 1e-3 and found.clock_s[0] == pytest.approx(60.0, abs=0.01)


def test_a_stop_with_a_late_departure_costs_what_two_separate_runs_cost():
    """To the stop there is time given anyway, so that auxiliaries change nothing; beyond it they shorten the run."""
    arrival, departure, end = 300.0, 400.0, 400.0 + 1.6 * least_time(TRAIN, COURSE.cut(MIDDLE_M, END_M)).trip_time_s
    timetable = Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)),
                           TimingPoint(MIDDLE_M, Window(latest_s=arrival), Window(departure), stands=True),
                           TimingPoint(END_M, arrival=Window(latest_s=end))))
    found = find_timed_reference(DRAWING, COURSE, timetable)
    first = find_reference(TRAIN, COURSE.cut(0.0, MIDDLE_M), arrival)
    second = find_reference(DRAWING, COURSE.cut(MIDDLE_M, END_M), end - departure)
    apart = first.energy_j + 2e5 * departure + second.energy_j
    assert found.energy_j == pytest.approx(apart, rel=1e-3)
    assert found.lower_bound_j <= apart and found.gap <= 1e-3
    assert found.lower_bound_j >= (first.lower_bound_j + 2e5 * departure + second.lower_bound_j) * (1 - 1e-3)


def test_what_auxiliaries_draw_at_stops_counts_in_a_trip_time_as_in_a_timetable():
    """The same trip asked in two ways: 60 s of waiting at a stop, within 900 s in all."""
    serving, waited = COURSE.split(np.array([MIDDLE_M])), 60.0
    serving = replace(serving, stops_m=(MIDDLE_M,))
    in_all = find_reference(DRAWING, serving, 900.0, waited_s=waited)
    stop = Timetable((TimingPoint(0.0, departure=Window(0.0, 0.0)),
                      TimingPoint(MIDDLE_M, stands=True, dwell_s=waited),
                      TimingPoint(END_M, arrival=Window(latest_s=900.0))))
    timed = find_timed_reference(DRAWING, serving, stop)
    assert in_all.energy_j == pytest.approx(timed.energy_j, rel=1e-3)
    assert in_all.lower_bound_j == pytest.approx(timed.lower_bound_j, rel=1e-3)
    assert in_all.check.energy_j == pytest.approx(in_all.energy_j, rel=1e-4)
    assert in_all.waits_j == 2e5 * waited
    # The certificate is of the time without stops.
    proven = bound_document(DRAWING, serving, in_all, 0.0, 0.0)["lower_bound_J"]
    assert proven + in_all.waits_j == pytest.approx(in_all.lower_bound_j, rel=1e-9)
    with pytest.raises(InputError, match=r"50 s is no more than the 60 s of waiting at stops.* trip time is \d+"):
        find_reference(DRAWING, serving, 50.0, waited_s=waited)
    with pytest.raises(WorkbenchError, match=r"^100 s is too short: with 60 s of waiting.* 40 s is too") as said:
        find_reference(DRAWING, serving, 100.0, waited_s=waited)
    least, alone = map(float, re.findall(r"least feasible trip time is ([\d.]+) s", str(said.value)))
    assert least == pytest.approx(alone + waited)


def test_a_tampered_count_of_auxiliaries_is_refused():
    found = find_timed_reference(DRAWING, COURSE, by(Window(latest_s=free_s() - 20)), intervals=40)
    made = bound_document(DRAWING, COURSE, found, 0.0, 0.0)
    for drawn, message in ((2e5 - 1, "it proves"), (0.0, "it proves"), (-1.0, "less than nothing")):
        other = copy.deepcopy(made)
        other["auxiliary_w"] = drawn
        with pytest.raises(ValueError, match=message):
            proven_bound(other)
    with pytest.raises(WorkbenchError, match="more than the train's 0 W"):
        lower_bound(TRAIN, found.timetable.on(COURSE), found.certificate, found.timetable)


def test_a_train_without_auxiliaries_counts_none():
    found = find_timed_reference(TRAIN, COURSE, by(Window(latest_s=free_s() - 20)), intervals=40)
    made = bound_document(TRAIN, COURSE, found, 0.0, 0.0)
    assert made.pop("auxiliary_w") == found.certificate.auxiliary_w == 0.0
    assert float(checked_bound(made)) == pytest.approx(made["lower_bound_J"], rel=1e-12)


@st.composite
def timetables(draw):
    """Chains of windows some of which are open on a side; the middle ones pass or stop."""
    def side(sign):
        return draw(st.sampled_from([sign * math.inf, None]))

    points, clock = [TimingPoint(0.0, departure=Window(0.0, draw(st.sampled_from([0.0, 30.0, math.inf]))))], 0.0
    for k in range(draw(st.integers(0, 3))):
        clock += 100.0
        windows = [Window(*(base if one is None else one for base, one in (
            (clock + shift, side(-1)), (clock + shift + draw(numbers(0.0, 40.0)), side(1))))) for shift in (0.0, 20.0)]
        stands = draw(st.booleans())
        points.append(TimingPoint(1000.0 * (k + 1), windows[0], windows[1] if stands else Window(), stands,
                                  10.0 if stands else 0.0))
    earliest = draw(st.sampled_from([-math.inf, clock + 90.0]))
    return Timetable((*points, TimingPoint(9000.0, arrival=Window(earliest, clock + 150.0))))


@given(timetables(), st.data(), st.sampled_from([0.0, 5e4, 12345.678]))
def test_fair_prices_always_prove_something(timetable, data, auxiliary_w):
    """Whatever a solver's noise does to prices that have a limit on their side."""
    drawn, prices = counted(auxiliary_w), []
    for event in timetable.events:
        sides = [0.0] + [1.0] * math.isfinite(event.window.latest_s) + [-1.0] * math.isfinite(event.window.earliest_s)
        prices.append(data.draw(st.sampled_from(sides)) * data.draw(st.sampled_from([1e-9, 1e-3, 1.0, 3e4, 2e5])))
    fair = timetable.fair(np.array(prices), drawn)
    assert np.isfinite(timetable.time_part_j(fair, drawn))
    assert np.all(timetable.levels(fair, drawn) >= 0)
    if np.all(timetable.levels(np.array(prices), drawn) >= 0):
        np.testing.assert_allclose(fair, prices, atol=1e-5)


@given(timetables(), st.data())
def test_a_brief_schedule_is_the_shortest_from_end_to_end(timetable, data):
    """Against a linear program over the times of all events."""
    legs = np.array([data.draw(numbers(60.0, 110.0)) for _ in timetable.points[1:]])
    clock = schedule(timetable, legs, brief=True)
    rows, limits, equal, values = [], [], [], []
    count = len(timetable.events)
    for k, event in enumerate(timetable.events[1:], start=1):
        row = np.zeros(count)
        row[[k - 1, k]] = (1.0, -1.0) if event.waits else (-1.0, 1.0)
        (rows if event.waits else equal).append(row)
        (limits if event.waits else values).append(-event.dwell_s if event.waits else legs[event.point - 1])
    cost = np.zeros(count)
    cost[[0, -1]] = -1.0, 1.0
    best = linprog(cost, np.array(rows) if rows else None, limits or None, np.array(equal), values,
                   [(event.window.earliest_s, event.window.latest_s) for event in timetable.events])
    assert isinstance(clock, Miss) == (best.status == 2)
    if not isinstance(clock, Miss):
        assert clock[-1] - clock[0] == pytest.approx(best.fun, abs=1e-6)
        for time, event in zip(clock, timetable.events, strict=True):
            assert event.window.earliest_s - TOUCH_S <= time <= event.window.latest_s + TOUCH_S
