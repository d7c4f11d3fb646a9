"""Points at which assumptions hold, and a relation fails if asked for, by damped least squares from a few starts.

All starts go down at once. Inequalities count until they hold with some room, so that rounding keeps them; bounds of
single symbols say where to start. Thin regions and curved surfaces, which random points miss, are reached this way.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy as sp

from workbench.proof.decide.boundary_points import Family
from workbench.proof.decide.landscape import Landscape, Numbers
from workbench.proof.decide.sampling import within_sign

STARTS, STEPS, BEST = 24, 25, 6
ROOM = np.array([0.3, 3e-2, 1e-3, 1e-5])  # of a margin, relative to the sum of its terms' sizes
DIGITS = (2, 4, 7, 11)
PLACES = (1, 2)  # after the point, to which the best points are rounded first: what is nearly zero becomes zero
DIFFERENCE, LARGEST = 1e-7, 1e8
OPEN = np.repeat((4.0, 0.4, 30.0), 4)  # how far points start from a bound where there is none on the other side

Columns = dict[sp.Symbol, Numbers]


def descended(landscape: Landscape, family: Family, break_shown: bool, rng: np.random.Generator) -> Numbers:
    """The best points reached, of shape (points, free symbols of the family); it must have some.

    A step counts as better by the sizes of terms at the point that it leaves: relative to its own sizes a margin may
    stay as large all the way down, as that of x**2 - 1/100 does from x = 10 to x = 1.
    """
    free = family.free
    points, room = _starts(landscape, free, rng), np.resize(ROOM, STARTS)
    damping = np.full(STARTS, 1e-2)
    values, slopes, sizes = _residuals(landscape, family, free, points, room, break_shown)
    for _ in range(STEPS):
        height = np.sum(values**2, axis=1)
        if np.sum(height == 0) >= BEST:
            break
        normal = np.einsum("bij,bik->bjk", slopes, slopes)
        scale = np.einsum("bjj->bj", normal)
        normal = normal + np.einsum("b,bj,jk->bjk", damping, scale + 1e-12, np.eye(len(free)))
        step = np.linalg.solve(normal, -np.einsum("bij,bi->bj", slopes, values)[..., None])[..., 0]
        moved = np.clip(points + step, -LARGEST, LARGEST)
        moved = np.stack([within_sign(s, c) for s, c in zip(free, moved.T, strict=True)], axis=1)
        tried, tried_slopes, tried_sizes = _residuals(landscape, family, free, moved, room, break_shown)
        with np.errstate(all="ignore"):
            better = np.sum((tried * (tried_sizes / sizes))**2, axis=1) < height
        points, values = np.where(better[:, None], moved, points), np.where(better[:, None], tried, values)
        slopes = np.where(better[:, None, None], tried_slopes, slopes)
        sizes = np.where(better[:, None], tried_sizes, sizes)
        damping = np.clip(np.where(better, damping * 0.2, damping * 5), 1e-12, 1e8)
    order = np.argsort(np.sum(values**2, axis=1), kind="stable")[:BEST]
    return points[order]


def rounded(family: Family, points: Numbers) -> Iterator[Columns]:
    """Points as columns, rounded to few digits first, then to more."""
    for places in PLACES:
        yield {s: np.round(points[:, i], places) for i, s in enumerate(family.free)}
    for digits in DIGITS:
        yield {s: np.array([float(f"{v:.{digits - 1}e}") for v in points[:, i]]) for i, s in enumerate(family.free)}


def _residuals(landscape: Landscape, family: Family, free: list[sp.Symbol], points: Numbers, room: Numbers,
               break_shown: bool) -> tuple[Numbers, Numbers, Numbers]:
    """Residuals of shape (points, relations), their derivatives of shape (points, relations, symbols), and the sums of
    terms' sizes, of which residuals are shares."""
    count, size = points.shape
    width = DIFFERENCE * (1 + np.abs(points))
    around = np.concatenate([points, *(points + width * unit for unit in np.eye(size))])
    margins, sizes = landscape.margins(family.columns({s: around[:, i] for i, s in enumerate(free)}))
    margins = margins.reshape(size + 1, count, -1)
    with np.errstate(all="ignore"):
        scale = sizes[:count] + 1e-300
        first = margins[0] / scale
        slopes = np.moveaxis((margins[1:] - margins[0]) / scale / np.moveaxis(width, 1, 0)[..., None], 0, 2)
    values, signs = np.zeros_like(first), np.zeros_like(first)
    for k, (operator, shown) in enumerate(landscape.operators()):
        # Nearly every point breaks an equality, or meets a relation that two sides differ.
        if (shown and not break_shown) or (operator == ("==" if shown else "!=")):
            continue
        if operator in ("==", "!="):
            values[:, k], signs[:, k] = first[:, k], 1.0
        else:
            turn = -1.0 if shown else 1.0
            short = np.maximum(0.0, room - turn * first[:, k])
            values[:, k], signs[:, k] = short, np.where(short > 0, -turn, 0.0)
    bad = ~np.isfinite(first).all(axis=1) | ~np.isfinite(slopes).all(axis=(1, 2))
    values[bad], slopes[bad] = 1e6, 0.0
    return values, slopes * signs[..., None], scale


def _starts(landscape: Landscape, free: list[sp.Symbol], rng: np.random.Generator) -> Numbers:
    """The middle of the box that the bounds of single symbols make, and random points in it, some farther out where it
    is open."""
    low, high = bounds_of(landscape, free)
    below, above = np.isfinite(low), np.isfinite(high)
    far = np.resize(OPEN, (STARTS, 1))
    least = np.where(below, low, np.where(above, high, far / 2) - far)
    most = np.where(above, high, np.where(below, low, -far / 2) + far)
    middle, reach = (least + most) / 2, (most - least) / 2
    points = middle + reach * rng.uniform(-1, 1, (STARTS, len(free)))
    points[0] = middle[0]
    return np.stack([within_sign(s, c) for s, c in zip(free, points.T, strict=True)], axis=1)


def bounds_of(landscape: Landscape, free: list[sp.Symbol]) -> tuple[Numbers, Numbers]:
    """The least and the largest value of each symbol by assumptions of it alone, infinite where there is none."""
    low, high = np.full(len(free), -np.inf), np.full(len(free), np.inf)
    for operator, margin in landscape.given:
        if operator in (">", ">=") and len(margin.free_symbols) == 1:
            symbol, = margin.free_symbols
            slope = sp.diff(margin, symbol)
            if symbol in free and slope.is_Rational and slope != 0:
                end, place = float(-margin.xreplace({symbol: sp.S.Zero}) / slope), free.index(symbol)
                if slope > 0:
                    low[place] = max(low[place], end)
                else:
                    high[place] = min(high[place], end)
    return low, high
