"""What one train meets along one run: speed limits, the line's force and tunnel drag, as functions of position."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Course:
    """A run from position_m[0] to position_m[-1], for one train: its length is already taken into account.

    position_m: shape (n + 1,), m, increasing: the borders of n sections. limit_mps: shape (n,), the speed limit of
    each section, positive; it already holds for the train's whole length and its own highest speed. force_n: shape
    (n, 2), N, at the start and the end of each section and linear between: grade and curves, opposing motion.
    drag: shape (n, 2), N s^2/m^2, likewise: what tunnels add to the resistance's square term. stops_m: positions
    strictly inside at which the train must come to a stand, each one of position_m.
    Raises WorkbenchError when shapes, order or signs are wrong.
    """

    position_m: Array
    limit_mps: Array
    force_n: Array
    drag: Array
    stops_m: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        n = len(self.position_m) - 1
        shapes = (self.limit_mps.shape, self.force_n.shape, self.drag.shape)
        if n < 1 or shapes != ((n,), (n, 2), (n, 2)):
            raise WorkbenchError(f"course: {n + 1} positions do not fit sections of shapes {shapes}: give one row "
                                 "a section")
        if not (np.all(np.diff(self.position_m) > 0) and np.all(self.limit_mps > 0) and np.all(self.drag >= 0)
                and np.all(np.isfinite(self.force_n))):
            raise WorkbenchError("course: positions must increase, limits be positive, drag not be negative and "
                                 "forces be finite: correct the line")
        if not set(self.stops_m) <= set(self.position_m[1:-1].tolist()):
            raise WorkbenchError("course: a stop is no border of a section inside the run: add it to position_m")

    @property
    def length_m(self) -> float:
        """Distance from the first to the last position."""
        return float(self.position_m[-1] - self.position_m[0])

    def split(self, position_m: Array) -> Course:
        """The same course with further borders, which must lie inside it."""
        borders = np.unique(np.concatenate((self.position_m, position_m)))
        section = np.searchsorted(self.position_m, borders[:-1], side="right") - 1
        start, width = self.position_m[section], np.diff(self.position_m)[section]
        share = np.stack(((borders[:-1] - start) / width, (borders[1:] - start) / width), axis=1)

        def cut(ends: Array) -> Array:
            low, high = ends[section, :1], ends[section, 1:]
            return low + share * (high - low)

        return Course(borders, self.limit_mps[section], cut(self.force_n), cut(self.drag), self.stops_m)

    def cut(self, from_m: float, to_m: float) -> Course:
        """The part of the course from one position to another, which must lie inside it."""
        whole = self.split(np.array([from_m, to_m]))
        inside = (whole.position_m[:-1] >= from_m) & (whole.position_m[1:] <= to_m)
        ends = np.flatnonzero(inside)
        return Course(whole.position_m[ends[0]:ends[-1] + 2], whole.limit_mps[inside], whole.force_n[inside],
                      whole.drag[inside], tuple(stop for stop in self.stops_m if from_m < stop < to_m))
