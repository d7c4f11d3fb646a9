"""Ranges of speed on each of which a force limit is one piece, as arrays over all of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.force_pieces import ForcePiece, force_pieces
from workbench.optimal.vehicle import Vehicle

# Ranges of speed on each of which one of several limits of the force is used.
ACCELERATION_RANGES = 30


@dataclass(frozen=True)
class Pieces:
    """The piece of a force limit on each range of speeds, each shape (ranges, 1, 1): its coefficients, and its force
    in the middle of the range."""

    inverse_w: Array
    constant_n: Array
    slope_n_s_per_m: Array
    middle_n: Array


@dataclass(frozen=True)
class Ranges:
    """Ranges of speed in m/s on which both force limits are one piece each, each shape (ranges, 1, 1)."""

    low: Array
    high: Array
    middle: Array
    middle_square: Array
    traction: Pieces
    brake: Pieces


def speed_ranges(vehicle: Vehicle, top_mps: float) -> Ranges:
    """From standstill to top_mps; cut finer where an acceleration is limited."""
    pieces = [force_pieces(limit, top_mps) for limit in (vehicle.traction, vehicle.regenerative)]
    edges = {0.0, top_mps, *(piece.high_mps for of in pieces for piece in of)}
    if np.isfinite(min(vehicle.max_acceleration_mps2, vehicle.max_deceleration_mps2)):
        edges |= set(np.linspace(0.0, top_mps, ACCELERATION_RANGES + 1).tolist())
    ranges = list(pairwise(sorted(edges)))
    middles = [(low + high) / 2 for low, high in ranges]
    traction, brake = (_pieces(of, middles) for of in pieces)
    return Ranges(_column([low for low, _ in ranges]), _column([high for _, high in ranges]), _column(middles),
                  _column([middle**2 for middle in middles]), traction, brake)


def _pieces(pieces: tuple[ForcePiece, ...], middles_mps: list[float]) -> Pieces:
    chosen = [next(p for p in pieces if p.low_mps <= middle <= p.high_mps) for middle in middles_mps]
    return Pieces(_column([p.inverse_w for p in chosen]), _column([p.constant_n for p in chosen]),
                  _column([p.slope_n_s_per_m for p in chosen]),
                  _column([p.at(middle) for p, middle in zip(chosen, middles_mps, strict=True)]))


def _column(values: Sequence[float]) -> Array:
    return np.array(values, dtype=float)[:, None, None]
