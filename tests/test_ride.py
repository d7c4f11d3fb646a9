"""How a run feels, added up at every plant step: against runs whose answer is known, a full log, and the standard."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from scenarios import short_scenario
from scipy import signal

from workbench.model.law import ControlLaw, LawState, time
from workbench.simulate.closed_loop import run_law, setting_of, simulate
from workbench.simulate.metrics import measure, measure_run
from workbench.simulate.ride import SUMS, SpeedLimits, ride, weighting
from workbench.trains.actuator import Actuator
from workbench.trains.track import ResistanceTable, over_length

AMPLITUDE, MIDDLE = 0.3, 0.5
up = sp.Symbol("up", real=True)
# Commands 0.8 and 0.2 m/s^2, another one at every sample.
alternating = ControlLaw("test.alternating", "alternates every sample", "a test", "nothing", MIDDLE + AMPLITUDE * up,
                         states=(LawState(up, update=-up),))


def setting(**changes):
    """The short scenario without resistance, so that the acceleration is the command."""
    scenario = short_scenario()
    bare = replace(setting_of(scenario), davis_n=(0.0, 0.0, 0.0), terms=np.zeros((0, 7)), end_s=4.0,
                   limits=(1e9, 1e9, np.inf), plant_step_s=0.005, log_every_s=0.1)
    level = replace(bare.line, specific_force=0.0 * bare.line.specific_force)
    return replace(bare, **{"line": level} | changes)


def driven(law=alternating, period_s=0.005, start=(1.0,), **changes):
    of = setting(**changes)
    return run_law(law, (np.zeros(0), np.array(start), np.zeros((0, 0)), np.zeros((0, 0))), of, period_s)


def test_a_law_that_alternates_at_every_sample_is_not_taken_for_a_smooth_one():
    run = driven()
    found = measure_run(run, 0.0)
    jerk = 2 * AMPLITUDE / 0.005
    assert found.jerk_rms == pytest.approx(jerk, rel=1e-6)
    assert found.jerk_max == pytest.approx(jerk, rel=1e-6)
    assert jerk * 0.999 <= found.jerk_p95 <= jerk * 1.016
    assert found.command_variation == pytest.approx(2 * AMPLITUDE / 0.005, rel=2e-3)
    # Rows of the log are 20 steps apart: an even number of them, so that the log sees nothing.
    assert found.logged_jerk_rms < 1e-6 * jerk


def test_a_train_that_is_pushed_evenly_has_no_jerk():
    found = measure_run(driven(replace(alternating, command=sp.Rational(1, 2) + 0 * up)), 0.0)
    assert found.jerk_max < 1e-6 and found.jerk_p95 <= found.jerk_max
    assert found.comfort_rms < 0.5


def test_a_constant_jerk_is_that_in_every_one_of_its_metrics():
    found = measure_run(driven(replace(alternating, command=sp.Rational(1, 5) * time + 0 * up)), 0.0)
    assert (found.jerk_rms, found.jerk_max) == pytest.approx((0.2, 0.2), rel=1e-6)
    assert 0.2 <= found.jerk_p95 * (1 + 1e-9) <= 0.2 * 1.017
    assert found.command_variation == pytest.approx(0.2, rel=2e-3)


def test_a_late_and_lagging_command_is_felt_as_the_force_it_makes():
    """A step of a, late by d, behind a lag tau: jerk a/tau exp(-(t - d)/tau), of which the squares' sum is known."""
    a, lag, late, end_s = 0.5, 0.3, 0.1, 6.0
    steady = replace(alternating, command=sp.Float(a) + 0 * up)
    run = driven(steady, end_s=end_s, log_every_s=0.005, actuator=Actuator(lag_s=lag, delay_s=late))
    found = measure_run(run, 0.0)
    assert found.jerk_rms == pytest.approx(a / np.sqrt(2 * lag * end_s), rel=0.02)
    assert found.jerk_max == pytest.approx(a / lag, rel=0.02)
    assert found.command_variation == 0.0 and found.switchings == 0.0
    assert np.all(run.column("v_mps")[: round(late / 0.005) + 1] == 0.0) and run.column("v_mps")[-1] > 0


def test_a_train_with_a_length_feels_an_edge_of_the_line_as_evenly_as_it_comes():
    """Jerk is the edge's resistance a metre of train times the speed, and nothing of how the line is kept."""
    edge, length, start = 0.2, 100.0, 2.0
    steady = replace(alternating, command=sp.Float(MIDDLE) + 0 * up)
    run = driven(steady, end_s=40.0, log_every_s=0.005,
                 line=over_length(ResistanceTable(np.array([0.0, start]), np.array([0.0, edge])), length))
    under = run.column("s_m") < start + length
    speed, found = run.column("v_mps")[under], measure_run(run, 0.0)
    assert found.jerk_max == pytest.approx(edge / length * speed[-1], rel=2e-3)
    square = np.sum((edge / length * speed[run.column("s_m")[under] > start]) ** 2)
    assert found.jerk_rms == pytest.approx(np.sqrt(square / run.totals["jerk_steps"]), rel=2e-3)


