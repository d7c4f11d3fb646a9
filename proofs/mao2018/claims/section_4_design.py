"""mao2018, section IV: the design for parameterizable failures, (39)-(44)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..active_mode import (
    Gamma_k,
    Gamma_m,
    alpha_1,
    chi_d,
    d,
    estimate_laws,
    eta,
    failure_hat,
    m,
    nu_failed,
    rho_0,
    rho_hat,
    rho_k_hat,
    rho_k_law,
    rho_law,
    signal_of,
    wanted,
    xi_law,
    zeta,
)
from ..counterexamples import already, exact, one_failed
from ..error_dynamics import (
    ACTIVE_MODE,
    ALL_MODES,
    ALL_SIGNALS,
    disturbed,
    failed_train,
    filippov,
    k_v,
    over_modes,
    rho_i,
    rho_k,
    within,
)
from ..lyapunov import V_40, V_true, lyapunov, m_all
from ..paper import paper
from ..plant import F, r_1, r_2, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2
from .section_2 import acceleration_by_modes, chi_d_of, chi_m_of, d_of, m_of, nu_0, parameters_of_mode
from .section_3_design import rho_rate

rho_k_rate = sp.Symbol("rho_k_hat_dot", real=True)


@paper.claim("39", "Rate of z_2 with failures", "identity",
             r"\dot z_2 = \sum_i\left(m_i\chi_{mi}(k_\nu\nu_0 + \xi^T\varpi) - a_i\chi_{ai} - \dots + \bar d_i\chi_{\bar di}"
             r"\right) - \dot\alpha_1", "proved", premises=("13", "24"), scope=ALL_MODES)
def speed_error_rate_failed() -> Goal:
    """(24) with (13); xi^T varpi is one number here."""
    force = k_v * nu_0 + sp.Symbol("xi_varpi", real=True)
    stated = over_modes(m_of * chi_m_of * force - sum((x * chi * by for x, chi, by in parameters_of_mode()),
                                                      sp.Integer(0)) + d_of * chi_d_of)
    return Goal((equal(D(x_2 - alpha_1), stated + r_1 * (x_2 - xdot_m) - xddot_m),),
                flow={x_1: x_2, x_2: acceleration_by_modes.xreplace({F: force}), x_m: xdot_m, xdot_m: xddot_m})


@paper.claim("40", "V_2 bounds the errors", "inequality", r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved",
             scope=ALL_SIGNALS)
def failure_lyapunov_not_negative() -> Goal:
    """Squares with positive weights, as printed and with the weights that fit."""
    return Goal(tuple(at_least(V, z_1**2 / 2 + z_2**2 / 2) for V in (V_40, V_true)))


def _rate_41(of_k: sp.Expr, of_xi: sp.Expr) -> Goal:
    inner = (nu_0 + rho_k * failure_hat - rho_i * zeta + rho_i * d * chi_d + rho_i * eta + rho_i * r_2 * z_2)
    stated = (-r_1 * z_1**2 + z_2 * m * k_v * inner - r_2 * z_2**2 - of_k / Gamma_k * (rho_k - rho_k_hat) * rho_k_rate
              - m / Gamma_m * (rho_i - rho_hat) * rho_rate)
    return Goal((equal(D(lyapunov(of_k, of_xi, m)), stated),), (),
                {**failed_train(nu_0), **estimate_laws, **xi_law, rho_k_hat: rho_k_rate, rho_hat: rho_rate})


RATE_41 = (r"\dot V_2 = -r_1z_1^2 + z_2\sum_im_ik_\nu\chi_{mi}(\nu_0 + \rho_{k\nu}\hat\xi^T\varpi - \rho_i\zeta_i + \dots)"
           r" - r_2z_2^2 + \sum_i\tfrac{m_i}{\Gamma_{k\nu}}\tilde\rho_{k\nu}\dot{\tilde\rho}_{k\nu} + "
           r"\sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i")


@paper.claim("41", "Rate of V_2 under the laws (27)-(31), (41)", "identity", RATE_41, "refuted",
             premises=("39", "25.idle"), scope=ALL_SIGNALS, correction=lambda: _rate_41(m, m),
             corrected_statement=r"\dot V_2 = \dots\ \text{if}\ V_2\ \text{has}\ m_i\ \text{of one mode instead of}\ "
                                 r"\textstyle\sum_im_i\ \text{before}\ \tilde\rho_{k\nu}^2\ \text{and}\ \tilde\xi^T\tilde\xi",
             note="The display before (42). (40) weighs the error of xi with the sum of all m_i, the train with the "
                  "m_i of the active mode, so a term -(sum of the idle m_i) z_2 xi_tilde^T varpi is left over. True "
                  "for l = 1. With equal masses, as in section VIII, one m in V_2 mends it; with different masses "
                  "each mode needs its own estimates of xi and rho_knu.")
def v2_rate_failed() -> Goal:
    """D(V_2) of (40) along (39) with nu_0 and the rates of rho_hat and rho_knu_hat free."""
    return already(_rate_41(m_all, m_all), exact | one_failed)


def _law_44(weight: sp.Expr, sign: int) -> Goal:
    error = rho_k - rho_k_hat
    return Goal((equal(z_2 * m * k_v * error * failure_hat + D(weight * error**2 / (2 * Gamma_k)), 0),),
                flow={rho_k_hat: sign * rho_k_law})


LAW_44 = (r"\dot{\hat\rho}_{k\nu} = %s\Gamma_{k\nu}z_2\hat\xi^T\varpi \Rightarrow z_2m_ik_\nu\tilde\rho_{k\nu}\hat\xi^T\varpi "
          r"+ \tfrac{%s}{\Gamma_{k\nu}}\tilde\rho_{k\nu}\dot{\tilde\rho}_{k\nu} = 0")


def left_by(signal: sp.Expr, compensation: sp.Expr, *more: sp.Expr) -> Goal:
    """A controller in the bracket of the display before (42): estimation errors, compensation and what is more."""
    inner = signal + rho_k * failure_hat + rho_i * (d * chi_d - wanted)
    left = (rho_k - rho_k_hat) * failure_hat - (rho_i - rho_hat) * wanted + compensation + rho_i * d * chi_d
    return Goal((equal(z_2 * m * k_v * inner, z_2 * m * k_v * sp.Add(left, *more)),), (at_most(chi_d, 1),))


LEFT = (r"z_2m_ik_\nu(\nu_0 + \rho_{k\nu}\hat\xi^T\varpi - \rho_i\zeta_i + \dots) = z_2m_ik_\nu(\tilde\rho_{k\nu}\hat\xi^T"
        r"\varpi - \tilde\rho_i(\zeta_i - \eta - r_2z_2) + %s + \rho_i\bar d_i\chi_{\bar di})")


@paper.claim("42", "What the controller leaves of the rate of V_2", "identity", LEFT % r"\nu_{di}", "proved",
             premises=("39",), scope=ALL_SIGNALS, note="(42) put into the display before it.")
def failure_controller_in_rate() -> Goal:
    """(42) in the bracket of V_2'."""
    return left_by(signal_of(nu_failed), nu_failed)


