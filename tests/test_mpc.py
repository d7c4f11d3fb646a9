"""Tracking MPC against the same quadratic program, written from matrices for an independent solver."""

import functools
import math

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import short_scenario
from scipy.linalg import expm, solve_discrete_are

from workbench.errors import InputError, SolverError
from workbench.mpc import tracking as mpc
from workbench.mpc.tracking import PARAMETERS, SOLVERS, TrackingMpc
from workbench.simulate.closed_loop import Factors, simulate
from workbench.simulate.controllers import SAMPLED
from workbench.simulate.law_values import check_controllers
from workbench.simulate.metrics import measure

T = 0.1
SCENARIO = short_scenario()
SPEC = SCENARIO.controllers["mpc"]
BAND = SCENARIO.simulation.position_band_m
BRAKE, TRACTION = 240 / 200, 200 / 200
WEIGHTS = SPEC.parameters
N = int(WEIGHTS["horizon"])


def controller(scenario=SCENARIO, solver="daqp"):
    return TrackingMpc(scenario, scenario.controllers["mpc"], "mpc", solver)


def on_curve(time_s):
    position, speed, acceleration = SCENARIO.desired_curve().at(np.asarray(time_s, dtype=float))
    return position, speed, acceleration


@functools.cache
def independent(time_s, position_error, speed_error, disturbance=0.0, band="soft"):
    """The program from matrices: exact discretisation, Riccati terminal cost, cvxpy with clarabel."""
    a, b, c = (getattr(SCENARIO.train, k) for k in ("davis_a_mps2", "davis_b_per_s", "davis_c_per_m"))
    _, speed, acceleration = on_curve(time_s + T * np.arange(N))
    feedforward = acceleration + a + b * speed + c * speed**2
    q = np.diag([WEIGHTS["position_weight"], WEIGHTS["speed_weight"]])
    weight = WEIGHTS["command_weight"]
    terminal = solve_discrete_are(np.array([[1, T], [0, 1]]), np.array([[T**2 / 2], [T]]), q, weight)
    w, slack, x = cp.Variable(N), cp.Variable(), cp.Variable((N + 1, 2))
    cost = weight * cp.sum_squares(w + disturbance) + cp.quad_form(x[N], cp.psd_wrap(terminal))
    constraints = [x[0] == [position_error, speed_error], slack >= 0 if band == "soft" else slack == 0,
                   w >= -BRAKE - feedforward, w <= TRACTION - feedforward]
    for k in range(N):
        augmented = expm(T * np.array([[0, 1, 0], [0, -(b + 2 * c * speed[k]), 1], [0, 0, 0]]))
        constraints += [x[k + 1] == augmented[:2, :2] @ x[k] + augmented[:2, 2] * (w[k] + disturbance),
                        cp.abs(x[k + 1, 0]) <= BAND + slack]
        if k:
            cost += cp.quad_form(x[k], q)
    problem = cp.Problem(cp.Minimize(cost + WEIGHTS["band_weight"] * (slack + slack**2)), constraints)
    problem.solve(solver=cp.CLARABEL, tol_gap_abs=1e-11, tol_gap_rel=1e-11, tol_feas=1e-11)
    return problem.status, (feedforward + w.value if w.value is not None else None), slack.value


RANDOM = np.random.default_rng(7)
CASES = [(RANDOM.choice([0.0, 3.0, 20.0, 50.0, 90.0]), RANDOM.uniform(-0.5, 0.5), RANDOM.uniform(-0.6, 0.6))
         for _ in range(14)]


@pytest.mark.parametrize(("time_s", "position_error", "speed_error"), CASES)
def test_the_plan_is_the_independent_solvers(time_s, position_error, speed_error):
    position, speed, _ = on_curve(time_s)
    ours = controller()
    u = ours.command(time_s, position + position_error, speed + speed_error)
    _, plan, slack = independent(time_s, position_error, speed_error)
    # Runge-Kutta against the exact discretisation, and the tolerances of two solvers.
    assert u == pytest.approx(plan[0], abs=2e-5)
    assert -BRAKE <= u <= TRACTION
    assert ours._plan[-1] == pytest.approx(float(slack), abs=1e-6)


