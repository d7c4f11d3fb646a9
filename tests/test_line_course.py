"""A line averaged over a train, against plain numeric averages and what must be conserved."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from workbench.errors import InputError
from workbench.optimal.inputs.line import RULES, Line, Tunnel, course
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("train", 2e5, (2000.0, 30.0, 5.0), ForceLimit(2e5), friction_brake_n=2e5, length_m=150.0,
                rotating_fraction=0.1, max_speed_mps=40.0, tunnel_drag=((24.0, 8.0), (40.0, 4.0)))
POINT = replace(TRAIN, length_m=0.0)
WEIGHT_KN = 2e5 * 9.80665 / 1000
INF = math.inf


def line(length_m: float = 3000.0, **values: object) -> Line:
    return Line("line", length_m, **({"stops_m": (0.0, length_m), "limits": ((0.0, 30.0),)} | values))


def at(found, position: float, what: str = "force_n") -> float:
    """The course's value at a position inside a section."""
    k = np.searchsorted(found.position_m, position, side="right") - 1
    share = (position - found.position_m[k]) / np.diff(found.position_m)[k]
    low, high = getattr(found, what)[k]
    return low + share * (high - low)


def per_kilonewton(rule: str, curvature):
    """Resistance of curves in N/kN, typed from the handbook a second time."""
    with np.errstate(divide="ignore"):  # where the line is straight, or by the formula of other radii
        radius = 1 / np.abs(curvature)
        return 600 / radius if rule == "inverse_radius" else np.where(
            radius >= 300, 650 / (radius - 55), 500 / (radius - 30))


def plain_force(given_line: Line, places):
    """Force in N on a point of the train's weight at each place, searched in the line's rows."""
    x, grade, curve, inside = np.maximum(places, 0.0), 0.0, 0.0, 0.0
    for start, here in given_line.grades:
        grade = np.where(start <= x, here, grade)
    rows = [*given_line.curves, (given_line.length_m, 0.0, 0.0)]
    for (start, one, two), (end, *_) in pairwise(rows):
        curvature = one + (x - start) / (end - start) * (two - one)
        curve = np.where((start <= x) & (x < end), per_kilonewton(given_line.curve_rule, curvature), curve)
    for t in given_line.tunnels:
        inside += np.where((t.start_m <= places) & (places < t.start_m + t.length_m), t.resistance_n_per_kn, 0.0)
    return WEIGHT_KN * (grade + curve + inside)


def plain_mean(given_line: Line, front: float, length: float, points: int = 20_000) -> float:
    places = front - length + (np.arange(points) + 0.5) * length / points
    return float(np.mean(plain_force(given_line, places)))


HILLS = ((0.0, 2.0), (400.0, -7.0), (450.0, 12.0), (1800.0, 0.0))
BENDS = ((0.0, 1 / 500, 1 / 500), (200.0, 1 / 500, -1 / 250), (350.0, -1 / 250, -1 / 250), (700.0, -1 / 250, 0.0),
         (900.0, 0.0, 0.0), (1000.0, 1 / 900, 1 / 900), (1600.0, 0.0, 0.0))


def test_a_point_meets_the_jumps_where_they_are():
    found = course(line(grades=HILLS), POINT)
    assert found.position_m.tolist() == [0.0, 400.0, 450.0, 1800.0, 3000.0]
    expected = np.array([2.0, -7.0, 12.0, 0.0]) * WEIGHT_KN
    assert found.force_n == pytest.approx(np.stack((expected, expected), axis=1), rel=1e-14)
    assert found.limit_mps.tolist() == [30.0] * 4
    assert not found.drag.any()


@pytest.mark.parametrize("front", [10.0, 170.0, 420.0, 449.0, 520.0, 599.0, 640.0, 1900.0, 1960.0, 2999.0])
def test_a_train_on_hills_meets_the_mean_over_its_length(front):
    found = course(line(grades=HILLS), TRAIN)
    # The grid of the plain mean misses a jump by half a step of the grid at most.
    assert at(found, front) == pytest.approx(plain_mean(line(grades=HILLS), front, 150.0), abs=WEIGHT_KN * 19 / 2e4)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("length", [0.0, 30.0, 150.0, 400.0])
