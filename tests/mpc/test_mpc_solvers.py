"""Every solver that is offered closes the loop at ipopt's cost; the compiled one solves what an outside solver does."""

import functools

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpc_runs import LOADS, closed_loop, problem_of
from scipy.optimize import minimize

from workbench.errors import SolverError
from workbench.mpc import kernels as memory_of
from workbench.mpc import transcription
from workbench.mpc.kernels import kernels
from workbench.mpc.linear import LinearMpc
from workbench.mpc.model import ACTUATORS
from workbench.mpc.nonlinear import NonlinearMpc
from workbench.mpc.problem import Weights
from workbench.mpc.transcription import SOLVERS, CasadiMpc

MAKERS = {"compiled": NonlinearMpc, **{name: functools.partial(CasadiMpc, solver=name) for name in SOLVERS}}
STEPS = 90


@functools.cache
def loop_with(name, actuator, load, horizon=20):
    problem, ahead = problem_of(horizon, actuator, load)
    return closed_loop(problem, ahead, MAKERS[name](problem, ahead), STEPS)


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("actuator", ACTUATORS)
@pytest.mark.parametrize("name", [name for name in MAKERS if name != "ipopt"])
def test_every_offered_solver_closes_the_loop_at_ipopts_cost(name, actuator, load, capfd):
    cost, commands, solutions = loop_with(name, actuator, load)
    assert capfd.readouterr() == ("", "")
    expected, at, reference = loop_with("ipopt", actuator, load)
    assert all(s.solved for s in solutions)
    assert all(s.solved for s in reference)
    assert cost == pytest.approx(expected, rel=1e-6)
    assert commands == pytest.approx(at, abs=1e-4)


def test_the_loops_hold_both_limits_and_a_price_that_is_paid():
    _, commands, _ = loop_with("compiled", "lag", "power, for long")
    assert commands.max() == pytest.approx(1.0)
    problem, ahead = problem_of(load="power, for long")
    _, commands, _ = closed_loop(problem, ahead, NonlinearMpc(problem, ahead), 10, start=(6.0, 2.0, 0.0))
    assert commands.min() == pytest.approx(-1.0, abs=1e-9)
    least = loop_with("compiled", "lag", "nothing")[0]
    assert loop_with("compiled", "lag", "power, for long")[0] > 10 * least


def test_a_long_horizon_is_solved_alike():
    cost, commands, _ = loop_with("compiled", "lag", "power, for long", 50)
    expected, at, _ = loop_with("fatrop", "lag", "power, for long", 50)
    assert cost == pytest.approx(expected, rel=1e-6)
    assert commands == pytest.approx(at, abs=1e-4)


@pytest.mark.parametrize("solver", ["osqp", "daqp", "bonmin", "", "nonsense"])
def test_a_solver_that_is_not_offered_is_refused(solver):
    with pytest.raises(SolverError, match="choose one of ipopt"):
        CasadiMpc(*problem_of(), solver=solver)


@pytest.mark.parametrize(("program", "options"), [
    ("daqp", {}), ("fatrop", {"structure_detection": "auto", "fatrop": {"print_level": 0}})])
def test_what_is_not_offered_is_wrong(program, options, monkeypatch):
    """sqpmethod with these for its programs: many times the cost. Offer them when this test fails."""
    sqp = transcription.SOLVERS["sqp_qrqp"][1] | {"qpsol": program, "qpsol_options": options | {"error_on_fail": False}}
    monkeypatch.setitem(SOLVERS, "wrong", ("sqpmethod", sqp))
    problem, ahead = problem_of(load="power, for long")
    cost, _, solutions = closed_loop(problem, ahead, CasadiMpc(problem, ahead, "wrong"), 40)
    right, _, _ = closed_loop(problem, ahead, NonlinearMpc(problem, ahead), 40)
    assert cost > 2 * right or not all(s.solved for s in solutions)


