"""mao2018, section VI: unknown bounds of the disturbance, (53)-(57), and Theorem 4."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..active_mode import (
    Gamma_d,
    chi_d,
    d,
    delta_0,
    lambda_0,
    lambda_hat,
    lambda_law,
    lambda_law_true,
    m,
    nu_unknown,
    rho_0,
    rho_k0,
    rho_k_hat,
    signal_of,
)
from ..counterexamples import already, exact, stopped, unit_gains
from ..error_dynamics import ACTIVE_MODE, ALL_SIGNALS, disturbed, failed_train, filippov, k_v, laws_true, size
from ..lyapunov import V_40, V_53, decay, square_integrable
from ..paper import paper
from ..plant import s, t, z_1, z_2
from ..steady_state_error import STEADY_STATE_ERROR, epsilon, steady_state_error
from .section_4_design import LEFT, OUTWEIGHED, left_by
from .section_4_theorem_2 import REPAIR
from .section_5 import delta, rest_bounds

bounded_by_unknown = (at_most(d, lambda_0), at_least(d, -lambda_0))


@paper.claim("53", "V_2 bounds the errors", "inequality", r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved",
             premises=("40",), scope=ALL_SIGNALS)
def unknown_bound_lyapunov_not_negative() -> Goal:
    """(40) and one more square, as printed and with the weights that fit."""
    more = (lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)
    return Goal(tuple(at_least(V, z_1**2 / 2 + z_2**2 / 2) for V in (V_40 + more, V_53)))


def _law_54(law: sp.Expr) -> Goal:
    error = lambda_0 - lambda_hat
    return Goal((at_most(D(error**2 / (2 * Gamma_d)) + error * size * chi_d, 0),), (*filippov, at_most(chi_d, 1)),
                {lambda_hat: law})


@paper.claim("54", "The law of lambda_hat cancels its error in the rate of V_2", "inequality",
             r"\dot{\hat\lambda}_i^0 = -\Gamma_{di}z_2\,\mathrm{sgn}(z_2)\chi_{\bar di} \Rightarrow \tilde\lambda_i^0|z_2|"
             r"\chi_{\bar di} + \Gamma_{di}^{-1}\tilde\lambda_i^0\dot{\tilde\lambda}_i^0 \le 0", "refuted",
             scope="each mode", correction=lambda: _law_54(lambda_law_true),
             corrected_statement=r"\dot{\hat\lambda}_i^0 = \Gamma_{di}z_2\,\mathrm{sgn}(z_2)\chi_{\bar di} \Rightarrow "
                                 r"\tilde\lambda_i^0|z_2|\chi_{\bar di} + \Gamma_{di}^{-1}\tilde\lambda_i^0"
                                 r"\dot{\tilde\lambda}_i^0 = 0",
             note="The sign of (54) is wrong: the estimate of the bound can only fall, where the disturbance needs it "
                  "to grow, and once it is negative (56) pushes away from z_2 = 0. (57) is what the opposite sign "
                  "gives.")
def lambda_law_cancels() -> Goal:
    """The estimation error's part of z_2 (d + m_i k_nu nu_d) against D of its term in (53)."""
    return _law_54(lambda_law)


def _terms_57(law: sp.Expr, coefficient: sp.Expr) -> Goal:
    true = (m * k_v * z_2 * nu_unknown + z_2 * d * chi_d + D((lambda_0 - lambda_hat) ** 2 / (2 * Gamma_d)))
    stated = (-coefficient / rho_0 * lambda_hat * size * chi_d + lambda_hat * size * chi_d - size * lambda_0 * chi_d
              + z_2 * d * chi_d)
    return Goal((equal(true, stated),), (*filippov, at_most(chi_d, 1)), {lambda_hat: law})


TERMS_57 = (r"\dot V_2 + r_1z_1^2 + r_2z_2^2 = \sum_i\left(-\tfrac{%s}{\rho_m^0}\hat\lambda_i^0|z_2| + \hat\lambda_i^0|z_2| - "
            r"|z_2|\lambda_i^0 + z_2\bar d_i\right)\chi_{\bar di}%s")


