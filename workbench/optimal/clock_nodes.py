"""The windows of a timetable on the nodes of a mesh, for a program that has the clock as a state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.course import Array
from workbench.optimal.timetable import Timetable


@dataclass(frozen=True)
class ClockNodes:
    """Seconds since the earliest departure, on n intervals; shape (n, 2) each: a lower and an upper limit.

    arrival: of the clock at an interval's end. departure: of the clock at its start. between: of what passes from an
    interval's end to the start of the next one: what is waited there, and what the leg takes beyond the program.
    """

    timetable: Timetable
    arrival: Array
    departure: Array
    between: Array

    @property
    def horizon_s(self) -> float:
        """Up to the latest arrival."""
        return self.timetable.points[-1].arrival.latest_s - self.timetable.origin_s

    def nodes(self, position_m: Array) -> NDArray[np.intp]:
        """The node of each event."""
        at = np.searchsorted(position_m, self.timetable.position_m)
        return np.array([at[event.point] for event in self.timetable.events])


def clock_nodes(timetable: Timetable, position_m: Array, extra_s: Array) -> ClockNodes:
    """For a mesh that has every timing point as a node; extra_s: of each leg, shape (points - 1,)."""
    count, origin = len(position_m) - 1, timetable.origin_s
    arrival, departure = (np.tile([-np.inf, np.inf], (count, 1)) for _ in range(2))
    between = np.zeros((count, 2))
    for event, node in zip(timetable.events, np.searchsorted(position_m, timetable.position_m)[
            [event.point for event in timetable.events]].tolist(), strict=True):
        window = np.array([event.window.earliest_s, event.window.latest_s]) - origin
        if not event.waits:
            arrival[node - 1] = window - extra_s[event.point - 1]
            between[node - 1] += extra_s[event.point - 1]
        elif node:
            departure[node] = window
            between[node - 1] += [event.dwell_s, np.inf]
        elif window[1] > 0:  # else the clock begins at zero
            departure[0] = window
    return ClockNodes(timetable, arrival, departure, between)
