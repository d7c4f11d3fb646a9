"""Paired bootstrap: which differences between controllers are more than chance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Interval:
    """A mean with its bootstrap interval."""

    mean: float
    low: float
    high: float


def resampled(draws: int, resamples: int, seed: int) -> NDArray[np.intp]:
    """Indices of the draws with replacement, shape (resamples, draws): the same for every metric and controller."""
    return np.random.default_rng(seed).integers(0, draws, (resamples, draws))


def _fitting(chosen: NDArray[np.intp], draws: int) -> NDArray[np.intp]:
    """The resampling, or one of the first draws where there are fewer."""
    return chosen if chosen.shape[1] == draws else resampled(draws, len(chosen), draws)


def mean_interval(values: Array, chosen: NDArray[np.intp], confidence: float) -> Interval:
    """The mean over the draws and its percentile interval; one draw has no width."""
    means = values[_fitting(chosen, len(values))].mean(axis=1)
    low, high = np.quantile(means, [(1 - confidence) / 2, (1 + confidence) / 2])
    return Interval(float(values.mean()), float(low), float(high))


def winners(values: Sequence[Array | None], chosen: NDArray[np.intp], confidence: float, alike: float = 0.0
            ) -> list[int]:
    """Numbers of the controllers that are not worse than the best by more than chance; the best alone has won.

    values: per controller its metric by draw, the less the better, or None where a run failed: such a controller
    neither wins nor ties. Of two with unlike numbers of draws the first ones of both are compared. A difference counts
    when the interval of the paired difference leaves out zero and the means differ by more than the share `alike`.
    """
    able = [i for i, value in enumerate(values) if value is not None]
    if not able:
        return []
    means = {i: float(np.mean(values[i])) for i in able}  # type: ignore[arg-type]
    best = min(able, key=lambda i: means[i])
    reference = values[best]
    assert reference is not None
    tied = []
    for i in able:
        value = values[i]
        assert value is not None
        both = min(len(value), len(reference))
        difference = mean_interval(value[:both] - reference[:both], chosen, confidence)
        if i == best or not difference.low > 0 or means[i] - means[best] <= alike * abs(means[best]):
            tied.append(i)
    return tied


def overtakes(trials: NDArray[np.float64], rival: NDArray[np.float64], resamples: int, seed: int,
              confidence: float, first_trial: int = 1) -> int | None:
    """The first trip from which on a learner's error is below a rival's by more than chance, else None.

    trials: of the learner, shape (draws, trips); rival: by draw, of which the first ones are compared; first_trial: the
    number of the first trip.
    """
    draws = min(len(trials), len(rival))
    chosen, found = resampled(draws, resamples, seed), None
    for trip in range(trials.shape[1] - 1, -1, -1):
        if not mean_interval(trials[:draws, trip] - rival[:draws], chosen, confidence).high < 0:
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
