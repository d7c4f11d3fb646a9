"""jiao2025 runs: the compiled trials against plain Python; what the paper says where it holds, and where not."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import plain_trials
import pytest
from refusals import changed_copy, refusal

from proofs.jiao2025 import laws as paper
from proofs.jiao2025 import stated_values
from proofs.jiao2025.laws import TRIAL_LAWS
from proofs.jiao2025.simulation.plans import Case, plan
from proofs.jiao2025.simulation.trials import run_trials
from proofs.jiao2025.study import KIND
from proofs.jiao2025.study.record import JiaoStudy
from proofs.jiao2025.study.runs import JiaoResults, cases, concerns, name_of, outcome
from workbench.cli.loading import load
from workbench.files.toml import read_toml, validate_record
from workbench.paper.learning_comparison import rises
from workbench.report.runs import study_document
from workbench.report.sources import sourced_values

FOLDER = Path(__file__).parents[3] / "proofs" / "jiao2025"


@pytest.fixture(scope="module")
def study():
    return load(FOLDER).study


@pytest.fixture(scope="module")
def small(study):
    """All trials of the short readings and of one with ten samples a k, few seeds, units and variants."""
    keep = ("N", "kN", "mass", "N_1s")
    wanted = ("first estimate 1", "every trial of the desired length", "lambda ten times larger")
    return study.model_copy(update={
        "readings": {name: study.readings[name] for name in keep},
        "trials": study.trials.model_copy(update={"seeds": 3}),
        "unit_sweep": study.unit_sweep.model_copy(update={"readings": ("N",), "count": 4}),
        "changes": tuple(v for v in study.changes if v.title in wanted),
        "pairs": study.pairs.model_copy(update={"draws": 2})})


@pytest.fixture(scope="module")
def result(small):
    return KIND.run(small, 1, lambda done, total, what: None)


@pytest.fixture(scope="module")
def results(small):
    return JiaoResults(small, {case: run_trials(plan(small, case)) for case in cases(small) if case.unit_mps2 is None})


# --- the compiled trials --------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", TRIAL_LAWS)
@pytest.mark.parametrize(("reading", "seen_by", "opposed"), [
    ("N", "stretched", False), ("kN", "train", False), ("N_1s", "desired", True)])
def test_compiled_trials_are_those_of_a_plain_loop(study, law, reading, seen_by, opposed):
    if opposed and law not in ("jiao2025.icfdl", "jiao2025.pd"):
        pytest.skip("the study does not run it")
    made = plan(study, Case(reading, law, 5, opposed=opposed))
    # From the second trial on PD leaves all bounds with u in kN: rounding errors would be all that is compared.
    trials = 1 if (reading, law) == ("kN", "jiao2025.pd") else 5
    made = replace(made, seen_by=seen_by, lengths=made.lengths[:trials], kept=(trials - 1,))
    done = run_trials(made)
    squares, speeds, estimates = plain_trials.run(made)
    assert done.failed is None
    assert done.mse == pytest.approx(squares, rel=1e-7)
    last = int(made.lengths[-1])
    assert done.sample(trials - 1, "speed") == pytest.approx(speeds[: last + 1], rel=1e-6, abs=1e-6)
    assert done.sample(trials - 1, "estimate")[:-1] == pytest.approx(estimates[:last], rel=1e-6, abs=1e-12)


def test_ten_samples_a_k_and_a_resistance_as_printed(study):
    as_printed = study.changed(next(i for i, v in enumerate(study.changes) if "train.resistance" in v.set))
    made = plan(as_printed, Case("N_long", "jiao2025.pd", 5))
    made = replace(made, lengths=made.lengths[:2])
    assert len(made.desired) == 20_001 and made.divisor == study.train.mass_kg
    assert run_trials(made).mse == pytest.approx(plain_trials.run(made)[0], rel=1e-7)


def test_desired_curve_and_grades_are_those_of_the_paper(study):
    made = plan(study, Case("N", "jiao2025.icfdl", 0))
    assert made.desired == pytest.approx([plain_trials.v_desired(k) for k in range(2001)], abs=1e-12)
    assert made.additional_n / made.mass_kg == pytest.approx(
        [9.80665 * s.grade_permille * 1e-3 for s in study.line.sections], rel=1e-4)
    assert made.edges[-1] == pytest.approx(0.1 * made.desired[:-1].sum())


def test_lengths_are_drawn_from_all_hundred_and_from_no_other(study):
    drawn = np.concatenate([plan(study, Case("N", "jiao2025.pd", seed)).lengths for seed in range(40)])
    assert set(drawn) == set(range(1901, 2001))


# --- what the file states -------------------------------------------------------------------------------------


def test_the_file_states_the_numbers_that_the_claims_are_decided_for(study):
    claims = stated_values
    stated = {str(symbol): float(value) for symbol, value in claims.STATED.items()}
    learning = study.learning.model_dump()
    assert {name: learning[name] for name in ("rho", "lamda", "mu", "eta", "epsilon", "K_p", "K_d")} == {
        name: value for name, value in stated.items() if name not in ("T_s", "M")}
    assert (study.readings["N"].step_s, study.train.mass_kg) == (stated["T_s"], stated["M"])
    assert (study.learning.first_input, study.trials.desired_length_k, study.trials.count) == (
        claims.FIRST_INPUT, claims.LENGTH, claims.TRIALS)
    for name, reading in (("N", claims.newton), ("kN", claims.kilonewton), ("mass", claims.per_mass),
                          ("N_1s", claims.newton_1s), ("kN_1s", claims.kilonewton_1s), ("mass_1s", claims.per_mass_1s)):
        own = study.readings[name]
        assert own.step_s * own.unit_n / study.train.mass_kg == pytest.approx(float(reading.gain))


def test_the_first_estimate_follows_its_rule(study):
    assert study.learning.first_estimate == pytest.approx(study.learning.lamda**0.5, rel=1e-5)
    made = plan(study, Case("kN", "jiao2025.fixed_estimate", 0))
    assert made.first_estimate == pytest.approx(0.1 * 1000 / 350_000) and set(made.lengths) == {2000}


def test_every_value_says_where_it_comes_from(study):
    values = {value.key: value for value in sourced_values(study)}
    assert values["learning.rho"].kind == "paper" and values["learning.first_estimate"].kind == "assumed"
    assert values["readings.kN.unit"].kind == "assumed"


@pytest.mark.parametrize(("old", "new", "message"), [
    ("mass_kg = 350000.0", "mass_kg = 350.0", "train.mass_kg: input should be greater"),
    ("rho = 0.245", "rho = 1.5", "learning.rho: input should be less than or equal to 1"),
    ("first_estimate = 0.0070711", 'first_estimate = "true"', "learning.first_estimate: 'true' is neither"),
    ("first_estimate = 0.0070711", "first_estimate = -1.0", "learning.first_estimate: -1.0 is neither"),
    ("shortest_length_k = 1900", "shortest_length_k = 1999\nlength = 3", "trials.length: unknown key"),
    ("desired_length_k = 2000", "desired_length_k = 1700",
     "trials: shortest_length_k = 1900 is above desired_length_k - 1 = 1699"),
    ("compared = [50, 100]", "compared = [50, 200]", "trials: compared = 200 is above count = 150"),
    ("end_fraction = 0.35", "end_fraction = 0.10", "line: sections: end_fraction must increase"),
    ("k_per_sample = 0.1\n", "k_per_sample = 0.3\n", "readings.N_long: k_per_sample = 0.3 is no whole part of 1"),
    ('reading = "kN"', 'reading = "MN"', "shown: there is no reading 'MN': choose one of N, kN"),
    ('law = "jiao2025.pd"', 'law = "pid"', "shown: there is no law 'pid'"),
    ('"learning.lamda" = 0.000005', '"learning.lambda" = 0.1',
     "changes: 'lambda ten times smaller': learning.lambda: no such key"),
    ('"learning.lamda" = 0.000005', '"learning.lamda" = -1.0', "changes: 'lambda ten times smaller'"),
    ('mu = "paper, Table 1"\n', "", "learning: source.mu is missing"),
])
def test_bad_input_is_one_line_with_file_and_key(tmp_path, old, new, message):
    path = changed_copy(FOLDER / "study.toml", tmp_path, old, new)
    said = refusal(lambda: validate_record(read_toml(path), JiaoStudy, path))
    assert said.startswith(f"{path}: ") and message.lower() in said.lower()


# --- what the paper says, and what comes out ------------------------------------------------------------------


@pytest.mark.parametrize(("reading", "law"), [
    ("N", "jiao2025.icfdl"), ("N", "jiao2025.pd"), ("kN", "jiao2025.icfdl"), ("N_1s", "jiao2025.icfdl"),
    ("N_1s", "jiao2025.pd")])
def test_trial_100_is_better_than_trial_50_where_a_law_ends(results, reading, law):
    errors = results.run(reading, law).mse
    assert errors[150] < errors[100] < errors[50] < errors[0]


def test_better_every_time_does_not_hold(results):
    for reading, law in (("N", "jiao2025.icfdl"), ("N", "jiao2025.pd"), ("kN", "jiao2025.icfdl")):
        assert rises(results.run(reading, law).mse) > 30


def test_learning_is_not_better_than_pd_in_any_unit_in_which_both_end(results):
    for reading in ("N", "N_1s"):
        assert np.all(results.run(reading, "jiao2025.icfdl").mse[20:] > results.run(reading, "jiao2025.pd").mse[20:])


def test_learning_is_better_than_pd_where_each_has_the_unit_it_learns_in(results):
    assert np.all(results.run("kN", "jiao2025.icfdl").mse[40:] < results.run("N", "jiao2025.pd").mse[40:])


def test_the_error_grows_before_it_falls(results):
    errors = results.run("kN", "jiao2025.icfdl").mse
    assert errors.argmax() == 1 and errors[1] > 5 * errors[0] and errors[-1] < 1e-3 * errors[0]


def test_no_law_as_printed_survives_forces_per_mass(results):
    for law in TRIAL_LAWS:
        assert len(results.run("mass", law).rows) == 1
    # Claim intro.growth: one trial can multiply the norm by ten, also without a resistance that drives the train.
    opposed = results.run("mass", "jiao2025.icfdl", opposed=True).mse
    assert opposed.max() > 1e3 * opposed[0]


def test_the_first_sample_learns_what_the_claims_say(results):
    newton, kilonewton = (results.run(name, "jiao2025.fixed_estimate").column("first_error") for name in ("N", "kN"))
    for reading, left in (("N", newton), ("kN", kilonewton)):
        b = results.study.readings[reading].unit_n * 0.1 / 350_000
        gain = 0.245 * b**2 / (0.00005 + b**2)
        assert left == pytest.approx(left[0] * (1 - gain) ** np.arange(151), rel=1e-9)
    # Claim intro.slow.any: with u in N no estimates change the first error by 0.1 per cent in 150 trials.
    adapted = results.run("N", "jiao2025.icfdl").column("first_error")
    assert np.abs(adapted / adapted[0] - 1).max() < 1e-3


def test_a_kept_estimate_is_monotone_just_where_the_claims_prove_it(results):
    for reading in ("N", "N_1s"):  # claims intro.monotone.N and intro.monotone.N.1s
        assert rises(results.run(reading, "jiao2025.fixed_estimate").mse) == 0
    assert rises(results.run("kN", "jiao2025.fixed_estimate").mse) > 0


def test_pd_with_a_difference_learns_where_pd_as_printed_diverges(results):
    assert results.run("kN", "jiao2025.pd").failed is not None
    mended = results.run("kN", "jiao2025.pd_difference").mse
    assert mended[-1] < 0.1 and mended[-1] < 0.1 * results.run("kN", "jiao2025.icfdl").mse[-1]


def test_full_lengths_are_the_law_without_gaps(results):
    """(13)-(15) with every trial complete are (11)-(13)."""
    place = next(i for i, v in enumerate(results.study.changes) if "trials.shortest_length_k" in v.set)
    whole = results.runs[Case("kN", "jiao2025.icfdl", results.study.trials.seed, place)]
    assert np.array_equal(whole.mse, results.run("kN", "jiao2025.cfdl").mse)


def test_the_first_estimate_decides_how_it_ends(results):
    place = next(i for i, v in enumerate(results.study.changes) if v.title == "first estimate 1")
    other = results.runs[Case("kN", "jiao2025.icfdl", results.study.trials.seed, place)]
    assert outcome(other) == "falls, then grows again"
    assert other.mse[-1] > 100 * results.run("kN", "jiao2025.icfdl").mse[-1]
    assert not concerns(results.study.changes[place], "jiao2025.pd")


def test_the_outcome_hardly_hangs_on_the_drawn_lengths(results):
    for entry in results.study.shown:
        assert {outcome(done) for done in results.of_seeds(entry)} == {outcome(results.run(entry.reading, entry.law))}


# --- runs that fail, and what is told -------------------------------------------------------------------------


def test_a_run_that_diverges_says_where_and_stops_no_other(results, result, small):
    failed = results.run("mass", "jiao2025.icfdl").failed
    assert re.fullmatch(r"jiao2025\.icfdl diverged in trial 1 at sample \d+ \(t = [\d.]+ s\): v = -[\d.e+]+ m/s under "
                        r"u = -[\d.e+]+", failed)
    asked = list(cases(small))
    assert len(result.rows) == len(asked) == len(set(asked))
    rows = {name_of(small, case): row for case, row in zip(asked, result.rows, strict=True)}
    assert rows["jiao2025.icfdl, mass"]["failed"] == failed and rows["jiao2025.icfdl, mass"]["mse_150"] is None
    assert rows["jiao2025.pd, N"]["failed"] is None and rows["jiao2025.pd, N"]["mse_150"] < 150
    assert ("jiao2025.icfdl, mass", failed) in result.failures


def test_the_result_is_plain_data_without_nan(result, small):
    text = json.dumps(study_document(small, result), allow_nan=False)
    assert "nan" not in text.lower()
    assert all(cell for table in result.tables for row in table.text for cell in row)


def test_plots_cover_the_figures_of_the_paper(result):
    sources = {plot.source for plot in result.plots}
    assert sources >= {f"paper, Figure {number}" for number in range(2, 8)}
    lengths = next(plot for plot in result.plots if plot.source == "paper, Figure 3").curves[0]
    assert len(lengths.y) == 151 and lengths.y.min() >= 1901 and lengths.y.max() <= 2000


def test_findings_tell_what_the_runs_gave(result, results):
    text = "\n".join(result.findings)
    assert "that holds in none of them" in text
    last = results.run("kN", "jiao2025.icfdl").mse[-1]
    assert f"{last:.2f}" in text and "nan" not in text.lower()


def test_the_reset_is_the_printed_case_distinction():
    values = {paper.epsilon: 1e-5, paper.phi_first: 0.5}
    after = paper.reset(paper.phi, paper.Delta_u).subs(values)
    for estimate, change, expected in ((0.2, 1.0, 0.2), (-0.2, 1.0, 0.5), (1e-5, 1.0, 0.5), (0.2, -1e-5, 0.5),
                                       (0.2, 0.0, 0.5), (0.2, -1.0, 0.2), (2e-5, 2e-5, 2e-5)):
        assert after.subs({paper.phi: estimate, paper.Delta_u: change}) == pytest.approx(expected)
