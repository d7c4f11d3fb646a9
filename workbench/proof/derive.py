"""Derivatives along a closed loop, and the split of an expression into a scalar part and a sum over neurons."""

from __future__ import annotations

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import D
from workbench.proof.text import text

SUM = sp.Symbol("Sum_", positive=True)


class Size(sp.Function):
    """Absolute value that sympy leaves as it stands, so that it is the very one that certificates speak of."""

    nargs = 1
    is_real = True

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Refuse a derivative: there is none everywhere."""
        raise ClaimError(f"abs({text(self.args[0])}) or a Max or Min has no derivative everywhere: use it outside of D")


class Side(sp.Function):
    """Sign (-1, 0 or 1) that sympy leaves as it stands."""

    nargs = 1
    is_real = True

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Refuse a derivative: there is none everywhere."""
        raise ClaimError(f"sign({text(self.args[0])}) has no derivative everywhere: use it outside of D")


class Summed(sp.Function):
    """A sum whose index has been dropped: what an expression with SUM stands for, inside a root."""

    nargs = 1


def unfold(expr: sp.Expr) -> sp.Expr:
    """tanh by exp, tan by sin and cos, Max and Min by absolute values, as `checker.py` reads them; Abs and sign left
    unevaluated."""
    if not expr.has(sp.tanh, sp.tan, sp.Abs, sp.sign, sp.Max, sp.Min):
        return expr
    if isinstance(expr, (sp.Max, sp.Min)):
        direction = 1 if isinstance(expr, sp.Max) else -1
        first, *others = (unfold(part) for part in sorted(expr.args, key=text))
        for other in others:
            first = (first + other + direction * Size(first - other)) / 2
        return first
    parts = [unfold(part) for part in expr.args]
    if isinstance(expr, sp.tanh):
        double = sp.exp(2 * parts[0])
        return (double - 1) / (double + 1)
    if isinstance(expr, sp.tan):
        return circular(sp.sin, parts[0]) / circular(sp.cos, parts[0])
    if isinstance(expr, sp.Abs):
        return Size(*parts)
    return Side(*parts) if isinstance(expr, sp.sign) else expr.func(*parts)


def circular(function: type[sp.Expr], angle: sp.Expr) -> sp.Expr:
    """sin or cos of an angle; of one with an arctan not as the root that sympy makes of it: the checker has none."""
    return function(angle, evaluate=False) if angle.has(sp.atan) else function(angle)


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
    """The expression with every D(...) carried out; ClaimError for one that has no derivative everywhere."""
    if not expr.has(D):
        return expr

    def carried(inner: sp.Expr) -> sp.Expr:
        return lie_derivative(unfold(inner), flow).replace(Size, sp.Abs).replace(Side, sp.sign)

    return expr.replace(D, carried)


def formal_sums(expr: sp.Expr) -> sp.Expr:
    """Replace Sum(term) by SUM*term: exact as long as no two sums are multiplied, which is refused.

    An expression that vanishes in this form vanishes for every number of neurons.
    Raises ClaimError for a product of sums.
    """
    if not expr.has(SUM, sp.Sum, Summed):
        return expr
    if _multiplied(expr):
        raise ClaimError("a product of two sums over neurons cannot be decided for every number of neurons")
    return expr.replace(sp.Sum, lambda term, *_: SUM * term).replace(Summed, lambda term: SUM * term)


def _multiplied(expr: sp.Expr) -> bool:
    """Whether sums are multiplied once terms that are equal are taken together; each sum is one of its own.

    ClaimError where a function has one in it.
    """
    letters = {total: sp.Dummy() for total in expr.atoms(sp.Sum, Summed)} | {SUM: sp.Dummy()}
    # The root of a sum is one number, like any other factor.
    apart = expr.xreplace(letters)
    apart = apart.xreplace({root: sp.Dummy() for root in apart.atoms(sp.Pow) if not root.exp.is_Integer})
    try:
        return _sums_in(apart, set(letters.values())) > 1 and any(
            sp.Poly(part, *letters.values()).total_degree() > most
            for part, most in zip(sp.fraction(sp.together(apart)), (1, 0), strict=True))
    except sp.PolynomialError:
        raise ClaimError("a function of a sum over neurons beside another sum cannot be decided for every number of "
                         "neurons: give the function a letter of its own") from None


def _sums_in(expr: sp.Expr, letters: set[sp.Expr]) -> int:
    """At most how many sums are multiplied in an expression; several for what is too involved to tell."""
    if expr in letters:
        return 1
    if not expr.args or not expr.has(*letters):
        return 0
    if isinstance(expr, sp.Add):
        return max(_sums_in(part, letters) for part in expr.args)
    return sum(_sums_in(part, letters) for part in expr.args) if isinstance(expr, sp.Mul) else 2
