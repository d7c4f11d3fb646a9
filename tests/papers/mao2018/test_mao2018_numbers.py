"""mao2018's numbers, laws and train follow what the paper states; a file that cannot be used names the key."""

import math
import re

import pytest
import sympy as sp
from mao2018_cases import FILE
from refusals import changed_copy, refusal

from proofs.mao2018 import laws, plant
from proofs.mao2018.simulation.trip import initial, parameters, setting_of
from proofs.mao2018.study.record import MaoStudy
from workbench.files.toml import read_toml, validate_record
from workbench.paper.study import varied
from workbench.trains.train import single_particle


def read(path):
    """A file as the study's record, without a folder of code beside it."""
    return validate_record(read_toml(path), MaoStudy, path)


def test_the_laws_numbers_follow_the_stated_rules(study):
    scaled, si = study.tunings.values()
    case = study.cases[1]
    values, other = parameters(study, case, scaled), parameters(study, case, si)
    for name, largest in (("a", 1.0), ("b", 60.0), ("c", 3600.0), ("vartheta", 9.81), ("D", 0.004)):
        assert values[f"Gamma_{name}"] == pytest.approx(2 / largest**2)
        assert other[f"Gamma_{name}"] == 2
    assert values["rho_0"] == pytest.approx(0.9 * 15) and parameters(study, study.cases[0], scaled)["rho_0"] == 0.9
    assert values["lambda_0_2"] == pytest.approx(200 / (0.9 * 4e5))
    start = initial(study, case)
    assert start["a_hat_1"] == pytest.approx(0.8 * 8.63e-3) and start["c_hat_2"] == pytest.approx(0.8 * 9.12e-6)
    assert start["rho_hat_3"] == pytest.approx(0.8 / 16) and start["rho_k_hat"] == pytest.approx(0.8 / 16)
    assert start["vartheta_hat_3"] == pytest.approx(0.8 * math.sin(math.radians(0.018)))
    assert start["xi_hat_0"] == start["xi_hat_1"] == 0
    assert initial(study, study.cases[3])["lambda_hat_2"] == pytest.approx(0.9 * 700 / 4e5)


def test_the_readings_of_the_units(study):
    rows = setting_of(study, study.cases[4], study.tunings["scaled"])
    assert rows.changes[0] == pytest.approx([0, 4e5 * 8.63e-3, 4e5 * 7.295e-6, 4e5 * 1.12e-6, 0])
    grade, curve = 9.81 * math.sin(math.radians(0.018)), 0.004 * 0.34
    assert rows.changes[rows.changes[:, 0] == 804][-1][4] == pytest.approx(grade + curve)
    assert rows.terms[:, 3].min() == pytest.approx(-100 / 4e5)
    assert sorted(rows.terms[rows.terms[:, 6] > 0][:, 3]) == [1e-3, 1e-3]
    whole = varied(study, {"readings.resistance": "whole train", "readings.disturbance_unit_n": 1000}, "test")
    rows = setting_of(whole, whole.cases[4], whole.tunings["scaled"])
    assert rows.changes[0][1] == pytest.approx(8.63)
    assert rows.terms[:, 3].min() == pytest.approx(-0.25)
    assert sorted(rows.terms[rows.terms[:, 6] > 0][:, 3]) == pytest.approx([1e-3 / 400] * 2)
    steep = varied(study, {"readings.angle": "radian"}, "test")
    assert setting_of(steep, steep.cases[0], steep.tunings["scaled"]).changes[-3][4] == pytest.approx(
        9.81 * math.sin(0.018) + curve)


def test_the_train_is_that_of_the_other_papers():
    own, other = plant.train, single_particle()
    assert (own.command, own.disturbance, own.parameters) == (other.command, other.disturbance, other.parameters)
    assert all(sp.simplify(rate - other.rates[state]) == 0 for state, rate in own.rates.items())


