"""Whether a rational function is zero, by its values at random points modulo a large prime.

This proposes only: a function that is zero by mistake would be refused by `checker.py`. It takes microseconds where
bringing everything over one denominator takes milliseconds.
"""

from __future__ import annotations

import random

import sympy as sp

from workbench.proof.derive import Side, Size

PRIME = 2**61 - 1
# Rational functions of these are zero where they are so for symbols; that sin and cos lie on a circle is a fact apart.
ON_THEIR_OWN = (sp.log, sp.tanh, sp.sin, sp.cos, sp.tan, sp.atan, sp.Abs, sp.sign, Size, Side, sp.Indexed)
TRIES, POINTS = 6, 2  # points tried, and those at which it has to vanish


class _NotRationalError(Exception):
    """Something stands in the expression that is no rational function of symbols."""


def vanishes(expr: sp.Expr) -> bool:
    """Whether the expression is zero as a rational function of its symbols; functions are symbols of their own."""
    if not expr.args:
        return bool(expr == 0)
    chance, seen = random.Random(1), 0
    for _ in range(TRIES):
        values: dict[sp.Basic, int] = {}
        try:
            if _value(expr, values, chance) != 0:
                return False
        except ZeroDivisionError:  # a denominator is zero there
            continue
        except _NotRationalError:
            break
        seen += 1
        if seen == POINTS:
            return True
    whole = sp.cancel(sp.together(expr))
    roots = any(power.base.is_Rational and not power.exp.is_Integer for power in whole.atoms(sp.Pow))
    return bool(whole == 0 or (roots and sp.expand(whole) == 0))


def _value(expr: sp.Basic, values: dict[sp.Basic, int], chance: random.Random) -> int:
    known = values.get(expr)
    if known is not None:
        return known
    if isinstance(expr, sp.Add):
        value = sum(_value(part, values, chance) for part in expr.args) % PRIME
    elif isinstance(expr, sp.Mul):
        value = 1
        for part in expr.args:
            value = value * _value(part, values, chance) % PRIME
    elif isinstance(expr, sp.Rational):
        value = expr.p * _inverse(expr.q) % PRIME
    elif isinstance(expr, (sp.Symbol, *ON_THEIR_OWN)):
        value = chance.randrange(1, PRIME)
    elif isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Integer):
        base = _value(expr.base, values, chance)
        value = pow(base, expr.exp.p, PRIME) if expr.exp.p >= 0 else pow(_inverse(base), -expr.exp.p, PRIME)
    else:  # powers of exp and of roots are related to each other
        raise _NotRationalError
    values[expr] = value
    return value


def _inverse(value: int) -> int:
    if value % PRIME == 0:
        raise ZeroDivisionError
    return value if value == 1 else pow(value, -1, PRIME)
