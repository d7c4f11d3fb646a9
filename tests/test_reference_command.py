"""`workbench reference` as newcomers and other programs meet it: outputs, exit codes, one-line errors."""

import csv
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import said
from scenarios import DRIVEN, SHARED, YANG, line_name

from workbench.errors import WorkbenchError
from workbench.optimal.bound_checker import main as check_bounds
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.vehicle import Vehicle

HILLS, TRAIN = SHARED / "lines" / "hills.toml", SHARED / "trains" / "yang2021.toml"
KEYS = {"version", "energy_J", "lower_bound_J", "gap", "trip_time_s", "solver", "solve_s", "status"}


def least_time(line: Path, train: Path) -> float:
    with pytest.raises(WorkbenchError, match="least feasible one") as trouble:
        said(line, train)
    return float(str(trouble.value).partition("a trip time of ")[2].partition(" s")[0])


@pytest.mark.parametrize(("line", "train"), DRIVEN, ids=line_name)
def test_every_bundled_train_runs_on_every_bundled_line(line: Path, train: Path, tmp_path: Path) -> None:
    time = 1.15 * least_time(line, train)
    said(line, train, "--time", time, "--json", tmp_path / "r.json")
    document = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert document.keys() >= KEYS
    assert document["trip_time_s"] <= time
    assert document["lower_bound_J"] <= document["energy_J"]
    assert document["gap"] <= 1e-3, "say in the line's or train's file why the bound is looser"
    assert document["status"] == "optimal"
    assert document["check"]["energy_J"] == pytest.approx(document["energy_J"], rel=1e-3)
    with (tmp_path / "r.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["t_s", "s_m", "v_mps", "a_mps2", "u_N"]
    assert float(rows[-1]["t_s"]) <= time
    assert float(rows[-1]["v_mps"]) == pytest.approx(0.0, abs=1e-6)
    require_certified(tmp_path / "r_certified.csv", document, load_vehicle(train)[0])
    smooth = document["smooth"]
    assert smooth["force_excess"] == 0 and smooth["speed_excess_mps"] < 1e-9
    assert smooth["gap"] == pytest.approx(1 - document["lower_bound_J"] / smooth["energy_J"])
    assert smooth["simulated_energy_J"] == pytest.approx(smooth["energy_J"], rel=2e-3)
    assert smooth["position_drift_m"] < 0.5


def require_certified(table: Path, document: dict[str, Any], vehicle: Vehicle) -> None:
    """The run of the bound, read back as another program would: its motion, its energy, and its limits to 1e-9."""
    with table.open(encoding="utf-8") as file:
        rows = np.array(list(csv.reader(file))[1:], dtype=float)
    s, t, v, a, force, power, limit, most = rows.T
    assert np.array_equal(rows, np.column_stack(list(document["certified"]["profile"].values())))
    assert np.allclose(np.diff(t), 2 * np.diff(s) / (v[1:] + v[:-1]), rtol=1e-6, atol=1e-9)
    assert np.allclose(v[1:]**2 - v[:-1]**2, 2 * a[:-1] * np.diff(s), rtol=1e-6, atol=1e-6)
    assert np.all(np.abs(force) <= limit * (1 + 1e-9))
    assert np.all(power <= vehicle.traction.power_w * (1 + 1e-9))
    assert np.all(v <= np.minimum(most, np.append(np.inf, most[:-1])) * (1 + 1e-9))
    # The force behind each row, up to the next one: all that a reader without the line can do.
    if vehicle.regenerative.force_n == 0:
        spent = float(np.sum(np.diff(s) * np.maximum(force[:-1], 0.0))) / vehicle.traction_efficiency
        spent += vehicle.auxiliary_w * t[-1]
        assert spent == pytest.approx(document["certified"]["energy_J"], rel=5e-3)
    assert document["certified"]["gap"] == document["gap"]


def test_all_outputs_of_one_run(tmp_path: Path) -> None:
    text = said(HILLS, TRAIN, "--time", 2600, "--json", tmp_path / "a.json", "--csv", tmp_path / "b.csv", "--every", 2,
                "--figure", tmp_path / "c.svg", "--certificate", tmp_path / "d.json", "--intervals", 200)
    assert {path.name for path in tmp_path.iterdir()} == {"a.json", "b.csv", "b_certified.csv", "c.svg", "d.json"}
    assert "gap" in text and "proves" in text
    assert (tmp_path / "c.svg").read_text(encoding="utf-8").startswith("<?xml")
    assert check_bounds([str(tmp_path / "d.json")]) == 0
    assert "for this line, train and times" in said(HILLS, TRAIN, "--time", 2600, "--check", tmp_path / "d.json")
    for other in ((HILLS, TRAIN, "--time", 2590), (SHARED / "lines" / "metro.toml", TRAIN, "--time", 2600),
                  (HILLS, TRAIN, "--time", 2600, "--to-speed", 5),
                  (HILLS, SHARED / "trains" / "jiao2025.toml", "--time", 2600)):
        with pytest.raises(WorkbenchError, match=r"digests\."):
            said(*other, "--check", tmp_path / "d.json")
    proven = json.loads((tmp_path / "d.json").read_text(encoding="utf-8"))["lower_bound_J"]
    stated = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["lower_bound_J"]
    auxiliaries = load_vehicle(TRAIN)[0].auxiliary_w * 2600
    assert stated - auxiliaries == pytest.approx(proven, rel=1e-6)


def test_stops_on_the_way_take_their_time(tmp_path: Path) -> None:
    line = SHARED / "lines" / "metro.toml"
    text = line.read_text(encoding="utf-8")
    assert "stops_m" in text, "the metro line must have stops for this test"
    train = SHARED / "trains" / "jiao2025.toml"
    energies, time = [], 3 * least_time(line, train) + 100
    for option in ((), ("--stops", "--dwell", 20)):
        said(line, train, "--time", time, "--json", tmp_path / "r.json", "--intervals", 200, *option)
        energies.append(json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))["energy_J"])
    assert energies[0] < energies[1]


