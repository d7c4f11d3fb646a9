"""When a Monte Carlo has drawn enough: the intervals of a metric's mean are as narrow as was asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Self

from workbench.errors import InputError
from workbench.simulate.metric_option import metric_and_number
from workbench.simulate.sweep_rows import NUMBERS, Values, numbers

# The intervals are looked at after these runs, and then after twice as many each time: at numbers of runs that
# depend on nothing, so that the same draws are made wherever they are run.
FIRST_LOOK, GROWTH = 64, 2
CONFIDENCE = 0.95


@dataclass(frozen=True)
class UntilWidth:
    """Draw until the interval of every controller's mean of a metric is no wider than `width`, in the metric's unit."""

    metric: str
    width: float

    @classmethod
    def parse(cls, text: str) -> Self:
        """METRIC=WIDTH as it is typed; InputError for a metric that is none, and a width that is not positive."""
        metric, value = metric_and_number("--until-width", text, "=", NUMBERS, "METRIC=WIDTH")
        if not 0 < value < math.inf:
            raise InputError("", "--until-width", f"'{text.partition('=')[2][:60]}' is no positive number: give a "
                             f"width in the unit of {metric}")
        return cls(metric, value)


@dataclass
class Mean:
    """Mean and sum of squares of a metric, added block by block (Chan, Golub and LeVeque 1979)."""

    count: int = 0
    mean: float = 0.0
    squares: float = 0.0

    def add(self, values: Sequence[float]) -> None:
        """Add more values."""
        if not values:
            return
        count, mean = len(values), math.fsum(values) / len(values)
        squares = math.fsum((value - mean) ** 2 for value in values)
        total, apart = self.count + count, mean - self.mean
        self.squares += squares + apart**2 * self.count * count / total
        self.mean += apart * count / total
        self.count = total

    @property
    def width(self) -> float:
        """Of the interval of the mean by Student's t; inf where there is none."""
        if self.count < 2:
            return math.inf
        from scipy.special import stdtrit  # noqa: PLC0415 - only a sweep that stops by it needs it

        quantile = float(stdtrit(self.count - 1, (1 + CONFIDENCE) / 2))
        return 2 * quantile * math.sqrt(self.squares / (self.count - 1) / self.count)


def looks(runs: int, until: UntilWidth | None) -> Iterator[int]:
    """After how many runs the intervals are looked at, at the latest after all."""
    look = FIRST_LOOK
    while until and look < runs:
        yield look
        look *= GROWTH
    yield runs


def metric_of(rows: Sequence[Values], until: UntilWidth) -> list[float]:
    """The metric of the runs that did not fail."""
    return numbers(rows, until.metric)
