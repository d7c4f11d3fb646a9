"""mao2018: the laws (18)-(62) in the active mode, typed once: what the claims decide and what laws.py runs.

s is sgn(z_2) as Filippov has it. A name that ends in `_true` is the law that fits V_2 where the printed one does not.
"""

from __future__ import annotations

import sympy as sp

from .plant import curvature, g, r_1, r_2, s, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2

# --- (18)-(37): the active mode, healthy motors ---------------------------------------------------------------------

# Parameters, estimates, gains and indicators of a, b, c, vartheta, D in this order.
REGRESSORS = (sp.Integer(1), x_2, x_2**2, g, curvature)
trues = sp.symbols("a_i b_i c_i vartheta_i D_i", real=True)
hats = sp.symbols("a_hat b_hat c_hat vartheta_hat D_hat", real=True)
gains = sp.symbols("Gamma_a Gamma_b Gamma_c Gamma_vartheta Gamma_D", positive=True)
chis = sp.symbols("chi_a chi_b chi_c chi_vartheta chi_D", nonnegative=True)
m, Gamma_m = sp.symbols("m_i Gamma_m", positive=True)
chi_d = sp.Symbol("chi_d", nonnegative=True)
rho_hat, d = sp.symbols("rho_hat d_i", real=True)

alpha_1 = -r_1 * (x_1 - x_m) + xdot_m  # (21)
speed_error = z_2 - r_1 * z_1  # x_1' - x_m' in error coordinates
alpha_rate = -r_1 * speed_error + xddot_m
eta = z_1 + r_1 * speed_error - xddot_m  # (32)
zeta = sum((hat * chi * by for hat, chi, by in zip(hats, chis, REGRESSORS, strict=True)), sp.Integer(0))  # (33)
estimate_laws: dict[sp.Expr, sp.Expr] = {hat: -gain * z_2 * chi * by for hat, gain, chi, by in zip(
    hats, gains, chis, REGRESSORS, strict=True)}  # (27)-(31)

wanted = zeta - eta - r_2 * z_2
rho_law = -Gamma_m * z_2 * wanted  # (37)
rho_0, lambda_0 = sp.symbols("rho_0 lambda_0", positive=True)
nu_healthy = -lambda_0 * s / rho_0  # (36)
F_35 = nu_healthy * chi_d + rho_hat * wanted  # (35)

# --- (41)-(44): parameterizable failures ----------------------------------------------------------------------------

basis = sp.Symbol("q", integer=True, positive=True)
basis_count = sp.Symbol("n_b", integer=True, positive=True)


def over_basis(summand: sp.Expr) -> sp.Expr:
    """Sum over the basis signals of all motors: a product xi^T varpi."""
    return sp.Sum(summand, (basis, 1, basis_count))


Gamma_k, Gamma_xi = sp.symbols("Gamma_k Gamma_xi", positive=True)
rho_k_hat = sp.Symbol("rho_k_hat", real=True)
xi_hat, varpi = (sp.IndexedBase(name, real=True)[basis] for name in ("xi_hat", "varpi"))
failure_hat = over_basis(xi_hat * varpi)
xi_law: dict[sp.Expr, sp.Expr] = {xi_hat: Gamma_xi * z_2 * varpi}  # (41)
rho_k_law = -Gamma_k * z_2 * failure_hat  # (44)
rho_k_law_true = -rho_k_law
nu_failed = -lambda_0 * s / rho_0  # (43)


def signal_of(compensation: sp.Expr) -> sp.Expr:
    """nu_0 of (42), (48), (55), with the compensation of what is not parameterized."""
    return -rho_k_hat * failure_hat + compensation + rho_hat * wanted


# --- (48)-(50): unparameterizable failures --------------------------------------------------------------------------

rho_k0, delta_0 = sp.symbols("rho_k0 delta_0", positive=True)
nu_s_sum = -delta_0 * s / rho_k0  # (49), summed over the failed motors: delta_0 is the sum of their delta_j^0

# --- (54)-(56): unknown bounds of the disturbance -------------------------------------------------------------------

lambda_hat, Gamma_d = sp.Symbol("lambda_hat", real=True), sp.Symbol("Gamma_d", positive=True)
lambda_law = -Gamma_d * z_2 * s * chi_d  # (54)
lambda_law_true = -lambda_law
nu_unknown = -lambda_hat * s * chi_d / rho_0  # (56)

# --- (60)-(62): unparameterizable system parameters -----------------------------------------------------------------

k_1, k_2 = sp.symbols("k_1 k_2", positive=True)
nu_damp = -k_1 * z_2 * x_2**2 - k_2 * z_2 * x_2**4  # (62)
signal_60 = signal_of(nu_failed) + rho_hat * nu_damp
rho_law_61 = -Gamma_m * z_2 * (-nu_damp + wanted)
rho_law_61_true = -Gamma_m * z_2 * (nu_damp + wanted)