def test_a_run_that_arrives_early_says_so(tmp_path: Path) -> None:
    """With auxiliaries a later arrival costs more: "0.380 km in 200 s" stood above a run of a minute."""
    (tmp_path / "line.toml").write_text(
        'name = "short"\nlength_m = 380.0\ngrade = [{ start_m = 0.0, end_m = 380.0, grade_permille = 0.0 }]\n'
        'curve = [{ start_m = 0.0, end_m = 380.0, radius_m = inf }]\n'
        'speed_limit = [{ start_m = 0.0, end_m = 380.0, speed_mps = 15.0 }]\n', encoding="utf-8")
    train = ("mass_kg = 150000.0\ndavis_a_mps2 = 0.02\ndavis_b_per_s = 0.0\ndavis_c_per_m = 0.0\n"
             "max_traction_n = 200000.0\nmax_braking_n = 160000.0\n")
    told = {}
    for auxiliary in (0.0, 80e3):
        (tmp_path / "train.toml").write_text(f"{train}auxiliary_w = {auxiliary}\n", encoding="utf-8")
        told[auxiliary] = said(tmp_path / "line.toml", tmp_path / "train.toml", "--time", 100, "--intervals", 60,
                               "--json", tmp_path / "r.json")
    assert "arrives  " not in told[0.0] and "note: no grade" not in told[0.0]
    assert re.search(r"line +grades 0 per mille, limits 54 km/h; the run at most [1-5]\d\.\d km/h, "
                     r"1[34]\.\d km/h on average", told[0.0])
    took = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))["trip_time_s"]
    assert took < 90
    assert f"arrives       after {took:.1f} s, {100 - took:.1f} s early" in told[80e3]


