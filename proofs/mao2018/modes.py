"""mao2018: V_2, the train and the laws with their sums over all modes, as the paper prints them.

Certificates know no sign of a symbol with an index, so what is positive in every mode (m_i, the gains, rho_i^0) is the
exponential of a real number; rho_i is one over m_i, or over m_i k_nu with failures. At any instant one mode is active:
its chi_mi is 1, all indicators of the others are 0. So sum chi_mi = 1, and sum (1 - chi_mi) chi_rhoi (...) = 0.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Relation, equal

from .active_mode import REGRESSORS, Gamma_k, Gamma_xi, alpha_rate, eta, r_2, rho_k_hat, speed_error
from .error_dynamics import NAMES, Flow, k_v, of_mode, over_modes
from .lyapunov import V_1
from .plant import s, z_1, z_2


def positive(name: str) -> sp.Expr:
    """A positive quantity of mode i."""
    return sp.exp(of_mode(f"log_{name}"))


m_i, Gamma_mi = positive("m"), positive("Gamma_m")
gains_i = tuple(positive(f"Gamma_{name}") for name in NAMES)
trues_i = tuple(of_mode(name) for name in NAMES)
hats_i = tuple(of_mode(f"{name}_hat") for name in NAMES)
hat_rates_i = tuple(of_mode(f"{name}_hat_rate") for name in NAMES)
chis_i = tuple(of_mode(f"chi_{name}") for name in NAMES)
chi_mi, chi_di, d_i, lambda_i = (of_mode(name) for name in ("chi_m", "chi_d", "d", "lambda_0"))
rho_hat_i, rho_rate_i = of_mode("rho_hat"), of_mode("rho_hat_rate")
rho_0i = positive("rho_0")  # rho_i^0
rho_k = 1 / k_v
size = s * z_2  # |z_2|

zeta_i = sum((hat * chi * by for hat, chi, by in zip(hats_i, chis_i, REGRESSORS, strict=True)), sp.Integer(0))  # (33)
wanted_i = zeta_i - eta - r_2 * z_2
resistance_i = sum((x * chi * by for x, chi, by in zip(trues_i, chis_i, REGRESSORS, strict=True)), sp.Integer(0))
errors_i = sum(((x - hat) ** 2 / gain for x, hat, gain in zip(trues_i, hats_i, gains_i, strict=True)), sp.Integer(0))


def V_25(rho: sp.Expr) -> sp.Expr:
    """(25), rho_i being 1/m_i or, with failures, 1/(m_i k_nu)."""
    return V_1 + z_2**2 / 2 + over_modes((errors_i + m_i / Gamma_mi * (rho - rho_hat_i) ** 2) / 2)


rho_i, rho_failed = 1 / m_i, 1 / (m_i * k_v)

# xi^T varpi, xi_hat^T varpi and xi_tilde^T xi_tilde are numbers here; xi_square moves as (41) makes it.
p, p_hat, xi_square = sp.symbols("xi_varpi xi_hat_varpi xi_square", real=True)
xi_square_rate = -2 * Gamma_xi * z_2 * (p - p_hat)
V_40_i = V_25(rho_failed) + over_modes(m_i / Gamma_k * (rho_k - rho_k_hat) ** 2 / 2) + over_modes(
    m_i / Gamma_xi * xi_square / 2)


def train(m_times_force: sp.Expr) -> Flow:
    """z_1 and z_2 along (7)-(10) with (19), (21), given m_i chi_mi F of each mode."""
    return {z_1: speed_error, z_2: over_modes(m_times_force - resistance_i + d_i * chi_di) - alpha_rate}


estimates: Flow = {hat: -gain * z_2 * chi * by for hat, gain, chi, by in zip(
    hats_i, gains_i, chis_i, REGRESSORS, strict=True)}  # (27)-(31)
free_estimates: Flow = dict(zip(hats_i, hat_rates_i, strict=True))
rho_law_i = -Gamma_mi * z_2 * wanted_i * chi_mi  # (37)


def rho_part(rho: sp.Expr = rho_i) -> sp.Expr:
    """The term of rho_i in the rate of V_2."""
    return over_modes(m_i / Gamma_mi * (rho - rho_hat_i) * D(rho - rho_hat_i))


def idle(term: sp.Expr) -> Relation:
    """A term with an indicator of an idle mode is zero."""
    return equal(over_modes((1 - chi_mi) * term), 0)


one_region = (equal(over_modes(chi_mi), 1), idle(zeta_i), idle(d_i * chi_di))
EVERY_MODE = "every number of modes"
