"""MPC of a train of cars against a second typing of the train, an outside solver, and every number of cars."""

import functools

import casadi as ca
import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.linalg import solve_discrete_are
from scipy.optimize import lsq_linear

from workbench.errors import InputError, SolverError
from workbench.model.desired_curve import start_cruise_stop
from workbench.mpc import box_program
from workbench.mpc.box_program import BoxProgram
from workbench.mpc.car_model import CarTrain, period, resistance, train_rates
from workbench.mpc.multi_car import COUNTERS, CarWeights, MultiCarMpc, patterns

T, N = 0.5, 12
VALUES = (0.00775, 0.000228, 0.0000166, 2e6, 1e5)  # chen2019, Table 1
WEIGHTS = CarWeights(1.0, 1.0, 0.1)


def train_of(n):
    """chen2019's cars: every other one has a motor, all have brakes."""
    return CarTrain(np.full(n, 5e4), np.full(n, -4e4), np.where(np.arange(n) % 2 == 0, 4e4, 0.0), VALUES)


@functools.cache
def desired():
    curve = start_cruise_stop(2500.0, 25.0, 0.3, 0.4, 4.0)
    times = np.arange(int(curve.trip_time_s / T) + N + 12) * T
    return np.stack(curve.at(times), axis=1)


def mpc_of(n, **changes):
    values = {"train": train_of(n), "desired": desired(), "horizon": N, "period_s": T, "weights": WEIGHTS,
              "speed_mps": 25.0}
    return MultiCarMpc(**(values | changes))


def typed_again(x, u, n):
    """Rates of chen2019 (1)-(3) from matrices."""
    c_0, c_v, c_a, c_k, c_d = VALUES
    s, v, m = x[:n], x[n:], np.full(n, 5e4)
    A = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    A[0, 0] = A[-1, -1] = 1
    air = np.zeros(n)
    air[0] = c_a * m.sum() * v[0] ** 2
    return np.concatenate([v, (u - m * (c_0 + c_v * v) - air - c_k * A @ s - c_d * A @ v) / m])


@pytest.mark.parametrize("n", [2, 6, 32])
def test_the_rates_are_those_of_the_matrices(n):
    draw = np.random.default_rng(n)
    x, u = np.concatenate([draw.normal(0, 0.05, n), draw.uniform(0, 80, n)]), draw.uniform(-4e4, 4e4, n)
    assert np.asarray(train_rates(train_of(n))(x, u)).ravel() == pytest.approx(typed_again(x, u, n), rel=1e-9)


@pytest.mark.parametrize("n", [2, 6])
def test_a_period_is_exact_for_small_errors_around_its_speed(n):
    of, draw, speed, size = period(train_of(n), T, 25.0), np.random.default_rng(n), 25.0, 1e-3
    e, u = size * draw.normal(0, 0.1, 2 * n), size * draw.normal(0, 1, n)
    still = np.concatenate([np.zeros(n), np.full(n, speed)])
    r = np.asarray(resistance(train_of(n))(speed)).ravel()

    def rates(t, x):  # the train, less a run at this speed that the resistances push off
        run = np.concatenate([np.full(n, speed * t), np.full(n, speed)])
        return typed_again(run + x, u * 5e4, n) - np.concatenate([np.full(n, speed), r])

    after = solve_ivp(rates, (0, T), e, rtol=1e-10, atol=1e-13, method="DOP853").y[:, -1]
    assert after == pytest.approx(of.A @ e + of.B @ u, abs=1e-5 * size)
    assert r == pytest.approx(typed_again(still, np.zeros(n), n)[n:], rel=1e-12)


@pytest.mark.parametrize("n", [2, 6])
def test_the_terminal_cost_is_riccatis(n):
    ours, q = mpc_of(n), np.diag(np.repeat([WEIGHTS.position, WEIGHTS.speed], n))
    expected = solve_discrete_are(ours._of.A, ours._of.B, q, WEIGHTS.command * np.eye(n))
    assert ours.terminal == pytest.approx(expected, rel=1e-6, abs=1e-9)


