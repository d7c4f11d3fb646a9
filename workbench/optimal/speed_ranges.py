"""Ranges of speed on each of which a force limit is one piece, as arrays over all of them at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.force_pieces import ForcePiece, force_pieces
from workbench.optimal.vehicle import ForceLimit, Vehicle

# Of 1 / v, 1, v and v^2.
Coefficients = tuple[Array, Array, Array, Array]
Four = tuple[float, float, float, float]
# Ranges of speed on which a limit of the acceleration is held against those of the forces, and halvings by which the
# speed at which it passes one is found in each.
ACCELERATION_RANGES, HALVINGS = 4, 30
# From this speed on forces are looked at, m/s: a power's is infinite at standstill.
SLOWEST_MPS = 1e-9
# By so much what is left to friction is taken above itself, so that rounding does not make it negative.
LIFTED_N = 1e-6


@dataclass(frozen=True)
class Ranges:
    """Ranges of speed in m/s on which every force limit is one piece, shape (ranges, 1, 1) or, where they differ from
    cell to cell, (ranges, 1, n).

    brake, friction: what the electric brake gives at most, and friction beside it. No run gains more: where both brakes
    together have a limit, a newton is worth no less by the electric brake, which is taken to be full first.
    """

    low: Array
    high: Array
    traction: Coefficients
    brake: Coefficients
    friction: Coefficients


def speed_ranges(vehicle: Vehicle, top_mps: float) -> Ranges:
    """From standstill to top_mps."""
    limits = [vehicle.traction, vehicle.regenerative]
    if vehicle.braking_table:
        limits.append(ForceLimit(max(force for _, force in vehicle.braking_table), table=vehicle.braking_table))
    pieces = [force_pieces(limit, top_mps) for limit in limits]
    edges = {0.0, top_mps, *(piece.high_mps for of in pieces for piece in of)}
    if vehicle.braking_table:
        edges |= {speed for low, high in pairwise(sorted(edges))
                  for speed in _met(_piece(pieces[1], (low + high) / 2), _piece(pieces[2], (low + high) / 2),
                                    vehicle.friction_brake_n, low, high)}
    if np.isfinite(min(vehicle.max_acceleration_mps2, vehicle.max_deceleration_mps2)):
        edges |= set(np.linspace(0.0, top_mps, ACCELERATION_RANGES + 1).tolist())
    ranges = list(pairwise(sorted(edges)))
    brakes = [_brakes(_piece(pieces[1], (low + high) / 2), _piece(pieces[2], (low + high) / 2) if pieces[2:] else None,
                      vehicle.friction_brake_n, low, high) for low, high in ranges]
    traction = _columns([_four(_piece(pieces[0], (low + high) / 2)) for low, high in ranges])
    return Ranges(_column([low for low, _ in ranges]), _column([high for _, high in ranges]), traction,
                  _columns([brake for brake, _ in brakes]), _columns([friction for _, friction in brakes]))


def _brakes(electric: ForcePiece, both: ForcePiece | None, friction_n: float, low: float,
            high: float) -> tuple[Four, Four]:
    """What the electric brake and friction give at most on a range of speed, under a limit of both together.

    Each of three pairs bounds what braking gains: no limit of both; all of it electric; and what the electric brake
    leaves of it to friction, which must not be negative. It is concave in the speed, and so least at an end.
    """
    own, alone = _four(electric), (0.0, float(friction_n), 0.0, 0.0)
    if both is None:
        return own, alone
    total, middle = _four(both), (low + high) / 2
    left = total[0] - own[0], total[1] - own[1] + LIFTED_N, total[2] - own[2], 0.0
    if _at(left, middle) <= LIFTED_N:
        return total, (0.0, 0.0, 0.0, 0.0)
    may = _at(left, high) >= 0 and ((own[0] == 0 and left[1] >= 0) if low == 0 else _at(left, low) >= 0)
    return own, left if may and _at(left, middle) < friction_n else alone


def _met(electric: ForcePiece, both: ForcePiece, friction_n: float, low: float, high: float) -> Iterator[float]:
    """Speeds between two others at which the limit of both brakes meets the electric one, and that with friction."""
    own, total = _four(electric), _four(both)
    for more in (0.0, friction_n):
        # (total - own - more) v is a polynomial of the speed.
        roots = np.roots([total[2] - own[2], total[1] - own[1] - more, total[0] - own[0]])
        yield from (float(v.real) for v in roots if abs(v.imag) < 1e-12 and low < v.real < high)


def _four(piece: ForcePiece) -> Four:
    return piece.inverse_w, piece.constant_n, piece.slope_n_s_per_m, 0.0


def _at(limit: Four, v: float) -> float:
    return (limit[0] / v if limit[0] else 0.0) + limit[1] + v * (limit[2] + v * limit[3])


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
                   traction=again(ranges.traction), brake=again(ranges.brake), friction=again(ranges.friction))


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


def _piece(pieces: tuple[ForcePiece, ...], v: float) -> ForcePiece:
    return next(piece for piece in pieces if piece.low_mps <= v <= piece.high_mps)


def _columns(limits: Sequence[Four]) -> Coefficients:
    """Of the limit of each range, shape (ranges, 1, 1)."""
    one, two, three, four = (_column(values) for values in zip(*limits, strict=True))
    return one, two, three, four


def _column(values: Sequence[float]) -> Array:
    return np.array(values, dtype=float)[:, None, None]
