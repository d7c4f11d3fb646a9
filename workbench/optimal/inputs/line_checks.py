"""Checks of a line's positions and values, each error naming the key that a file or a caller gave them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from workbench.errors import InputError

SHARPEST_RADIUS_M = 50.0
STEEPEST_PERMILLE = 100.0
SLOWEST_MPS, FASTEST_MPS = 0.1, 200.0
LONGEST_M = 2e7
NEAREST_STOPS_M = 1.0
# The end of a tunnel is a sum of two rounded numbers.
SAME_PLACE_M = 1e-6
# A train shorter than a metre is none: its length is in another unit.
SHORTEST_TRAIN_M, LONGEST_TRAIN_M = 1.0, 1e4


def require_stops(key: str, stops_m: Sequence[float]) -> None:
    """Raises InputError unless stops begin at 0, increase by a metre at least and end within a line's length."""
    if len(stops_m) < 2:
        raise InputError("", key, f"{len(stops_m)} given: name the first and the last position at least")
    if stops_m[0] != 0:
        raise InputError("", f"{key}[0]", f"{stops_m[0]:g} m: a line begins at its first stop: let that be 0")
    for number, (one, two) in enumerate(pairwise(stops_m), start=1):
        if not two - one >= NEAREST_STOPS_M:
            raise InputError("", f"{key}[{number}]", f"{two:g} m does not come {NEAREST_STOPS_M:g} m or more after "
                             f"{one:g} m: sort the stops, name each once")
    if not stops_m[-1] <= LONGEST_M:
        raise InputError("", f"{key}[{len(stops_m) - 1}]", f"{stops_m[-1]:g} m is no railway's length, at most "
                         f"{LONGEST_M:g} m: correct it or its unit")


def require_starts(key: str, starts_m: Sequence[float], length_m: float) -> None:
    """Raises InputError unless positions begin at 0, increase and lie within the line."""
    if not starts_m:
        raise InputError("", key, "none given: name at least what holds from 0 on")
    if starts_m[0] != 0:
        raise InputError("", f"{key}[0]", f"begins at {starts_m[0]:g} m: say what holds from 0 on, the line's start")
    _require_order(key, starts_m)
    if not starts_m[-1] < length_m:
        raise InputError("", f"{key}[{len(starts_m) - 1}]", f"{starts_m[-1]:g} m lies beyond the line, which ends at "
                         f"{length_m:g} m with its last stop: remove it or correct the stops")


def require_tunnels(key: str, tunnels: Sequence[tuple[float, float, float | None, float]],
                    length_m: float) -> None:
    """Raises InputError unless tunnels lie within the line, in order and apart, with plausible values.

    A tunnel: start in m, length in m, cross section in m^2 or None, added resistance in N/kN.
    """
    _require_order(key, [start for start, *_ in tunnels])
    reached = 0.0
    for number, (start, length, area, resistance) in enumerate(tunnels):
        where, end = f"{key}[{number}]", start + length
        if not (start >= 0 and length > SAME_PLACE_M and end <= length_m + SAME_PLACE_M):
            raise InputError("", where, f"from {start:g} m to {end:g} m does not lie within the line of "
                             f"{length_m:g} m: correct position or length")
        if start < reached - SAME_PLACE_M:
            raise InputError("", where, f"begins at {start:g} m within the tunnel before it, which ends at "
                             f"{reached:g} m: let them not overlap")
        reached = end
        if not (area is None or 5 <= area <= 1000):
            raise InputError("", where, f"a cross section of {area:g} m^2 is no railway tunnel's, 5 to 1000: correct "
                             "it or its unit")
        if not 0 <= resistance <= 100:
            raise InputError("", where, f"{resistance:g} N/kN is no tunnel's resistance, 0 to 100: "
                             "correct it or its unit")


def _require_order(key: str, positions_m: Sequence[float]) -> None:
    for number, (one, two) in enumerate(pairwise(positions_m), start=1):
        if not two > one:
            raise InputError("", f"{key}[{number}]", f"{two:g} m does not come after {one:g} m: sort by position, name "
                             "each once")
