"""MPC of any plant: against the linear optimum, a second solver, its limits, and what it refuses."""

import math
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from scipy.linalg import expm, solve_discrete_are
from shown_plants import CART, PENDULUM, u, v, x

import workbench as wb
from workbench.mpc.plant_tracking import PlantMpc
from workbench.simulate.plants.run import Entrant, run
from workbench.systems.law import Reference
from workbench.systems.metric import Metric
from workbench.systems.plant import Parameter, Plant
from workbench.systems.setting import Setting
from workbench.systems.signals import Constant, Sine

AT_REST = {"references": {"r": Constant(value=0.0)}, "tracks": {"x": "r"}}


def finite_horizon_gain(A, B, Q, R, P, steps):
    """The first feedback gain of the finite problem, by dynamic programming."""
    for _ in range(steps):
        K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
        P = Q + A.T @ P @ (A - B @ K)
    return K


@pytest.mark.parametrize("solver", ["fatrop", "ipopt"])
def test_without_limits_it_is_the_linear_optimum(solver):
    period, horizon = 0.1, 12
    whole = expm(period * np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]))
    A, B = whole[:2, :2], whole[:2, 2:]
    Q, R = np.diag([3.0, 0.0]), np.array([[0.05]])
    # The first stage's state cannot be changed, so its weight is of no effect on the gain.
    gain = finite_horizon_gain(A, B, Q, R, 2.0 * Q, horizon)
    how = PlantMpc(horizon, {"x": 3.0}, {"u": 0.05}, terminal_weight=2.0, solver=solver)
    controller = how.build(Setting(CART, 1.0, **AT_REST), period)
    for at in ([1.0, 0.0], [-0.4, 0.7]):
        assert controller.command(0.0, np.array(at)) == pytest.approx(-gain @ at, abs=1e-5)
    assert controller.fallbacks == 0


def test_a_constant_beyond_all_measure_keeps_no_solver_busy():
    """fatrop looks for the first step of such a problem without end."""
    wild = Plant("wild", (x, v), (v, u - 1e25 * x**3), inputs=(u,), input_limits={u: (-20.0, 20.0)})
    controller = PlantMpc(20, {"x": 1.0}, {"u": 0.01}).build(Setting(wild, 0.2, **AT_REST), 0.05)
    assert controller.command(0.0, np.array([0.3, 0.0])) == [0.0] and controller.fallbacks == 1
    assert abs(controller.command(0.05, np.array([0.0, 0.0]))) < 1e-6 and controller.fallbacks == 1
    told = wb.compare(Setting(CART, 0.05, **AT_REST), [Entrant("mpc", 0.05, build=lambda setting, period: controller)])
    assert told.rows[0]["fallbacks"] == 1 and "1 sample without a solution" in str(told)


def test_with_a_long_horizon_it_is_the_regulator():
    period = 0.1
    whole = expm(period * np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]))
    A, B, Q, R = whole[:2, :2], whole[:2, 2:], np.diag([1.0, 0.0]), np.array([[0.1]])
    P = solve_discrete_are(A, B, Q, R)
    gain = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    controller = PlantMpc(150, {"x": 1.0}, {"u": 0.1}).build(Setting(CART, 1.0, **AT_REST), period)
    assert controller.command(0.0, np.array([1.0, -0.5])) == pytest.approx(-gain @ [1.0, -0.5], abs=1e-4)


def test_limits_of_inputs_rates_and_states_hold():
    plant = Plant("limited", CART.states, CART.rates, CART.inputs, input_limits={u: (-1.0, 1.0)},
                  state_limits={v: (-0.6, 0.6)})
    how = PlantMpc(25, {"x": 1.0}, {"u": 0.01}, rate_limits={"u": 4.0})
    found = run(Setting(plant, 8.0, step_s=0.01, initial={"x": 2.0}, log_every_s=0.01, **AT_REST),
                Entrant("mpc", 0.1, build=how.build))
    assert found.failed is None and found.fallbacks == 0
    force = found.column("u")
    assert np.max(np.abs(force)) <= 1.0 + 1e-6 and np.max(np.abs(np.diff(force))) <= 0.4 + 1e-6
    assert found.metrics["v_limit_excess"] < 1e-4 and np.min(found.column("v")) < -0.59
    assert found.metrics["x_error_final"] == pytest.approx(0.0, abs=0.01)


