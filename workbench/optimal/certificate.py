"""What proves a lower bound: a piecewise linear function of position, and what seconds cost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from workbench.errors import WorkbenchError
from workbench.optimal.course import Array
from workbench.optimal.timetable import Timetable


@dataclass(frozen=True)
class Certificate:
    """What proves a bound: position_m shape (n + 1,); left, right: shape (n,), p at both ends of each cell (J/m per N).

    time_price_w: mu on the way to the end, the price of the last arrival and what is counted of auxiliaries,
    auxiliary_w, which may be less than a train draws. window_prices_w: the prices of the timetable's events before it,
    in their order; none for zero. Raises WorkbenchError when a value is not finite, or mu or auxiliary_w is negative.
    """

    position_m: Array
    left: Array
    right: Array
    time_price_w: float
    window_prices_w: tuple[float, ...] = ()
    auxiliary_w: float = 0.0

    def __post_init__(self) -> None:
        values = (self.position_m, self.left, self.right, np.array([self.time_price_w, *self.window_prices_w]),
                  np.array(self.auxiliary_w))
        if not all(np.all(np.isfinite(v)) for v in values) or min(self.time_price_w, self.auxiliary_w) < 0:
            raise WorkbenchError("certificate of a bound: its values must be finite and its time price not negative: "
                                 "solve again")

    def prices_w(self, timetable: Timetable) -> Array:
        """The price of each event of a timetable without auxiliaries, W; raises WorkbenchError for other events."""
        count = len(timetable.events)
        earlier = self.window_prices_w or (0.0,) * (count - 1)
        if len(earlier) != count - 1:
            raise WorkbenchError(f"certificate of a bound: it has {len(earlier) + 1} prices and the timetable {count} "
                                 "events: solve again")
        return np.array([*earlier, self.time_price_w - self.auxiliary_w])

    def cell_prices_w(self, timetable: Timetable) -> Array:
        """What a second costs on each cell, mu, W."""
        return timetable.cell_prices(self.prices_w(timetable), self.position_m, self.auxiliary_w)

    def time_part_j(self, timetable: Timetable) -> float:
        """What windows and least waits add to the bound, J; -inf where the prices prove nothing."""
        return timetable.time_part_j(self.prices_w(timetable), self.auxiliary_w)
