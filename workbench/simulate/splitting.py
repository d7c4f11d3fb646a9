"""Adaptive multilevel splitting: the probability of what random draws hardly ever show.

Of the points drawn the least bad ones are dropped, and as many copies of the others take their places, each moved by
a Markov chain that stays above the level that was dropped; again, until the level has reached the value
asked for. The product of the shares that were left has the probability as its mean, however few points there are and
however the chains move (Cerou and Guyader 2007; unbiased: Brehier, Gazeau, Goudenege, Lelievre and Rousset 2016).
Subset simulation (Au and Beck 2001) is the same with correlated chains, and is biased: by half of 3e-7 with 500 points.

The randomness must be drawn at the start, as the train of a run is: then how bad a run is depends on the point drawn
alone. What is drawn anew within a run would need splitting in time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# Points of shape (n, dimensions) in [-1, 1] -> how bad each is, shape (n,); inf where nothing is worse.
Performance = Callable[[Array], Array]

# The share that is dropped at each level.
DROPPED = 0.75
# So often an interval is narrowed before its point is left where it is: rounding alone comes so far.
NARROWED = 60
# Of an interval's probability, left out at each end.
TAIL = 0.025
# So deep is searched for an event that no point has met.
LEAST = 1e-9


@dataclass(frozen=True)
class Estimate:
    """One estimate. runs: how often the performance was asked for; counted: no level was raised, so that the
    probability is the share of independent draws."""

    probability: float
    runs: int
    counted: bool = False


def splitting(performance: Performance, dimensions: int, beyond: float, samples: int,
              generator: np.random.Generator, least: float = LEAST, near: bool = False) -> Estimate:
    """The probability that the performance of a point drawn evenly from [-1, 1]^dimensions is above a value.

    least: the share of all points that is searched at last; with 1 points are drawn and counted, no more. near: moves
    begin near the points that are left, which takes a few runs where others take dozens, and is biased: for a search
    that only has to find whether there is anything.
    """
    points = generator.uniform(-1.0, 1.0, (samples, dimensions))
    values, runs, weight = performance(points), samples, 1.0
    while weight > least:
        level = float(np.partition(values, round(samples * DROPPED) - 1)[round(samples * DROPPED) - 1])
        if level >= beyond:
            break
        left = np.flatnonzero(values > level)
        if not len(left):
            break
        weight *= len(left) / samples
        gone = np.flatnonzero(values <= level)
        chosen = generator.choice(left, len(gone))
        low, high = _around(points[left]) if near else (np.full(dimensions, -1.0), np.full(dimensions, 1.0))
        points[gone], values[gone], tried = _moved(performance, level, points[chosen], values[chosen], low, high,
                                                   generator)
        runs += tried
    return Estimate(weight * float(np.mean(values > beyond)), runs, weight == 1.0)


def _around(points: Array) -> tuple[Array, Array]:
    """In each coordinate the span of some points, and as much on both sides of it."""
    low, high = points.min(axis=0), points.max(axis=0)
    return np.maximum(-1.0, 2 * low - high), np.minimum(1.0, 2 * high - low)


def _moved(performance: Performance, level: float, points: Array, values: Array, least: Array, most: Array,
           generator: np.random.Generator) -> tuple[Array, Array, int]:
    """The points after a move along each coordinate, in an order by chance, their values, and the runs that it took.

    A coordinate is drawn evenly from an interval, which begins as least to most, and is cut at each draw that is not
    above the level, towards the point (slice sampling, Neal 2003): so moves become as short as what is above the level
    is thin, in each coordinate by itself, and the even distribution above the level stays what it is.
    """
    points, values, runs = points.copy(), values.copy(), 0
    orders = generator.permuted(np.tile(np.arange(points.shape[1]), (len(points), 1)), axis=1)
    for axes in orders.T:
        low, high, moving = least[axes], most[axes], np.arange(len(points))
        for _ in range(NARROWED):
            axis, tried = axes[moving], points[moving]
            here, drawn = points[moving, axis], generator.uniform(low[moving], high[moving])
            tried[np.arange(len(moving)), axis] = drawn
            there = performance(tried)
            runs += len(moving)
            allowed = there > level
            points[moving[allowed]], values[moving[allowed]] = tried[allowed], there[allowed]
            above, below = ~allowed & (drawn > here), ~allowed & (drawn <= here)
            high[moving[above]], low[moving[below]] = drawn[above], drawn[below]
            moving = moving[~allowed]
            if not len(moving):
                break
    return points, values, runs


@dataclass(frozen=True)
class Probability:
    """The mean of independent estimates with a 95 % interval.

    Estimates of rare events are products of many shares, so that their logarithms are about normal: the interval is
    that of a log-normal mean, by the method of variance estimates recovery (Zou, Huo and Taleban 2009). Where some
    estimates are 0 it is that of a weighted sum of Poisson counts (Fay and Feuer 1997), and of what was only counted
    the exact one of Clopper and Pearson.
    """

    mean: float
    low: float
    high: float

    @classmethod
    def of(cls, estimates: Sequence[Estimate], samples: int) -> Probability:
        """Of at least two estimates with so many points each."""
        found = np.array([one.probability for one in estimates])
        mean = float(np.mean(found))
        if not mean or all(one.counted for one in estimates):
            draws = samples * len(estimates)
            low, high = _counted(round(mean * draws), draws)
        elif np.all(found > 0.0):
            low, high = _log_normal(np.log(found))
        else:
            low, high = _weighted(found / len(found))
        return cls(mean, min(low, mean), min(1.0, max(high, mean)))


def _log_normal(logarithms: Array) -> tuple[float, float]:
    """The interval of the mean of what has these logarithms: of their mean (by Student's t, for there are few) and of
    half their variance, each with the interval of its own, of which the distances are added in squares."""
    from scipy.special import chdtri, stdtrit  # noqa: PLC0415 - only who asks for rare events needs it

    count, half = len(logarithms), float(np.var(logarithms, ddof=1)) / 2
    middle = float(np.mean(logarithms)) + half
    of_mean = float(stdtrit(count - 1, 1 - TAIL)) ** 2 * 2 * half / count
    least, most = (half * (count - 1) / float(chdtri(count - 1, tail)) for tail in (TAIL, 1 - TAIL))
    return (math.exp(middle - math.sqrt(of_mean + (half - least) ** 2)),
            math.exp(middle + math.sqrt(of_mean + (most - half) ** 2)))


def _weighted(parts: Array) -> tuple[float, float]:
    """The interval of a sum of Poisson counts of which each has a weight of its own: 0, or what it has added."""
    total, squares, largest = float(np.sum(parts)), float(np.sum(parts**2)), float(np.max(parts))
    more, spread = total + largest, squares + largest**2
    return (squares / (2 * total) * _chi_square(TAIL, 2 * total**2 / squares),
            spread / (2 * more) * _chi_square(1 - TAIL, 2 * more**2 / spread))


def _chi_square(share: float, freedom: float) -> float:
    from scipy.special import chdtri  # noqa: PLC0415 - as above

    return float(chdtri(freedom, 1 - share))


def _counted(met: int, draws: int) -> tuple[float, float]:
    """The interval of a share of independent draws; one-sided where all or none have met the event."""
    from scipy.special import betaincinv  # noqa: PLC0415 - as above

    one_sided = (2 * TAIL) ** (1 / draws)
    low = 0.0 if not met else one_sided if met == draws else float(betaincinv(met, draws - met + 1, TAIL))
    high = 1.0 if met == draws else 1 - one_sided if not met else float(betaincinv(met + 1, draws - met, 1 - TAIL))
    return low, high
