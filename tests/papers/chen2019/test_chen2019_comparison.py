"""chen2019's train under MPC: the same cars as under the law, within their limits; law and MPC stated and tuned."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from proofs.chen2019 import laws as law
from proofs.chen2019.simulation.held_cars_loop import HELD_COLUMNS
from proofs.chen2019.simulation.mpc_trip import held_arguments, held_kernel, run_mpc
from proofs.chen2019.simulation.plans import car_data, plan
from proofs.chen2019.study.comparison import COMPARISON, DRIVERS, stated_tasks
from workbench.paper.cells import Phrase
from workbench.paper.stages import run_stages
from workbench.paper.study import varied
from workbench.simulate.closed_loop import NOMINAL, Factors

# Two cars over a short trip.
SHORT = {"train.cars": 2, "reference.cruise_mps": 5.0, "reference.acceleration_mps2": 0.15,
         "reference.trip_time_s": 60.0, "trials.count": 3, "trials.shown": [3]}


@pytest.fixture(scope="module")
def short(study):
    return varied(study, SHORT, "test")


def test_held_cars_are_chen2019s_equations(study):
    """Against the train typed again as matrices, integrated by scipy."""
    n, train = study.train.cars, study.train
    of = plan(study)
    state = np.zeros((4, n))
    draw = np.random.default_rng(5)
    state[0], state[1] = draw.normal(0, 0.01, n), 20 + draw.normal(0, 0.05, n)
    u = draw.uniform(-4e4, 4e4, n)
    start, steps = state[:2].ravel().copy(), 3000
    log = np.zeros((steps, n))
    held_kernel().held_forces(
        0, steps, of.period_s, np.zeros((steps, 3)), *held_arguments(of), state, np.zeros((1, n)),
        np.array([u, 0 * u]), np.zeros(len(HELD_COLUMNS)), log, 1)
    m = train.car_mass_kg
    A = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    A[0, 0] = A[-1, -1] = 1

    def rates(_, x):
        s, v = x[:n], x[n:]
        air = np.zeros(n)
        air[0] = train.c_a_n_s2_per_m2_kg * n * m * v[0] ** 2
        force = u - m * (train.c_0_n_per_kg + train.c_v_n_s_per_m_kg * v) - air
        return np.concatenate([v, (force - train.coupler_n_per_m * A @ s - train.coupler_n_s_per_m * A @ v) / m])

    wanted = solve_ivp(rates, (0, steps * of.period_s), start, rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]
    assert state[:2].ravel() == pytest.approx(wanted, rel=1e-7, abs=1e-7)
    assert not state[2:].any()


def test_mpc_of_the_cars_keeps_their_limits_and_stays_on_the_curve(study):
    trip = run_mpc(study, 60.0)
    assert trip.counters["qp_failed"] == 0 and trip.counters["qp"] == 600
    assert trip.totals["largest_position_error_m"] < 0.1
    weak = study.model_copy(update={"train": study.train.model_copy(update={"traction_n": 1.5e4})})
    late = run_mpc(weak, 60.0)  # cannot follow: 45 kN for 300 t, where 60 kN are needed
    assert late.totals["car_steps_at_limit"] > 0 and late.counters["qp_failed"] == 0
    assert late.totals["stopping_error_m"] < -1.0
    assert car_data(weak)[law.CAR_DATA.index(law.u_high)].max() == 1.5e4


def test_a_heavier_train_is_the_file_with_another_mass(short):
    """The law is told no mass, so a factor must do what the file's own value does."""
    heavy = short.model_copy(update={"train": short.train.model_copy(
        update={"car_mass_kg": 1.06 * short.train.car_mass_kg})})
    drawn = DRIVERS.drive(short, "law", "trip", Factors(mass=1.06))
    assert drawn["speed_rms"] == DRIVERS.drive(heavy, "law", "trip", NOMINAL)["speed_rms"]


def test_stated_and_tuned_stand_side_by_side(short):
    everything = replace(COMPARISON, own_tasks=lambda study: ())
    (rows,) = run_stages([everything.stage(short)], 1, lambda *_: None)
    table = next(COMPARISON.tables(short, rows))
    assert [row[0] for row in table.rows] == [
        "the law, trial 1", "the law", "the law, tuned, trial 1", "the law, tuned", "multi-car MPC",
        "multi-car MPC, tuned"]
    energy = next(i for i, column in enumerate(table.columns) if column.title == "energy")
    assert table.rows[1][energy] == rows["trip", "law", False]["energy_J"] == pytest.approx(
        3.6e6 * table.values[1][energy])
    assert all(cell == "no trial" or isinstance(cell, Phrase) for row in table.rows[1:4:2] for cell in row[-2:])
    errors = rows["trip", "law", False]["trials"]
    assert table.rows[0][1:3] == pytest.approx((errors["position_rms"][0], errors["speed_rms"][0]))
    assert "MPC counted" in table.note and "model unknown" in table.note
    assert len(list(COMPARISON.plots(short, rows))) == 2
    assert len(list(COMPARISON.findings(short, rows))) == 2
    own = stated_tasks(short)
    assert own and list(COMPARISON.stage(short).tasks) == [task for task in rows if task not in own]
