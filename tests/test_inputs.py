"""Bad input: each mistake becomes one line that names the file, the key and the remedy, and nothing else."""

import shutil
from pathlib import Path

import pytest
from input_mistakes import GRADES, LINE, LINE_MISTAKES, LINE_TEXT, SCENARIO_MISTAKES, TEXT
from refusals import changed, refusal
from scenarios import BENCHMARKS, YANG, name_of, short_scenario, variant_of

from workbench.files.toml import read_toml
from workbench.simulate.law_values import check_controllers
from workbench.trains.scenario import Variant, load_scenario
from workbench.trains.track import load_track


@pytest.fixture
def folder(tmp_path):
    for path in (YANG, LINE):
        shutil.copy(path, tmp_path / path.name)
    return tmp_path


def load_all(path: Path) -> None:
    check_controllers(load_scenario(path), path)


@pytest.mark.parametrize("mistake", SCENARIO_MISTAKES)
def test_a_mistake_in_a_scenario_is_named_with_its_key_and_remedy(mistake, folder):
    old, new, key, words = SCENARIO_MISTAKES[mistake]
    path = folder / YANG.name
    path.write_text(changed(TEXT, old, new), encoding="utf-8")
    message = refusal(load_all, path)
    assert message.startswith(f"{path}: {key}")
    assert words in message
    assert len(message) < 400 + len(str(path))



@pytest.mark.parametrize("mistake", LINE_MISTAKES)
def test_a_mistake_in_a_line_is_named_with_the_lines_own_file(mistake, folder):
    old, new, words = LINE_MISTAKES[mistake]
    path = folder / LINE.name
    path.write_text(changed(LINE_TEXT, old, new), encoding="utf-8")
    message = refusal(load_scenario, folder / YANG.name)
    assert message.startswith(f"{path}: {words}")
    assert message == refusal(load_track, path, True)


def test_a_straight_line_is_written_with_an_infinite_radius(folder):
    path = folder / LINE.name
    path.write_text(changed(LINE_TEXT, "radius_m = 700.0", "radius_m = inf"), encoding="utf-8")
    assert load_track(path).curve[4].radius_m == float("inf")


def test_a_line_too_short_for_its_cruise_speed_is_refused_with_the_length_it_needs(folder):
    short = ("grade = [{ start_m = 0.0, end_m = 900.0, grade_permille = 0.0 }]\n"
             "curve = [{ start_m = 0.0, end_m = 900.0, radius_m = inf }]\n")
    curves = LINE_TEXT[LINE_TEXT.index("curve = [") : LINE_TEXT.index("[source]")]
    text = changed(changed(LINE_TEXT, GRADES + curves, short), "length_m = 53880.0", "length_m = 900.0")
    (folder / LINE.name).write_text(text, encoding="utf-8")
    path = folder / YANG.name
    message = refusal(load_scenario, path)
    assert message.startswith(f"{path}: reference: desired curve: 32.57 m/s cannot be reached")
    assert "within 900 m" in message
    assert "lower the cruise speed" in message


def test_a_scenario_without_controllers_is_refused(folder):
    path = folder / YANG.name
    before, after = TEXT[: TEXT.index("[controllers.")], TEXT[TEXT.index("[uncertainty]") :]
    after = after[: after.index("[printed_table]")]
    path.write_text(f"{before}[controllers]\n{after}", encoding="utf-8")
    assert "controllers: none given: add a [controllers.<name>] table" in refusal(load_scenario, path)


def test_neurons_for_a_law_without_a_network_are_refused():
    neurons = short_scenario().controllers["rbf_pid"].neurons.model_dump()
    scenario = short_scenario(controllers__pid__neurons=neurons)
    message = refusal(check_controllers, scenario, "my.toml")
    assert message == "my.toml: controllers.pid.neurons: 'pid' has no hidden neurons: remove it"
    scenario = short_scenario(controllers__mpc__neurons=neurons)
    assert "controllers.mpc.neurons: 'mpc.tracking' has none" in refusal(check_controllers, scenario)


