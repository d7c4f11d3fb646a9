"""The same budget for every controller: one optimiser, one seed, so many runs."""

from __future__ import annotations

from collections.abc import Callable

from workbench.contest.entrants import follows_curve
from workbench.contest.matches import match_values, run_match
from workbench.contest.record import Contest, Objective, WithoutCurve
from workbench.errors import InputError
from workbench.model.tuning import at_the_rail
from workbench.paper.local_search import Tuned, score, search
from workbench.simulate.process_pool import results_of
from workbench.trains.scenario import Scenario, tunable, with_parameters

# Draws of the search lie far from those of the contest, so that no controller is judged by what it was tuned on.
DRAWS_FROM = 1_000_000


def objective(values: dict[str, float | None], goal: Objective | WithoutCurve, actuator: bool = False) -> float:
    """The cost of one run; actuator: whether the plant has one, see `at_the_rail`."""
    if isinstance(goal, WithoutCurve):
        units = {"energy_J": goal.energy_j, "stopping_error": goal.stopping_m, "late_s": goal.late_s,
                 "overspeed_mps": goal.overspeed_mps, "logged_jerk_rms": goal.jerk_mps3}
    else:
        units = {"position_rms": goal.position_m, "speed_rms": goal.speed_mps, "logged_jerk_rms": goal.jerk_mps3}
    return score(values, at_the_rail(units, actuator), goal.failed)


def tune(contest: Contest, scenario: Scenario, name: str) -> Tuned:
    """The best parameters found for a controller, their cost, and that of the stated ones.

    Every evaluation is `draws` runs under the stated condition and counts as so many of the budget; the stated
    parameters are the first, so that tuning cannot make a controller worse. Raises InputError for unknown names.
    """
    budget, condition = contest.tuning, contest.conditions[contest.tuning.condition]
    if name not in scenario.controllers or name not in budget.ranges:
        raise InputError("", f"tuning.ranges.{name}", "is no controller with ranges: name one of "
                         f"{', '.join(n for n in budget.ranges if n in scenario.controllers)}")
    ranges = budget.ranges[name]
    for key in ranges:
        if key not in tunable(scenario, name):
            raise InputError("", f"tuning.ranges.{name}.{key}", "is no parameter of this controller: remove it")
    goal = budget.objective if follows_curve(scenario, name) else budget.without_curve
    if goal is None:
        raise InputError("", "tuning.without_curve", f"is missing: state what '{name}', which follows no curve, is "
                         "tuned for")
    draws = budget.draws if condition.random else 1

    def cost(parameters: dict[str, float]) -> float:
        changed = with_parameters(scenario, name, parameters)
        total = 0.0
        for draw in range(draws):
            run = run_match(changed, name, condition, DRAWS_FROM + draw, budget.seed)
            total += objective(match_values(run, changed), goal, condition.acting(scenario) is not None) / draws
        return total

    return search(cost, tunable(scenario, name), ranges, budget.runs // draws, budget.seed,
                  3 * goal.failed)


def tune_all(contest: Contest, scenario: Scenario, names: list[str], workers: int,
             on_progress: Callable[[int, int, str], None]) -> dict[str, Tuned]:
    """`tune` of several controllers in parallel processes, in the order of the names."""
    return results_of(_tune_task, (contest, scenario), names, workers,
                      lambda done, name, _: on_progress(done, len(names), name))


def _tune_task(shared: tuple[Contest, Scenario], name: str) -> Tuned:
    return tune(*shared, name)
