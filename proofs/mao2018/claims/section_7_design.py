"""mao2018, section VII: nonlinear damping of uncertain resistance, (58)-(63)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal

from ..active_mode import (
    chi_d,
    d,
    eta,
    k_1,
    k_2,
    lambda_0,
    m,
    nu_damp,
    nu_failed,
    r_2,
    rho_0,
    rho_hat,
    rho_k_hat,
    rho_k_law,
    rho_law_61,
    rho_law_61_true,
    signal_60,
)
from ..counterexamples import already, at_instant, exact, stopped, unit_gains
from ..error_dynamics import ALL_SIGNALS, Flow, filippov, k_v, rho_i, size, uncertain_train
from ..felt_force import of_every_mode, printed_signal, signal_law
from ..lyapunov import V_40, V_true, decay, m_idle
from ..modes import EVERY_MODE, rho_hat_i
from ..paper import paper
from ..plant import D_c, Delta_b, Delta_c, F, curvature, drag, g, vartheta, x_1, x_2, z_2
from .section_2 import PER_MASS, a_t, b_t, c_t, d_bar, m_t, v
from .section_4_design import LEFT, NU_0, SIGNAL, left_by

rate = sp.Symbol("acceleration", real=True)
nu_one = sp.Symbol("nu_Delta", real=True)
gamma = sp.Symbol("gamma", positive=True)
chi_one, zeta_one = sp.Symbol("chi", nonnegative=True), sp.Symbol("zeta", real=True)


@paper.claim("58", "Position and speed", "identity", r"\dot{x}_1(t) = x_2(t)", "proved", premises=("7",),
             note="(7) again.")
def position_and_speed_again() -> Goal:
    """The first state's rate is the second."""
    return Goal((equal(D(x_1), x_2),), (equal(x_2, v),), flow={x_1: v})


@paper.claim("59", "The train with unparameterizable parameters", "identity",
             r"\dot{x}_2(t) = m(t)F(t) - a(t) - (b(t) + \Delta b(t))x_2(t) - (c(t) + \Delta c(t))x_2^2(t) - g\vartheta(t) - "
             r"0.004D(t) + \bar{d}(t)", "proved", premises=("8",), where=PER_MASS | {"b": b_t, "c": c_t},
             note="(8) with b + Delta_b and c + Delta_c for b and c.")
def uncertain_per_mass() -> Goal:
    """The coefficients of (8), each with its uncertain part."""
    b_all, c_all = sp.symbols("b_all c_all", real=True)
    whole = {b_t: b_all, c_t: c_all}
    along_8 = equal(rate, m_t * F - a_t - b_all * x_2 - c_all * x_2**2 - g * vartheta - curvature * D_c + d_bar)
    stated = (m_t * F - a_t - (b_t + Delta_b) * x_2 - (c_t + Delta_c) * x_2**2 - g * vartheta - curvature * D_c + d_bar)
    return Goal((equal(D(x_2), stated),), (along_8, *(equal(all_, x + more) for (x, all_), more in zip(
        whole.items(), (Delta_b, Delta_c), strict=True))), flow={x_2: rate})


@paper.claim("60.law", "The controller with nonlinear damping", "identity", printed_signal(r"\hat{\xi}^T(t)\varpi(t)", within=r"\hat{\rho}_i(t)\nu_{\Delta}(t) + "), "proved",
             rests_on=(), scope=EVERY_MODE, where=SIGNAL | {r"\nu_{di}(t)": of_every_mode(nu_failed)}, reading=NU_0
                     + "The extracted text has i for the last mode l.")
def damped_law() -> Goal:
    """D(x_2) of (8) with the signal that is simulated."""
    return signal_law(signal_60, of_every_mode(nu_failed), within=rho_hat_i * nu_damp)


