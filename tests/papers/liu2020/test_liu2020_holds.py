"""What liu2020 says, where it holds, and where it does not."""

import numpy as np
import pytest

from proofs.liu2020.steady_run import eigenvalues, implied, largest_step_s
from proofs.liu2020.study.runs import RMS, RunCase, run_case


def outcome_of(study, column, law, disturbance="fast", leak=None):
    outcome = run_case(study, RunCase(column, f"liu2020.{law}", disturbance, leak_rate_per_s=leak))
    assert outcome.failed is None, outcome.failed
    return {name: outcome.row[in_row] for name, in_row in RMS.items()}


def test_more_observer_gain_estimates_better_with_the_term_that_12_prints(short):
    numbers = [outcome_of(short, column, "corrected") for column in (1, 2, 3, 4, 5)]
    for name, factor in (("s_tilde_m", 5), ("v_tilde_mps", 1.2)):
        errors = [n[name] for n in numbers]
        assert errors == sorted(errors, reverse=True) and errors[-1] < errors[0] / factor, name


def test_with_the_term_that_18_has_it_does_not_estimate_the_speed_better(short):
    low, high = (outcome_of(short, column, "feedback_rate") for column in (4, 10))
    assert high["s_tilde_m"] < low["s_tilde_m"] / 20
    assert high["v_tilde_mps"] > 0.5 * low["v_tilde_mps"]
    # The slow eigenvalue is the same for all gains of Table 2 from Value 4 on.
    slow = [max(eigenvalues(short, column, "s_tilde'").real) for column in (5, 7, 9, 10)]
    assert np.ptp(slow) < 0.01 and np.mean(slow) == pytest.approx(-1 / 9, rel=0.05)


@pytest.mark.parametrize(("low", "high"), [(5, 6), (7, 8)])
def test_more_control_gain_tracks_better(short, low, high):
    before, after = (outcome_of(short, column, "corrected") for column in (low, high))
    for name in ("position_m", "speed_mps"):
        assert after[name] < before[name] / 3


def test_learning_tracks_better_than_feedback_alone(short):
    for column in (5, 9):
        assert outcome_of(short, column, "corrected")["position_m"] < outcome_of(
            short, column, "feedback")["position_m"]


def test_the_printed_leakage_diverges_and_the_corrected_one_does_not(short):
    for law in ("printed", "wrong_leakage"):
        outcome = run_case(short, RunCase(5, f"liu2020.{law}", "fast", leak_rate_per_s=1.0))
        assert {outcome.row[name] for name in (*RMS.values(), "energy_J", "energy_both_J", "reversals")} == {None}
        assert f"liu2020.{law} diverged at t = " in outcome.failed and " m, v = " in outcome.failed
        assert 5 < outcome.row["end_s"] < 60
    for law in ("corrected", "wrong_learning"):
        outcome_of(short, 5, law, leak=1.0)


def test_the_printed_sign_of_32_costs_tracking(short):
    wrong, right = (outcome_of(short, 5, law, leak=0.1) for law in ("wrong_learning", "corrected"))
    assert wrong["position_m"] > 1.02 * right["position_m"]


def test_without_the_speed_the_estimate_is_worse(short):
    known, had = (outcome_of(short, 10, law)["v_tilde_mps"] for law in ("corrected", "position_only_speed"))
    assert had > 3 * known
    finer = short.model_copy(update={"sampling": short.sampling.model_copy(update={"speed_filter_s": 0.01})})
    assert outcome_of(finer, 10, "position_only_speed")["v_tilde_mps"] < had / 3


def test_value_10_needs_the_step_that_its_eigenvalues_say(short):
    assert largest_step_s(eigenvalues(short, 10, "v_tilde")) == pytest.approx(2 / 173.97, rel=1e-3)
    assert largest_step_s(eigenvalues(short, 10, "s_tilde'")) == pytest.approx(2 / 314.89, rel=1e-3)
    coarse = short.model_copy(update={"sampling": short.sampling.model_copy(update={"period_s": 0.01})})
    outcome_of(coarse, 10, "feedback")
    assert run_case(coarse, RunCase(10, "liu2020.feedback_rate", "fast")).failed is not None


def test_the_printed_tables_imply_one_acceleration_and_one_step(study):
    """No run: Values 4 to 9 of Table 3 and Value 10 of Table 4 agree, Value 10 of Table 3 does not."""
    third = [implied(study, c, study.table_3.s_tilde_m[c - 1], study.table_3.v_tilde_mps[c - 1],
                     study.table_3.position_m[c - 1]) for c in range(1, 11)]
    fourth = implied(study, 10, study.table_4.s_tilde_m[1], study.table_4.v_tilde_mps[1], study.table_4.position_m[1])
    for one in (*third[3:9], fourth):
        assert 0.66 < one.by_estimates < 0.72
    assert third[9].by_estimates == pytest.approx(10 * fourth.by_estimates, rel=0.01)
    assert third[9].by_position == pytest.approx(fourth.by_estimates, rel=0.01)
    assert all(0.09 < one.step_s < 0.12 for one in third[3:9]) and fourth.step_s == pytest.approx(0.011, rel=0.05)
    assert max(map(abs, study.figure_ranges.v_tilde_mps)) < study.table_3.v_tilde_mps[9]


@pytest.mark.parametrize("column", [4, 5, 7, 8, 9])
def test_table_3_comes_out_by_feedback_alone_with_ten_times_its_gain(study, column):
    number = [change.title for change in study.changes].index(study.runs.inferred_changes[0])
    row = run_case(study, RunCase(column, "liu2020.feedback", "fast", number)).row
    for name, within in (("s_tilde_m", 0.1), ("v_tilde_mps", 0.1), ("position_m", 0.3)):
        assert row[RMS[name]] == pytest.approx(getattr(study.table_3, name)[column - 1], rel=within), name
    assert row["speed_rms"] > 1.5 * study.table_3.speed_mps[column - 1]  # where it does not
