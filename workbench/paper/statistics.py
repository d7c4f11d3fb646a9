"""Paired bootstrap: which differences between controllers are more than chance, also where many are looked at."""

from __future__ import annotations

import math
import warnings
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Key = TypeVar("Key", bound=Hashable)

# So many resamples for each one that the smallest probability asked for would need.
RESAMPLES_A_TAIL = 4
BATCH = 4096
ROUNDING = 1e-9


@dataclass(frozen=True)
class Interval:
    """A mean with its interval; p: how probable so large a mean is where the true one is zero, two-sided."""

    mean: float
    low: float
    high: float
    p: float = 1.0


@dataclass(frozen=True)
class Bootstrap:
    """How intervals are made: so many resamples, from a seed, which every metric and controller shares."""

    resamples: int
    seed: int
    confidence: float

    def for_comparisons(self, count: int) -> Bootstrap:
        """With enough resamples to tell the probabilities that so many comparisons need."""
        least = math.ceil(RESAMPLES_A_TAIL * count / (1 - self.confidence))
        return replace(self, resamples=max(self.resamples, least))

    def tells(self, found: Interval, less: bool = False) -> bool:
        """Whether a mean difference is more than chance; less: and below zero."""
        return found.p <= 1 - self.confidence and not (less and found.mean >= 0)


def mean_interval(values: Array, how: Bootstrap) -> Interval:
    """The mean over the draws with its BCa interval (Efron 1987, by scipy), and the p at which it meets zero.

    One draw, and draws that are all alike, have no width.
    """
    mean = float(values.mean())
    if _constant(values):
        return Interval(mean, mean, mean, _exact(values, how))
    from scipy.stats import bootstrap  # noqa: PLC0415 - takes a second, which only a table with draws has to spare

    with warnings.catch_warnings():  # of draws that differ in their last bits alone it says that they are degenerate
        warnings.simplefilter("ignore")
        found = bootstrap((values,), np.mean, n_resamples=how.resamples, confidence_level=how.confidence, method="BCa",
                          axis=-1, vectorized=True, rng=np.random.default_rng(how.seed))
    means = found.bootstrap_distribution
    low, high = found.confidence_interval
    if not (math.isfinite(low) and math.isfinite(high)):
        low, high = np.quantile(means, [(1 - how.confidence) / 2, (1 + how.confidence) / 2])
    return Interval(mean, float(low), float(high), _level(values, _below(means, 0.0), _below(means, mean), len(means)))


def _constant(values: Array) -> bool:
    """Whether draws are all alike: what differs in its last digits has the skewness of rounding."""
    return float(np.ptp(values)) <= ROUNDING * float(np.abs(values).max())


def _below(means: Array, limit: float | Array) -> Any:
    """Share of the resampled means below a limit, those at it by half."""
    return ((means < limit).mean(axis=0) + (means <= limit).mean(axis=0)) / 2


def _exact(values: Array, how: Bootstrap) -> float:
    """p of draws that are all alike; a single one is an exact number, where nothing was drawn."""
    count = len(values)
    return 1.0 if not values[0] else 0.0 if count == 1 else max(2.0 ** (1 - count), 1 / (how.resamples + 1))


def _level(values: Array, below_zero: float, below_mean: float, resamples: int) -> float:
    """The level at which the BCa interval ends at zero: its formulas, solved for the level.

    No smaller than that of a sign test, 2^(1-n), below which n draws say nothing, whatever they are.
    """
    from scipy.special import ndtr, ndtri  # noqa: PLC0415 - as above

    off = values - values.mean()
    floor = max(2.0 ** (1 - len(values)), 1 / (resamples + 1))
    skew = float(np.sum(off**3) / (6 * np.sum(off**2) ** 1.5))
    within = 0.5 / (resamples + 1)  # a share that resamples did not meet is no zero
    bias, at = (float(ndtri(min(max(share, within), 1 - within))) for share in (below_mean, below_zero))
    if 1 + skew * (at - bias) <= 0:
        return floor
    level = float(ndtr((at - bias) / (1 + skew * (at - bias)) - bias))
    return min(1.0, max(2 * min(level, 1 - level), floor))


