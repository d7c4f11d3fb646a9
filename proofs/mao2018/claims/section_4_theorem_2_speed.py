"""mao2018, section IV: the speed tracks too, as the text after Theorem 2 has it."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_most, equal

from ..active_mode import (
    REGRESSORS,
    chi_d,
    chis,
    d,
    failure_hat,
    hats,
    lambda_0,
    m,
    nu_failed,
    rho_hat,
    rho_k_hat,
    signal_of,
    trues,
    wanted,
)
from ..error_dynamics import ALL_SIGNALS, Flow, disturbed, failed_train, failure, k_v, laws_true, rho_i, rho_k
from ..growing_error import GROWING_ERROR, growing_error
from ..paper import paper
from ..plant import r_2, x_2, xdot_m, z_1, z_2
from ..steady_state_error import LAWS
from .section_3_signals import P_max, R_max, W_max, Z_max, bounded_errors, e_i, rho_error, w_i
from .section_3_theorem_1 import SPEED, B, speed_tracks_mended
from .section_4_theorem_2 import ONE_MASS, p_one

nu_c, delta = sp.symbols("nu_c delta", real=True)  # nu_di and all nu_sj; the sum of the delta_j
Q_max, N_max = sp.symbols("Q N", nonnegative=True)
xi_error, n_c, rho_k_error = sp.symbols("xi_tilde_varpi n_c rho_k_tilde", real=True)


@paper.claim("theorem2.z2.loop", "z_2 in closed loop with failures, (44) mended", "identity",
             r"\dot z_2 = -z_1 - r_2z_2 - \tilde a_i\chi_{ai} - \dots - m_ik_\nu\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
             r"m_ik_\nu\tilde\rho_{k\nu}\hat\xi^T\varpi + m_i\tilde\xi^T\varpi + m_ik_\nu\nu_c + m_i\delta + \bar d_i\chi_{\bar di}",
             "proved", premises=("39", "17"), origin="ours", scope=ALL_SIGNALS)
def z2_closed_failed() -> Goal:
    """D(z_2) along the closed loop, delta being zero in section IV."""
    errors = sum(((x - hat) * chi * by for x, hat, chi, by in zip(trues, hats, chis, REGRESSORS, strict=True)), sp.Integer(0))
    stated = (-z_1 - r_2 * z_2 - errors - m * k_v * (rho_i - rho_hat) * wanted + m * k_v * (rho_k - rho_k_hat) * failure_hat
              + m * (failure - failure_hat) + m * k_v * nu_c + m * delta + d * chi_d)
    return Goal((equal(D(z_2), stated),), flow={**failed_train(signal_of(nu_c) + delta / k_v), **laws_true})


@paper.claim("theorem2.z2", "The rate of z_2 is bounded with x_m'' and the basis signals", "implication",
             r"\dot z_2^2 \le 7\left(2B(1 + r_2^2) + Z + m_i^2k_\nu^2R(W + P) + m_i^2Q + N\right)\ \text{for}\ "
             r"(\zeta_i - \eta - r_2z_2)^2 \le W,\ (\hat\xi^T\varpi)^2 \le P,\ (\tilde\xi^T\varpi)^2 \le Q,\ "
             r"(m_ik_\nu\nu_c + m_i\delta + \bar d_i\chi_{\bar di})^2 \le N", "proved",
             premises=("theorem2.z2.loop", "35.zeta", "35.wanted", "47.basis"), origin="ours", scope=ALL_SIGNALS,
             note="The last of the four is bounded since nu_di, the nu_sj, the delta_j and d_i are.")
def z2_rate_failed() -> Goal:
    """Seven terms, each bounded."""
    rate = (-z_1 - r_2 * z_2 - e_i - m * k_v * rho_error * w_i + m * k_v * rho_k_error * p_one + m * xi_error + n_c)
    scale = m**2 * k_v**2
    most = 7 * (2 * B * (1 + r_2**2) + Z_max + scale * R_max * (W_max + P_max) + m**2 * Q_max + N_max)
    return Goal((at_most(rate**2, most),),
                (*bounded_errors, at_most(e_i**2, Z_max), at_most(rho_error**2, R_max), at_most(rho_k_error**2, R_max),
                 at_most(w_i**2, W_max), at_most(p_one**2, P_max), at_most(xi_error**2, Q_max), at_most(n_c**2, N_max)),
                lemmas=(at_most((m * k_v * rho_error * w_i) ** 2, scale * R_max * W_max),
                        at_most((m * k_v * rho_k_error * p_one) ** 2, scale * R_max * P_max)))


PRINTED = r"\text{Similar to the convergence discussion in Section III, we have%s } \lim_{t\to\infty}(x_2(t) - \dot{x}_m(t)) = 0"
STAYS = ("The printed closed loop has a motion along which x_2 - x_m' stays at 1: it does not tend to zero. Decided as "
         "(x_2 - x_m')^2 <= 1/4 from some time on.")
GROWS = GROWING_ERROR % LAWS
FOLLOWS = r"\text{: } \lim_{t\to\infty}(x_2(t) - \dot{x}_m(t)) = 0\ \text{for bounded}\ \dot x_m, \ddot x_m\ \text{and}\ f_{j\rho}"
one, quarter = sp.Integer(1), sp.Rational(1, 4)


def speed_stays(compensation: sp.Expr, *assume: Relation, constants: Flow, extra_force: sp.Expr | None = None) -> Goal:
    """The printed closed loop, with a motion along which x_2 - x_m' = 1."""
    return growing_error(at_most((x_2 - xdot_m) ** 2, quarter), compensation, {lambda_0: one, **constants},
                         *disturbed, *assume, extra_force=extra_force)


@paper.claim("theorem2.speed", "Theorem 2: The speed tracks too with failures", "limit", PRINTED % "", "refuted", match="words",
             severity="result", closed_loop=True, rests_on=("47", "47.finite", "47.signal"), scope=ALL_SIGNALS, reading=STAYS,
             note="False as printed: " + GROWS + "With a plus in (44) it holds as theorem2.speed.mended states.")
def speed_with_failures() -> Goal:
    """With (42)."""
    return speed_stays(nu_failed, constants={})


@paper.claim("theorem2.speed.mended", "The speed tracks too with a plus in (44), one mass in all modes and bounded x_m', x_m'' and basis "
             "signals", "limit", r"\dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi" + ONE_MASS + FOLLOWS, "proved", origin="ours",
             premises=("theorem2.mended", "theorem2.z2", "theorem1.bounded", "barbalat"), mends="theorem2.speed", severity="result",
             scope=ALL_SIGNALS, reading=SPEED)
def speed_with_failures_mended() -> Goal:
    """x_2 - x_m' = z_2 - r_1 z_1, and both errors tend to zero, being square integrable with bounded rates."""
    return speed_tracks_mended()