def test_neurons_missing_for_a_law_with_a_network_are_asked_for():
    spec = short_scenario().controllers["rbf_pid"].model_copy(update={"neurons": None})
    scenario = short_scenario().model_copy(update={"controllers": {"rbf_pid": spec}})
    message = refusal(check_controllers, scenario, "my.toml")
    assert message.startswith("my.toml: controllers.rbf_pid.neurons: is missing: 'yang2021.rbf_pid' has hidden")


BAD_FILES = {
    "missing": (lambda path: path.unlink(), "no such file: check the path"),
    "empty": (lambda path: path.write_text(""), "is empty"),
    "blank": (lambda path: path.write_text(" \n\n"), "is empty"),
    "a folder": (lambda path: (path.unlink(), path.mkdir()), "is a folder: name a .toml file"),
    "binary": (lambda path: path.write_bytes(bytes(range(256)) * 9), "is not UTF-8 text: save it as UTF-8"),
    "zeros": (lambda path: path.write_bytes(bytes(100)), "is not valid TOML"),
    "not TOML": (lambda path: path.write_text('{"mass_kg": 2}'), "is not valid TOML"),
    "UTF-16": (lambda path: path.write_bytes("version = 1".encode("utf-16")), "is not UTF-8 text"),
    "a loop of links": (lambda path: (path.unlink(), path.symlink_to(path)), "cannot be read"),
}


@pytest.mark.parametrize(("spoil", "words"), BAD_FILES.values(), ids=BAD_FILES.keys())
@pytest.mark.parametrize("which", [YANG.name, LINE.name])
def test_a_file_that_cannot_be_used_is_named(which, spoil, words, folder):
    spoil(folder / which)
    assert refusal(load_scenario, folder / YANG.name).startswith(f"{folder / which}: {words}")


def test_a_file_of_another_kind_is_told_from_a_mistake_in_one(tmp_path):
    for name, ending in (("laws.py", ": a file whose name ends with .toml is expected"), ("study.toml", ")")):
        (tmp_path / name).write_text("import sympy\n")
        assert refusal(load_scenario, tmp_path / name).endswith(ending)


def test_a_file_without_permission_is_named(monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    # File modes do not stop root, who may run the tests; and nothing shall have been read before.
    monkeypatch.setattr("workbench.files.text.contents", refuse)
    monkeypatch.setattr("workbench.files.toml._tables", {})
    message = refusal(load_scenario, YANG)
    assert message == f"{YANG}: cannot be read (Permission denied): check its permissions"


@pytest.mark.parametrize("name", ["nowhere/line.toml", "", ".", "a\\u0000b.toml", "\\ud7ff", "x" * 5000])
def test_a_track_that_is_not_there_is_named(name, folder):
    path = folder / YANG.name
    path.write_text(changed(TEXT, "line.toml", name), encoding="utf-8")
    assert refusal(load_scenario, path).startswith(str(folder))


def test_a_variant_that_names_no_value_is_refused():
    for key in ("train.mass_t", "train", "train.mass_kg.x", "", "controllers.nobody.law",
                "uncertainty.factors.0"):
        variant = Variant(title="a test", set={key: 1.0})
        assert refusal(variant_of, YANG, variant).startswith(f"{YANG}: ")
    shorter = variant_of(YANG, Variant(title="a test", set={"reference.ramp_s": 4.0}))
    assert shorter.desired_curve().trip_time_s < load_scenario(YANG).desired_curve().trip_time_s


@pytest.mark.parametrize("path", BENCHMARKS, ids=name_of)
def test_every_shipped_scenario_loads_with_all_its_controllers_and_variants(path):
    scenario = load_scenario(path)
    check_controllers(scenario, path)
    for variant in scenario.variants:
        check_controllers(variant_of(path, variant), path)
    assert set(read_toml(path)["controllers"]) == set(scenario.controllers)