@pytest.mark.parametrize(("time_s", "position_error", "speed_error"), CASES)
def test_the_band_is_softened_exactly_when_it_cannot_be_kept(time_s, position_error, speed_error):
    position, speed, _ = on_curve(time_s)
    ours = controller()
    ours.command(time_s, position + position_error, speed + speed_error)
    status, _, _ = independent(time_s, position_error, speed_error, band="hard")
    assert status in ("optimal", "infeasible")
    assert ours.counters["band_slack_used"] == int(status == "infeasible")


def test_the_cases_hold_both_kinds_and_the_limits_of_both_sides():
    kinds = {independent(*case, band="hard")[0] for case in CASES}
    assert kinds == {"optimal", "infeasible"}
    commands = [independent(*case)[1][0] for case in CASES]
    assert min(commands) == pytest.approx(-BRAKE, abs=1e-6)
    assert max(commands) == pytest.approx(TRACTION, abs=1e-6)


def test_the_observer_believes_its_share_of_the_surprise():
    ours, time_s = controller(), 50.0
    position, speed, _ = on_curve([time_s, time_s + T])
    first = ours.command(time_s, position[0] + 0.01, speed[0] - 0.02)
    a, b, c = (getattr(SCENARIO.train, k) for k in ("davis_a_mps2", "davis_b_per_s", "davis_c_per_m"))
    slope = -(b + 2 * c * speed[0])
    w = first - (on_curve(time_s)[2] + a + b * speed[0] + c * speed[0] ** 2)
    predicted = math.exp(slope * T) * -0.02 + (math.exp(slope * T) - 1) / slope * w
    disturbance = WEIGHTS["observer_gain"] * (0.03 - predicted) / T
    second = ours.command(time_s + T, position[1] + 0.015, speed[1] + 0.03)
    _, plan, _ = independent(time_s + T, 0.015, 0.03, disturbance)
    assert second == pytest.approx(plan[0], abs=2e-5)
    assert abs(plan[0] - independent(time_s + T, 0.015, 0.03)[1][0]) > 1e-2  # the observer matters here


def test_an_unknown_constant_resistance_leaves_no_offset():
    # A train that resists by 20 % more and weighs 10 % more than the model, between two changes of the line.
    scenario = short_scenario(simulation__log_every_s=0.1)
    run = simulate(scenario, "mpc", Factors(mass=1.1, davis_a=1.2))
    settled = (run.column("t_s") > 52) & (run.column("s_m") < 499)
    assert run.column("s_m")[settled].min() > 450
    error = run.column("s_m") - run.column("s_desired_m")
    assert np.abs(error[settled]).max() < 1e-3
    assert run.counters["qp_failed"] == run.counters["bad_measurement"] == 0


def random_loop(seed):
    """A loop in which little traction, little braking and a tight band bind, each more or less."""
    draw = np.random.default_rng(seed)
    changes = {"train__max_traction_n": draw.uniform(148e3, 155e3),
               "train__max_braking_n": draw.choice([240e3, 15e3, 20e3]),
               "simulation__position_band_m": draw.choice([0.003, 0.01, 0.05])}
    factors = Factors(mass=draw.uniform(1.0, 1.07), davis_a=draw.uniform(1.0, 1.1),
                      line_resistance=draw.uniform(0.5, 2.0))
    return {name: float(value) for name, value in changes.items()}, factors


LOOPS = {
    "nothing binds": ({}, Factors()),
    "traction binds": ({"train__max_traction_n": 152e3, "simulation__position_band_m": 0.003},
                       Factors(davis_a=1.1)),
    "braking binds": ({"train__max_braking_n": 15e3, "simulation__position_band_m": 0.01},
                      Factors(mass=0.95)),
    **{f"random {seed}": random_loop(seed) for seed in range(6)},
}


@functools.cache
def closed_loop_with(solver, loop):
    changes, factors = LOOPS[loop]
    scenario = short_scenario(**changes)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(SAMPLED, "mpc.tracking", functools.partial(TrackingMpc, solver=solver))
        run = simulate(scenario, "mpc", factors)
    return run, measure(run, scenario)


