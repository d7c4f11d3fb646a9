"""The line: the resistance it causes, against values computed by hand from Table 1 of yang2021."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenarios import BENCHMARKS, SHORT_LINE, YANG, name_of, short_scenario

from workbench.trains.line_resistance import (
    additional_specific_resistance,
    curvature_per_m,
    grade_permille,
    tunnel_n_per_kn,
)
from workbench.trains.scenario import load_scenario
from workbench.trains.track import ResistanceTable, Track, over_length, resistance_table

# Table 1 of yang2021, typed from the paper a second time: start (m), end (m), value.
TABLE_1_SLOPE = ((0, 3800, "2"), (3800, 9200, "-1.5"), (9200, 21400, "0"), (21400, 23900, "5"),
                 (23900, 29900, "2.5"), (29900, 32300, "-3"), (32300, 50000, "0"), (50000, 53880, "1.2"))
TABLE_1_CURVE = ((0, 4600, 1000), (4600, 18000, 1200), (18000, 24200, 800), (24200, 29300, 1500),
                 (29300, 34000, 700), (34000, 48000, 1300), (48000, 53880, 1200))
GRAVITY = Fraction(980665, 100000)


def table_1_at(position_m: float) -> float:
    """Grade plus 600/R, in N per kN, times the standard gravity: N per kg, in exact fractions."""
    slope = next(Fraction(value) for start, end, value in TABLE_1_SLOPE if start <= position_m < end)
    radius = next(value for start, end, value in TABLE_1_CURVE if start <= position_m < end)
    return float((slope + Fraction(600, radius)) * GRAVITY / 1000)


def test_resistance_of_table_1_is_the_one_computed_by_hand():
    table = resistance_table(load_scenario(YANG).track)
    positions = np.arange(0.0, 53880.0, 10.0)
    by_hand = np.array([table_1_at(x) for x in positions])
    assert table.at(positions) == pytest.approx(by_hand, rel=1e-14, abs=1e-18)


@pytest.mark.parametrize(("position_m", "newton_per_kilonewton"), [
    (100.0, 2.0 + 0.6),          # 2 per mille, R = 1000 m
    (4000.0, -1.5 + 0.6),        # downhill, R = 1000 m
    (10000.0, 0.5),              # level, R = 1200 m
    (22000.0, 5.0 + 0.75),       # the steepest grade, R = 800 m
    (30000.0, -3.0 + 600 / 700),  # the sharpest curve
    (53879.0, 1.2 + 0.5),        # the last metre
])
def test_resistance_at_single_places(position_m, newton_per_kilonewton):
    table = resistance_table(load_scenario(YANG).track)
    assert table.at(np.array([position_m]))[0] == pytest.approx(newton_per_kilonewton * 9.80665e-3, rel=1e-14)


@pytest.mark.parametrize(("values", "newton_per_kilonewton"), [
    ((1, 0, 0), 1),              # 1 per mille of grade lifts 1 N per kN
    ((0, Fraction(1, 600), 0), 1),  # 600/R with R = 600 m
    ((0, Fraction(1, 300), 0), 2),
    ((0, 0, 3), 3),
    ((-2, Fraction(1, 300), 5), 5),
])
def test_each_cause_of_resistance_is_added(values, newton_per_kilonewton):
    expression = additional_specific_resistance()
    symbols = (grade_permille, curvature_per_m, tunnel_n_per_kn)
    exact = expression.subs(dict(zip(symbols, values, strict=True)))
    assert exact == GRAVITY * newton_per_kilonewton / 1000


def test_a_grade_resists_with_the_weight_it_lifts():
    # Energy, not the table's rule: 1000 m up a grade of 5 per mille lift every kilogram by 5 m.
    straight = {curvature_per_m: 0, tunnel_n_per_kn: 0}
    lifted = additional_specific_resistance().subs({grade_permille: 5} | straight)
    assert float(lifted) * 1000 == pytest.approx(9.80665 * 5, rel=1e-15)


def test_straight_track_and_tunnels():
    table = resistance_table(short_scenario().track)
    gravity = 9.80665e-3
    here = dict(zip((0.5, 200.0, 350.0, 450.0, 550.0, 600.0), (
        2.0, -3.0, -3.0 + 1.5, 4.0 + 1.5, 4.0 + 1.5 + 1.5, 4.0 + 1.5), strict=True))
    found = table.at(np.array(list(here)))
    assert found == pytest.approx(gravity * np.array(list(here.values())), rel=1e-13)


def test_a_value_holds_from_its_border_on_and_beyond_the_ends():
    table = resistance_table(short_scenario().track)
    before, after, at = table.at(np.array([np.nextafter(1.0, 0.0), np.nextafter(1.0, 2.0), 1.0]))
    assert before > after
    assert at == after
    low, first, last, high = table.at(np.array([-5.0, 0.0, 899.0, 2000.0]))
    assert (low, high) == (first, last)


@pytest.mark.parametrize("path", BENCHMARKS, ids=name_of)
def test_every_shipped_line_has_a_finite_plausible_resistance_everywhere(path):
    track = load_scenario(path).track
    table = resistance_table(track)
    assert table.position_m[0] == 0.0
    assert np.all(np.diff(table.position_m) > 0)
    assert table.position_m[-1] < track.length_m
    # 100 per mille, R = 50 m and their sum are the steepest and sharpest that validation lets through.
    assert np.all(np.abs(table.specific_force) < 2.0)


def _cut(edges: list[float]) -> list[tuple[float, float]]:
    return list(pairwise(edges))


@given(st.lists(st.integers(1, 999), unique=True, max_size=8), st.lists(st.integers(1, 999), unique=True,
                                                                        max_size=8), st.data())
def test_table_equals_a_search_of_the_sections(grade_cuts, curve_cuts, data):
    grades = [(a, b, data.draw(st.integers(-40, 40))) for a, b in _cut([0, *sorted(grade_cuts), 1000])]
    curves = [(a, b, data.draw(st.integers(50, 5000))) for a, b in _cut([0, *sorted(curve_cuts), 1000])]
    track = Track.model_validate(SHORT_LINE | {
        "length_m": 1000.0, "tunnel": [],
        "grade": [{"start_m": a, "end_m": b, "grade_permille": g} for a, b, g in grades],
        "curve": [{"start_m": a, "end_m": b, "radius_m": r} for a, b, r in curves],
        "source": dict.fromkeys(SHORT_LINE, "assumed: a test"),
    })
    positions = np.arange(0.0, 1000.0, 7.0)
    searched = [9.80665e-3 * (next(g for a, b, g in grades if a <= x < b)
                              + 600 / next(r for a, b, r in curves if a <= x < b)) for x in positions]
    assert resistance_table(track).at(positions) == pytest.approx(np.array(searched), rel=1e-12, abs=1e-15)


@given(st.lists(st.floats(1, 999), unique=True, max_size=6), st.floats(20, 400), st.data())
def test_a_trains_length_spreads_every_edge(cuts, length, data):
    edges = np.array([0.0, *sorted(cuts)])
    table = ResistanceTable(edges, np.array([data.draw(st.floats(-0.3, 0.3)) for _ in edges]))
    found = over_length(table, length)
    fronts = np.linspace(0.0, 1500.0, 40)
    # The mean by many points of the train, behind the line's start its first value.
    under = fronts[:, None] - length * (np.arange(4000) + 0.5) / 4000
    means = table.at(np.maximum(under, 0.0)).mean(axis=1)
    assert np.abs(found.at(fronts) - means).max() <= 1e-3 * np.ptp(table.specific_force) + 1e-12
    places, rows = found.position_m, found.pieces()
    assert len(places) <= 2 * len(edges) and rows[0, 1] == 0.0
    section = np.searchsorted(places, fronts, side="right") - 1
    assert rows[section, 0] + rows[section, 1] * (fronts - places[section]) == pytest.approx(
        found.at(fronts), rel=1e-9, abs=1e-12)


def test_a_point_meets_the_table_as_it_is():
    table = ResistanceTable(np.array([0.0, 10.0]), np.array([0.1, 0.2]))
    assert over_length(table, None) is table
