"""liu2020's claims against calculations of their own: exact motions by integration, lemmas on grids, tables by hand."""

import numpy as np
import pytest
import sympy as sp
from papers_import import PROOFS
from scipy.integrate import solve_ivp

from proofs.liu2020 import exact_motions
from proofs.liu2020.error_dynamics import delta_tilde, t, theta_tilde
from proofs.liu2020.laws import e_v, s_tilde, v_tilde
from proofs.liu2020.stated_values import stated
from workbench.proof.claim import at_most
from workbench.proof.paper import collect_papers

CLAIMS = {claim.equation: claim for paper in collect_papers([PROOFS / "liu2020"]) for claim in paper.claims}
HELD, KAPPA = 30 * np.log(3), 60.0


def observer(leak, k_1=4.0, k_2=5.0, k_3=1.0):
    """(13), (18) to (21) for one neuron, exact network and priors, constants 1 but kappa_1; typed from the paper."""
    def rate(time, state):
        s, v, weight, delta = state
        return [v - k_1 * s, -k_3 * v - (k_2 - k_1 * k_3) * s + weight - np.tanh(v / KAPPA) * delta, -v + leak * weight,
                np.tanh(v / KAPPA) * v + leak * delta]
    return rate


def tracking(leak, learn, k_5=0.25, alpha_2=2.0, beta_2=0.5, hidden=0.5):
    """(33) as (28) and (31) give it, (32), (34), (35) for one neuron, M = chi = 1, exact network and priors."""
    def rate(time, state):
        e, weight, theta = state
        return [-k_5 * e - weight * hidden - np.tanh(e / KAPPA) * theta, learn * hidden * e + leak * weight,
                alpha_2 * (np.tanh(e / KAPPA) * e + leak * beta_2 * theta)]
    return rate


def stated_functions(goal, *states):
    return [sp.lambdify(t, goal.model[state], "numpy") for state in states]


@pytest.mark.parametrize("printed", [True, False])
def test_the_observer_runs_away_as_printed_and_comes_to_rest_with_the_leakage_turned(printed):
    goal = exact_motions.observer_motion(at_most(v_tilde, 1))
    expected = stated_functions(goal, s_tilde, v_tilde, exact_motions.weight_f, delta_tilde)
    start = [float(f(0.0)) for f in expected]
    run = solve_ivp(observer(1 if printed else -1), (0.0, 4.0 if printed else 60.0), start, rtol=1e-11, atol=1e-12)
    if printed:
        # The motion is unstable, so the integration follows it only as far as rounding lets it.
        for found, f in zip(run.y[:, -1], expected, strict=True):
            assert found == pytest.approx(float(f(4.0)), rel=1e-5)
        assert run.y[2, -1] > 50 and run.y[1, -1] == pytest.approx(HELD, rel=1e-4)
    else:
        assert np.abs(run.y[:, -1]).max() < 1e-3


@pytest.mark.parametrize("printed", [True, False])
def test_the_tracking_loop_runs_away_as_printed_and_comes_to_rest_with_the_signs_turned(printed):
    goal = exact_motions.tracking_motion(at_most(e_v, 1))
    expected = stated_functions(goal, e_v, exact_motions.weight_v, theta_tilde)
    start = [float(f(0.0)) for f in expected]
    laws = tracking(1, -1) if printed else tracking(-1, 1)
    run = solve_ivp(laws, (0.0, 4.0 if printed else 60.0), start, rtol=1e-11, atol=1e-12)
    if printed:
        for found, f in zip(run.y[:, -1], expected, strict=True):
            assert found == pytest.approx(float(f(4.0)), rel=1e-5)
        assert run.y[2, -1] > 70 and run.y[0, -1] == pytest.approx(HELD, rel=1e-4)
    else:
        assert np.abs(run.y[:, -1]).max() < 1e-3


def test_the_motions_stay_in_the_papers_domain():
    goal = exact_motions.tracking_motion(at_most(e_v, 1))
    model = {str(symbol): value for symbol, value in goal.model.items()}
    assert 0 < model["h_f"] <= 1 and 0 < model["h_v"] <= 1  # Gaussians
    assert model["k_2"] == 1 + model["k_1"] * model["k_3"]  # (40)
    assert all(model[name] > 0 for name in ("M", "chi", "k_1", "k_3", "k_5", "alpha_1", "beta_2", "sigma_f", "kappa_2"))
    assert all(model[name] == 0 for name in exact_motions.ZERO)


def test_no_column_of_table_2_meets_equation_40():
    gains = [np.array(stated["gains"][name]) for name in ("k_1", "k_2", "k_3")]
    left = 1 - gains[1] + gains[0] * gains[2]
    assert np.abs(left).min() > 0.5
    assert all(f"{value:.4g}" in CLAIMS["40"].note for value in left[np.abs(left) < 1e4])
    assert all(f"{value:.0f}" in CLAIMS["40"].note for value in left[np.abs(left) >= 1e4])
    undamped = 1 + np.flatnonzero(left**2 >= 4 * gains[0] * gains[2])
    assert f"for Values {', '.join(map(str, undamped))} the squares" in CLAIMS["40"].note