@pytest.mark.parametrize("loop", LOOPS)
@pytest.mark.parametrize("solver", SOLVERS)
def test_every_offered_solver_closes_the_same_loop_in_silence(solver, loop, capfd):
    run, numbers = closed_loop_with(solver, loop)
    reference, expected = closed_loop_with("daqp", loop)
    assert capfd.readouterr() == ("", "")
    assert run.failed is None
    assert run.counters == reference.counters
    assert run.counters["qp_failed"] == 0
    assert (run.counters["band_slack_used"] > 50) == (loop != "nothing binds")
    # On forty other random loops the worst were 2e-5 of a cost, 7 um of an extreme and 2 mm/s^2 of a command.
    for cost in ("position_rms", "speed_rms", "energy_J"):
        assert getattr(numbers, cost) == pytest.approx(getattr(expected, cost), rel=5e-5), cost
    for extreme in ("position_error_min", "position_error_max"):  # where the tightest band is 3 mm
        assert getattr(numbers, extreme) == pytest.approx(getattr(expected, extreme), abs=2e-5), extreme
    assert run.column("u_mps2") == pytest.approx(reference.column("u_mps2"), abs=5e-3)


@pytest.mark.parametrize("solver", ["ipopt", "hpipm", "", "nonsense"])
def test_a_solver_that_is_not_offered_is_refused_before_it_is_loaded(solver):
    with pytest.raises(SolverError, match="choose one of daqp"):
        controller(solver=solver)


KINDS = ["good", "position", "speed", "time", "all"]
BAD = [math.nan, math.inf, -math.inf, 1e300, -1e12]


@settings(max_examples=25)
@given(st.lists(st.tuples(st.sampled_from(KINDS), st.sampled_from(BAD)), min_size=1, max_size=12))
def test_bad_measurements_are_counted_and_answered_by_a_command_within_the_limits(kinds):
    ours = controller()
    bad = 0
    for k, (kind, value) in enumerate(kinds):
        position, speed, _ = on_curve(50.0 + k * T)
        given_time = value if kind in ("time", "all") and not math.isfinite(value) else 50.0 + k * T
        given_position = value if kind in ("position", "all") else position
        given_speed = value if kind in ("speed", "all") else speed
        bad += not (math.isfinite(given_time) and abs(given_position) < 1e9 and abs(given_speed) < 1e4)
        u = ours.command(given_time, given_position, given_speed)
        assert -BRAKE <= u <= TRACTION
    assert ours.counters["bad_measurement"] == bad
    assert ours.counters["qp"] == len(kinds) - bad
    assert ours.counters["qp_failed"] == 0


def test_a_bad_measurement_is_answered_by_the_shifted_plan_and_then_forgotten():
    ours, twin = controller(), controller()
    position, speed, _ = on_curve(20.0 + T * np.arange(3))
    for one in (ours, twin):
        one.command(20.0, position[0] - 0.1, speed[0])
    planned = twin._plan[1] + twin._feedforward[201]
    assert ours.command(20.1, math.nan, speed[1]) == pytest.approx(planned, abs=1e-12)
    assert ours.counters["shifted_plan"] == 1
    after = ours.command(20.2, position[2] - 0.05, speed[2] + 0.1)
    # The missed sample leaves no prediction to be surprised by, so no disturbance is inferred from it.
    _, plan, _ = independent(20.2, -0.05, 0.1)
    assert after == pytest.approx(plan[0], abs=2e-5)


def test_without_any_plan_a_bad_measurement_is_answered_by_the_feedforward():
    ours = controller()
    _, speed, acceleration = on_curve(30.0)
    train = SCENARIO.train
    needed = acceleration + train.davis_a_mps2 + train.davis_b_per_s * speed + train.davis_c_per_m * speed**2
    assert ours.command(30.0, math.nan, math.nan) == pytest.approx(float(needed), rel=1e-12)
    assert ours.counters["shifted_plan"] == ours.counters["qp"] == 0


class _Failing:
    """A QP solver that fails in one of three ways."""

    def __init__(self, way):
        self.way = way

    def __call__(self, **_):
        if self.way == "raises":
            raise RuntimeError("out of iterations")
        return {"x": np.full(N + 1, math.nan if self.way == "answers nan" else 0.0)}

    def stats(self):
        return {"success": self.way == "answers nan"}


