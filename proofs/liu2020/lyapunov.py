"""The Lyapunov functions (36) and (49), what they are bounded with, and their rates of decay."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import Relation, at_most

from .error_dynamics import W_f_off, W_f_tilde, W_v_off, W_v_tilde, delta, delta_tilde, theta, theta_tilde, w_f, w_v
from .laws import alpha_1, alpha_2, beta_1, beta_2, e_v, k_1, k_3, k_5, s_tilde, sigma_f, v_tilde
from .plant import M, chi

V_f = over_neurons(w_f**2 / 2)
V_1 = s_tilde**2 / 2 + v_tilde**2 / 2 + V_f + delta_tilde**2 / (2 * alpha_1)  # (36)
V_v = over_neurons(w_v**2 / 2)
V_tracking = M / (2 * chi) * e_v**2 + V_v + theta_tilde**2 / (2 * alpha_2)
V_2 = V_1 + V_tracking  # (49)


# Squares of the weights' errors, plain and as W_tilde^T Gamma^(-1) W_tilde, and of the distances to their priors.
norm_f, norm_v = over_neurons(W_f_tilde**2), over_neurons(W_v_tilde**2)
square_f, square_v = over_neurons(w_f**2), over_neurons(w_v**2)
prior_f, prior_v = over_neurons(W_f_off**2), over_neurons(W_v_off**2)
delta_size, theta_size = sp.Abs(delta), sp.Abs(theta)


def positive(expr: sp.Expr) -> sp.Expr:
    """A bound for delta, theta >= 0."""
    return expr.xreplace({delta_size: delta, theta_size: theta})


# The rate rho of decay, mu, and the eigenvalues of Gamma^(-1) that stand in rho: the smallest ones in print, the largest
# ones in what holds.
rho, lambda_f, lambda_v = sp.symbols("rho lambda_f lambda_v", positive=True)
largest_f, largest_v = sp.symbols("lambda_f_max lambda_v_max", positive=True)
mu = sp.Symbol("mu", nonnegative=True)
rates_scalar = (at_most(rho * M, 2 * chi * k_5), at_most(rho, alpha_1 * beta_1), at_most(rho, alpha_2 * beta_2))


def rates_1(eigenvalue: sp.Expr) -> tuple[Relation, ...]:
    """The first entries of (44), by an eigenvalue of Gamma_f^(-1)."""
    return at_most(rho, 2 * k_1), at_most(rho, 2 * k_3), at_most(rho * eigenvalue, sigma_f)


def bounded_by_eigenvalue(square: sp.Expr, norm: sp.Expr, eigenvalue: sp.Expr) -> Relation:
    """What the largest eigenvalue of Gamma^(-1) means for W_tilde^T Gamma^(-1) W_tilde."""
    return at_most(square, eigenvalue * norm)
