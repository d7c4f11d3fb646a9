"""Adaptive multilevel splitting: the probability of what random draws hardly ever show.

Of the points drawn the least bad ones are dropped, and as many copies of the others take their places, each moved by
some steps of a Markov chain that stays above the level that was dropped; again, until the level has reached the value
asked for. The product of the shares that were left has the probability as its mean, however few points there are and
however the chains move (Cerou and Guyader 2007; unbiased: Brehier, Gazeau, Goudenege, Lelievre and Rousset 2016).
Subset simulation (Au and Beck 2001) is the same with correlated chains, and is biased: by half of 3e-7 with 500 points.

The randomness must be drawn at the start, as the train of a run is: then how bad a run is depends on the point drawn
alone. What is drawn anew within a run would need splitting in time.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# Points of shape (n, dimensions) in [-1, 1] -> how bad each is, shape (n,); inf where nothing is worse.
Performance = Callable[[Array], Array]

# The share that is dropped at each level, and the steps by which copies move away from what they were copied from.
DROPPED, MOVES = 0.75, 8
# Lengths of steps are drawn between these, evenly in their logarithm. They depend on nothing: steps as long as the
# points that are left lie apart would accept more, and would bring back a bias, of a tenth at 3e-7.
LONGEST, SHORTEST = 1.0, 0.03
# So deep is searched for an event that no point has met.
LEAST = 1e-9


@dataclass(frozen=True)
class Estimate:
    """One estimate. runs: how often the performance was asked for."""

    probability: float
    runs: int


def splitting(performance: Performance, dimensions: int, beyond: float, samples: int,
              generator: np.random.Generator, least: float = LEAST) -> Estimate:
    """The probability that the performance of a point drawn evenly from [-1, 1]^dimensions is above a value.

    least: the share of all points that is searched at last; with 1 points are drawn and counted, no more.
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
        moving, worth = points[chosen], values[chosen]
        for _ in range(MOVES):
            step = LONGEST * (SHORTEST / LONGEST) ** generator.uniform(0.0, 1.0, (len(gone), 1))
            tried = _reflected(moving + step * generator.uniform(-1.0, 1.0, moving.shape))
            there = performance(tried)
            allowed = there > level
            moving, worth = np.where(allowed[:, None], tried, moving), np.where(allowed, there, worth)
            runs += len(gone)
        points[gone], values[gone] = moving, worth
    return Estimate(weight * float(np.mean(values > beyond)), runs)


def _reflected(points: Array) -> Array:
    """Points beyond [-1, 1] mirrored at its ends, which leaves an even distribution what it is."""
    turned = np.mod(points + 1.0, 4.0)
    return np.where(turned > 2.0, 4.0 - turned, turned) - 1.0


@dataclass(frozen=True)
class Probability:
    """The mean of independent estimates with a 95 % interval by Student's t over them, not below 0."""

    mean: float
    low: float
    high: float

    @classmethod
    def of(cls, estimates: Array) -> Probability:
        """Of at least two estimates."""
        from scipy.special import stdtrit  # noqa: PLC0415 - only who asks for rare events needs it

        count, mean = len(estimates), float(np.mean(estimates))
        half = float(stdtrit(count - 1, 0.975)) * float(np.std(estimates, ddof=1)) / math.sqrt(count)
        return cls(mean, max(0.0, mean - half), mean + half)