@pytest.mark.parametrize("kind", laws.KINDS)
def test_a_mended_law_differs_from_the_printed_one_in_its_wrong_signs_alone(kind):
    printed, corrected = laws.failure_law(kind), laws.failure_law(kind, laws.KINDS[kind][-1])
    assert printed.command == corrected.command
    differing = {str(one.symbol).rstrip("_1234") for one, other in zip(printed.states, corrected.states, strict=True)
                 if one.rate != other.rate}
    own = {"44": "rho_k_hat", "54": "lambda_hat", "61": "rho_hat"}
    assert differing == {own[sign] for sign in laws.KINDS[kind][-1]}
    (rho_k,) = (pair for pair in zip(printed.states, corrected.states, strict=True) if "rho_k" in str(pair[0].symbol))
    assert rho_k[0].rate == -rho_k[1].rate


def test_the_indicators_are_one_at_a_time_and_the_slopes_grows():
    at = dict(zip(laws.switch_times, (400, 800, 1400), strict=True)) | {laws.ramp_rate: sp.Rational(1, 4)}
    for time, mode in ((0, 1), (399, 1), (400, 2), (799, 2), (800, 3), (1399, 3), (1400, 4), (2000, 4)):
        values = [chi.xreplace(at).subs(laws.time, time) for chi in laws.indicators]
        assert values == [int(number == mode) for number in laws.MODES]
    slope = [laws.slope_indicator.xreplace(at).subs(laws.time, time) for time in (799, 800, 801, 804, 1399, 1400)]
    assert slope == [0, 0, sp.Rational(1, 4), 1, 1, 0]


@pytest.mark.parametrize(("old", "new", "message"), [
    ("mass_t = 400.0", "mass_t = 400000.0", "train.mass_t: "),
    ("a_kn = 8.63e-3", "a_kn = 8.63", r"modes\[0\].a_kn: "),
    ("start_s = 400.0", "start_s = 900.0", "modes: start_s must increase"),
    ("slope_ramp_per_s = 0.25\n", "", r"modes\[2\]: source.slope_ramp_per_s explains"),
    ('resistance = "per tonne"', 'resistance = "per kilogram"', "readings.resistance: "),
    ("r_1_per_s = 1.0\nr_2", "r_1_per_s = -1.0\nr_2", "tunings.scaled.r_1_per_s: "),
    ("period_s = 0.001\n", "period_s = 0.5\n", "tunings.scaled.period_s: "),
    ("period_s = 0.00025", "period_s = 0.00001", "tunings.SI.period_s = 1e-05: gives 2e.08 periods"),
    ('disturbance = "known"', 'disturbance = "unheard"', r"cases\[0\].disturbance: there is no disturbance 'unheard'"),
    ('events = ["failure"]', 'events = ["flood"]', r"cases\[1\].events"),
    ('law = "damped"', 'law = "magic"', r"cases\[4\].law: "),
    ("end_s = 700.0", "end_s = 7000.0", "sampling.end_s = 7000 is above the desired curve's end"),
    ("starts_s = [0.0, 500.0", "starts_s = [0.0, 100.0", "reference: desired curve: the change to 50 m/s"),
    ("cases = [2, 5]", "cases = [2, 6]", "changes: '.*': cases: there is no case 6"),
    ('"law.omega_rad_s" = 0.1', '"law.omega" = 0.1', "changes: '.*': law.omega: no such key"),
    ('"law.layer_mps" = 0.01', '"law.layer_mps" = -0.01', "changes: '.*': law.layer_mps: Input should be"),
    ('"reference.rate_mps2" = 0.6', '"reference.rate_mps2" = 0.1', "changes: '.*': reference: desired curve"),
    ("to_s = 1000.0", "to_s = 1100.0", "failure: from_s and to_s of its parts, which are one motor, must increase"),
    ("gain = 2.0\n", "gains = 2.0\n", "law.gains: unknown key; did you mean 'gain'"),
    ('gain = "paper', 'gain = "guess', "law: source.gain = 'guess"),
])
def test_a_file_that_cannot_be_used_names_the_key(tmp_path, old, new, message):
    assert re.search(f"study.toml: {message}", refusal(read, changed_copy(FILE, tmp_path, old, new)))
