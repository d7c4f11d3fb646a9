"""Adhesion in references: the table is below the curve of 1944, runs keep it at every point, and bounds know of it."""

import copy
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.optimal.bound_checker import FINE, _ranges, checked_bound
from workbench.optimal.bound_document import bound_document
from workbench.optimal.cars.car_train import CarTrain, car_limits
from workbench.optimal.certified_export import COLUMNS, certified_rows
from workbench.optimal.course import Course
from workbench.optimal.inputs import adhesion
from workbench.optimal.inputs.adhesion import adhesion_table, chord_table, least_of
from workbench.optimal.inputs.files import load_vehicle
from workbench.optimal.profile import forces, largest_braking, largest_force
from workbench.optimal.reference import find_reference
from workbench.optimal.speed_ranges import speed_ranges
from workbench.optimal.vehicle import ForceLimit, Vehicle
from workbench.trains.actuator import Adhesion

STATED = """
mass_kg = 100000.0
davis_a_mps2 = 0.015
davis_b_per_s = 2e-4
davis_c_per_m = 3e-5
max_traction_n = 110000.0
max_braking_n = 120000.0
regenerative_force_n = 90000.0
regenerative_efficiency = 0.6
max_speed_mps = 30.0
"""


def force_1944(v, factor=1.0, share=1.0, mass=1e5):
    """mu = 7.5 / (V + 44) + 0.161, V in km/h, typed once more."""
    return (7.5 / (3.6 * v + 44) + 0.161) * factor * share * mass * 9.80665


def train(folder, table):
    path = folder / "train.toml"
    path.write_text(STATED + table, encoding="utf-8")
    return load_vehicle(path)[0]


@given(st.floats(0.05, 1), st.floats(0.1, 1), st.floats(5, 90))
def test_tangents_are_below_the_curve_and_chords_above_it_by_less_than_a_thousandth(factor, share, top):
    grip, speeds = Adhesion(factor=factor, adhesive_share=share), np.linspace(0, top, 997)
    low, high = (np.interp(speeds, *zip(*table(grip, 1e5, top), strict=True)) / force_1944(speeds, factor, share)
                 for table in (adhesion_table, chord_table))
    assert low.min() > 0.999 and low.max() <= 1 + 1e-12
    assert high.max() < 1.001 and high.min() >= 1 - 1e-15


@given(st.lists(st.tuples(st.floats(0, 40), st.floats(1, 9)), min_size=1, max_size=6, unique_by=lambda p: p[0]),
       st.lists(st.tuples(st.floats(0, 40), st.floats(1, 9)), min_size=1, max_size=6, unique_by=lambda p: p[0]))
def test_the_least_of_two_tables_is_the_least_everywhere(one, two):
    one, two = tuple(sorted(one)), tuple(sorted(two))
    speeds = np.linspace(-1, 41, 331)
    first, second, both = (np.interp(speeds, *zip(*table, strict=True)) for table in (one, two, least_of(one, two)))
    assert both == pytest.approx(np.minimum(first, second), abs=1e-6)
    assert least_of(one, ()) == one and least_of((), two) == two


def test_a_run_keeps_adhesion_and_its_bound_is_checked_under_it(tmp_path):
    """Of 110 kN of traction a wet rail under three quarters of the axles leaves 99.6 kN at 20 m/s."""
    slippery, dry = train(tmp_path, "[adhesion]\nfactor = 0.6\nadhesive_share = 0.75\n"), train(tmp_path, "")
    rising = np.repeat([[0.0], [5e3]], 2, axis=1)
    of = Course(np.array([0.0, 1000.0, 2400.0]), np.array([26.0, 24.0]), rising, np.zeros((2, 2)))
    run, free = (find_reference(vehicle, of, 125.0, intervals=40, solver="socp") for vehicle in (slippery, dry))
    rows = dict(zip(COLUMNS, certified_rows(slippery, run.profile).T, strict=True))
    limit = force_1944(rows["v_mps"], 0.6, 0.75)
    assert np.all(np.abs(rows["force_N"]) <= limit * (1 + 1e-9))
    reached = np.abs(rows["force_N"]) / limit
    assert reached.max() > 0.99  # it binds
    assert run.lower_bound_j <= run.energy_j and free.energy_j < run.energy_j
    document = json.loads(json.dumps(bound_document(slippery, of, run, 0.0, 0.0)))
    assert float(checked_bound(document)) == pytest.approx(run.lower_bound_j, rel=1e-6)
    slipping = copy.deepcopy(document)
    limit_of = slipping["train"]["traction"]
    limit_of["table"] = [[v, 10 * force] for v, force in limit_of["table"]]
    with pytest.raises(ValueError, match="digests"):
        checked_bound(slipping)


