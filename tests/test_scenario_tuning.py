"""A scenario's controllers are tuned as a study's: never worse than stated, written, and shown as a variant."""

import re
import shutil

import pytest
from scenarios import YANG, short_scenario

from workbench.cli.loading import load
from workbench.errors import InputError
from workbench.paper.scenario_tuning import tune_scenario
from workbench.paper.tune import tune_run
from workbench.trains.scenario import with_parameters


def nothing(done: int, total: int, what: str) -> None:
    pass


def tuned(scenario, **ranges):
    budget = scenario.tuning.model_copy(update={"runs": 6, "ranges": ranges})
    return scenario.model_copy(update={"tuning": budget})


def test_what_is_found_is_no_worse_than_what_is_stated_and_within_the_ranges():
    scenario = tuned(short_scenario(), pid={"K_p": (0.075, 7.5), "K_d": (0.15, 15.0)},
                     rbf_pid={"K_p": (0.1, 10.0), "eta": (0.02, 2.0)})
    found = tune_scenario(scenario, ["pid", "rbf_pid"], 1, nothing)
    assert list(found) == ["pid", "rbf_pid"]
    for one in found.values():
        assert one.cost <= one.stated < 300.0
        assert 0.05 < one.values["K_p"] < 10.0
    values = found["rbf_pid"].values
    changed = with_parameters(scenario, "rbf_pid", values).controllers["rbf_pid"]
    assert changed.initial["K_p"] == values["K_p"] and "K_p" not in changed.parameters
    assert changed.parameters["eta"] == values["eta"]


@pytest.mark.parametrize(("name", "ranges", "message"), [
    ("nobody", {"K_p": (1.0, 2.0)}, "tuning.ranges.nobody: is no controller of this scenario"),
    ("pid", {"K_q": (1.0, 2.0)}, "tuning.ranges.pid.K_q: is no parameter that this controller states"),
])
def test_ranges_of_what_is_not_there_are_refused(name, ranges, message):
    with pytest.raises(InputError, match=re.escape(message)):
        tune_scenario(tuned(short_scenario(), **{name: ranges}), [name], 1, nothing)


@pytest.fixture
def copied(tmp_path):
    """yang2021's scenario with one controller's tuning, on its own line; nothing here runs it."""
    folder = tmp_path / "own"
    shutil.copytree(YANG.parent, folder, ignore=shutil.ignore_patterns("certificates", "__pycache__"))
    return folder


def test_what_was_found_is_a_variant_of_the_comparison(copied):
    path = copied / "study.toml"
    text = path.read_text(encoding="utf-8")
    before = load(copied).scenario
    path.write_text(f"{text}\n[tuning.found.pid]\nK_p = 1.0\nK_i = 0.2\nK_d = 2.0\n", encoding="utf-8")
    variant = load(copied).scenario.all_variants[-1]
    assert variant.title == "tuned, 24 runs each" and variant.controllers == ("pid",)
    assert variant.set["controllers.pid.parameters.K_d"] == 2.0
    assert before.all_variants == before.variants


def test_a_try_is_not_written(copied):
    before = (copied / "study.toml").read_bytes()
    with pytest.raises(InputError, match="--runs: is for trying"):
        list(tune_run(load(copied), ["pid"], True, 1, nothing, runs=2))
    assert (copied / "study.toml").read_bytes() == before


def test_an_interrupted_search_goes_on_and_ends_as_one_that_was_not(copied, tmp_path):
    path = copied / "study.toml"
    text = path.read_text(encoding="utf-8")
    short = text[text.index("[tuning]"):].partition("runs = ")[2].partition("\n")[0]
    text = text.replace(f"[tuning]\nruns = {short}", "[tuning]\nrestarts = 2\nruns = 4")
    path.write_text(text.replace("[tuning.source]", '[tuning.source]\nrestarts = "assumed: two"'), encoding="utf-8")
    loaded, out = load(copied), tmp_path / "kept"
    assert loaded.scenario.tuning.restarts == 2

    class StopError(Exception):
        pass

    def stop(done, *_):
        raise StopError

    with pytest.raises(StopError):
        list(tune_run(loaded, ["pid"], False, 1, stop, out=out))
    seen = []
    lines = list(tune_run(loaded, ["pid"], False, 1, lambda *now: seen.append(now), out=out, resume=True))
    assert seen == [(2, 2, "pid")], "the first restart is searched again"
    assert lines == list(tune_run(loaded, ["pid"], False, 1, nothing))
    with pytest.raises(InputError, match="--resume: needs the folder"):
        list(tune_run(loaded, ["pid"], False, 1, nothing, resume=True))
    path.write_text(path.read_text(encoding="utf-8").replace("runs = 4", "runs = 6"), encoding="utf-8")
    with pytest.raises(InputError, match="values and code"):
        list(tune_run(load(copied), ["pid"], False, 1, nothing, out=out, resume=True))
