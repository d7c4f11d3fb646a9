"""The closed loop in the errors z_1, z_2 of (10) and the estimation errors.

Only (7) ties the acceleration to the force, so the force is what (7) says for an acceleration that stands as a symbol.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import equal
from workbench.proof.derive import lie_derivative
from workbench.trains.multi_particle import s, v

from .laws import (
    As,
    Av,
    Delta_u,
    M,
    M_hat,
    alpha,
    auxiliary,
    errors,
    estimates,
    lambda_1,
    lambda_2,
    mu_law,
    phi,
    q_sums,
    q_values,
    s_r,
    tildes,
    true_parameters,
    v_dot,
    v_r,
    v_r_dot,
    z_1,
    z_2,
)
from .plant import compact_force

u_of_7 = M * v_dot - compact_force(true_parameters, v, phi, As, Av)  # the force that (7) says


def rates_with(input_mu: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The rates of (7) and (9) for an unsaturated input mu."""
    saturated = {x: rate.xreplace({Delta_u: u_of_7 - input_mu}) for x, rate in auxiliary.items()}
    return {s: v, v: v_dot, s_r: v_r, v_r: v_r_dot, **saturated}


# The symbol stands on the right: examples need not solve for it.
sums_named = tuple(equal(value, x) for x, value in zip(q_sums, q_values, strict=True))


def in_errors(expr: sp.Expr) -> sp.Expr:
    """An expression of the closed loop in z_1, z_2 and the estimation errors."""
    pairs = zip((*estimates, M_hat), tildes, (*true_parameters, M), strict=True)
    expr = expr.xreplace({hat: tilde + true for hat, tilde, true in pairs})
    expr = expr.xreplace({lambda_2: v - v_r - alpha - z_2})
    return sp.expand(expr.xreplace({s: z_1 + s_r + lambda_1}))


flow = {z: in_errors(lie_derivative(expr, rates_with(mu_law))) for z, expr in errors.items()}
