"""The compiled closed loop, against a plain Python loop and against what its own full log says."""

import re
import time

import compiled_apart
import numpy as np
import pytest
import sympy as sp
from plain_loop import plain_run
from scenarios import BENCHMARKS, LAWS, YANG, name_of, short_scenario, values_for, with_law

from workbench.errors import InputError, WorkbenchError
from workbench.model.law import ControlLaw, LawState, desired_position, position, speed
from workbench.model.laws import GENERAL
from workbench.simulate import closed_loop, law_time
from workbench.simulate.closed_loop import Factors, prepared, setting_of, simulate
from workbench.simulate.metrics import measure
from workbench.trains.scenario import load_scenario

EVERY = [(law, estimates) for estimates in ("corrected", "explicit") for law in LAWS]


def run_law(law_id, estimates="corrected", period_s=0.01, **changes):
    scenario = with_law(short_scenario(**changes), LAWS[law_id], period_s, estimates)
    return scenario, simulate(scenario, "only")


def compared_with_plain(law, estimates, steps=600, period_s=0.02):
    """The scenario of a law, and the plain loop's columns."""
    scenario = with_law(short_scenario(), law, period_s, estimates)
    plain = plain_run(scenario, law, values_for(law), estimates, period_s, steps)
    assert np.ptp(plain["u_mps2"]) > 0.1  # the stretch is not a trivial one
    return scenario, plain


@pytest.mark.parametrize(("law", "estimates"), EVERY, ids=str)
def test_every_law_runs_compiled_as_it_does_in_plain_python(law, estimates):
    scenario, plain = compared_with_plain(LAWS[law], estimates)
    run = simulate(scenario, "only")
    applied = np.array(plain.pop("force")) / scenario.train.mass_kg
    steps = len(applied)
    assert run.column("u_applied_mps2")[:steps] == pytest.approx(applied, rel=1e-9, abs=1e-11)
    for name, values in plain.items():
        assert run.column(name)[:steps] == pytest.approx(np.array(values), rel=1e-9, abs=1e-11), name


@pytest.mark.parametrize("law_id", LAWS)
def test_the_same_run_twice_is_the_same_bit_for_bit(law_id):
    first, second = run_law(law_id)[1], run_law(law_id)[1]
    assert first.log.tobytes() == second.log.tobytes()
    assert first.totals == second.totals
    assert first.final_position_m == second.final_position_m


@pytest.mark.parametrize("law_id", LAWS)
def test_totals_are_those_of_the_full_log(law_id):
    scenario, run = run_law(law_id, period_s=0.05)
    assert run.failed is None
    error = run.column("s_m") - run.column("s_desired_m")
    speed_error = run.column("v_mps") - run.column("v_desired_mps")
    command = run.column("u_mps2")
    total = run.totals
    assert len(error) == total["samples"] == round(run.end_s / 0.01)
    assert (total["position_error_min"], total["position_error_max"]) == (error.min(), error.max())
    assert (total["speed_error_min"], total["speed_error_max"]) == (speed_error.min(), speed_error.max())
    assert (total["command_min_mps2"], total["command_max_mps2"]) == (command.min(), command.max())
    assert total["speed_min_mps"] == run.column("v_mps").min()
    assert total["time_of_max_position_error_s"] == run.column("t_s")[np.abs(error).argmax()]
    assert total["position_error_square_sum"] == pytest.approx(np.sum(error**2), rel=1e-12)
    assert total["speed_error_square_sum"] == pytest.approx(np.sum(speed_error**2), rel=1e-12)
    assert total["band_violations"] == np.sum(np.abs(error) > scenario.simulation.position_band_m)
    assert total["commands"] == np.ceil(len(error) / 5)


def test_a_sparser_log_is_every_so_manyth_row_of_the_full_one():
    full = run_law("pid")[1]
    sparse = run_law("pid", simulation__log_every_s=0.07)[1]
    assert np.array_equal(sparse.log, full.log[::7])
    assert sparse.column("t_s") == pytest.approx(0.07 * np.arange(len(sparse.log)), abs=1e-12)
    assert sparse.totals == full.totals


