"""Tuning the controllers of a scenario: each drives the scenario's own train as stated, again and again."""

from __future__ import annotations

from collections.abc import Callable

from workbench.errors import InputError
from workbench.files.known_names import one_of
from workbench.model.tuning import at_the_rail
from workbench.paper.parameter_search import NONE_YET, Finished, Name, Restart, Tuned, score, search, search_all
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.trains.scenario import Scenario, ScenarioTuning, tunable, with_parameters


def tune_scenario(scenario: Scenario, names: list[str], workers: int, on_progress: Callable[[int, int, str], None],
                  finished: Finished = NONE_YET) -> dict[Name, Tuned]:
    """The best parameters found for each of the controllers, in parallel processes, in the order of the names.

    Raises InputError for a name that is no controller, and for ranges of what it does not state.
    """
    budget = _budget(scenario)
    for name in names:
        if name not in scenario.controllers:
            raise InputError("", f"tuning.ranges.{name}", "is no controller of this scenario: "
                             f"{one_of(name, scenario.controllers)}")
        for key in budget.ranges[name].keys() - tunable(scenario, name).keys():
            raise InputError("", f"tuning.ranges.{name}.{key}", "is no parameter that this controller states: remove "
                             "it")
    return search_all(_restart, scenario, names, budget.restarts, workers, on_progress, finished)


def _budget(scenario: Scenario) -> ScenarioTuning:
    if scenario.tuning is None:
        raise InputError("", "tuning", "is missing: state budget, objective and ranges in this table")
    return scenario.tuning


def _restart(scenario: Scenario, name: str, restart: int) -> Restart:
    budget = _budget(scenario)
    goal = budget.objective
    units = at_the_rail(goal.units, scenario.actuator is not None)

    def cost(parameters: dict[str, float]) -> float:
        changed = with_parameters(scenario, name, parameters)
        found = measure(simulate(changed, name), changed)
        values = {metric: None if found.failed else float(getattr(found, metric)) for metric in units}
        return score(values, units, goal.failed)

    return search(cost, tunable(scenario, name), budget.ranges[name], budget.runs // budget.restarts, budget.seed,
                  restart)
