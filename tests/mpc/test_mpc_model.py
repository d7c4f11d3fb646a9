"""The model of MPC against a reference integrator, its derivatives against differences, its LQR against theory."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpc_runs import problem_of
from scenarios import short_scenario
from scipy.integrate import solve_ivp
from scipy.linalg import solve_discrete_are

from workbench.compile.code_cache import kept_texts
from workbench.errors import InputError
from workbench.mpc import model as model_module
from workbench.mpc.kernels import kernels
from workbench.mpc.model import ACTUATORS, kernel_functions, model
from workbench.mpc.preview import preview
from workbench.mpc.problem import Problem, Weights
from workbench.mpc.terminal import lqr
from workbench.trains.track import ResistanceTable

STATES = st.tuples(st.floats(0, 1e3), st.floats(0, 40), st.floats(-1, 1), st.floats(-1, 1), st.floats(-0.2, 0.2))


@pytest.mark.parametrize("actuator", ACTUATORS)
@given(STATES)
def test_a_period_is_what_the_train_does(actuator, at):
    problem, _ = problem_of(actuator=actuator)
    p, v, F, u, f = at
    a, b, c = problem.davis

    def rates(_, x):
        acting = x[2] if actuator == "lag" else u
        lag = (u - x[2]) / problem.lag_s if actuator == "lag" else 0.0
        return [x[1], acting - a - b * x[1] - c * x[1] ** 2 + f, lag]

    exact = solve_ivp(rates, (0, problem.period_s), [p, v, F], rtol=1e-11, atol=1e-12).y[:, -1]
    after = np.array(kernels(actuator).follow(*at, problem.parameters))
    # One step of Runge-Kutta over the period of the lag itself: its error is (T/tau)^5/120 of the change, which is 2.
    assert after[:2] == pytest.approx(exact[:2], abs=1e-2)
    assert after[2] == pytest.approx(exact[2] if actuator == "lag" else u, abs=2e-2)
    of_casadi = np.asarray(model(actuator).casadi_step()(*at, *problem.parameters)).ravel()
    assert after == pytest.approx(of_casadi, rel=1e-13, abs=1e-13)


@given(STATES)
def test_with_a_direct_actuator_a_period_is_exact_to_rounding(at):
    problem, _ = problem_of(actuator="direct", period_s=0.1)
    p, v, _, u, f = at
    a, b, c = problem.davis
    exact = solve_ivp(lambda _, x: [x[1], u - a - b * x[1] - c * x[1] ** 2 + f], (0, 0.1), [p, v], rtol=1e-12,
                      atol=1e-12).y[:, -1]
    assert np.array(kernels("direct").follow(*at, problem.parameters))[:2] == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("actuator", ACTUATORS)
@given(STATES)
def test_the_compiled_derivatives_are_differences(actuator, at):
    problem, _ = problem_of(actuator=actuator)
    module, x = kernels(actuator), np.array(at)
    jac, gap = np.zeros(12), np.zeros(3)
    module.linearise_at(x[:3], x[3], x[4], problem.parameters, jac, gap, np.zeros(3))
    assert gap == pytest.approx(module.follow(*at, problem.parameters), rel=1e-15)
    for i in range(4):
        step = np.eye(5)[i] * 1e-4
        change = np.subtract(module.follow(*(x + step), problem.parameters),
                             module.follow(*(x - step), problem.parameters)) / 2e-4
        assert jac.reshape(3, 4)[:, i] == pytest.approx(change, abs=1e-6)


@pytest.mark.parametrize("actuator", ACTUATORS)
def test_the_terminal_cost_is_riccatis_and_what_the_feedback_costs(actuator):
    problem, _ = problem_of(actuator=actuator)
    beyond, w = lqr(problem), problem.weights
    q, r = np.diag([w.position, w.speed, w.force + w.change]), np.array([[w.command + w.change]])
    cross = np.array([[0], [0], [-w.change]])
    assert beyond.cost == pytest.approx(solve_discrete_are(beyond.A, beyond.B, q, r, s=cross), rel=1e-8)
    x, total = np.array([1.0, -0.5, 0.2]), 0.0
    for _ in range(600):
        u = -beyond.gain @ x
        total += x @ q @ x + r[0, 0] * u**2 + 2 * (x @ cross)[0] * u
        x = beyond.A @ x + beyond.B[:, 0] * u
    start = np.array([1.0, -0.5, 0.2])
    assert total == pytest.approx(start @ beyond.cost @ start, rel=1e-9)


@pytest.mark.parametrize("actuator", ACTUATORS)
def test_the_command_of_the_preview_keeps_the_train_on_the_desired_run(actuator):
    problem, _ = problem_of(actuator=actuator, load="nothing")
    curve = short_scenario().desired_curve()
    ahead = preview(problem, curve, curve.trip_time_s, line=ResistanceTable(np.array([0.0, 300.0]), np.array([0, .04])))
    x = ahead[0, :3]
    for row, following in pairwise(ahead):
        x = np.array(kernels(actuator).follow(*row[:4], row[5], problem.parameters))
        assert x == pytest.approx(following[:3], abs=2e-2)
    assert set(np.round(ahead[:, 5], 12)) == {0.0, -0.04}


@pytest.mark.parametrize(("changes", "words"), [
    ({"horizon": 1}, "horizon: 1 is no whole number from 2 to 1000"),
    ({"horizon": 10**9}, "no whole number from 2 to 1000"),
    ({"period_s": 0.0}, "must be positive"),
    ({"period_s": float("nan")}, "must be positive"),
    ({"lag_s": 0.1}, "too short for Runge-Kutta"),
    ({"actuator": "none"}, "choose one of direct, lag"),
    ({"lowest_command_mps2": 0.5}, "on both sides of zero"),
    ({"highest_command_mps2": float("inf")}, "must be finite"),
    ({"price": ((1.0, 0.0),)}, "two finite numbers"),
    ({"price": ((-1.0, 0.0),) * 4}, "two finite numbers"),
    ({"band_m": -1.0}, "must be positive"),
    ({"power_w_per_kg": float("nan")}, "must be positive"),
])
def test_a_problem_that_cannot_be_is_refused_in_one_line(changes, words):
    with pytest.raises(InputError, match=words) as trouble:
        problem_of(**changes)
    assert "\n" not in str(trouble.value)


@pytest.mark.parametrize("changes", [{"position": 0.0}, {"command": 0.0}, {"speed": -1.0}, {"change": float("nan")},
                                     {"force": 1e300}])
def test_weights_that_give_no_feedback_are_refused(changes):
    with pytest.raises(InputError, match="choose a weight within"):
        Weights(**({"position": 1.0, "speed": 1.0, "command": 1.0} | changes))


def test_weights_too_far_apart_are_refused():
    problem = Problem(10, 0.1, (0.1, 0.0, 0.0), -1.0, 1.0, Weights(1e-9, 0.0, 1e12))
    with pytest.raises(InputError, match="choose weights nearer"):
        lqr(problem)


def test_its_texts_are_made_once_and_anew_when_anything_that_they_depend_on_has_changed(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    source, made = tmp_path / "source.py", []
    source.write_text("a")

    def texts(*made_of):
        return kept_texts(made_of, (source,), lambda: (str(made.append(made_of)), *made_of))

    for made_of, times in ((("x",), 1), (("x",), 1), (("x", ""), 2), (("", "x"), 3), (("x\n0 ",), 4), (("x",), 4)):
        assert texts(*made_of) == ("None", *made_of)
        assert len(made) == times
    source.write_text("b")
    assert texts("x") == ("None", "x") and len(made) == 5
    for path in (tmp_path / "cache").rglob("*.sealed-texts"):
        path.write_bytes(path.read_bytes()[:-1] + b"?")
    assert texts("x") == ("None", "x") and len(made) == 6
    assert "damaged" in capsys.readouterr().err
    # The model's own: another process takes derivatives of nothing.
    first = kernel_functions.__wrapped__("lag")
    monkeypatch.setattr(model_module, "_kernel_functions", lambda actuator: pytest.fail("derived again"))
    assert kernel_functions.__wrapped__("lag") == first
    with pytest.raises(pytest.fail.Exception, match="derived again"):
        kernel_functions.__wrapped__("direct")
