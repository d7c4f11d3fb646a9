"""Functions and powers of numbers, as the language of goals has them; what would be no real number is refused."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from workbench.proof.claim import cosh, saturation, sinh
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.limits import LARGEST_EXPONENT
from workbench.proof.latex.vectors import is_vector

_ONE = {"tanh": sp.tanh, "sin": sp.sin, "cos": sp.cos, "arctan": sp.atan, "exp": sp.exp, "ln": sp.log, "sgn": sp.sign}
_BY_EXP = {"cosh": cosh, "sinh": sinh}
_MOST_ARGUMENTS = 20
_MOST_BITS = 100_000


def applied(name: str, arguments: Sequence[sp.Expr], position: int) -> sp.Expr:
    """A function of its arguments; LatexError for one that goals do not have."""
    if name in _ONE and len(arguments) == 1:
        if name == "ln" and arguments[0].is_Rational and arguments[0] <= 0:
            raise LatexError(f"ln({arguments[0]}) is no real number: correct it", position)
        return _ONE[name](arguments[0])
    if name in _BY_EXP and len(arguments) == 1:
        return _BY_EXP[name](arguments[0])
    if name == "tan" and len(arguments) == 1:
        return sp.sin(arguments[0]) / sp.cos(arguments[0])
    if name in ("max", "min") and 1 < len(arguments) <= _MOST_ARGUMENTS:
        return (sp.Max if name == "max" else sp.Min)(*arguments)
    if name == "sat" and len(arguments) == 3:
        return saturation(*arguments)
    if name == "sat" and len(arguments) == 1:
        raise LatexError("sat without its limits: write sat(x, low, high), or give sat(x) in the notation", position)
    if name in _ONE or name in _BY_EXP or name in ("tan", "max", "min", "sat"):
        raise LatexError(f"{name} with {len(arguments)} arguments: give it what it takes", position)
    raise LatexError(f"'{name}' has no meaning in goals: give the piece in the notation", position)


def power(base: sp.Expr, exponent: sp.Expr, position: int) -> sp.Expr:
    """base**exponent where that is a real number of moderate size."""
    if exponent.is_Rational:
        if abs(exponent) > LARGEST_EXPONENT:
            raise LatexError(f"the exponent {exponent} is too large: write at most {LARGEST_EXPONENT}", position)
        if base == 0 and exponent <= 0:
            raise LatexError(f"0 to the power {exponent} is no number: correct it", position)
        if base.is_Rational:
            if not exponent.is_Integer and base < 0:
                raise LatexError(f"{base} to the power {exponent} is no real number: correct it", position)
            bits = max(abs(base.p).bit_length(), base.q.bit_length()) * abs(exponent)
            if bits > _MOST_BITS:
                raise LatexError("a number of too many digits: write a smaller power", position)
    return base**exponent


def require_usual(base: sp.Expr | None, exponent: sp.Expr, position: int) -> None:
    """Raise LatexError for a power that goals do not have: of a column, or with another exponent."""
    if base is not None and is_vector(base):
        raise LatexError("a power of a vector: write a norm, a product of a row and a column, or a sum", position)
    if not exponent.is_Rational:
        raise LatexError(r"a power with letters in its exponent has no meaning in goals: write \exp(...), or give the "
                         "piece in the notation", position)
    if exponent.q > 2:
        raise LatexError(f"the power {exponent} has no meaning in goals: only whole and half ones have", position)


def divided(top: sp.Expr, bottom: sp.Expr, position: int) -> sp.Expr:
    """top/bottom."""
    if bottom == 0:
        raise LatexError("a division by zero: correct what stands below", position)
    return top / bottom
