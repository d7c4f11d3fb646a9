"""Whether a rational function is zero, by multiplying out over the rational numbers."""

from __future__ import annotations

from functools import reduce
from typing import Any

import sympy as sp
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

Fraction = tuple[Any, Any]  # numerator and denominator, polynomials of one ring


def is_zero(expr: sp.Expr) -> bool:
    """Whether an expression of + * and whole powers is zero, all else in it taken for symbols; False where a
    denominator is zero."""
    symbols = sorted(_symbols(expr), key=str)
    ring = PolyRing([f"x{number}" for number in range(len(symbols))], QQ, lex)
    known = dict(zip(symbols, ring.gens, strict=True))
    top, bottom = _fraction(expr, known, ring)
    return not top and bool(bottom)


def _symbols(expr: sp.Expr) -> set[sp.Expr]:
    if isinstance(expr, sp.Rational):
        return set()
    if isinstance(expr, (sp.Add, sp.Mul)) or (isinstance(expr, sp.Pow) and expr.exp.is_Integer):
        return set().union(*(_symbols(part) for part in expr.args))
    return {expr}


def _fraction(expr: sp.Expr, known: dict[sp.Expr, Any], ring: PolyRing) -> Fraction:
    if isinstance(expr, sp.Rational):
        return ring(QQ(int(expr.p), int(expr.q))), ring.one
    if expr in known:
        return known[expr], ring.one
    parts = [_fraction(part, known, ring) for part in expr.args]
    if isinstance(expr, sp.Mul):
        return reduce(lambda a, b: (a[0] * b[0], a[1] * b[1]), parts)
    if isinstance(expr, sp.Pow):
        count = int(expr.exp)
        top, bottom = parts[0] if count >= 0 else parts[0][::-1]
        return top ** abs(count), bottom ** abs(count)
    tops: dict[Any, Any] = {}
    for top, bottom in parts:  # what has one denominator is added first
        tops[bottom] = tops.get(bottom, ring.zero) + top
    added = ((top, bottom) for bottom, top in tops.items())
    return reduce(lambda a, b: (a[0] * b[1] + b[0] * a[1], a[1] * b[1]), added)
