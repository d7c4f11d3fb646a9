"""Smooth references: continuous acceleration, the run's distance and time, and what leaves the program."""

import csv
import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.errors import InputError
from workbench.optimal import planning, smooth
from workbench.optimal.bound import lower_bound
from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.export import COLUMNS, samples, time_response, write_csv
from workbench.optimal.grid import Grid
from workbench.optimal.profile import Profile
from workbench.optimal.reference import find_reference
from workbench.optimal.smooth import smooth_reference, smoothed
from workbench.optimal.smooth_run import SmoothRun
from workbench.optimal.socp import Plan, solve_socp
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("test", 2e5, (3e3, 20.0, 8.0), ForceLimit(2e5, 2e6), ForceLimit(1.5e5, 2e6), 1e5,
                traction_efficiency=0.85, regenerative_efficiency=0.6, max_speed_mps=40.0)


def course(length_m: float = 12_000.0, limits: tuple[float, ...] = (30.0, 20.0, 35.0),
           stops: tuple[float, ...] = ()) -> Course:
    borders = np.unique(np.concatenate((np.linspace(0.0, length_m, len(limits) + 1), stops)))
    middle = (borders[1:] + borders[:-1]) / 2
    limit = np.array(limits)[np.minimum((middle / length_m * len(limits)).astype(int), len(limits) - 1)]
    n = len(limit)
    slope = np.where(np.arange(n) % 2 == 0, 1.0, -1.0)[:, None] * np.full((n, 2), 4e3)
    return Course(borders, limit, slope, np.zeros((n, 2)), stops)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(1.0, 900.0), min_size=1, max_size=12), st.floats(0.05, 30.0), st.data())
def test_the_moving_average_is_that_of_the_run_and_keeps_its_ends(
        speeds: list[float], window_s: float, data: st.DataObject) -> None:
    b = np.array([data.draw(st.sampled_from((0.0, 5.0))), *speeds, 0.0]) / 2
    x = np.linspace(0.0, 5_000.0, len(b))
    n = len(b) - 1
    profile = Profile(Course(x, np.full(n, 100.0), np.zeros((n, 2)), np.zeros((n, 2))), b)
    run = smoothed(profile, window_s)
    assert run.trip_time_s == pytest.approx(profile.trip_time_s + window_s)
    start = profile.speed_mps[0] * window_s / 2
    s, v, _ = run.at(np.array([0.0, run.trip_time_s]))
    assert s == pytest.approx([-start, 5_000.0], abs=1e-6)
    assert v == pytest.approx([profile.speed_mps[0], 0.0], abs=1e-8)
    # The mean of the speed over a window, by sums over a fine grid.
    times, speed = profile.time_s, profile.speed_mps
    for t in np.linspace(window_s, run.trip_time_s - window_s, 7) if run.trip_time_s > 3 * window_s else ():
        fine = np.linspace(t - window_s, t, 20_001)
        wanted = np.interp((fine[1:] + fine[:-1]) / 2, times, speed).mean()
        assert run.at(np.array([t]))[1][0] == pytest.approx(wanted, rel=1e-6, abs=1e-6)


def jumps(run: SmoothRun) -> float:
    """The largest jump of position, speed or acceleration at a break."""
    ends = np.diff(run.breaks_s)
    a_end = run.acceleration_mps2 + run.jerk_mps3 * ends
    v_end = run.speed_mps + ends * (run.acceleration_mps2 + ends * run.jerk_mps3 / 2)
    return max(float(np.abs(a_end[:-1] - run.acceleration_mps2[1:]).max()),
               float(np.abs(v_end[:-1] - run.speed_mps[1:]).max()))


@pytest.mark.parametrize("stops", [(), (4_000.0, 7_500.0)])
def test_a_smooth_reference_arrives_in_time_and_keeps_limits(stops: tuple[float, ...]) -> None:
    run = course(stops=stops)
    found = smooth_reference(TRAIN, run, 700.0 + 30 * len(stops), dwell_s=30.0)
    assert found.run.trip_time_s <= 700.0 + 30 * len(stops)
    assert jumps(found.run) < 1e-9
    assert found.speed_excess_mps < 1e-6
    # Where the slope jumps under a point mass, the smooth run asks for half the jump on top of full traction.
    assert found.force_excess < 0.05
    curve = found.run.desired_curve()
    assert curve.length_m == pytest.approx(run.length_m, abs=1e-6)
    s, v, _ = found.run.at(np.linspace(0.0, found.run.trip_time_s, 20_000))
    for stop in stops:
        standing = s[v < 1e-9]
        assert np.any(np.abs(standing - stop) < 1e-6), "the train must stand at each stop"
    assert np.all(np.diff(s) >= -1e-9)


def test_smoothing_costs_energy_and_more_of_it_the_longer_the_window() -> None:
    energies = [smooth_reference(TRAIN, course(), 600.0, window).energy_j for window in (0.5, 2.0, 8.0)]
    assert all(one < two for one, two in pairwise(energies))


