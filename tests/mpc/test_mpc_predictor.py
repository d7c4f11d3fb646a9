"""MPC behind an actuator that it is told of: the state is predicted over the delay, the lag is in its model."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import short_scenario

from workbench.errors import InputError
from workbench.mpc.controller import KINDS, MpcController
from workbench.mpc.kernels import kernels
from workbench.mpc.predictor import Predictor, told
from workbench.mpc.problem import Problem, Weights
from workbench.simulate.closed_loop import simulate
from workbench.simulate.law_values import check_controllers
from workbench.simulate.metrics import measure
from workbench.trains.actuator import Actuator

WEIGHTS = {"horizon": 25.0, "position_weight": 25.0, "speed_weight": 14.8, "command_weight": 0.434,
           "change_weight": 0.1, "band_price": 1e3}
OWN = {"observer_gain": 0.3, "energy_price": 1.0, "time_price": 0.0, "regenerated": 0.0, "disturbance_mps2": 0.15}
PROBLEM = Problem(horizon=10, period_s=0.1, davis=(0.02, 2e-4, 1e-5), lowest_command_mps2=-1.0,
                  highest_command_mps2=1.0, weights=Weights(1.0, 1.0, 1.0))


def scenario_of(law, predictor, actuator):
    parameters = WEIGHTS | {key: OWN[key] for key in KINDS[law].parameters}
    return short_scenario(reproduction=False, controllers__mpc__law=law, controllers__mpc__parameters=parameters,
                          controllers__mpc__predictor=predictor, actuator=actuator)


def measured(law, predictor, actuator):
    scenario = scenario_of(law, predictor, actuator)
    return measure(simulate(scenario, "mpc"), scenario)


@settings(max_examples=25, deadline=None)
@given(delay=st.sampled_from([0.0, 0.03, 0.1, 0.25, 0.3]), lag=st.sampled_from([0.0, 0.2, 0.5]),
       seed=st.integers(0, 1000))
def test_the_prediction_is_exact_for_the_model(delay, lag, seed):
    problem, late = told(PROBLEM, Actuator(delay_s=delay, lag_s=lag))
    assert late == delay and problem.actuator == ("lag" if lag else "direct")
    follow, random = kernels(problem.actuator).follow, np.random.default_rng(seed)
    commands, push = random.uniform(-1, 1, 12).tolist(), random.uniform(-0.1, 0.1, 20)
    whole, rest = divmod(round(100 * delay), 10)
    history = [0.0] * (whole + 1) + commands  # what acts first is as many places before as the delay has periods
    predictor = Predictor(problem, push, late)
    for k in range(12):
        x = (3.0, 10.0, 0.1)
        found = predictor.ahead(k, np.array(x), 0.01)
        if rest:
            x = follow(*x, history[k], push[k] + 0.01, problem.parameters_over(rest / 100))
        for j in range(whole):
            x = follow(*x, history[k + 1 + j], push[k + j] + 0.01, problem.parameters)
        assert found == pytest.approx(x, abs=1e-12)
        assert predictor.acting(commands[k]) == (history[k], history[k + 1])


def test_over_whole_periods_what_was_predicted_comes():
    problem, late = told(PROBLEM, Actuator(delay_s=0.3, lag_s=0.4))
    follow, random = kernels(problem.actuator).follow, np.random.default_rng(1)
    predictor, x, seen, promised = Predictor(problem, np.full(30, 0.05), late), (0.0, 5.0, 0.0), [], []
    for k, command in enumerate(random.uniform(-1, 1, 30)):
        seen.append(x)
        promised.append(predictor.ahead(k, np.array(x), 0.02))
        _, acts = predictor.acting(float(command))
        x = follow(*x, acts, 0.05 + 0.02, problem.parameters)
    assert np.array(promised[:-3]) == pytest.approx(np.array(seen[3:]), abs=1e-12)


@pytest.mark.parametrize("law", ["mpc.linear", "mpc.nonlinear", "mpc.offset_free", "mpc.told"])
@pytest.mark.parametrize("actuator", [{"delay_s": 0.3}, {"delay_s": 0.25, "lag_s": 0.4}])
def test_who_is_told_of_a_late_actuator_is_better_than_who_is_not(law, actuator):
    aware, unaware = (measured(law, predictor, actuator) for predictor in (True, False))
    assert aware.failed is None
    assert aware.position_rms < 0.5 * unaware.position_rms or unaware.failed
    assert aware.command_variation < 0.5 * unaware.command_variation
    assert aware.jerk_rms < unaware.jerk_rms


def test_without_an_actuator_a_predictor_changes_no_bit():
    with_one, without = (simulate(scenario_of("mpc.offset_free", on, None), "mpc").log for on in (True, False))
    assert with_one.tobytes() == without.tobytes()


def test_a_lag_that_is_quicker_than_the_period_is_told_as_a_delay():
    assert told(PROBLEM, Actuator(delay_s=0.2, lag_s=0.03)) == (PROBLEM, pytest.approx(0.23))


def test_economic_mpc_is_told_too_and_the_tube_refuses():
    actuator = {"delay_s": 0.2, "lag_s": 0.4}
    scenario = scenario_of("mpc.economic", True, actuator)
    found = MpcController(scenario, scenario.controllers["mpc"], "mpc")
    assert found.problem.actuator == "lag" and found.problem.lag_s == 0.4
    for law in ("mpc.tube", "mpc.tracking"):
        changed = scenario_of("mpc.linear", True, actuator)
        spec = changed.controllers["mpc"].model_copy(update={"law": law, "parameters": (
            WEIGHTS | {"disturbance_mps2": 0.15} if law == "mpc.tube" else
            {"horizon": 20.0, "position_weight": 25.0, "speed_weight": 15.0, "command_weight": 4.0,
             "band_weight": 1e3, "observer_gain": 0.3})})
        with pytest.raises(InputError, match="predictor"):
            check_controllers(changed.model_copy(update={"controllers": {"mpc": spec}}))
