"""liu2020's train, line, reference, networks and values: what a run happens in, and what a file may say of it."""

import math
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from plain_liu2020 import G
from refusals import changed_copy, refusal

from proofs.liu2020 import plant as of_train
from proofs.liu2020.simulation.trip import (
    centers,
    davis_at,
    davis_newton,
    desired_curve,
    disturbance_rows,
    line_table,
    rates,
    section_force,
)
from proofs.liu2020.study import KIND
from proofs.liu2020.study.record import LiuStudy
from workbench.files.toml import read_toml, validate_record
from workbench.report.sources import sourced_values

FILE = Path(__file__).parents[3] / "proofs" / "liu2020" / "study.toml"


def read(path):
    """A file as the study's record, without a folder of code beside it."""
    return validate_record(read_toml(path), LiuStudy, path)


def test_the_simulated_train_is_9_with_its_resistances_and_disturbance():
    plant = of_train.model()
    (_, acceleration) = plant.rates.values()
    whole = of_train.acceleration.xreplace({of_train.f_d: of_train.davis(of_train.v) + of_train.additional})
    assert sp.simplify(acceleration.xreplace({of_train.opposing: of_train.opposing_force}) - whole) == 0


def test_the_disturbances_are_70_and_71(study):
    for name, d in (("fast", lambda t: 1e5 / 890e3 * (math.sin(0.08 * t) + math.cos(0.08 * t))),
                    ("slow", lambda t: 1e6 / 890e3 * math.sin(0.008 * t) if t >= 1000 else 0.0)):
        ((start, end, offset, amplitude, omega, phase, power),) = disturbance_rows(study, name)
        assert (end, offset, power) == (math.inf, 0.0, 0.0)
        for t in (0.0, 7.3, 999.0, 1000.0, 1234.5):
            opposing_per_kg = amplitude * math.sin(omega * t + phase) if t >= start else 0.0
            assert -0.9 * opposing_per_kg == pytest.approx(d(t), abs=1e-12)  # chi/M (-f) = d
    assert disturbance_rows(study, "none").shape == (0, 7)


@pytest.mark.parametrize(("unit", "at_350_kmh"), [
    ("N/kN, km/h", 890 * G * (0.53 + 0.00388 * 350 + 0.000114 * 350**2)),
    ("N/kN, m/s", 890 * G * (0.53 + 0.00388 * 350 / 3.6 + 0.000114 * (350 / 3.6) ** 2)),
    ("N/kg, m/s", 890e3 * (0.53 + 0.00388 * 350 / 3.6 + 0.000114 * (350 / 3.6) ** 2)),
])
def test_61_in_each_unit(study, unit, at_350_kmh):
    train = study.train.model_copy(update={"davis_unit": unit})
    assert davis_at(train, 350 / 3.6) == pytest.approx(at_350_kmh, rel=1e-12)
    assert davis_at(train, 0.0) == davis_newton(train)[0]


def test_table_1_in_newtons(study):
    slope, curve = study.line.sections
    assert section_force(slope, study.line, study.train) == pytest.approx(890e3 * G * math.sin(math.atan(0.1)))
    permille = study.line.model_copy(update={"slope_unit": "permille"})
    assert section_force(slope, permille, study.train) == pytest.approx(890e3 * G * math.sin(math.atan(0.01)))
    # (3) with the centre angle in degrees, and (4) without a restricted ramp.
    by_hand = 0.1029 * math.degrees(1.0) / 200 * 890e3 + 1.3e-6 * 1000 * 890e3
    assert section_force(curve, study.line, study.train) == pytest.approx(by_hand)
    table = line_table(study)
    assert table.at(np.array([0.0, 7e4, 1.05e5, 1.1e5, 1.29e5])) == pytest.approx(
        [0, G * math.sin(math.atan(0.1)), 0, by_hand / 890e3, 0])


def test_perfect_tracking_of_the_reference_needs_the_inputs_of_figure_18(study):
    curve = desired_curve(study)
    assert curve.length_m == pytest.approx(study.line.length_m)
    time = np.linspace(0.0, curve.trip_time_s, 200_001)
    _, v, a = curve.at(time)
    assert v.max() == pytest.approx(350 / 3.6)
    u = a * 890e3 / 0.9 + np.array([davis_at(study.train, x) for x in v[::200]]).repeat(200)[: len(a)]
    assert u.max() <= 5e6 * 1.001 and u.max() > 4.5e6
    assert u.min() >= -2e6 * 1.001 and u.min() < -1.8e6
    assert rates(study) == pytest.approx((a.max(), -a.min()), rel=1e-6)


