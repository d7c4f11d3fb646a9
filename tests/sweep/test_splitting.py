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
from workbench.simulate.splitting import Estimate, Probability, splitting
from workbench.trains.scenario import load_scenario


def total(points):
    return points.sum(axis=1)


def beyond(dimensions: int, edge: float) -> float:
    """P(sum of the coordinates > dimensions - edge) in [-1, 1]^dimensions, for edge <= 2: a corner (Irwin and Hall)."""
    return edge**dimensions / (2**dimensions * math.factorial(dimensions))


def study(performance, dimensions: int, value: float, seed: int, count: int = 10, points: int = 500) -> list[Estimate]:
    return [splitting(performance, dimensions, value, points, np.random.default_rng((seed, i))) for i in range(count)]


def estimates(*arguments) -> np.ndarray:
    return np.array([one.probability for one in study(*arguments)])


@pytest.mark.parametrize(("dimensions", "edge"), [(2, 0.1), (3, 0.3), (5, 1.0), (6, 0.5)])
def test_the_corner_of_a_cube_has_the_probability_that_it_has(dimensions, edge):
    truth = beyond(dimensions, edge)
    found = estimates(total, dimensions, dimensions - edge, 1, 40)
    assert abs(found.mean() - truth) < 4 * found.std(ddof=1) / math.sqrt(40)
    assert found.std(ddof=1) < 0.6 * truth, "a plain Monte Carlo of as many runs would see none at all"


@pytest.mark.parametrize("dimensions", [1, 4])
def test_so_has_what_one_coordinate_alone_decides_however_thin_it_is(dimensions):
    """As the energy of a train, which its mass decides: steps as long in every coordinate would not get there."""
    found = estimates(lambda points: points[:, 0], dimensions, 1 - 2e-6, 1, 40, 100)
    assert abs(found.mean() - 1e-6) < 4 * found.std(ddof=1) / math.sqrt(40)
    assert found.min() > 0 and found.std(ddof=1) < 0.9e-6
    searches = [splitting(lambda points: points[:, 0], dimensions, 1 - 2e-6, 40, np.random.default_rng(i), near=True)
                for i in range(40)]
    assert all(one.probability > 0 and one.runs < 2500 for one in searches), "a search finds it in fewer runs"


def test_intervals_hold_the_truth_about_as_often_as_they_say():
    truth, flat = beyond(3, 0.3), 0.0
    intervals = [Probability.of(study(total, 3, 2.7, seed, 10, 50), 50) for seed in range(100, 140)]
    held = sum(one.low <= truth <= one.high for one in intervals)
    assert held >= 33, "95 % of 40, less three standard deviations"
    for seed in range(40):  # where nothing leads to the event, which some of the estimates then do not meet
        one = Probability.of(study(lambda points: np.where(total(points) > 2.7, np.inf, flat), 3, 9.0, seed, 10, 200),
                             200)
        held += one.low <= truth <= one.high
    assert held >= 69


def test_what_was_counted_has_the_interval_of_counts():
    """Clopper and Pearson 1934: of 10 with 3 the printed 0.0667 to 0.6525, and one-sided at the ends."""
    def of(met, draws):
        return Probability.of([Estimate(met / draws, draws, True)] * 2, draws)

    assert (of(6, 20).low, of(6, 20).high) == pytest.approx((0.166, 0.465), abs=1e-3)
    assert (of(0, 50).low, of(0, 50).high) == pytest.approx((0.0, 1 - 0.05**0.01))
    assert (of(50, 50).low, of(50, 50).high) == pytest.approx((0.05**0.01, 1.0))


