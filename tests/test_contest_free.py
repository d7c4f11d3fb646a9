"""Who follows no curve is judged by what it is for; and what is computed once a process changes no bit of a run."""

import json
from dataclasses import replace

import numpy as np
import pytest
from contests import COMMON, few, only, without_actuator
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from workbench.contest.effort import mpc_table
from workbench.contest.energy import best_run
from workbench.contest.entrants import follows_curve
from workbench.contest.learning import learning_tables
from workbench.contest.matches import (
    OF_CURVE,
    STANDING_MPS,
    Match,
    all_matches,
    entries,
    match_values,
    overspeed,
    run_match,
    with_parameters,
)
from workbench.contest.record import Contest, WithoutCurve
from workbench.contest.study import KIND, located
from workbench.contest.tables import condition_table, winners_table
from workbench.contest.told import LATE_S, Told
from workbench.contest.tune import tune_all
from workbench.errors import InputError
from workbench.mpc import linear, terminal, transcription, tube
from workbench.mpc.controller import KINDS
from workbench.paper.parameter_search import score
from workbench.trains.scenario import Scenario

FREE = "mpc_economic"
KEPT = (terminal.lqr, tube._extents, linear._linearised, transcription._program)


@pytest.fixture(scope="module")
def scenario(contest: Contest) -> Scenario:
    return contest.world


@pytest.mark.parametrize("law", KINDS)
def test_an_mpc_is_computed_once_and_runs_the_same_whatever_ran_before(
        law: str, contest: Contest, scenario: Scenario) -> None:
    name = next(n for n, spec in scenario.controllers.items() if spec.law == law)

    def run(condition: str, draw: int) -> bytes:
        stated = contest.conditions[condition]
        changed = scenario.model_copy(update={"simulation": scenario.simulation.model_copy(update={"dwell_s": 1.0})})
        return run_match(changed, name, stated, draw, contest.seed).log[:600].tobytes()

    for kept in KEPT:
        kept.cache_clear()
    first, other = run("noise", 0), run("weak", 1)
    misses = [kept.cache_info().misses for kept in KEPT]
    again = run("noise", 0), run("weak", 1)
    assert [kept.cache_info().misses for kept in KEPT] == misses, "computed again for the same train"
    assert again == (first, other)
    for kept in KEPT:
        kept.cache_clear()
    assert run("weak", 1) == other


def test_economic_results_are_the_same_bytes_with_any_number_of_processes(contest: Contest, scenario: Scenario) -> None:
    small, of = few(contest, "noise"), only(scenario, FREE, "mpc_tube")
    runs = [all_matches(small, of, workers, lambda *_: None) for workers in (1, 2)]
    plain = [json.dumps([(m.draw, m.entry, m.values, m.failed, m.counters) for m in run]) for run in runs]
    assert plain[0] == plain[1]


def hurried(scenario: Scenario) -> Scenario:
    """With a curve that brakes later than the speed limit before the last station allows."""
    reference = scenario.reference.model_copy(update={"braking_mps2": 0.6})
    return scenario.model_copy(update={"reference": reference})


def test_economic_mpc_saves_energy_stops_and_keeps_the_limits_without_following(
        contest: Contest, scenario: Scenario) -> None:
    nominal, scenario = contest.conditions["nominal"], without_actuator(scenario)
    free, tied = (match_values(run_match(scenario, name, nominal, 0, contest.seed), scenario)
                  for name in (FREE, "mpc_told"))
    best = best_run(scenario)
    assert best is not None
    assert best.lower_bound_j < free["energy_J"] < tied["energy_J"]  # type: ignore[operator]
    assert free["stopping_error"] < scenario.simulation.position_band_m  # type: ignore[operator]
    assert free["late_s"] == 0.0
    assert free["position_rms"] > 5 * tied["position_rms"]  # type: ignore[operator]
    assert free["overspeed_mps"] == tied["overspeed_mps"] == 0.0
    too_fast, limited = (match_values(run_match(hurried(scenario), name, nominal, 0, contest.seed), scenario)
                         for name in ("mpc_told", FREE))
    assert too_fast["overspeed_mps"] > 1.0 > limited["overspeed_mps"]  # type: ignore[operator]


