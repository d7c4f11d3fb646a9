"""What one train meets along one run: speed limits, the line's force and tunnel drag, as functions of position."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Passage:
    """A point of a run that is passed at slowest_mps to fastest_mps: more than the limits of the line around it."""

    position_m: float
    slowest_mps: float = 0.0
    fastest_mps: float = np.inf


@dataclass(frozen=True)
class Course:
    """A run from position_m[0] to position_m[-1], for one train: its length is already taken into account.

    position_m: shape (n + 1,), m, increasing: the borders of n sections. limit_mps: shape (n,), the speed limit of
    each section, positive; it already holds for the train's whole length and its own highest speed. force_n: shape
    (n, 2), N, at the start and the end of each section and linear between: grade and curves, opposing motion.
    drag: shape (n, 2), N s^2/m^2, likewise: what tunnels add to the resistance's square term. stops_m: positions
    strictly inside at which the train must come to a stand, each one of position_m. points: passed strictly inside,
    each at one of position_m too. usable: shape (n, 2), the shares of traction and of the brakes that a driven run may
    use on each section, all of them where none is given; bounds do not count on it.
    Raises WorkbenchError when shapes, order or signs are wrong.
    """

    position_m: Array
    limit_mps: Array
    force_n: Array
    drag: Array
    stops_m: tuple[float, ...] = ()
    points: tuple[Passage, ...] = ()
    usable: Array | None = None

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
        if self.usable is not None and not (self.usable.shape == (n, 2) and np.all((self.usable > 0)
                                                                                   & (self.usable <= 1))):
            raise WorkbenchError("course: the usable shares of traction and brakes must lie above 0 and up to 1, two a "
                                 "section: correct them")
        within = [*self.stops_m, *(p.position_m for p in self.points)]
        if within and not np.isin(within, self.position_m[1:-1]).all():
            raise WorkbenchError("course: a stop or a point is no border of a section inside the run: add it to "
                                 "position_m")

    @property
    def usable_shares(self) -> Array:
        """`usable`, shape (n, 2), ones where none is given."""
        return np.ones((len(self.limit_mps), 2)) if self.usable is None else self.usable

    @property
    def length_m(self) -> float:
        """Distance from the first to the last position."""
        return float(self.position_m[-1] - self.position_m[0])

    def split(self, position_m: Array) -> Course:
        """The same course with further borders, which must lie inside it."""
        borders = np.unique(np.concatenate((self.position_m, position_m)))
        section = np.searchsorted(self.position_m, borders[:-1], side="right") - 1
        start, width = self.position_m[section], np.diff(self.position_m)[section]
        share = np.empty((len(section), 2))
        np.divide(borders[:-1] - start, width, out=share[:, 0])
        np.divide(borders[1:] - start, width, out=share[:, 1])

        def cut(ends: Array) -> Array:
            if not ends.any():  # no tunnels, say
                return np.zeros_like(share)
            low, change = ends[:, :1], np.diff(ends, axis=1)
            return low[section] + share * change[section]

        return replace(self, position_m=borders, limit_mps=self.limit_mps[section], force_n=cut(self.force_n),
                       drag=cut(self.drag), usable=None if self.usable is None else self.usable[section])

    def cut(self, from_m: float, to_m: float) -> Course:
        """The part of the course from one position to another, which must lie inside it."""
        whole = self.split(np.array([from_m, to_m]))
        inside = (whole.position_m[:-1] >= from_m) & (whole.position_m[1:] <= to_m)
        ends = np.flatnonzero(inside)
        return Course(whole.position_m[ends[0]:ends[-1] + 2], whole.limit_mps[inside], whole.force_n[inside],
                      whole.drag[inside], tuple(stop for stop in self.stops_m if from_m < stop < to_m),
                      tuple(point for point in self.points if from_m < point.position_m < to_m),
                      None if whole.usable is None else whole.usable[inside])

    def speed_windows_mps(self, nodes_m: Array) -> tuple[Array, Array]:
        """The least and the highest speed at positions by points and stops alone: 0 and infinite elsewhere."""
        least, most = np.zeros(len(nodes_m)), np.full(len(nodes_m), np.inf)
        for point in self.points:
            at = nodes_m == point.position_m
            least[at], most[at] = point.slowest_mps, point.fastest_mps
        most[np.isin(nodes_m, self.stops_m)] = 0.0
        return least, most