def test_near_the_least_time_the_window_shrinks_and_it_is_said() -> None:
    """A run smoothed over a window is later by it: within a second of the least time none is left for one."""
    least = least_time(HILLS, TRAIN)
    told = said(HILLS, TRAIN, "--time", f"{least + 0.9:.3f}", "--intervals", 200)
    assert re.search(r"note: smoothing over 1 s takes more time than there is: over 0\.[25] s here", told)
    with pytest.raises(WorkbenchError, match=r"its smooth reference is not: .*; or choose a shorter --window$"):
        said(HILLS, TRAIN, "--time", f"{least + 0.9:.3f}", "--window", 1, "--intervals", 200)
    with pytest.raises(WorkbenchError, match="the least feasible trip time is"):
        said(HILLS, TRAIN, "--time", f"{least - 0.9:.3f}")


@pytest.mark.parametrize(("arguments", "message"), [
    ((HILLS, TRAIN, "--time", 60), "60 s is too short: the least feasible trip time is .* allow more time"),
    ((HILLS, TRAIN, "--time", "nan"), "time: nan s is no trip time"),
    ((HILLS, TRAIN, "--time", -5), "time: -5 s is no trip time"),
    ((HILLS, TRAIN, "--time", 1e9), "is it in seconds"),
    ((HILLS, TRAIN), "--time: is missing: give a trip time of"),
    ((TRAIN, HILLS, "--time", 2600), "yang2021.toml: grade: is missing: this is not a line's file"),
    ((HILLS, YANG, "--time", 2600), "study.toml: mass_kg: is missing: this is a scenario"),
    ((HILLS, "nowhere.toml", "--time", 2600), "nowhere.toml: no such file"),
    ((HILLS, "nowhere.txt", "--time", 2600), "neither .toml .* nor .json"),
    ((HILLS, TRAIN, "--time", 2600, "--from-m", 9e9), "is no run of a metre or more"),
    ((HILLS, TRAIN, "--time", 2600, "--from-speed", 300), "the run cannot start at 300 m/s"),
    ((HILLS, TRAIN, "--time", 2600, "--to-speed", 300), "the run cannot end at 300 m/s"),
    ((HILLS, TRAIN, "--time", 2600, "--to-speed", "nan"), "--to-speed: nan is not usable"),
    ((HILLS, TRAIN, "--time", 2600, "--window", 0), "must be positive"),
    ((HILLS, TRAIN, "--time", 2600, "--max-jerk", -1), "must be positive"),
    ((HILLS, TRAIN, "--time", 2600, "--figure", "x.gif"), "figure: end the name in one of"),
    ((HILLS, TRAIN, "--time", 2600, "--json", "/proc/nothing/r.json"), "cannot be written"),
    ((HILLS, TRAIN, "--time", 2600, "--every", 0), "--every: 0 s is no step"),
    ((HILLS, TRAIN, "--time", 2600, "--window", 5000), "smoothing over 5000 s leaves nothing of 2600 s to run"),
    ((HILLS, TRAIN, "--time", 2600, "--json", "x.out", "--csv", "x.out"), "x.out: --csv: is what --json writes too"),
    ((HILLS, TRAIN, "--time", 2600, "--json", "x.csv"), "x.csv: --csv: is what --json writes too"),
    ((HILLS, TRAIN, "--time", 2600, "--json", HILLS), "hills.toml: --json: is a .toml file"),
    ((HILLS, TRAIN, "--time", 2600, "--figure", TRAIN), "yang2021.toml: --figure: is a .toml file"),
], ids=str)
def test_mistakes_are_one_line_with_a_remedy(arguments: tuple[object, ...], message: str) -> None:
    with pytest.raises(WorkbenchError, match=message) as trouble:
        said(*arguments)
    assert "\n" not in str(trouble.value)


def test_grades_that_are_ratios_are_told(tmp_path: Path) -> None:
    """A climb of 0.02 per mille on a line of no other is 20 per mille, written as a ratio."""
    text = HILLS.read_text(encoding="utf-8")
    ratios = re.sub(r"(?<=grade_permille = )(-?[\d.]+)", lambda found: str(float(found[1]) / 1000), text)
    (tmp_path / "line.toml").write_text(ratios, encoding="utf-8")
    assert load_line(tmp_path / "line.toml")[1] == (
        "no grade of line 'synthetic hilly line' is above 0.027 per mille: are they ratios, and not per mille?",)
    assert load_line(HILLS)[1] == ()
