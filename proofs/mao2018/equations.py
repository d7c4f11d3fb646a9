"""mao2018 as expressions: the train (1)-(6), and in the active mode the laws (18)-(62).

What is typed here is what `proofs/mao2018.py` decides and what `mao2018_laws.py` runs. s is sgn(z_2) as Filippov has
it; forces have the unit in which m_i turns them into m/s^2. A name that ends in `_true` is the law that fits V_2 where
the printed one does not.
"""

from __future__ import annotations

import sympy as sp

# --- the train ------------------------------------------------------------------------------------------------------

x_1, x_2, x_m, xdot_m, xddot_m, z_1, z_2 = sp.symbols("x_1 x_2 x_m xdot_m xddot_m z_1 z_2", real=True)
r_1, r_2, g = sp.symbols("r_1 r_2 g", positive=True)
F, s, t = sp.symbols("F s t", real=True)
curvature = sp.Rational(4, 1000)

M, d_force = sp.Symbol("M", positive=True), sp.Symbol("d", real=True)
a_r, b_r, c_r, vartheta, D_c = sp.symbols("a_r b_r c_r vartheta D_c", real=True)
F_g, F_c = M * g * vartheta, curvature * D_c * M  # (2), (3)
newton_1 = F - a_r - b_r * x_2 - c_r * x_2**2 - F_g - F_c + d_force  # the right side of (1)
Delta_b, Delta_c = sp.symbols("Delta_b Delta_c", real=True)
drag = Delta_b * x_2 + Delta_c * x_2**2  # what (59) adds to the resistance


def slope_ramp(rate: sp.Expr, start: sp.Expr) -> sp.Expr:
    """Section VIII's indicator of a slope that the train climbs onto from time `start` on: 0.25 (t - 800)."""
    return rate * (t - start)


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
