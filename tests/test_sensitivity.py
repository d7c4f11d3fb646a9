"""Sobol' indices of a function whose indices are known, through the same path as a file's, and of a short scenario."""

import json
import math
from copy import copy
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scenarios import PROOFS, YANG

from workbench.cli.loading import load
from workbench.errors import InputError
from workbench.files.toml import read_toml
from workbench.model.sensitivity import Sensitivity
from workbench.paper.reproduction import Reproduction, _run_one
from workbench.paper.sensitivity import (
    CSV_NAME,
    JOURNAL_NAME,
    _evaluate,
    drawn,
    sensitivity,
    sensitivity_lines,
    sensitivity_table,
)
from workbench.paper.sobol import design, indices
from workbench.paper.study import varied
from workbench.simulate.journal import Journal
from workbench.trains.scenario import Variant, changed_scenario

ENDS = (-math.pi, math.pi)


def ishigami(_shared, values):
    """Ishigami and Homma 1990, with a = 7 and b = 0.1."""
    return (math.sin(values["x1"]) + 7 * math.sin(values["x2"]) ** 2 + 0.1 * values["x3"] ** 4 * math.sin(values["x1"]))


def with_table(**changes):
    stated = Sensitivity(**({"ranges": dict.fromkeys(("x1", "x2", "x3"), ENDS), "metric": "f", "samples": 1024,
                             "seed": 1, "resamples": 100} | changes))
    loaded = load(YANG)
    return replace(loaded, record=loaded.scenario.model_copy(update={"joint_sensitivity": stated}))


def test_the_indices_of_ishigamis_function():
    """Known: variance 13.8446; first 0.3139, 0.4424, 0; total 0.5576, 0.4424, 0.2437."""
    found = sensitivity(with_table(), workers=1, evaluate=ishigami)
    assert np.var(found.values[:2048]) == pytest.approx(13.8446, rel=0.03)
    for of, known in ((found.indices.first, (0.3139, 0.4424, 0.0)), (found.indices.total, (0.5576, 0.4424, 0.2437))):
        assert [index.value for index in of] == pytest.approx(known, abs=0.02)
        assert all(index.low <= index.value <= index.high for index in of)
    assert [row[0] for row in sensitivity_table(found).rows] == ["x1", "x2", "x3"]
    assert list(sensitivity_lines(found))[-1].startswith("x1 ")
    clear = sensitivity(with_table(samples=64), workers=1, evaluate=lambda _, v: 5 * v["x1"] + v["x2"])
    assert list(sensitivity_lines(clear))[-1].startswith("x1 decides most of it: 9")


def test_every_run_is_a_row_with_its_values(tmp_path):
    found = sensitivity(with_table(samples=16), tmp_path, workers=1, evaluate=ishigami)
    lines = (tmp_path / CSV_NAME).read_text(encoding="utf-8").splitlines()
    assert lines[0] == "x1,x2,x3,f" and len(lines) == 1 + 5 * 16
    rows = [[float(text) for text in line.split(",")] for line in lines[1:]]
    assert [row[-1] for row in rows] == found.values.tolist()
    assert [ishigami(None, dict(zip(("x1", "x2", "x3"), row, strict=False))) for row in rows] == pytest.approx(
        [row[-1] for row in rows], rel=1e-9)


def test_an_interrupted_sweep_goes_on_and_ends_as_one_that_was_not(tmp_path):
    loaded, count = with_table(samples=16), 16 * 5

    class StopError(Exception):
        pass

    def stop(done, _total):
        if done == 30:
            raise StopError

    with pytest.raises(StopError):
        sensitivity(loaded, tmp_path, False, 1, stop, ishigami)
    seen = []
    found = sensitivity(loaded, tmp_path, True, 1, lambda done, total: seen.append((done, total)), ishigami)
    assert seen[0] == (31, count) and seen[-1] == (count, count)
    assert found.values.tolist() == sensitivity(loaded, None, False, 1, evaluate=ishigami).values.tolist()
    with pytest.raises(InputError, match="values and code"):
        sensitivity(with_table(samples=32), tmp_path, True, 1, evaluate=ishigami)
    header = json.loads((tmp_path / JOURNAL_NAME).read_text(encoding="utf-8").splitlines()[0])
    with Journal(tmp_path / JOURNAL_NAME, header, True) as journal:
        journal.append({"point": 1e9})
    with pytest.raises(InputError, match="no point of this sweep"):
        sensitivity(loaded, tmp_path, True, 1, evaluate=ishigami)


def test_runs_that_fail_count_as_what_is_stated_or_are_refused():
    def fails(shared, values):
        return None if values["x1"] > 2 else values["x1"]

    with pytest.raises(InputError, match=r"joint_sensitivity.failed: is missing: \d+ of 80 runs fail, the first with"):
        sensitivity(with_table(samples=16), workers=1, evaluate=fails)
    found = sensitivity(with_table(samples=16, failed=50.0), workers=1, evaluate=fails)
    assert found.failed == np.sum(found.values == 50.0) > 0
    assert any("fail and count as 50" in line for line in sensitivity_lines(found))
    assert "none of these values matters" in list(sensitivity_lines(sensitivity(
        with_table(samples=16), workers=1, evaluate=lambda *_: 2.0)))[-1]


