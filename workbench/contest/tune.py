"""The same budget for every controller: one optimiser, one seed, so many runs."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import minimize
from scipy.stats import qmc

from workbench.contest.matches import match_values, run_match, tunable, with_parameters
from workbench.contest.record import Contest, Objective
from workbench.errors import InputError
from workbench.scenario import Scenario
from workbench.workers import run_tasks

# Draws of the search lie far from those of the contest, so that no controller is judged by what it was tuned on.
DRAWS_FROM = 1_000_000
# Share of the budget for points spread over all ranges; the rest goes on from the best of them by Nelder and Mead.
SPREAD_SHARE = 0.5


class _SpentError(Exception):
    """The budget is used up."""


def objective(values: dict[str, float | None], goal: Objective) -> float:
    """The cost of one run."""
    parts = ((values["position_rms"], goal.position_m), (values["speed_rms"], goal.speed_mps),
             (values["jerk_rms"], goal.jerk_mps3))
    return sum(goal.failed if value is None else min(value / unit, goal.failed) for value, unit in parts)


def tune(contest: Contest, scenario: Scenario, name: str) -> tuple[dict[str, float], float, float]:
    """The best parameters found for a controller, their cost, and that of the stated ones.

    Every evaluation is `draws` runs under the stated condition and counts as so many of the budget; the stated
    parameters are the first, so that tuning cannot make a controller worse. Raises InputError for unknown names.
    """
    budget, condition = contest.tuning, contest.conditions[contest.tuning.condition]
    if name not in scenario.controllers or name not in budget.ranges:
        raise InputError("", f"tuning.ranges.{name}", "is no controller with ranges: name one of "
                         f"{', '.join(n for n in budget.ranges if n in scenario.controllers)}")
    ranges = budget.ranges[name]
    keys = list(ranges)
    for key in keys:
        if key not in tunable(scenario, name):
            raise InputError("", f"tuning.ranges.{name}.{key}", "is no parameter of this controller: remove it")
    low, high = (np.log([ranges[key][end] for key in keys]) for end in (0, 1))
    draws = budget.draws if condition.random else 1
    left = budget.runs // draws
    best: tuple[float, np.ndarray | None] = (math.inf, None)

    def cost(point: np.ndarray) -> float:
        nonlocal left, best
        if left == 0:
            raise _SpentError
        left -= 1
        if np.any(point < low) or np.any(point > high):
            outside = float(np.sum(np.maximum(low - point, 0) + np.maximum(point - high, 0)))
            return 3 * budget.objective.failed * (1 + outside)
        changed = with_parameters(scenario, name, dict(zip(keys, np.exp(point).tolist(), strict=True)))
        total = 0.0
        for draw in range(draws):
            run = run_match(changed, name, condition, DRAWS_FROM + draw, budget.seed)
            total += objective(match_values(run, changed), budget.objective) / draws
        if total < best[0]:
            best = total, point.copy()
        return total

    stated = np.log([tunable(scenario, name)[key] for key in keys])
    first = cost(np.clip(stated, low, high))
    points = qmc.Sobol(len(keys), scramble=True, rng=np.random.default_rng(budget.seed))
    count = int(SPREAD_SHARE * left)
    try:
        for point in low + points.random(2 ** max(0, math.ceil(math.log2(max(1, count)))))[:count] * (high - low):
            cost(point)
        while left:
            assert best[1] is not None
            minimize(cost, best[1], method="Nelder-Mead",
                     options={"initial_simplex": _simplex(best[1], low, high), "xatol": 1e-3, "fatol": 1e-4})
    except _SpentError:
        pass
    assert best[1] is not None
    found = {key: float(f"{value:.4g}") for key, value in zip(keys, np.exp(best[1]).tolist(), strict=True)}
    return found, best[0], first


def _simplex(point: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """A tenth of each range away from a point, inwards."""
    step = np.where(point + 0.1 * (high - low) <= high, 0.1, -0.1) * (high - low)
    return np.vstack([point, point + np.diag(step)])


def tune_all(contest: Contest, scenario: Scenario, names: list[str], workers: int,
             on_progress: Callable[[int, int, str], None]) -> dict[str, tuple[dict[str, float], float, float]]:
    """`tune` of several controllers in parallel processes, in the order of the names."""
    found: dict[str, tuple[dict[str, float], float, float]] = {}

    def record(result: tuple[str, tuple[dict[str, float], float, float]]) -> None:
        found[result[0]] = result[1]
        on_progress(len(found), len(names), result[0])

    run_tasks(_tune_task, (contest, scenario), names, workers, record)
    return {name: found[name] for name in names}


def _tune_task(shared: tuple[Contest, Scenario], name: str) -> tuple[str, tuple[dict[str, float], float, float]]:
    return name, tune(*shared, name)
