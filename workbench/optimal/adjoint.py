"""From the dual of the cone program to the function p(s) of a bound."""

from __future__ import annotations

import numpy as np

from workbench.optimal.bound import Certificate
from workbench.optimal.course import Array
from workbench.optimal.grid import kept_borders
from workbench.optimal.socp import Plan

# Parts of half an interval: enough that p, which goes like 1/v near a stop, is nearly linear on each.
MOST_PARTS = 60
RATIO = 1.08


def certificate_from(plan: Plan) -> Certificate:
    """p through the dual values at the middles of the intervals, linear in 1/v between them; jumps at borders.

    p may jump where a stop or another limit begins; there it is continued from each side on its own.
    """
    grid = plan.grid
    s, p = grid.position_m, plan.adjoint
    middle = (s[1:] + s[:-1]) / 2
    breaks = np.isin(s, kept_borders(grid.course))
    at, left, right = [s[:1]], [], []
    for k in range(len(p)):
        for start, end, other in ((s[k], middle[k], k - 1), (middle[k], s[k + 1], k + 1)):
            border = breaks[k] if other < k else breaks[k + 1]
            far = 2 * k - other if border else other
            if not 0 <= far < len(p) or (border and breaks[k + 1 if other < k else k]):
                far = k
            points = _parts(start, end, plan, k)
            values = _between(points, plan, k, far, middle)
            at.append(points[1:])
            left.append(values[:-1])
            right.append(values[1:])
    return Certificate(np.concatenate(at), np.concatenate(left), np.concatenate(right), max(plan.time_price_w, 0.0))


def _half_square(points: Array, plan: Plan, k: int) -> Array:
    s, b = plan.grid.position_m, plan.half_square
    return np.asarray(b[k] + (b[k + 1] - b[k]) * (points - s[k]) / (s[k + 1] - s[k]))


def _parts(start: float, end: float, plan: Plan, k: int) -> Array:
    """Positions from start to end with about equal ratios of speed, and a short last cell at a standstill."""
    b = _half_square(np.array([start, end]), plan, k)
    low, high = float(b.min()), float(b.max())
    if high <= low * RATIO**2 or high == 0:
        return np.array([start, end])
    floor = max(low, high * RATIO ** (-2 * MOST_PARTS))
    count = int(np.ceil(np.log(high / floor) / (2 * np.log(RATIO))))
    levels = np.geomspace(floor, high, count + 1)
    levels[-1] = high
    if floor > low:
        levels = np.insert(levels, 0, low)
    else:
        levels[0] = low
    share = (levels - b[0]) / (b[1] - b[0])
    points = start + np.sort(share) * (end - start)
    points[0], points[-1] = start, end
    return np.asarray(np.unique(points))


def _between(points: Array, plan: Plan, k: int, far: int, middle: Array) -> Array:
    """p at points of interval k, by the line in 1/v through its middle and that of interval `far`."""
    p = plan.adjoint
    if far == k:
        return np.full(len(points), p[k])
    here, there = (float(_half_square(middle[j:j + 1], plan, j)[0]) for j in (k, far))
    border = plan.half_square[max(k, far)] if abs(k - far) == 1 else 0.0
    monotone = here < border < there or here > border > there
    with np.errstate(divide="ignore"):
        inverse = 1 / np.sqrt(2 * _half_square(points, plan, k))
    if monotone and abs(here - there) > 1e-3 * max(here, there):
        one, two = 1 / np.sqrt(2 * here), 1 / np.sqrt(2 * there)
        # At a standstill 1/v has no value; the cell that ends there is short, so that a constant serves.
        inverse = np.where(np.isfinite(inverse), inverse, inverse[np.isfinite(inverse)].max(initial=one))
        return np.asarray(p[k] + (p[far] - p[k]) * (inverse - one) / (two - one))
    return np.asarray(p[k] + (p[far] - p[k]) * (points - middle[k]) / (middle[far] - middle[k]))
