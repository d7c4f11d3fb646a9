"""What of a large cone program is still open once the same run is known on a coarser mesh.

Where a train plainly brakes it will not pull, and a limit that is far away will not bind. Leaving such variables and
rows out makes large programs a third cheaper. Whether they were rightly left out is read off the solution: where
`rightly_closed` says so, it is optimal for the whole program too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.course import Array
from workbench.optimal.grid import Grid, grid_on, kept_borders
from workbench.optimal.profile import largest_force
from workbench.optimal.vehicle import Vehicle

Mask = NDArray[np.bool_]

# A coarser mesh keeps one node in so many; this many of its intervals to each side are open as well.
THINNED, REACH = 10, 4
# A force below the first share of the largest is none, unless a newton's worth is this near to where one pays; from
# the last shares on a force or a speed is near its limit.
NO_FORCE, NEAR_PAY, NEAR_FORCE, NEAR_SPEED = 1e-3, 0.06, 0.8, 0.97
# Shares by which a price or a limit may be passed by what was left out.
PRICE_SLACK, LIMIT_SLACK = 1e-4, 1e-6


@dataclass(frozen=True)
class OpenRows:
    """Shape (n,), for the n intervals: where the train may pull or brake, and where the limit of pulling is asked for.

    top: shape (n + 1,), where the speed limit is asked for.
    """

    pull: Mask
    brake: Mask
    pull_limit: Mask
    top: Mask

    @property
    def share(self) -> float:
        """Of everything that may be open, how much is."""
        return float(np.mean([mask.mean() for mask in (self.pull, self.brake, self.pull_limit, self.top)]))


def all_open(grid: Grid) -> OpenRows:
    """Nothing is left out."""
    every = np.ones(len(grid.limit_mps), dtype=bool)
    return OpenRows(every, every, every, np.append(every, True))


def thinned(grid: Grid) -> Grid:
    """The same course on a mesh that is THINNED times as coarse."""
    s = grid.position_m
    return grid_on(grid.course, np.union1d(s[::THINNED], kept_borders(grid.course)))


def open_rows(vehicle: Vehicle, grid: Grid, coarse: Grid, half_square: Array, force_n: Array,
              price: Array) -> OpenRows:
    """What is open on the grid after a solution on a coarser one, shapes (m + 1,), (m,) and (m,)."""
    speed = np.sqrt(2 * half_square)
    middle = (speed[1:] + speed[:-1]) / 2
    pull, brake = np.maximum(force_n, 0.0), np.maximum(-force_n, 0.0)
    none = NO_FORCE * max(vehicle.traction.force_n, vehicle.braking_n)
    fast = speed >= NEAR_SPEED * coarse.node_limit_mps
    owner = np.clip(np.searchsorted(coarse.position_m, grid.position_m[:-1], side="right") - 1, 0, len(force_n) - 1)

    def on_grid(found: Mask) -> Mask:
        wide = found.copy()
        for k in range(1, REACH + 1):
            wide[k:] |= found[:-k]
            wide[:-k] |= found[k:]
        return np.asarray(wide[owner])

    top = on_grid(fast[1:] | fast[:-1])
    pays, slows = _pays(vehicle)
    return OpenRows(on_grid((pull > none) | (price > pays - NEAR_PAY)),
                    on_grid((brake > none) | (price < slows + NEAR_PAY)),
                    on_grid(pull >= NEAR_FORCE * largest_force(vehicle.traction, middle)),
                    np.append(top, True) | np.insert(top, 0, True))


def rightly_closed(vehicle: Vehicle, grid: Grid, rows: OpenRows, half_square: Array, force_n: Array,
                   price: Array) -> bool:
    """Whether a solution without the closed rows meets them, and would use none of the closed forces.

    price: shape (n,), what a newton more at the wheel is worth, J/m per N.
    """
    speed = np.sqrt(2 * half_square)
    middle = (speed[1:] + speed[:-1]) / 2
    pays, slows = _pays(vehicle)
    most = largest_force(vehicle.traction, middle)
    return not (np.any(price[~rows.pull] > pays + PRICE_SLACK) or np.any(price[~rows.brake] < slows - PRICE_SLACK)
                or np.any(force_n[~rows.pull_limit] > (1 + LIMIT_SLACK) * most[~rows.pull_limit])
                or np.any(speed[~rows.top] > (1 + LIMIT_SLACK) * grid.node_limit_mps[~rows.top]))


def _pays(vehicle: Vehicle) -> tuple[float, float]:
    """The worth of a newton from which on pulling pays, and the one below which braking does."""
    electric = vehicle.regenerative_efficiency if vehicle.regenerative.force_n > 0 else 0.0
    return 1 / vehicle.traction_efficiency, electric