def test_a_limit_that_cannot_be_kept_is_left_at_its_price_and_the_solver_goes_on():
    plant = Plant("late", CART.states, CART.rates, CART.inputs, input_limits={u: (-1.0, 1.0)},
                  state_limits={x: (-math.inf, 0.5)})
    found = run(Setting(plant, 4.0, step_s=0.01, initial={"x": 0.4, "v": 1.0}, **AT_REST),
                Entrant("mpc", 0.1, build=PlantMpc(20, {"x": 1.0}, {"u": 0.01}).build))
    # Braking at the limit from 1 m/s ends 0.5 m ahead, at 0.9 m.
    assert found.failed is None and found.fallbacks == 0
    assert found.metrics["x_limit_excess"] == pytest.approx(0.4, abs=0.02)


def test_both_solvers_swing_a_pendulum_up_alike_and_it_tracks():
    setting = Setting(PENDULUM, 3.0, references={"r": Sine(offset=math.pi, amplitude=0.3, period_s=2.0)},
                      tracks={"theta": "r"})
    ends = []
    for solver in ("fatrop", "ipopt"):
        how = PlantMpc(20, {"theta": 10.0}, {"tau": 1e-3}, solver=solver)
        found = run(setting, Entrant("mpc", 0.05, build=how.build))
        assert found.failed is None and found.fallbacks == 0
        assert abs(found.metrics["theta_error_final"]) < 0.01
        ends.append(found.log[-1, 1:4])
    assert ends[0] == pytest.approx(ends[1], abs=1e-4)


def test_it_believes_the_nominal_plant_whatever_the_truth():
    setting = Setting(PENDULUM, 0.5, references={"r": Constant(value=1.0)}, tracks={"theta": "r"})
    how = PlantMpc(10, {"theta": 1.0}, {"tau": 0.1})
    heavy = setting.varied(parameters={"m": 1.2})
    nominal, told = (run(heavy, Entrant("mpc", 0.05, build=how.build), belief).column("tau")[0]
                     for belief in (None, heavy.parameters))
    stated = run(setting, Entrant("mpc", 0.05, build=how.build)).column("tau")[0]
    assert nominal == pytest.approx(stated, abs=1e-9) and abs(told - stated) > 1e-3


@pytest.mark.parametrize(("how", "words"), [
    (PlantMpc(5, {"omega": 1.0}), "no reference is tracked"),
    (PlantMpc(5, {"theta": 1.0}, {"F": 1.0}), "no such input")])
def test_names_that_the_plant_does_not_have_are_one_line(how, words):
    with pytest.raises(ValueError, match=words):
        how.check(Setting(PENDULUM, 1.0, references={"r": Constant(value=0.0)}, tracks={"theta": "r"}), 0.1)


def test_a_plant_that_hides_a_state_is_refused():
    hidden = Plant("hidden", CART.states, CART.rates, CART.inputs, outputs={x: x})
    with pytest.raises(ValueError, match="'v' is not measured"):
        PlantMpc(5, {"x": 1.0}).check(Setting(hidden, 1.0, **AT_REST), 0.1)
    for wrong in ({"horizon": 0}, {"solver": "newton"}, {"weights": {"x": -1.0}}):
        with pytest.raises(ValueError, match=r"horizon|solver|weights"):
            PlantMpc(**({"horizon": 5, "weights": {"x": 1.0}} | wrong))


def test_several_inputs_and_several_outputs():
    a, b, f, g = sp.symbols("a b f g", real=True)
    c = sp.Symbol("c", positive=True)
    plant = Plant("two", (a, b), (f - a, c * g + a), inputs=(f, g), parameters=(Parameter(c, 2.0),))
    wanted = {"r": Constant(value=1.0), "w": Sine(amplitude=1.0, period_s=4.0)}
    setting = Setting(plant, 4.0, step_s=0.01, references=wanted,
                      tracks={"a": "r", "b": "w"})
    found = run(setting, Entrant("mpc", 0.1, build=PlantMpc(15, {"a": 1.0, "b": 1.0}, {"f": 1e-4, "g": 1e-4}).build))
    assert abs(found.metrics["a_error_final"]) < 0.02 and abs(found.metrics["b_error_final"]) < 0.05


def test_a_constant_error_of_the_model_vanishes_with_the_disturbance_model():
    """Held aslant with a mass 20 % heavier than believed; the limits of the torque stay kept."""
    setting = Setting(PENDULUM, 5.0, step_s=0.005, references={"r": Constant(value=0.5)}, tracks={"theta": "r"},
                      parameters={"m": 1.2})
    errors = []
    for gain in (0.0, 0.5):
        how = PlantMpc(15, {"theta": 100.0}, change_weights={"tau": 1e-2}, disturbance_gain=gain)
        found = run(setting, Entrant("mpc", 0.05, build=how.build))
        assert found.failed is None and found.fallbacks == 0
        assert np.max(np.abs(found.column("tau"))) <= 5.0
        errors.append(abs(found.metrics["theta_error_final"]))
    assert errors[0] > 1e-3 and errors[1] < 1e-4 * errors[0]


