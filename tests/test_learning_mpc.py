"""MPC that learns from trip to trip: errors fall on what repeats, and it uses no more than it is said to be told."""

from dataclasses import replace

import numpy as np
import pytest
from contests import common

from workbench.contest.entrant import trial_errors
from workbench.contest.entrants import check_entrants, information, learns, play
from workbench.contest.learning import learners, mpc_rivals
from workbench.contest.matches import play_match
from workbench.contest.record import Contest
from workbench.contest.told import Told
from workbench.errors import InputError
from workbench.model.sensing import Sensing
from workbench.mpc.learning import learned_from
from workbench.simulate.closed_loop import setting_of
from workbench.trains.scenario import ControllerSpec, Scenario

OWN = {"learning_gain": 0.8, "smoothing_s": 0.15, "trials": 4.0}


def learner(contest: Contest, **changes: float) -> ControllerSpec:
    """As the offset-free MPC that is stated, and what it learns by."""
    spec = contest.world.controllers["mpc_offset_free"]
    return spec.model_copy(update={"law": "mpc.learning", "parameters": {**spec.parameters, **OWN, **changes}})


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    contest = common()
    return contest.world.model_copy(update={"controllers": {
        name: contest.world.controllers[name] for name in ("mpc_offset_free", "mpc_linear")} | {
            "mpc_learning": learner(contest)}})


def test_errors_fall_from_trip_to_trip_and_end_below_those_of_the_same_mpc_that_does_not_learn(
        scenario: Scenario) -> None:
    """On the contest's drawn train and line, its gusts and its actuator, which repeat."""
    contest = common()
    condition = contest.conditions["ten"]
    found = play_match(scenario, "mpc_learning", condition, 1, contest.seed)
    plain, nominal = (trial_errors(play_match(scenario, name, condition, 1, contest.seed).run, scenario.track.length_m)
                      for name in ("mpc_offset_free", "mpc_linear"))
    assert plain is not None and nominal is not None
    position, speed = np.array(found.trials).T
    assert len(position) == 4 and position[0] == pytest.approx(plain[0], rel=1e-12)
    assert np.all(np.diff(position) < 0) and position[-1] < 0.5 * position[0] and speed[-1] < speed[0]
    assert trial_errors(found.run, scenario.track.length_m) == found.trials[-1]
    assert position[-1] < 0.1 * nominal[0]


def test_it_is_told_position_and_speed_and_no_train_or_line(scenario: Scenario) -> None:
    """Its first trip does not change with the drawn train but by what it measures: at the start, nothing."""
    short = replace(setting_of(scenario), end_s=20.0)
    of = scenario.model_copy(update={"controllers": {"mpc_learning": learner(common(), trials=1.0)}})
    plain, at_place, at_speed = (play(of, "mpc_learning", replace(short, sensing=Sensing(**noise, seed=3))).run.log
                                 for noise in ({}, {"position_noise_m": 0.02}, {"speed_noise_mps": 0.02}))
    assert not np.array_equal(plain, at_place) and not np.array_equal(plain, at_speed)
    assert learns(scenario, "mpc_learning")
    assert information(scenario, "mpc_learning") == (
        "full state, nominal model, earlier trials; the actuator's delay and lag")


def test_it_enters_a_contest_and_is_no_rival_of_itself(scenario: Scenario) -> None:
    contest = common()
    entering = contest.model_copy(update={"entrants": {"mpc_learning": learner(contest)}})
    path = contest.folder / "common.toml"
    stated = contest.world.model_copy(update={"controllers": {"pid": contest.world.controllers["pid"]}})
    check_entrants(entering, stated, path, path)
    wrong = entering.model_copy(update={"entrants": {"mpc_learning": learner(contest, trials=2.5)}})
    with pytest.raises(InputError, match="no whole number"):
        check_entrants(wrong, stated, path, path)
    told = Told(few_of(contest), scenario, (), None)
    assert learners(told) == ["mpc_learning"]
    assert mpc_rivals(told) == ["mpc_offset_free", "mpc_linear"]


def few_of(contest: Contest) -> Contest:
    tuning = contest.tuning.model_copy(update={"found": {}})
    return contest.model_copy(update={"conditions": {"ten": contest.conditions["ten"]}, "entrants": {}, "absent": {},
                                      "tuning": tuning})


def test_what_is_learned_is_smoothed_without_a_shift_and_gaps_are_bridged() -> None:
    true = np.sin(np.arange(200) / 15)
    noisy = true + np.random.default_rng(3).normal(0, 0.3, 200)
    pushed = np.where(np.arange(200) < 10, np.nan, noisy)
    found = learned_from(np.zeros(200), pushed, 1.0, 3.0)
    assert np.abs(found - true)[20:-10].max() < 0.5 * np.abs(noisy - true)[20:-10].max()
    lags = [np.corrcoef(found[20 + lag:180 + lag], true[20:180])[0, 1] for lag in (-4, 0, 4)]
    assert lags[1] == max(lags)
    assert np.isfinite(found).all()
    halved = learned_from(np.full(200, 0.2), pushed, 0.5, 3.0)
    assert halved == pytest.approx(0.5 * (0.2 + found))
    assert np.array_equal(learned_from(found, np.full(200, np.nan), 0.5, 3.0), found)
    for share, smoothing in ((0.0, 1.0), (1.1, 1.0), (0.5, -1.0)):
        with pytest.raises(InputError):
            learned_from(found, pushed, share, smoothing)
