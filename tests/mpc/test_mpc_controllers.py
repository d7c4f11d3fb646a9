"""The MPC family as controllers: every one of KINDS keeps its word on a line, whatever is measured or goes wrong."""

import functools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import short_scenario

from workbench.errors import InputError
from workbench.mpc.controller import COMMON, KINDS, MpcController
from workbench.mpc.fallback import COUNTERS, MEANING, Fallback
from workbench.mpc.solution import Solution
from workbench.simulate.closed_loop import Factors, simulate
from workbench.simulate.controllers import SAMPLED
from workbench.simulate.law_values import check_controllers
from workbench.simulate.metrics import measure
from workbench.trains.track import resistance_table

T, BRAKE, TRACTION, BAND = 0.1, 1.2, 1.0, 0.2
WEIGHTS = {"horizon": 25.0, "position_weight": 25.0, "speed_weight": 14.8, "command_weight": 4.34,
           "change_weight": 0.0, "band_price": 1e4}
OWN = {"observer_gain": 0.3, "energy_price": 1.0, "time_price": 0.0, "regenerated": 0.0, "disturbance_mps2": 0.15,
       "forgetting": 0.995}


def scenario_of(law, factory=short_scenario, **changes):
    parameters = WEIGHTS | {key: OWN[key] for key in KINDS[law].parameters} | changes
    return factory(controllers__mpc__law=law, controllers__mpc__parameters=parameters)


def controller(law, **changes):
    scenario = scenario_of(law, **changes)
    return MpcController(scenario, scenario.controllers["mpc"], "mpc"), scenario.desired_curve()


@functools.cache
def driven(law, factors=Factors()):  # noqa: B008 - frozen
    """The run of a kind with its plain values, looked at by several tests."""
    return simulate(scenario_of(law), "mpc", factors)


def errors(run):
    return run.column("s_m") - run.column("s_desired_m")


def test_every_kind_is_a_controller_of_scenarios():
    assert set(KINDS) <= set(SAMPLED)
    assert all(law.startswith("mpc.") for law in KINDS)


def test_a_command_may_be_held_for_several_samples_and_planned_with_their_period():
    held, curve = controller("mpc.linear", held_samples=5.0)
    scenario = scenario_of("mpc.linear")
    slow = scenario.controllers["mpc"].model_copy(update={"period_s": 5 * T})
    plain = MpcController(scenario.model_copy(update={"controllers": {"mpc": slow}}), slow, "mpc")
    assert held.problem.period_s == pytest.approx(5 * T)
    for k in range(40):
        position, speed, _ = (float(x) for x in curve.at(k * T))
        answer = held.command(k * T, position + 0.01, speed)
        if k % 5 == 0:
            wanted = plain.command(k * T, position + 0.01, speed)
        assert answer == wanted
    assert held.counters["qp"] == 8


OTHER_TRAINS = [Factors(), Factors(mass=1.1, davis_a=1.2), Factors(mass=0.93, line_resistance=1.5)]


@pytest.mark.parametrize("factors", OTHER_TRAINS)
@pytest.mark.parametrize("law", KINDS)
def test_every_kind_keeps_the_band_without_a_failure(law, factors):
    scenario, run = scenario_of(law), driven(law, factors)
    assert run.failed is None
    assert np.abs(errors(run)).max() < BAND
    assert run.counters["qp"] == len(run.step_us)
    assert {name: run.counters[name] for name in COUNTERS[1:]} == dict.fromkeys(COUNTERS[1:], 0)
    assert measure(run, scenario).saturated_fraction < 0.5


@pytest.mark.parametrize("law", KINDS)
def test_a_run_repeats_bit_for_bit(law):
    one, other = driven(law, OTHER_TRAINS[1]), simulate(scenario_of(law), "mpc", OTHER_TRAINS[1])
    assert one.log.tobytes() == other.log.tobytes()
    assert one.counters == other.counters


