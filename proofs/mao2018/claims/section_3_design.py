"""mao2018, section III: the design for healthy motors, (18)-(34)."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..active_mode import (
    REGRESSORS,
    Gamma_m,
    alpha_1,
    chi_d,
    chis,
    d,
    estimate_laws,
    eta,
    gains,
    hats,
    m,
    rho_hat,
    speed_error,
    trues,
    zeta,
)
from ..counterexamples import already
from ..error_dynamics import ACTIVE_MODE, ALL_MODES, Flow, error_rates, over_modes
from ..lyapunov import V_1, V_estimates, V_healthy, V_idle
from ..paper import paper
from ..plant import F, r_1, r_2, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2
from .section_2 import acceleration_by_modes, chi_d_of, chi_m_of, d_of, m_of, parameters_of_mode


@paper.claim("20", "Rate of the position error", "identity",
             r"\dot z_1 = \dot x_1 - \dot x_m = z_2 + \alpha_1 - \dot x_m", "proved", premises=("8",))
def position_error_rate() -> Goal:
    """D(z_1) of (18) along (7), with (19)."""
    virtual = sp.Symbol("alpha_1", real=True)
    return Goal((equal(D(x_1 - x_m), x_2 - xdot_m), equal(D(x_1 - x_m), (x_2 - virtual) + virtual - xdot_m)),
                flow={x_1: x_2, x_m: xdot_m})


@paper.claim("23", "Rate of V_1", "identity",
             r"\dot V_1 = z_1(z_2 - r_1z_1 + \dot x_m - \dot x_m) = -r_1z_1^2 + z_1z_2", "proved", premises=("20",))
def v1_rate() -> Goal:
    """D(V_1) along (20), (21)."""
    return Goal((equal(D(V_1), -r_1 * z_1**2 + z_1 * z_2),), flow={z_1: speed_error})


@paper.claim("24", "Rate of z_2", "identity",
             r"\dot z_2 = \sum_i\left(m_i\chi_iF - a_i\chi_i - b_i\chi_ix_2 - c_i\chi_ix_2^2 - g\vartheta_i\chi_i - "
             r"0.004D_i\chi_i + \bar d_i\chi_i\right) - \dot\alpha_1", "proved", premises=("8",), scope=ALL_MODES,
             note="(24), (26) print one chi_i for all indicators. Read as each parameter's own, which (9), (10), the "
                  "laws (27)-(31) and (39) force; one common chi_i would be false while a ramp lasts.")
def speed_error_rate() -> Goal:
    """D(x_2 - alpha_1) along (7), (8) with (9), (10)."""
    stated = over_modes(m_of * chi_m_of * F - sum((x * chi * by for x, chi, by in parameters_of_mode()),
                                                  sp.Integer(0)) + d_of * chi_d_of)
    return Goal((equal(D(x_2 - alpha_1), stated + r_1 * (x_2 - xdot_m) - xddot_m),),
                flow={x_1: x_2, x_2: acceleration_by_modes, x_m: xdot_m, xdot_m: xddot_m})


@paper.claim("25", "V_2 is not negative and bounds the errors", "inequality",
             r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved", scope=ACTIVE_MODE)
def lyapunov_not_negative() -> Goal:
    """Squares with positive weights."""
    return Goal((at_least(V_healthy, z_1**2 / 2 + z_2**2 / 2), at_least(V_healthy, 0)))


chi_m = sp.Symbol("chi_m", nonnegative=True)


@paper.claim("25.idle", "Modes whose indicators are zero add a constant to V_2", "implication",
             r"\chi_{\varrho i} = 0 \Rightarrow \frac{d}{dt}\left[\tfrac12\Gamma_{ai}^{-1}\tilde a_i^2 + \dots + "
             r"\tfrac12\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i^2\right] = 0", "proved", scope="each idle mode",
             note="This lets the claims below gather the idle modes in the constant V_idle.")
def idle_modes() -> Goal:
    """The laws (27)-(31), (37) with all indicators zero."""
    own = V_estimates + m * (1 / m - rho_hat) ** 2 / (2 * Gamma_m)
    laws = {**estimate_laws, rho_hat: -Gamma_m * z_2 * (zeta - eta - r_2 * z_2) * chi_m}
    return Goal((equal(D(own), 0),), tuple(equal(chi, 0) for chi in (*chis, chi_m)), laws)


@paper.claim("25.switch", "V_2 does not jump when the mode switches", "identity",
             r"V_2(T_q^+) = V_2(T_q^-)", "proved", scope=ACTIVE_MODE,
             note="V_2 sums over all modes and contains no indicator, and by (9) the parameters of a mode are "
                  "constants. Section IV says that a_i, b_i, c_i, ... change their values at T_q and calls V_2 "
                  "discontinuous there; they do not, or infinitely many jumps would void the argument.")
def no_jump_at_switches() -> Goal:
    """The derivative of V_2 by every indicator is zero."""
    one = sp.Integer(1)
    return Goal((equal(D(V_healthy), 0),), flow={**dict.fromkeys(chis, one), chi_d: one, z_1: sp.Integer(0)})


hat_rates = sp.symbols("a_hat_dot b_hat_dot c_hat_dot vartheta_hat_dot D_hat_dot", real=True)
rho_rate, z_2_rate, idle_rate = sp.symbols("rho_hat_dot zdot_2 Vdot_idle", real=True)
rho_part = m / Gamma_m * (1 / m - rho_hat) * -rho_rate
free_laws: Flow = {**dict(zip(hats, hat_rates, strict=True)), rho_hat: rho_rate, V_idle: idle_rate}


@paper.claim("26.a", "Rate of V_2 before the plant is put in", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_1z_2 + z_2\dot z_2 + \sum_i\left(\Gamma_{ai}^{-1}\tilde a_i\dot{\tilde a}_i + "
             r"\dots + \tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i\right)", "proved", premises=("23",),
             scope=ACTIVE_MODE, note="The idle modes' terms stand as the rate of V_idle on both sides.")
def v2_rate_open() -> Goal:
    """D(V_2) with free rates of z_2 and of the estimates."""
    errors = sum(((x - hat) * -rate / gain for x, hat, gain, rate in zip(trues, hats, gains, hat_rates, strict=True)),
                 sp.Integer(0))
    return Goal((equal(D(V_healthy), -r_1 * z_1**2 + z_1 * z_2 + z_2 * z_2_rate + errors + rho_part + idle_rate),),
                flow={z_1: speed_error, z_2: z_2_rate, **free_laws})


def _rate_26(bracket: Callable[[sp.Expr, sp.Expr], sp.Expr]) -> Goal:
    """The second form of (26); bracket(rate of the estimate, Gamma z_2 chi ...) multiplies the estimation error."""
    errors = sum(((x - hat) / gain * bracket(rate, gain * z_2 * chi * by) for x, hat, gain, chi, by, rate in zip(
        trues, hats, gains, chis, REGRESSORS, hat_rates, strict=True)), sp.Integer(0))
    stated = (-r_1 * z_1**2 + z_2 * z_1 + z_2 * (m * F - zeta + d * chi_d) + z_2 * (r_1 * speed_error - xddot_m)
              + errors + rho_part + idle_rate)
    return Goal((equal(D(V_healthy), stated),), tuple(at_most(chi, 1) for chi in (*chis, chi_d)),
                {**error_rates(F), **free_laws})


only_a: Flow = dict.fromkeys((*trues[1:], *hats[1:], V_idle, idle_rate, F, d, rho_rate), sp.Integer(0))


RATE_26 = (r"\dot V_2 = \dots + \sum_i\left(%s\Gamma_{ai}^{-1}\tilde a_i(\dot{%s a}_i %s \Gamma_{ai}z_2\chi_i) + \dots"
           r"\right)")


def _rate_26_claim(part: str, accent: str, bracket: Callable[[sp.Expr, sp.Expr], sp.Expr]) -> None:
    @paper.claim(f"26.{part}", f"Rate of V_2 with the plant, the dotted letters read as {part}s", "identity",
                 RATE_26 % ("", accent, "+"), "refuted", premises=("24", "26.a"), scope=ACTIVE_MODE,
                 correction=lambda: _rate_26(lambda rate, by: -(rate + by)),
                 corrected_statement=RATE_26 % ("-", r"\hat", "+"),
                 note="A sign: the bracket needs a minus in front (hats) or inside (tildes); the extraction leaves "
                      "open which accent is printed, and neither is right. Cosmetic: the laws (27)-(31) make the "
                      "right bracket zero.")
    def rate() -> Goal:
        return already(_rate_26(bracket), only_a)


_rate_26_claim("hat", r"\hat", lambda rate, by: rate + by)
_rate_26_claim("tilde", r"\tilde", lambda rate, by: -rate + by)


def _law_claim(equation: str, i: int, letter: str, law: str) -> None:
    x, hat, gain, chi, by = trues[i], hats[i], gains[i], chis[i], REGRESSORS[i]

    @paper.claim(equation, f"The law of the estimate of {letter} cancels its error in the rate of V_2", "identity",
                 rf"{law} \Rightarrow \frac{{d}}{{dt}}\left[\frac{{\tilde {letter}_i^2}}{{2\Gamma}}\right] - "
                 rf"z_2 \tilde {letter}_i \chi \cdot (\dots) = 0", "proved", premises=("26.a",), scope="each mode")
    def cancels() -> Goal:
        """D of the error's term in V_2 against its term in z_2 z_2'."""
        return Goal((equal(D((x - hat) ** 2 / (2 * gain)) - z_2 * (x - hat) * chi * by, 0),), flow=estimate_laws)


_law_claim("27", 0, "a", r"\dot{\hat a}_i = -\Gamma_{ai}z_2\chi_{ai}")
_law_claim("28", 1, "b", r"\dot{\hat b}_i = -\Gamma_{bi}z_2\chi_{bi}x_2")
_law_claim("29", 2, "c", r"\dot{\hat c}_i = -\Gamma_{ci}z_2\chi_{ci}x_2^2")
_law_claim("30", 3, r"\vartheta", r"\dot{\hat\vartheta}_i = -\Gamma_{\vartheta i}z_2\chi_{\vartheta i}g")
_law_claim("31", 4, "D", r"\dot{\hat D}_i = -0.004\Gamma_{Di}z_2\chi_{Di}")

open_loop: Flow = {**error_rates(F), **estimate_laws, rho_hat: rho_rate}


@paper.claim("33", "Rate of V_2 under the laws (27)-(31)", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_2\left(\eta + \sum_i(m_i\chi_iF - \zeta_i\chi_i + \bar d_i\chi_i)\right) + "
             r"\sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i", "proved",
             premises=("24", "25.idle", "27", "28", "29", "30", "31"), scope=ACTIVE_MODE,
             note="The display before (32). It does not rest on the misprinted form of (26).")
def v2_rate_laws() -> Goal:
    """D(V_2) along the plant with F free."""
    return Goal((equal(D(V_healthy), -r_1 * z_1**2 + z_2 * (eta + m * F - zeta + d * chi_d) + rho_part),),
                flow=open_loop)


def _rate_34(damped: bool) -> Goal:
    rho = 1 / m
    inner = F - rho * zeta + rho * d * chi_d + rho * eta + (rho * r_2 * z_2 if damped else 0)
    stated = -r_1 * z_1**2 + z_2 * m * inner - (r_2 * z_2**2 if damped else 0) + rho_part
    return Goal((equal(D(V_healthy), stated),), flow=open_loop)


@paper.claim("34.a", "Rate of V_2 with rho_i", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_2\sum_im_i\chi_{mi}(F - \rho_i\zeta_i + \rho_i\bar d_i\chi_{\bar di} + "
             r"\rho_i\eta) + \sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i", "proved", premises=("33",),
             scope=ACTIVE_MODE,
             note="Uses that the chi_mi are 0 or 1 and sum to 1, and that the other indicators of idle modes are zero.")
def v2_rate_rho() -> Goal:
    """m_i rho_i = 1 in the active mode."""
    return _rate_34(damped=False)


@paper.claim("34", "Rate of V_2 with the damping split off", "identity",
             r"\dot V_2 = -r_1z_1^2 + z_2\sum_im_i\chi_{mi}(F - \rho_i\zeta_i + \rho_i\bar d_i\chi_{\bar di} + "
             r"\rho_i\eta + \rho_ir_2z_2) - r_2z_2^2 + \sum_i\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i\dot{\tilde\rho}_i",
             "proved", premises=("34.a",), scope=ACTIVE_MODE,
             note="rho_i(t) before r_2 z_2 is the constant rho_i.")
def v2_rate_damped() -> Goal:
    """r_2 z_2^2 added and taken away."""
    return _rate_34(damped=True)
