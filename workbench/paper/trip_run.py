"""What a run along a trip leaves of a study that has many: numbers, a few thinned curves, and why it ended early."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from workbench.paper.cells import Cell, Phrase, Quantity
from workbench.paper.results import Array, Curve, thinned
from workbench.simulate.closed_loop import Run
from workbench.simulate.metrics import finite, measure_run, rms

C = TypeVar("C")
# The curve that a comparison with MPC draws.
ERROR = "error"


@dataclass(frozen=True)
class TripRun(Generic[C]):
    """A run of a case as processes send it.

    row: the numbers of `trip_numbers`; curves: thinned, by name, over time in s, in SI; of a run that is held against
    MPC the position error as `ERROR`.
    """

    case: C
    row: Mapping[str, Any]
    curves: Mapping[str, Curve]

    @property
    def failed(self) -> str | None:
        """Why the run ended early, if it did."""
        why: str | None = self.row["failed"]
        return why

    @property
    def ended(self) -> Cell:
        """When it diverged, in a table's words; None of a run that came to its end."""
        end = self.row["end_s"]
        return Phrase("diverged at {} s", (Quantity(end, decimals=3 if end < 10 else 1),)) if self.failed else None

    @property
    def compared(self) -> dict[str, Any]:
        """The row as a comparison with MPC takes it."""
        return {**self.row, "curve": self.curves[ERROR]}


def trip_numbers(run: Run, length_m: float, **own: float | str | None) -> dict[str, Any]:
    """The row of a run that should end after length_m: the keys of `workbench compare`, `end_s`, and the paper's own.

    SI; None for what a run that failed does not have, the paper's own numbers that are not finite among it.
    """
    return measure_run(run, length_m).row() | {"end_s": run.end_s} | finite(own)


def signal_numbers(run: Run, signals: Mapping[str, Array]) -> dict[str, float | None]:
    """Of each signal over the log, by name, `_rms`, `_min` and `_max`; None of a run that failed."""
    measures: dict[str, Callable[[Array], float]] = {"rms": rms, "min": np.min, "max": np.max}
    return {f"{name}_{what}": None if run.failed else float(measure(values))
            for name, values in signals.items() for what, measure in measures.items()}


def thinned_log(run: Run, columns: Mapping[str, Array]) -> dict[str, Curve]:
    """Columns over the time of a run's log, each thinned under its own name."""
    return {name: thinned(name, run.column("t_s"), values) for name, values in columns.items()}


def error_curve(run: Run) -> Curve:
    """The position error (m) over time (s)."""
    return thinned("position error", run.column("t_s"), run.position_error)