def test_lemma_2_holds_in_its_known_form_and_not_as_extracted():
    h, x, delta = (a.ravel() for a in np.meshgrid(np.linspace(-3, 3, 41), np.linspace(-4, 4, 41), [0.05, 0.5, 2.0]))
    left = h * np.abs(x) - x * h * np.tanh(0.2785 * h * x / delta)
    assert np.all(left <= delta)
    assert np.any(left > h * delta)


def test_white_speed_errors_keep_the_balance_that_table_4_breaks():
    printed = {str(symbol): float(value) for symbol, value in CLAIMS["table4.balance"].at.items()}
    gain, step, rng = printed["k_1"], 1e-5, np.random.default_rng(1)
    speed = np.repeat(rng.normal(size=400), 50)
    position = np.zeros(speed.size + 1)
    decay = np.exp(-gain * step)
    for i, value in enumerate(speed):  # (13), exactly for a speed error that is constant over a step
        position[i + 1] = decay * position[i] + (1 - decay) / gain * value
    rms = [np.sqrt(np.mean(signal**2)) for signal in (position, speed)]
    assert gain * rms[0] <= rms[1]
    assert gain * printed["stilde_rms"] > 1.9 * printed["vtilde_rms"]


def test_every_number_has_a_row():
    """But (62) to (68), which are not in the extracted text."""
    numbers = {int(equation.split(".")[0]) for equation in CLAIMS if equation.split(".")[0].isdigit()}
    assert {*range(1, 62), 69, 70, 71} <= numbers


def test_the_slow_disturbance_jumps_where_it_begins():
    values = {str(symbol): float(value) for symbol, value in CLAIMS["71.continuous"].at.items()}
    jump = values["A_d"] * np.sin(values["omega_d"] * values["T_d"])
    assert 0.98e6 < jump < 1e6 and CLAIMS["71.continuous"].recorded == "violated"


def test_the_force_of_a_curve_is_the_rule_of_10_5_newtons_a_kilonewton():
    """f_c at one degree, one metre and one kilogram against 10.5 N/kN at 9.8 m/s^2."""
    goal = CLAIMS["3"].build()
    at_one = goal.show[0].right.xreplace({symbol: sp.Integer(1) for symbol in goal.show[0].right.free_symbols})
    assert at_one == sp.Rational("10.5") * sp.Rational("9.8") / 1000


def test_what_the_text_says_of_the_tables_is_charged_only_where_paper_prints_both():
    charged = {name for name, claim in CLAIMS.items() if claim.recorded == "violated" and claim.origin == "printed"}
    assert charged == {"40", "text.value5", "table4", "table4.increase"}
    table_3, table_4 = stated["table_3"], stated["table_4"]
    assert table_3["speed_mps"][4] != 2.0952 == table_3["speed_mps"][3]
    assert table_4["v_tilde_mps"][1] < table_4["v_tilde_mps"][0]
    assert table_3["v_tilde_mps"][9] > max(map(abs, stated["figure_ranges"]["v_tilde_mps"]))


def test_delta_hat_leaves_its_prior_for_all_gains_while_nothing_drives_the_laws():
    """At zero errors only the leakage moves anything, by the printed laws typed from the paper, for random gains."""
    rng = np.random.default_rng(3)
    for alpha, beta, k_1, k_2, k_3, kappa in rng.uniform(0.1, 5, (50, 6)):
        s, v, weight, delta = 0.0, 0.0, 0.0, rng.uniform(0.1, 2)
        signal = (v - k_1 * s) + k_1 * s
        rates = [v - k_1 * s, -k_3 * v - (k_2 - k_1 * k_3) * s + weight - np.tanh(signal / kappa) * delta,
                 -signal + weight, alpha * (np.tanh(signal / kappa) * signal + beta * delta)]
        assert rates[:3] == [0.0, 0.0, 0.0] and rates[3] == pytest.approx(alpha * beta * delta)
    assert CLAIMS["48.zero"].recorded == CLAIMS["60.zero"].recorded == "refuted"


def test_of_tables_3_and_4_it_is_table_3_that_is_off_by_ten():
    """What (12) with k_3 v_tilde needs of s_tilde and v_tilde for one acceleration, typed from Tables 2 to 4."""
    k_2, k_3 = (np.array(stated["gains"][name]) for name in ("k_2", "k_3"))
    position, speed = (np.array(stated["table_3"][row]) for row in ("s_tilde_m", "v_tilde_mps"))
    needed = k_2 * position + k_3 * speed
    by_table_4 = k_2[9] * stated["table_4"]["s_tilde_m"][1] + k_3[9] * stated["table_4"]["v_tilde_mps"][1]
    assert np.all((needed[3:9] > 0.665) & (needed[3:9] < 0.715)) and np.all((needed[:3] > 0.75) & (needed[:3] < 0.845))
    assert by_table_4 == pytest.approx(0.66, abs=0.005) and needed[9] == pytest.approx(6.6, abs=0.05)
    # With k_3 s_tilde' instead, which is zero while the errors rest, k_2 s_tilde alone does it.
    alone = k_2 * position
    assert alone[0] == pytest.approx(0.62, abs=0.005) and alone[9] == pytest.approx(0.002, abs=0.0005)


