"""Whether two expressions are the same by exact algebra: their difference is zero as a rational function."""

from __future__ import annotations

from collections.abc import Mapping
from math import comb

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import D
from workbench.proof.derive import SUM, expand_derivatives, formal_sums
from workbench.proof.latex.limits import MOST_TERMS
from workbench.proof.latex.residue import DivisionByZeroError, exponents, residue
from workbench.proof.latex.vanish import is_zero

_FUNCTIONS = (sp.log, sp.exp, sp.tanh, sp.sin, sp.cos, sp.tan, sp.atan, sp.sign, sp.Max, sp.Min, D)


class Comparison:
    """Compares expressions along one flow; `too_large` says whether two were too large to be compared."""

    def __init__(self, flow: Mapping[sp.Expr, sp.Expr]) -> None:
        self.flow = dict(flow)
        self.too_large = False
        self._carried: dict[sp.Expr, sp.Expr] = {}
        self._residues: dict[sp.Expr, int] = {}
        self._equal: dict[frozenset[sp.Expr], bool] = {}

    def same(self, first: sp.Expr, second: sp.Expr) -> bool:
        """Whether two expressions are equal wherever they are defined, D(...) carried out along the flow.

        Functions are equal when their arguments are, and exp of a sum is a product; no further law of functions, roots
        and sums is used.
        """
        pair = frozenset((first, second))
        if pair not in self._equal:
            self._equal[pair] = self._compare(self.carried(first), self.carried(second))
        return self._equal[pair]

    def carried(self, expr: sp.Expr) -> sp.Expr:
        """The expression with its derivatives carried out; what has none everywhere is equal to itself only."""
        if expr not in self._carried:
            try:
                self._carried[expr] = expand_derivatives(expr, self.flow) if expr.has(D) else expr
            except ClaimError:
                self._carried[expr] = expr
        return self._carried[expr]

    def _compare(self, first: sp.Expr, second: sp.Expr) -> bool:
        if first == second:
            return True
        if len({total.limits for side in (first, second) for total in side.atoms(sp.Sum)}) > 1:
            return False
        try:
            if residue(first, self._residues) != residue(second, self._residues):
                return False
        except DivisionByZeroError:
            pass  # decided below
        try:
            return _Atoms().vanishes(first - second)
        except TooLargeError:
            self.too_large = True
            return False


class TooLargeError(ClaimError):
    """Two expressions are too large to be compared."""


class _Atoms:
    """Symbols in place of roots and functions, one for all that have the same arguments."""

    def __init__(self) -> None:
        self.known: dict[tuple[object, ...], list[tuple[tuple[sp.Expr, ...], sp.Symbol]]] = {}

    def vanishes(self, expr: sp.Expr) -> bool:
        """Whether an expression is zero, as a rational function of symbols, roots and functions."""
        if _sums_multiplied(expr) <= 1:
            return self.zero(self.flat(expr.replace(sp.Sum, lambda term, *_: SUM * term)))
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
        return is_zero(expr)

    def flat(self, expr: sp.Expr) -> sp.Expr:
        """The expression with a symbol for each root and function in it."""
        if not expr.args or isinstance(expr, sp.Indexed):
            return self.symbol((sp.exp, 1), (sp.S.One,)) if expr == sp.E else expr
        parts = [self.flat(part) for part in expr.args]
        if isinstance(expr, sp.Abs):  # |x| = x sgn x
            return parts[0] * self.symbol((sp.sign,), (parts[0],))
        if isinstance(expr, (sp.Max, sp.Min)):
            return self.symbol((expr.func, len(parts)), tuple(sorted(parts, key=str)))
        if isinstance(expr, sp.exp):
            return sp.Mul(*(self.symbol((sp.exp, count.q), (self.flat(term),)) ** count.p
                            for count, term in exponents(expr.args[0])))
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


def _sums_multiplied(expr: sp.Expr) -> int:
    """How many sums are multiplied with each other in an expression, at most; 2 where one stands below or in a root."""
    if isinstance(expr, sp.Sum):
        return 1
    parts = [_sums_multiplied(part) for part in expr.args if isinstance(part, sp.Expr)]
    if isinstance(expr, sp.Mul):
        return sum(parts)
    if isinstance(expr, sp.Pow):
        return parts[0] * int(expr.exp) if expr.exp.is_Integer and expr.exp > 0 else 2 * parts[0]
    most = max(parts, default=0)
    return most if isinstance(expr, sp.Add) else 2 * most


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
    total = 1
    for part in sp.Mul.make_args(expr):
        if isinstance(part, sp.Pow) and part.exp.is_negative:
            total = min(total * _size(part), MOST_TERMS + 1)
    return total
