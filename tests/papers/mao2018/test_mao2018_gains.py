"""mao2018's gains: the damping against a maximum by brute force, the leakage against the laws that run."""

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from proofs.mao2018 import active_mode
from proofs.mao2018 import gains as mao2018
from proofs.mao2018.laws import KINDS, LAWS, failure_law
from proofs.mao2018.leakage import leak, leaky
from proofs.mao2018.plant import train
from proofs.mao2018.simulation.trip import initial, parameters, setting_of
from workbench.gains.search import search
from workbench.gains.stated import Stated
from workbench.paper.loading import load
from workbench.simulate.closed_loop import run_law


@pytest.fixture(scope="module")
def loaded():
    return load(Path(__file__).parents[3] / "proofs" / "mao2018")


@pytest.fixture(scope="module")
def stated(loaded):
    return Stated(loaded.path, loaded.data)


def test_the_constant_of_65_is_the_largest_push_of_the_drag():
    """Over speeds and errors on a grid, for the worst signs of Delta_b and Delta_c (64)."""
    b_0, c_0, k_1, k_2 = Fraction(1, 10), Fraction(1, 20), Fraction(1, 3), Fraction(1, 7)
    x, z = np.meshgrid(np.linspace(0, 20, 2001), np.geomspace(1e-4, 1e2, 2001))
    push = float(b_0) * z * x + float(c_0) * z * x**2 - float(k_1) * z**2 * x**2 - float(k_2) * z**2 * x**4
    most = float(mao2018.constant_of(b_0, c_0, k_1, k_2))
    assert push.max() <= most
    assert push.max() == pytest.approx(most, rel=1e-3)


def test_no_other_damping_of_the_same_ball_feeds_back_less(stated):
    b_0, c_0 = mao2018.drag_bounds(stated)
    speed, K = mao2018.top_speed(stated), Fraction(1, 100)
    found = search(mao2018.damping_problem(b_0, c_0, speed, K), 1e-3)
    k_1, k_2 = (Fraction(str(found.values[k])) for k in (active_mode.k_1, active_mode.k_2))
    assert mao2018.constant_of(b_0, c_0, k_1, k_2) <= K
    theory = float(b_0 * speed + c_0 * speed**2) ** 2 / (4 * float(K))  # by Cauchy
    assert theory * (1 - 1e-9) <= float(k_1 * speed**2 + k_2 * speed**4) <= theory * 1.005


@pytest.mark.parametrize("law", [law for law in LAWS if law.id != "mao2018.healthy"], ids=lambda law: law.id)
def test_leakage_adds_what_it_says_to_every_estimate(law):
    with_leak = leaky(law)
    assert with_leak.parameters == (*law.parameters, leak)
    for before, after in zip(law.states, with_leak.states, strict=True):
        added = sp.expand(after.rate - before.rate)
        assert added.has(leak), before.symbol
        assert sp.simplify(added.xreplace({before.symbol: sp.Integer(0)})) == 0
        # Off while the mode is: the indicators are 0 or 1.
        assert sp.expand(added / (leak * before.symbol)).free_symbols.isdisjoint({leak, before.symbol})


def run_of(study, leak_per_s, seconds=30.0):
    case, tuning = study.cases[4], study.tunings["scaled"]
    law = failure_law("damped", KINDS["damped"][-1])
    named, start = parameters(study, case, tuning), initial(study, case)
    if leak_per_s is not None:
        law, named = leaky(law), named | {"leak": leak_per_s}
    values = (np.array([named[str(s)] for s in law.parameters]),
              np.array([start[str(s.symbol)] for s in law.scalar_states]), np.zeros((0, 0)), np.zeros((0, 0)))
    setting = replace(setting_of(study, case, tuning), end_s=seconds)
    return run_law(law, values, setting, tuning.period_s, study.law.estimates, plant=train)


def test_without_leakage_the_leaky_law_is_the_law(loaded):
    plain, none = run_of(loaded.study, None), run_of(loaded.study, 0.0)
    for name in ("s_m", "v_mps", "u_mps2", "rho_hat_1", "xi_hat_0"):
        assert none.column(name) == pytest.approx(plain.column(name), rel=1e-9, abs=1e-12)


def test_with_leakage_an_idle_modes_estimates_rest_and_the_active_ones_are_drawn_to_zero(loaded):
    some = run_of(loaded.study, 0.5)
    assert np.ptp(some.column("rho_hat_3")) == 0
    assert abs(some.column("rho_hat_1")[-1]) < abs(run_of(loaded.study, None).column("rho_hat_1")[-1])


def test_e_0_is_what_the_estimates_weigh_while_they_are_zero(loaded, stated):
    """By the study's own parameters and true values, summed here in floats."""
    study = loaded.study
    case, tuning = study.cases[4], study.tunings["scaled"]
    named, right = parameters(study, case, tuning), initial(study, case.model_copy(update={"estimate_share": 1.0}))
    worst = 0.0
    for mode in (1, 2, 3, 4):
        worst = max(worst, sum(right[f"{hat}_{mode}"] ** 2 / (2 * named[str(gain)])
                               for hat, gain in zip(active_mode.hats, active_mode.gains, strict=True)))
    healthy, n = 15, 16
    push = 2e5 / 4e5
    expected = worst + 2 * n * (push / n) ** 2 / (2 * 2.0) + healthy * (1 / healthy) ** 2 / (2 * 2.0) * 2
    assert float(mao2018.estimates_at_zero(stated)) == pytest.approx(expected, rel=1e-3)
