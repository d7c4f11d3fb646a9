"""The rows of a Monte Carlo: what each says, the same as columns, as CSV, and what they come to."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, fields
from itertools import chain

import numpy as np

from workbench.simulate.metrics import Metrics
from workbench.simulate.setting import Factors

# Totals and means over a whole run: they say nothing when the run ended early.
WHOLE_RUN = ("position_rms", "speed_rms", "stopping_error", "energy_J", "jerk_rms", "jerk_p95",
             "jerk_max", "comfort_rms", "command_variation", "switchings", "overspeed_max",
             "saturated_fraction", "limit_violations")


@dataclass(frozen=True)
class SweepRow:
    """One run of one controller: the drawn factors and the metrics that do not depend on the machine's speed.

    SI units as in `Metrics`. A failed run keeps its extrema up to the failure; what only makes sense for a
    whole run is None. counters: the controller's own counts, e.g. "qp=300;qp_failed=0".
    """

    run: int
    controller: str
    factors: Factors
    position_error_min: float | None
    position_error_max: float | None
    speed_error_min: float | None
    speed_error_max: float | None
    position_rms: float | None
    speed_rms: float | None
    stopping_error: float | None
    energy_J: float | None
    jerk_rms: float | None
    jerk_p95: float | None
    jerk_max: float | None
    comfort_rms: float | None
    command_variation: float | None
    switchings: float | None
    overspeed_max: float | None
    saturated_fraction: float | None
    limit_violations: int | None
    command_max: float | None
    command_min: float | None
    speed_min: float | None
    time_of_max_position_error: float | None
    counters: str
    failed: str | None


# A row as a tuple of plain values, in the order of COLUMNS: what is sent between processes and written.
Values = tuple[int | float | str | None, ...]
FACTORS = tuple(f.name for f in fields(Factors))
_METRICS = tuple(f for f in fields(SweepRow) if f.name not in ("run", "controller", "factors"))
# Name of each column, and the type of its values as SweepRow has it.
COLUMNS: dict[str, str] = {"run": "int", "controller": "str", **{f"factor_{name}": "float" for name in FACTORS},
                           **{f.name: str(f.type) for f in _METRICS}}
PLACE = {name: i for i, name in enumerate(COLUMNS)}
# What means and intervals can be taken of.
NUMBERS = tuple(f.name for f in _METRICS if str(f.type).startswith(("int", "float")))
# Rows are read, written and added up so many runs at a time, however they are kept: sums do not depend on that.
BLOCK = 4096


def row_values(run: int, factors: Factors, metrics: Metrics) -> Values:
    """The row of a run."""
    values = metrics.row()
    if metrics.failed is not None:
        values |= dict.fromkeys(WHOLE_RUN)
        if values["position_error_max"] is None:  # it failed before its first sample
            values["time_of_max_position_error"] = None
    values["counters"] = ";".join(f"{key}={count}" for key, count in sorted(metrics.counters.items()))
    return (run, metrics.controller, *vars(factors).values(),
            *(values[f.name] for f in _METRICS))


def summarised(controller: str, rows: Sequence[SweepRow]) -> SweepSummary:
    """What the rows of one controller come to."""
    sums = Sums(controller)
    for first in range(0, len(rows), BLOCK):
        sums.add([(row.run, row.controller, *vars(row.factors).values(), *(getattr(row, f.name) for f in _METRICS))
                  for row in rows[first:first + BLOCK]])
    return sums.summary()


def sweep_row(values: Values) -> SweepRow:
    """The record of a row."""
    run, controller, *rest = values
    return SweepRow(run, controller, Factors(*rest[:len(FACTORS)]), *rest[len(FACTORS):])  # type: ignore[arg-type]


def in_order(block: Sequence[Sequence[Values]]) -> list[Values]:
    """The rows of the same runs of each controller, ordered by run, then controller."""
    return list(chain.from_iterable(zip(*block, strict=True)))


def csv_pieces(blocks: Iterable[Sequence[Values]], columns: Sequence[str] = tuple(COLUMNS)) -> Iterator[bytes]:
    """The rows as CSV; floats by repr, so that they read back as the same numbers; None is an empty cell."""
    for rows in chain([[columns]], blocks):
        stream = io.StringIO()
        csv.writer(stream, lineterminator="\n").writerows(
            ["" if c is None else repr(c) if isinstance(c, float) else c for c in row] for row in rows)
        yield stream.getvalue().encode()


@dataclass(frozen=True)
class SweepSummary:
    """A controller over all runs: extrema and means over the runs that did not fail; None when all failed.

    position errors and mean_abs_stopping_error in m, speed errors in m/s.
    """

    controller: str
    runs: int
    failed: int
    position_error_min: float | None
    position_error_max: float | None
    speed_error_min: float | None
    speed_error_max: float | None
    mean_abs_stopping_error: float | None


_EXTREMA: dict[str, Callable[..., float]] = {
    "position_error_min": min, "position_error_max": max, "speed_error_min": min, "speed_error_max": max}


@dataclass
class Sums:
    """What the rows of one controller come to, added block by block in the order of the runs."""

    controller: str
    runs: int = 0
    failed: int = 0
    extrema: dict[str, float] = field(default_factory=dict)
    stops: int = 0
    stop_sum: float = 0.0

    def add(self, rows: Sequence[Values]) -> None:
        """Add rows of this controller."""
        whole = [row for row in rows if row[PLACE["failed"]] is None]
        self.runs += len(rows)
        self.failed += len(rows) - len(whole)
        for key, fold in _EXTREMA.items():
            known = [self.extrema[key]] if key in self.extrema else []
            if found := [*known, *numbers(whole, key)]:
                self.extrema[key] = fold(found)
        stopped = np.abs(numbers(whole, "stopping_error"))
        self.stops += len(stopped)
        self.stop_sum += float(np.sum(stopped))

    def summary(self) -> SweepSummary:
        """The controller's row of the summary."""
        return SweepSummary(controller=self.controller, runs=self.runs, failed=self.failed,
                            mean_abs_stopping_error=self.stop_sum / self.stops if self.stops else None,
                            **{key: self.extrema.get(key) for key in _EXTREMA})


def numbers(rows: Iterable[Values], column: str) -> list[float]:
    """The numbers of a column where there are any."""
    place = PLACE[column]
    return [float(value) for row in rows if (value := row[place]) is not None]