@settings(max_examples=20, deadline=None)
@given(st.lists(st.floats(0.1, 5.0), min_size=1, max_size=4), st.integers(0, 5))
def test_of_a_sum_first_and_total_indices_are_the_shares_of_the_variance(weights, seed):
    values = design(len(weights), 512, seed) @ np.array(weights)
    found = indices(values, len(weights), seed, 20)
    shares = np.array(weights) ** 2 / np.sum(np.array(weights) ** 2)
    assert [index.value for index in found.first] == pytest.approx(shares, abs=0.03)
    assert [index.value for index in found.total] == pytest.approx(shares, abs=0.03)


def test_a_scenario_is_run_with_all_values_at_once():
    loaded = load(YANG)
    stated = Sensitivity(ranges={"train.mass_kg": (150e3, 250e3), "disturbance.amplitude_mps2": (0.001, 0.1)},
                         metric="position_rms", controller="pid", samples=2, seed=1, logarithmic=(
                             "disturbance.amplitude_mps2",), set={"simulation.dwell_s": 1.0})
    points = drawn(stated)
    assert points.shape == (8, 2) and points[:, 1].min() >= 0.001 and points[:, 0].max() <= 250e3
    record = loaded.scenario.model_copy(update={"joint_sensitivity": stated})
    of = replace(loaded, record=record)
    found = sensitivity(of, workers=1)
    assert np.isfinite(found.values).all() and np.ptp(found.values) > 0
    for change, words in (({"metric": "energy"}, "is no number of a run"), ({"controller": "nobody"}, "is none"),
                          ({"ranges": {"train.mass": (1.0, 2.0)}, "logarithmic": ()}, "no such key")):
        wrong = replace(of, record=record.model_copy(update={"joint_sensitivity": stated.model_copy(update=change)}))
        with pytest.raises(InputError, match=words):
            sensitivity(wrong, workers=1)


@dataclass(frozen=True)
class Case:
    """A run of a study made up for the test: y = a x, negative where mended is not stated."""

    factor: float
    mended: tuple[str, ...] = ()
    change: int = -1


def test_of_a_papers_study_the_one_run_is_made_that_the_table_names():
    made = []

    def run(study, case):
        made.append(case)
        return case.factor * study["x"] * (1 if case.mended else -1)

    kind = Reproduction(None, lambda study: [Case(2.0), Case(2.0, ("4",)), Case(3.0), Case(2.0, change=0)], run, None,
                        lambda study, case, found: {"y": found}, None, (), (), (), None, None)
    assert _run_one(kind, {"x": 5.0}, {"factor": 2.0}) == {"y": -10.0}  # else as stated
    assert _run_one(kind, {"x": 5.0}, {"factor": 2.0, "mended": ["4"]}) == {"y": 10.0}
    assert made == [Case(2.0), Case(2.0, ("4",))]  # and no other
    for fields, words in (({"gain": 1.0}, "has no 'gain': choose among factor, mended, change"),
                          ({"factor": 4.0}, "no run has factor = 4.0: choose among 2.0, 3.0"),
                          ({"change": -1}, "give factor, too")):
        with pytest.raises(ValueError, match=words):
            _run_one(kind, {"x": 5.0}, fields)


def test_a_study_is_run_as_it_reaches_a_worker_process():
    """How a study is run does not travel: a worker finds it beside the file."""
    loaded = load(PROOFS / "jiao2025")
    stated = loaded.record.joint_sensitivity.model_copy(update={"metric": "mse_0"})
    values = {key: ends[0] for key, ends in stated.ranges.items()}
    sent = copy(loaded)  # by what goes to a worker
    assert sent.kind is None
    assert _evaluate((sent, stated), values) == _evaluate((loaded, stated), values) > 0


@pytest.mark.parametrize("name", [path.parent.name for path in sorted(PROOFS.glob("*/study.toml"))
                                  if "joint_sensitivity" in read_toml(path)])
def test_each_table_of_a_paper_names_values_and_a_number_that_are_there(name):
    """Every end of every range fits the study; what the runs give is for the benchmark to say."""
    loaded = load(PROOFS / name)
    stated = loaded.record.joint_sensitivity
    for end in (0, 1):
        values = {key: ends[end] for key, ends in stated.ranges.items()}
        if loaded.kind is None:
            assert stated.controller in loaded.scenario.controllers
            changed_scenario(loaded.path, dict(loaded.data), Variant(title="end", set=stated.set | values),
                             loaded.scenario)
        else:
            varied(loaded.study, stated.set | values, "joint_sensitivity.ranges")


@pytest.mark.parametrize(("changes", "words"), [
    ({"samples": 1}, "greater than or equal to 2"), ({"samples": 100}, "no power of two"),
    ({"ranges": {}}, "none given"),
    ({"ranges": {"x": (2.0, 1.0)}}, "is no range"),
    ({"logarithmic": ("x1",)}, "no range of positive numbers")])
def test_tables_that_cannot_be_drawn_are_refused(changes, words):
    with pytest.raises(ValidationError, match=words):
        with_table(**changes)


def test_a_contest_has_no_such_sweep_and_says_so_before_any_run():
    one = with_table()
    with pytest.raises(InputError, match="joint_sensitivity: is for scenarios and studies"):
        sensitivity(replace(one, data={**one.data, "kind": "contest"}))