def test_clothoids_are_followed_within_the_stated_tolerance(rule, length):
    bent = line(curves=BENDS, curve_rule=rule)
    found = course(bent, replace(TRAIN, length_m=length))
    fronts = np.random.default_rng(7).uniform(0.0, 3000.0, 120)
    fronts = fronts[np.min(np.abs(fronts[:, None] - found.position_m), axis=1) > 1e-6]
    assert len(found.limit_mps) < 150
    largest = np.max(found.force_n)
    points = 4000
    rounding = 3 * largest / points if length else 1e-9
    for front in fronts:
        expected = plain_mean(bent, front, length, points) if length else plain_force(bent, front)
        assert at(found, front) == pytest.approx(expected, abs=1e-3 * largest + rounding)


@pytest.mark.parametrize("front", [0.0, 20.0, 60.0, 149.0, 151.0, 400.0])
def test_behind_the_start_the_first_curvature_holds(front):
    eased = line(curves=((0.0, 1 / 400, 1 / 1000), (500.0, 1 / 1000, 1 / 1000)), curve_rule="inverse_radius")
    assert at(course(eased, TRAIN), front) == pytest.approx(plain_mean(eased, front, 150.0), rel=1e-3)


def test_the_magnitude_of_a_curvature_that_changes_sign_resists():
    s_bend = line(curves=((0.0, 0.0, 0.0), (1000.0, 1 / 400, -1 / 400), (1400.0, 0.0, 0.0)))
    found = course(s_bend, POINT)
    assert at(found, 1200.0) == pytest.approx(0.0, abs=1e-3)  # of 3 kN at its ends
    for offset in (20.0, 100.0, 150.0):
        assert at(found, 1200.0 - offset) == pytest.approx(at(found, 1200.0 + offset), rel=1e-9)
    mirrored = replace(s_bend, curves=tuple((x, -a, -b) for x, a, b in s_bend.curves))
    assert course(mirrored, POINT).force_n == pytest.approx(found.force_n, rel=1e-12)


def test_roeckls_formula_jumps_at_300_metres_and_so_does_the_course():
    found = course(line(curves=((0.0, 1 / 600, 1 / 200), (1000.0, 0.0, 0.0))), POINT)
    k = int(np.argmin(np.abs(found.position_m - 500.0)))
    assert found.position_m[k] == pytest.approx(500.0, abs=1e-9)
    assert found.force_n[k - 1, 1] == pytest.approx(WEIGHT_KN * 650 / 245, rel=1e-6)
    assert found.force_n[k, 0] == pytest.approx(WEIGHT_KN * 500 / 270, rel=1e-6)


@pytest.mark.parametrize("radius", [50.0, 52.0, 299.0, 300.0, 1000.0, INF])
@pytest.mark.parametrize("rule", RULES)
def test_constant_curves_resist_by_their_formula(rule, radius):
    found = course(line(curves=((0.0, -1 / radius, -1 / radius),), curve_rule=rule), TRAIN)
    assert len(found.limit_mps) == 1
    expected = WEIGHT_KN * per_kilonewton(rule, 1 / radius)
    assert found.force_n == pytest.approx(np.full((1, 2), expected), rel=1e-12)


@given(st.lists(st.tuples(st.integers(1, 1999), st.integers(-40, 40)), max_size=8, unique_by=lambda row: row[0]),
       st.sampled_from([0.0, 1.0, 58.6, 150.0, 700.0]))
