"""Sobol' indices of a function of several numbers: how much of its variance each decides, alone and with the others."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Index:
    """A share of the variance, with its 95 % bootstrap interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Indices:
    """first: by a number alone; total: with all that it does together with others; both in the order of the numbers.

    None each where the function does not vary.
    """

    first: tuple[Index, ...] | None
    total: tuple[Index, ...] | None


def design(count: int, samples: int, seed: int) -> Array:
    """Points of the unit cube at which the function is needed, shape (samples (count + 2), count).

    First two samples A and B of a scrambled Sobol' sequence, then for each number A with this number taken from B
    (Saltelli 2010).
    """
    from scipy.stats import qmc  # noqa: PLC0415 - takes a second

    both = qmc.Sobol(2 * count, scramble=True, rng=np.random.default_rng(seed)).random(samples)
    a, b = both[:, :count], both[:, count:]
    mixed = []
    for i in range(count):
        one = a.copy()
        one[:, i] = b[:, i]
        mixed.append(one)
    return np.vstack([a, b, *mixed])


def indices(values: Array, count: int, seed: int, resamples: int) -> Indices:
    """First and total indices from the function's values at the points of `design`, by scipy.stats.sobol_indices."""
    from scipy.stats import sobol_indices  # noqa: PLC0415 - takes a second

    samples = len(values) // (count + 2)
    rows = values.reshape(count + 2, samples)
    if float(np.ptp(rows[:2])) == 0.0:
        return Indices(None, None)
    if count == 1:
        return Indices((Index(1.0, 1.0, 1.0),), (Index(1.0, 1.0, 1.0),))
    found = sobol_indices(func={"f_A": rows[:1], "f_B": rows[1:2], "f_AB": rows[2:, None, :]}, n=samples,
                          rng=np.random.default_rng(seed))
    with warnings.catch_warnings(), np.errstate(all="ignore"):  # a number that does nothing has an index of no width
        warnings.simplefilter("ignore")
        sure = found.bootstrap(confidence_level=CONFIDENCE, n_resamples=resamples)

    def of(shares: Array, interval: object) -> tuple[Index, ...]:
        low, high = (np.where(np.isfinite(end), end, np.ravel(shares)) for end in (
            np.ravel(getattr(interval, name)) for name in ("low", "high")))
        return tuple(Index(*map(float, row)) for row in zip(np.ravel(shares), low, high, strict=True))

    return Indices(of(found.first_order, sure.first_order.confidence_interval),
                   of(found.total_order, sure.total_order.confidence_interval))
