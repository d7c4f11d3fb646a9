"""Local search: many points at once move at random and keep what brings them nearer to a counterexample."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy as sp

from workbench.proof.decide.boundary_points import Family
from workbench.proof.decide.landscape import Landscape, Numbers
from workbench.proof.decide.sampling import trial_columns, within_sign

WALKERS, STEPS, BEST = 160, 120, 6
DIGITS = (1, 2, 3, 5, 8, 12)
PENALTY, FAR = 10.0, 1e6

Columns = dict[sp.Symbol, Numbers]


def local_search(landscape: Landscape, family: Family, break_shown: bool, rng: np.random.Generator) -> Columns:
    """Columns of the best points reached, each rounded to fewer and more digits; tidy ones first."""
    free = family.free
    if not free:
        return {}
    walkers = trial_columns(free, WALKERS, rng)
    height = _height(landscape, family, break_shown, walkers)
    for step in range(STEPS):
        moved = _moved(walkers, rng, fine=step / STEPS)
        reached = _height(landscape, family, break_shown, moved)
        better = reached > height
        height = np.where(better, reached, height)
        walkers = {s: np.where(better, moved[s], c) for s, c in walkers.items()}
    order = np.argsort(-height, kind="stable")[:BEST]
    return {s: np.concatenate([_rounded(c[order], digits) for digits in DIGITS]) for s, c in walkers.items()}


def _height(landscape: Landscape, family: Family, break_shown: bool, chosen: Columns) -> Numbers:
    violation, excess = landscape.look(family.columns(chosen))
    height: Numbers = (excess if break_shown else np.zeros_like(excess)) - PENALTY * np.minimum(violation, FAR)
    return np.where(np.isfinite(height), height, -np.inf)


def _moved(walkers: Columns, rng: np.random.Generator, fine: float) -> Columns:
    """Every walker with about half of its values changed: scaled, shifted, mixed with another's, or set equal."""
    count = len(next(iter(walkers.values())))
    width = 10.0 ** rng.uniform(-1 - 5 * fine, 0.5 - 2 * fine, count)
    one, two = rng.integers(0, count, (2, count))
    share = rng.choice([0.15, 0.5, 1.0], count)
    kind = rng.integers(0, 4, count)
    moved: Columns = {}
    for symbol, values in walkers.items():
        scaled = values * (1 + width * rng.normal(size=count))
        shifted = values + width * rng.normal(size=count)
        mixed = values + rng.uniform(0, 1, count) * (values[one] - values[two])
        jumped = values * 10.0 ** (2 * rng.normal(size=count) * (1 - fine))
        new = np.choose(kind, [scaled, shifted, mixed, jumped])
        moved[symbol] = within_sign(symbol, np.where(rng.random(count) < share, new, values))
    return moved


def _rounded(values: Numbers, digits: int) -> Numbers:
    """Values to so many significant digits."""
    return np.array([float(f"{v:.{digits - 1}e}") for v in values])


def rows(columns: Columns) -> Iterator[dict[sp.Symbol, float]]:
    """The points that columns hold, one by one."""
    for place in range(len(next(iter(columns.values()), ()))):
        yield {s: float(c[place]) for s, c in columns.items()}
