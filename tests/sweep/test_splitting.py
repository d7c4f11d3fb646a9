"""Splitting against probabilities in closed form, and as a mode of a sweep against counted draws."""

import math

import numpy as np
import pytest
from command_line import one_line, run
from small_folders import small_folder

from workbench.simulate import rare
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.simulate.rare import Event, probabilities
from workbench.simulate.setting import Factors
from workbench.simulate.splitting import Probability, splitting
from workbench.trains.scenario import load_scenario


def total(points):
    return points.sum(axis=1)


def beyond(dimensions: int, edge: float) -> float:
    """P(sum of the coordinates > dimensions - edge) in [-1, 1]^dimensions, for edge <= 2: a corner (Irwin and Hall)."""
    return edge**dimensions / (2**dimensions * math.factorial(dimensions))


def estimates(performance, dimensions: int, value: float, seed: int, count: int = 10, points: int = 500) -> np.ndarray:
    return np.array([splitting(performance, dimensions, value, points, np.random.default_rng((seed, i))).probability
                     for i in range(count)])


@pytest.mark.parametrize(("dimensions", "edge"), [(2, 0.1), (3, 0.3), (5, 1.0), (6, 0.5)])
def test_the_corner_of_a_cube_has_the_probability_that_it_has(dimensions, edge):
    truth = beyond(dimensions, edge)
    found = estimates(total, dimensions, dimensions - edge, 1, 40)
    assert abs(found.mean() - truth) < 4 * found.std(ddof=1) / math.sqrt(40)
    assert found.std(ddof=1) < 1.5 * truth, "a plain Monte Carlo of as many runs would see none at all"


def test_intervals_hold_the_truth_about_as_often_as_they_say():
    truth = beyond(3, 0.3)
    intervals = [Probability.of(estimates(total, 3, 2.7, seed, points=200)) for seed in range(100, 130)]
    held = sum(one.low <= truth <= one.high for one in intervals)
    assert held >= 24, "95 % of 30, less three standard deviations and what skewness takes"


def test_what_is_not_rare_is_counted_and_what_cannot_be_is_0():
    often = splitting(total, 2, 0.0, 1000, np.random.default_rng(1))
    assert abs(often.probability - 0.5) < 0.06
    never = splitting(total, 2, 2.5, 100, np.random.default_rng(1))
    assert never.probability == 0.0
    flat = splitting(lambda points: np.zeros(len(points)), 2, 1.0, 100, np.random.default_rng(1))
    assert flat == type(flat)(0.0, 100)


def test_runs_that_fail_are_beyond_every_value():
    """A corner in which the performance is infinite, as of a run that leaves a law's domain."""
    truth, edge = beyond(3, 0.6), 0.6

    def falls(points):
        return np.where(total(points) > 3 - edge, np.inf, total(points))

    found = estimates(falls, 3, 100.0, 7, 40)
    assert abs(found.mean() - truth) < 4 * found.std(ddof=1) / math.sqrt(40)


@pytest.fixture(scope="module")
def scenario_path(tmp_path_factory):
    """A scenario whose mass alone is drawn, within a tenth."""
    return small_folder(tmp_path_factory.mktemp("rare") / "doe2030") / "study.toml"


def test_the_probability_of_a_run_is_that_of_the_trains_that_make_it(scenario_path, monkeypatch):
    """The energy grows with the mass: it is above that of 1.09 times the mass for a twentieth of the trains."""
    monkeypatch.setattr(rare, "ESTIMATES", 4)
    monkeypatch.setattr(rare, "SAMPLES", 20)
    scenario = load_scenario(scenario_path)
    energy = [measure(simulate(scenario, "own", Factors(mass=mass)), scenario).energy_J for mass in (0.9, 1.0, 1.09)]
    assert energy == sorted(energy)
    [one] = probabilities(scenario, scenario_path, Event("energy_J", energy[-1]), 3, ["own"], 1)
    assert one.probability.low < 0.05 < one.probability.high < 0.2
    [again] = probabilities(scenario, scenario_path, Event("energy_J", energy[-1]), 3, ["own"], 1)
    assert again == one
    every = [rare.estimate((scenario, Event("energy_J", energy[-1]), 3, rare.LEAST), ("own", n)) for n in range(4)]
    assert one.probability == Probability.of(np.array([each.probability for each in every])), "no estimate is left out"


def test_an_event_that_no_run_meets_ends_early_with_what_the_draws_alone_say(scenario_path, monkeypatch, tmp_path):
    """As by hand: of n independent draws none, so 0.05 = (1 - p)^n; what the search has seen beyond is no bound."""
    monkeypatch.setattr(rare, "SAMPLES", 8)
    deep = []

    def counted(shared, task):
        deep.append(task) if shared[-1] < 1 else None
        return estimate(shared, task)

    estimate = rare.estimate
    monkeypatch.setattr(rare, "estimate", counted)
    scenario, event = load_scenario(scenario_path), Event("position_rms", 1000.0)
    [one] = probabilities(scenario, scenario_path, event, 3, ["own"], 1, tmp_path / "rare.csv")
    assert deep == [("own", 0), ("own", 1)], "the others draw their points, and search no deeper"
    assert (one.probability.mean, one.probability.low) == (0.0, 0.0)
    assert (1 - one.probability.high) ** 80 == pytest.approx(0.05)
    assert f"was met by none of {one.runs} runs" in one.line(event) and "is below 0.037 at 95 %" in one.line(event)
    assert (tmp_path / "rare.csv").read_text().count(",0.0,") == 10
    monkeypatch.setattr(rare, "PILOTS", 0)  # whose estimates meet nothing, where others do
    [often] = probabilities(scenario, scenario_path, Event("position_rms", 0.0), 3, ["own"], 1)
    assert often.probability.mean == 1.0


@pytest.mark.parametrize(("arguments", "words"), [
    (("--rare", "nothing>1"), "no metric of a run"), (("--rare", "energy_J>much"), "no finite number"),
    (("--rare", "energy_J"), "no finite number"), (("--rare", "energy_J>inf"), "no finite number"),
    (("--rare", "energy_J>1", "--resume"), "leave --resume out"),
    (("--rare", "energy_J>1", "--runs", 5), "leave --runs out"),
    (("--sensitivity", "--runs", 5), "leave --runs out"), (("--sensitivity", "--seed", 0), "leave --seed out"),
])
def test_what_cannot_be_asked_is_said_in_a_line(scenario_path, tmp_path, arguments, words):
    assert words in one_line(run("sweep", scenario_path, "--out", tmp_path / "out", *arguments))
    assert not (tmp_path / "out").exists()