def independent_program(mpc, problem, ahead, sample, state, plan=None):
    """The linear program of a sample from its matrices, by cvxpy with clarabel; of a plan its cost, and the least."""
    N, w = problem.horizon, problem.weights
    x, u, s = cp.Variable((N + 1, 3)), cp.Variable(N), cp.Variable((N, 4))
    rows = ahead[sample : sample + N + 1]
    cost = cp.quad_form(x[N] - rows[N, :3], cp.psd_wrap(mpc.lqr.cost))
    constraints = [x[0] == state, s >= 0, u >= problem.lowest_command_mps2, u <= problem.highest_command_mps2]
    for k in range(N):
        jac, gap = mpc.along.jac[sample + k].reshape(3, 4), mpc.along.gap[sample + k]
        base, desired = mpc.along.x[sample + k], rows[k]
        following = rows[k + 1, :3] + gap + jac[:, :3] @ (x[k] - base) + jac[:, 3] * (u[k] - desired[3])
        constraints.append(x[k + 1] == following)
        e = x[k] - desired[:3]
        cost += (w.position * e[0] ** 2 + w.speed * e[1] ** 2 + w.command * (u[k] - desired[3]) ** 2
                 + w.change * (u[k] - x[k, 2]) ** 2 + sum(p[0] * s[k, i] + p[1] * s[k, i] ** 2
                                                          for i, p in enumerate(problem.price)))
        if k:
            F = min(base[2], problem.power_w_per_kg / max(base[1], 1e-3))
            power = base[1] * x[k, 2] + F * x[k, 1] - base[1] * F
            constraints += [power - problem.power_w_per_kg <= s[k, 0], e[0] - problem.band_m <= s[k, 1],
                            -e[0] - problem.band_m <= s[k, 2]]
    asked = cp.Problem(cp.Minimize(cost), constraints)
    asked.solve(solver=cp.CLARABEL, tol_gap_abs=1e-11, tol_gap_rel=1e-11, tol_feas=1e-11)
    if plan is None:
        return u.value
    least = asked.value
    asked = cp.Problem(cp.Minimize(cost), [*constraints, u == np.clip(plan, -1.0 + 1e-9, 1.0 - 1e-9)])
    asked.solve(solver=cp.CLARABEL)
    return asked.value, least


@functools.cache
def banded(squares):
    price = ((1e3, squares), (50.0, squares), (50.0, squares), (1e3, 0.0))
    problem, ahead = problem_of(12, "lag", "power, a little", band_m=0.5, price=price)
    return problem, ahead, LinearMpc(problem, ahead)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 100), st.tuples(st.floats(-8, 8), st.floats(-3, 3), st.floats(-1, 1)),
       st.sampled_from([0.0, 20.0]))
def test_linear_programs_are_solved_as_an_outside_solver_does(sample, error, squares):
    problem, ahead, mpc = banded(squares)
    state = ahead[sample, :3] + error
    mpc.forget()
    solution = mpc.solve(sample, state)
    assert solution.solved
    assert solution.plan == pytest.approx(independent_program(mpc, problem, ahead, sample, state), abs=2e-5)


EXPONENT = st.floats(-3, 4)


@settings(max_examples=10, deadline=None)
@given(st.tuples(EXPONENT, EXPONENT, st.floats(-1, 2)), st.tuples(st.floats(0, 4), st.floats(0, 4)), st.floats(-1, 1),
       st.integers(0, 100), st.tuples(st.floats(-50, 50), st.floats(-3, 3), st.floats(-1, 1)))
def test_weights_prices_and_errors_of_all_sizes_are_solved(weights, prices, band, sample, error):
    price = ((10 ** prices[0], 0.0), (10 ** prices[1], 1.0), (10 ** prices[1], 1.0), (1.0, 0.0))
    weights = Weights(*(10**x for x in weights))
    problem, ahead = problem_of(8, band_m=10**band, price=price, weights=weights)
    mpc = LinearMpc(problem, ahead)
    state = ahead[sample, :3] + error
    solution = mpc.solve(sample, state)
    assert solution.solved
    cost, least = independent_program(mpc, problem, ahead, sample, state, solution.plan)
    assert cost <= least * (1 + 1e-5) + 1e-5


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 100), st.tuples(st.floats(-8, 8), st.floats(-3, 3), st.floats(-1, 1)))
def test_the_interior_point_method_alone_finds_the_same_plan(sample, error):
    _, ahead, mpc = banded(0.0)
    state = ahead[sample, :3] + error
    mpc.forget()
    expected = mpc.solve(sample, state).plan
    alone, N = np.zeros(12), 12
    window = slice(sample, sample + N + 1)
    how, _ = kernels("lag").solve_linear(
        state, mpc.along.x[window], mpc.along.u[sample : sample + N], mpc.along.jac[sample : sample + N],
        mpc.along.gap[sample : sample + N], mpc.along.h[window], mpc.along.g[window], ahead[window], *mpc._fixed,
        memory_of.memory(N), memory_of.workspace(N), alone, 0, 60)
    assert how == 1
    assert alone == pytest.approx(expected, abs=1e-5)


