"""The tube against an adversary: a disturbance that pushes as far as its bound lets it stays in, and gets near."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import YANG, short_scenario
from scipy.integrate import solve_ivp
from scipy.linalg import solve_discrete_lyapunov

from workbench.errors import InputError
from workbench.model.desired_curve import start_cruise_stop
from workbench.mpc.controller import MpcController
from workbench.mpc.preview import preview
from workbench.mpc.problem import Problem, Weights
from workbench.mpc.tube import TubeMpc, extents, feedback, held, tube
from workbench.simulate.closed_loop import Factors, simulate
from workbench.trains.scenario import load_scenario

T, W = 0.1, 0.15
DAVIS = (0.3, 4e-3, 1.6e-4)


def problem_of(**changes):
    values = {"horizon": 20, "period_s": T, "davis": DAVIS, "lowest_command_mps2": -1.2, "highest_command_mps2": 1.0,
              "weights": Weights(25.0, 14.8, 4.34), "band_m": 0.2, "terminal_speed_mps": 25.0}
    problem = Problem(**(values | changes))
    return problem, preview(problem, start_cruise_stop(2200.0, 25.0, 0.3, 0.5, 8.0), 110.0)


def pushed_run(mpc, ahead, push, samples, start=(0.0, 0.0)):
    """Errors from the nominal run, twenty times a sample, of the train itself under push(time)."""
    a, b, c = DAVIS
    mpc.forget()
    x, seen = np.array([*(ahead[0, :2] + start), ahead[0, 2]]), []
    nominal = x.copy()
    for k in range(samples):
        u = float(mpc.solve(k, x).plan[0])
        after = mpc._state  # the nominal state of the next sample
        times = np.linspace(0, T, 21)
        v0, n0 = x[:2], nominal[:2]
        real = solve_ivp(lambda t, y, u=u, k=k: [y[1], u - a - b * y[1] - c * y[1] ** 2 + push(k * T + t)], (0, T), v0,
                         rtol=1e-9, atol=1e-10, t_eval=times, max_step=T / 10).y
        ideal = solve_ivp(lambda t, y, u=after[2]: [y[1], u - a - b * y[1] - c * y[1] ** 2], (0, T), n0, rtol=1e-9,
                          atol=1e-10, t_eval=times).y
        seen.append(real - ideal)
        x, nominal = np.array([*real[:, -1], u]), after.copy()
        assert abs(u - after[2]) <= mpc.around.command_mps2 + 1e-9
    return np.abs(np.concatenate(seen, axis=1)).max(axis=1)


def adversary(around, slope, direction, samples):
    """The disturbance at its bound that pushes farthest in a direction after `samples` samples."""
    signs = {}

    def push(time_s):
        k, step = int(time_s / T), round((time_s % T) / T * 20)
        if (k, step) not in signs:
            impulse = held(slope, T - step * T / 20)[0][:, 1]
            power = np.linalg.matrix_power(around.A_K, max(samples - 1 - k, 0))
            signs[k, step] = np.sign(direction @ power @ impulse)
        return W * signs[k, step]

    return push


@pytest.mark.parametrize("weights", [Weights(25.0, 14.8, 4.34), Weights(4.0, 0.5, 4.0)])
def test_the_worst_disturbance_stays_in_the_tube_and_nearly_fills_it(weights):
    problem, ahead = problem_of(weights=weights, highest_command_mps2=1.2)
    around = tube(problem, ahead, W, problem.band_m)
    assert around.holds, around.report()
    mpc, samples = TubeMpc(problem, ahead, around), 150
    slope = -(DAVIS[1] + 2 * DAVIS[2] * 15.0)
    position, speed = (pushed_run(mpc, ahead, adversary(around, slope, row, samples), samples)[i]
                       for i, row in enumerate(np.eye(2)))
    assert 0.85 * around.position_m < position <= around.position_m
    assert 0.85 * around.speed_mps < speed <= around.speed_mps


@settings(max_examples=6)
@given(st.integers(0, 2**32 - 1))
def test_random_disturbances_stay_in_the_tube(seed):
    problem, ahead = problem_of()
    around = tube(problem, ahead, W, problem.band_m)
    levels = np.random.default_rng(seed).uniform(-W, W, 400)
    position, speed = pushed_run(TubeMpc(problem, ahead, around), ahead, lambda t: levels[int(t / 0.23)], 120)
    assert position <= around.position_m
    assert speed <= around.speed_mps


@settings(max_examples=20)
@given(st.floats(0.0, 0.1), st.floats(1.0, 1e3), st.floats(0.1, 1e2))
def test_the_extents_bound_what_the_samples_of_constant_pushes_can_sum_up_to(slope, position_weight, command_weight):
    """A push that is constant within samples is one of the allowed: its sum over the powers must be no larger."""
    problem, _ = problem_of(weights=Weights(position_weight, 1.0, command_weight))
    gain = feedback(problem, -slope)
    each, A_K = extents(-slope, T, gain)
    pushed, power, total = held(-slope, T)[1], np.eye(2), np.zeros(3)
    for _ in range(5000):
        total += np.abs(np.vstack([np.eye(2), gain]) @ power @ pushed)
        power = A_K @ power
    assert (total <= each * (1 + 1e-12)).all()
    # And no smaller than what white noise leaves: twice its standard deviation bounds nothing that is possible.
    spread = np.sqrt(np.diag(solve_discrete_lyapunov(A_K, np.outer(pushed, pushed)))).max()
    assert spread <= each.max()


def test_an_unstable_feedback_has_no_tube():
    problem, ahead = problem_of()
    around = tube(problem, ahead, W, gain=np.array([-1.0, 0.5]))
    assert not around.holds
    assert around.position_m == np.inf
    assert around.report()[0].startswith("FAILS: the feedback is stable")


@pytest.mark.parametrize(("changes", "arguments", "words"), [
    ({"highest_command_mps2": 0.4}, {}, "driving leaves room"),
    ({"lowest_command_mps2": -0.2}, {}, "braking leaves room"),
    ({"power_w_per_kg": 15.0}, {}, "power limit leaves room"),
    ({}, {"band_m": 0.04}, "fits into the band"),
    ({}, {"start": 0.19}, "starts within"),
])
def test_a_premise_that_fails_is_named_with_its_numbers(changes, arguments, words):
    problem, ahead = problem_of(**changes)
    around = tube(problem, ahead, W, **arguments)
    failing = [line for line in around.report() if line.startswith("FAILS")]
    assert any(words in line for line in failing)
    assert not around.holds


def test_the_nominal_run_is_known_before_the_real_one():
    problem, ahead = problem_of()
    mpc = TubeMpc(problem, ahead, tube(problem, ahead, W, start=0.1))
    rows = mpc.nominal_run(ahead[0, :3] + [0.1, 0.0, 0.0], 200)
    assert np.abs(rows[:, 0]).max() <= problem.band_m - mpc.around.position_m
    assert abs(rows[-1, 0]) < 1e-3
    assert (rows[:, 2] <= problem.highest_command_mps2 - mpc.around.command_mps2 + 1e-12).all()


@pytest.mark.parametrize("bound", [0.0, -1.0, float("nan"), float("inf"), 6.0])
def test_a_bound_that_is_none_is_refused(bound):
    with pytest.raises(InputError, match="is not above 0 and up to 5"):
        tube(*problem_of(), bound)


def tube_scenario(base, **changes):
    return base(controllers__mpc__law="mpc.tube", controllers__mpc__parameters={
        "horizon": 25.0, "position_weight": 25.0, "speed_weight": 14.8, "command_weight": 4.34, "change_weight": 0.0,
        "band_price": 1e4, "disturbance_mps2": 0.15}, **changes)


@pytest.mark.parametrize("factors", [Factors(), Factors(mass=1.1, davis_a=1.1), Factors(mass=0.9, line_resistance=1.1)])
def test_on_a_line_whose_forces_are_within_the_bound_the_error_is_within_the_tube(factors):
    run = simulate(tube_scenario(short_scenario), "mpc", factors)
    ours = MpcController(tube_scenario(short_scenario), tube_scenario(short_scenario).controllers["mpc"], "mpc")
    assert ours.explain() == []
    assert run.counters["premises_failed"] == 0
    error = np.abs(run.column("s_m") - run.column("s_desired_m")).max()
    assert error <= ours.tracker.around.position_m + 1e-6


def test_the_premises_hold_for_yang2021s_own_line_and_train():
    scenario = load_scenario(YANG)
    train, curve = scenario.train, scenario.desired_curve()
    problem, _ = problem_of(davis=(train.davis_a_mps2, train.davis_b_per_s, train.davis_c_per_m))
    ahead = preview(problem, curve, curve.trip_time_s)
    around = tube(problem, ahead, W, scenario.simulation.position_band_m)
    assert around.holds, around.report()
    # A push that stays at its bound is met by K_p e: no tube of this feedback is thinner.
    assert W / around.gain[0] * 0.99 < around.position_m < 0.2


def test_the_start_of_the_run_is_a_premise():
    """The nominal run starts where the train does; from beyond what the tube leaves of the band nothing is promised."""
    near, far = (tube_scenario(short_scenario, simulation__initial_position_m=start) for start in (-0.05, -0.19))
    made = [MpcController(scenario, scenario.controllers["mpc"], "mpc") for scenario in (near, far)]
    assert made[0].counters["premises_failed"] == 0
    assert made[1].counters["premises_failed"] > 0
    assert any("the run starts within" in line for line in made[1].explain())


def test_a_push_beyond_the_stated_bound_is_counted_and_explained():
    weak = tube_scenario(short_scenario, disturbance__amplitude_mps2=0.3, disturbance__period_s=10.0)
    run, quiet = simulate(weak, "mpc"), simulate(tube_scenario(short_scenario), "mpc")
    assert quiet.counters["beyond_bound"] == 0
    assert 0.2 < run.counters["beyond_bound"] / run.counters["qp"] < 0.9
    ours = MpcController(weak, weak.controllers["mpc"], "mpc")
    ours.command(0.0, 0.0, 0.0)
    expected = ours._observer._expected_speed
    ours.command(T, 0.0, expected + 0.149 * T)
    assert ours.counters["beyond_bound"] == 0
    ours.command(2 * T, 0.0, ours._observer._expected_speed - 0.2 * T)
    assert ours.counters["beyond_bound"] == 1
    assert "beyond_bound: 1" in ours.explain()[0]
    assert "0.2 m/s^2" in ours.explain()[0]


def test_where_premises_fail_the_nominal_run_still_follows_the_curve():
    """A bound that no limit leaves room for is counted; tightened all the same, the train would not even start."""
    weak = tube_scenario(short_scenario, train__max_traction_n=160e3)
    weak.controllers["mpc"].parameters["disturbance_mps2"] = 0.9
    run = simulate(weak, "mpc")
    assert run.counters["premises_failed"] > 0
    assert np.abs(run.column("s_m") - run.column("s_desired_m")).max() < 0.2
