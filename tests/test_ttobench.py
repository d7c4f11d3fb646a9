"""TTOBench files: the public ones, the same values in other units, and files that are wrong in every way."""

import copy
import json
import math
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from workbench.errors import InputError
from workbench.optimal.inputs.files import load_line, load_vehicle, notes_together
from workbench.optimal.inputs.line import Line, course
from workbench.optimal.vehicle import ForceLimit, Vehicle

SHARED = Path(__file__).parent.parent.parent / "shared" / "ttobench"
TRACKS, TRAINS = sorted(SHARED.glob("tracks/*.json")), sorted(SHARED.glob("trains/*.json"))
shared = pytest.mark.skipif(not TRACKS, reason="the public files are not here")

META = {"id": "mine", "library version": "TTOBench v1.5", "created by": "a test", "further": [1, 2]}
TRACK = {
    "metadata": META, "altitude": {"unit": "m", "value": 400},
    "stops": {"unit": "m", "values": [0, 2500.0, 9000.0]},
    "speed limits": {"units": {"position": "m", "velocity": "km/h"}, "values": [[0, 90], [2100.5, 140]]},
    "gradients": {"units": {"position": "m", "slope": "permil"}, "values": [[0, 1.5], [3000, -12.5]]},
    "curvatures": {"units": {"position": "m", "radius at start": "m", "radius at end": "m"},
                   "values": [[0, "infinity", "infinity"], [1000, "infinity", -500], [1200, -500, 400],
                              [1400.0, 400, 400], [1700.0, "infinity", "-infinity"]]},
    "tunnels": {"units": {"position": "m", "length": "m", "cross section": "m^2"}, "values": [[4000, 800.5, 44]]},
    "ETCS braking data": {"M_NVAVADH": {"unit": "-", "value": 0}},
}
TRAIN = {
    "metadata": META, "num seats": {"unit": "-", "value": 167}, "length": {"unit": "m", "value": 58.6},
    "mass": {"unit": "kg", "value": 122000.0}, "rho": {"unit": "%", "value": 10},
    "max traction power": {"unit": "kW", "value": 2600.0}, "max reg braking power": {"unit": "kW", "value": 2500.0},
    "max traction force": {"unit": "kN", "value": 200.0}, "max reg braking force": {"unit": "kN", "value": 190.0},
    "max pn braking force": {"unit": "kN", "value": 120.0}, "max acceleration": {"unit": "m/s^2", "value": 1.1},
    "max deceleration": {"unit": "m/s^2", "value": 0.9}, "max speed": {"unit": "km/h", "value": 162},
    "rolling resistance r0": {"unit": "kN", "value": 2.37888},
    "rolling resistance r1": {"unit": "kN/(km/h)", "value": 0.0169},
    "rolling resistance r2": {"unit": "kN/(km/h)^2", "value": 0.000932},
    "efficiency traction": {"unit": "%", "value": 90.0}, "efficiency reg brake": {"unit": "%", "value": 85.0},
    "tunnel resistance": {"units": {"cross section": "m^2", "coefficient": "kN/(km/h)^2"},
                          "values": [[24, 0.0011664], [40, 0.0005184]]},
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("ttobench")


def written(folder: Path, data: object, name: str = "file.json") -> Path:
    path = folder / name
    path.write_text(data if isinstance(data, str) else json.dumps(data), encoding="utf-8")
    return path


def changed(data: dict, **values: object) -> dict:
    """A copy with blocks replaced, by their name with `__` for blanks; None removes one."""
    renamed = {key.replace("__", " "): value for key, value in values.items()}
    return {key: value for key, value in (copy.deepcopy(data) | renamed).items() if value is not None}


def refusal(load, path: Path) -> str:
    with pytest.raises(InputError) as caught:
        load(path)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert message.isprintable() and len(message) < 400 + len(str(path))
    return message.removeprefix(str(path))


@shared
@pytest.mark.parametrize("train", TRAINS, ids=lambda p: p.stem)
@pytest.mark.parametrize("track", TRACKS, ids=lambda p: p.stem)
def test_every_public_track_is_a_course_for_every_public_train(track, train):
    (line, _), (vehicle, notes) = load_line(track), load_vehicle(train)
    raw = json.loads(track.read_text(encoding="utf-8"))
    found = course(line, vehicle, 0.0, line.length_m, line.stops_between(0.0, line.length_m))
    assert [0.0, *found.stops_m, line.length_m] == raw["stops"]["values"]
    assert found.length_m == raw["stops"]["values"][-1]
    fastest = min(max(v for _, v in raw["speed limits"]["values"]) / 3.6, vehicle.max_speed_mps)
    assert max(found.limit_mps) == pytest.approx(fastest, rel=1e-15)
    steepest = max(g for _, g in raw["gradients"]["values"])
    assert found.force_n.max() <= vehicle.mass_kg * 9.80665e-3 * (max(steepest, 0) + 650 / (340.1 - 55)) + 1e-6
    tells = bool(notes_together(line, vehicle))
    assert tells == ("tunnels" in raw and not vehicle.tunnel_drag)
    assert any("'length'" in note for note in notes) == (vehicle.length_m == 0)


@shared
def test_the_public_intercity_in_si_typed_by_hand():
    vehicle, notes = load_vehicle(SHARED / "trains" / "NL_Intercity_VIRM6.json")
    assert vehicle == Vehicle(
        "NL_Intercity_VIRM6", 391000.0, (5854.0, 74.16, 12.96), ForceLimit(213900.0, 2157000.0),
        ForceLimit(142500.0, 3616000.0), 273500.0, rotating_fraction=0.06, max_deceleration_mps2=0.66,
        max_speed_mps=140 / 3.6, traction_efficiency=0.875, regenerative_efficiency=0.7)
    assert notes == ("no 'length': the train is taken as a point",)


def test_a_track_in_si(folder):
    line, notes = load_line(written(folder, TRACK))
    assert notes == ()
    assert (line.name, line.length_m, line.stops_m) == ("mine", 9000.0, (0.0, 2500.0, 9000.0))
    assert line.limits == ((0.0, 25.0), (2100.5, pytest.approx(140 / 3.6, rel=1e-15)))
    assert line.grades == ((0.0, 1.5), (3000.0, -12.5))
    assert line.curves == ((0.0, 0.0, 0.0), (1000.0, 0.0, -1 / 500), (1200.0, -1 / 500, 1 / 400),
                           (1400.0, 1 / 400, 1 / 400), (1700.0, 0.0, 0.0))
    assert (line.tunnels[0].start_m, line.tunnels[0].length_m, line.tunnels[0].cross_section_m2) == (4000, 800.5, 44)
    assert line.curve_rule == "roeckl"


# The same values in other units, moved by hand; the decimals are exact, so that the floats must be the same.
OTHER_UNITS = {
    "length": ("km", 0.0586), "mass": ("t", 122), "rho": ("-", 0.1), "max__traction__power": ("MW", 2.6),
    "max__reg__braking__power": ("W", 2500000), "max__traction__force": ("N", 2e5),
    "max__reg__braking__force": ("N", 190000), "max__speed": ("m/s", 45), "rolling__resistance__r0": ("N", 2378.88),
    "rolling__resistance__r1": ("N/(m/s)", 60.84), "rolling__resistance__r2": ("N s^2/m^2", 12.07872),
    "efficiency__traction": ("-", 0.9), "efficiency__reg__brake": ("-", 0.85),
}


def test_the_same_train_in_other_units_is_the_same_vehicle(folder):
    expected, _ = load_vehicle(written(folder, TRAIN))
    every = {key: {"unit": unit, "value": value} for key, (unit, value) in OTHER_UNITS.items()}
    every["tunnel__resistance"] = {"units": {"cross section": "m^2", "coefficient": "N/(m/s)^2"},
                                   "values": [[40, 6.718464], [24, 15.116544]]}
    assert load_vehicle(written(folder, changed(TRAIN, **every)))[0] == expected
    for key, block in every.items():
        assert load_vehicle(written(folder, changed(TRAIN, **{key: block})))[0] == expected


def test_the_same_track_in_other_units_is_the_same_line(folder):
    expected, _ = load_line(written(folder, TRACK))
    other = changed(
        TRACK, stops={"unit": "km", "values": [0, 2.5, 9]},
        speed__limits={"units": {"position": "km", "velocity": "m/s"}, "values": [[0, 25]]},
        gradients={"units": {"position": "km", "slope": "%"}, "values": [[0, 0.15], [3, -1.25]]},
        tunnels={"units": {"position": "km", "length": "km", "cross section": "m^2"}, "values": [[4, 0.8005, 44]]})
    other["curvatures"] = {"units": {"position": "km", "radius at start": "km", "radius at end": "km"}, "values": [
        [x if isinstance(x, str) else x / 1000 for x in row] for row in TRACK["curvatures"]["values"]]}
    found, _ = load_line(written(folder, other))
    assert (found.stops_m, found.grades, found.tunnels) == (expected.stops_m, expected.grades, expected.tunnels)
    assert found.curves == expected.curves
    assert found.limits == expected.limits[:1]


def test_what_is_left_out_has_its_default_and_a_note(folder):
    least = ("metadata", "mass", "max traction force", "max pn braking force", "rolling resistance r0",
             "rolling resistance r1", "rolling resistance r2")
    vehicle, notes = load_vehicle(written(folder, {key: TRAIN[key] for key in least}))
    assert (vehicle.rotating_fraction, vehicle.length_m, vehicle.tunnel_drag) == (0.0, 0.0, ())
    assert (vehicle.traction_efficiency, vehicle.regenerative_efficiency) == (1.0, 0.0)
    assert vehicle.regenerative == ForceLimit(0.0)
    assert {vehicle.max_speed_mps, vehicle.max_acceleration_mps2, vehicle.traction.power_w} == {math.inf}
    assert len(notes) == 4
    bare, _ = load_line(written(folder, {key: TRACK[key] for key in ("metadata", "stops", "speed limits")}))
    assert (bare.grades, bare.curves, bare.tunnels) == (((0.0, 0.0),), (), ())
    (_, told), (without, _) = load_line(written(folder, changed(TRACK, wind=3))), load_vehicle(written(
        folder, changed(TRAIN, tunnel__resistance=None)))
    assert told == ("the block 'wind' is not known and was not used",)
    assert "tunnels" in notes_together(load_line(written(folder, TRACK))[0], without)[0]


def _limits(*rows: object) -> dict:
    return {"speed__limits": {"units": {"position": "m", "velocity": "km/h"}, "values": list(rows)}}


def _curves(*rows: object) -> dict:
    return {"curvatures": TRACK["curvatures"] | {"values": list(rows)}}


NEST: list = []
for _ in range(60):
    NEST = [NEST]

TRACK_MISTAKES = {
    "no stops": ({"stops": None}, "stops", "add it"), "a train": (TRAIN | {"stops": None}, "stops", "train's file"),
    "one stop": ({"stops": {"unit": "m", "values": [0]}}, "stops.values", "at least"),
    "stops back": ({"stops": {"unit": "m", "values": [0, 9, 8]}}, "stops.values[2]", "sort"),
    "stops twice": ({"stops": {"unit": "m", "values": [0, 9, 9]}}, "stops.values[2]", "once"),
    "empty stops": ({"stops": {"unit": "m", "values": []}}, "stops.values", "correct it"),
    "unit of stops": ({"stops": {"unit": "mi", "values": [0, 9]}}, "stops", "convert to one of m, km"),
    "late limits": (_limits([10, 90]), "speed limits.values[0]", "from 0 on"),
    "limits twice": (_limits([0, 90], [500, 60], [500, 70]), "speed limits.values[2]", "sort"),
    "limit beyond": (_limits([0, 90], [9000, 60]), "speed limits.values[1]", "beyond the line"),
    "limit NaN": (_limits([0, math.nan]), "line ", "NaN is no number of JSON: give a number"),
    "limit text": (_limits([0, "90"]), "speed limits.values[0][1]", "valid number"),
    "limit bool": (_limits([0, True]), "speed limits.values[0][1]", "valid number"),
    "limit huge": (_limits([0, 10**400]), "speed limits.values[0][1]", "valid number"),
    "limit large": (_limits([0, 1e308]), "speed limits", "correct it"),
    "limit zero": (_limits([0, 0]), "speed limits[0]", "no speed limit"),
    "a short row": (_limits([0]), "speed limits.values[0][1]", "add it"),
    "a long row": (_limits([0, 90, 1]), "speed limits.values[0]", "correct it"),
    "no rows": (_limits(), "speed limits.values", "correct it"), "deep": (_limits(NEST), "", "flatter"),
    "misspelt": ({"gradient": TRACK["gradients"], "gradients": None}, "gradient", "did you mean 'gradients'"),
    "steep": ({"gradients": TRACK["gradients"] | {"values": [[0, 300]]}}, "gradients[0]", "its unit"),
    "column": ({"gradients": TRACK["gradients"] | {"units": {"position": "m"}}}, "gradients", "units.slope is missing"),
    "radius 0": (_curves([0, 0, 100]), "curvatures.values[0][1]", "no railway curve"),
    "radius 30": (_curves([0, 100, -30]), "curvatures.values[0][2]", "no railway curve"),
    "radius word": (_curves([0, 100, "straight"]), "curvatures.values[0][2]", "infinity"),
    "radius inf": (_curves([0, 100, math.inf]), "line ", "Infinity is no number of JSON: give a number"),
    "tunnel": ({"tunnels": TRACK["tunnels"] | {"values": [[8999, 10, 40]]}}, "tunnels.values[0]", "within the line"),
    "version": ({"metadata": {"id": "x", "library version": "TTOBench v2.0"}}, "metadata", "v1.1 to v1.5"),
}
TRAIN_MISTAKES = {
    "unit of mass": ({"mass": {"unit": "lb", "value": 3e5}}, "mass", "convert to one of kg, t"),
    "mass in t": ({"mass": {"unit": "kg", "value": 122}}, "mass", "correct it or its unit"),
    "negative mass": ({"mass": {"unit": "kg", "value": -1e5}}, "mass", "correct it or its unit"),
    "force in N": ({"max__traction__force": {"unit": "N", "value": 200}}, "traction force", "unit"),
    "efficiency": ({"efficiency__traction": {"unit": "-", "value": 90}}, "efficiency", "per cent"),
    "no brake": ({"max__reg__braking__force": None, "max__reg__braking__power": None, "max__pn__braking__force": None},
                 "braking", "no brake"),
    "power alone": ({"max__reg__braking__force": None}, "max reg braking force", "add it"),
    "negative r1": ({"rolling__resistance__r1": {"unit": "N/(m/s)", "value": -3}}, "resistance", "signs"),
    "rho as a factor": ({"rho": {"unit": "-", "value": 1.06}}, "rotating mass", "its unit"),
    "speed": ({"max__speed": {"unit": "m/s", "value": 300}}, "max speed", "its unit"),
    "a number alone": ({"mass": 122000}, "mass", "unit"), "no value": ({"mass": {"unit": "kg"}}, "mass.value", "add"),
    "areas": ({"tunnel__resistance": TRAIN["tunnel resistance"] | {"values": [[24, 1e-3], [24, 1e-3]]}},
              "tunnel resistance", "twice"),
    "a track": ({"mass": None, "stops": TRACK["stops"]}, "mass", "track's file"),
}


@pytest.mark.parametrize("mistake", TRACK_MISTAKES)
def test_a_mistake_in_a_track_is_named_with_key_and_remedy(mistake, folder):
    values, key, words = TRACK_MISTAKES[mistake]
    message = refusal(load_line, written(folder, changed(TRACK, **values)))
    assert message.startswith(f": {key}") and words in message


@pytest.mark.parametrize("mistake", TRAIN_MISTAKES)
def test_a_mistake_in_a_train_is_named_with_key_and_remedy(mistake, folder):
    values, key, words = TRAIN_MISTAKES[mistake]
    message = refusal(load_vehicle, written(folder, changed(TRAIN, **values)))
    assert message.startswith(f": {key}") and words in message


@pytest.mark.parametrize("load", [load_line, load_vehicle])
@pytest.mark.parametrize(("text", "words"), [
    ("", "not valid JSON"), ("{", "not valid JSON"), ("[]", "no JSON object"), ("3", "no JSON object"),
    ("null", "no JSON object"), ("[" * 100_000, "nested too deeply"), ('{"a":' * 100_000, "nested too deeply"),
    ('{"a": 1' + "0" * 9000 + "}", "not valid JSON"), ('{"mass": 1, "mass": 2}', "stands twice"),
    (json.dumps({"a": NEST}), "nested too deeply"),
])
def test_what_is_no_json_table_is_refused(folder, load, text, words):
    assert words in refusal(load, written(folder, text))


@pytest.mark.parametrize("load", [load_line, load_vehicle])
def test_what_cannot_be_read_is_refused(folder, load):
    assert "no such file" in refusal(load, folder / "missing.json")
    (folder / "sub.json").mkdir(exist_ok=True)
    assert "is a folder" in refusal(load, folder / "sub.json")
    (folder / "latin.json").write_bytes(b'{"a": "\xe9"}')
    assert "UTF-8" in refusal(load, folder / "latin.json")
    assert ".toml" in refusal(load, written(folder, TRACK, "track.txt"))


JUNK = st.one_of(
    st.none(), st.booleans(), st.integers(), st.just(10**400), st.floats(), st.text(max_size=8), st.just([]),
    st.just({}), st.just(NEST), st.lists(st.integers(-5, 5), max_size=3),
    st.sampled_from(["infinity", "km", "kN", "%"]),
    st.dictionaries(st.sampled_from(["unit", "value", "values", "units"]), st.integers(), max_size=2))


@st.composite
def mutated(draw, original: dict) -> dict:
    """The document with a few places changed, removed or doubled, at any depth."""
    data = copy.deepcopy(original)
    for _ in range(draw(st.integers(1, 3))):
        place: object = data
        while True:
            keys = list(place) if isinstance(place, dict) else list(range(len(place)))
            if not keys:
                break
            key = draw(st.sampled_from(keys))
            if isinstance(place[key], dict | list) and place[key] and draw(st.integers(0, 3)):
                place = place[key]
                continue
            match draw(st.sampled_from(["change", "scale", "remove", "rename"])):
                case "change":
                    place[key] = copy.deepcopy(draw(JUNK))
                case "scale" if type(place[key]) is float or (type(place[key]) is int and abs(place[key]) < 2**53):
                    place[key] = place[key] * draw(st.sampled_from([-1, 0, 1e-3, 1e3, 1e300, 0.999]))
                case "rename" if isinstance(place, dict):
                    place[draw(st.text(max_size=5))] = place.pop(key)
                case _:
                    del place[key]
            break
    return data


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(mutated(TRACK), mutated(TRAIN))
def test_a_mutated_file_loads_and_runs_or_is_refused_in_one_line(folder, track, train):
    loaded: list[object] = []
    for load, data, original in ((load_line, track, TRACK), (load_vehicle, train, TRAIN)):
        try:
            loaded.append(load(written(folder, data))[0])
        except InputError as refused:
            assert str(refused).startswith(str(folder)) and str(refused).isprintable()
            loaded.append(load(written(folder, original))[0])
    line, vehicle = loaded
    assert isinstance(line, Line) and isinstance(vehicle, Vehicle)
    try:
        assert course(line, vehicle, 0.0, line.length_m, line.stops_between(0.0, line.length_m)).length_m > 0
    except InputError as refused:
        assert str(refused).isprintable()
