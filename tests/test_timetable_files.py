"""Timetables from files: what is read, what is refused, and the command that runs by one."""

import json
import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import SHARED as BENCHMARKS
from test_reference_command import HILLS, TRAIN, said

from workbench.errors import InputError, WorkbenchError
from workbench.optimal.bound_checker import main as check_bounds
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.journey import load_timetable
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import least_time

TIMETABLE = BENCHMARKS / "timetables" / "hills.toml"
SHARED = Path(__file__).parent.parent.parent / "shared" / "ttobench"
JOURNEYS = sorted((SHARED / "journeys").glob("*.json"))
UNITS = {"position": "km", "lower time constraint": "min", "upper time constraint": "s",
         "lower speed constraint": "km/h", "upper speed constraint": "m/s"}
ROWS = [[0, 0, 0, 0, 0], [1.0, 1, 90, 36, None], [2.0, None, 200, 0, 0], [2.0, 4, 260, 0, 0], [3.0, None, 400, 0, 0]]


def journey(folder: Path, rows: object = ROWS, track: str = "here", **more: object) -> Path:
    path = folder / "journey.json"
    path.write_text(json.dumps({
        "metadata": {"id": "j", "library version": "TTOBench v1.5", "associated track": track},
        "timing points": {"units": UNITS, "values": rows}} | more), encoding="utf-8")
    return path


def changed(place: int, row: list[object]) -> list[list[object]]:
    return [row if k == place else old for k, old in enumerate(ROWS)]


def test_a_journey_is_read_in_its_units(tmp_path):
    asked = load_timetable(journey(tmp_path), "here", 3000.0, 30.0)
    first, passed, stop, last = asked.timetable.points
    assert (asked.start_mps, asked.end_mps) == (0.0, 0.0)
    assert (first.departure.earliest_s, first.departure.latest_s) == (0.0, 0.0)
    assert (passed.position_m, passed.arrival.earliest_s, passed.arrival.latest_s) == (1000.0, 60.0, 90.0)
    assert passed.slowest_mps == 10.0 and passed.fastest_mps == float("inf") and not passed.stands
    assert stop.stands and stop.dwell_s == 0.0
    assert (stop.departure.earliest_s, stop.departure.latest_s) == (240.0, 260.0)
    assert last.arrival.latest_s == 400.0


def test_a_stop_of_one_row_has_the_least_dwell(tmp_path):
    asked = load_timetable(journey(tmp_path, [row for k, row in enumerate(ROWS) if k != 3]), "here", 3000.0, 25.0)
    assert asked.timetable.points[2].dwell_s == 25.0


def test_a_time_of_day_is_refused_with_the_unit_to_give(tmp_path):
    path = tmp_path / "t.toml"
    path.write_text('name = "t"\n[[point]]\nposition_m = 0.0\nearliest_s = 00:01:20\n')
    with pytest.raises(InputError) as refused:
        load_timetable(path, "here", 3000.0, 30.0)
    assert str(refused.value).startswith(f"{path}: point[0].earliest_s: 00:01:20 is a time of day or a date: give a "
                                         "number in the unit that the key names")


def test_our_own_format_says_the_same(tmp_path):
    own = tmp_path / "t.toml"
    rows = [[1000 * x, None if a is None else 60 * a, b, None if v is None else v / 3.6, w] for x, a, b, v, w in ROWS]
    keys = ("position_m", "earliest_s", "latest_s", "slowest_mps", "fastest_mps")
    points = ", ".join("{" + ", ".join(f"{key} = {float(value)!r}" for key, value in zip(keys, row, strict=True)
                                       if value is not None) + "}" for row in rows)
    own.write_text(f'name = "t"\npoint = [{points}]\n[source]\nname = "assumed: t"\npoint = "assumed: t"\n')
    assert load_timetable(own, "here", 3000.0, 30.0).timetable == load_timetable(
        journey(tmp_path), "here", 3000.0, 30.0).timetable


