"""The found gains of jiao2025 in simulation: what is certified of them is what the trials show."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from proofs.jiao2025.simulation.plans import Case, plan
from proofs.jiao2025.simulation.trials import run_trials
from proofs.jiao2025.study.runs import run_case
from workbench.paper import gain_effects
from workbench.paper.gain_effects import effects, gains_of
from workbench.paper.gain_search import gain_search_of
from workbench.paper.loading import load
from workbench.paper.reproduced import STATED
from workbench.paper.study import varied
from workbench.report.gains import compared, gains_document, gains_result

FOLDER = Path(__file__).parents[3] / "proofs" / "jiao2025"


@pytest.fixture(scope="module")
def done():
    loaded = load(FOLDER)
    report = gains_of(loaded)
    return loaded.study, report, effects(loaded, report, workers=1)


def of(done, gains, law):
    return next(e for e in done[2] if e.gains == gains and e.setting.startswith(f"jiao2025.{law}, "))


def test_a_step_that_is_proved_monotone_gets_worse_in_no_trial_and_learns_more_slowly(done):
    stated, found = of(done, "stated", "fixed_estimate"), of(done, "monotone", "fixed_estimate")
    assert found.numbers["trials_worse"] == 0 < stated.numbers["trials_worse"]
    assert found.numbers["mse_150"] > stated.numbers["mse_150"]
    sentence = next(s for s in compared(done[2]) if "'monotone'" in s)
    assert "better in number of trials with a larger error than the one before" in sentence
    assert "worse in mean squared error of trial 50, mean squared error of trial 100" in sentence


def test_the_contracting_law_is_far_ahead_of_any_step_of_14(done):
    found = of(done, "difference", "pd_difference")
    assert found.numbers["mse_50"] < 1e-4 * of(done, "stated", "icfdl").numbers["mse_50"]


def test_where_trials_repeat_the_law_contracts_as_fast_as_is_certified(done):
    """From trial to trial by the certified factor, by that of the recursion once the speeds are in their range."""
    study, report, _ = done
    found = next(s for s in report.found if s.name == "difference")
    certified = next(q for q in report.quantities if q.certificate == "jiao2025:difference")
    repeated = {"line.seen_by": "desired", "trials.shortest_length_k": 1999}
    other = varied(study, {**found.changes, **repeated}, "test")
    mse = run_trials(plan(other, Case("kN", "jiao2025.pd_difference", 0))).column("mse")[:13]
    ratios = np.sqrt(mse[1:] / mse[:-1])
    assert ratios.max() <= certified.proved
    assert ratios[mse[:-1] < 1].max() <= certified.check
    assert ratios[-1] > 0.9 * certified.check  # and hardly faster, so that the bound says something


def test_what_the_study_has_run_is_not_run_again(done, monkeypatch):
    study, report, alone = done
    loaded, again = load(FOLDER), []
    search = gain_search_of(loaded)
    cases = {Case("kN", task.values["law"], study.trials.seed) for task in search.tasks(report) if not task.changes}
    runs = {case: run_case(study, case) for case in cases}

    def counted(study, case):
        again.append(case)
        return run_case(study, case)

    own = replace(search.run.__self__, make=counted)
    monkeypatch.setattr(gain_effects, "gain_search_of", lambda _: replace(search, run=own.run, had=own.had))
    assert effects(loaded, report, 1, runs=runs) == alone
    assert len(again) == len([task for task in search.tasks(report) if task.changes]) < len(alone) - 3


def test_a_change_is_known_by_its_values():
    study = load(FOLDER).study
    last = len(study.changes) - 1
    assert study.number_of({}) == study.number_of({"learning.rho": study.learning.rho}) == STATED
    assert study.number_of(study.changes[last].set) == last
    assert study.number_of({"learning.rho": 0.123}) is None


def test_document_and_tables_hold_every_run(done):
    _, report, runs = done
    document = json.loads(json.dumps(gains_document(report, runs), allow_nan=False))
    assert len(document["effects"]) == len(runs)
    assert {s["name"] for s in document["found"]} == {s.name for s in report.found}
    result = gains_result(report, runs)
    assert sum(len(t.rows) for t in result.tables if t.title.startswith("simulated")) == len(runs)
    assert [why for _, why in result.failures] == [e.failed for e in runs if e.failed]