def test_who_follows_no_curve_is_not_ranked_by_errors_from_it(
        contest: Contest, scenario: Scenario) -> None:
    of = only(scenario, "pid", FREE, "mpc_offset_free", "chen2019")
    of = with_parameters(of, "chen2019", {"trials": 2.0})
    small = few(contest, "nominal", seeds=1).with_world(of)
    told = Told(small, of, all_matches(small, of, 1, lambda *_: None), None)
    assert [follows_curve(of, name) for name in of.controllers] == [True, False, True, True]
    # Errors from the curve made the least of all, it would still not be their winner; energy would be its own, did it
    # not come too late to be held against who is on time.
    favoured = tuple(replace(m, values=m.values | dict.fromkeys(OF_CURVE, 0.0)) if m.entry == FREE else m
                     for m in told.matches)
    flattered = replace(told, matches=favoured)
    for metric in told.metrics:
        assert (FREE in flattered.winners("nominal", metric)) <= (metric not in OF_CURVE)
    late, = (m.values["late_s"] for m in told.matches if m.entry == FREE)
    assert late is not None and late > LATE_S and FREE not in told.winners("nominal", "energy_J")
    punctual = tuple(replace(m, values=m.values | {"late_s": 0.0}) for m in told.matches)
    assert replace(told, matches=punctual).winners("nominal", "energy_J") == [FREE]
    row = next(row for row in condition_table(told, "nominal").text if row[0] == FREE)
    marked = [metric for metric, cell in zip(told.metrics, row[1:-1], strict=True) if "follows no curve" in cell]
    assert tuple(marked) == tuple(m for m in told.metrics if m in OF_CURVE)
    assert len(winners_table(told).rows[0]) == 1 + len(told.metrics)
    for table in learning_tables(told):
        assert FREE not in table.header and "mpc_offset_free" in table.header
    findings = KIND.run(small, 1, lambda *_: None).findings
    assert any(finding.startswith(f"{FREE}, which follows no curve") for finding in findings)
    assert not any("desired curve itself" in finding for finding in findings)
    findings = KIND.run(small.with_world(hurried(only(scenario, "pid"))), 1, lambda *_: None).findings
    assert any("The desired curve itself is up to 1.06 m/s faster" in finding for finding in findings)


def test_steps_are_told_beside_their_period_with_who_answered_instead(contest: Contest, scenario: Scenario) -> None:
    small, of = few(contest, "nominal", seeds=1), only(scenario, "pid", "mpc_linear")
    counters = {"qp": 400, "qp_failed": 3, "late": 2, "shifted_plan": 4, "lqr": 1, "feedforward": 0}
    values = dict.fromkeys(Told(small, of, (), None).metrics, 0.0)
    matches = tuple(Match("nominal", draw, name, dict(values), None, 10.0 * (draw + 1), 500.0 * (draw + 1), counters)
                    for draw in range(3) for name in of.controllers)
    (table,) = mpc_table(of, entries(small, of), matches)
    assert len(table.rows) == 1  # no other than MPC
    name, period, middle, slow, share, asked, *rest = table.text[0]
    assert (name, period, middle, slow) == ("mpc_linear", "100", "20.0", "1000")
    assert float(share) == pytest.approx(1.0)  # 1 ms of 100 ms
    assert asked == "1200" and rest == ["9", "6", "12", "3", "0"]


@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(places=st.lists(st.tuples(st.floats(0.0, 5400.0), st.floats(0.0, 30.0)), min_size=1, max_size=20))
def test_excess_over_the_limits_is_found_place_by_place(scenario: Scenario, places: list[tuple[float, float]]) -> None:
    track = scenario.track
    worst = 0.0
    for place, speed in places:
        for section in track.speed_limit:
            if section.start_m <= place < section.end_m:
                worst = max(worst, speed - section.speed_mps)
    position, speeds = (np.array(column) for column in zip(*places, strict=True))
    assert overspeed(position, speeds, track) == worst
    assert overspeed(position, speeds, track.model_copy(update={"speed_limit": ()})) == 0.0


def test_late_is_how_long_a_train_moves_beyond_its_time(contest: Contest, scenario: Scenario) -> None:
    run = run_match(scenario, "pid", contest.conditions["nominal"], 0, contest.seed)
    trip = scenario.desired_curve().trip_time_s
    log, v = run.log.copy(), run.columns.index("v_mps")
    log[:, v] = np.where(run.column("t_s") <= trip + 2.0, 2 * STANDING_MPS, 0.0)
    assert match_values(replace(run, log=log), scenario)["late_s"] == pytest.approx(2.0, abs=0.11)
    log[:, v] = np.where(run.column("t_s") <= trip - 9.0, 2 * STANDING_MPS, 0.0)
    assert match_values(replace(run, log=log), scenario)["late_s"] == 0.0


def test_it_is_tuned_for_what_it_is_for(contest: Contest, scenario: Scenario) -> None:
    goal = contest.tuning.without_curve
    assert isinstance(goal, WithoutCurve)
    values = {"energy_J": goal.energy_j, "stopping_error": goal.stopping_m, "late_s": goal.late_s,
              "overspeed_mps": goal.overspeed_mps, "jerk_rms": goal.ride_jerk_mps3, "position_rms": 1e9}
    assert score(values, goal.units, goal.failed) == pytest.approx(5.0)
    assert score(dict.fromkeys(values), goal.units, goal.failed) == 5 * goal.failed
    without = contest.tuning.model_copy(update={"without_curve": None})
    with pytest.raises(InputError, match="which follows no curve"):
        tune_all(contest.model_copy(update={"tuning": without}), scenario, [FREE], 1, lambda *_: None)
    with pytest.raises(InputError, match="which follows no curve"):
        located(contest.model_copy(update={"tuning": without}), COMMON)
