"""A force limit as pieces of the form inverse / v + constant + slope v: exact, and easy to minimise over."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from workbench.optimal.vehicle import ForceLimit


@dataclass(frozen=True)
class ForcePiece:
    """The largest force in N for speeds from low_mps to high_mps: inverse_w / v + constant_n + slope_n_s_per_m v."""

    low_mps: float
    high_mps: float
    inverse_w: float
    constant_n: float
    slope_n_s_per_m: float

    def at(self, speed_mps: float) -> float:
        """Force in N at a speed in m/s, the inverse left out at standstill where it is zero."""
        inverse = self.inverse_w / speed_mps if self.inverse_w else 0.0
        return inverse + self.constant_n + self.slope_n_s_per_m * speed_mps


def force_pieces(limit: ForceLimit, top_mps: float) -> tuple[ForcePiece, ...]:
    """The limit from standstill to top_mps, in pieces without gap; equal to `limit.at` everywhere."""
    lines = _lines(limit, top_mps)
    pieces: list[ForcePiece] = []
    for low, high, constant, slope in lines:
        cuts = [low, *sorted(_crossings(limit.power_w, constant, slope, low, high)), high]
        for one, two in pairwise(cuts):
            middle = (one + two) / 2
            if constant + slope * middle <= limit.power_w / middle:
                pieces.append(ForcePiece(one, two, 0.0, constant, slope))
            else:
                pieces.append(ForcePiece(one, two, limit.power_w, 0.0, 0.0))
    return tuple(pieces)


def _lines(limit: ForceLimit, top_mps: float) -> list[tuple[float, float, float, float]]:
    """(low, high, constant, slope) of the least of the constant force and the table, without the power."""
    if not limit.table:
        return [(0.0, top_mps, limit.force_n, 0.0)]
    points = [(0.0, limit.table[0][1]), *limit.table, (math.inf, limit.table[-1][1])]
    found = []
    for (low, first), (high, last) in pairwise(points):
        start, end = max(low, 0.0), min(high, top_mps)
        if not end > start:
            continue
        slope = (last - first) / (high - low) if math.isfinite(high) else 0.0
        constant = first - slope * low
        cuts = [start, end]
        if slope and start < (limit.force_n - constant) / slope < end:
            cuts.insert(1, (limit.force_n - constant) / slope)
        for one, two in pairwise(cuts):
            below = constant + slope * (one + two) / 2 <= limit.force_n
            found.append((one, two, constant, slope) if below else (one, two, limit.force_n, 0.0))
    return found


def _crossings(power_w: float, constant: float, slope: float, low: float, high: float) -> list[float]:
    """Speeds strictly between low and high at which constant + slope v = power / v."""
    if not math.isfinite(power_w):
        return []
    if slope == 0:
        roots = [power_w / constant] if constant > 0 else []
    else:
        inside = constant**2 + 4 * slope * power_w
        roots = [(-constant + sign * math.sqrt(inside)) / (2 * slope) for sign in (1, -1)] if inside >= 0 else []
    return [root for root in roots if low < root < high]
