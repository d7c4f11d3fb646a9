"""What chen2019's study states: its sources, the force that its reference asks for, mistakes in its file."""

import shutil
import sys

import pytest
from chen2019_studies import FOLDER

from proofs.chen2019.simulation.formulas import needed_force
from proofs.chen2019.study.record import ChenStudy
from workbench.cli import app as cli
from workbench.errors import InputError
from workbench.files.toml import validate_record
from workbench.report.sources import sourced_values


def test_every_value_says_where_it_comes_from_and_what_is_assumed(study):
    kinds = {value.key: value.kind for value in sourced_values(study)}
    assert kinds["gains.c_1"] == kinds["train.car_mass_kg"] == "paper"
    assert kinds["reference.acceleration_mps2"] == kinds["mass_bounds.low_kg"] == "assumed"
    assert kinds["sampling.acceleration"] == kinds["trials.lambda_1_m"] == "assumed"


def test_the_reference_asks_for_what_the_motors_can_give(study):
    ref, train = study.reference, study.train
    # By hand: 300 t with 0.2 m/s^2, rolling and air at 83.5 m/s.
    need = 3e5 * 0.2 + 3e5 * (0.00775 + 0.000228 * 83.5) + 3e5 * 1.66e-5 * 83.5**2
    assert needed_force(study, ref.cruise_mps, ref.acceleration_mps2) == pytest.approx(need, rel=1e-12)
    assert need < 3 * train.traction_n
    assert needed_force(study, 0.0, -ref.braking_mps2) > -6 * train.braking_n


MISTAKES = [
    ("train.car_mass_kg", 50.0, "train.car_mass_kg"),
    ("train.traction_n", 40.0, "train.traction_n"),
    ("train.motor_pattern", "1x0", "train.motor_pattern"),
    ("train.cars", 1, "train.cars"),
    ("mass_bounds.low_kg", 60000.0, "low_kg = 60000 is above high_kg = 50000: lower it"),
    ("reference.acceleration_mps2", 0.05, "allow more trip_time_s"),
    ("reference.trip_time_s", 1000.0004, "not a whole number of samples"),
    ("sampling.log_every_s", 0.0015, "sampling.log_every_s = 0.0015 is not a whole number of samples"),
    ("sampling.period_s", 0.00001, "GB: sample more coarsely or shorten the trip"),
    ("sampling.acceleration", "guessed", "sampling.acceleration"),
    ("trials.shown", [31], "shown = 31 is above count = 30: lower it"),
    ("line.slope_permille", 500.0, "line.slope_permille"),
    ("gains.c_3", 0.0, "gains.c_3"),
    ("cost.end_s", 5000.0, "cost.end_s = 5000 is above reference.trip_time_s"),
]


@pytest.mark.parametrize(("key", "value", "message"), MISTAKES, ids=[key for key, _, _ in MISTAKES])
def test_a_mistake_names_file_key_and_remedy(study, key, value, message):
    data = study.model_dump(exclude_unset=True)
    table, name = key.split(".")
    data[table] = {**data[table], name: value}
    with pytest.raises(InputError) as caught:
        validate_record(data, ChenStudy, "chen2019.toml")
    assert message in str(caught.value)
    assert str(caught.value).startswith("chen2019.toml: ")


def test_a_change_of_what_is_not_stated_ends_with_exit_code_2(tmp_path, capsys, monkeypatch):
    path = tmp_path / "chen2019" / "study.toml"
    shutil.copytree(FOLDER, path.parent, ignore=shutil.ignore_patterns("certificates", "__pycache__"))
    path.write_text(path.read_text(encoding="utf-8").replace('set = { "gains.gamma_a" = 0.005 }',
                                                             'set = { "gains.gamma_b" = 0.005 }'), encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["workbench", "compare", str(path)])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "changes: 'gamma_a a quarter': gains.gamma_b: no such key" in said
