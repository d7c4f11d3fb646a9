"""From which trial on a learner is ahead, and what is said of learners beside MPC."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.paper.cells import Column, Phrase
from workbench.paper.comparison import STEP
from workbench.paper.drivers import Drivers
from workbench.paper.learning_comparison import (
    LearningComparison,
    jerk_rms,
    rises,
    row_cells,
    trial_columns,
    trial_curve,
)
from workbench.paper.statistics import ahead_from
from workbench.paper.study_tables import run_table

COLUMNS = {"speed_rms": Column("speed RMS", "m/s"), "jerk_rms": Column("jerk RMS", "m/s³"), "step_s": STEP}
DRIVERS = Drivers({"learner": "the learner", "mpc_linear": "linear MPC"}, lambda study: {"here": "the line"},
                  lambda study, name: {}, lambda *_: {})
STUDY = SimpleNamespace(
    trials=SimpleNamespace(count=3),
    tuning=SimpleNamespace(set={}, runs=1, places=("here",), objective=SimpleNamespace(units={"speed_rms": 0.1})))


@settings(max_examples=80, deadline=None)
@given(st.lists(st.floats(0.0, 10.0), min_size=1, max_size=30), st.floats(0.1, 10.0), st.integers(0, 1))
def test_ahead_is_the_first_trial_from_which_all_are_below(errors, rival, first):
    plain = next((first + i for i in range(len(errors)) if all(e < rival for e in errors[i:])), None)
    assert ahead_from(np.array(errors), rival, first) == plain


def test_jerk_is_the_second_difference_of_all_columns():
    t = np.arange(50) * 0.1
    assert jerk_rms(0.5 * 3.0 * t**2, 0.1) == pytest.approx(3.0)
    assert jerk_rms(np.stack([1.5 * t**2, 0 * t], axis=1), 0.1) == pytest.approx(3.0 / 2**0.5)


def test_rises_and_curves_count_trials():
    errors = np.array([3.0, 4.0, 2.0, 2.0, 2.5])
    assert rises(errors) == 2
    assert trial_curve("x", errors, 1).x.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]


def test_a_table_of_runs_has_each_heading_beside_what_a_run_says():
    runs = {"a": np.array([3.0, 2.0, 2.5]), "b": np.array([5.0])}  # b ended after its first trial
    table = run_table("Runs", "a test", ("law",), (((name,), errors) for name, errors in runs.items()), (
        *trial_columns(Column("error", "mm", 1e-3), lambda errors: errors, (0, 2), 0), ("trials worse", rises)))
    assert table.headings == ("law", "error, trial 0 (mm)", "error, trial 2 (mm)", "trials worse")
    assert table.rows == (("a", 3.0, 2.5, 1), ("b", 5.0, None, 0))
    assert table.values[0] == ("a", 3000.0, 2500.0, 1)


def test_a_failed_run_has_no_numbers_but_the_time_of_a_step():
    assert row_cells({"failed": "at once", "step_s": 2e-6}, COLUMNS) == ("fails", None, 2e-6)
    assert row_cells({"failed": None, "speed_rms": 0.5, "jerk_rms": 1.0, "step_s": 2e-6}, COLUMNS) == (0.5, 1.0, 2e-6)


@pytest.mark.parametrize(("first", "trial"), [(0, 2), (1, 3)])
def test_learners_are_ahead_from_the_same_trial_in_table_and_sentence(first, trial):
    learner = {"failed": None, "speed_rms": 0.1, "jerk_rms": 0.3, "step_s": 1e-6,
               "trials": {"speed_rms": np.array([0.9, 0.5, 0.2, 0.1])}}
    rival = {"failed": None, "speed_rms": 0.4, "jerk_rms": 0.2, "step_s": 5e-5}
    rows = {("here", "learner", False): learner, ("here", "mpc_linear", False): rival}
    compared = LearningComparison(replace(DRIVERS, first_trial=first), COLUMNS, ("speed_rms",))
    table = next(compared.tables(STUDY, rows))
    assert [row[-1] for row in table.rows] == [Phrase("trial {}", (trial,)), None]
    assert table.text[1] == ("linear MPC", "0.400", "0.200", "50.0", "—")
    (sentence,) = compared.findings(STUDY, rows)
    assert sentence.startswith("As stated: the learner has the smallest speed RMS, 0.100 m/s, then linear MPC with "
                               "0.400")
    assert sentence.endswith(f"the learner is ahead of linear MPC from trial {trial} on.")
    (plot,) = compared.plots(STUDY, rows)
    assert [curve.x[0] for curve in plot.curves] == [first, first]


def test_a_rival_that_fails_is_no_rival():
    learner = {"failed": None, "speed_rms": 0.1, "jerk_rms": 0.3, "step_s": 1e-6,
               "trials": {"speed_rms": np.array([0.9, 0.1])}}
    rows = {("here", "learner", True): learner, ("here", "mpc_linear", True): {"failed": "lost", "step_s": 5e-5}}
    compared = LearningComparison(DRIVERS, COLUMNS, ("speed_rms",))
    assert [row[-1] for row in next(compared.tables(STUDY, rows)).rows] == [None, None]
    assert "ahead" not in next(compared.findings(STUDY, rows))
    assert len(next(compared.plots(STUDY, rows)).curves) == 1


def test_several_places_are_summed_up_in_a_sentence_a_learner():
    of = replace(DRIVERS, places=lambda study: {"here": "the line", "there": "the hill", "far": "the valley"})
    learner = {"failed": None, "speed_rms": 0.1, "jerk_rms": 0.3, "step_s": 1e-6,
               "trials": {"speed_rms": np.array([0.9, 0.5, 0.2, 0.1])}}
    rival = {"failed": None, "speed_rms": 0.4, "jerk_rms": 0.2, "step_s": 5e-5, "counters": {"qp": 7}}
    better = rival | {"speed_rms": 0.05}
    rows = {("here", "learner", False): learner, ("here", "mpc_linear", False): rival,
            ("there", "learner", False): learner, ("there", "mpc_linear", False): better,
            ("far", "learner", False): {"failed": "lost", "step_s": 1e-6}, ("far", "mpc_linear", False): rival}
    compared = LearningComparison(of, COLUMNS, ("speed_rms",), "place", note=lambda study: "Both know the line.")
    assert list(compared.findings(STUDY, rows))[1:] == [
        "Beside MPC, which knows the train and drives it once, in speed RMS: the learner finishes in 2 of 3 places and "
        "overtakes linear MPC in 1 (at trials 3) of them within 3 trials."]
    table = next(compared.tables(STUDY, rows))
    assert len(table.rows) == 6 and "Both know the line. MPC counted quadratic programs 21." in table.note
    assert len(list(compared.plots(STUDY, rows))) == 1, "the tuning's place alone is drawn"


def test_a_first_trial_stands_above_the_last():
    learner = {"failed": None, "speed_rms": 0.1, "jerk_rms": 0.3, "step_s": 1e-6,
               "trials": {"speed_rms": np.array([0.9, 0.1])}, "first": {"failed": None, "speed_rms": 0.9}}
    compared = LearningComparison(DRIVERS, COLUMNS, ("speed_rms",))
    table = next(compared.tables(STUDY, {("here", "learner", False): learner}))
    assert [row[:2] for row in table.rows] == [("the learner, trial 1", 0.9), ("the learner", 0.1)]


def test_without_tuning_all_is_as_stated():
    stated = SimpleNamespace(trials=STUDY.trials, tuning=None, mpc=SimpleNamespace())
    compared = LearningComparison(DRIVERS, COLUMNS, ("speed_rms",))
    assert compared.tasks(stated) == [("here", "learner", False), ("here", "mpc_linear", False)]
    same = {"failed": None, "speed_rms": 0.2, "jerk_rms": 0.3, "step_s": 1e-6}
    rows = dict.fromkeys(compared.tasks(stated), same)
    table = next(compared.tables(stated, rows))
    assert table.title == "Beside MPC, stated" and "tuned" not in table.note
