"""Whether two expressions are the same by exact algebra: their difference is zero as a rational function."""

from __future__ import annotations

from collections.abc import Mapping
from math import comb

import sympy as sp
from sympy.polys.fields import sfield

from workbench.errors import ClaimError
from workbench.proof.claim import D
from workbench.proof.derive import expand_derivatives, formal_sums
from workbench.proof.latex.limits import MOST_TERMS

_FUNCTIONS = (sp.log, sp.exp, sp.tanh, sp.sign, sp.Max, sp.Min, D)


class TooLargeError(ClaimError):
    """Two expressions are too large to be compared."""


def same(first: sp.Expr, second: sp.Expr, flow: Mapping[sp.Expr, sp.Expr]) -> bool:
    """Whether two expressions are equal wherever they are defined, D(...) carried out along the flow.

    Functions are equal when their arguments are; of roots, sums and functions no further law is used.
    Raises TooLargeError.
    """
    if first == second:
        return True
    pair = [_carried(side, dict(flow)) for side in (first, second)]
    if pair[0] == pair[1]:
        return True
    limits = {total.limits for side in pair for total in side.atoms(sp.Sum)}
    if len(limits) > 1:
        return False
    return _Atoms().vanishes(sp.Add(pair[0], -pair[1]))


def _carried(expr: sp.Expr, flow: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    if not expr.has(D):
        return expr
    try:
        return expand_derivatives(expr, flow)
    except ClaimError:  # what has no derivative everywhere is equal to itself only
        return expr


class _Atoms:
    """Symbols in place of roots and functions, one for all that have the same arguments."""

    def __init__(self) -> None:
        self.known: dict[tuple[object, ...], list[tuple[tuple[sp.Expr, ...], sp.Symbol]]] = {}

    def vanishes(self, expr: sp.Expr) -> bool:
        """Whether an expression is zero, as a rational function of symbols, roots and functions."""
        try:
            flat = formal_sums(expr)
        except ClaimError:  # a product of sums
            return False
        return self.zero(self.flat(flat))

    def zero(self, expr: sp.Expr) -> bool:
        """Whether a rational function is zero."""
        if expr.is_Rational:
            return bool(expr == 0)
        if _size(expr) > MOST_TERMS:
            raise TooLargeError(f"an expression of more than {MOST_TERMS} terms is not compared: write it in parts")
        symbols = sorted(expr.free_symbols | expr.atoms(sp.Indexed), key=str)
        plain = dict(zip(symbols, sp.symbols(f"x0:{len(symbols)}", cls=sp.Dummy), strict=True))
        indexed = {symbol: plain[symbol] for symbol in symbols if isinstance(symbol, sp.Indexed)}
        return bool(sfield(expr.xreplace(indexed).xreplace(plain))[1] == 0)

    def flat(self, expr: sp.Expr) -> sp.Expr:
        """The expression with a symbol for each root and function in it."""
        if not expr.args or isinstance(expr, sp.Indexed):
            return self.symbol(("constant", expr), ()) if expr == sp.E else expr
        parts = [self.flat(part) for part in expr.args]
        if isinstance(expr, sp.Abs):  # |x| = x sgn x
            return parts[0] * self.symbol((sp.sign,), (parts[0],))
        if isinstance(expr, (sp.Max, sp.Min)):
            return self.symbol((expr.func, len(parts)), tuple(sorted(parts, key=str)))
        if isinstance(expr, _FUNCTIONS) or (isinstance(expr, sp.Pow) and not expr.exp.is_Integer):
            return self.symbol((expr.func,), tuple(parts))
        return expr.func(*parts)

    def symbol(self, kind: tuple[object, ...], arguments: tuple[sp.Expr, ...]) -> sp.Symbol:
        """The symbol of a function of arguments."""
        for others, symbol in self.known.setdefault(kind, []):
            if all(a == b or self.zero(a - b) for a, b in zip(arguments, others, strict=True)):
                return symbol
        symbol = sp.Dummy()
        self.known[kind].append((arguments, symbol))
        return symbol


def _size(expr: sp.Expr) -> int:
    """A bound on the number of terms when an expression is multiplied out."""
    if not expr.args or isinstance(expr, sp.Indexed):
        return 1
    sizes = [min(_size(part), MOST_TERMS + 1) for part in expr.args]
    if isinstance(expr, sp.Add):  # of fractions all denominators meet all other terms
        bottoms = 1
        for part in expr.args:
            bottoms = min(bottoms * _bottom(part), MOST_TERMS + 1)
        return sum(sizes) * bottoms
    if isinstance(expr, sp.Mul):
        total = 1
        for size in sizes:
            total = min(total * size, MOST_TERMS + 1)
        return total
    if isinstance(expr, sp.Pow) and expr.exp.is_Integer:
        count = int(abs(expr.exp))
        return min(comb(sizes[0] + count - 1, count), MOST_TERMS + 1) if sizes[0] > 1 else 1
    return 1


def _bottom(expr: sp.Expr) -> int:
    bottoms = [part for part in sp.Mul.make_args(expr) if isinstance(part, sp.Pow) and part.exp.is_negative]
    total = 1
    for part in bottoms:
        total = min(total * _size(part), MOST_TERMS + 1)
    return total
