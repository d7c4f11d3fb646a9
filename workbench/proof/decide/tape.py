"""Expressions as functions of columns of floating-point numbers.

Every part that stands in them is calculated once. Deciders look at most goals a few times only, so that translating an
expression must be as cheap as its values: this takes a tenth of the time of sympy's `lambdify`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import sympy as sp

FUNCTIONS: dict[type, Callable[[Any], Any]] = {
    sp.log: np.log, sp.exp: np.exp, sp.tanh: np.tanh, sp.sin: np.sin, sp.cos: np.cos, sp.tan: np.tan,
    sp.atan: np.arctan, sp.Abs: np.abs, sp.sign: np.sign}


class Tape:
    """Values of several expressions of the symbols; what is undefined or too large is nan or infinite.

    sizes: whether each value is followed by the sum of its terms' absolute values.

    Raises TypeError for an expression that is more than arithmetic, Max, Min and `FUNCTIONS`.
    """

    def __init__(self, symbols: Sequence[sp.Symbol], exprs: Sequence[sp.Expr], sizes: bool = False) -> None:
        self._places: dict[sp.Basic, int] = {}
        self._start: list[Any] = []  # inputs, then constants and room for what is calculated
        self._steps: list[tuple[int, Callable[..., Any], tuple[int, ...]]] = []
        for symbol in symbols:
            self._place_of(symbol, None)
        self._count = len(symbols)
        self._results: list[int] = []
        for expr in exprs:
            self._results.append(self._read(expr))
            if sizes:
                self._results.append(self._add(_size, [self._read(term) for term in sp.Add.make_args(expr)]))

    def __call__(self, *columns: Any) -> list[Any]:
        """The expressions' values, each a column or one number where none of the symbols stands in it."""
        values = list(self._start)
        values[:self._count] = columns
        for place, function, arguments in self._steps:
            values[place] = function(*[values[i] for i in arguments])
        return [values[place] for place in self._results]

    def _place_of(self, expr: sp.Basic, value: Any) -> int:
        self._start.append(value)
        self._places[expr] = len(self._start) - 1
        return len(self._start) - 1

    def _read(self, expr: sp.Basic) -> int:
        known = self._places.get(expr)
        if known is not None:
            return known
        if expr.is_number and not expr.args:
            return self._place_of(expr, _number(expr))
        place = self._add(*self._step(expr))
        self._places[expr] = place
        return place

    def _add(self, function: Callable[..., Any], parts: list[int]) -> int:
        self._start.append(None)
        self._steps.append((len(self._start) - 1, function, tuple(parts)))
        return len(self._start) - 1

    def _step(self, expr: sp.Basic) -> tuple[Callable[..., Any], list[int]]:
        if isinstance(expr, sp.Pow) and expr.base != sp.E:
            return self._power(expr)
        if isinstance(expr, (sp.Add, sp.Mul)):
            function = _sum if isinstance(expr, sp.Add) else _product
        elif isinstance(expr, (sp.Max, sp.Min)):
            function = _largest if isinstance(expr, sp.Max) else _smallest
        elif type(expr) in FUNCTIONS or isinstance(expr, sp.Pow):
            return FUNCTIONS.get(type(expr), np.exp), [self._read(expr.args[-1])]
        else:
            raise TypeError(f"{expr} is no expression of columns of numbers")
        return function, [self._read(part) for part in expr.args]

    def _power(self, expr: sp.Pow) -> tuple[Callable[..., Any], list[int]]:
        if isinstance(expr.exp, sp.Rational) and expr.exp.q == 2 and abs(expr.exp.p) == 1:
            return np.sqrt if expr.exp.p == 1 else _inverse_root, [self._read(expr.base)]
        return np.power, [self._read(expr.base), self._read(expr.exp)]


def _number(expr: sp.Basic) -> np.float64:
    try:
        return np.float64(int(expr.p) / int(expr.q)) if isinstance(expr, sp.Rational) else np.float64(expr)
    except (OverflowError, TypeError):  # too large, or no real number
        return np.float64(np.nan)


def _sum(*parts: Any) -> Any:
    total = parts[0]
    for part in parts[1:]:
        total = total + part
    return total


def _size(*parts: Any) -> Any:
    return _sum(*map(np.abs, parts))


def _product(*parts: Any) -> Any:
    total = parts[0]
    for part in parts[1:]:
        total = total * part
    return total


def _largest(*parts: Any) -> Any:
    total = parts[0]
    for part in parts[1:]:
        total = np.maximum(total, part)
    return total


def _smallest(*parts: Any) -> Any:
    total = parts[0]
    for part in parts[1:]:
        total = np.minimum(total, part)
    return total


def _inverse_root(part: Any) -> Any:
    return 1 / np.sqrt(part)
