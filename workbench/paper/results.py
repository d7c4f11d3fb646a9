"""What a study found, as data: rows, tables, figures, findings."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.paper.cells import Cell, Column, cell_text, cell_value, is_finite

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Curve:
    """One curve of a plot: x and y of the same length, in the units of the plot's labels.

    One whose label begins with `desired` or `printed` is drawn broad and faint, beneath the others.
    Raises ValueError for what is no curve: other lengths, no point, a value that is not finite.
    """

    label: str
    x: Array
    y: Array

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.y.shape or not self.x.size:
            raise ValueError(f"curve '{self.label}' has {self.x.shape} values of x and {self.y.shape} of y")
        if not (np.isfinite(self.x).all() and np.isfinite(self.y).all()):
            raise ValueError(f"curve '{self.label}' has values that are not finite: end it where its run failed")

    def called(self, label: str, factor: float = 1.0) -> Curve:
        """The same under another label, y times a factor."""
        return Curve(label, self.x, self.y if factor == 1 else self.y * factor)

    def size(self) -> Curve:
        """|y| as a logarithmic axis takes it, without points where it is zero; the same where it is zero throughout."""
        some = self.y != 0
        return Curve(self.label, self.x[some], np.abs(self.y[some])) if some.any() else self

    def part(self, start: float, most: float) -> Curve | None:
        """From x = start on and up to where |y| first exceeds `most`; None where nothing is left."""
        x, y = self.x[self.x >= start], self.y[self.x >= start]
        beyond = np.abs(y) > most
        last = max(1, int(np.argmax(beyond))) if beyond.any() else len(y)
        return Curve(self.label, x[:last], y[:last]) if len(x) else None


def thinned(label: str, x: Array, y: Array, stretches: int = 1000) -> Curve:
    """A curve up to where y is finite, of which each of so many stretches keeps its largest and its smallest value."""
    whole = len(y) if np.isfinite(y).all() else max(1, int(np.argmin(np.isfinite(y))))
    x, y = x[:whole], y[:whole]
    if len(x) <= 2 * stretches:
        return Curve(label, x, y)
    parts = np.array_split(np.arange(len(x)), stretches)
    extremes = {int(part[pick(y[part])]) for part in parts for pick in (np.argmin, np.argmax)}
    chosen = sorted(extremes | {0, len(x) - 1})
    return Curve(label, x[chosen], y[chosen])


@dataclass(frozen=True)
class Plot:
    """A figure of the paper, run again: what it shows, its axes with their units, its curves.

    source: the figure it stands for (`paper, Figure 5`) or what it adds.
    """

    title: str
    source: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    note: str = ""
    log_y: bool = False
    log_x: bool = False


@dataclass(frozen=True)
class ResultTable:
    """A table of results; printed and obtained values stand side by side in it.

    header: a Column each, plain text for one of words or of cells that bring their own unit; rows: numbers in SI,
    words, or both together; letters: whether its cells hold letters of formulas, such as k_2, and no names. Raises
    ValueError for a row that does not fit and a number that is not finite.
    """

    title: str
    source: str
    header: tuple[Column | str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""
    letters: bool = False

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.header) or not all(map(is_finite, row)):
                raise ValueError(f"table '{self.title}': the row {row} does not fit its header, or has no number")

    @property
    def columns(self) -> tuple[Column, ...]:
        """What each column holds."""
        return tuple(column if isinstance(column, Column) else Column(column) for column in self.header)

    @property
    def headings(self) -> tuple[str, ...]:
        """The header as it is shown."""
        return tuple(column.heading for column in self.columns)

    @property
    def text(self) -> tuple[tuple[str, ...], ...]:
        """The rows as they are shown."""
        return tuple(tuple(cell_text(cell, column) for cell, column in zip(row, self.columns, strict=True))
                     for row in self.rows)

    @property
    def values(self) -> tuple[tuple[Any, ...], ...]:
        """The rows for programs: numbers in the units of their columns."""
        return tuple(tuple(cell_value(cell, column) for cell, column in zip(row, self.columns, strict=True))
                     for row in self.rows)


@dataclass(frozen=True)
class Shown:
    """What a part of a study shows, in the order of the page."""

    tables: Iterable[ResultTable] = ()
    plots: Iterable[Plot] = ()
    findings: Iterable[str] = ()


@dataclass(frozen=True)
class StudyResult:
    """What a study found.

    rows: one a run, with the keys of `workbench compare` where they make sense, and more; plain data, None for
    a number that a failed run does not have. findings: what a reader should know, a sentence each, every number
    in it taken from the runs. failures: (run, why) of runs that ended early. winners, first_plot: what the first screen
    shows, a table and the number of one of the plots; None where nobody is compared. standings: who wins under which
    condition and at what price, a sentence each; a page makes them of the rows of `winners` where there are none. runs:
    what each of the study's own cases left, for whoever asks for the same run; left_out: how many cases were not run,
    for a short report.
    """

    rows: tuple[dict[str, Any], ...]
    tables: tuple[ResultTable, ...]
    plots: tuple[Plot, ...]
    findings: tuple[str, ...]
    failures: tuple[tuple[str, str], ...] = ()
    winners: ResultTable | None = None
    first_plot: int | None = None
    standings: tuple[str, ...] = ()
    runs: Mapping[Hashable, Any] = field(default_factory=dict)
    left_out: int = 0

    def __post_init__(self) -> None:
        for row in self.rows:
            wrong = [key for key, value in row.items() if isinstance(value, float) and not math.isfinite(value)]
            if wrong:
                raise ValueError(f"row {row}: {wrong[0]} is not finite: say None for what a run does not have")
