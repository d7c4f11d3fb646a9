"""MPC that estimates the state, and MPC that is told of lags and delays: against exact shifts and the Kalman filter."""

import numpy as np
import pytest
import sympy as sp
from scipy.linalg import expm, solve_discrete_are
from shown_plants import CART, u, v, x

from workbench.model.law import time
from workbench.mpc.plant_tracking import PlantMpc
from workbench.systems.plant import Parameter, Plant
from workbench.systems.setting import Setting
from workbench.systems.signals import Constant

ONE = {"references": {"r": Constant(value=1.0)}, "tracks": {"x": "r"}}
w = sp.Symbol("w", real=True)
HIDDEN = Plant("hidden", (x, v), (v, u + w), (u,), disturbances=(w,), outputs={x: x}, input_limits={u: (-5.0, 5.0)})


def driven(controller, seconds, delay=0, lag_s=0.0, first=0.0, push=lambda t: 0.0):
    """A cart under a controller that samples every 0.1 s, in exact steps of 0.01 s: rows of t, x, v and the command."""
    at, acting, sent, rows = np.zeros(2), first, [first] * (delay + 1), []
    for k in range(round(100 * seconds)):
        t = k * 0.01
        if k % 10 == 0:
            command = float(np.ravel(controller.command(t, at if controller.measures_all else at[:1]))[0])
        sent = [*sent[1:], command]
        rows.append((t, *at, command))
        if lag_s:  # the acting force is left of it exponentially; its integrals are exact
            left = np.exp(-0.01 / lag_s)
            gap, end = acting - sent[0], sent[0] + left * (acting - sent[0])
            rise = sent[0] * 0.01 + gap * lag_s * (1 - left)
            way = sent[0] * 0.01**2 / 2 + gap * lag_s * (0.01 - lag_s * (1 - left))
            at, acting = np.array([at[0] + 0.01 * at[1] + way, at[1] + rise]), end
        else:
            a = sent[0] + push(t)
            at = np.array([at[0] + 0.01 * at[1] + a * 0.01**2 / 2, at[1] + 0.01 * a])
    return np.array(rows)


def made(how, plant, **setting):
    controller = PlantMpc(**how).build(Setting(plant, 10.0, step_s=0.01, **ONE, **setting), 0.1)
    controller.measures_all = plant is not HIDDEN
    return controller


@pytest.mark.parametrize("delay", [20, 13])
def test_told_of_a_delay_it_drives_as_without_it_so_much_later(delay):
    """A cart at rest stays where it is until the first command arrives; both loops see the same states then."""
    how = {"horizon": 12, "weights": {"x": 1.0}, "input_weights": {"u": 0.01}, "rate_limits": {"u": 20.0},
           "predictor": True}
    late = driven(made(how, CART, delay_s={"u": delay / 100}), 2.5, delay)
    prompt = driven(made(how, CART), 2.5)
    assert late[delay:, 1:3] == pytest.approx(prompt[:-delay, 1:3], abs=1e-6)
    assert abs(prompt[-1, 1] - 1.0) < 0.05


def test_told_of_a_lag_it_is_the_mpc_of_the_plant_with_that_lag():
    acting = sp.Symbol("force", real=True)
    stated = Plant("with lag", (x, v, acting), (v, acting, (u - acting) / sp.Float(0.3)), (u,))
    how = {"horizon": 12, "weights": {"x": 1.0}, "input_weights": {"u": 0.01}}
    told = made(how | {"predictor": True}, CART, lag_s={"u": 0.3}, initial={"u": 0.5})
    whole = made(how, stated, initial={"force": 0.5})
    states = driven(told, 1.5, lag_s=0.3, first=0.5)
    force = 0.5
    again = made(how | {"predictor": True}, CART, lag_s={"u": 0.3}, initial={"u": 0.5})
    for t, *at, command in states[::10]:
        assert again.command(t, np.array(at)) == pytest.approx(whole.command(t, np.array([*at, force])), abs=1e-3)
        force = command + np.exp(-0.1 / 0.3) * (force - command)
    assert states[-1, 1] > 0.8


def test_its_filter_ends_at_the_stationary_kalman_gain():
    period, noise = 0.1, 0.02
    setting = Setting(HIDDEN, 1.0, noise={"x": noise}, **ONE)
    how = PlantMpc(5, {"x": 1.0}, {"u": 0.1}, observer={"v": 0.3, "w": 0.4})
    state = how.build(setting, period).state
    for _ in range(200):
        state.now(np.zeros(1), [(np.zeros(1), period)])
    A = expm(period * np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]))
    C, Q, R = np.array([[1.0, 0.0, 0.0]]), period * np.diag([0.0, 0.3**2, 0.4**2]), np.array([[noise**2]])
    P = solve_discrete_are(A.T, C.T, Q, R)
    gain = P @ C.T / (C @ P @ C.T + R)
    before = state.now(np.zeros(1), [(np.zeros(1), period)]).copy()
    moved = state.now(np.ones(1), [])
    # Two measurements at the same time: the second one's gain is of the covariance that the first one left.
    left = (np.eye(3) - gain @ C) @ P
    second = left @ C.T / (C @ left @ C.T + R)
    assert (moved - before)[:2] == pytest.approx(second[:2, 0], rel=1e-6)
    assert state.disturbances == pytest.approx(second[2], rel=1e-6)