def test_the_hills_cost_a_long_train_what_they_cost_a_point(rows, length):
    # Level margins longer than the train at both ends: rear and front cross every hill.
    grades = ((0.0, 0.0), *((1000.0 + x, float(g)) for x, g in sorted(rows)), (3000.0, 0.0))
    work = [np.sum(found.force_n.mean(axis=1) * np.diff(found.position_m)) for found in (
        course(line(4000.0, grades=grades), replace(TRAIN, length_m=shape)) for shape in (0.0, length))]
    lifted = sum((b[0] - a[0]) * a[1] / 1000 for a, b in pairwise(grades))
    scale = WEIGHT_KN * 40 * 2000
    assert work[1] == pytest.approx(work[0], abs=1e-9 * scale)
    assert work[0] == pytest.approx(2e5 * 9.80665 * lifted, abs=1e-9 * scale)


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(1, 2999), st.integers(5, 60)), max_size=8, unique_by=lambda row: row[0]),
       st.sampled_from([0.0, 1.0, 150.5, 2000.5]), st.integers(10, 50))
def test_the_limit_is_the_least_over_the_train_and_its_own(rows, length, own):
    limits = ((0.0, 25.0), *((float(x), float(v)) for x, v in sorted(rows)))
    found = course(line(limits=limits), replace(TRAIN, length_m=length, max_speed_mps=float(own)))
    for front in np.arange(0.25, 3000.0, 13.0):
        under = [v for (x, v), (end, _) in zip(limits, [*limits[1:], (INF, 0.0)], strict=True)
                 if x <= front and end > max(front - length, 0.0)]
        k = np.searchsorted(found.position_m, front, side="right") - 1
        assert found.limit_mps[k] == min(own, *under)


def test_tunnel_drag_grows_with_the_share_of_the_train_inside():
    holed = line(tunnels=(Tunnel(1000.0, 400.0, 40.0), Tunnel(2000.0, 50.0, 30.0)))
    found = course(holed, TRAIN)
    for front, expected in ((999.0, 0.0), (1075.0, 2.0), (1200.0, 4.0), (1475.0, 2.0), (1550.5, 0.0)):
        assert at(found, front, "drag") == pytest.approx(expected, abs=1e-9)
    # A third of the train is in the second one; 30 m^2 lies halfway between 24 and 40 m^2 by 1/area.
    assert at(found, 2100.0, "drag") == pytest.approx(6.0 / 3, rel=1e-12)
    assert not course(holed, replace(TRAIN, tunnel_drag=())).drag.any()


@pytest.mark.parametrize(("area", "expected"), [(24.0, 8.0), (10.0, 8.0), (40.0, 4.0), (100.0, 4.0), (30.0, 6.0)])
def test_tunnel_drag_of_an_area_that_is_not_listed(area, expected):
    found = course(line(tunnels=(Tunnel(500.0, 1000.0, area),)), POINT)
    assert at(found, 700.0, "drag") == pytest.approx(expected, rel=1e-12)


def test_a_tunnel_with_a_stated_resistance_is_a_force():
    found = course(line(tunnels=(Tunnel(500.0, 1000.0, None, 1.5),)), TRAIN)
    assert not found.drag.any()
    assert at(found, 575.0) == pytest.approx(WEIGHT_KN * 0.75, rel=1e-12)
    assert at(found, 900.0) == pytest.approx(WEIGHT_KN * 1.5, rel=1e-12)


def test_rotating_mass_weighs_nothing_and_equal_neighbours_are_one():
    grades = ((0.0, 5.0), (700.0, 5.0), (1500.0, 5.0))
    limits = ((0.0, 30.0), (200.0, 30.0), (900.0, 50.0))  # the train's own 40 m/s is less than the last
    found = course(line(grades=grades, limits=limits), TRAIN)
    assert found.position_m.tolist() == [0.0, 1050.0, 3000.0]
    assert found.force_n == pytest.approx(np.full((2, 2), 5 * WEIGHT_KN), rel=1e-14)
    assert found.limit_mps.tolist() == [30.0, 40.0]


