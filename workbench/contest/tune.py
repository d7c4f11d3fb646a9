"""The same budget for every controller: one optimiser, the same seeds, so many runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from workbench.contest.entrants import follows_curve
from workbench.contest.matches import match_values, run_match
from workbench.contest.record import Contest, Objective, WithoutCurve
from workbench.errors import InputError
from workbench.model.tuning import at_the_rail
from workbench.paper.parameter_search import NONE_YET, Finished, Name, Restart, Tuned, score, search, search_all
from workbench.trains.scenario import Scenario, tunable, with_parameters

# Draws of the search lie far from those of the contest, so that no controller is judged by what it was tuned on.
DRAWS_FROM = 1_000_000
Metrics = Mapping[str, float | None]


def goal_of(contest: Contest, scenario: Scenario, name: str) -> Objective | WithoutCurve:
    """What is minimised for a controller; InputError for one that is not searched, or whose objective is missing."""
    budget = contest.tuning
    if name not in scenario.controllers or name not in budget.ranges:
        raise InputError("", f"tuning.ranges.{name}", "is no controller with ranges: name one of "
                         f"{', '.join(n for n in budget.ranges if n in scenario.controllers)}")
    for key in budget.ranges[name]:
        if key not in tunable(scenario, name):
            raise InputError("", f"tuning.ranges.{name}.{key}", "is no parameter of this controller: remove it")
    goal = budget.objective if follows_curve(scenario, name) else budget.without_curve
    if goal is None:
        raise InputError("", "tuning.without_curve", f"is missing: state what '{name}', which follows no curve, is "
                         "tuned for")
    return goal


def tuning_runs(contest: Contest, scenario: Scenario, name: str, parameters: dict[str, float], condition: str
                ) -> list[Metrics]:
    """The metrics of a controller with other parameters in a condition, on the draws of the search."""
    changed, stated = with_parameters(scenario, name, parameters), contest.conditions[condition]
    draws = contest.tuning.draws if stated.random else 1
    return [match_values(run_match(changed, name, stated, DRAWS_FROM + draw, contest.tuning.seed), changed)
            for draw in range(draws)]


def tune_restart(contest: Contest, scenario: Scenario, name: str, condition: str, restart: int) -> Restart:
    """What one restart of the search finds for a controller; condition: of "per condition", else of no effect.

    An evaluation is the mean over the draws of a condition, of "minimax" the largest of these means. The stated
    parameters are the first, so that tuning cannot make a controller worse. Raises InputError for unknown names.
    """
    goal, budget = goal_of(contest, scenario, name), contest.tuning

    def cost(parameters: dict[str, float]) -> float:
        return max(_mean(tuning_runs(contest, scenario, name, parameters, each), goal,
                         contest.conditions[each].acting(scenario) is not None)
                   for each in contest.tuned_in(condition))

    evaluations = contest.evaluations(condition, name) // budget.restarts
    return search(cost, tunable(scenario, name), budget.ranges[name], evaluations, budget.seed, restart)


def _mean(runs: list[Metrics], goal: Objective | WithoutCurve, actuator: bool) -> float:
    units = at_the_rail(goal.units, actuator)
    return sum(score(values, units, goal.failed) for values in runs) / len(runs)


def tune_all(contest: Contest, scenario: Scenario, names: list[str], workers: int,
             on_progress: Callable[[int, int, str], None], finished: Finished = NONE_YET) -> dict[Name, Tuned]:
    """Several controllers in parallel processes, in the order of the names; of "per condition" each in each."""
    for name in names:
        goal_of(contest, scenario, name)
    searched: list[Name] = [*names]
    if contest.tuning.mode == "per condition":
        searched = [(condition, name) for condition in contest.conditions for name in names]
    return search_all(_task, (contest, scenario), searched, contest.tuning.restarts, workers, on_progress, finished)


def _task(shared: tuple[Contest, Scenario], name: Name, restart: int) -> Restart:
    contest, scenario = shared
    condition, controller = (contest.tuning.condition, name) if isinstance(name, str) else name
    return tune_restart(contest, scenario, controller, condition, restart)