@paper.claim("60", "What the controller leaves of the rate of V_2", "identity",
             LEFT % r"\nu_{di} + \rho_i\nu_\Delta - \tilde\rho_i\nu_\Delta", "proved", premises=("42",),
             origin="implied", scope=ALL_SIGNALS, reading="(60) put into the display before (42).",
             note="So the law of rho_hat has to cancel nu_Delta + zeta_i - eta - r_2 z_2: see 61.")
def damped_controller_in_rate() -> Goal:
    """(60) in the bracket of V_2'."""
    return left_by(signal_60, nu_failed, rho_i * nu_damp, -(rho_i - rho_hat) * nu_damp)


paper.definition("62.law", "The nonlinear damping", r"\nu_{\Delta}(t) = -k_1z_2(t)x_2^2(t) - k_2z_2(t)x_2^4(t)",
                 note="What it is for is decided in 62.")


@paper.claim("62", "The nonlinear damping damps", "inequality",
             r"z_2\nu_\Delta = -k_1z_2^2x_2^2 - k_2z_2^2x_2^4 \le 0", "proved", origin="implied",
             reading="What (62) is designed for.")
def damping_damps() -> Goal:
    """z_2 times (62)."""
    return Goal((equal(z_2 * nu_damp, -k_1 * z_2**2 * x_2**2 - k_2 * z_2**2 * x_2**4), at_most(z_2 * nu_damp, 0)))


def _law_61(sign: int) -> Goal:
    """What the error of rho_hat adds to the rate of V_2: through (60), and by its own square with the weight m_i k_nu."""
    inner, error = zeta_one - eta - r_2 * z_2, rho_i - rho_hat
    left = -z_2 * m * k_v * chi_one * error * (nu_one + inner) + D(m * k_v * error**2 / (2 * gamma))
    return Goal((equal(left, 0),), flow={rho_hat: -gamma * z_2 * (sign * nu_one + inner) * chi_one})


LAW_61 = (r"\dot{\hat{\rho}}_i(t) = -\gamma_{mi}z_2(t)(%s\nu_{\Delta}(t) + \zeta_i(t) - \eta(t) - r_2z_2(t))\chi_{mi}(t)")
CANCELS_61 = LAW_61 + (r"\ \Rightarrow\ -m_ik_\nu z_2\tilde\rho_i(\nu_\Delta + \zeta_i - \eta - r_2z_2)\chi_{mi} + "
                       r"\tfrac{d}{dt}\left[\tfrac{m_ik_\nu}{2\gamma_{mi}}\tilde\rho_i^2\right] = 0")
CHOSEN_61 = ("With (60) the rate of V_2 contains the first term; the square of the error of rho_hat, with the weight m_i k_nu "
             "granted, has to cancel it. ")
paper.definition("61.law", "The law of rho_hat with nonlinear damping", LAW_61 % "-", note="What it is for is decided in 61.")


@paper.claim("61", "The minus of nu_Delta in (61) fits (60): the error of rho_hat cancels in the rate of V_2", "identity",
             CANCELS_61 % "-", "refuted", premises=("60",), rests_on=("60",), origin="implied", scope="each mode, all failures",
             correction=lambda: _law_61(1), corrected_statement=CANCELS_61 % "", reading=CHOSEN_61,
             note="The sign of nu_Delta in (61) is wrong: it does not fit (60), which has rho_hat nu_Delta with a plus. The extracted "
                  "text has a clear minus, as in (44). What is left over multiplies the damping of (64) by 2 rho_hat/rho_i - 1: it turns "
                  "into a drive while rho_hat is below half of rho_i. Theorem 5 and Remark 4 fall with either sign, see theorem5.reading "
                  "and remark4.reading.")
def rho_law_damped() -> Goal:
    """The law as printed."""
    return at_instant(_law_61(-1), {k_v: sp.Integer(15)})


@paper.claim("61.glyph", "With a plus for the minus of nu_Delta in (61) its error cancels", "identity", CANCELS_61 % "",
             "proved", premises=("60",), origin="ours", mends="61", scope="each mode, all failures", reading=CHOSEN_61)