@paper.claim("57.a", "The terms of the unknown bound in the rate of V_2", "identity", TERMS_57 % ("m_i", ""), "refuted",
             premises=("45.a", "54"), scope="one active mode", correction=lambda: _terms_57(lambda_law_true, m * k_v),
             corrected_statement=TERMS_57 % (r"m_ik_\nu", r"\ \text{with}\ \dot{\hat\lambda}_i^0 = +\Gamma_{di}|z_2|\chi_{\bar di}"),
             note="With (54) as printed the two middle terms have the opposite sign; the first also lacks k_nu. All "
                  "that 45.a finds wrong is left out here.")
def unknown_bound_terms() -> Goal:
    """z_2 m_i k_nu nu_d + z_2 d_i chi_di and D of the last term of (53)."""
    return already(_terms_57(lambda_law, m), {k_v: sp.Integer(15), m: sp.Integer(1)})


def _terms_bound(*assume: Relation) -> Goal:
    stated = (-m / rho_0 * lambda_hat * size + lambda_hat * size - size * lambda_0 + z_2 * d) * chi_d
    return Goal((at_most(stated, 0),), (*bounded_by_unknown, at_least(m, rho_0), at_most(chi_d, 1), *assume))


@paper.claim("57.b", "The bound drawn in (57)", "inequality",
             r"\sum_i\left(-\tfrac{m_i}{\rho_m^0}\hat\lambda_i^0|z_2| + \hat\lambda_i^0|z_2| - |z_2|\lambda_i^0 + z_2\bar d_i"
             r"\right)\chi_{\bar di} \le 0", "refuted", scope="one active mode",
             correction=lambda: _terms_bound(at_least(lambda_hat, 0)),
             corrected_statement=r"\hat\lambda_i^0 \ge 0 \Rightarrow \dots \le 0",
             note="It needs lambda_hat >= 0, because m_i/rho_m^0 may exceed 1. That is nowhere asked for; the "
                  "corrected law keeps it (54.sign) when lambda_hat(0) >= 0.")
def unknown_bound_step() -> Goal:
    """The printed terms, with the coefficient m_i/rho_m^0 >= 1 as printed."""
    return _terms_bound()


lambda_start = sp.Symbol("lambda_hat_0", nonnegative=True)


@paper.claim("55", "What the controller leaves of the rate of V_2", "identity", LEFT % r"\nu_{di}", "proved",
             premises=("42",), scope=ALL_SIGNALS, note="(55) is (42) with the nu_di of (56).")
def unknown_bound_controller_in_rate() -> Goal:
    """(55) in the bracket of V_2'."""
    return left_by(signal_of(nu_unknown), nu_unknown)


@paper.claim("56", "nu_d outweighs the disturbance once the estimate reaches its bound", "inequality",
             OUTWEIGHED % r"\hat\lambda_i^0 \ge |\bar d_i|", "proved", scope=ACTIVE_MODE,
             note="rho_m^0 in (56) is read as the rho_i^0 of the next line. Nothing makes the estimate reach the bound, "
                  "and with (54) as printed it never rises: see 54.")
def estimated_bound_outweighs() -> Goal:
    """With an estimate that is no smaller than the disturbance."""
    return Goal((at_most(z_2 * (m * k_v * nu_unknown + d * chi_d), 0),),
                (*filippov, at_most(chi_d, 1), at_least(m * k_v, rho_0), at_most(d, lambda_hat),
                 at_least(d, -lambda_hat)), lemmas=(at_least(lambda_hat, 0),))


@paper.claim("54.sign", "The corrected law keeps lambda_hat from falling", "implication",
             r"\dot{\hat\lambda}_i^0 = \Gamma_{di}|z_2|\chi_{\bar di},\ \hat\lambda_i^0(0) \ge 0 \Rightarrow "
             r"\hat\lambda_i^0(t) \ge 0", "proved", scope="each mode",
             note="A helper for 57, not printed.")
def lambda_not_negative() -> Goal:
    """-lambda_hat does not increase."""
    drift = sp.Symbol("lambda_hat_dot", real=True)
    return Goal((at_least(lambda_hat, 0),), (), {t: sp.Integer(1), lambda_hat: drift}, (at_least(drift, 0),),
                {t: sp.Integer(0), lambda_hat: lambda_start}, decreasing=-lambda_hat, inputs=(drift,))


