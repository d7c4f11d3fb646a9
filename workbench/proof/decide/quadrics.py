"""Rational points of spheres, ellipsoids and other quadrics: lines through one rational point meet them in all others.

So what is assumed of unit vectors, rotations and unit quaternions is met exactly by points that can be drawn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from math import isqrt, prod

import sympy as sp

from workbench.proof.claim import Goal
from workbench.proof.decide.boundary_points import Family, equations
from workbench.proof.decide.landscape import landscape_of
from workbench.proof.decide.once import once_per_goal

MOST_SYMBOLS = 6  # of a quadric: a rational point is sought among 3^(n - 1) lines along each axis
ON_LINES = (Fraction(0), Fraction(1), Fraction(-1))


@once_per_goal
def on_quadrics(goal: Goal) -> Family | None:
    """The points at which all equalities that are assumed hold, one of them a quadric at least; None where some are
    others, or no rational point is found."""
    landscape = landscape_of(goal)
    family, curved = Family(landscape.symbols), []
    for equation in equations(landscape):
        here = equation.xreplace(family.bound)
        if not _holds_linearly(family, here):
            curved.append(equation)
    for equation in curved:
        points = _parametrised(equation.xreplace(family.bound), landscape.symbols)
        if points is None:
            return None
        family.bind(points)
    return family if curved else None


def _holds_linearly(family: Family, equation: sp.Expr) -> bool:
    """Take an equation in that gives one symbol by others."""
    for symbol in sorted(equation.free_symbols & set(family.symbols), key=str):
        slope = sp.expand(sp.diff(equation, symbol))
        if slope.is_Rational and slope != 0:
            family.bind({symbol: sp.expand(-equation.xreplace({symbol: sp.Integer(0)}) / slope)})
            return True
    return False


def _parametrised(equation: sp.Expr, symbols: Sequence[sp.Symbol]) -> dict[sp.Symbol, sp.Expr] | None:
    """Every symbol of a quadric by the direction of a line through one of its points; None of what is none."""
    unknown = sorted(equation.free_symbols & set(symbols), key=str)
    if not 2 <= len(unknown) <= MOST_SYMBOLS or equation.free_symbols - set(unknown):
        return None
    try:
        quadric = sp.Poly(equation, *unknown, domain=sp.QQ)
    except (sp.PolynomialError, sp.CoercionFailed):
        return None
    if quadric.total_degree() != 2:
        return None
    start = next(_rational_points(quadric), None)
    if start is None:
        return None
    along = [sp.Dummy(f"along_{symbol}", real=True) for symbol in unknown]
    slope = sum((rate * d for rate, d in zip(_slopes(quadric, start), along, strict=True)), sp.Integer(0))
    squares = sum((c * sp.prod([d**e for d, e in zip(along, powers, strict=True)]) for powers, c in quadric.terms()
                   if sum(powers) == 2), sp.Integer(0))
    return {symbol: value - d * slope / squares for symbol, value, d in zip(unknown, start, along, strict=True)}


def _rational_points(quadric: sp.Poly) -> Iterator[tuple[sp.Rational, ...]]:
    """Rational points at which the quadric is smooth, on lines along the axes."""
    rows = [(powers, Fraction(int(c.p), int(c.q))) for powers, c in quadric.terms()]
    count = len(quadric.gens)
    for place in range(count):
        for others in product(ON_LINES, repeat=count - 1):
            values = [*others[:place], Fraction(0), *others[place:]]
            c = [Fraction(0)] * 3
            for powers, coefficient in rows:
                c[powers[place]] += coefficient * prod(values[i] ** e for i, e in enumerate(powers) if i != place)
            for root in _rational_roots(*c):
                here = (*values[:place], root, *values[place + 1:])
                point = tuple(sp.Rational(v.numerator, v.denominator) for v in here)
                if any(_slopes(quadric, point)):
                    yield point


def _slopes(quadric: sp.Poly, point: Sequence[sp.Rational]) -> list[sp.Expr]:
    """Its rates at a point, one by each symbol."""
    here = dict(zip(quadric.gens, point, strict=True))
    return [quadric.diff(symbol).as_expr().xreplace(here) for symbol in quadric.gens]


def _rational_roots(constant: Fraction, slope: Fraction, square: Fraction) -> Iterator[Fraction]:
    """Of a quadratic in one unknown, or of what is linear in it."""
    if square == 0:
        yield from (-constant / slope,) if slope else ()
        return
    inner = slope**2 - 4 * square * constant
    if inner < 0:
        return
    root = Fraction(isqrt(inner.numerator), isqrt(inner.denominator))
    if root**2 == inner:
        yield from ((-slope + sign * root) / (2 * square) for sign in (1, -1))
