"""Lines and trains in this project's own format: the bundled ones, and what is wrong in one."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import DRIVEN, LINES, PROOFS, SHARED, TRAIN_PAPERS, TRAINS, line_name

from proofs.liu2020.simulation.trip import davis_newton
from proofs.liu2020.study.record import LiuStudy
from workbench.cli.loading import load
from workbench.errors import InputError
from workbench.files.toml import load_record
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.inputs.plausible import plausible
from workbench.optimal.inputs.train_file import TrainFile
from workbench.optimal.vehicle import ForceLimit, Vehicle
from workbench.trains.track import Track, load_track, resistance_table


def stated(paper: str) -> dict:
    return tomllib.loads((PROOFS / paper / "study.toml").read_text(encoding="utf-8"))


def test_every_paper_has_its_train():
    assert {path.stem for path in TRAINS} >= set(TRAIN_PAPERS)


@pytest.mark.parametrize(("path", "train"), DRIVEN, ids=line_name)
def test_every_bundled_train_can_run_on_every_bundled_line(path, train):
    (line, _), (vehicle, _) = load_line(path), load_vehicle(train)
    found = course(line, vehicle, 0.0, line.length_m, line.stops_between(0.0, line.length_m))
    # At standstill it can start on the steepest place and stop on the steepest descent.
    assert found.force_n.max() + vehicle.davis_n[0] < vehicle.traction.at(0.0)
    assert -found.force_n.min() < vehicle.braking_n
    assert all(v <= vehicle.max_speed_mps for v in found.limit_mps)


@pytest.mark.parametrize("path", LINES, ids=line_name)
def test_a_point_meets_on_a_line_what_a_scenario_meets(path):
    line, _ = load_line(path)
    table = resistance_table(load_track(path))
    vehicle = Vehicle("point", 5e4, (0.0, 0.0, 0.0), ForceLimit(1e5), friction_brake_n=1e5, max_speed_mps=30.0)
    found = course(line, vehicle)
    for front in np.arange(3.0, line.length_m, 37.0):
        k = np.searchsorted(found.position_m, front, side="right") - 1
        assert found.force_n[k] == pytest.approx(5e4 * table.at(np.array([front]))[0], rel=1e-12, abs=1e-9)


def test_the_trains_are_those_of_the_studies():
    found = {paper: load_vehicle(SHARED / "trains" / f"{paper}.toml")[0] for paper in TRAIN_PAPERS}
    for paper in ("yang2021", "liu2020", "jiao2025"):
        assert found[paper].mass_kg == stated(paper)["train"]["mass_kg"]
    yang, chen = stated("yang2021")["train"], stated("chen2019")["train"]
    assert found["yang2021"].davis_n == tuple(
        yang[key] * yang["mass_kg"] for key in ("davis_a_mps2", "davis_b_per_s", "davis_c_per_m"))
    assert (found["yang2021"].traction.force_n, found["yang2021"].braking_n) == (
        yang["max_traction_n"], yang["max_braking_n"])
    mass = chen["cars"] * chen["car_mass_kg"]
    assert found["chen2019"].mass_kg == mass
    assert found["chen2019"].davis_n == pytest.approx(
        [mass * chen[key] for key in ("c_0_n_per_kg", "c_v_n_s_per_m_kg", "c_a_n_s2_per_m2_kg")], rel=1e-14)
    assert found["chen2019"].traction.force_n == chen["cars"] / 2 * chen["traction_n"]
    assert found["chen2019"].braking_n == chen["cars"] * chen["braking_n"]
    mao = stated("mao2018")
    assert found["mao2018"].mass_kg == 1000 * mao["train"]["mass_t"]
    # kN per tonne is N per kg.
    assert found["mao2018"].davis_n == pytest.approx(
        [4e5 * mao["modes"][0][key] for key in ("a_kn", "b_kn_s_per_m", "c_kn_s2_per_m2")], rel=1e-14)
    study = load(PROOFS / "liu2020").record
    assert isinstance(study, LiuStudy)
    liu = study.train
    assert found["liu2020"].davis_n == pytest.approx(davis_newton(liu), rel=1e-12)
    assert found["liu2020"].inertia_kg == pytest.approx(liu.mass_kg / liu.chi, rel=1e-14)
    assert found["jiao2025"].davis_n == pytest.approx((2977, 25.17, 0.2864), rel=1e-12)  # (17), typed again


VALUES = {
    "mass_kg": "200000.0", "davis_a_mps2": "0.01", "davis_b_per_s": "1e-4", "davis_c_per_m": "1e-5",
    "max_traction_n": "180000.0", "max_braking_n": "200000.0", "max_power_w": "3e6", "length_m": "120.0",
    "rotating_fraction": "0.08", "max_speed_mps": "40.0", "max_acceleration_mps2": "1.0",
    "max_deceleration_mps2": "0.8", "traction_curve": "[{speed_mps = 0.0, force_n = 170000.0}, "
    "{speed_mps = 30.0, force_n = 60000.0}]", "traction_efficiency": "0.9", "regenerative_force_n": "150000.0",
    "regenerative_power_w": "2e6", "regenerative_efficiency": "0.8", "auxiliary_w": "50000.0",
}


def written(path: Path, values: dict[str, str]) -> Path:
    sources = "\n".join(f'{key} = "assumed: a test"' for key in values)
    path.write_text("\n".join(f"{k} = {v}" for k, v in values.items()) + f"\n[source]\n{sources}\n", encoding="utf-8")
    return path


def test_every_value_of_a_train_file_arrives(tmp_path):
    vehicle, notes = load_vehicle(written(tmp_path / "mine.toml", VALUES))
    assert vehicle == Vehicle(
        "mine", 2e5, (2000.0, 20.0, 2.0), ForceLimit(1.8e5, 3e6, ((0.0, 1.7e5), (30.0, 6e4))), ForceLimit(1.5e5, 2e6),
        5e4, 0.08, 1.0, 0.8, 40.0, 0.9, 0.8, 120.0, (), 5e4)
    assert notes == ()
    least = {key: VALUES[key] for key in list(VALUES)[:6]}
    bare, told = load_vehicle(written(tmp_path / "bare.toml", least))
    assert (bare.regenerative.force_n, bare.friction_brake_n, bare.max_speed_mps) == (0.0, 2e5, math.inf)
    assert len(told) == 3


@pytest.mark.parametrize(("change", "words"), [
    ({"regenerative_force_n": "250000.0"}, "cannot exceed it"), ({"regenerative_force_n": "0.0"}, "is missing where"),
    ({"traction_efficiency": "90.0"}, "traction_efficiency"), ({"regenerative_efficiency": "nan"}, "give a number"),
    ({"length_m": "0.12"}, "length"), ({"length_m": "true"}, "valid number"), ({"max_speed_mps": "400.0"}, "max speed"),
    ({"rotating_fraction": "1.08"}, "rotating mass"), ({"mass_kg": "200.0"}, "is it in tonnes?"),
    ({"traction_curve": "[{speed_mps = 5.0, force_n = 1e5}, {speed_mps = 5.0, force_n = 9e4}]"}, "sort the points"),
    ({"traction_curve": "[{speed_kmh = 5.0, force_n = 1e5}]"}, "did you mean 'speed_mps'"),
    ({"auxiliary_w": "1e12"}, "auxiliary power"), ({"max_acceleration_mps2": "1e-9"}, "max acceleration"),
    ({"regenerative_power_w": "2000.0"}, "regenerative braking power"), ({"wheels": "8"}, "unknown key"),
])
def test_a_mistake_in_a_train_file_is_named(tmp_path, change, words):
    path = written(tmp_path / "mine.toml", VALUES | change)
    with pytest.raises(InputError) as caught:
        load_vehicle(path)
    assert str(caught.value).startswith(f"{path}: ") and words in str(caught.value) and str(caught.value).isprintable()


def test_a_value_of_a_train_file_needs_a_source_where_a_paper_is_reproduced(tmp_path):
    path = written(tmp_path / "mine.toml", VALUES)
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace('length_m = "assumed: a test"\n', ""), encoding="utf-8")
    assert load_vehicle(path)[0].length_m == 120.0
    with pytest.raises(InputError, match=r"source\.length_m is missing"):
        load_record(path, TrainFile, reproduction=True)


@pytest.mark.parametrize("path", [*LINES, *TRAINS], ids=lambda p: f"{p.parent.name}-{p.stem}")
def test_every_value_of_what_ships_has_its_source(path):
    load_record(path, Track if path in LINES else TrainFile, reproduction=True)


METRO = (SHARED / "lines" / "metro.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(("old", "new", "words"), [
    ("stops_m = [0.0, 1250.0", "stops_m = [1.0, 1250.0", "name both ends"),
    ("1250.0, 2900.0, 5400.0]", "2900.0, 1250.0, 5400.0]", "sort them"),
    ("1250.0, 2900.0, 5400.0]", "1250.0, 2900.0, 5300.0]", "name both ends"),
    ("stops_m = [0.0, 1250.0, 2900.0, 5400.0]", "stops_m = []", "name both ends"),
    ("start_m = 150.0, end_m = 420.0, speed_mps", "start_m = 160.0, end_m = 420.0, speed_mps", "speed_limit[1]: gap"),
    ("speed_mps = 13.88", "speed_mps = -13.88", "speed_limit[0].speed_mps"),
    ("speed_mps = 13.88", "speed_mps = 1388", "speed_limit[0].speed_mps"),
    ("speed_mps = 13.88", "speed_kmh = 50.0 #", "did you mean 'speed_mps'"),
])
def test_a_mistake_in_a_lines_limits_or_stops_is_named(tmp_path, old, new, words):
    assert old in METRO
    text = METRO.replace(old, new, 1) if "#" not in new else METRO.replace(
        METRO[METRO.index(old):METRO.index("}", METRO.index(old))], "speed_kmh = 50.0 ", 1)
    path = tmp_path / "line.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_line(path)
    assert str(caught.value).startswith(f"{path}: ") and words in str(caught.value)


@pytest.mark.parametrize(("load", "path", "words"), [
    (load_line, "../proofs/yang2021/study.toml", "scenario"), (load_vehicle, "../proofs/liu2020/study.toml", "study"),
    (load_line, "trains/yang2021.toml", "not a line's file"), (load_vehicle, "lines/metro.toml", "not a train's file"),
    (load_line, "missing.toml", "no such file"), (load_vehicle, "lines", ".toml"),
])
def test_another_file_than_the_one_wanted_is_told(load, path, words):
    with pytest.raises(InputError, match=words):
        load(SHARED / path)


JUNK = st.sampled_from(["", "nan", "inf", "-1.0", "0.0", "1e300", "true", '"x"', "[]", "[[]]", "{}", "9" * 400,
                        "1e-300"])


@settings(max_examples=200, deadline=None)
@given(st.dictionaries(st.sampled_from([*VALUES, "wheels"]), JUNK, min_size=1, max_size=3))
def test_a_mutated_train_file_loads_or_is_refused_in_one_line(tmp_path_factory, change):
    path = written(tmp_path_factory.getbasetemp() / "mutated.toml", VALUES | change)
    try:
        vehicle = load_vehicle(path)[0]
    except InputError as refused:
        assert str(refused).startswith(str(path)) and str(refused).isprintable()
    else:
        assert vehicle == plausible(vehicle)


def test_what_a_vehicle_cannot_be_is_refused():
    good = load_vehicle(SHARED / "trains" / "jiao2025.toml")[0]
    for change in ({"tunnel_drag": ((24.0, 8.0), (24.0, 9.0))}, {"tunnel_drag": ((0.0, 8.0),)},
                   {"traction": ForceLimit(math.nan)}, {"length_m": math.nan}, {"mass_kg": math.inf},
                   {"traction_efficiency": 0.009}):
        with pytest.raises(InputError):
            plausible(replace(good, **change))