def test_an_observer_takes_the_offset_out_and_knowing_the_grades_the_transients():
    rms = {}
    for law in ("mpc.nonlinear", "mpc.offset_free", "mpc.told"):
        run = driven(law)
        settled = (run.column("t_s") > 52) & (run.column("s_m") < 499)  # between two changes of the line
        rms[law] = np.sqrt(np.mean(errors(run) ** 2))
        if law != "mpc.nonlinear":
            assert np.abs(errors(run)[settled]).max() < 1e-3
    assert rms["mpc.told"] < 0.5 * rms["mpc.offset_free"] < 0.1 * rms["mpc.nonlinear"]


def test_without_an_observer_a_constant_push_leaves_the_offset_that_the_feedback_states():
    run = simulate(scenario_of("mpc.linear"), "mpc", Factors(davis_a=1.2))
    ours, _ = controller("mpc.linear")
    settled = (run.column("t_s") > 54) & (run.column("s_m") < 499)
    # A constant push is met by K_p e: that of the line, and what the resistance is too low by.
    table = resistance_table(scenario_of("mpc.linear").track)
    force = table.specific_force[np.searchsorted(table.position_m, 480.0, side="right") - 1] + 0.2 * 0.3
    gain = ours.tracker.lqr.gain[0]
    assert errors(run)[settled].mean() == pytest.approx(-force / gain, rel=0.05)


BAD = [math.nan, math.inf, -math.inf, 1e300, -1e12]


@pytest.mark.parametrize("law", [law for law in KINDS if law != "mpc.economic"])
@settings(max_examples=15)
@given(st.lists(st.tuples(st.sampled_from(["good", "position", "speed", "time", "all"]), st.sampled_from(BAD)),
                min_size=1, max_size=10))
def test_bad_measurements_are_counted_and_answered_within_the_limits(law, kinds):
    ours, curve = controller(law)
    bad = 0
    for k, (kind, value) in enumerate(kinds):
        time_s = 50.0 + k * T
        position, speed, _ = curve.at(np.array(time_s))
        given_time = value if kind in ("time", "all") and not math.isfinite(value) else time_s
        given_position = value if kind in ("position", "all") else float(position)
        given_speed = value if kind in ("speed", "all") else float(speed)
        bad += not (math.isfinite(given_time) and abs(given_position) < 1e9 and abs(given_speed) < 1e4)
        assert -BRAKE <= ours.command(given_time, given_position, given_speed) <= TRACTION
    assert ours.counters["bad_measurement"] == bad
    assert ours.counters["qp"] == len(kinds) - bad
    assert any("bad_measurement" in line for line in ours.explain()) == (bad > 0)


@pytest.mark.parametrize("law", KINDS)
@settings(max_examples=8)
@given(st.floats(-1e6, 1e9), st.floats(-1e8, 1e8), st.floats(-1e3, 1e3))
def test_whatever_is_measured_the_command_is_a_number_within_the_limits(law, time_s, position, speed):
    ours, _ = controller(law, horizon=5.0)
    for k in range(2):
        assert -BRAKE <= ours.command(time_s + k * T, position, speed) <= TRACTION


class _Scripted:
    """A tracker that answers as told: a plan, a failure, nan or an exception; and takes as long as told."""

    horizon = 4

    def __init__(self, script):
        self.script, self.clock = list(script), 0.0

    def forget(self):
        pass

    def solve(self, sample, state, disturbance=0.0):
        way, seconds = self.script.pop(0)
        self.clock += seconds
        if way == "raises":
            raise RuntimeError("lots of text\nout of iterations")
        plan = np.array([0.1, 0.2, 0.3, 0.4]) + sample
        return Solution(plan * math.nan if way == "nan" else plan / 10, solved=way in ("good", "nan", "unconverged"),
                        why="" if way == "good" else "no reason")


def answers(script, bad=()):
    """Commands of a fallback whose solver answers by the script; None as state where a sample is bad."""
    ours, _ = controller("mpc.linear")
    tracker = _Scripted(script)
    made = Fallback(tracker, ours.tracker.lqr, ours.ahead, (-BRAKE, TRACTION), 0.05, lambda: tracker.clock)
    state = ours.ahead[0, :3] + [0.01, 0.0, 0.0]
    commands = [made.command(k, None if k in bad else state) for k in range(len(script) + len(bad))]
    return made, commands, state, ours


