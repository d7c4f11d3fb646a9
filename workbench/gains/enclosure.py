"""Bounds of an expression over a box by interval arithmetic: exact for rationals, rounded outwards for functions.

Sums, products and whole powers are of fractions, so that a bound that is a simple number stays one; mpmath's intervals
bound sines, cosines, exponentials, logarithms and roots, and are widened to short fractions. Each occurrence of a
symbol is taken by itself, so the bounds hold but need not be the closest.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import product
from math import prod

import mpmath
import sympy as sp

from workbench.gains.exact import fraction

Interval = tuple[Fraction, Fraction]


def _tanh(bounds: mpmath.iv.mpf) -> mpmath.iv.mpf:
    """By one exponential, so that the bounds of its argument enter once."""
    return 1 - 2 / (mpmath.iv.exp(2 * bounds) + 1)


_FUNCTIONS = {sp.sin: mpmath.iv.sin, sp.cos: mpmath.iv.cos, sp.tan: mpmath.iv.tan, sp.exp: mpmath.iv.exp,
              sp.log: mpmath.iv.log, sp.tanh: _tanh}
DIGITS = 9  # of the fractions to which a function's bounds are widened


def stated_number(value: float) -> Fraction:
    """A float as the shortest decimal that is read as it: 0.1 is one tenth."""
    return Fraction(str(float(value)))


def enclosed(expr: sp.Expr, box: Mapping[sp.Symbol, Interval]) -> Interval:  # noqa: PLR0911 - a case a kind
    """Bounds of an expression whose symbols lie in a box; ValueError where it has none that are finite or known."""
    match expr:
        case sp.Rational():
            return fraction(expr), fraction(expr)
        case sp.Float():
            return stated_number(expr), stated_number(expr)
        case sp.Symbol() if expr in box:
            return box[expr]
        case sp.Add():
            parts = [enclosed(one, box) for one in expr.args]
            return sum((low for low, _ in parts), Fraction(0)), sum((high for _, high in parts), Fraction(0))
        case sp.Mul():
            ends = [prod(corner) for corner in product(*(enclosed(one, box) for one in expr.args))]
            return Fraction(min(ends)), Fraction(max(ends))
        case sp.Pow(base=base, exp=power) if power.is_Integer:
            return _power(enclosed(base, box), int(power))
    return _widened(_of_function(expr, box))


def _power(base: Interval, power: int) -> Interval:
    low, high = base
    if power < 0 and low <= 0 <= high:
        raise ValueError("a denominator may be zero")
    ends = [low**power, high**power]
    if power > 0 and power % 2 == 0 and low <= 0 <= high:
        ends.append(Fraction(0))
    return min(ends), max(ends)


def _of_function(expr: sp.Expr, box: Mapping[sp.Symbol, Interval]) -> mpmath.iv.mpf:
    if expr is sp.pi:
        return mpmath.iv.pi
    if isinstance(expr, sp.Pow) and expr.exp in (sp.S.Half, -sp.S.Half):
        low, high = enclosed(expr.base, box)
        if low < 0 or (low == 0 and expr.exp.is_negative):
            raise ValueError(f"{expr} is not defined everywhere")
        root = mpmath.iv.sqrt(_interval((low, high)))
        return root if expr.exp.is_positive else 1 / root
    if expr.func not in _FUNCTIONS:
        raise ValueError(f"bounds of {expr.func.__name__} are not known")
    return _FUNCTIONS[expr.func](_interval(enclosed(expr.args[0], box)))


def _interval(bounds: Interval) -> mpmath.iv.mpf:
    """mpmath's interval around exact bounds; the quotient is rounded outwards."""
    low, high = (mpmath.iv.mpf(end.numerator) / end.denominator for end in bounds)
    return mpmath.iv.mpf([low.a, high.b])


def _widened(found: mpmath.iv.mpf) -> Interval:
    low, high = (_exact(mpmath.mpf(end)) for end in (found.a, found.b))
    top = max(abs(low), abs(high))
    if not top:
        return low, high
    step = Fraction(10) ** (len(str(int(top))) - DIGITS if top >= 1 else -len(str(int(1 / top))) - DIGITS + 1)
    return low // step * step, -(-high // step) * step


def _exact(number: mpmath.mpf) -> Fraction:
    if not mpmath.isfinite(number):
        raise ValueError("a function has no finite bounds")
    return Fraction(int(abs(number).man)) * Fraction(2) ** int(number.exp) * (-1 if number < 0 else 1)
