"""What lies between a command and the force at the rail: against closed forms, scipy's integrator, and energy."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scenarios import YANG, short_scenario
from scipy.integrate import quad, solve_ivp

from workbench.errors import InputError
from workbench.files.toml import read_toml
from workbench.model import law as of
from workbench.model.law import ControlLaw, LawState
from workbench.simulate.actuator_loop import force_after_lag
from workbench.simulate.closed_loop import run_law, setting_of, simulate
from workbench.simulate.metrics import measure_run
from workbench.trains.actuator import Actuator, Adhesion
from workbench.trains.scenario import build_scenario

STEP_S, WANTED = 0.01, 0.5
# One law for all, so that one is compiled: a command with a jump, a spring and a damper; it keeps what it is told in
# states, which the log has.
told_s, told_v = sp.symbols("told_s told_v", real=True)
first, jump, jump_s, k_1, k_2, k_a = sp.symbols("first jump jump_s k_1 k_2 k_a", real=True)
law = ControlLaw(
    "test.noting", "what each test asks for", "a test", "nothing",
    first + jump * sp.Heaviside(of.time - jump_s, 1) + k_a * of.desired_acceleration
    + k_1 * (of.desired_position - of.position) + k_2 * (of.desired_speed - of.speed),
    states=(LawState(told_s, update=of.position), LawState(told_v, update=of.speed)),
    parameters=(first, jump, jump_s, k_1, k_2, k_a))
steady, spring = (WANTED, 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.6, 1.4, 0.0)


def setting(actuator=None, resisting=False, **changes):
    """The short scenario; without resistance and limits unless `resisting`."""
    found = replace(setting_of(short_scenario()), end_s=6.0, plant_step_s=STEP_S, log_every_s=STEP_S,
                    terms=np.zeros((0, 7)), actuator=actuator)
    if not resisting:
        found = replace(found, davis_n=(0.0, 0.0, 0.0), limits=(1e9, 1e9, np.inf),
                        line=replace(found.line, specific_force=0.0 * found.line.specific_force))
    return replace(found, **changes)


def driven(values, of_setting, period_s=STEP_S, **options):
    return run_law(law, (np.array(values), np.zeros(2), np.zeros((0, 0)), np.zeros((0, 0))), of_setting, period_s,
                   **options)


def applied(actuator, **changes):
    """The mean force of every plant step after a step of the command, m/s^2."""
    return driven(steady, setting(actuator, **changes)).column("u_applied_mps2")


def mean_of(force, count):
    """Means over plant steps of a force as a function of time."""
    return np.array([quad(force, n * STEP_S, (n + 1) * STEP_S, epsabs=1e-13)[0] / STEP_S for n in range(count)])


def test_a_lag_closes_the_gap_exponentially():
    found = applied(Actuator(lag_s=0.4))
    assert found[:300] == pytest.approx(mean_of(lambda t: WANTED * (1 - np.exp(-t / 0.4)), 300), abs=1e-12)


def test_a_delay_is_nothing_and_then_all():
    found = applied(Actuator(delay_s=0.3))
    assert np.all(found[:30] == 0.0) and np.all(found[30:] == WANTED)


def test_a_limited_rate_is_a_ramp():
    mass = setting().nominal_mass_kg
    found = applied(Actuator(rise_n_per_s=0.2 * mass))
    assert found == pytest.approx(np.minimum(0.2 * STEP_S * (np.arange(len(found)) + 0.5), WANTED), abs=1e-12)


def test_a_limited_rate_and_a_lag_are_a_ramp_until_the_lag_is_slower():
    mass, rate, lag = setting().nominal_mass_kg, 0.2, 0.4
    until = WANTED / rate - lag

    def force(t):
        return rate * t if t < until else WANTED - rate * lag * np.exp(-(t - until) / lag)
    found = driven(steady, setting(Actuator(lag_s=lag, rise_n_per_s=rate * mass, fall_n_per_s=mass)))
    assert found.column("u_applied_mps2")[:400] == pytest.approx(mean_of(force, 400), abs=1e-9)
    assert found.totals["rate_limited_steps"] == round(until / STEP_S)
    assert measure_run(found, 0.0).rate_limited_fraction == pytest.approx(until / 6.0, abs=2e-3)


@settings(max_examples=40, deadline=None)
@given(force=st.floats(-1, 1), wanted=st.floats(-1, 1), lag=st.floats(0.01, 2), rise=st.floats(0.1, 5),
       fall=st.floats(0.1, 5), dt=st.floats(0.01, 1))
def test_the_mean_and_the_end_of_a_step_are_those_of_the_equation(force, wanted, lag, rise, fall, dt):
    mean, end, _ = force_after_lag(force, wanted, dt, lag, rise, fall)
    found = solve_ivp(lambda _, y: [np.clip((wanted - y[0]) / lag, -fall, rise), y[0]], (0, dt), [force, 0.0],
                      rtol=1e-9, atol=1e-12, max_step=dt / 50)
    assert end == pytest.approx(found.y[0, -1], abs=1e-6)
    assert mean == pytest.approx(found.y[1, -1] / dt, abs=1e-6)


def test_without_delay_lag_or_limits_it_is_not_there_to_the_last_bit():
    bare, passing = (driven(spring, setting(actuator, resisting=True)) for actuator in (None, Actuator(lag_s=0.0)))
    assert bare.log.tobytes() == passing.log.tobytes()
    assert bare.totals == passing.totals


def piecewise(of_setting, period_s, lag, delay, rate, end_s):
    """Position and speed at the end of the same loop by an adaptive method, from change to change of the command."""
    mass, davis = of_setting.mass_kg, of_setting.davis_n
    line = float(of_setting.line.specific_force[0])
    y, commands = np.zeros(3), {}
    samples = range(round(end_s / period_s))
    marks = sorted({round(k * period_s + d, 9) for k in samples for d in (0.0, delay)} | {end_s})
    curve = of_setting.curve
    for begin, end in pairwise(marks):
        if abs(begin / period_s - round(begin / period_s)) < 1e-6:
            x, v, _ = (float(value) for value in np.ravel(curve.at(np.array([begin]))))
            commands[round(begin / period_s)] = 0.6 * (x - y[0]) + 1.4 * (v - y[1])
        acting = mass * commands.get(int(np.floor((begin - delay) / period_s + 1e-6)), 0.0)

        def rates(_, z, acting=acting):
            _, v, force = z
            resisting = davis[0] + davis[1] * v + davis[2] * v**2 + mass * line
            return [v, (force - resisting) / mass, np.clip((acting - force) / lag, -rate, rate)]
        y = solve_ivp(rates, (begin, end), y, rtol=1e-11, atol=1e-9, max_step=0.01).y[:, -1]
        if end >= end_s:
            break
    return y


def test_the_loop_with_lag_delay_and_rate_comes_to_scipys_with_the_square_of_the_plant_step():
    period, lag, delay, end_s = 0.08, 0.25, 0.12, 4.0
    base = setting(resisting=True, limits=(1e9, 1e9, np.inf), end_s=end_s)
    base = replace(base, line=replace(base.line, specific_force=0.0 * base.line.specific_force + 0.02))
    rate = 0.3 * base.mass_kg
    actuator = Actuator(lag_s=lag, delay_s=delay, rise_n_per_s=rate, fall_n_per_s=rate)
    p, _, _ = piecewise(base, period, lag, delay, rate, end_s)
    errors = []
    for step in (0.04, 0.02, 0.01):
        run = driven(spring, replace(base, actuator=actuator, plant_step_s=step, log_every_s=step), period)
        errors.append(abs(run.final_position_m - p))
    assert errors[2] < 2e-5
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([2.0, 2.0], abs=0.3)


def test_what_the_rail_takes_is_the_adhesion_exactly():
    grip = Adhesion(factor=0.3, adhesive_share=0.5)
    wanting = (2.0, -4.0, 3.0, 0.0, 0.0, 0.0)
    base = setting(Actuator(lag_s=0.2, adhesion=grip), mass_kg=1.2e5)
    run = driven(wanting, base)
    force, speed = run.column("u_applied_mps2") * base.nominal_mass_kg, run.column("v_mps")
    limit = 0.3 * (7.5 / (3.6 * np.abs(speed) + 44) + 0.161) * 0.5 * 9.80665 * 1.2e5
    held = np.abs(force) >= limit * (1 - 1e-9)
    assert np.all(np.abs(force) <= limit * (1 + 1e-12))
    assert held[100:300].all() and held[400:500].all()
    assert run.totals["adhesion_limited_steps"] == held.sum()
    assert measure_run(run, 0.0).adhesion_limited_fraction == pytest.approx(held.mean(), abs=2e-3)


def test_the_adhesion_of_curtius_and_kniffler():
    assert Adhesion().coefficient(0.0) == pytest.approx(7.5 / 44 + 0.161)
    assert Adhesion(factor=0.5).coefficient(100 / 3.6) == pytest.approx(0.5 * (7.5 / 144 + 0.161))


def test_a_drive_gives_no_more_power_than_it_has_whatever_it_lags():
    base = setting(Actuator(lag_s=0.5), limits=(1e9, 1e9, 2e4))
    run = driven(steady, base)
    force, speed = run.column("u_applied_mps2") * base.nominal_mass_kg, run.column("v_mps")
    assert np.all(force * speed <= 2e4 * (1 + 1e-9))
    assert (force * speed)[-50:] == pytest.approx(2e4)


def test_work_at_the_rail_is_kinetic_energy_and_what_resists():
    grip = Adhesion(factor=0.4)
    base = setting(Actuator(lag_s=0.3, delay_s=0.1, rise_n_per_s=1e5, fall_n_per_s=1e5, adhesion=grip), resisting=True)
    base = replace(base, line=replace(base.line, specific_force=0.0 * base.line.specific_force + 0.03),
                   davis_n=(base.davis_n[0], 0.0, 0.0))
    run = driven(spring, base)
    p, v = run.final_position_m, run.column("v_mps")[-1]
    force, a = run.column("u_applied_mps2")[-1] * base.nominal_mass_kg, base.davis_n[0] + 0.03 * base.mass_kg
    last = v + STEP_S * (force - a) / base.mass_kg  # the log's last row is where the last step begins
    kinetic, resisted = 0.5 * base.mass_kg * last**2, a * p
    work = run.totals["traction_work_j"] - run.totals["braking_work_j"]
    assert work == pytest.approx(kinetic + resisted, rel=1e-9)


@pytest.mark.parametrize("lag_s", [0.0, 0.3])
def test_a_predictor_knows_where_the_train_will_be(lag_s):
    actuator = Actuator(lag_s=lag_s, delay_s=0.3, rise_n_per_s=1e5, fall_n_per_s=1e5)
    base = setting(actuator, resisting=True)
    base = replace(base, line=replace(base.line, specific_force=0.0 * base.line.specific_force))
    run = driven(spring, base, 0.02, predictor=True)
    p, v, told = run.column("s_m"), run.column("v_mps"), run.log[:, -2:]
    assert told[:-30:2] == pytest.approx(np.stack((p, v), 1)[30::2], abs=1e-6)
    unaware = driven(spring, base, 0.02)
    assert unaware.log[:, -2:][::2] == pytest.approx(np.stack((unaware.column("s_m"), unaware.column("v_mps")), 1)[::2])


def test_a_predictor_saves_a_stiff_law_from_a_delay():
    stiff = (0.0, 0.0, 0.0, 9.0, 6.0, 1.0)
    base = setting(Actuator(delay_s=0.3), resisting=True, end_s=20.0)
    plain, aware = (measure_run(driven(stiff, base, predictor=on), 0.0) for on in (False, True))
    assert aware.command_variation < 0.1 * plain.command_variation
    assert aware.jerk_p95 < 0.1 * plain.jerk_p95
    assert aware.position_rms < 0.5 * plain.position_rms


@pytest.mark.parametrize(("values", "words"), [
    ({"delay_s": 0.0033}, "actuator.delay_s = 0.0033 is not a whole number of plant steps"),
    ({"delay_s": float("nan")}, "delay_s: nan is not a finite number"),
    ({"lag_s": -0.1}, "actuator.lag_s: input should be greater than or equal to 0"),
    ({"rise_n_per_s": 0.0}, "actuator.rise_n_per_s: input should be greater than 0"),
    ({"lag": 0.1}, "actuator.lag: unknown key"),
    ({"adhesion": {"factor": 1.2}}, "actuator.adhesion.factor: input should be less than or equal to 1"),
    ({"adhesion": {"floor": 0.95}}, "a coefficient of 1.12045 at a standstill is outside 0 to 1"),
])
def test_an_actuator_that_is_none_is_refused_in_a_line(values, words):
    with pytest.raises(InputError) as refused:
        build_scenario(YANG, read_toml(YANG) | {"actuator": values, "reproduction": False})
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_a_scenario_states_its_actuator_and_all_its_controllers_meet_it():
    scenario = short_scenario(reproduction=False, actuator={"lag_s": 0.3, "delay_s": 0.1})
    with pytest.raises(ValidationError):
        scenario.actuator.lag_s = 1.0  # frozen
    for name in ("pid", "mpc"):
        run = simulate(scenario, name)
        asked, got = (np.flatnonzero(run.column(column))[0] for column in ("u_mps2", "u_applied_mps2"))
        assert got == asked + 10
        assert run.failed is None
