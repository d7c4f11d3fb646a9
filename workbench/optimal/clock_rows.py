"""The windows of a timetable as rows of the cone program: what was run and waited up to each event."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.cone_program import ConeProgram, Linear, Rule, Solution
from workbench.optimal.course import Array
from workbench.optimal.timetable import Timetable


@dataclass(frozen=True)
class ClockRows:
    """Event i is at fixed_s[i] + runs[i] times the intervals' durations + waits[i] times the free waits.

    fixed_s: shape (m,). runs: shape (m, n). waits: shape (m, k), a column for each wait that may serve to be later.
    """

    timetable: Timetable
    fixed_s: Array
    runs: Array
    waits: Array

    @property
    def horizon_s(self) -> float:
        """From the earliest departure to the latest arrival, without what is known to be waited; at least a second."""
        latest = self.timetable.points[-1].arrival.latest_s
        return max(latest - float(self.fixed_s[-1]), 1.0)

    @property
    def fixed_between_ends_s(self) -> float:
        """What is known to pass from the first departure to the last arrival beside running and free waits."""
        return float(self.fixed_s[-1] - self.fixed_s[0])

    @property
    def free_waits(self) -> int:
        """How many waits are variables."""
        return int(self.waits.shape[1])

    def rules(self, program: ConeProgram, tau: Linear, wait: Linear, unit_s: float) -> WindowRules:
        """Adds the rows that say which events have a latest and an earliest time; durations in unit_s."""
        windows = [event.window for event in self.timetable.events]
        highest, lowest = (np.array([getattr(window, name) for window in windows])
                           for name in ("latest_s", "earliest_s"))
        # What precedes the first departure is free where a wait there may serve, else it is none.
        late = np.flatnonzero(np.isfinite(highest) & ((np.arange(len(windows)) > 0) | self.waits.any(axis=1)))
        soon = np.flatnonzero(np.isfinite(lowest) & (np.arange(len(windows)) > 0))

        def clock(at: NDArray[np.intp]) -> Linear:
            return _each(self.runs[at], tau) + _each(self.waits[at], wait)

        not_late = program.require_at_most(clock(late) - (highest - self.fixed_s)[late] / unit_s)
        not_soon = program.require_at_most(-1.0 * clock(soon) + (lowest - self.fixed_s)[soon] / unit_s)
        return WindowRules(late, soon, not_late, not_soon)

    def between_ends(self, program: ConeProgram, tau: Linear, wait: Linear) -> Array:
        """What is run and freely waited from the first departure to the last arrival: a factor a variable."""
        return program.factors(tau, np.ones(len(tau.constant))) + program.factors(wait, self.waits[-1] - self.waits[0])

    def prices(self, solved: Solution, rules: WindowRules) -> Array:
        """The price of each event in the program's unit of cost."""
        found = np.zeros(len(self.fixed_s))
        found[rules.late] += np.maximum(solved.price(rules.not_late), 0.0)
        found[rules.soon] -= np.maximum(solved.price(rules.not_soon), 0.0)
        return found


@dataclass(frozen=True)
class WindowRules:
    """Events with a latest time, those with an earliest one, and the rows that say so."""

    late: NDArray[np.intp]
    soon: NDArray[np.intp]
    not_late: Rule
    not_soon: Rule


def _each(factors: Array, variables: Linear) -> Linear:
    """Each row of the factors times the variables, one a row of theirs."""
    row, column = np.nonzero(factors)
    return Linear(row, variables.variable[column], factors[row, column], np.zeros(len(factors)))


def clock_rows(timetable: Timetable, position_m: Array, extra_s: Array | None = None) -> ClockRows:
    """For a mesh that has every timing point as a node.

    extra_s: what each leg takes beyond the program's durations, shape (legs,). A wait is free only where a later
    event must not come too soon: elsewhere waiting serves nothing.
    """
    events = timetable.events
    extra = np.zeros(len(timetable.points) - 1) if extra_s is None else extra_s
    node = np.searchsorted(position_m, timetable.position_m)
    rows, fixed, waits = [], [], []
    total, seen = timetable.origin_s, [0.0] * sum(event.waits for event in events)
    number = 0
    for place, event in enumerate(events):
        if event.waits:
            total += event.dwell_s
            serves = any(np.isfinite(later.window.earliest_s) for later in events[max(place, 1):])
            serves &= place > 0 or event.window.latest_s > event.window.earliest_s
            seen[number] = 1.0 if serves else 0.0
            number += 1
        else:
            total += float(extra[event.point - 1])
        fixed.append(total)
        waits.append(list(seen))
        rows.append((np.arange(len(position_m) - 1) < node[event.point]).astype(float))
    columns = np.array(waits)
    return ClockRows(timetable, np.array(fixed), np.array(rows), columns[:, columns.any(axis=0)])
