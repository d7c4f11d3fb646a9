"""Derivatives along a closed loop, and the split of an expression into a scalar part and a sum over neurons."""

from __future__ import annotations

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import D

SUM = sp.Symbol("Sum_", positive=True)


def lie_derivative(expr: sp.Expr, flow: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    """d/dt of an expression along `flow` (symbol -> rate); other symbols are constant.

    Sums over neurons are differentiated term by term: a rate given for W[j] applies to every j.
    """
    if isinstance(expr, sp.Sum):
        return sp.Sum(lie_derivative(expr.function, flow), *expr.limits)
    if expr.has(sp.Sum):
        if isinstance(expr, sp.Add):
            return sp.Add(*(lie_derivative(term, flow) for term in expr.args))
        sums = {total: sp.Dummy(real=True) for total in expr.atoms(sp.Sum)}
        inner = expr.xreplace(sums)
        rates = flow | {symbol: lie_derivative(total, flow) for total, symbol in sums.items()}
        return lie_derivative(inner, rates).xreplace({symbol: total for total, symbol in sums.items()})
    return sp.Add(*(sp.diff(expr, symbol) * rate for symbol, rate in flow.items() if expr.has(symbol)))


def expand_derivatives(expr: sp.Expr, flow: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    """The expression with every D(...) carried out."""
    return expr.replace(D, lambda inner: lie_derivative(inner, flow))


def formal_sums(expr: sp.Expr) -> sp.Expr:
    """Replace Sum(term) by SUM*term: exact as long as no two sums are multiplied, which is refused.

    An expression that vanishes in this form vanishes for every number of neurons.
    Raises ClaimError for a product of sums.
    """
    flat = expr.replace(sp.Sum, lambda term, *_: SUM * term)
    numerator = sp.fraction(sp.together(flat))[0] if flat.has(SUM) else flat
    if flat.has(SUM) and sp.Poly(numerator, SUM).degree() > 1:
        raise ClaimError("a product of two sums over neurons cannot be decided for every number of neurons")
    return flat