def test_a_warm_start_changes_the_work_and_not_the_plan():
    problem, ahead = problem_of(30, load="power, a little")
    warm, cold = LinearMpc(problem, ahead), LinearMpc(problem, ahead)
    passes = [0, 0]
    state = ahead[20, :3] + [-4.0, 0.0, 0.0]
    for k in range(20, 60):
        cold.forget()
        one, other = warm.solve(k, state), cold.solve(k, state)
        assert one.plan == pytest.approx(other.plan, abs=1e-6)
        passes[0], passes[1] = passes[0] + one.passes, passes[1] + other.passes
        state = np.array(kernels("lag").follow(*state, one.plan[0], 0.0, problem.parameters))
    assert passes[0] < passes[1]


@pytest.mark.parametrize("kind", [LinearMpc, NonlinearMpc])
@pytest.mark.parametrize("actuator", ACTUATORS)
def test_rows_that_come_to_their_limit_beside_held_commands_hardly_ever_need_an_interior_point(actuator, kind):
    """The run moves through the horizon sample by sample: commands at their limit, then power at its own to the end."""
    problem, ahead = problem_of(50, actuator, "power, for long")
    mpc = kind(problem, ahead)
    _, commands, solutions = closed_loop(problem, ahead, mpc, 60)
    assert commands.max() == pytest.approx(1.0)
    assert all(s.solved for s in solutions)
    few = [s.passes for s in solutions if not s.interior]
    assert len(few) >= 58 and max(few[1:]) <= 8


def test_the_nonlinear_plan_cannot_be_improved_by_a_search_that_knows_no_derivatives_of_ours():
    problem, ahead = problem_of(6, "direct", "power, a little")
    mpc = NonlinearMpc(problem, ahead)
    state = ahead[30, :3] + [-1.0, 0.3, 0.0]
    plan = mpc.solve(30, state).plan
    window, module = ahead[30:37], kernels("direct")
    x, h, g = np.zeros((7, 3)), np.zeros(4), np.zeros((4, 3))

    def cost(commands):
        module.roll_out.py_func(state, commands, window, problem.parameters, x)
        return module.cost_of.py_func(x, commands, window, problem.weights.array(), mpc.lqr.upper(), problem.limits(),
                              problem.rows(ahead), np.array(problem.price), h, g)

    assert cost(plan) == pytest.approx(mpc.cost, rel=1e-12)
    found = minimize(cost, plan + 0.01, method="Nelder-Mead", bounds=[(-1.0, 1.0)] * 6,
                     options={"maxfev": 4000, "xatol": 1e-9, "fatol": 1e-10})
    assert found.fun >= mpc.cost - 1e-7


EVERY = {**MAKERS, "linear": LinearMpc}


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e200])
@pytest.mark.parametrize("name", EVERY)
def test_a_state_that_is_no_number_is_an_answer_not_to_be_used_and_then_forgotten(name, bad, capfd):
    problem, ahead = problem_of(10)
    mpc, twin = EVERY[name](problem, ahead), EVERY[name](problem, ahead)
    mpc.solve(30, ahead[30, :3])
    solution = mpc.solve(31, np.array([bad, 1.0, 0.0]))
    assert not (solution.solved and not np.isfinite(solution.plan).all())
    if not np.isfinite(bad):
        assert not solution.solved
        assert solution.why
    good = mpc.solve(32, ahead[32, :3] + [0.1, 0.0, 0.0])
    assert good.solved
    assert good.plan == pytest.approx(twin.solve(32, ahead[32, :3] + [0.1, 0.0, 0.0]).plan, abs=1e-4)
    assert capfd.readouterr().out == ""


def test_one_iteration_a_sample_loses_little():
    problem, ahead = problem_of(20, "lag", "power, a little")
    full, _, _ = closed_loop(problem, ahead, NonlinearMpc(problem, ahead), STEPS)
    single, _, solutions = closed_loop(problem, ahead, NonlinearMpc(problem, ahead, most_programs=1), STEPS)
    assert {s.programs for s in solutions} == {1}
    assert single == pytest.approx(full, rel=1e-3)
