"""Exact values of expressions at rational points, without sympy's cost of building an expression for each."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import name_of

Values = dict[str, Fraction]
Exact = Callable[[Values], "Fraction | None"]


def exact_function(expr: sp.Expr) -> Exact:
    """The expression's value at a point by name; None where it is undefined or no rational number."""
    if all(part.is_Symbol or part.is_Rational or part.is_Add or part.is_Mul
           or (part.is_Pow and part.exp.is_Integer) for part in sp.preorder_traversal(expr)):
        def rational(point: Values) -> Fraction | None:
            try:
                return _value(expr, point)
            except (ZeroDivisionError, KeyError):
                return None

        return rational

    def substituted(point: Values) -> Fraction | None:
        value = expr.xreplace({s: sp.Rational(point[name].numerator, point[name].denominator)
                               for s in expr.free_symbols if (name := name_of(s)) in point})
        return Fraction(int(value.p), int(value.q)) if value.is_Rational else None

    return substituted


def _value(expr: sp.Basic, point: Values) -> Fraction:
    if isinstance(expr, sp.Symbol):
        return point[name_of(expr)]
    if isinstance(expr, sp.Rational):
        return Fraction(expr.p, expr.q)
    if isinstance(expr, sp.Pow):
        return _value(expr.base, point) ** int(expr.exp)
    first, *others = (_value(part, point) for part in expr.args)
    for other in others:
        first = first + other if expr.is_Add else first * other
    return first