def rho_law_damped_plus() -> Goal:
    """The same with a plus."""
    return _law_61(1)


def _along_63(V: sp.Expr, flow: Flow, damping: sp.Expr) -> Goal:
    stated = decay - m * k_v / rho_0 * lambda_0 * size + z_2 * d * chi_d + damping
    return Goal((equal(D(V), stated),), (*filippov, at_most(chi_d, 1)), flow)


printed_loop = uncertain_train(rho_law_61) | {rho_k_hat: rho_k_law}
LOOP = ("Along the printed laws and (40), with no failure signal, exact estimates of rho_i and one mode, so that the errors "
        "of the display before (42), of (44) and (61) play no part. ")


def at_rest(goal: Goal) -> Goal:
    """An instant at which only the powers of z_2 matter."""
    return already(goal, exact | unit_gains | stopped | {k_v: sp.Integer(15), m_idle: sp.Integer(0),
                                                         rho_k_hat: sp.Rational(1, 15)})


RATE_63 = (r"\dot{V}_2 = -r_1z_1^2(t) - r_2z_2^2(t) + \sum_{i=1}^{l}\left(-\frac{m_ik_{\nu}}{\rho_i^0}\lambda_i^0|z_2(t)|"
           r"\chi_{%s}(t) + z_2(t)\bar{d}_i(t)\chi_{\bar{d}i}(t)\right) + %s")
MENDED_63 = RATE_63 % ("mi", r"z_2(t)\nu_{\Delta}(t) - \Delta b(t)z_2(t)x_2(t) - \Delta c(t)z_2(t)x_2^2(t)")


@paper.claim("63", "Rate of V_2 with nonlinear damping", "identity",
             RATE_63 % (r"\bar{d}i", r"\nu_{\Delta}(t) - \Delta b(t)z_2^2(t)x_2(t) - \Delta c(t)z_2^2(t)x_2^2(t)"), "refuted",
             premises=("60",), rests_on=("60",), severity="cosmetic", glyph="63.glyph", scope=ALL_SIGNALS,
             correction=lambda: _along_63(V_true, uncertain_train(rho_law_61_true), z_2 * (nu_damp - drag)),
             corrected_statement=MENDED_63,
             reading="One mode is active, the others are at rest. " + LOOP,
             note="The powers of z_2 are wrong, and the next display has the right ones.")
def v2_rate_damping() -> Goal:
    """D(V_2) along (58)-(61)."""
    return at_rest(_along_63(V_40, printed_loop, nu_damp - Delta_b * z_2**2 * x_2 - Delta_c * z_2**2 * x_2**2))


@paper.claim("63.glyph", "Rate of V_2 with nonlinear damping, the squares of z_2 before x_2 read as first powers",
             "identity", RATE_63 % (r"\bar{d}i", r"\nu_{\Delta}(t) - \Delta b(t)z_2(t)x_2(t) - \Delta c(t)z_2(t)x_2^2(t)"), "refuted",
             premises=("60",), origin="ours", severity="cosmetic", glyph="63", scope=ALL_SIGNALS,
             note=LOOP + "nu_Delta still lacks its factor z_2.")
def v2_rate_damping_glyph() -> Goal:
    """The same with first powers."""
    return at_rest(_along_63(V_40, printed_loop, nu_damp - drag * z_2))


@paper.claim("63.mended", "Rate of V_2 with nonlinear damping, laws, weights and powers mended", "identity", MENDED_63,
             "proved", premises=("60", "44.mended", "61.glyph"), origin="ours", mends="63", scope=ALL_SIGNALS)
def v2_rate_damping_mended() -> Goal:
    """D(V_2) along (58)-(60) and the mended laws."""
    return _along_63(V_true, uncertain_train(rho_law_61_true), z_2 * (nu_damp - drag))