def p_values(rows: Sequence[Array], how: Bootstrap) -> list[float]:
    """The p of `mean_interval` of many rows of draws, by resamples that rows of the same length share."""
    found = [_exact(row, how) for row in rows]
    lengths = {len(row) for row in rows if not _constant(row)}
    for count in sorted(lengths):
        numbers = [i for i, row in enumerate(rows) if len(row) == count and not _constant(row)]
        columns = np.array([rows[i] for i in numbers]).T
        means, generator = columns.mean(axis=0), np.random.default_rng(how.seed)
        below = np.zeros((2, len(numbers)))
        for start in range(0, how.resamples, BATCH):
            size = min(BATCH, how.resamples - start)
            resampled = generator.multinomial(count, np.full(count, 1 / count), size) @ columns / count
            below += size * np.array([_below(resampled, 0.0), _below(resampled, means)])
        below /= how.resamples
        for place, i in enumerate(numbers):
            found[i] = _level(rows[i], below[0, place], below[1, place], how.resamples)
    return found


def holm(p: Sequence[float]) -> list[float]:
    """Holm's adjusted probabilities (1979), in the order given: at most a level where the step-down test rejects."""
    found, largest = [0.0] * len(p), 0.0
    for rank, i in enumerate(sorted(range(len(p)), key=lambda i: p[i])):
        largest = max(largest, min(1.0, (len(p) - rank) * p[i]))
        found[i] = largest
    return found


@dataclass(frozen=True)
class Ranking:
    """Who is not worse than the best by more than chance, by number, the best first; separated: whether everyone else
    who could be ranked is."""

    winners: tuple[int, ...]
    ranked: int

    @property
    def separated(self) -> bool:
        """Whether one alone is best, or there is nobody to be."""
        return len(self.winners) <= 1


def rankings(tables: Mapping[Key, Sequence[Array | None]], how: Bootstrap, alike: float = 0.0) -> dict[Key, Ranking]:
    """Who is best in each table, told apart by Holm's correction over all tables.

    tables: key -> per controller its metric by draw, the less the better, or None where a run failed: such a controller
    neither wins nor ties. Of two with unlike numbers of draws the first ones of both are compared. Everyone is held
    against the best by its paired differences; each controller's differences, over all tables, are one family. A
    difference counts where its adjusted p is at most 1 - confidence and the means differ by more than the share
    `alike`; of a single draw, where nothing is chance, by the latter alone.
    """
    best: dict[Key, int] = {}
    pairs: dict[int, list[tuple[Key, Array]]] = {}
    for key, values in tables.items():
        means = {i: float(np.mean(value)) for i, value in enumerate(values) if value is not None}
        if not means:
            continue
        best[key] = min(means, key=lambda i, means=means: means[i])  # type: ignore[misc]
        reference = values[best[key]]
        for i in means:
            value = values[i]
            if value is not None and reference is not None and i != best[key]:
                both = min(len(value), len(reference))
                pairs.setdefault(i, []).append((key, value[:both] - reference[:both]))
    how = how.for_comparisons(max((len(rows) for rows in pairs.values()), default=1))
    every = [(i, key, row) for i, rows in pairs.items() for key, row in rows]
    p = dict(zip(((i, key) for i, key, _ in every), p_values([row for _, _, row in every], how), strict=True))
    tied: dict[Key, list[int]] = {key: [] for key in tables}
    for i, rows in pairs.items():
        drawn = [key for key, row in rows if len(row) > 1]
        chance = dict(zip(drawn, holm([p[i, key] for key in drawn]), strict=True))
        for key, row in rows:
            reference = tables[key][best[key]]
            assert reference is not None
            near = float(row.mean()) <= alike * abs(float(np.mean(reference)))
            if near or chance.get(key, 0.0) > 1 - how.confidence:
                tied[key].append(i)
    return {key: Ranking((best[key], *sorted(tied[key])) if key in best else (),
                         sum(value is not None for value in tables[key])) for key in tables}


def overtakes(trials: NDArray[np.float64], rival: NDArray[np.float64], resamples: int, seed: int,
              confidence: float, first_trial: int = 1) -> int | None:
    """The first trip from which on a learner's error is below a rival's by more than chance, else None.

    trials: of the learner, shape (draws, trips); rival: by draw, of which the first ones are compared; first_trial: the
    number of the first trip.
    """
    draws, found = min(len(trials), len(rival)), None
    sure = Bootstrap(resamples, seed, confidence)
    for trip in range(trials.shape[1] - 1, -1, -1):
        if not sure.tells(mean_interval(trials[:draws, trip] - rival[:draws], sure), less=True):
            break
        found = first_trial + trip
    return found


def ahead_from(errors: Array, rival: float, first_trial: int = 1) -> int | None:
    """The trial from which on all errors of a learner are below a rival's, None where there is none.

    first_trial: the number of the first one.
    """
    above = np.nonzero(errors >= rival)[0]
    ahead = int(above[-1]) + 1 if len(above) else 0
    return first_trial + ahead if ahead < len(errors) else None