def test_one_iteration_is_the_optimum_of_a_linear_plant_and_close_to_it_on_a_pendulum():
    plant = Plant("limited", CART.states, CART.rates, CART.inputs, input_limits={u: (-1.0, 1.0)},
                  state_limits={v: (-0.6, 0.6)})
    setting = Setting(plant, 4.0, step_s=0.01, initial={"x": 1.0}, **AT_REST)
    swing = Setting(PENDULUM, 2.0, references={"r": Sine(amplitude=1.0, period_s=2.0)}, tracks={"theta": "r"})
    for where, period, tolerance, how in (
            (setting, 0.1, 1e-4, {"weights": {"x": 1.0}, "input_weights": {"u": 0.01}, "rate_limits": {"u": 4.0}}),
            (swing, 0.05, 0.05, {"weights": {"theta": 10.0}, "input_weights": {"tau": 1e-3}})):
        one, whole = (run(where, Entrant("mpc", period, build=PlantMpc(20, one_iteration=single, **how).build))
                      for single in (True, False))
        assert one.failed is None and one.fallbacks == 0
        assert np.max(np.abs(one.log[:, 1] - whole.log[:, 1])) < tolerance


def test_one_iteration_starts_from_a_plan_where_no_input_means_no_steering():
    """A craft whose tilt does nothing without thrust: the first plan is iterated, since at rest its slope is zero."""
    theta, f, w = sp.symbols("theta f w", real=True)
    craft = Plant("craft", (x, v, theta), (v, f * sp.sin(theta) - v / 5, w), (f, w),
                  input_limits={f: (0.0, 5.0), w: (-3.0, 3.0)})
    setting = Setting(craft, 1.0, step_s=0.01, initial={"x": -1.0}, **AT_REST)
    how = PlantMpc(15, {"x": 1.0}, {"f": 0.01, "w": 0.01}, terminal_weight=10.0, input_targets={"f": 2.0})
    first = [replace(how, one_iteration=single).build(setting, 0.1).command(0.0, np.array([-1.0, 0.0, 0.0]))
             for single in (True, False)]
    assert abs(first[1][1]) > 0.5
    np.testing.assert_allclose(first[0], first[1], atol=0.02)


def test_economic_mpc_trades_by_its_price_within_limits_and_beats_tracking_on_its_own_metric():
    price = Reference("p")
    store = Plant("store", (x,), (u,), (u,), input_limits={u: (-1.0, 1.0)}, state_limits={x: (0.0, 1.0)})
    cost = Metric("cost", "integral", price.value * u + u**2 / 20)
    setting = Setting(store, 12.0, step_s=0.01, initial={"x": 0.5}, tracks={"x": "half"}, metrics=(cost,),
                      references={"p": Sine(offset=1.0, amplitude=0.8, period_s=4.0), "half": Constant(value=0.5)})
    economic = run(setting, Entrant("mpc", 0.1, build=PlantMpc(40, objective={"cost": 1.0}).build))
    tracking = run(setting, Entrant("mpc", 0.1, build=PlantMpc(40, {"x": 1.0}, {"u": 0.01}).build))
    assert economic.failed is None and economic.fallbacks == 0
    assert economic.metrics["x_limit_excess"] < 1e-4 and np.max(np.abs(economic.column("u"))) <= 1 + 1e-6
    # Whatever is traded earns at most the difference of the prices, and what was in the store at most the highest one.
    assert economic.metrics["cost"] < tracking.metrics["cost"] - 1.5
    assert economic.metrics["cost"] > -3 * 1.6 - 0.5 * 1.8


@pytest.mark.parametrize(("how", "words"), [
    ({"weights": {}}, "weights and objective are empty"), ({"disturbance_gain": 1.5}, "from 0 to 1"),
    ({"disturbance_gain": 0.5, "input_weights": {"tau": 1.0}}, "take change_weights"),
    ({"one_iteration": True, "solver": "ipopt"}, "one_iteration needs"),
    ({"objective": {"theta_error_largest": 1.0}}, "integrated or taken at the end")])
def test_what_contradicts_itself_is_one_line(how, words):
    with pytest.raises(ValueError, match=words):
        PlantMpc(**({"horizon": 5, "weights": {"theta": 1.0}} | how)).check(
            Setting(PENDULUM, 1.0, references={"r": Constant(value=0.0)}, tracks={"theta": "r"}), 0.1)
