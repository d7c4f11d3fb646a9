"""The value of an expression in a finite field: expressions whose values differ are not the same by algebra."""

from __future__ import annotations

import hashlib
from functools import reduce

import sympy as sp

PRIME = 2**61 - 1


class DivisionByZeroError(ArithmeticError):
    """A denominator is zero in the finite field, which says nothing of the expression."""


def residue(expr: sp.Expr, known: dict[sp.Expr, int]) -> int:
    """The value where symbols, roots and functions stand for values drawn from their names and arguments.

    A sum counts as its summand times one fixed value, |x| as x sgn x. `known` keeps what has been found.
    Raises DivisionByZeroError.
    """
    found = known.get(expr)
    if found is None:
        found = known[expr] = _residue(expr, known)
    return found


def _residue(expr: sp.Expr, known: dict[sp.Expr, int]) -> int:
    if isinstance(expr, sp.Rational):
        return int(expr.p) * _inverse(int(expr.q)) % PRIME
    if isinstance(expr, sp.Indexed) or not expr.args:
        return _drawn("symbol", repr(expr), sorted(map(str, expr.assumptions0.items())))
    if isinstance(expr, sp.Sum):
        return _drawn("sum") * residue(expr.function, known) % PRIME
    return _combined(expr, [residue(part, known) for part in expr.args])


def _combined(expr: sp.Expr, values: list[int]) -> int:
    """The value of an expression whose parts have these values."""
    if isinstance(expr, sp.Add):
        return sum(values) % PRIME
    if isinstance(expr, sp.Mul):
        return reduce(lambda total, value: total * value % PRIME, values)
    if isinstance(expr, sp.Pow) and expr.exp.is_Integer:
        power = int(expr.exp)
        return pow(values[0] if power > 0 else _inverse(values[0]), abs(power), PRIME)
    if isinstance(expr, sp.Abs):
        return values[0] * _drawn("sign", values) % PRIME
    if isinstance(expr, (sp.Max, sp.Min)):
        values.sort()
    return _drawn(expr.func.__name__, values)


def _inverse(value: int) -> int:
    if value % PRIME == 0:
        raise DivisionByZeroError
    return pow(value, -1, PRIME)


def _drawn(*what: object) -> int:
    return int.from_bytes(hashlib.blake2b(repr(what).encode(), digest_size=8).digest()) % PRIME