def independent(ours, n, k, error):
    """The program stage by stage, by cvxpy with clarabel."""
    e, u = cp.Variable((N + 1, 2 * n)), cp.Variable((N, n))
    push, shares = ours._push[k : k + N], ours._shares[k : k + N]
    constraints = [e[0] == error, u >= np.tile(ours._low[:n], (N, 1)), u <= np.tile(ours._high[:n], (N, 1))]
    root = np.linalg.cholesky(ours.terminal + 1e-12 * np.eye(2 * n)).T
    cost = cp.sum_squares(root @ e[N]) + WEIGHTS.command * cp.sum_squares(u - shares)
    for i in range(N):
        cost += cp.sum_squares(cp.multiply(np.sqrt(ours._q), e[i]))
        constraints.append(e[i + 1] == ours._of.A @ e[i] + ours._of.B @ (u[i]) + ours._of.C @ push[i])
    cp.Problem(cp.Minimize(cost), constraints).solve(
        solver=cp.CLARABEL, tol_gap_abs=1e-10, tol_gap_rel=1e-10, tol_feas=1e-10)
    return u.value


@pytest.mark.parametrize(("n", "k", "spread"), [(6, 4, 0.0), (6, 20, 2.0), (6, 150, -3.0), (8, 190, 1.0), (3, 60, 0.2)])
def test_the_plan_is_an_outside_solvers(n, k, spread):
    ours, draw = mpc_of(n), np.random.default_rng(k)
    position = desired()[k, 0] + spread + draw.normal(0, 0.01, n)
    speed = desired()[k, 1] + draw.normal(0, 0.05, n)
    forces = ours.command(k, position, speed)
    expected = independent(ours, n, k, np.concatenate([position - desired()[k, 0], speed - desired()[k, 1]]))
    assert forces / 5e4 == pytest.approx(expected[0], abs=2e-4)
    assert ours._plan.reshape(N, n) == pytest.approx(expected, abs=1e-3)


@functools.cache
def train_step(n):
    """The train itself over a period, by RK4 of 10 ms, forces held."""
    rates, x, u, h = train_rates(train_of(n)), ca.SX.sym("x", 2 * n), ca.SX.sym("u", n), 0.01
    k1 = rates(x, u)
    k2 = rates(x + h / 2 * k1, u)
    k3 = rates(x + h / 2 * k2, u)
    k4 = rates(x + h * k3, u)
    return ca.Function("step", [x, u], [x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)]).fold(round(T / h))


def run(n, mpc, samples, bad=()):
    """Position errors (samples, n) and forces of a loop from 1 m behind."""
    x, errors, forces = np.concatenate([np.full(n, -1.0), np.zeros(n)]), [], []
    for k in range(samples):
        measured = np.full(2 * n, np.nan) if k in bad else x
        F = mpc.command(k, measured[:n], measured[n:])
        x = np.asarray(train_step(n)(x, np.tile(F.reshape(-1, 1), (1, round(T / 0.01))))).ravel()
        errors.append(x[:n] - desired()[k + 1, 0])
        forces.append(F)
    return np.array(errors), np.array(forces)


@pytest.mark.parametrize("n", [6, 8, 12, 16, 24, 32])
def test_trains_of_every_length_follow_within_every_cars_limits(n):
    ours, samples = mpc_of(n), 250
    errors, forces = run(n, ours, samples)
    train = train_of(n)
    assert (forces >= train.lowest_n).all()
    assert (forces <= train.highest_n).all()
    assert (forces[:, 1::2] <= 0).all()  # trailers only brake
    assert (forces[:, 0] == 4e4).any()  # the limits bind
    assert np.abs(errors[60:]).max() < 0.06
    assert ours.counters == dict.fromkeys(COUNTERS, 0) | {"qp": samples}


def test_bad_measurements_cost_little_and_are_counted():
    bad = {30, 31, 32, 100}
    ours = mpc_of(6)
    errors, _ = run(6, ours, 130, bad)
    assert np.abs(errors[60:]).max() < 0.06
    assert (ours.counters["bad_measurement"], ours.counters["shifted_plan"]) == (4, 4)
    assert ours.counters["qp"] == 126
    fresh = mpc_of(6)
    forces = fresh.command(10, np.full(6, np.inf), np.zeros(6))
    assert forces == pytest.approx(fresh._shares[10] * 5e4)
    assert fresh.counters["feedforward"] == 1


class _Failing:
    def solve(self, *_):
        raise SolverError("no answer after 100 steps")