def test_an_estimated_disturbance_leaves_no_offset_and_is_found():
    how = {"horizon": 12, "weights": {"x": 1.0}, "change_weights": {"u": 0.01}, "observer": {"v": 0.1, "w": 1.0},
           "predictor": True}
    controller = made(how, HIDDEN, delay_s={"u": 0.1})
    states = driven(controller, 5.0, 10, push=lambda t: 0.8 if t > 0.995 else 0.0)
    assert states[-1, 1] == pytest.approx(1.0, abs=2e-3) and states[-1, 3] == pytest.approx(-0.8, abs=0.01)
    assert controller.state.disturbances == pytest.approx([0.8], abs=5e-3)


def test_rates_of_an_input_are_limited_from_where_it_was():
    """From zero no limited rate leads into these limits: the first program had no answer."""
    plant = Plant("warm", CART.states, (v, u - 300), CART.inputs, input_limits={u: (280.0, 320.0)})
    how = {"horizon": 10, "weights": {"x": 1.0}, "change_weights": {"u": 1e-6}, "rate_limits": {"u": 50.0}}
    for initial, most in (({"u": 300.0}, 305.0), ({}, 285.0)):  # unless stated, as near to zero as the limits allow
        controller = made(how, plant, initial=initial)
        assert controller.command(0.0, np.zeros(2)) == pytest.approx([most], abs=1e-3) and controller.fallbacks == 0


@pytest.mark.parametrize(("how", "setting", "words"), [
    ({"observer": {"y": 1.0}}, {}, "observer.y: plant 'hidden' has no such state"),
    ({"observer": {"v": 1.0}, "first_estimate": {"w": 1.0}}, {}, "state observer.w"),
    ({}, {}, r"state observer, as \{ v = 1.0 \}")])
def test_what_cannot_be_estimated_is_one_line(how, setting, words):
    with pytest.raises(ValueError, match=words):
        PlantMpc(5, {"x": 1.0}, **how).check(Setting(HIDDEN, 1.0, **ONE, **setting), 0.1)


def test_steps_that_would_make_a_quick_state_grow_are_one_line():
    """A current's time constant of 5 ms, planned with steps of 20 ms, grew beyond all bounds."""
    quick = Plant("quick", (x, v), (v, 200 * (u - v)), (u,))
    setting = Setting(quick, 1.0, **ONE)
    with pytest.raises(ValueError, match=r"time constant of 0.005 s, too short for 1 Runge-Kutta step .* substeps = 2"):
        PlantMpc(5, {"x": 1.0}).check(setting, 0.02)
    PlantMpc(5, {"x": 1.0}, substeps=2).check(setting, 0.02)


def test_what_it_cannot_be_told_of_is_one_line():
    f = sp.Symbol("f", real=True)
    two = Plant("two", (x, v), (v, u + f), (u, f))
    with pytest.raises(ValueError, match=r"delays differ, u 0.1 s, f 0 s"):
        PlantMpc(5, {"x": 1.0}, predictor=True).check(Setting(two, 1.0, delay_s={"u": 0.1}, **ONE), 0.1)
    with pytest.raises(ValueError, match=r"lag of u, 0.01 s, is too short .* give 10 substeps or more"):
        PlantMpc(5, {"x": 1.0}, predictor=True).check(Setting(CART, 1.0, lag_s={"u": 0.01}, **ONE), 0.2)
    with pytest.raises(ValueError, match="disturbance_gain is for plants all of whose"):
        PlantMpc(5, {"x": 1.0}, disturbance_gain=0.5, observer={"v": 1.0})
    with pytest.raises(ValueError, match="first_spread is for an observer"):
        PlantMpc(5, {"x": 1.0}, first_spread={"v": 1.0})
    m = sp.Symbol("m", positive=True)
    clocked = Plant("clocked", (x, v), (v, u / m + sp.sin(time)), (u,), parameters=(Parameter(m, 1.0),))
    with pytest.raises(ValueError, match="'v' of plant 'clocked' moves by the clock"):
        PlantMpc(5, {"x": 1.0}).check(Setting(clocked, 1.0, **ONE), 0.1)