@pytest.mark.parametrize(("frequency", "printed"), [(0.5, 853), (1.0, 1011), (4.0, 512)])
def test_a_shaking_train_is_weighted_as_the_standard_prints(frequency, printed):
    """A whole run, shaken at one frequency: W_d of ISO 2631-1:1997, table 3, in thousandths."""
    shaken = replace(alternating, command=sp.Float(AMPLITUDE) * sp.sin(2 * sp.pi * sp.Float(frequency) * time) + 0 * up)
    found = measure_run(driven(shaken, end_s=60.0), 0.0)
    assert found.comfort_rms == pytest.approx(AMPLITUDE / np.sqrt(2) * printed / 1000, rel=0.02)


def test_changes_between_traction_and_braking_are_counted_where_they_happen():
    swinging = replace(alternating, command=AMPLITUDE * up)
    found = measure_run(driven(swinging), 0.0)
    assert found.switchings == pytest.approx(1 / 0.005, rel=2e-3)
    assert measure_run(driven(), 0.0).switchings == 0.0


@pytest.mark.parametrize("name", ["pid", "pocrac"])
def test_it_agrees_with_a_run_logged_at_every_step(name):
    scenario = short_scenario(simulation__log_every_s=short_scenario().simulation.plant_step_s)
    run, step = simulate(scenario, name), scenario.simulation.plant_step_s
    found = measure(run, scenario)
    speed = np.append(run.column("v_mps"), np.nan)[:-1]
    jerk = np.abs(np.diff(speed, 2)) / step**2
    # The log has no row after the last step.
    assert len(jerk) == run.totals["jerk_steps"] - 1
    assert found.jerk_rms == pytest.approx(float(np.sqrt(np.mean(jerk**2))), rel=2e-3)
    assert found.jerk_max == pytest.approx(float(jerk.max()), rel=1e-6)
    assert found.jerk_p95 == pytest.approx(float(np.percentile(jerk, 95)), rel=0.03)
    assert found.jerk_rms == pytest.approx(found.logged_jerk_rms, rel=2e-3)
    force = np.sign(np.where(np.abs(run.column("u_applied_mps2")) < 1e-3, 0, run.column("u_applied_mps2")))
    changes = np.count_nonzero(np.diff(force[force != 0]))
    assert found.switchings * run.end_s == pytest.approx(changes, abs=0.5)


def test_the_log_s_spacing_changes_nothing_but_what_is_of_the_log():
    rows = [measure(simulate(s, "pid"), s).row() for s in (
        short_scenario(simulation__log_every_s=every) for every in (0.01, 0.5))]
    timed = {"step_us_median", "step_us_p99", "deadline_misses", "logged_jerk_rms"}
    assert {k: v for k, v in rows[0].items() if k not in timed} == {k: v for k, v in rows[1].items() if k not in timed}
    assert rows[0]["logged_jerk_rms"] != rows[1]["logged_jerk_rms"]


def test_speed_limits_are_held_against_every_step():
    # Under 0.5 m/s^2 from rest: 0.25 t^2 m, 0.5 t m/s. Beyond 1 m (2 s, 1 m/s) one may go 0.75 m/s, beyond 2.25 m all.
    limits = SpeedLimits(np.array([0.0, 1.0, 2.25]), np.array([np.inf, 0.75, np.inf]))
    steady = replace(alternating, command=sp.Float(0.5) + 0 * up)
    run = driven(steady, speed_limits=limits)
    assert run.totals["overspeed_max_mps"] == pytest.approx(0.75, abs=0.0051)
    assert run.totals["overspeed_steps"] == pytest.approx(200, abs=2)


# ISO 2631-1:1997, table 3, W_d in thousandths.
TABLE = {0.5: 853, 0.8: 992, 1.0: 1011, 2.0: 890, 4.0: 512, 8.0: 253, 16.0: 125}


@pytest.mark.parametrize("step_s", [0.001, 0.005])
def test_the_weighting_is_the_standard_s(step_s):
    sections = weighting(step_s)
    sos = np.array([[b0, b1, b2, 1.0, a1, a2] for b0, b1, b2, a1, a2, *_ in sections])
    for frequency, printed in TABLE.items():
        _, gain = signal.sosfreqz(sos, [2 * np.pi * frequency * step_s])
        assert abs(gain[0]) == pytest.approx(printed / 1000, rel=0.03), frequency


def test_the_loop_s_filter_is_scipy_s():
    run = driven(end_s=2.0, log_every_s=0.005)
    speed = np.append(run.column("v_mps"), [run.column("v_mps")[-1] + 0.005 * run.column("u_mps2")[-1]])
    sections = weighting(0.005)
    sos = np.array([[b0, b1, b2, 1.0, a1, a2] for b0, b1, b2, a1, a2, *_ in sections])
    filtered = signal.sosfilt(sos, np.diff(speed) / 0.005)
    assert run.totals["weighted_square_sum"] == pytest.approx(float(np.sum(filtered**2)), rel=1e-5)


def test_the_percentile_is_rounded_up_to_its_bin():
    of, rng = ride(0.005, SpeedLimits()), np.random.default_rng(7)
    drawn = np.exp(rng.normal(0.0, 2.0, 5000))
    for value in drawn:
        octave = int(np.floor(np.log2(value)))
        of.values[31 + 64 * (octave + 21) + int(64 * (value / 2.0**octave - 1))] += 1
    of.values[SUMS.index("jerk_max_mps3")] = drawn.max()
    for share in (0.5, 0.95, 0.99):
        exact = float(np.quantile(drawn, share, method="inverted_cdf"))
        assert exact <= of.percentile(share) <= exact * 1.016
    assert of.percentile(1.0) == drawn.max()
    assert ride(0.005, SpeedLimits()).percentile(0.95) == 0.0