def test_adhesion_is_of_both_brakes_together(tmp_path):
    """The electric brake may take all of it: 90 kN of a rail that bears less, beside 30 kN of other brakes."""
    slippery = train(tmp_path, "[adhesion]\nfactor = 0.4\nadhesive_share = 0.6\n")
    assert slippery.regenerative.at(5.0) == 90000.0 and slippery.friction_brake_n == 30000.0
    assert largest_braking(slippery, np.array([5.0]))[0] == pytest.approx(force_1944(5.0, 0.4, 0.6), rel=1e-3)
    falling = Course(np.array([0.0, 2000.0]), np.array([20.0]), np.array([[-1e4, -1e4]]), np.zeros((1, 2)))
    run = find_reference(slippery, falling, 160.0, intervals=60, solver="socp")
    found = forces(slippery, run.profile)
    both = found.regenerative_n + found.friction_n
    assert np.all(both <= force_1944(found.speed_mps, 0.4, 0.6) * (1 + 1e-9))
    assert found.regenerative_n.max() > force_1944(0.0, 0.4, 0.6) - 30000.0  # more than the other brake left, if full
    assert run.check.force_excess <= 1e-9
    assert float(checked_bound(json.loads(json.dumps(bound_document(slippery, falling, run, 0.0, 0.0))))) == (
        pytest.approx(run.lower_bound_j, rel=1e-6))


def test_cars_have_no_negative_brake_where_adhesion_leaves_friction_nothing(tmp_path):
    cars = train(tmp_path, "[adhesion]\nfactor = 0.3\nadhesive_share = 0.6\n")
    limits = car_limits(CarTrain(cars, (True, False, True), 1e6, 1e4), np.array([0.0, 10.0, 25.0]))
    assert limits.friction_n.min() == 0.0
    both = (limits.electric_n + limits.friction_n).sum(axis=1)
    assert np.all(both >= largest_braking(cars, np.array([0.0, 10.0, 25.0])) * (1 - 1e-12))


def test_a_bound_is_one_of_the_curve_and_not_of_what_follows_it_from_below(tmp_path, monkeypatch):
    """With few tangents a run takes more than a train on the curve needs; the bound must not."""
    table = "[adhesion]\nfactor = 0.3\nadhesive_share = 0.6\n"
    rising = Course(np.array([0.0, 3000.0]), np.array([25.0]), np.array([[4e3, 4e3]]), np.zeros((1, 2)))
    monkeypatch.setattr(adhesion, "TANGENTS", 4)
    coarse = train(tmp_path, table)
    monkeypatch.setattr(adhesion, "TANGENTS", 60)
    near = find_reference(train(tmp_path, table), rising, 205.0)
    rough = find_reference(coarse, rising, 205.0)
    assert near.gap < 2e-3
    assert rough.lower_bound_j < near.lower_bound_j < near.energy_j < rough.energy_j


@given(st.floats(0, 2e5), st.floats(1e5, 5e6), st.floats(0, 1e5), st.floats(0.05, 1), st.floats(1e-3, 1),
       st.floats(-2, 2), st.floats(0, 1))
def test_no_split_of_the_brakes_gains_more_than_the_ranges_say(electric, power, friction, factor, share, p, back):
    """Against the best split of every speed, for what optimiser and checker take alike."""
    table = adhesion_table(Adhesion(factor=factor), 1e5, 30.0)
    vehicle = Vehicle("t", 1e5, (0.0, 0.0, 0.0), ForceLimit(1e5), ForceLimit(electric, power), friction + 1.0,
                      regenerative_efficiency=back, braking_table=table)
    regain, rub = max(back - p, 0.0), max(-p, 0.0)
    ranges = speed_ranges(vehicle, 30.0)
    document = {"traction": stated(vehicle.traction), "regenerative": stated(vehicle.regenerative),
                "braking_table": [list(row) for row in table]}
    exact = [*_ranges(document, 30 << FINE, True, int((friction + 1.0) * 2**FINE))]
    for v in np.geomspace(0.05, 29.9, 40) * (0.9 + 0.1 * share):
        own, both = largest_force(vehicle.regenerative, v), largest_braking(vehicle, np.array([v]))[0]
        best = max(regain * e + rub * min(friction + 1.0, both - e) for e in np.linspace(0, min(own, both), 9))
        k = int(np.flatnonzero((ranges.low.ravel() <= v) & (v <= ranges.high.ravel()))[0])
        taken = [sum(c.ravel()[k] * v**power for c, power in zip(limit, (-1, 0, 1, 2), strict=True))
                 for limit in (ranges.brake, ranges.friction)]
        assert taken[0] >= 0 and taken[1] >= -1e-9
        assert best <= (regain * taken[0] + rub * taken[1]) * (1 + 1e-9) + 1e-5
        here = next(one for one in exact if one.low <= v * 2**FINE <= one.high)
        told = [sum(c / 2**FINE * v**power for c, power in zip(limit, (-1, 0, 1, 2), strict=True))
                for limit in (here.electric, here.friction)]
        assert told[0] >= 0 and told[1] >= -1e-9
        assert best <= (regain * told[0] + rub * told[1]) * (1 + 1e-9) + 1e-5


def stated(limit):
    power_w = limit.power_w if np.isfinite(limit.power_w) else None
    return {"force_n": limit.force_n, "power_w": power_w, "table": [list(row) for row in limit.table]}


def test_a_motors_curve_and_adhesion_hold_together(tmp_path):
    both = train(tmp_path, "traction_curve = [{ speed_mps = 0.0, force_n = 110000.0 }, { speed_mps = 20.0, "
                 "force_n = 30000.0 }]\n[adhesion]\nfactor = 0.5\nadhesive_share = 0.6\n")
    assert both.traction.at(0.0) == pytest.approx(force_1944(0.0, 0.5, 0.6), rel=1e-12)
    assert both.traction.at(20.0) == pytest.approx(30000.0)
    assert both.braking_n == pytest.approx(force_1944(0.0, 0.5, 0.6), rel=1e-12)
