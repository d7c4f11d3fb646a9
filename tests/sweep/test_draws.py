"""What is drawn, and when enough is."""

import math
from dataclasses import fields

import numpy as np
import scipy.stats
from short_sweep import SEED

from workbench.simulate import stopping
from workbench.simulate.closed_loop import Factors
from workbench.simulate.draws import draw_factors, factors_of
from workbench.simulate.stopping import UntilWidth
from workbench.simulate.sweep import MonteCarlo, Options, monte_carlo
from workbench.trains.scenario import load_scenario


def test_factors_are_drawn_for_named_ones_only_within_the_spread(scenario_path):
    scenario = load_scenario(scenario_path)
    drawn = [draw_factors(scenario, run) for run in range(200)]
    assert all(abs(f.mass - 1) <= 0.1 and abs(f.davis_a - 1) <= 0.1 for f in drawn)
    assert min(f.mass for f in drawn) < 0.91 and max(f.mass for f in drawn) > 1.09
    assert all(f.davis_b == f.davis_c == f.line_resistance == 1.0 for f in drawn)
    everything = scenario.uncertainty.model_copy(update={"factors": tuple(f.name for f in fields(Factors))})
    more = draw_factors(scenario.model_copy(update={"uncertainty": everything}), 5)
    assert (more.mass, more.davis_a) == (drawn[5].mass, drawn[5].davis_a)
    assert draw_factors(scenario, 5, seed=8) != drawn[5]


def test_sobol_draws_are_the_same_in_parts_and_fill_the_range_evenly(scenario_path):
    scenario = load_scenario(scenario_path)
    every = list(factors_of(scenario, 0, 64, SEED, "sobol"))
    assert every == [*factors_of(scenario, 0, 5, SEED, "sobol"), *factors_of(scenario, 5, 59, SEED, "sobol")]
    places = sorted((f.mass - 0.9) / 0.2 for f in every)
    assert all(i / 64 <= place < (i + 1) / 64 for i, place in enumerate(places)), "one in each 64th of the range"
    assert all(f.davis_b == 1.0 for f in every)


def test_draws_end_once_the_intervals_are_narrow_wherever_they_are_run(scenario_path, monkeypatch):
    monkeypatch.setattr(stopping, "FIRST_LOOK", 8)
    scenario = load_scenario(scenario_path)

    def found(width: float, workers: int) -> MonteCarlo:
        return monte_carlo(scenario, scenario_path, Options(64, SEED, ["pid"], workers=workers,
                                                            until=UntilWidth("position_error_max", width)))

    one, two = found(0.03, 1), found(0.03, 2)
    assert 8 < one.runs == two.runs < 64
    assert list(one.rows()) == list(two.rows())
    values = [row.position_error_max for row in one.rows()]
    interval = scipy.stats.t.interval(0.95, len(values) - 1, np.mean(values), scipy.stats.sem(values))
    assert math.isclose(interval[1] - interval[0], one.means["pid"].width)
    assert one.means["pid"].width <= 0.03
    assert found(1e-9, 1).runs == 64