def test_the_networks_stand_on_the_desired_curve_with_inputs_of_order_one(study):
    c = centers(study)
    assert c.shape == (9, study.networks.neurons)
    assert np.abs(c).max() <= 1.0 + 1e-9
    assert np.array_equal(c[0], c[6]) and np.array_equal(c[1], c[7])  # s, v of z_1 are s_d, s_d' of z_2 there
    assert c[0] == pytest.approx(np.linspace(0, 1, study.networks.neurons))
    assert c[1][0] == pytest.approx(0, abs=1e-3) and c[1][7] == pytest.approx(1.0)


def test_assumed_values_follow_their_rules(study):
    gains, adapt, neurons = study.gains, study.adaptation, study.networks.neurons
    assert adapt.alpha_1_per_s2 == pytest.approx(gains.k_3[0] ** 2 / 4, rel=0.01)
    assert adapt.gamma_f_per_s2 == pytest.approx(gains.k_3[0] ** 2 / 4 / neurons, rel=0.01)
    critical = gains.k_5[0] ** 2 * study.train.chi / (4 * study.train.mass_kg)
    assert adapt.alpha_2_n_per_m == pytest.approx(critical, rel=0.01)
    assert adapt.gamma_v_n_per_m == pytest.approx(critical / neurons, rel=0.01)
    position, speed_mps, _ = desired_curve(study).at(np.linspace(0, desired_curve(study).trip_time_s, 100_001))
    braking_from = position[np.nonzero(speed_mps >= study.reference.cruise_mps * (1 - 1e-9))[0][-1]]
    assert 2500 < study.line.length_m - braking_from < 2650 and braking_from > study.line.sections[-1].to_m
    cruise = study.reference.cruise_mps
    assert davis_at(study.train, cruise) == pytest.approx(139e3, rel=0.01)
    assert davis_at(study.train, cruise) * cruise == pytest.approx(13.5e6, rel=0.01)


def test_every_value_has_its_source(study):
    values = sourced_values(study)
    assert {value.kind for value in values} == {"paper", "assumed", "convention"}
    assert len(values) > 60
    assert KIND.record is type(study)


@pytest.mark.parametrize(("old", "new", "key", "words"), [
    ("mass_kg = 890000.0", "mass_kg = 890.0", "train.mass_kg", "greater than or equal to 1000"),
    ("mass_kg = 890000.0", "mass_t = 890.0", "train.mass_t", "did you mean 'mass_kg'"),
    ('davis_unit = "N/kN, km/h"', 'davis_unit = "kN"', "train.davis_unit", "N/kN, km/h"),
    ("cruise_mps = 97.2222222222", "cruise_mps = 350.0", "reference.cruise_mps", "less than or equal to 150"),
    ("lowest_input_n = -2e6", "lowest_input_n = 2e6", "reference.lowest_input_n", "less than 0"),
    ("length_m = 131000.0", "length_m = 120000.0", "line", "from_m and to_m, up to length_m, must increase"),
    ("curve_radius_m = 200.0", "curve_radius_m = 0.2", "line.sections[1].curve_radius_m", "or equal to 50"),
    ("period_s = 0.001\n", "period_s = 1.0\n", "sampling.period_s", "less than or equal to 0.1"),
    ("k_1 = [0.048, ", "k_1 = [", "gains", "k_1 has 9 values"),
    ("k_3 = [0.06, ", "k_3 = [-0.06, ", "gains.k_3[0]", "greater than 0"),
    ("energy = [1.6383e11, ", "energy = [", "table_4", "values"),
    ('table_3_disturbance = "fast"', 'table_3_disturbance = "wind"', "", "there is no disturbance 'wind'"),
    ('sensitivity_law = "liu2020.corrected"', 'sensitivity_law = "liu2020.best"', "", "there is no law 'liu2020.best'"),
    ('divergence_change = "all', 'divergence_change = "al', "", "runs.divergence_change: there is no change"),
    ('"line.length_m" = 300000.0', '"line.length_km" = 300.0', "", "line.length_km: no such key"),
    ('"train.chi" = 1.0', '"train.chi" = 90.0', "", "changes: 'χ = 1, as (1) has it': train.chi"),
    ("divergence_columns = [5, 10]", "divergence_columns = [5, 11]", "runs.divergence_columns[1]", "or equal to 10"),
    ('neurons = "assumed', 'neurons = "guessed', "networks", "must start with 'paper'"),
])
def test_mistakes_are_named(tmp_path, old, new, key, words):
    path = changed_copy(FILE, tmp_path, old, new)
    said = refusal(read, path)
    assert said.startswith(f"{path}: ") and key in said and words in said
