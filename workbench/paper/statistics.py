"""Paired differences: intervals by bootstrap, and which of them are more than chance, also where many are looked at.

Intervals are BCa. What is said to be more than chance is decided by sign flips (Fisher's randomisation test): under
chance alone each draw's difference might as well have had the other sign. Their p is exact for any number of draws,
while a bootstrap's is too small for few draws, by a factor of ten and more where Holm's correction asks for 1e-4.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

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
    """A mean with its interval; p: how probable so large a mean is by chance, two-sided, by `p_values`."""

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


def mean_interval(values: Array, how: Bootstrap) -> Interval:
    """The mean over the draws with its BCa interval (Efron 1987, by scipy), and its p.

    One draw, and draws that are all alike, have no width.
    """
    mean, p = float(values.mean()), p_values([values], how)[0]
    if _constant(values):
        return Interval(mean, mean, mean, p)
    from scipy.stats import bootstrap  # noqa: PLC0415 - takes a second, which only a table with draws has to spare

    with warnings.catch_warnings():  # of draws that differ in their last bits alone it says that they are degenerate
        warnings.simplefilter("ignore")
        found = bootstrap((values,), np.mean, n_resamples=how.resamples, confidence_level=how.confidence, method="BCa",
                          axis=-1, vectorized=True, rng=np.random.default_rng(how.seed))
    low, high = found.confidence_interval
    if not (math.isfinite(low) and math.isfinite(high)):
        low, high = np.quantile(found.bootstrap_distribution, [(1 - how.confidence) / 2, (1 + how.confidence) / 2])
    return Interval(mean, float(low), float(high), p)


def _constant(values: Array) -> bool:
    """Whether draws are all alike: what differs in its last digits has the skewness of rounding."""
    return float(np.ptp(values)) <= ROUNDING * float(np.abs(values).max())


def _one_sided(values: Array) -> float | None:
    """p of draws that are nowhere of two signs, in closed form: no other choice of signs but the opposite gives so
    large a mean, whatever the signs of draws that are zero but for rounding. None of others. A single draw is an exact
    number, where nothing was drawn.
    """
    if values.min() < 0 < values.max():
        return None
    told = int((np.abs(values) > ROUNDING * np.abs(values).sum()).sum())
    return 1.0 if not told else 0.0 if len(values) == 1 else 2.0 ** (1 - told)


@lru_cache(maxsize=4)
def _signs(count: int, resamples: int, seed: int) -> NDArray[np.int8]:
    """Ways to choose the signs of so many draws, a row each: all that differ by more than all signs at once where they
    are no more than the resamples, else so many by chance."""
    if count - 1 <= math.log2(resamples):
        numbers = np.arange(2 ** (count - 1))[:, np.newaxis] >> np.arange(count)
        return (1 - 2 * (numbers & 1)).astype(np.int8)
    return np.random.default_rng(seed).choice(np.array([-1, 1], dtype=np.int8), (resamples, count))


def p_values(rows: Sequence[Array], how: Bootstrap) -> list[float]:
    """How probable so large a mean is of each row of draws if their signs are chance, two-sided; exact for few draws,
    and for draws of one sign.

    No smaller than 2^(1-n), below which n draws say nothing. Rows of the same length share their signs.
    """
    one_sided = [_one_sided(row) for row in rows]
    found = [1.0 if p is None else p for p in one_sided]
    for count in sorted({len(row) for row, p in zip(rows, one_sided, strict=True) if p is None}):
        numbers = [i for i, row in enumerate(rows) if len(row) == count and one_sided[i] is None]
        columns, signs = np.array([rows[i] for i in numbers]).T, _signs(count, how.resamples, how.seed)
        least = np.abs(columns.sum(axis=0)) - ROUNDING * np.abs(columns).sum(axis=0)
        met = np.zeros(len(numbers))
        for start in range(0, len(signs), BATCH):
            met += (np.abs(signs[start : start + BATCH] @ columns) >= least).sum(axis=0)
        share = met / len(signs) if len(signs) == 2 ** (count - 1) else (1 + met) / (len(signs) + 1)
        for i, p in zip(numbers, share.tolist(), strict=True):
            found[i] = max(p, 2.0 ** (1 - count))
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
    That one alone is best says that everyone else is worse, so its p is the largest of theirs, and these claims, one a
    table, are one family too: where theirs does not hold, the nearest other stays. So no claim that one is alone best
    is made by chance in more than 1 - confidence of all contests, however many take part; who of many is not told
    apart from the best is a looser word, since the best is chosen by the same draws.
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
    nearest = _nearest(every, p)
    alone = holm([1.0 if tied[key] else p[i, key] for key, i in nearest.items()])
    for (key, i), chance_of in zip(nearest.items(), alone, strict=True):
        if not tied[key] and chance_of > 1 - how.confidence:
            tied[key].append(i)
    return {key: Ranking((best[key], *sorted(tied[key])) if key in best else (),
                         sum(value is not None for value in tables[key])) for key in tables}


def _nearest(every: Sequence[tuple[int, Key, Array]], p: Mapping[tuple[int, Key], float]) -> dict[Key, int]:
    """By table the controller whose difference from the best is most probable by chance, of several draws."""
    found: dict[Key, int] = {}
    for i, key, row in every:
        if len(row) > 1 and (key not in found or p[i, key] > p[found[key], key]):
            found[key] = i
    return found


def overtakes(trials: NDArray[np.float64], rival: NDArray[np.float64], resamples: int, seed: int,
              confidence: float, first_trial: int = 1, comparisons: int = 1) -> int | None:
    """The first trip from which on a learner's error is below a rival's by more than chance, else None.

    trials: of the learner, shape (draws, trips); rival: by draw, of which the first ones are compared; first_trial: the
    number of the first trip; comparisons: how many such questions are asked together, which share 1 - confidence. Trips
    are asked from the last one back, and only while each is ahead, so that they need no correction of their own.
    """
    draws, found = min(len(trials), len(rival)), None
    how = Bootstrap(resamples, seed, confidence).for_comparisons(comparisons)
    differences = trials[:draws] - rival[:draws, np.newaxis]
    chance = p_values(list(differences.T), how)
    for trip in range(trials.shape[1] - 1, -1, -1):
        if comparisons * chance[trip] > 1 - confidence or differences[:, trip].mean() >= 0:
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