@pytest.mark.parametrize("trouble", [("raises", 0.0), ("nan", 0.0), ("says so", 0.0), ("good", 0.06)])
def test_a_failed_or_late_solution_is_answered_by_the_shifted_plan_then_by_the_lqr(trouble):
    made, commands, state, ours = answers([("good", 0.0), *[trouble] * 5])
    lqr = [ours.ahead[k, 3] - ours.tracker.lqr.gain @ (state - ours.ahead[k, :3]) for k in (4, 5)]
    assert commands == pytest.approx([0.01, 0.02, 0.03, 0.04, *lqr])
    name = "late" if trouble[1] else "qp_failed"
    assert {k: v for k, v in made.counters.items() if v} == {"qp": 6, name: 5, "shifted_plan": 3, "lqr": 2}
    lines = made.explain()
    assert any(line.startswith(f"{name}: 5") for line in lines)
    assert any("5 times" in line for line in lines)
    assert all("\n" not in line for line in lines)


def test_a_plan_that_is_not_converged_is_used_and_counted():
    made, commands, _, _ = answers([("unconverged", 0.0), ("good", 0.0)])
    assert commands == pytest.approx([0.01, 0.11])
    assert {k: v for k, v in made.counters.items() if v} == {"qp": 2, "unconverged": 1}
    assert len(made.explain()) == 2


def test_without_plan_and_measurement_what_the_curve_needs_answers():
    made, commands, _, ours = answers([("good", 0.0)], bad=(0,))
    assert commands[0] == pytest.approx(ours.ahead[0, 3])
    assert (made.counters["feedforward"], made.counters["bad_measurement"]) == (1, 1)
    assert set(MEANING) == set(COUNTERS)


def test_a_deadline_that_nothing_meets_leaves_a_train_that_still_arrives():
    run = simulate(scenario_of("mpc.nonlinear", deadline_s=1e-9), "mpc")
    assert run.failed is None
    assert run.counters["late"] == run.counters["lqr"] == run.counters["qp"] > 0
    assert np.abs(errors(run)).max() < BAND


@pytest.mark.parametrize(("changes", "words"), [
    *(({name: None}, f"'{name}' is missing: add it") for name in COMMON),
    ({"horizont": 25.0}, "unknown 'horizont': choose among horizon"),
    ({"horizon": 2.5}, "horizon: 2.5 is no whole number"),
    ({"held_samples": 2.5}, "held_samples = 2.5 is no whole number"),
    ({"held_samples": 0.0}, "held_samples = 0 is no whole number"),
    ({"horizon": 1.0}, "horizon: 1 is no whole number"),
    ({"horizon": 1e9}, "is no whole number from 2 to 1000"),
    ({"position_weight": 0.0}, "choose a weight within"),
    ({"band_price": -1.0}, "two finite numbers"),
    ({"deadline_s": 0.0}, "deadline_s = 0 must be positive"),
])
@pytest.mark.parametrize("law", KINDS)
def test_unfit_parameters_are_refused_naming_the_controller_and_the_file(law, changes, words):
    def without_none(**given):
        kept = {k: v for k, v in given.pop("controllers__mpc__parameters").items() if v is not None}
        return short_scenario(controllers__mpc__parameters=kept, **given)

    with pytest.raises(InputError, match=rf"^my\.toml: controllers\.mpc\.parameters: .*{words}") as trouble:
        check_controllers(scenario_of(law, without_none, **changes), "my.toml")
    assert "\n" not in str(trouble.value)


@pytest.mark.parametrize(("law", "changes", "words"), [
    ("mpc.offset_free", {"observer_gain": 1.5}, "observer_gain: 1.5 is outside 0 to 1"),
    ("mpc.economic", {"energy_price": -1.0}, "must be finite and not negative"),
    ("mpc.economic", {"regenerated": 2.0}, "be a share"),
    ("mpc.tube", {"disturbance_mps2": 0.0}, "is not above 0 and up to 5"),
    ("mpc.tube", {"disturbance_mps2": 50.0}, "is not above 0 and up to 5"),
])
def test_unfit_parameters_of_one_kind_are_refused(law, changes, words):
    with pytest.raises(InputError, match=words):
        controller(law, **changes)
