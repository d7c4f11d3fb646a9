"""A day's trips in one command: one table, the same for any number of workers; bad trips told, the others run."""

import csv
import json
import re
from pathlib import Path

import pytest
from command_line import run, said
from scenarios import SHARED

from workbench.errors import WorkbenchError
from workbench.optimal.fleet import COLUMNS, TripRow
from workbench.report.fleet_command import FleetRequest, _write_csv, fleet_run

FLEET = f"""
name = "short trips"
track = "{(SHARED / 'lines' / 'metro.toml').as_posix()}"
train = "{(SHARED / 'trains' / 'jiao2025.toml').as_posix()}"
trips = [
  {{ id = "a", time_s = 120.0, to_m = 1250.0 }},
  {{ id = "too soon", time_s = 20.0, to_m = 1250.0 }},
  {{ id = "b", time_s = 150.0, from_m = 1250.0, to_m = 2900.0 }},
  {{ id = "no train", time_s = 150.0, train = "nowhere.toml" }},
]
"""


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    path = tmp_path / "fleet.toml"
    path.write_text(FLEET, encoding="utf-8")
    return path


def test_a_days_trips_are_one_table_of_the_same_bytes_for_any_number_of_workers(fleet, tmp_path, monkeypatch):
    files = []
    for workers in (1, 2):
        names = [tmp_path / f"{workers}.{kind}" for kind in ("json", "csv")]
        text = said("--fleet", fleet, "--json", names[0], "--csv", names[1], "--workers", workers)
        files.append([name.read_bytes() for name in names])
    assert files[0] == files[1]
    assert "2 of 4 trips solved" in text and "too soon     refused: 20 s is too short" in text
    rows = json.loads(files[0][0])["trips"]
    assert [row["id"] for row in rows] == ["a", "too soon", "b", "no train"]
    for row in rows:
        if row["id"] in ("a", "b"):
            assert row["status"] == "optimal" and 0 <= row["gap"] <= 1e-2 and row["lower_bound_J"] <= row["energy_J"]
            assert row["least_time_s"] < row["time_s"] and row["trouble"] is None
        else:
            assert row["energy_J"] is None and row["trouble"] and "\n" not in row["trouble"]
    with (tmp_path / "1.csv").open(encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    assert [row["id"] for row in table] == [row["id"] for row in rows]
    assert float(table[0]["energy_J"]) == pytest.approx(rows[0]["energy_J"], rel=1e-11)

    # What is finished is taken over: no trip is solved again but those that were refused.
    from workbench.optimal import fleet as solving
    asked = []
    solve = solving.solved_trip
    monkeypatch.setattr(solving, "solved_trip", lambda shared, trip: asked.append(trip.trip.id) or solve(shared, trip))
    said("--fleet", fleet, "--json", tmp_path / "1.json", "--csv", tmp_path / "3.csv", "--workers", 1, "--resume")
    assert asked == ["too soon", "no train"]
    seen = []
    (tmp_path / "4.json").write_bytes(files[0][0])
    list(fleet_run(FleetRequest(fleet, tmp_path / "4.json", None, 1, True), lambda *far: seen.append(far)))
    assert seen == [(2, 4), (3, 4), (4, 4)], "how far it is, from what an earlier run has done"
    assert [(tmp_path / name).read_bytes() for name in ("1.json", "3.csv")] == files[0]


@pytest.mark.parametrize(("old", "new", "words"), [
    ('id = "b"', 'id = "a"', "'a' stands twice"), ("time_s = 120.0", "time_s = -1.0", "time_s"),
    ("trips = [", "tips = [", "tips"), ("train = ", "# train = ", "train is missing"),
])
def test_a_mistake_in_the_file_itself_is_one_line(fleet, old, new, words):
    fleet.write_text(FLEET.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(WorkbenchError, match=words) as trouble:
        said("--fleet", fleet)
    assert "\n" not in str(trouble.value)


def test_no_name_of_a_trip_is_a_formula_in_a_spreadsheet(tmp_path):
    written = tmp_path / "a.csv"
    names = ["=cmd|' /C calc'!A0", "+1", "-1", "@x", "\t=1", "a=1"]
    _write_csv(written, COLUMNS, [TripRow(name, "line", "train", 1.0, trouble="=x").document() for name in names])
    with written.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["id"] for row in rows] == [*("'" + name for name in names[:-1]), "a=1"]
    assert {(row["trouble"], row["length_m"], row["gap"]) for row in rows} == {("'=x", "1", "")}


def test_a_day_of_which_no_trip_can_be_run_ends_as_a_mistake_below_its_table(tmp_path):
    path = tmp_path / "fleet.toml"
    path.write_text(FLEET.replace("jiao2025.toml", "nothing.toml"), encoding="utf-8")
    ended = run("reference", "--fleet", path, "--csv", tmp_path / "a.csv")
    assert ended.returncode == 2 and "0 of 4 trips solved" in ended.stdout
    error = ended.stderr.splitlines()[-1]
    assert "fleet.toml: trips: none of 4 could be run, trip 'a' because of" in error and "no such file" in error
    assert len((tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()) == 5
    path.write_text(re.sub(r"^train = .*$", r'train = "a\\u0000b"', FLEET, flags=re.MULTILINE), encoding="utf-8")
    ended = run("reference", "--fleet", path, "--json", tmp_path / "a.json", "--resume")
    assert ended.returncode == 2 and "Traceback" not in ended.stderr and "could be run, trip 'a'" in ended.stderr
    # What a trip waits at its stops is told where the time left is too short.
    path.write_text(FLEET.replace("time_s = 20.0, to_m = 1250.0", "time_s = 20.0, stops = true"), encoding="utf-8")
    assert "20 s is no more than the 60 s of waiting at stops" in run("reference", "--fleet", path).stdout


def test_whole_numbers_stay_numbers_in_a_table(tmp_path):
    written = tmp_path / "a.csv"
    row = {"zero": 0, "negative": -3, "small": -0.5, "none": None}
    _write_csv(written, tuple(row), [row])
    assert written.read_text(encoding="utf-8").splitlines()[1] == "0,-3,-0.5,"


def test_options_that_do_not_go_together_are_refused(fleet):
    with pytest.raises(WorkbenchError, match="--fleet: names lines, trains and times itself"):
        said("--fleet", fleet, "--time", 100)
    with pytest.raises(WorkbenchError, match="--resume: needs --json"):
        said("--fleet", fleet, "--resume")
    with pytest.raises(WorkbenchError, match="are missing: name the files"):
        said()