def outweighed(compensation: sp.Expr, *assume: Relation) -> Goal:
    """z_2 times a compensation and the disturbance is not positive."""
    return Goal((at_most(z_2 * (m * k_v * compensation + d * chi_d), 0),),
                (*filippov, at_most(chi_d, 1), at_least(m * k_v, rho_0), *assume), lemmas=within)


OUTWEIGHED = r"m_ik_\nu \ge \rho_i^0,\ %s \Rightarrow z_2(m_ik_\nu\nu_{di} + \bar d_i\chi_{\bar di}) \le 0"


@paper.claim("43", "nu_d outweighs the disturbance with failures too", "inequality",
             OUTWEIGHED % r"\lambda_i^0 \ge d_i^0 \ge |\bar d_i|", "proved", premises=("10",), scope=ACTIVE_MODE,
             note="rho_i^0 bounds m_i k_nu from below, as the inequality in the text says (its words say m_i).")
def disturbance_outweighed_failed() -> Goal:
    """For every value of Filippov's sign at z_2 = 0."""
    return outweighed(nu_failed, *disturbed)


@paper.claim("44", "The law of rho_knu_hat cancels its error in the rate of V_2", "identity", LAW_44 % ("-", "m_i"),
             "refuted", premises=("41",), scope=ALL_SIGNALS, correction=lambda: _law_44(m * k_v, -1),
             corrected_statement=LAW_44 % ("", "m_ik_\\nu"),
             note="The sign is wrong: the two terms add up to (k_nu + 1) m_i z_2 rho_tilde xi_hat^T varpi, and no "
                  "positive weight in V_2 makes them cancel. (44) drives the estimate the wrong way; see theorem2 for "
                  "what it does. Taken for l = 1, so that 41 plays no part. Should the page show a plus, theorem2 and "
                  "45 hold but for the weights.")
def rho_k_law_cancels() -> Goal:
    """The error's term of z_2 m_i k_nu nu_0 against D of its term in (40)."""
    return already(_law_44(m, 1), one_failed)


@paper.claim("44.weight", "With the sign of (44) mended the term cancels in (40)", "identity", LAW_44 % ("", "m_i"),
             "refuted", premises=("44",), scope=ALL_SIGNALS, correction=lambda: _law_44(m * k_v, -1),
             corrected_statement=LAW_44 % ("", "m_ik_\\nu"),
             note="The weight in (40) lacks k_nu: true only for k_nu = 1. Cosmetic, since V_2 is free to choose.")
def rho_k_law_weight() -> Goal:
    """The same with a plus in (44)."""
    return already(_law_44(m, -1), one_failed)


def _law_37(weight: sp.Expr) -> Goal:
    error = rho_i - rho_hat
    return Goal((equal(-z_2 * m * k_v * error * wanted + D(weight * error**2 / (2 * Gamma_m)), 0),),
                flow={rho_hat: rho_law})


@paper.claim("37.failures", "(37) cancels its error with failures too", "identity",
             r"\rho_i = \tfrac{1}{m_ik_\nu}:\ -z_2m_ik_\nu\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
             r"\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i = 0", "refuted", premises=("41",), scope="each mode",
             correction=lambda: _law_37(m * k_v),
             corrected_statement=r"-z_2m_ik_\nu\tilde\rho_i(\zeta_i - \eta - r_2z_2) + "
                                 r"\tfrac{m_ik_\nu}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i = 0",
             note="The weight in (40) lacks k_nu. Cosmetic: V_2 with m_i k_nu mends it, the law stands.")
def rho_law_failed() -> Goal:
    """The error's term of z_2 m_i k_nu nu_0 against D of its term in (40)."""
    return already(_law_37(m), exact | one_failed)
