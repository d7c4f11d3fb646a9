"""Ranges of speed on each of which a force limit is one piece, as arrays over all of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.force_pieces import ForcePiece, force_pieces
from workbench.optimal.vehicle import Vehicle

# Of 1 / v, 1, v and v^2.
Coefficients = tuple[Array, Array, Array, Array]
# Ranges of speed on which a limit of the acceleration is held against those of the forces, and halvings by which the
# speed at which it passes one is found in each.
ACCELERATION_RANGES, HALVINGS = 4, 30
# From this speed on forces are looked at, m/s: a power's is infinite at standstill.
SLOWEST_MPS = 1e-9


@dataclass(frozen=True)
class Ranges:
    """Ranges of speed in m/s on which both force limits are one piece each, shape (ranges, 1, 1) or, where they differ
    from cell to cell, (ranges, 1, n)."""

    low: Array
    high: Array
    traction: Coefficients
    brake: Coefficients


def speed_ranges(vehicle: Vehicle, top_mps: float) -> Ranges:
    """From standstill to top_mps."""
    pieces = [force_pieces(limit, top_mps) for limit in (vehicle.traction, vehicle.regenerative)]
    edges = {0.0, top_mps, *(piece.high_mps for of in pieces for piece in of)}
    if np.isfinite(min(vehicle.max_acceleration_mps2, vehicle.max_deceleration_mps2)):
        edges |= set(np.linspace(0.0, top_mps, ACCELERATION_RANGES + 1).tolist())
    ranges = list(pairwise(sorted(edges)))
    traction, brake = (_coefficients(of, [(low + high) / 2 for low, high in ranges]) for of in pieces)
    return Ranges(_column([low for low, _ in ranges]), _column([high for _, high in ranges]), traction, brake)


def cut_at_crossings(ranges: Ranges, limits: Sequence[tuple[Coefficients, Coefficients]]) -> Ranges:
    """The ranges cut in each cell where the one of two limits passes the other; empty ones where it does not.

    limits: pairs whose values can be broadcast to (ranges, 1, n).
    """
    cuts = [_crossing(ranges, one, other) for one, other in limits]
    borders = np.sort(np.stack(np.broadcast_arrays(ranges.low, *cuts, ranges.high)), axis=0)
    parts = len(borders) - 1

    def again(values: Coefficients) -> Coefficients:
        one, two, three, four = (np.tile(value, (parts, 1, 1)) for value in values)
        return one, two, three, four

    return replace(ranges, low=np.concatenate(borders[:-1]), high=np.concatenate(borders[1:]),
                   traction=again(ranges.traction), brake=again(ranges.brake))


def _crossing(ranges: Ranges, one: Coefficients, other: Coefficients) -> Array:
    """The speed in each range at which the difference changes its sign, a little below it; the highest for none."""
    low, high, *apart = np.broadcast_arrays(ranges.low, ranges.high, *(a - b for a, b in zip(one, other, strict=True)))
    below, above, found = np.maximum(low, SLOWEST_MPS), high, high.copy()
    sign = force_at((apart[0], apart[1], apart[2], apart[3]), below) > 0
    changes = (force_at((apart[0], apart[1], apart[2], apart[3]), above) > 0) != sign
    a, b, c, d, below, above, sign = (values[changes] for values in (*apart, below, above, sign))
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        same = (force_at((a, b, c, d), middle) > 0) == sign
        below, above = np.where(same, middle, below), np.where(same, above, middle)
    found[changes] = below
    return found


def force_at(limit: Coefficients, v: Array) -> Array:
    """A limit's force in N at speeds above zero in m/s."""
    return np.asarray(limit[0] / v + limit[1] + v * (limit[2] + v * limit[3]))


def _coefficients(pieces: tuple[ForcePiece, ...], middles_mps: list[float]) -> Coefficients:
    """Of the piece at the middle of each range, shape (ranges, 1, 1)."""
    chosen = [next(p for p in pieces if p.low_mps <= middle <= p.high_mps) for middle in middles_mps]
    return (_column([p.inverse_w for p in chosen]), _column([p.constant_n for p in chosen]),
            _column([p.slope_n_s_per_m for p in chosen]), _column([0.0] * len(chosen)))


def _column(values: Sequence[float]) -> Array:
    return np.array(values, dtype=float)[:, None, None]