def test_what_is_not_rare_is_counted_and_what_cannot_be_is_0():
    often = splitting(total, 2, 0.0, 1000, np.random.default_rng(1))
    assert abs(often.probability - 0.5) < 0.06
    never = splitting(total, 2, 2.5, 100, np.random.default_rng(1))
    assert never.probability == 0.0
    flat = splitting(lambda points: np.zeros(len(points)), 2, 1.0, 100, np.random.default_rng(1))
    assert flat == Estimate(0.0, 100, True)


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
    monkeypatch.setattr(rare, "ESTIMATES", 8)
    monkeypatch.setattr(rare, "SAMPLES", 20)
    monkeypatch.setattr(rare, "SCOUTS", 8)
    scenario = load_scenario(scenario_path)
    energy = [measure(simulate(scenario, "own", Factors(mass=mass)), scenario).energy_J for mass in (0.9, 1.0, 1.09)]
    assert energy == sorted(energy)
    [one] = probabilities(scenario, scenario_path, Event("energy_J", energy[-1]), 3, ["own"], 1)
    assert one.probability.low < 0.05 < one.probability.high < 0.2
    [again] = probabilities(scenario, scenario_path, Event("energy_J", energy[-1]), 3, ["own"], 1)
    assert again == one
    every = [rare.estimate((scenario, Event("energy_J", energy[-1]), 3, 20, rare.LEAST), ("own", n)) for n in range(8)]
    assert one.probability == Probability.of(every, 20), "no estimate is left out"


def test_an_event_that_no_run_meets_ends_early_with_what_the_draws_alone_say(scenario_path, monkeypatch, tmp_path):
    """As by hand: of n independent draws none, so 0.05 = (1 - p)^n; what the search has seen beyond is no bound."""
    monkeypatch.setattr(rare, "SAMPLES", 8)
    monkeypatch.setattr(rare, "SCOUTS", 4)
    deep = []

    def counted(shared, task):
        deep.append(task) if shared[-1] < 1 else None
        return estimate(shared, task)

    estimate = rare.estimate
    monkeypatch.setattr(rare, "estimate", counted)
    scenario, event = load_scenario(scenario_path), Event("position_rms", 1000.0)
    [one] = probabilities(scenario, scenario_path, event, 3, ["own"], 1, tmp_path / "rare.csv")
    assert deep == [("own", 10)], "a small search alone; the estimates draw their points, and search no deeper"
    assert one.runs < 80 + 4 + 15 * 3 * 6
    assert (one.probability.mean, one.probability.low) == (0.0, 0.0)
    assert (1 - one.probability.high) ** 80 == pytest.approx(0.05)
    assert f"was met by none of {one.runs} runs" in one.line(event) and "is below 0.037 at 95 %" in one.line(event)
    assert (tmp_path / "rare.csv").read_text().count(",0.0,") == 10
    deep.clear()
    monkeypatch.setattr(rare, "estimate",
                        lambda shared, task: Estimate(0.0, 4) if task[1] == 10 else counted(shared, task))
    [often] = probabilities(scenario, scenario_path, Event("position_rms", 0.0), 3, ["own"], 1)
    assert often.probability.mean == 1.0, "a search that finds nothing where the draws do is no answer"
    assert often.probability.low == pytest.approx(0.05 ** (1 / 80)) and len(deep) == 10


@pytest.mark.parametrize(("arguments", "words"), [
    (("--rare", "nothing>1"), "no metric of a run"), (("--rare", "energy_J>much"), "no finite number"),
    (("--rare", "energy_J"), "says no number behind"), (("--rare", "energy_J>inf"), "no finite number"),
    (("--rare", "energy_J>1", "--resume"), "leave --resume out"),
    (("--rare", "energy_J>1", "--runs", 5), "leave --runs out"),
    (("--sensitivity", "--runs", 5), "leave --runs out"), (("--sensitivity", "--seed", 0), "leave --seed out"),
])
def test_what_cannot_be_asked_is_said_in_a_line(scenario_path, tmp_path, arguments, words):
    assert words in one_line(run("sweep", scenario_path, "--out", tmp_path / "out", *arguments))
    assert not (tmp_path / "out").exists()
