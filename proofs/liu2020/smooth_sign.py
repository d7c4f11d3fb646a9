"""The smooth sign tanh(x/kappa) against |x|, with the constant 0.2785 of Lemma 2."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Relation, at_most

constant = sp.Rational(2785, 10000)
constant_suffices = at_most(sp.log(1 / constant), 1 + constant)


def smooth_sign(error: sp.Expr, kappa: sp.Expr) -> tuple[Relation, ...]:
    """|error| - error tanh(error/kappa) <= 0.2785 kappa, for either sign."""
    return tuple(at_most(size - error * sp.tanh(error / kappa), constant * kappa) for size in (error, -error))


def smooth_sign_facts(error: sp.Expr, kappa: sp.Expr) -> tuple[sp.Expr, ...]:
    """The tangents of exp that prove it."""
    return (2 * error / kappa + sp.log(constant), -2 * error / kappa + sp.log(constant))
