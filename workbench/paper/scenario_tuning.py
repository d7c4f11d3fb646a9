"""Tuning the controllers of a scenario: each drives the scenario's own train as stated, again and again."""

from __future__ import annotations

from collections.abc import Callable

from workbench.errors import InputError
from workbench.model.tuning import at_the_rail
from workbench.paper.local_search import Tuned, score, search
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.simulate.process_pool import results_of
from workbench.trains.scenario import Scenario, tunable, with_parameters


def tune_scenario(scenario: Scenario, names: list[str], workers: int,
                  on_progress: Callable[[int, int, str], None]) -> dict[str, Tuned]:
    """The best parameters found for each of the controllers, in parallel processes, in the order of the names.

    Raises InputError for a name that is no controller, and for ranges of what it does not state.
    """
    for name in names:
        if name not in scenario.controllers:
            raise InputError("", f"tuning.ranges.{name}", "is no controller of this scenario: choose one of "
                             f"{', '.join(scenario.controllers)}")
        for key in scenario.tuning.ranges[name].keys() - tunable(scenario, name).keys() if scenario.tuning else ():
            raise InputError("", f"tuning.ranges.{name}.{key}", "is no parameter that this controller states: remove "
                             "it")
    return results_of(_tune, scenario, names, workers, lambda done, name, _: on_progress(done, len(names), name))


def _tune(scenario: Scenario, name: str) -> Tuned:
    budget = scenario.tuning
    if budget is None:
        raise InputError("", "tuning", "is missing: state budget, objective and ranges in this table")
    goal = budget.objective
    units = at_the_rail(goal.units, scenario.actuator is not None)

    def cost(parameters: dict[str, float]) -> float:
        changed = with_parameters(scenario, name, parameters)
        found = measure(simulate(changed, name), changed)
        values = {metric: None if found.failed else float(getattr(found, metric)) for metric in units}
        return score(values, units, goal.failed)

    return search(cost, tunable(scenario, name), budget.ranges[name], budget.runs, budget.seed, 3 * goal.failed)