@pytest.mark.parametrize("way", ["raises", "answers nan", "says so"])
def test_a_failed_program_is_counted_and_answered_by_the_shifted_plan_else_by_the_lqr(way):
    ours = controller()
    position, speed, _ = on_curve(50.0 + T * np.arange(2))
    ours._solver = _Failing(way)
    u = ours.command(50.0, position[0] + 0.02, speed[0] - 0.01)
    q = np.diag([WEIGHTS["position_weight"], WEIGHTS["speed_weight"]])
    A, B = np.array([[1, T], [0, 1]]), np.array([[T**2 / 2], [T]])
    P = solve_discrete_are(A, B, q, WEIGHTS["command_weight"])
    gain = np.linalg.solve(WEIGHTS["command_weight"] + B.T @ P @ B, B.T @ P @ A).ravel()
    train = SCENARIO.train
    needed = train.davis_a_mps2 + train.davis_b_per_s * speed[0] + train.davis_c_per_m * speed[0] ** 2
    assert u == pytest.approx(needed - gain @ [0.02, -0.01], abs=1e-9)
    assert (ours.counters["qp_failed"], ours.counters["lqr"], ours.counters["shifted_plan"]) == (1, 1, 0)
    working = controller()
    working.command(50.0, position[0] + 0.02, speed[0] - 0.01)
    planned = working._plan[1] + working._feedforward[501]
    working._solver = _Failing(way)
    assert working.command(50.1, position[1], speed[1]) == pytest.approx(planned, abs=1e-12)
    assert (working.counters["qp_failed"], working.counters["shifted_plan"]) == (1, 1)


@settings(max_examples=25)
@given(st.floats(-1e6, 1e9), st.floats(-1e8, 1e8), st.floats(-1e3, 1e3))
def test_whatever_is_measured_the_command_is_a_number_within_the_limits(time_s, position, speed):
    ours = controller()
    for k in range(2):
        assert -BRAKE <= ours.command(time_s + k * T, position, speed) <= TRACTION


def test_the_power_limit_bounds_the_plan():
    limited = short_scenario(train__max_power_w=1000e3)
    position, speed, _ = on_curve(50.0)
    u = controller(limited).command(50.0, position - 2.0, speed)
    assert u == pytest.approx(1000e3 / 200e3 / speed, rel=1e-9)
    assert controller().command(50.0, position - 2.0, speed) == pytest.approx(TRACTION, rel=1e-9)


def _with(changes):
    kept = {k: v for k, v in (WEIGHTS | changes).items() if v is not None}
    return short_scenario(controllers__mpc__parameters=kept)


@pytest.mark.parametrize(("changes", "words"), [
    *(({name: None}, f"'{name}' is missing: add it") for name in PARAMETERS),
    ({"horizont": 25.0}, "unknown 'horizont': choose among horizon"),
    ({"horizon": 2.5}, "horizon = 2.5 is no whole number"),
    ({"horizon": 1.0}, "horizon = 1 is no whole number"),
    ({"horizon": 1e9}, "is no whole number from 2 to 1000"),
    ({"observer_gain": 0.0}, "observer_gain = 0 is outside"),
    ({"observer_gain": 1.5}, "observer_gain = 1.5 is outside"),
    *(({name: 0.0}, f"{name} = 0 is outside") for name in PARAMETERS if name.endswith("_weight")),
    ({"band_weight": -1.0}, "band_weight = -1 is outside"),
    ({"position_weight": 1e300}, r"position_weight = 1e\+300 is outside"),
    ({"position_weight": 1.0, "speed_weight": 1e-9, "command_weight": 1e9}, "choose weights nearer"),
])
def test_unfit_parameters_are_refused_naming_the_controller_and_the_file(changes, words):
    with pytest.raises(InputError, match=rf"^my\.toml: controllers\.mpc\.parameters: .*{words}"):
        check_controllers(_with(changes), "my.toml")


def test_the_counters_of_a_run_are_its_own():
    one, two = (simulate(SCENARIO, "mpc") for _ in range(2))
    assert one.counters == two.counters
    assert one.counters["qp"] == math.ceil(one.end_s / T - 1e-9)
    assert set(one.counters) == set(controller().counters)
    assert mpc.SOLVER in SOLVERS