def test_a_row_holds_the_desired_values_of_its_time_and_the_command_of_its_step():
    scenario, run = run_law("pid", period_s=0.1)
    desired = scenario.desired_curve().at(run.column("t_s"))
    for name, values in zip(("s_desired_m", "v_desired_mps", "a_desired_mps2"), desired, strict=True):
        assert run.column(name) == pytest.approx(values, rel=1e-12, abs=1e-12)
    commands = run.column("u_mps2")[: len(run.log) // 10 * 10].reshape(-1, 10)
    assert np.all(commands == commands[:, :1])  # held for the ten steps of a sample
    sampled = run.log[::10]
    at = {name: sampled[:, run.columns.index(name)] for name in run.columns}
    gains = values_for(LAWS["pid"])["parameters"]
    by_hand = (gains["K_p"] * (at["s_desired_m"] - at["s_m"]) + gains["K_i"] * at["eta_e"]
               + gains["K_d"] * (at["v_desired_mps"] - at["v_mps"]))
    assert at["u_mps2"] == pytest.approx(by_hand, abs=1e-12)


def test_a_column_that_is_not_logged_is_named_with_the_ones_that_are():
    with pytest.raises(KeyError, match="choose one of t_s"):
        run_law("pid")[1].column("speed")


@pytest.mark.parametrize(("traction", "braking"), [(110e3, 240e3), (200e3, 10e3)])
def test_saturation_is_applied_and_counted(traction, braking):
    limits = {"train__max_traction_n": traction, "train__max_braking_n": braking}
    scenario, run = run_law("pid", period_s=0.05, **limits)
    mass = scenario.train.mass_kg
    wanted, applied = run.column("u_mps2") * mass, run.column("u_applied_mps2") * mass
    limited = np.clip(wanted, -braking, traction)
    assert applied == pytest.approx(limited, rel=1e-15)
    reached = applied.max() / traction if traction < 200e3 else applied.min() / -braking
    assert reached == pytest.approx(1.0, rel=1e-15)
    counted = np.sum((limited != wanted)[::5])
    assert run.totals["saturated_samples"] == counted > 0
    fraction = measure(run, scenario).saturated_fraction
    assert fraction == pytest.approx(counted / np.ceil(len(wanted) / 5))


def test_the_power_limit_bounds_force_times_speed_at_every_sample():
    scenario, run = run_law("pid", train__max_power_w=800e3)
    power = run.column("u_applied_mps2") * scenario.train.mass_kg * run.column("v_mps")
    assert power.max() == pytest.approx(800e3, rel=1e-12)
    unlimited = run_law("pid")[1]
    assert (unlimited.column("u_applied_mps2") * unlimited.column("v_mps")).max() * 200e3 > 800e3 * 1.1


def test_a_run_within_its_limits_saturates_nowhere():
    _, run = run_law("pid")
    assert run.totals["saturated_samples"] == 0
    assert run.column("u_applied_mps2") == pytest.approx(run.column("u_mps2"), rel=1e-15)


def test_the_true_train_may_differ_from_the_nominal_one_that_scales_the_command():
    scenario = with_law(short_scenario(), LAWS["pid"], 0.01)
    factors = Factors(mass=1.1, davis_a=0.9, davis_b=1.2, davis_c=0.8, line_resistance=1.5)
    run = simulate(scenario, "only", factors)
    t, p, v, u = (run.column(name) for name in ("t_s", "s_m", "v_mps", "u_mps2"))
    train, true_mass = scenario.train, 1.1 * 200e3
    a, b, c = 0.9 * train.davis_a_mps2, 1.2 * train.davis_b_per_s, 0.8 * train.davis_c_per_m
    per_mille = np.where(p < 1, 2.0, -3.0)
    resisted = 200e3 * (a + b * v + c * v**2) + true_mass * 1.5 * 9.80665e-3 * per_mille
    expected = (200e3 * u - resisted) / true_mass
    smooth = (t > 0.5) & (p < 290) & (np.abs(p - 1) > 0.5)
    found = np.gradient(v, t)
    # The command changes from step to step, so the slope of speed lies half a step beside it.
    assert found[smooth] == pytest.approx(expected[smooth], abs=5e-3)
    assert np.abs(np.mean(found[smooth] - expected[smooth])) < 2e-4


def test_leaving_the_barrier_is_reported_with_time_state_and_law_and_not_clipped():
    scenario = load_scenario(YANG)
    spec = scenario.controllers["pocrac"].model_copy(update={"estimates": "explicit"})
    scenario = scenario.model_copy(update={"controllers": {"pocrac": spec}, "printed_table": None})
    run = simulate(scenario, "pocrac")
    stated = re.fullmatch(r"yang2021\.pocrac left its domain \(k\^2 - \(x_1 - x_d\)\^2 > 0\) "
                          r"at t = ([\d.]+) s, s = ([\d.]+) m, v = ([\d.]+) m/s", run.failed)
    assert stated
    t, p, _ = map(float, stated.groups())
    assert t == pytest.approx(run.end_s, abs=1e-9)
    assert p == pytest.approx(run.final_position_m, abs=1e-3)
    error = run.final_position_m - scenario.desired_curve().at(np.array([run.end_s]))[0][0]
    assert abs(error) >= spec.parameters["k"]
    # The error with which it left is the extreme one, and it is counted, however far the log reaches.
    extremes = (run.totals["position_error_min"], run.totals["position_error_max"])
    assert error == pytest.approx(max(extremes, key=abs), rel=1e-9)
    assert run.column("t_s")[-1] < run.end_s
    assert measure(run, scenario).failed == run.failed
    assert simulate(load_scenario(YANG), "pocrac").failed is None


x_state = sp.Symbol("z", real=True)
BAD_LAWS = {
    "a state that escapes in finite time": ControlLaw(
        "test.escape", "escape", "a test", "full state, model unknown", x_state,
        states=(LawState(x_state, rate=1 + x_state**2),)),
    "a division by zero at standstill": ControlLaw(
        "test.division", "division", "a test", "full state, model unknown", 1 / speed),
    "a root of a negative number": ControlLaw(
        "test.root", "root", "a test", "full state, model unknown", sp.sqrt(-1 - position**2)),
    "a logarithm of zero": ControlLaw(
        "test.log", "logarithm", "a test", "full state, model unknown", sp.log(speed)),
}


@pytest.mark.parametrize("law", BAD_LAWS.values(), ids=BAD_LAWS.keys())
def test_a_law_that_diverges_stops_its_run_and_is_reported(law, monkeypatch):
    monkeypatch.setitem(GENERAL, law.id, lambda: law)
    scenario = with_law(short_scenario(), law, 0.01)
    run = simulate(scenario, "only")
    assert re.match(rf"{re.escape(law.id)} diverged at t = \d", run.failed)
    assert run.end_s < 10.0
    numbers = measure(run, scenario)
    assert numbers.failed == run.failed
    assert all(value is None or np.isfinite(value) for value in numbers.row().values()
               if isinstance(value, float))


def test_a_controller_that_is_not_there_is_named_with_those_that_are():
    with pytest.raises(InputError, match="there is no 'lqr': choose one of rbfnn_pocrac, pocrac"):
        simulate(short_scenario(), "lqr")


def test_timing_counts_steps_and_not_the_compiler(monkeypatch, tmp_path):
    law = ControlLaw("test.fresh", "fresh", "a test", "full state, model unknown",
                     (desired_position - position) / 8)
    monkeypatch.setitem(GENERAL, law.id, lambda: law)
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))  # so that this kernel must be compiled here and now
    monkeypatch.setattr(time, "perf_counter", time.process_time)  # what else the machine does is no matter
    monkeypatch.setattr(compiled_apart, "kept", lambda *_: True)  # and in this process
    run = simulate(with_law(short_scenario(), law, 0.01), "only")
    assert run.failed is None
    # Compiling a kernel takes some tenths of a second; some hundred steps of it take less than a millisecond.
    assert 0.0 <= run.step_us.max() < 100.0 and len(run.step_us) == law_time.BLOCKS