REFUSED = {
    "another track": ({"track": "elsewhere"}, "associated track: 'elsewhere' is another line than 'here'"),
    "beyond the line": ({"rows": changed(4, [3.5, None, 400, 0, 0])}, r"values\[4\]: 3500 m lies beyond the line"),
    "not in order": ({"rows": changed(1, [2.5, 1, 90, 36, None])}, r"values\[2\]: 2000 m does not come 1 m or more"),
    "times that contradict": ({"rows": changed(1, [1.0, 2, 90, 36, None])}, "120 to 90 s contradict each other"),
    "speeds that contradict": ({"rows": changed(1, [1.0, 1, 90, 72, 10])}, "20 to 10 m/s are no range"),
    "a creep": ({"rows": changed(1, [1.0, 1, 90, 0, 1e-4])}, r"values\[1\]: a passing at no more than"),
    "negative speed": ({"rows": changed(1, [1.0, 1, 90, -1, 10])}, "are no range"),
    "no departure": ({"rows": changed(0, [0, None, 0, 0, 0])}, r"values\[0\]: has no earliest time"),
    "no arrival": ({"rows": changed(4, [3.0, 6, None, 0, 0])}, r"values\[4\]: has no latest time"),
    "two rows that pass": ({"rows": changed(3, [2.0, 4, 260, 0, 5])}, "one row too many at 2000 m"),
    "two rows at the start": ({"rows": [ROWS[0], *ROWS]}, "one row too many at 0 m"),
    "departs before": ({"rows": changed(2, [2.0, 5, 310, 0, 0])}, "before the arrival"),
    "range at an end": ({"rows": changed(4, [3.0, None, 400, 36, 20])}, "range of speeds at an end"),
    "one place": ({"rows": [ROWS[0]]}, "names one place only"),
    "ages": ({"rows": changed(4, [3.0, None, 1e9, 0, 0])}, "is it in seconds"),
    "a text": ({"rows": changed(1, [1.0, "1", 90, 36, None])}, "valid number"),
    "a short row": ({"rows": changed(1, [1.0, 1])}, r"values\[1\]"),
    "no unit": ({"timing points": {"units": {}, "values": ROWS}}, "units.position is missing"),
    "no points": ({"timing points": None}, "timing points"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_mistake_is_one_line_with_file_and_remedy(name, tmp_path):
    more, words = REFUSED[name]
    with pytest.raises(InputError, match=words) as caught:
        load_timetable(journey(tmp_path, **more), "here", 3000.0, 30.0)
    assert "\n" not in str(caught.value) and "journey.json" in str(caught.value)


ANY = st.recursive(st.none() | st.booleans() | st.integers(-10**6, 10**6) | st.floats() | st.text(max_size=5),
                   lambda inner: st.lists(inner, max_size=6) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
                   max_leaves=12)
CELL = st.none() | st.floats(-10, 4000) | st.sampled_from([0, 1, "x", 1e308])


@settings(max_examples=150)
@given(st.one_of(ANY, st.lists(st.lists(CELL, min_size=5, max_size=5), max_size=6)), st.booleans())
def test_garbage_is_an_input_error_and_nothing_else(tmp_path_factory, rows, sorted_rows):
    if sorted_rows and isinstance(rows, list) and all(isinstance(r, list) and r and isinstance(r[0], float)
                                                      for r in rows):
        rows = sorted(rows, key=lambda row: row[0])
    path = tmp_path_factory.getbasetemp() / "garbage.json"
    path.write_text(json.dumps({"metadata": {"id": "j", "library version": "TTOBench v1.5"},
                                "timing points": {"units": UNITS, "values": rows}}), encoding="utf-8")
    try:
        found = load_timetable(path, "here", 3000.0, 30.0)
    except InputError as trouble:
        assert "\n" not in str(trouble)
    else:
        assert len(found.timetable.points) >= 2


def test_every_output_of_a_run_by_timetable(tmp_path):
    text = said(HILLS, TRAIN, "--timetable", TIMETABLE, "--json", tmp_path / "a.json", "--figure", tmp_path / "c.svg",
                "--certificate", tmp_path / "d.json", "--intervals", 400)
    assert check_bounds([str(tmp_path / "d.json")]) == 0
    document = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    rows = document["timing_points"]
    assert [row["kind"] for row in rows] == ["departure", "passing", "arrival", "departure", "passing", "arrival"]
    for row in rows:
        for name in ("time_s", "smooth_time_s", "simulated_time_s"):
            slack = 1e-2 if name == "simulated_time_s" else 1e-6
            assert row["earliest_s"] is None or row[name] >= row["earliest_s"] - slack
            assert row["latest_s"] is None or row[name] <= row["latest_s"] + slack
        assert row["binds"] in (None, "latest", "earliest") and row["price_W"] >= 0
    assert 8.0 <= rows[4]["speed_mps"] <= 20.0
    assert document["smooth"]["window_miss_s"] == 0
    assert any(row["binds"] for row in rows)
    assert document["lower_bound_J"] <= document["energy_J"]
    assert document["gap"] <= 1e-3
    assert len(re.findall(r"\n *(?:departure|passing|arrival) ", text)) == 6
    assert "480–540 s" in (tmp_path / "c.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(("options", "words"), [
    (("--time", 2600), "--time: does not go with --timetable"), (("--stops",), "--stops: does not go"),
    (("--to-m", 9000), "--to-m: does not go"), (("--from-speed", 5), "contradicts the timetable"),
])
def test_options_that_a_timetable_says_are_refused(options, words):
    with pytest.raises(WorkbenchError, match=words):
        said(HILLS, TRAIN, "--timetable", TIMETABLE, *options)


@pytest.mark.skipif(not JOURNEYS, reason="the public instances lie beside the checkout")
def test_the_public_journey_asks_for_more_than_its_speed_limits_allow_any_train():
    """By the files' own numbers: its last leg at the limits all along, without a second for starting or braking."""
    rows = json.loads(JOURNEYS[0].read_text())["timing points"]["values"]
    (from_m, since_s, *_), (to_m, _, by_s, *_) = rows[-2:]
    limits = json.loads((SHARED / "tracks" / "CH_StGallen_Wil.json").read_text())["speed limits"]["values"]
    ends = [*(x for x, _ in limits[1:]), to_m]
    least_s = sum(max(min(end, to_m) - max(x, from_m), 0.0) / (kmh / 3.6) for (x, kmh), end in zip(limits, ends,
                                                                                                strict=True))
    assert least_s == pytest.approx(345.3, abs=0.1) and by_s - since_s == 250.0


@pytest.mark.skipif(not JOURNEYS, reason="the public instances lie beside the checkout")
@pytest.mark.parametrize("train", sorted((SHARED / "trains").glob("*.json")), ids=lambda path: path.stem)
@pytest.mark.parametrize("path", JOURNEYS, ids=lambda path: path.stem)
def test_every_public_journey_is_solved_or_refused_for_a_true_reason(path, train, tmp_path):
    """A refusal names a point and the least delay; the fastest run alone, from the file's numbers, must say so too."""
    track = SHARED / "tracks" / f"{json.loads(path.read_text())['metadata']['associated track']}.json"
    try:
        said(track, train, "--timetable", path, "--json", tmp_path / "a.json")
    except WorkbenchError as trouble:
        found = re.search(r"timing point \d+ at (\S+) m cannot be met: .* by (\S+) s asked, (\S+) s is the earliest.* "
                          r"after \w+ at (\S+) m not before (\S+) s", str(trouble))
        assert found, str(trouble)
        to_m, asked_s, earliest_s, from_m, since_s = map(float, found.groups())
        line, _ = load_line(track)
        quick = least_time(load_vehicle(train)[0], course(line, load_vehicle(train)[0]))
        at = [float(quick.time_s[quick.position_m.searchsorted(x)]) for x in (from_m, to_m)]
        assert since_s + at[1] - at[0] > asked_s + 1
        assert since_s + at[1] - at[0] <= earliest_s + 1
    else:
        assert json.loads((tmp_path / "a.json").read_text())["gap"] <= 1e-3