def test_a_part_of_a_line_with_stops():
    whole = line(grades=HILLS, stops_m=(0.0, 500.0, 1200.0, 3000.0))
    part = course(whole, TRAIN, 500.0, 3000.0, whole.stops_between(500.0, 3000.0))
    assert (part.position_m[0], part.position_m[-1], part.stops_m) == (500.0, 3000.0, (1200.0,))
    full = course(whole, TRAIN)
    # The rear stands on what lies behind the start, so that the part meets what the whole does.
    for front in (501.0, 555.0, 1199.0, 1201.0, 1900.0):
        assert at(part, front) == pytest.approx(at(full, front), rel=1e-12, abs=1e-6)


@pytest.mark.parametrize(("ends", "stops", "words"), [
    ((-1.0, 3000.0), (), "choose other ends"), ((0.0, 3001.0), (), "choose other ends"),
    ((500.0, 500.0), (), "choose other ends"), ((800.0, 100.0), (), "choose other ends"),
    ((math.nan, 100.0), (), "choose other ends"), ((0.0, 3000.0), (0.0,), "apart"), ((0.0, 3000.0), (3000.0,), "apart"),
    ((0.0, 3000.0), (700.0, 700.0), "apart"), ((0.0, 1000.0), (2000.0,), "apart"),
    ((0.0, 1000.0), (math.nan,), "apart"),
])
def test_what_is_no_run_is_refused(ends, stops, words):
    with pytest.raises(InputError, match=words):
        course(line(), TRAIN, *ends, stops)


def test_no_limit_at_all_is_refused():
    with pytest.raises(InputError, match="highest speed"):
        course(line(limits=((0.0, INF),)), replace(TRAIN, max_speed_mps=INF))


@pytest.mark.parametrize(("values", "words"), [
    ({"stops_m": (0.0, 2000.0)}, "last stop"), ({"stops_m": (10.0, 3000.0)}, "first stop"),
    ({"stops_m": (0.0, 700.0, 600.0, 3000.0)}, "sort"), ({"stops_m": (3000.0,)}, "1 given"),
    ({"stops_m": (0.0, math.nan, 3000.0)}, "sort"), ({"limits": ()}, "none given"),
    ({"limits": ((5.0, 20.0),)}, "from 0 on"), ({"limits": ((0.0, 20.0), (0.0, 30.0))}, "name each once"),
    ({"limits": ((0.0, 0.0),)}, "no speed limit"), ({"limits": ((0.0, math.nan),)}, "no speed limit"),
    ({"grades": ((0.0, 0.0), (3000.0, 1.0))}, "beyond the line"), ({"grades": ((0.0, 250.0),)}, "per mille"),
    ({"curves": ((0.0, 0.03, 0.0),)}, "sharper than R = 50 m"), ({"curves": ((0.0, math.nan, 0.0),)}, "sharper"),
    ({"tunnels": (Tunnel(2900.0, 200.0, 30.0),)}, "within the line"),
    ({"tunnels": (Tunnel(100.0, 200.0, 30.0), Tunnel(200.0, 10.0, 30.0))}, "not overlap"),
    ({"tunnels": (Tunnel(100.0, 200.0, 0.0),)}, "cross section"),
    ({"tunnels": (Tunnel(100.0, 200.0, None, -1.0),)}, "resistance"),
])
def test_what_is_no_line_is_refused(values, words):
    with pytest.raises(InputError, match=words):
        line(**values)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.floats(1, 2999), st.floats(-0.02, 0.02), st.floats(-0.02, 0.02)), max_size=6,
                unique_by=lambda row: row[0]), st.floats(1, 900), st.sampled_from(sorted(RULES)))
def test_any_curves_and_any_length_make_a_course(rows, length, rule):
    curves = ((0.0, 0.0, 0.0), *sorted(rows))
    assume(all(b[0] > a[0] for a, b in pairwise(curves)))
    found = course(line(curves=curves, curve_rule=rule), replace(TRAIN, length_m=length))
    highest = WEIGHT_KN * max(per_kilonewton(rule, k) for k in (0.02, 1 / 300))
    assert np.all((found.force_n >= -1e-9 * highest) & (found.force_n <= highest * (1 + 1e-9)))
    assert np.all(np.diff(found.position_m) > 0)
