"""MPC in the papers' own scenarios: the same plants as the papers' laws, and honest counts of who is ahead when."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import YANG
from scipy.integrate import solve_ivp
from workbench.paper.registry import load_study

from proofs.chen2019 import laws as chen_law
from proofs.chen2019.study import mpc_comparison as chen2019_beside
from proofs.chen2019.study.held_cars_loop import HELD_COLUMNS
from proofs.chen2019.study.runs import plan as chen_plan
from proofs.jiao2025.study import mpc_comparison as jiao2025_beside
from proofs.jiao2025.study.cases import plan as jiao_plan
from proofs.liu2020.study import mpc_comparison as liu2020_beside
from proofs.liu2020.study import runs as liu2020_runs
from proofs.mao2018 import laws as mao_laws
from proofs.mao2018.study import mpc_comparison as mao2018_beside
from proofs.mao2018.study import numbers as mao2018_numbers
from workbench.paper.mpc_comparison import KINDS_BESIDE, known, run_beside
from workbench.trains.track import ResistanceTable


def study(name: str):
    return load_study(Path(YANG).parent / f"{name}.toml")


def test_offset_free_mpc_forgets_a_failed_motor_and_linear_mpc_does_not() -> None:
    mao = study("mao2018")
    tuning = next(iter(mao.tunings.values()))
    setting = replace(mao2018_numbers.setting_of(mao, mao.cases[1], tuning, 900.0), log_every_s=1.0)
    a, b, c = setting.changes[0, 1:4]
    of = known(mao.mpc, setting.curve, setting.mass_kg, (a, b, c), setting.end_s)
    offset = {}
    for kind in KINDS_BESIDE:
        run = run_beside(of, kind, setting, mao_laws.train)
        time, error = run.column("t_s"), run.column("s_m") - run.column("s_desired_m")
        offset[kind] = np.abs(error[(time > 700) & (time < 790)]).max()
    # 200 kN of one motor, less its share of what the others give: 0.5 m/s^2 that the linear one must lean against.
    assert offset["mpc.offset_free"] < 0.01 * offset["mpc.linear"]


def test_liu2020s_plant_is_a_single_particle_of_the_mass_that_mpc_knows() -> None:
    liu = study("liu2020")
    setting = replace(liu2020_runs.setting_of(liu, "fast"), end_s=200.0)
    chi, mass = liu.train.chi, liu.train.mass_kg / liu.train.chi
    of = known(liu.mpc, setting.curve, mass, liu2020_runs.davis_newton(liu.train), setting.end_s)
    terms = setting.terms.copy()
    terms[:, 2:4] *= chi  # N per kg of M become N per kg of M/chi
    line = ResistanceTable(setting.line.position_m, setting.line.specific_force * chi)
    plain = replace(setting, mass_kg=mass, line=line, terms=terms, plant_values=())
    one = run_beside(of, "mpc.offset_free", setting, liu2020_runs.of_train.model())
    other = run_beside(of, "mpc.offset_free", plain)
    assert one.log[:, 1:3] == pytest.approx(other.log[:, 1:3], rel=1e-9, abs=1e-9)


def test_every_trip_of_jiao2025_that_differs_is_driven_once() -> None:
    jiao = study("jiao2025")
    tasks = jiao2025_beside.beside_tasks(jiao)
    trips = {(r.step_s, r.k_per_sample) for r in jiao.readings.values()}
    assert len(tasks) == len(set(tasks)) == len(trips) * len(KINDS_BESIDE)
    assert {(jiao.readings[name].step_s, jiao.readings[name].k_per_sample) for name, _ in tasks} == trips
    found = jiao2025_beside.run_one(jiao, tasks[0])
    desired = jiao_plan(jiao, jiao2025_beside.Case(tasks[0][0], "jiao2025.icfdl", 0)).desired
    assert 0 < found.mse < 1e-4 * np.mean(desired**2)
    assert found.counters["qp"] == len(desired) - 1 and found.counters["qp_failed"] == 0


@settings(max_examples=80, deadline=None)
@given(st.lists(st.floats(0.0, 10.0), min_size=1, max_size=30), st.floats(0.1, 10.0))
def test_overtaken_is_the_first_trial_after_which_all_are_below(errors: list[float], rival: float) -> None:
    found = chen2019_beside.overtaken(np.array(errors), rival)
    plain = next((i + 1 for i in range(len(errors)) if all(e < rival for e in errors[i:])), None)
    assert found == plain


def test_held_cars_are_chen2019s_equations() -> None:
    """Against the train typed again as matrices, integrated by scipy."""
    chen = study("chen2019")
    n, train = chen.train.cars, chen.train
    of = chen_plan(chen)
    state = np.zeros((4, n))
    draw = np.random.default_rng(5)
    state[0], state[1] = draw.normal(0, 0.01, n), 20 + draw.normal(0, 0.05, n)
    u = draw.uniform(-4e4, 4e4, n)
    start, steps = state[:2].ravel().copy(), 3000
    log = np.zeros((steps, n))
    chen2019_beside._kernel().held_forces(
        0, steps, of.period_s, np.zeros((steps, 3)), *chen2019_beside._fixed(of), state, np.zeros((1, n)),
        np.array([u, 0 * u]), np.zeros(len(HELD_COLUMNS)), log, 1)
    m = train.car_mass_kg
    A = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    A[0, 0] = A[-1, -1] = 1

    def rates(_: float, x: np.ndarray) -> np.ndarray:
        s, v = x[:n], x[n:]
        air = np.zeros(n)
        air[0] = train.c_a_n_s2_per_m2_kg * n * m * v[0] ** 2
        force = u - m * (train.c_0_n_per_kg + train.c_v_n_s_per_m_kg * v) - air
        return np.concatenate([v, (force - train.coupler_n_per_m * A @ s - train.coupler_n_s_per_m * A @ v) / m])

    wanted = solve_ivp(rates, (0, steps * of.period_s), start, rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]
    assert state[:2].ravel() == pytest.approx(wanted, rel=1e-7, abs=1e-7)
    assert not state[2:].any()


def test_mpc_of_the_cars_keeps_their_limits_and_stays_on_the_curve() -> None:
    chen = study("chen2019")
    trip = chen2019_beside.run_beside(chen, 60.0)
    assert trip.counters["qp_failed"] == 0 and trip.counters["qp"] == 600
    assert trip.totals["largest_position_error_m"] < 0.1
    weak = chen.model_copy(update={"train": chen.train.model_copy(update={"traction_n": 1.5e4})})
    late = chen2019_beside.run_beside(weak, 60.0)  # cannot follow: 45 kN for 300 t, where 60 kN are needed
    assert late.totals["car_steps_at_limit"] > 0 and late.counters["qp_failed"] == 0
    assert late.totals["stopping_error_m"] < -1.0
    rows = chen2019_beside.car_data(weak)
    assert rows[chen_law.CAR_DATA.index(chen_law.u_high)].max() == 1.5e4


def test_studies_without_mpc_run_none() -> None:
    for name, module in (("mao2018", mao2018_beside), ("liu2020", liu2020_beside), ("jiao2025", jiao2025_beside)):
        assert module.beside_tasks(study(name).model_copy(update={"mpc": None})) == []
        assert module.beside_tasks(study(name))
