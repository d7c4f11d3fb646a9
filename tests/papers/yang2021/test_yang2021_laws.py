"""The laws of yang2021 against its formulas, typed a second time in plain Python, and against what they claim to be."""

import math

import numpy as np
import pytest
import sympy as sp

from proofs.yang2021 import laws as yang2021
from proofs.yang2021 import network as rbf

RANDOM = np.random.default_rng(2021)
NEURONS = 4


def _value(expr, numbers, neurons=None, j=None):
    """A law's expression at numbers by name; sums over the neurons are added up one by one."""
    neurons = neurons or {}
    sums = {s: sum(_value(s.function, numbers, neurons, i) for i in range(NEURONS)) for s in expr.atoms(sp.Sum)}
    expr = expr.xreplace(sums)
    at = {s: neurons[str(s.base.label)][j] for s in expr.atoms(sp.Indexed)}
    expr = expr.xreplace(at)
    return float(expr.xreplace({s: numbers[str(s)] for s in expr.free_symbols}))


@pytest.fixture(params=range(5))
def yang():
    """Numbers for every symbol of yang2021 (22)-(37), the position error within the barrier."""
    names = "alpha beta chi lambda_1 lambda_2 lambda_3 sigma_1 sigma_2 sigma_3 a_hat b_hat c_hat x_2 xdot_d xddot_d"
    n = dict(zip(names.split(), RANDOM.uniform(0.1, 2.0, 15), strict=True))
    n |= {"k": 0.21, "x_d": RANDOM.uniform(0, 100), "T_s": 0.01}
    n["x_1"] = n["x_d"] + RANDOM.uniform(-0.2, 0.2)
    neurons = {name: RANDOM.uniform(0.5, 2.0, NEURONS) for name in ("W_hat", "c_2", "b_h")}
    neurons["c_1"] = n["x_1"] + RANDOM.uniform(-1, 1, NEURONS)
    return n, neurons


def _printed(n, neurons):
    """(22)-(24), (27), (28), (5) and (16) as printed."""
    e_1 = n["x_1"] - n["x_d"]
    r = -n["alpha"] * e_1 + n["xdot_d"]
    rdot = -n["alpha"] * (n["x_2"] - n["xdot_d"]) + n["xddot_d"]
    e_2 = n["x_2"] - r
    h = [math.exp(-((n["x_1"] - c1) ** 2 + (n["x_2"] - c2) ** 2) / (2 * b**2))
         for c1, c2, b in zip(neurons["c_1"], neurons["c_2"], neurons["b_h"], strict=True)]
    f_hat = sum(w * hj for w, hj in zip(neurons["W_hat"], h, strict=True))
    return e_1, e_2, rdot, h, f_hat


def test_yang2021_33_the_command(yang):
    n, neurons = yang
    e_1, e_2, rdot, _, f_hat = _printed(n, neurons)
    u = (n["a_hat"] + n["b_hat"] * n["x_2"] + n["c_hat"] * n["x_2"] ** 2 - f_hat + rdot - n["beta"] * e_2
         - e_1 / (n["k"] ** 2 - e_1**2))
    assert _value(yang2021.rbfnn_pocrac.command, n, neurons) == pytest.approx(u, rel=1e-12)
    assert _value(yang2021.pocrac.command, n) == pytest.approx(u + f_hat, rel=1e-12)


def test_yang2021_34_to_37_the_adaptation(yang):
    n, neurons = yang
    _, e_2, _, h, _ = _printed(n, neurons)
    v = n["x_2"]
    rates = {
        "a_hat": -n["lambda_1"] * (e_2 + n["sigma_1"] * n["a_hat"]),
        "b_hat": -n["lambda_2"] * (v * e_2 + n["sigma_2"] * n["b_hat"]),
        "c_hat": -n["lambda_3"] * (v**2 * e_2 + n["sigma_3"] * n["c_hat"]),
    }
    for law in (yang2021.rbfnn_pocrac, yang2021.pocrac):
        assert {str(s.symbol) for s in law.scalar_states} == set(rates)
        for state in law.scalar_states:
            rate = rates[str(state.symbol)]
            assert _value(state.rate, n) == pytest.approx(rate, rel=1e-12)
            # One Euler step a sample, as the contract says.
            assert _value(law.next_value(state), n) == pytest.approx(n[str(state.symbol)] + 0.01 * rate, rel=1e-12)
    (weight,) = yang2021.rbfnn_pocrac.neuron_states
    assert yang2021.pocrac.neuron_states == ()
    for j in range(NEURONS):
        rate = n["chi"] * e_2 * h[j] - n["chi"] * neurons["W_hat"][j]
        assert _value(weight.rate, n, neurons, j) == pytest.approx(rate, rel=1e-12)


