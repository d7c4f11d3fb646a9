"""What sympy loses of a term's domain while it builds it: x**3/x becomes x**2, which has a value at 0 too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import sympy as sp

from workbench.errors import ClaimError

Asked = tuple[str, sp.Expr]  # "not zero", "not negative" or "positive", and of what
NOTHING: frozenset[Asked] = frozenset()
WITHOUT = {"not zero": "zero", "not negative": "negative", "positive": "not positive"}
LONGEST = 60


def require_kept(asked: frozenset[Asked], found: object) -> None:
    """ClaimError where sympy made `found` of a term that has a value only where more is so than it asks."""
    if not asked or not isinstance(found, sp.Expr):
        return
    if lost := sorted(asked - domain(found), key=str):
        side, of = lost[0]
        raise ClaimError(f"sympy makes {_short(found)} of a term that has no value where {_short(of)} is "
                         f"{WITHOUT[side]}, and claims would hold there: write it, with xreplace for subs, in the "
                         "function of the goal, or within `with as_typed():` of workbench.proof.typed")


def asked_of(kind: type, args: Sequence[Any]) -> frozenset[Asked]:
    """What must hold for a term of that class to have a value, were it kept as it is written down."""
    parts = [part for part in map(_expression, args) if part is not None]
    return NOTHING.union(*map(domain, parts), _own(kind, parts))


def asked_after(expr: sp.Expr, pairs: Sequence[tuple[Any, Any]], put: Callable[[sp.Expr], Any]) -> frozenset[Asked]:
    """What must hold for an expression to have a value where `pairs` are put in, as `put` does."""
    asks = {"not zero": (sp.Pow, -1), "not negative": (sp.Pow, sp.S.Half), "positive": (sp.log,)}
    asked = NOTHING.union(*(asked_of(kind, (put(of), *power)) for side, of in domain(expr)
                            for kind, *power in [asks[side]]))
    return asked.union(*(asked_of(sp.Add, (new,)) for old, new in pairs if isinstance(old, sp.Basic) and expr.has(old)))


def _short(expr: sp.Expr) -> str:
    said = str(expr)
    return said if len(said) <= LONGEST else f"{said[:LONGEST]}..."


def _expression(part: Any) -> sp.Expr | None:
    try:
        found = sp.sympify(part, strict=True)
    except (sp.SympifyError, TypeError):
        return None
    return found if isinstance(found, sp.Expr) else None


@lru_cache(maxsize=65536)
def domain(expr: sp.Expr) -> frozenset[Asked]:
    """What must hold for an expression to have a value, as far as the signs of its symbols do not tell."""
    if not expr.args:
        return NOTHING
    parts = [part for part in expr.args if isinstance(part, sp.Expr)]
    return NOTHING.union(*map(domain, parts), _own(expr.func, parts))


def _own(kind: type, parts: Sequence[sp.Expr]) -> frozenset[Asked]:
    """What a function, a quotient or a root asks of its arguments themselves."""
    if kind not in (sp.log, sp.Pow) or not parts:
        return NOTHING
    base = _usual(parts[0])
    if kind is sp.log:
        return NOTHING if base.is_positive else frozenset({("positive", _positive_scale(base))})
    power = _usual(parts[1]) if len(parts) == 2 else sp.S.One
    if base.is_number or not power.is_Rational:
        return NOTHING
    asked: set[Asked] = set()
    if power < 0:
        asked |= {("not zero", factor) for factor in _factors(base) if not factor.is_nonzero}
    if not power.is_Integer and not base.is_nonnegative:
        radicand = [factor for factor in sp.Mul.make_args(base) if not factor.is_nonnegative]
        asked.add(("not negative", _odd(radicand)))
    return frozenset(asked)


@lru_cache(maxsize=65536)
def _usual(expr: sp.Expr) -> sp.Expr:
    """An expression as sympy builds it, whatever it was kept as."""
    return expr.func(*map(_usual, expr.args)) if expr.args and isinstance(expr, sp.Expr) else expr


def _odd(factors: Sequence[sp.Expr]) -> sp.Expr:
    """A product of the sign of that of the factors: odd powers as their bases."""
    return _positive_scale(sp.Mul(*(factor.base if factor.is_Pow and factor.exp.is_odd else factor
                                    for factor in factors)))


def _factors(base: sp.Expr) -> list[sp.Expr]:
    """What is zero where one of the base's factors is: without powers, sizes, numbers and signs."""
    found = []
    for whole in sp.Mul.make_args(base):
        factor = whole
        while (factor.is_Pow and factor.exp.is_positive) or isinstance(factor, sp.Abs):
            factor = factor.args[0]
        if factor.is_Mul:
            found += _factors(factor)
        elif not factor.is_number:
            scaled = _positive_scale(factor)
            found.append(-scaled if scaled.could_extract_minus_sign() else scaled)
    return found


def _positive_scale(expr: sp.Expr) -> sp.Expr:
    return expr.primitive()[1]
