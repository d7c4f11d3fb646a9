"""One optimiser for everything that is tuned: points spread over all ranges, then on from the best of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from scipy.optimize import minimize
from scipy.stats import qmc

# Share of the budget for points spread over all ranges; the rest goes on from the best of them by Nelder and Mead.
SPREAD_SHARE = 0.5

# Parameters found, their cost, that of the stated ones.
Tuned = tuple[dict[str, float], float, float]


class _SpentError(Exception):
    """The budget is used up."""


def score(values: Mapping[str, float | None], units: Mapping[str, float], failed: float) -> float:
    """The sum of each metric over its unit, each at most `failed`; what a run does not have costs as much."""
    return sum(failed if (value := values[name]) is None else min(value / unit, failed)
               for name, unit in units.items())


def search(cost: Callable[[dict[str, float]], float], stated: Mapping[str, float],
           ranges: Mapping[str, tuple[float, float]], evaluations: int, seed: int, outside: float) -> Tuned:
    """The best parameters within their ranges, searched on a logarithmic scale.

    The stated ones (at the nearest end where they lie outside) are the first to be evaluated, so that tuning cannot
    make anything worse. A point that is tried outside the ranges counts as an evaluation and costs at least `outside`.
    """
    keys = list(ranges)
    low, high = (np.log([ranges[key][end] for key in keys]) for end in (0, 1))
    left = evaluations
    best: tuple[float, np.ndarray | None] = (math.inf, None)

    def tried(point: np.ndarray) -> float:
        nonlocal left, best
        if left == 0:
            raise _SpentError
        left -= 1
        if np.any(point < low) or np.any(point > high):
            beyond = float(np.sum(np.maximum(low - point, 0) + np.maximum(point - high, 0)))
            return outside * (1 + beyond)
        found = cost(dict(zip(keys, np.exp(point).tolist(), strict=True)))
        if found < best[0]:
            best = found, point.copy()
        return found

    with np.errstate(divide="ignore"):  # a stated 0 is below every range
        first = np.clip(np.log([stated[key] for key in keys]), low, high)
    first_cost = tried(first)
    points = qmc.Sobol(len(keys), scramble=True, rng=np.random.default_rng(seed))
    count = int(SPREAD_SHARE * left)
    try:
        for point in low + points.random(2 ** max(0, math.ceil(math.log2(max(1, count)))))[:count] * (high - low):
            tried(point)
        while left:
            assert best[1] is not None
            minimize(tried, best[1], method="Nelder-Mead",
                     options={"initial_simplex": _simplex(best[1], low, high), "xatol": 1e-3, "fatol": 1e-4})
    except _SpentError:
        pass
    assert best[1] is not None
    found = {key: float(f"{value:.4g}") for key, value in zip(keys, np.exp(best[1]).tolist(), strict=True)}
    return found, best[0], first_cost


def _simplex(point: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """A tenth of each range away from a point, inwards."""
    step = np.where(point + 0.1 * (high - low) <= high, 0.1, -0.1) * (high - low)
    return np.vstack([point, point + np.diag(step)])
