"""Numbers that a scenario states as following from a rule do follow from it."""

import pytest
from scenarios import YANG

from workbench.trains.scenario import load_scenario


@pytest.fixture(scope="module")
def yang():
    return load_scenario(YANG)


def test_pid_puts_three_poles_at_the_rate_alpha(yang):
    alpha = yang.controllers["rbfnn_pocrac"].parameters["alpha"]
    # (s + alpha)^3 = s^3 + K_d s^2 + K_p s + K_i, the loop around a double integrator
    wanted = {"K_p": 3 * alpha**2, "K_i": alpha**3, "K_d": 3 * alpha}
    assert yang.controllers["pid"].parameters == pytest.approx(wanted)
    initial = yang.controllers["rbf_pid"].initial
    assert {name: initial[name] for name in wanted} == pytest.approx(wanted)


def test_the_stiff_pid_is_pocrac_near_zero_error(yang):
    gains = yang.controllers["pocrac"].parameters
    alpha, beta, k = gains["alpha"], gains["beta"], gains["k"]
    # e'' = -(alpha + beta) e' - (alpha beta + 1/k^2) e, from (27) and (33) linearised; a tenth of Routh's limit
    proportional, derivative = alpha * beta + 1 / k**2, alpha + beta
    wanted = {"K_p": proportional, "K_d": derivative, "K_i": 0.1 * proportional * derivative}
    (variant,) = [v for v in yang.variants if "as stiff as" in v.title]
    for name, value in wanted.items():
        assert variant.set[f"controllers.pid.parameters.{name}"] == pytest.approx(value, rel=1e-3)
        assert variant.set[f"controllers.rbf_pid.initial.{name}"] == pytest.approx(value, rel=1e-3)


def test_the_soft_pid_halves_the_rate(yang):
    alpha = yang.controllers["rbfnn_pocrac"].parameters["alpha"] / 2
    (variant,) = [v for v in yang.variants if "-0.25 rad/s" in v.title]
    for name, value in {"K_p": 3 * alpha**2, "K_i": alpha**3, "K_d": 3 * alpha}.items():
        assert variant.set[f"controllers.pid.parameters.{name}"] == pytest.approx(value)


def test_mpc_weights_are_brysons_on_the_papers_numbers(yang):
    weights = yang.controllers["mpc"].parameters
    printed = {(v.controller, v.metric): v.value for v in yang.printed_values}
    assert weights["position_weight"] == pytest.approx(1 / yang.simulation.position_band_m**2, rel=1e-2)
    assert weights["speed_weight"] == pytest.approx(1 / printed["rbfnn_pocrac", "speed_error_max"] ** 2, rel=1e-2)
    assert weights["command_weight"] == pytest.approx(1 / printed["rbfnn_pocrac", "command_max"] ** 2, rel=1e-2)


def test_the_neurons_stand_as_their_sources_say(yang):
    grid = yang.controllers["rbfnn_pocrac"].neurons
    spacing = (grid.last_center - grid.first_center) / (grid.count - 1)
    assert spacing == pytest.approx(1000.0)
    assert grid.width == pytest.approx(spacing / 2)
    assert grid.first_center == 0.0 and grid.last_center >= yang.track.length_m