def test_a_step_is_timed_without_the_plant_and_leaves_what_the_run_gave(monkeypatch):
    """The same law under a plant of ten times as many steps a sample: the loop takes longer, a step of the law not."""
    monkeypatch.setattr(time, "perf_counter", time.process_time)
    scenario = short_scenario()
    slow = scenario.model_copy(update={"simulation": scenario.simulation.model_copy(
        update={"plant_step_s": scenario.simulation.plant_step_s / 10})})
    for name in ("rbfnn_pocrac", "pocrac"):
        run, fine = simulate(scenario, name), simulate(slow, name)
        assert len(run.step_us) == len(fine.step_us) == law_time.BLOCKS
        assert 0.0 <= np.median(fine.step_us) < 3 * np.median(run.step_us) + 1.0
        setting = setting_of(scenario)
        untimed = prepared(scenario, name)(setting)
        assert len(untimed.step_us) == 0 and np.array_equal(untimed.log, run.log) and untimed.totals == run.totals


@pytest.mark.parametrize(("path", "name"), [
    pytest.param(path, name, id=f"{name_of(path)}-{name}")
    for path in BENCHMARKS for name in load_scenario(path).controllers
])
def test_every_shipped_controller_obeys_the_laws_of_the_loop(path, name):
    scenario = load_scenario(path)
    run = simulate(scenario, name)
    train, mass = scenario.train, scenario.train.mass_kg
    force = run.column("u_applied_mps2") * mass
    assert force.max() <= train.max_traction_n * (1 + 1e-12)
    assert force.min() >= -train.max_braking_n * (1 + 1e-12)
    error = run.column("s_m") - run.column("s_desired_m")
    assert run.totals["position_error_min"] <= error.min()
    assert run.totals["position_error_max"] >= error.max()
    assert np.all(np.isfinite(run.log))
    if run.failed is None:
        planned = scenario.desired_curve().trip_time_s + scenario.simulation.dwell_s
        assert run.end_s == pytest.approx(planned, abs=scenario.simulation.plant_step_s)
    else:
        assert f"t = {run.end_s:.3f} s" in run.failed


def test_a_controller_that_stops_at_the_limit_itself_is_counted_like_the_others():
    """MPC never commands beyond the limit it knows; at the limit it is as saturated as a law that is cut there."""
    scenario = short_scenario(train__max_traction_n=110e3)
    run = simulate(scenario, "mpc")
    per_sample = round(scenario.controllers["mpc"].period_s / scenario.simulation.plant_step_s)
    applied = run.column("u_applied_mps2")[::per_sample] * scenario.train.mass_kg
    at_limit = (applied >= 110e3 * (1 - 1e-9)) | (applied <= -scenario.train.max_braking_n * (1 - 1e-9))
    assert run.totals["saturated_samples"] == np.sum(at_limit) > 0
    assert run.column("u_mps2").max() <= 110e3 / scenario.train.mass_kg


def test_values_that_are_not_those_of_the_laws_states_are_refused():
    """A kernel writes every state into the log, whose rows are as wide as the law says."""
    law, empty = LAWS["pid"], np.zeros((0, 0))
    with pytest.raises(WorkbenchError, match=r"pid: 2 initial values for 1 states of one number each: give one"):
        closed_loop.run_law(law, (np.zeros(3), np.zeros(2), empty, empty), setting_of(short_scenario()), 0.05)
