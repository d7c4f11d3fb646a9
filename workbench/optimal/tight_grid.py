"""A mesh for a time near the least one: fine where the fastest run changes its speed, and where it must soon brake.

There the price of time is so high that a run is that of least time but for short coasting before it brakes. What the
mesh misses of its time, the constant acceleration of its intervals, then costs more than anything else.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.course import Array, Course
from workbench.optimal.grid import Grid, kept_borders, shared_out
from workbench.optimal.profile import Profile

# The share of the intervals that are spread evenly; the length before a braking that is as fine as its beginning.
EVENLY, COASTED_M = 0.3, 300.0
# Half the squared speed below which a train hardly moves; a change of its logarithm on a cell that is none.
HARDLY, NO_CHANGE = 1e-2, 1e-6


def tight_grid(course: Course, quickest: Profile, intervals: int) -> Grid:
    """About so many intervals of a course whose fastest run is known."""
    kept, x = kept_borders(course), quickest.position_m
    h, b = np.diff(x), np.maximum(quickest.half_square, HARDLY)
    change = np.diff(np.log(b))
    density = _before_braking(x, np.abs(change) / h, change < -NO_CHANGE)
    density = density * (1 - EVENLY) / max(float(density @ h), 1e-300) + EVENLY / (x[-1] - x[0])
    share = np.insert(np.cumsum(density * h), 0, 0.0) * intervals
    return shared_out(course, kept, x, share)


def _before_braking(x: Array, density: Array, brakes: NDArray[np.bool_]) -> Array:
    """The density of cells, raised on COASTED_M before each braking to what it is where that begins."""
    raised, middle = density.copy(), (x[1:] + x[:-1]) / 2
    starts = np.flatnonzero(brakes & ~np.insert(brakes[:-1], 0, False))
    for k in starts:
        first = int(np.searchsorted(middle, x[k] - COASTED_M))
        raised[first:k] = np.maximum(raised[first:k], density[k])
    return raised