def test_a_failed_program_is_answered_by_the_shifted_plan_then_by_the_lqr_and_explained():
    ours = mpc_of(6)
    position, speed = np.full(6, desired()[20, 0] - 0.05), np.full(6, desired()[20, 1])
    ours.command(20, position, speed)
    plan, ours._program = ours._plan.reshape(N, 6), _Failing()
    assert ours.command(22, position, speed) == pytest.approx(plan[2] * 5e4)
    late = 20 + N
    error = np.linspace(-0.03, 0.02, 12)
    needed = ours._shares[late] - ours.gain @ error
    assert ours.command(late, desired()[late, 0] + error[:6], desired()[late, 1] + error[6:]) == pytest.approx(
        np.clip(needed, ours._low[:6], ours._high[:6]) * 5e4)
    assert {k: c for k, c in ours.counters.items() if c} == {"qp": 3, "qp_failed": 2, "shifted_plan": 1, "lqr": 1}
    assert ours.trouble == {"no answer after 100 steps": 2}


@settings(max_examples=40)
@given(st.integers(1, 25), st.integers(0, 2**32 - 1), st.floats(0.0, 6.0))
def test_programs_with_bounds_are_solved_as_an_outside_solver_does(n, seed, stiff):
    draw = np.random.default_rng(seed)
    rows = draw.normal(size=(n + 3, n)) * 10 ** draw.uniform(-stiff / 4, stiff / 4, n)
    aim = draw.normal(size=n + 3) * 3
    low = draw.uniform(-1.0, 0.0, n)
    high = low + draw.choice([0.0, 0.5, 1.5], n)
    program = BoxProgram(rows.T @ rows)
    best, start = program.unbounded(-rows.T @ aim), draw.uniform(-2, 2, n)
    found, _ = program.solve(best, low, high, start)
    assert ((found >= low) & (found <= high)).all()
    expected = lsq_linear(rows, aim, (low - 1e-12, high + 1e-12), method="bvls", tol=1e-14).x
    cost, least = (float(np.sum((rows @ x - aim) ** 2)) for x in (found, np.clip(expected, low, high)))
    assert cost <= least * (1 + 1e-9) + 1e-12
    # The way that is taken where guesses do not come to rest gives the same; so does a guess that is the answer.
    stepped, _ = program._stepped(best, low, high, start)
    assert program.solve(best, low, high, stepped)[0] == pytest.approx(found, abs=1e-9)
    assert float(np.sum((rows @ stepped - aim) ** 2)) <= least * (1 + 1e-9) + 1e-12


def test_guesses_that_do_not_come_to_rest_are_left_for_steps(monkeypatch):
    monkeypatch.setattr(box_program, "MOST_GUESSES", 1)
    H, best = np.array([[2.0, 1.9], [1.9, 2.0]]), np.array([1.5, 0.2])
    found, solved = BoxProgram(H).solve(best, -np.ones(2), np.ones(2), np.zeros(2))
    assert found == pytest.approx([1.0, 0.2 + 0.5 * 1.9 / 2])  # the first at its bound, the second free
    assert solved > 1


@pytest.mark.parametrize(("low", "best"), [(2.0, 0.0), (0.0, np.nan), (0.0, np.inf)])
def test_a_program_without_an_answer_says_so(low, best):
    with pytest.raises(SolverError, match="has no answer"):
        BoxProgram(np.eye(2)).solve(np.array([best, 0.0]), np.array([low, 0.0]), np.ones(2), np.zeros(2))


@pytest.mark.parametrize("uneven", [False, True])
def test_the_plan_without_limits_is_that_of_the_program_stage_by_stage(uneven):
    """The program of a loop is the old one: the same Hessian, and what it is linear in summed up sample by sample."""
    n, k, draw = 5, 30, np.random.default_rng(3)
    train = train_of(n) if not uneven else CarTrain(draw.uniform(3e4, 6e4, n), -draw.uniform(3e4, 5e4, n),
                                                    draw.uniform(0, 4e4, n), VALUES)
    ours, error = mpc_of(n, train=train), draw.normal(size=2 * n)
    errors, of, f = [error], ours._of, np.empty((N, n))
    for i in range(N):
        errors.append(of.A @ errors[-1] + of.C @ ours._push[k + i])
    costate = ours.terminal @ errors[N]
    for i in range(N - 1, -1, -1):
        f[i] = of.B.T @ costate - WEIGHTS.command * ours._shares[k + i]
        costate = ours._q * errors[i] + of.A.T @ costate
    assert ours._best(k, error) == pytest.approx(np.linalg.solve(ours._hessian(), -2 * f.ravel()), abs=1e-9)


