"""What chen2019 says, where it holds in runs, and what it depends on."""

import math

import numpy as np
import pytest
from chen2019_studies import changed

from proofs.chen2019 import laws as law
from proofs.chen2019.simulation.cars_runs import run_cars
from proofs.chen2019.simulation.formulas import allowed_change, alternating_growth, cef_change, first_cef
from proofs.chen2019.simulation.plans import plan
from proofs.chen2019.study.runs import grows_from, outcome
from workbench.paper.learning_comparison import rises


def test_errors_fall_from_trip_to_trip_and_so_does_the_difference(runs):
    stated = runs["as stated"]
    assert stated.failed is None
    assert rises(stated.position_error) == 0
    assert rises(stated.speed_error) == 0
    assert stated.position_error[-1] < 0.5 * stated.position_error[0]
    assert stated.difference[-1] < stated.difference[0]
    assert stated.speed_error[-1] > 0.01
    assert outcome(stated) == "falls"


def test_traction_comes_from_motor_cars_alone_and_all_cars_brake(runs):
    stated = runs["as stated"]
    assert stated.of_cars("force_max")[:, 1::2].max() == 0
    assert stated.of_cars("force_max")[:, ::2].min() > 0
    assert stated.of_cars("force_min").max() < 0


def test_the_energy_function_falls_as_the_proof_says(runs, short):
    stated = runs["as stated"]
    assert (cef_change(stated) <= allowed_change(short, stated)).all()
    assert first_cef(short) + cef_change(stated).sum() > 0


def test_the_auxiliary_state_is_bounded_by_the_saturation_as_the_corrected_claim_says(runs, short):
    bound = float(law.any_gains.subs({g: getattr(short.gains, str(g)) for g in law.gains}))
    for name in ("as stated", "slopes where the car is"):
        ratio = runs[name].total("lambda_square_s") / runs[name].total("difference_square_s")
        assert (ratio > 0).all()
        assert (ratio <= bound).all()


def test_the_repaired_c_1_starts_with_far_smaller_position_errors(runs):
    repaired = runs["c_1 = 1, acceleration of the sample before"]
    assert repaired.failed is None
    assert repaired.position_error[0] < 0.2 * runs["as stated"].position_error[0]


def test_a_smaller_c_3_starts_better_and_learns_less(runs):
    smaller, stated = runs["c_3 = 1/100, room of 100 kg for the estimate of the mass"], runs["as stated"]
    assert smaller.position_error[0] < stated.position_error[0]
    left = [run.position_error[-1] / run.position_error[0] for run in (smaller, stated)]
    assert left[0] > left[1]


def test_slopes_that_are_met_where_the_train_is_are_learned_too(runs):
    for name in ("slopes as a function of time", "slopes where the car is"):
        assert runs[name].failed is None
        assert runs[name].position_error[-1] < runs[name].position_error[0]


def alternating(study, speed_mps, answered):
    """How an error that alternates grows in a trip, by (9) and (18) of one saturated car alone, sample by sample."""
    g, T = study.gains, study.sampling.period_s
    q = math.exp(-g.c_2 * T)
    held = (1 - q) / g.c_2 * g.c_3
    answer = g.c_3 * (g.gamma_v * speed_mps**2 + g.gamma_a * speed_mps**4 + g.gamma_eta)
    samples = 4000
    learned = np.array([(-1.0) ** k for k in range(samples)])
    sizes = []
    for _ in range(2):
        z, following = 0.0, learned.copy()
        trace = []
        for k in range(samples):
            row = k - 1 if answered else k
            if row >= 0:
                following[row] += answer * z
            trace.append(z)
            z = q * z - held * (learned[k] + answer * z)  # z_2 = -lambda_2 but for what does not alternate
        sizes.append(abs(trace[samples // 2]))
        learned = following
    return sizes[1] / sizes[0]


@pytest.mark.parametrize("speed_mps", [40.0, 70.0, 83.5])
def test_errors_that_alternate_grow_as_the_study_says(study, speed_mps):
    same, following = alternating_growth(study, speed_mps)
    assert alternating(study, speed_mps, answered=False) == pytest.approx(same, rel=1e-6)
    assert alternating(study, speed_mps, answered=True) == pytest.approx(following, rel=1e-6)


def test_sampled_errors_of_the_same_sample_break_the_energy_function_that_those_of_the_next_keep(short):
    """At half the speed of sampling the printed rules learn; at a quarter they do not."""
    coarse = changed(short, trials__count=7, trials__shown=(1, 7), sampling__acceleration="sampled",
                     gains__gamma_a=0.03)
    same = run_cars(plan(changed(coarse, sampling__memory="same_sample")))
    fine = run_cars(plan(changed(coarse, sampling__memory="same_sample", sampling__period_s=0.00025)))
    assert same.failed is not None or grows_from(same.difference) is not None
    assert grows_from(fine.difference) is None
    assert fine.failed is None


def test_an_estimate_above_the_singular_one_ends_the_run_and_says_where(runs):
    failed = runs["50.03 to 55 t: the lower bound 30 kg above the mass"].failed
    assert failed is not None
    assert "trial 1, t = 0.000 s, car 1: the acceleration is not unique" in failed
    assert "exceeds the mass by 30 kg, 1/c_3 is 25 kg" in failed