def test_what_smoothing_keeps_back_is_driven_by_the_plan_at_hand(monkeypatch: pytest.MonkeyPatch) -> None:
    solved: list[int] = []

    def counted(vehicle: Vehicle, grid: Grid, *rest: Any, **more: Any) -> Plan:
        solved.append(len(grid.limit_mps))
        return solve_socp(vehicle, grid, *rest, **more)

    monkeypatch.setattr(planning, "solve_socp", counted)
    monkeypatch.setattr(smooth, "MANY_INTERVALS", 0)
    run = course(limits=(30.0, 20.0, 35.0, 25.0))
    found = smooth_reference(TRAIN, run, 520.0, intervals=400)
    assert found.usable[0] < 1 and found.force_excess == 0.0, "the test needs forces to be kept back"
    # Beside the first plan at most what a run that is late asks for, on the same mesh.
    assert len(solved) <= planning.PLANS and len(set(solved)) == 1
    # The bound is that of the whole forces, and what proves it proves it of this course.
    optimal = found.optimal
    assert lower_bound(TRAIN, optimal.profile.course, optimal.certificate, optimal.timetable) == pytest.approx(
        optimal.lower_bound_j, rel=1e-9)
    assert 0 <= optimal.gap < 5e-3
    # A reference of another course, or of another time, lends its mesh at most: what is proven is of what is asked.
    steeper = replace(run, force_n=1.5 * run.force_n)
    for other, time_s in ((steeper, 520.0), (run, 600.0)):
        alone = find_reference(TRAIN, other, time_s)
        begun = find_reference(TRAIN, other, time_s, like=find_reference(TRAIN, run, 520.0))
        assert begun.lower_bound_j <= alone.energy_j and alone.lower_bound_j <= begun.energy_j and begun.gap < 1e-3


@pytest.mark.parametrize("jerk", [1.0, 0.3, 0.1])
def test_a_limit_of_the_jerk_is_kept(jerk: float) -> None:
    found = smooth_reference(TRAIN, course(), 700.0, max_jerk_mps3=jerk)
    fine = np.linspace(0.0, found.run.trip_time_s, 200_001)
    measured = np.abs(np.diff(found.run.at(fine)[2]) / np.diff(fine)).max()
    assert measured <= jerk * (1 + 1e-6)
    assert found.max_jerk_mps3 <= jerk


def test_a_run_may_begin_and_end_at_a_speed() -> None:
    found = smooth_reference(TRAIN, course(), 600.0, 2.0, start_mps=15.0, end_mps=10.0)
    s, v, _ = found.run.at(np.array([0.0, found.run.trip_time_s]))
    assert s == pytest.approx([0.0, 12_000.0], abs=1e-6)
    assert v == pytest.approx([15.0, 10.0], abs=1e-8)


def test_requests_that_leave_no_run_are_refused() -> None:
    with pytest.raises(InfeasibleRunError, match="least feasible trip time is"):
        smooth_reference(TRAIN, course(), 200.0)
    with pytest.raises(InfeasibleRunError, match="leave nothing of"):
        smooth_reference(TRAIN, course(stops=(4_000.0,)), 20.0, dwell_s=30.0)
    with pytest.raises(InputError, match="must be positive"):
        smooth_reference(TRAIN, course(), 700.0, 0.0)


@pytest.mark.parametrize(("stops", "dwell_s"), [((), 0.0), ((4_000.0,), 30.0)])
def test_a_time_that_is_too_short_is_told_the_least_one(stops: tuple[float, ...], dwell_s: float) -> None:
    with pytest.raises(InfeasibleRunError, match="it takes") as said:
        smooth_reference(TRAIN, course(stops=stops), 300.0, 2.0, dwell_s=dwell_s)
    least_s = said.value.least_time_s
    assert least_s is not None and f"it takes {least_s:.1f} s at least, {2.0 + dwell_s:g} s of them" in str(said.value)
    found = smooth_reference(TRAIN, course(stops=stops), least_s + 1.0, 2.0, dwell_s=dwell_s)
    assert found.run.trip_time_s <= least_s + 1.0
    with pytest.raises(InfeasibleRunError):
        smooth_reference(TRAIN, course(stops=stops), least_s - 1.0, 2.0, dwell_s=dwell_s)


def test_samples_are_the_motion_of_the_train_under_their_force(tmp_path: Path) -> None:
    run = course()
    found = smooth_reference(TRAIN, run, 700.0)
    rows = samples(TRAIN, run, found.run, 0.05)
    t, _, v, a, u = rows.T
    assert t[0] == 0 and t[-1] == found.run.trip_time_s
    # Work of the force = kinetic energy + resistance + slope, each by sums over the samples.
    work = np.trapezoid(u * v, t)
    resisted = np.trapezoid((3e3 + 20.0 * v + 8.0 * v**2) * v, t)
    climbed = sum((-1) ** k * 4e3 * 4_000.0 for k in range(3))
    assert work == pytest.approx(resisted + climbed, rel=1e-3)
    assert np.gradient(v, t)[5:-5] == pytest.approx(a[5:-5], abs=0.06)
    write_csv(tmp_path / "r.csv", rows)
    with (tmp_path / "r.csv").open(encoding="utf-8") as file:
        read = list(csv.reader(file))
    assert tuple(read[0]) == COLUMNS
    assert np.array(read[1:], dtype=float) == pytest.approx(rows, rel=1e-8, abs=1e-8)
    response = time_response(rows)
    assert isinstance(response, control.TimeResponseData)
    assert response.outputs[1] == pytest.approx(v)
    assert response.inputs[0] == pytest.approx(u)


@pytest.mark.parametrize("every", [0.0, -1.0, float("nan"), 1e-9])
def test_a_step_that_is_none_is_refused(every: float) -> None:
    found = smooth_reference(TRAIN, course(), 700.0)
    with pytest.raises(InputError, match="choose another step"):
        samples(TRAIN, course(), found.run, every)


def test_documents_hold_no_nan() -> None:
    from workbench.optimal.export import reference_document

    found = smooth_reference(TRAIN, course(), 700.0)
    document = reference_document(found.optimal, found)
    text = json.dumps(document, allow_nan=False)
    assert {"version", "energy_J", "lower_bound_J", "gap", "trip_time_s", "solver", "solve_s",
            "status"} <= json.loads(text).keys()
    assert document["lower_bound_J"] <= document["energy_J"]