def _bound_57(repaired: bool) -> Goal:
    law = lambda_law_true if repaired else lambda_law
    flow = {**failed_train(signal_of(nu_unknown)), **laws_true, lambda_hat: law}
    return Goal((at_most(D(V_53), decay),),
                (*filippov, *bounded_by_unknown, at_least(m * k_v, rho_0), at_least(lambda_hat, 0)), flow)


@paper.claim("57", "V_2 does not increase with unknown bounds: the whole argument", "implication",
             r"\lambda_i^0 \ge |\bar d_i|,\ m_ik_\nu \ge \rho_i^0,\ \hat\lambda_i^0 \ge 0 \Rightarrow \dot V_2 \le -r_1z_1^2 - "
             r"r_2z_2^2", "gap", premises=("39", "45", "25.idle"), scope=ALL_SIGNALS,
             correction=lambda: _bound_57(repaired=True),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2\ \text{with}\ \dot{\hat\lambda}_i^0 = +\Gamma_{di}|z_2|"
                                 r"\chi_{\bar di},\ \hat\lambda_i^0(0) \ge 0",
             note=REPAIR + "All this granted, and lambda_hat >= 0 too, (54) as printed still breaks the bound, and its "
                  "opposite sign mends it.")
def v2_bound_unknown() -> Goal:
    """D(V_2) along (7), (8), (27)-(31), (37), (41), (54)-(56) and (44) repaired."""
    return already(_bound_57(repaired=False), exact | unit_gains | stopped | {
        k_v: sp.Integer(15), rho_k_hat: sp.Rational(1, 15), Gamma_d: sp.Integer(1)})


@paper.claim("theorem4", "The position error tends to zero with unknown bounds", "limit",
             r"\lim_{t\to\infty}(x_1 - x_m) = 0\ \text{under (27)-(31), (37), (41), (44), (54)-(56)}", "gap",
             premises=("57",), scope=ALL_SIGNALS, correction=square_integrable,
             corrected_statement=r"\text{with 45 and 57 repaired:}\ \int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le V_2(0)",
             note="False as printed: " + STEADY_STATE_ERROR + "rho_knu_hat starts at its true value here, and lambda_hat falls "
                  "from 1 without end. Mended as 45 and 57 are, Theorem 4 holds.")
def theorem_4() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    one = sp.Integer(1)
    return steady_state_error(at_most(z_1**2, epsilon), nu_unknown,
                           {epsilon: sp.Rational(1, 4), lambda_0: one, Gamma_d: sp.Integer(16)}, *disturbed,
                           lambda_law=lambda_law)


delta_hat, Gamma_delta = sp.Symbol("delta_hat", real=True), sp.Symbol("Gamma_delta", positive=True)


@paper.claim("VI.extension", "The scheme, repaired, extends to unparameterizable failures of unknown bound",
             "implication", r"\nu_s = -\tfrac{1}{\rho_{k\nu}^0}\hat\delta^0\mathrm{sgn}(z_2),\ \dot{\hat\delta}^0 = \Gamma_\delta|z_2|,\ "
             r"\hat\delta^0, \hat\lambda^0 \ge 0 \Rightarrow \dot V_2 \le -r_1z_1^2 - r_2z_2^2", "proved", premises=("57",),
             scope=ALL_SIGNALS,
             note="'Easily', without equations, in the text below Theorem 4; delta^0 bounds the sum of the delta_j. "
                  "Holds with the signs repaired, V_2 getting the term m_i (delta_tilde^0)^2/(2 Gamma_delta).")
def unknown_failure_bound() -> Goal:
    """(57) repaired, with an estimate of delta^0 too."""
    V = V_53 + m * (delta_0 - delta_hat) ** 2 / (2 * Gamma_delta)
    signal = signal_of(nu_unknown - delta_hat * s / rho_k0) + delta / k_v
    flow = {**failed_train(signal), **laws_true, lambda_hat: lambda_law_true, delta_hat: Gamma_delta * z_2 * s}
    return Goal((at_most(D(V), decay),),
                (*filippov, *bounded_by_unknown, *rest_bounds, at_least(m * k_v, rho_0), at_least(lambda_hat, 0),
                 at_least(delta_hat, 0)), flow)