def test_by_13_the_printed_estimation_errors_are_of_steps_of_a_tenth_and_a_hundredth_of_a_second():
    """Euler's steps of T leave k_1 s_tilde = v_tilde + a T/2 at the acceleration a."""
    k_1, k_2, k_3 = (np.array(stated["gains"][name]) for name in ("k_1", "k_2", "k_3"))
    position, speed = (np.array(stated["table_3"][row]) for row in ("s_tilde_m", "v_tilde_mps"))
    position[9], speed[9] = stated["table_4"]["s_tilde_m"][1], stated["table_4"]["v_tilde_mps"][1]
    steps = 2 * (k_1 * position - speed) / (k_2 * position + k_3 * speed)
    assert np.all(np.abs(steps[3:9] - 0.1) < 0.011) and steps[9] == pytest.approx(0.011, abs=0.0005)
    assert (k_1 * position / speed)[3:9].max() == pytest.approx(1.6, abs=0.05)


def test_some_gains_bring_the_printed_observer_to_rest_while_its_estimates_diverge():
    """Why Remark 2, which names no gains, is not called false; typed from the paper, random starts."""
    k_1 = k_3 = 2.0
    alpha, beta, sigma, kappa = 8.0, 0.05, 0.01, 0.1

    def rate(time, state):
        s, v, weight, delta = state
        push = np.tanh(v / kappa)
        return [v - k_1 * s, -k_3 * v - s + weight - push * delta, -v + sigma * weight,
                alpha * (push * v + beta * delta)]

    for start in np.random.default_rng(5).uniform(-10, 10, (4, 4)):
        run = solve_ivp(rate, (0.0, 30.0), start, method="LSODA", rtol=1e-8, atol=1e-10)
        assert abs(run.y[1, -1]) < 1e-4 and run.y[3, -1] > 1e3
    assert CLAIMS["remark2"].recorded == CLAIMS["remark3"].recorded == "gap"


def test_a_standing_train_makes_the_motion_of_theorem_2():
    """(12), (17), (20), (23), (27), (31), (34) at some instants, M = chi = a_0 = u = 1, W_f* = 0, W_v* = 2."""
    goal = CLAIMS["theorem2"].build()
    model = {str(symbol): value for symbol, value in goal.model.items()}
    at = {name: float(model[name]) for name in ("k_1", "k_2", "k_3", "k_5", "h_v", "kappa_1", "kappa_2", "h_f")}
    k_4 = 1.0
    for time in (0.0, 1.5):
        s_err, v_err, w_f, delta, e_v, w_v, theta = (float(sp.sympify(model[name]).subs(t, time)) for name in (
            "s_tilde", "v_tilde", "w_f", "delta_tilde", "e_v", "w_v", "theta_tilde"))
        u = (2 + w_v) * at["h_v"] + at["k_5"] * e_v + np.tanh(e_v / at["kappa_2"]) * theta
        f_hat, robust = w_f * at["h_f"], -np.tanh(v_err / at["kappa_1"]) * delta
        s_hat_rate = v_err - at["k_1"] * s_err
        v_hat_rate = f_hat - at["k_2"] * s_err - at["k_3"] * s_hat_rate + robust
        f_v = k_4 * -s_hat_rate - v_hat_rate + u
        assert u == pytest.approx(1.0) and f_v == pytest.approx(2 * at["h_v"])
        assert s_hat_rate == pytest.approx(0.0, abs=1e-9) and v_hat_rate == pytest.approx(0.0, abs=1e-9)


def test_assumption_5_needs_one_bounded_speed():
    a_1, a_2, v_max = 0.00388, 0.000114, 110.0
    v_1, v_2 = np.meshgrid(np.linspace(-2000, 2000, 401), np.linspace(-v_max, v_max, 111))
    change = np.abs(a_1 * (v_1 - v_2) + a_2 * (v_1**2 - v_2**2))
    assert np.all(change <= (a_1 + 2 * a_2 * v_max) * np.abs(v_1 - v_2) + a_2 * (v_1 - v_2) ** 2 + 1e-9)


def test_the_curve_of_table_1_is_fifteen_full_circles():
    values = {str(symbol): float(value) for symbol, value in CLAIMS["table1.curve"].at.items()}
    turns = (values["s_end"] - values["s_begin"]) / (2 * np.pi * values["R_curve"])
    assert 15 < turns < 16 and (350 / 3.6) ** 2 / values["R_curve"] == pytest.approx(47, abs=0.5)
