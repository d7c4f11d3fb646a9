"""mao2018: the Lyapunov functions (25), (40), (53), what bounds their rates, and what such a bound gives.

The idle modes, whose indicators are zero and whose estimates therefore rest (25.idle), are gathered in V_idle and in
m_idle, the sum of their m_i. That is every number of modes.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most

from .active_mode import (
    Gamma_d,
    Gamma_k,
    Gamma_m,
    Gamma_xi,
    gains,
    hats,
    k_1,
    k_2,
    lambda_0,
    lambda_hat,
    m,
    over_basis,
    rho_0,
    rho_hat,
    rho_k_hat,
    trues,
    xi_hat,
)
from .error_dynamics import b_0, c_0, k_v, rho_i, rho_k, xi
from .plant import r_1, r_2, t, z_1, z_2

V_idle = sp.Symbol("V_idle", nonnegative=True)
V_1 = z_1**2 / 2  # (22)
V_estimates = sum(((x - hat) ** 2 / (2 * gain) for x, hat, gain in zip(trues, hats, gains, strict=True)), sp.Integer(0))
V_healthy = V_1 + z_2**2 / 2 + V_estimates + m * (1 / m - rho_hat) ** 2 / (2 * Gamma_m) + V_idle  # (25)
decay = -r_1 * z_1**2 - r_2 * z_2**2

m_idle = sp.Symbol("m_idle", nonnegative=True)
m_all = m + m_idle  # the sum of all m_i


def lyapunov(of_k: sp.Expr, of_xi: sp.Expr, of_rho: sp.Expr) -> sp.Expr:
    """V_1 + z_2^2/2 and the squared errors, those of rho_knu, xi and rho_i with the weights given."""
    return (V_1 + z_2**2 / 2 + of_k * (rho_k - rho_k_hat) ** 2 / (2 * Gamma_k)
            + of_xi * over_basis((xi - xi_hat) ** 2) / (2 * Gamma_xi) + V_estimates
            + of_rho * (rho_i - rho_hat) ** 2 / (2 * Gamma_m) + V_idle)


V_40 = lyapunov(m_all, m_all, m)
V_true = lyapunov(m * k_v, m, m * k_v)  # with the weights that fit
V_53 = V_true + m * k_v / rho_0 * (lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)
constant = b_0**2 / (4 * k_1) + c_0**2 / (4 * k_2)  # of (65)

J, V_t, w_t, V_0 = sp.symbols("J V_t w V_0", real=True)
z_2_rate, z_1_start, z_2_start = sp.symbols("zdot_2 z_1_0 z_2_0", real=True)


def square_integrable() -> Goal:
    """r_1 int z_1^2 + r_2 int z_2^2 <= V(0) for every V >= 0 with V' <= -r_1 z_1^2 - r_2 z_2^2."""
    return Goal((at_most(J, V_0), at_most(V_t + J, V_0)), (at_least(V_t, 0),), {t: sp.Integer(1), V_t: w_t, J: -decay},
                (at_most(w_t, decay),), {t: sp.Integer(0), V_t: V_0, J: sp.Integer(0)},
                decreasing=J + V_t, inputs=(w_t, z_1, z_2))


def tracks(V: sp.Expr, decrease: tuple[Relation, ...], below: tuple[Relation, ...]) -> Goal:
    """What a theorem needs before Barbalat's lemma, from what was shown of V along its loop and of V's size.

    For all times V, z_1^2, z_2^2 and the integral of r_1 z_1^2 + r_2 z_2^2 are at most what V(0) allows.
    """
    always = tuple(relation.subs({D(V): w_t}) for relation in decrease)
    at_end = (*(relation.subs({V: V_t}) for relation in below), at_least(J, 0))  # J is an integral of squares
    return Goal((at_most(V_t, V_0), at_most(J, V_0), at_most(z_1**2, 2 * V_0), at_most(z_2**2, 2 * V_0)), at_end,
                {t: sp.Integer(1), V_t: w_t, J: -decay, z_1: z_2 - r_1 * z_1, z_2: z_2_rate}, always,
                {t: sp.Integer(0), V_t: V_0, J: sp.Integer(0), z_1: z_1_start, z_2: z_2_start}, decreasing=J + V_t,
                inputs=(w_t, z_2_rate))
