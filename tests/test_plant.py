"""The plant between samples: its integrator against an adaptive one, and the energy it spends."""

import numpy as np
import pytest
from scenarios import LAWS, short_scenario, with_law
from scipy.integrate import solve_ivp

from workbench.model.sensing import PERFECT
from workbench.simulate.closed_loop import simulate
from workbench.simulate.controllers import held_command
from workbench.simulate.kernel_loop import ACCUMULATORS, DIVERGED, LOG_COLUMNS
from workbench.simulate.law_loop import law_loop
from workbench.simulate.metrics import measure
from workbench.simulate.ride import SpeedLimits, ride
from workbench.trains.track import resistance_table

MASS, DAVIS, LINE, SINE = 2e5, (6e4, 8e2, 32.0), 0.02, (0.05, 2 * np.pi / 60)


def held(command_mps2, dt, steps, limits=(1e9, 1e9, np.inf)):
    """The compiled plant alone under a held command, on a uniform line: position, speed, totals."""
    kernel, plant = law_loop(held_command).closed_loop, np.array([MASS, *DAVIS])
    state, acc = np.zeros(4), np.zeros(len(ACCUMULATORS))
    standstill = np.zeros((1, 6))
    status, reached = kernel(
        0, steps, 1, dt, state, np.zeros(2, dtype=np.int64), np.array([0.0, 1.0]), standstill, np.zeros(1),
        np.array([[LINE, 0.0]]), np.array([[0.0, np.inf, 0.0, SINE[0], SINE[1], 0.0, 0.0]]),
        np.zeros((0, 7)), np.zeros((0, 5)), plant, plant.copy(), np.array(limits), PERFECT.arrays(steps, dt),
        0.2, MASS, np.array([command_mps2]), np.zeros(0), np.zeros((0, 0)), np.zeros((0, 0)), acc,
        ride(dt, SpeedLimits()).arrays(), np.zeros((1, len(LOG_COLUMNS))), 10**9)
    return state[0], state[1], dict(zip(ACCUMULATORS, acc, strict=True)), status, reached


def adaptive(command_mps2, end_s):
    """The same train by an adaptive method of order 8, with Newton's law typed out; also the work done."""
    def rates(t, y):
        v = y[1]
        resistance = DAVIS[0] + DAVIS[1] * v + DAVIS[2] * v**2
        opposing = MASS * (LINE + SINE[0] * np.sin(SINE[1] * t))
        force = MASS * command_mps2
        return [v, (force - resistance - opposing) / MASS, force * v]

    return solve_ivp(rates, (0, end_s), [0.0, 0.0, 0.0], method="DOP853", rtol=1e-13, atol=1e-10).y[:, -1]


def test_the_fixed_step_integrator_converges_to_the_adaptive_one_with_order_four():
    position, speed, _ = adaptive(0.6, 128.0)
    steps = np.array([8.0, 4.0, 2.0, 1.0])
    runs = [held(0.6, dt, round(128 / dt)) for dt in steps]
    for found, true in ((0, position), (1, speed)):
        errors = np.array([abs(run[found] - true) for run in runs])
        order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
        assert order == pytest.approx(4.0, abs=0.3)
    assert held(0.6, 0.01, 12800)[0] == pytest.approx(position, rel=1e-10)
    assert held(0.6, 0.01, 12800)[1] == pytest.approx(speed, rel=1e-10)


def test_traction_work_is_force_times_distance_and_the_integral_of_power():
    position, _, work = adaptive(0.6, 128.0)
    totals = held(0.6, 0.1, 1280)[2]
    assert totals["traction_work_j"] == pytest.approx(0.6 * MASS * position, rel=1e-9)
    assert totals["traction_work_j"] == pytest.approx(work, rel=1e-9)
    assert totals["braking_work_j"] == 0.0


def test_a_plant_that_runs_away_is_reported_and_stopped():
    *_, status, reached = held(1e5, 0.01, 10_000, limits=(np.inf, np.inf, np.inf))
    assert status == DIVERGED
    assert reached < 10_000


@pytest.mark.parametrize("law_id", LAWS)
def test_work_is_the_gain_of_kinetic_energy_plus_the_work_against_resistance(law_id):
    scenario = with_law(short_scenario(), LAWS[law_id], 0.01)
    run = simulate(scenario, "only")
    assert run.failed is None
    p, v, force = run.column("s_m"), run.column("v_mps"), run.column("u_applied_mps2") * 200e3
    # By rows of the full log: the force of a row acts until the next one.
    work = force[:-1] * np.diff(p)
    totals = run.totals
    last = force[-1] * (run.final_position_m - p[-1])
    traction = np.sum(work[work > 0]) + max(last, 0)
    braking = -np.sum(work[work < 0]) + max(-last, 0)
    assert totals["traction_work_j"] == pytest.approx(traction, rel=1e-10)
    assert totals["braking_work_j"] == pytest.approx(braking, rel=1e-10)
    assert measure(run, scenario).energy_J == totals["traction_work_j"]
    # Resistance by quadrature over distance, on the nodes of the log.
    train = scenario.train
    davis = 200e3 * (train.davis_a_mps2 + train.davis_b_per_s * v + train.davis_c_per_m * v**2)
    line = 200e3 * resistance_table(scenario.track).at((p[1:] + p[:-1]) / 2)
    resisted = np.sum(((davis[1:] + davis[:-1]) / 2 + line) * np.diff(p))
    kinetic = 200e3 / 2 * (v[-1] ** 2 - v[0] ** 2)
    assert np.sum(work) == pytest.approx(kinetic + resisted, rel=1e-5)
