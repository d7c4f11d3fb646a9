"""An expression as a reader would write it: of the same value, without what was put in as zero or one."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.latex.letters import LOGARITHM


def tidied(expr: sp.Expr) -> sp.Expr:
    """The expression without terms of zero, factors and powers of one; e^log_m is m. Nothing else is multiplied out,
    and a product with zero stays where one of its factors may not be defined."""
    if not expr.args or isinstance(expr, sp.Indexed):
        return expr
    if isinstance(expr, sp.Sum):
        inside = tidied(expr.function)
        return sp.S.Zero if inside == 0 else expr if inside is expr.function else sp.Sum(inside, *expr.limits)
    args = tuple(map(tidied, expr.args))
    rule = _RULES.get(expr.func)
    if rule is not None:
        found = rule(args)
        if found is not None:
            return found
    elif isinstance(expr, sp.Function) and set(args) == {sp.S.Zero}:
        value = sp.S.Zero if expr.func.__name__ == "D" else expr.func(*args)
        if value.is_Integer:
            return value
    unchanged = all(new is old for new, old in zip(args, expr.args, strict=True))
    return expr if unchanged else expr.func(*args, evaluate=False)


def _sum(args: tuple[sp.Expr, ...]) -> sp.Expr:
    terms = [arg for arg in args if arg != 0]
    if all(term.is_Rational for term in terms):
        return sp.Add(*terms)
    return terms[0] if len(terms) == 1 else sp.Add(*terms, evaluate=False)


def _product(args: tuple[sp.Expr, ...]) -> sp.Expr:
    if sp.S.Zero in args and all(map(_defined, args)):
        return sp.S.Zero
    factors = [arg for arg in args if arg != 1]
    if all(factor.is_Rational for factor in factors):
        return sp.Mul(*factors)
    return factors[0] if len(factors) == 1 else sp.Mul(*factors, evaluate=False)


def _defined(expr: sp.Expr) -> bool:
    """Whether an expression is known to have a value, whatever its letters are."""
    if isinstance(expr, sp.Pow) and not (expr.exp.is_Integer and expr.exp > 0):
        base = expr.base.is_nonnegative if expr.exp.is_positive else (
            expr.base.is_zero is False if expr.exp.is_integer else expr.base.is_positive)
        return bool(base) and _defined(expr.base) and _defined(expr.exp)
    if isinstance(expr, sp.log) and not expr.args[0].is_positive:
        return False
    return isinstance(expr, sp.Indexed) or all(map(_defined, expr.args))


def _power(args: tuple[sp.Expr, ...]) -> sp.Expr | None:
    base, exponent = args
    if (base == 0 and exponent.is_positive) or exponent == 1:
        return base
    if base == 1 or (base.is_Rational and base != 0 and exponent == -1):
        return sp.S.One / base
    return None


def _exponential(args: tuple[sp.Expr, ...]) -> sp.Expr | None:
    if args[0] == 0:
        return sp.S.One
    number, letter = args[0].as_coeff_Mul()
    positive = _of_logarithm(letter)
    return None if positive is None or number not in (1, -1) else positive**number


def _of_logarithm(letter: sp.Expr) -> sp.Expr | None:
    """The letter whose logarithm this one is."""
    name = str(letter.base.label if isinstance(letter, sp.Indexed) else letter)
    if not name.startswith(LOGARITHM) or not isinstance(letter, sp.Indexed | sp.Symbol):
        return None
    name = name.removeprefix(LOGARITHM)
    if isinstance(letter, sp.Indexed):
        return sp.IndexedBase(name, real=True)[letter.indices]
    return sp.Symbol(name, positive=True)


_RULES: dict[type, Callable[[tuple[sp.Expr, ...]], sp.Expr | None]] = {
    sp.Add: _sum, sp.Mul: _product, sp.Pow: _power, sp.exp: _exponential}