def test_yang2021_is_defined_inside_the_barrier_and_nowhere_else():
    for law in (yang2021.rbfnn_pocrac, yang2021.pocrac):
        (margin,) = law.domain
        for error, inside in ((0.0, True), (0.2099, True), (-0.2099, True), (0.21, False), (-0.22, False)):
            assert (_value(margin, {"k": 0.21, "x_1": 10.0 + error, "x_d": 10.0}) > 1e-9) == inside


# The gradient laws (10), (12), (14) from the performance index (9), by differentiation.
x, c, b, w, target, rate = sp.symbols("x c b w f eta", positive=True)
H = sp.exp(-((x - c) ** 2) / (2 * b**2))
MODEL_ERROR = target - w * H
INDEX = MODEL_ERROR**2 / 2


@pytest.mark.parametrize(("parameter", "step"), [
    (w, rbf.weight_step(rate, MODEL_ERROR, H)),
    (b, rbf.width_step(rate, MODEL_ERROR, w, H, (x - c) ** 2, b)),
    (c, rbf.center_step(rate, MODEL_ERROR, w, H, x, c, b)),
])
def test_a_step_is_the_descent_of_the_performance_index(parameter, step):
    assert sp.simplify(step + rate * sp.diff(INDEX, parameter)) == 0


def test_14_as_printed_is_not_the_descent_of_the_performance_index():
    printed = rbf.center_step_as_printed(rate, MODEL_ERROR, w, H, x, c, b)
    assert sp.simplify(printed + rate * sp.diff(INDEX, c)) != 0
    assert sp.simplify((printed + rate * sp.diff(INDEX, c)).subs(c, 1)) == 0  # only where c^2 = c


def test_momentum_is_11():
    value = rbf.with_momentum(sp.Integer(3), sp.Rational(1, 2), sp.Rational(1, 4), sp.Integer(1))
    assert value == 3 + sp.Rational(1, 2) + sp.Rational(1, 4) * (3 - 1)


def test_the_sensitivity_that_moves_the_gains_is_the_networks_derivative_by_the_command():
    """Learning lowers the error: the gains move against d(error^2/2)/d(gain), by the network's own derivative."""
    law = yang2021.rbf_pid
    n = {"x_d": 5.0, "x_1": 4.8, "e_prev": 0.25, "e_prev2": 0.3, "u_prev": 0.4, "T_s": 0.1, "eta": 0.2,
         "varpi": 0.04, "eta_K": 0.7, "K_p": 1.0, "K_i": 0.5, "K_d": 0.3}
    neurons = {name: RANDOM.uniform(0.2, 0.9, NEURONS) for name in ("w", "b_h", "c_1", "c_2", "c_3")}

    def network(u):
        inputs = (u, 0.2, 0.25)
        return sum(wj * math.exp(-sum((xi - ci) ** 2 for xi, ci in zip(inputs, centers, strict=True)) / (2 * bj**2))
                   for wj, bj, *centers in zip(*neurons.values(), strict=True))

    derivative = (network(0.4 + 1e-6) - network(0.4 - 1e-6)) / 2e-6
    signals = {"K_p": 0.2 - 0.25, "K_i": 0.2 * 0.1, "K_d": (0.2 - 2 * 0.25 + 0.3) / 0.1}
    moved = {}
    for state in law.scalar_states:
        if str(state.symbol) in signals:
            moved[str(state.symbol)] = _value(state.update, n, neurons)
            expected = n[str(state.symbol)] - 0.7 * 0.2 * derivative * signals[str(state.symbol)]
            assert moved[str(state.symbol)] == pytest.approx(expected, rel=1e-6)
    command = next(s for s in law.scalar_states if str(s.symbol) == "u_prev")
    increment = sum(moved[name] * signal for name, signal in signals.items())
    assert _value(command.update, n, neurons) == pytest.approx(0.4 + increment, rel=1e-9)