def test_rows_are_made_of_as_few_patterns_as_they_have():
    draw = np.random.default_rng(4)
    rows = draw.normal(size=(40, 2)) @ draw.normal(size=(2, 7))
    sizes, of = patterns(rows)
    assert of.shape == (2, 7)
    assert sizes @ of == pytest.approx(rows, abs=1e-13)
    assert patterns(np.zeros((3, 7)))[1].shape == (0, 7)


def test_a_cost_that_is_not_convex_is_refused():
    with pytest.raises(SolverError, match="not positive definite"):
        BoxProgram(np.diag([1.0, -1.0]))


@pytest.mark.parametrize(("changes", "words"), [
    ({"horizon": 1}, "horizon: 1 samples of 6 cars"),
    ({"horizon": 10**6}, "samples of 6 cars"),
    ({"horizon": 600}, "longer than the run"),
])
def test_a_horizon_that_does_not_fit_is_refused(changes, words):
    with pytest.raises(InputError, match=words):
        mpc_of(6, **changes)


@pytest.mark.parametrize(("changes", "words"), [
    ({"mass_kg": np.ones(1), "lowest_n": -np.ones(1), "highest_n": np.ones(1)}, "for 2 to 64 cars"),
    ({"lowest_n": np.array([-1.0, -1.0, -1.0])}, "for 2 to 64 cars"),
    ({"mass_kg": np.array([1.0, 0.0])}, "masses must be positive"),
    ({"mass_kg": np.array([1.0, np.nan])}, "masses must be positive"),
    ({"lowest_n": np.array([1.0, -1.0])}, "include no force"),
    ({"highest_n": np.zeros(2)}, "cannot drive or cannot brake"),
])
def test_a_train_that_cannot_be_is_refused(changes, words):
    values = {"mass_kg": np.ones(2), "lowest_n": -np.ones(2), "highest_n": np.ones(2), "values": VALUES}
    with pytest.raises(InputError, match=words):
        CarTrain(**(values | changes))


@pytest.mark.parametrize("name", ["position", "speed", "command"])
def test_weights_that_give_no_feedback_are_refused(name):
    with pytest.raises(InputError, match="choose a weight within"):
        CarWeights(**({"position": 1.0, "speed": 1.0, "command": 1.0} | {name: 0.0}))


class _ByIpopt:
    """A `BoxProgram` of the same Hessian, by ipopt."""

    def __init__(self, H):
        x, best = ca.SX.sym("x", len(H)), ca.SX.sym("best", len(H))
        self._solver = ca.nlpsol("box", "ipopt", {"x": x, "p": best, "f": ca.bilin(ca.DM(H), x - best, x - best) / 2}, {
            "print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-10, "bound_relax_factor": 0.0}})

    def solve(self, best, low, high, start):
        found = self._solver(x0=start, p=best, lbx=low, ubx=high)
        assert self._solver.stats()["success"]
        return np.asarray(found["x"]).ravel(), 0


class _ByNewton:
    """A `BoxProgram` that guesses nothing."""

    def __init__(self, H):
        self._program = BoxProgram(H)

    def solve(self, *program):
        return self._program._stepped(*program)


@pytest.mark.parametrize("n", [3, 16])
def test_guessed_sets_close_the_same_loop_as_newtons_steps(n):
    ours, twin = mpc_of(n), mpc_of(n)
    twin._program = _ByNewton(ours._hessian())
    loops = [np.hstack(run(n, mpc, 40)) for mpc in (ours, twin)]
    assert loops[0] == pytest.approx(loops[1], rel=1e-8, abs=1e-4)  # of forces up to 4e4 N
    assert loops[0][:, :n] == pytest.approx(loops[1][:, :n], abs=1e-8)


@pytest.mark.parametrize("n", [2, 6])
def test_the_loop_costs_what_ipopts_does(n):
    ours, twin = mpc_of(n), mpc_of(n)
    twin._program = _ByIpopt(twin._program._H)
    costs = []
    for mpc in (ours, twin):
        errors, forces = run(n, mpc, 60)
        costs.append(WEIGHTS.position * np.sum(errors**2) + WEIGHTS.command * np.sum((forces / 5e4) ** 2))
        # While a metre is made up limits bind: of the motors, and of the trailers, which cannot pull.
        assert (forces[:, 0] >= 4e4 * (1 - 1e-6)).sum() >= 2
        assert (forces[:, 1] >= -1e-2).sum() >= 2
        assert mpc.counters["qp_failed"] == 0
    assert costs[0] == pytest.approx(costs[1], rel=1e-6)
