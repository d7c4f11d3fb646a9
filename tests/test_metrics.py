"""The numbers of a comparison, from runs whose every metric can be computed by hand."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scenarios import short_scenario

from workbench.simulate.closed_loop import Run, simulate
from workbench.simulate.kernel_loop import ACCUMULATORS, LOG_COLUMNS
from workbench.simulate.metrics import measure
from workbench.simulate.ride import SpeedLimits, ride
from workbench.simulate.stretches import Stretch, stretches


def made_up_run(**changes):
    """Ten rows, 0.5 s apart, of a train whose speed is t^2: its jerk is 2 m/s^3 in the log."""
    t = 0.5 * np.arange(10)
    log = np.zeros((10, len(LOG_COLUMNS)))
    log[:, LOG_COLUMNS.index("t_s")], log[:, LOG_COLUMNS.index("v_mps")] = t, t**2
    totals = dict.fromkeys(ACCUMULATORS, 0.0) | ride(0.001, SpeedLimits()).totals() | {
        "jerk_square_sum": 900.0, "jerk_steps": 100.0, "jerk_p95_mps3": 5.0, "jerk_max_mps3": 7.0,
        "command_variation_mps2": 10.0, "force_switchings": 20.0, "overspeed_max_mps": 1.5,
        "weighted_square_sum": 36.0,
        "samples": 400.0, "position_error_min": -0.3, "position_error_max": 0.1, "speed_error_min": -0.2,
        "speed_error_max": 0.4, "position_error_square_sum": 4.0, "speed_error_square_sum": 16.0,
        "traction_work_j": 7.0, "braking_work_j": 3.0, "saturated_samples": 5.0, "commands": 40.0,
        "band_violations": 12.0, "command_max_mps2": 0.9, "command_min_mps2": -0.8, "speed_min_mps": -0.01,
        "time_of_max_position_error_s": 2.5, "rate_limited_steps": 8.0, "adhesion_limited_steps": 4.0,
    }
    values = {"controller": "pid", "title": "PID", "columns": LOG_COLUMNS, "log": log, "totals": totals,
              "final_position_m": 900.25, "end_s": 5.0, "failed": None, "period_s": 0.001,
              "step_us": np.array([1.0, 2.0, 3.0, 4.0, 2000.0]), "counters": {"qp": 3}}
    return Run(**(values | changes))


def test_each_metric_is_its_definition():
    row = measure(made_up_run(), short_scenario()).row()
    by_hand = {
        "controller": "pid", "period_s": 0.001, "position_error_min": -0.3, "position_error_max": 0.1,
        "speed_error_min": -0.2, "speed_error_max": 0.4, "position_rms": 0.1, "speed_rms": 0.2, "stopping_error": 0.25,
        "energy_J": 7.0, "jerk_rms": 3.0, "jerk_p95": 5.0, "jerk_max": 7.0, "logged_jerk_rms": 2.0,
        "comfort_rms": 0.3, "command_variation": 2.0, "switchings": 4.0, "overspeed_max": 1.5,
        "saturated_fraction": 0.125, "rate_limited_fraction": 0.02, "adhesion_limited_fraction": 0.01,
        "limit_violations": 12,
        "step_us_median": 3.0,
        "step_us_p99": np.percentile([1, 2, 3, 4, 2000], 99), "deadline_misses": 1, "failed": None,
        "command_max": 0.9, "command_min": -0.8, "speed_min": -0.01, "time_of_max_position_error": 2.5,
        "counters": {"qp": 3},
    }
    assert list(row) == list(by_hand)
    for name, value in by_hand.items():
        assert row[name] == (pytest.approx(value, rel=1e-12) if isinstance(value, float) else value), name


def test_the_logged_jerk_does_not_depend_on_how_the_log_was_asked_for():
    # 0.014 s is no whole number of 10 ms steps: the rows are 10 ms apart.
    asked = short_scenario(simulation__log_every_s=0.014)
    given = short_scenario(simulation__log_every_s=0.01)
    rms = [measure(simulate(s, "pid"), s).logged_jerk_rms for s in (asked, given)]
    assert rms[0] == rms[1] > 0


@pytest.mark.parametrize("rows", [1, 2])
def test_a_run_too_short_for_a_jerk_has_none(rows):
    run = made_up_run()
    assert measure(replace(run, log=run.log[:rows]), short_scenario()).logged_jerk_rms == 0.0
    failed = replace(run, log=run.log[:rows], failed="it diverged")
    assert measure(failed, short_scenario()).row()["logged_jerk_rms"] is None


def test_what_a_run_never_reached_is_none_and_can_be_written_as_json():
    totals = made_up_run().totals | {"command_max_mps2": -np.inf, "command_min_mps2": np.inf}
    row = measure(made_up_run(totals=totals, failed="it left its domain"), short_scenario()).row()
    assert row["command_max"] is row["command_min"] is None
    # A part of a run has extrema, but no mean, no work and no stop to compare with those of a whole run.
    whole = ("position_rms", "speed_rms", "stopping_error", "energy_J", "jerk_rms", "jerk_p95", "jerk_max",
             "logged_jerk_rms", "comfort_rms", "command_variation", "switchings", "overspeed_max")
    assert [name for name in whole if row[name] is not None] == []
    assert (row["position_error_min"], row["speed_error_max"]) == (-0.3, 0.4)
    assert json.loads(json.dumps(row, allow_nan=False))["failed"] == "it left its domain"


def test_stretches_are_the_largest_errors_between_events_and_before_the_next():
    """The desired position is zero and the position 5 - t at t = 0, 0.5 ... 4.5 s."""
    run = made_up_run()
    log = run.log.copy()
    log[:, LOG_COLUMNS.index("s_m")] = 5.0 - run.column("t_s")
    run = replace(run, log=log)
    assert run.position_error == pytest.approx(5.0 - run.column("t_s"))
    assert stretches(run, (0.0, 2.0, 4.0, 5.0), 0.5) == (
        Stretch(0.0, 5.0, 3.5), Stretch(2.0, 3.0, 1.5), Stretch(4.0, 1.0, 0.5))
    assert len(stretches(run, (0.0, 2.0, 6.0), 0.5)) == 1, "the run ends before the third event"
    assert len(stretches(replace(run, failed="lost"), (0.0, 2.0, 5.0), 0.5)) == 1, "it fails as the third begins"
