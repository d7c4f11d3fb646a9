"""Adhesion in references: the table is below the curve of 1944, runs keep it at every point, and bounds know of it."""

import copy
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenarios import LINES

from workbench.errors import InputError
from workbench.optimal.bound_checker import checked_bound
from workbench.optimal.bound_document import bound_document
from workbench.optimal.certified_export import COLUMNS, certified_rows
from workbench.optimal.inputs.adhesion import adhesion_table, least_of
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import find_reference
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


@given(st.floats(0.05, 1), st.floats(0.1, 1), st.floats(5, 100))
def test_the_table_is_below_the_curve_by_less_than_a_thousandth(factor, share, top):
    table = adhesion_table(Adhesion(factor=factor, adhesive_share=share), 1e5, top)
    speeds = np.linspace(0, top, 997)
    ratio = np.interp(speeds, *zip(*table, strict=True)) / force_1944(speeds, factor, share)
    assert ratio.min() > 0.999 and ratio.max() <= 1 + 1e-12


@given(st.lists(st.tuples(st.floats(0, 40), st.floats(1, 9)), min_size=1, max_size=6, unique_by=lambda p: p[0]),
       st.lists(st.tuples(st.floats(0, 40), st.floats(1, 9)), min_size=1, max_size=6, unique_by=lambda p: p[0]))
def test_the_least_of_two_tables_is_the_least_everywhere(one, two):
    one, two = tuple(sorted(one)), tuple(sorted(two))
    speeds = np.linspace(-1, 41, 331)
    first, second, both = (np.interp(speeds, *zip(*table, strict=True)) for table in (one, two, least_of(one, two)))
    assert both == pytest.approx(np.minimum(first, second), abs=1e-6)
    assert least_of(one, ()) == one and least_of((), two) == two


def test_a_run_keeps_adhesion_and_its_bound_is_checked_under_it(tmp_path):
    """A wet rail under half of the axles: 147 kN at a standstill become 93 kN at 30 m/s."""
    slippery, dry = train(tmp_path, "[adhesion]\nfactor = 0.6\nadhesive_share = 0.75\n"), train(tmp_path, "")
    line = load_line(LINES[0])[0]
    found = {}
    for name, vehicle in (("slippery", slippery), ("dry", dry)):
        of = course(line, vehicle, 0.0, 3000.0)
        found[name] = of, find_reference(vehicle, of, 160.0)
    of, run = found["slippery"]
    rows = dict(zip(COLUMNS, certified_rows(slippery, run.profile).T, strict=True))
    limit = force_1944(rows["v_mps"], 0.6, 0.75)
    assert np.all(np.abs(rows["force_N"]) <= limit * (1 + 1e-9))
    reached = np.abs(rows["force_N"]) / limit
    assert reached.max() > 0.99  # it binds
    _, free = found["dry"]
    assert free.lower_bound_j <= free.energy_j < run.lower_bound_j <= run.energy_j
    document = json.loads(json.dumps(bound_document(slippery, of, run, 0.0, 0.0)))
    assert float(checked_bound(document)) == pytest.approx(run.lower_bound_j, rel=1e-6)
    slipping = copy.deepcopy(document)
    limit_of = slipping["train"]["traction"]
    limit_of["table"] = [[v, 10 * force] for v, force in limit_of["table"]]  # of a train that slips less, less holds
    with pytest.raises(ValueError, match=r"\w"):  # whichever number of the certificate is found first not to fit
        checked_bound(slipping)


def test_brakes_that_are_not_electric_need_adhesion_at_every_speed(tmp_path):
    with pytest.raises(InputError, match=r"adhesion.*leaves .* at the top speed"):
        train(tmp_path, "[adhesion]\nfactor = 0.2\nadhesive_share = 0.5\n")


def test_a_motors_curve_and_adhesion_hold_together(tmp_path):
    both = train(tmp_path, "traction_curve = [{ speed_mps = 0.0, force_n = 110000.0 }, { speed_mps = 20.0, "
                 "force_n = 30000.0 }]\n[adhesion]\nfactor = 0.5\nadhesive_share = 0.6\n")
    assert both.traction.at(0.0) == pytest.approx(force_1944(0.0, 0.5, 0.6), rel=1e-12)
    assert both.traction.at(20.0) == pytest.approx(30000.0)
    assert both.regenerative.at(10.0) == pytest.approx(force_1944(10.0, 0.5, 0.6) - 30000.0, rel=2e-3)
