"""Who wins, of runs whose errors are known: equals win together, and a change that not all drove says nothing."""

from types import SimpleNamespace

import pytest
from short_sweep import write_scenario

from workbench.report.winners import winners
from workbench.trains.scenario import load_scenario


@pytest.fixture(scope="module")
def scenario(tmp_path_factory):
    return load_scenario(write_scenario(tmp_path_factory.mktemp("winners")))


def driven(scenario, *errors):
    """Metrics of the scenario's controllers in their order; None for one that fails."""
    return [SimpleNamespace(controller=name, failed=None if error is not None else "lost", energy_J=1e6,
                            step_us_median=1.0, position_error_min=None if error is None else -error,
                            position_error_max=error)
            for name, error in zip(scenario.controllers, errors, strict=False)]


def test_the_smallest_error_wins_and_equals_win_together(scenario):
    first, second, *_ = scenario.controllers
    names = {name: name.upper() for name in scenario.controllers}
    changes = [(None, driven(scenario, 2.0, 1.0)), (None, driven(scenario, 1.0, 2.0)),
               (None, driven(scenario, 0.001)), (None, driven(scenario, 3.0, None))]
    found = winners(scenario, driven(scenario, 1.0, 1.0 + 1e-9), changes, [], names)
    nominal, changed = found.rows
    assert nominal.winner.startswith(f"{names[first]} and {names[second]}, ")
    assert changed.condition == "3 changes of an assumed value, driven by all"
    assert (changed.winner, changed.others) == (f"{names[first]}, in 2 of 3", f"{names[second]} in 1")
    even = winners(scenario, driven(scenario, 1.0, 2.0), changes[:3], [], names)
    assert even.rows[1].winner == f"{names[second]} and {names[first]}, in 1 of 2"
    assert even.rows[1].others == "none"
    assert winners(scenario, driven(scenario, 1.0, None), [], [], names) is None
