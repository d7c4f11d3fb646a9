"""Columns of trial values, tidy ones first, and the way back from a float to a tidy fraction."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import sympy as sp

from workbench.proof.decide.landscape import Numbers

TIDY = np.array([0.0, 1.0, -1.0, 0.5, 2.0, -2.0, 3.0, -0.5, 4.0])
EXTREME = np.array([1e-6, 1e-4, 1e-3, 1e-2, 1e2, 1e3, 1e4, 1e6])
DENOMINATORS = (1, 100, 10**4, 10**7, 10**9)
SHAPES = 6


def trial_columns(symbols: Sequence[sp.Symbol], count: int, rng: np.random.Generator) -> dict[sp.Symbol, Numbers]:
    """`count` points: nearly all 0 or 1, of tidy values, of several magnitudes, with extremes, with coincidences,
    and scaled as a whole."""
    shape = np.sort(rng.integers(0, SHAPES, count))  # the tidy ones come first
    row_scale = np.where(shape == 5, rng.choice(EXTREME, count), 1.0)
    columns: dict[sp.Symbol, Numbers] = {}
    for symbol in symbols:
        tidy = rng.choice(TIDY, count)
        wide = rng.integers(-100, 101, count) / 40 * rng.choice([0.01, 0.1, 1.0, 10.0, 100.0], count)
        value = np.where(shape <= 1, tidy, np.where(rng.random(count) < 0.3, tidy, wide))
        value = np.where((shape == 0) & (rng.random(count) < 0.8), 1.0 if symbol.is_nonnegative else 0.0, value)
        extreme = rng.choice(EXTREME, count) * rng.choice([-1.0, 1.0], count)
        value = np.where((shape == 3) & (rng.random(count) < 0.4), extreme, value)
        if columns:  # the same as another symbol, or its opposite
            others = np.array(list(columns.values()))
            other = others[rng.integers(0, len(others), count), np.arange(count)] * rng.choice([1.0, 1.0, -1.0], count)
            value = np.where((shape == 4) & (rng.random(count) < 0.5), other, value)
        columns[symbol] = value
    return {s: within_sign(s, v * row_scale) for s, v in columns.items()}


def within_sign(symbol: sp.Symbol, values: Numbers) -> Numbers:
    """Values moved to where sympy knows the symbol to be."""
    if symbol.is_positive:
        return np.where(values == 0, 1.0, np.abs(values))
    return np.abs(values) if symbol.is_nonnegative else values


def tidy_fraction(value: float) -> Fraction:
    """The fraction of smallest denominator that rounds to this float, as far as one is known."""
    exact = Fraction(value)
    for denominator in DENOMINATORS:
        candidate = exact.limit_denominator(denominator)
        if float(candidate) == value:
            return candidate
    return exact
