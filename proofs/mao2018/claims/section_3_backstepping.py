"""mao2018, section III: the design for healthy motors, (18)-(34)."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, equal

from ..active_mode import REGRESSORS, Gamma_m, alpha_1, chi_d, chis, estimate_laws, eta, hats, m, rho_hat
from ..active_mode import wanted as wanted_active
from ..counterexamples import error_in_a, ramp_time
from ..error_dynamics import ACTIVE_MODE, ALL_MODES, Flow, over_modes
from ..lyapunov import V_1, V_estimates, V_healthy
from ..modes import (
    EVERY_MODE,
    V_25,
    Gamma_mi,
    chi_di,
    chi_mi,
    chis_i,
    d_i,
    estimates,
    free_estimates,
    gains_i,
    hat_rates_i,
    hats_i,
    m_i,
    one_region,
    rho_hat_i,
    rho_i,
    rho_part,
    rho_rate_i,
    train,
    trues_i,
    zeta_i,
)
from ..paper import paper
from ..plant import F, r_1, r_2, x_1, x_2, x_m, xddot_m, xdot_m, z_1, z_2
from .section_2 import acceleration_by_modes, chi_d_of, chi_m_of, d_of, m_of, parameters_of_mode

V = V_25(rho_i)
ONE_LETTER = (r"The one letter chi_i of (24), (26) and the display before (32) is read as the 0-1 indicator chi_mi, as "
              "(34) has it; where a parameter's own indicator is a ramp, as (6) allows, that is not the same.")
alpha = sp.Symbol("alpha_1", real=True)


@paper.claim("20", "Rate of the position error", "identity",
             r"\dot{z}_1(t) = \dot{x}_1(t) - \dot{x}_m(t) = z_2(t) + \alpha_1(t) - \dot{x}_m(t)", "proved",
             premises=("7",), where={"z_1(t)": x_1 - x_m, "z_1": x_1 - x_m, r"\dot{z}_1(t)": D(x_1 - x_m), r"\alpha_1(t)": alpha})
def position_error_rate() -> Goal:
    """D(z_1) of (18) along (7), with (19)."""
    return Goal((equal(D(x_1 - x_m), D(x_1) - xdot_m), equal(D(x_1) - xdot_m, z_2 + alpha - xdot_m)),
                (equal(z_2, x_2 - alpha),), {x_1: x_2, x_m: xdot_m})


@paper.claim("23", "Rate of V_1", "identity",
             r"\dot{V}_1 = z_1(t)\dot{z}_1(t) = z_1(t)(z_2(t) - r_1z_1(t) + \dot{x}_m(t) - \dot{x}_m(t)) = "
             r"-r_1z_1^2(t) + z_1(t)z_2(t)", "proved", premises=("20",), where={"V_1": V_1})
def v1_rate() -> Goal:
    """D(V_1) along (20), (21)."""
    rate = sp.Symbol("zdot_1", real=True)
    along_20 = equal(rate, z_2 + (-r_1 * z_1 + xdot_m) - xdot_m)
    return Goal((equal(D(V_1), z_1 * D(z_1)), equal(z_1 * D(z_1), z_1 * (z_2 - r_1 * z_1 + xdot_m - xdot_m)),
                 equal(D(V_1), -r_1 * z_1**2 + z_1 * z_2)), (along_20,), {z_1: rate})


def _rate_24(indicators: tuple[sp.Expr, ...]) -> Goal:
    """The rate of x_2 - alpha_1; the indicators are those of m, a, b, c, vartheta, D and d that the line prints."""
    of_m, *of_parameters, of_d = indicators
    stated = over_modes(m_of * of_m * F - sum((x * chi * by for (x, _, by), chi in zip(
        parameters_of_mode(), of_parameters, strict=True)), sp.Integer(0)) + d_of * of_d)
    return Goal((equal(D(x_2 - alpha_1), D(x_2) - D(alpha_1)), equal(D(x_2 - alpha_1), stated - D(alpha_1))),
                flow={x_1: x_2, x_2: acceleration_by_modes, x_m: xdot_m, xdot_m: xddot_m})


own_indicators = (chi_m_of, *(chi for _, chi, _ in parameters_of_mode()), chi_d_of)
one_indicator = (chi_m_of,) * len(own_indicators)


@paper.claim("24", "Rate of z_2", "identity",
             r"\dot{z}_2(t) = \dot{x}_2(t) - \dot{\alpha}_1(t) = \sum_{i=1}^{l}\left(m_i\chi_i(t)F(t) - a_i\chi_i(t) - "
             r"b_i\chi_i(t)x_2(t) - c_i\chi_i(t)x_2^2(t) - g\vartheta_i\chi_i(t) - 0.004D_i\chi_i(t) + "
             r"\bar{d}_i(t)\chi_i(t)\right) - \dot{\alpha}_1(t)", "refuted", premises=("8.modes",), severity="cosmetic",
             scope=ALL_MODES, where={"z_2": x_2 - alpha_1, "z_2(t)": x_2 - alpha_1, r"\dot{z}_2(t)": D(x_2 - alpha_1), "m_i": m_of, r"\chi_i(t)": chi_m_of},
             reading=ONE_LETTER, glyph="24.mended", correction=lambda: _rate_24(own_indicators),
             corrected_statement=r"\dot z_2 = \sum_{i=1}^{l}\left(m_i\chi_{mi}F - a_i\chi_{ai} - \dots + "
                                 r"\bar d_i\chi_{\bar di}\right) - \dot\alpha_1",
             note="chi_i is nowhere defined. Read as the indicator of each parameter's own, as (9), (10), (27)-(31) and (39) "
                  "print it, the line holds: write chi_mi, chi_ai and so on.")
def speed_error_rate() -> Goal:
    """Two seconds onto the slope: chi_m = 1, chi_vartheta = 1/2."""
    return ramp_time(_rate_24(one_indicator))


@paper.claim("24.mended", "Rate of z_2, each parameter with its own indicator", "identity",
             r"\dot z_2 = \sum_{i=1}^{l}\left(m_i\chi_{mi}F - a_i\chi_{ai} - b_i\chi_{bi}x_2 - \dots + "
             r"\bar d_i\chi_{\bar di}\right) - \dot\alpha_1", "proved", premises=("8.modes",), origin="ours", mends="24",
             glyph="24", scope=ALL_MODES)
def speed_error_rate_mended() -> Goal:
    """D(x_2 - alpha_1) along (7), (8) with (9), (10)."""
    return _rate_24(own_indicators)


@paper.claim("25", "V_2 is not negative and bounds the errors", "inequality",
             r"V_2 \ge \tfrac12 z_1^2 + \tfrac12 z_2^2 \ge 0", "proved", origin="implied", scope=ACTIVE_MODE,
             reading="The text calls V_2 a Lyapunov function, and uses that it bounds what stands in it.")
def lyapunov_not_negative() -> Goal:
    """Squares with positive weights."""
    return Goal((at_least(V_healthy, z_1**2 / 2 + z_2**2 / 2), at_least(V_healthy, 0)))


chi_m = sp.Symbol("chi_m", nonnegative=True)


@paper.claim("25.idle", "Modes whose indicators are zero add a constant to V_2", "implication",
             r"\chi_{\varrho i} = 0 \Rightarrow \frac{d}{dt}\left[\tfrac12\Gamma_{ai}^{-1}\tilde a_i^2 + \dots + "
             r"\tfrac12\tfrac{m_i}{\Gamma_{mi}}\tilde\rho_i^2\right] = 0", "proved", origin="ours", scope="each idle mode",
             note="This lets claims gather the idle modes in the constant V_idle.")
def idle_modes() -> Goal:
    """The laws (27)-(31), (37) with all indicators zero."""
    own = V_estimates + m * (1 / m - rho_hat) ** 2 / (2 * Gamma_m)
    laws = {**estimate_laws, rho_hat: -Gamma_m * z_2 * wanted_active * chi_m}
    return Goal((equal(D(own), 0),), tuple(equal(chi, 0) for chi in (*chis, chi_m)), laws)


@paper.claim("25.switch", "V_2 does not jump when the mode switches", "identity",
             r"V_2(T_q^+) = V_2(T_q^-)", "proved", origin="implied", scope=ACTIVE_MODE,
             note="V_2 sums over all modes and contains no indicator, and by (9) the parameters of a mode are "
                  "constants. Section IV says that a_i, b_i, c_i, ... change their values at T_q and calls V_2 "
                  "discontinuous there; they do not, or infinitely many jumps would void the argument.")
def no_jump_at_switches() -> Goal:
    """Only indicators move at a switch; states and estimates are continuous, so their rates are zero there."""
    one, zero = sp.Integer(1), sp.Integer(0)
    return Goal((equal(D(V_healthy), 0),),
                flow={**dict.fromkeys((*chis, chi_d), one), **dict.fromkeys((z_1, z_2, rho_hat, *hats), zero)})


z_2_rate = sp.Symbol("zdot_2", real=True)
free: Flow = {**free_estimates, rho_hat_i: rho_rate_i}


@paper.claim("26.a", "Rate of V_2 before the plant is put in", "identity",
             r"\dot{V}_2 = -r_1z_1^2(t) + z_1(t)z_2(t) + z_2\dot{z}_2(t) + \sum_{i=1}^{l}\left(\Gamma_{ai}^{-1}"
             r"\tilde{a}_i(t)\dot{\tilde{a}}_i(t) + \Gamma_{bi}^{-1}\tilde{b}_i(t)\dot{\tilde{b}}_i(t) + "
             r"\Gamma_{ci}^{-1}\tilde{c}_i(t)\dot{\tilde{c}}_i(t) + \Gamma_{\vartheta i}^{-1}\tilde{\vartheta}_i(t)"
             r"\dot{\vartheta}_i(t) + \Gamma_{Di}^{-1}\tilde{D}_i(t)\dot{\tilde{D}}_i(t) + \frac{m_i}{\Gamma_{mi}}"
             r"\tilde{\rho}_i(t)\dot{\tilde{\rho}}_i(t)\right)", "proved", premises=("23",), scope=EVERY_MODE,
             where={"V_2": V, r"\dot{\vartheta}_i(t)": D(trues_i[3] - hats_i[3])},
             reading="The extracted text lost the tilde under the dot of vartheta_i.")
def v2_rate_open() -> Goal:
    """D(V_2) with free rates of z_2 and of the estimates."""
    errors = sum(((x - hat) * D(x - hat) / gain for x, hat, gain in zip(trues_i, hats_i, gains_i, strict=True)),
                 m_i / Gamma_mi * (rho_i - rho_hat_i) * D(rho_i - rho_hat_i))
    return Goal((equal(D(V), -r_1 * z_1**2 + z_1 * z_2 + z_2 * D(z_2) + over_modes(errors)),),
                flow={z_1: z_2 - r_1 * z_1, z_2: z_2_rate, **free})


def _rate_26(bracket: Callable[[sp.Expr, sp.Expr], sp.Expr], own: bool) -> Goal:
    """The second form of (26); bracket(rate of the estimate, Gamma z_2 chi ...) multiplies the estimation error."""
    indicators, of_d = (chis_i, chi_di) if own else ((chi_mi,) * len(chis_i), chi_mi)
    errors = sum(((x - hat) / gain * bracket(rate, gain * z_2 * chi * by) for x, hat, gain, chi, by, rate in zip(
        trues_i, hats_i, gains_i, indicators, REGRESSORS, hat_rates_i, strict=True)), sp.Integer(0))
    resisting = sum((hat * chi * by for hat, chi, by in zip(hats_i, indicators, REGRESSORS, strict=True)), sp.Integer(0))
    stated = (-r_1 * z_1**2 + z_2 * z_1 + z_2 * over_modes(m_i * chi_mi * F - resisting + d_i * of_d)
              + z_2 * (r_1 * (z_2 - r_1 * z_1) - xddot_m) + over_modes(errors) + rho_part())
    return Goal((equal(D(V), stated),), flow={**train(m_i * chi_mi * F), **free})


RATE_26 = (r"\dot{V}_2 = -r_1z_1^2 + z_2(x_1 - x_m) + z_2\sum_{i=1}^{l}(m_i\chi_iF - \hat{a}_i\chi_i - \dots) + \dots + "
           r"\sum_{i=1}^{l}\left(%s\Gamma_{ai}^{-1}\tilde{a}_i(\dot{%s}_i + \Gamma_{ai}z_2\chi_i) + \dots\right)")
SIGN_26 = ("A sign: the bracket needs a minus in front (hats) or inside (tildes). Cosmetic: the laws (27)-(31) make the "
           "right bracket zero.")


@paper.claim("26", "Rate of V_2 with the plant, the dotted letters read with tildes", "identity",
             RATE_26 % ("", "{a}"), "refuted", premises=("24.mended", "26.a"), rests_on=("24", "26.a"),
             severity="cosmetic", glyph="26.hat", scope=EVERY_MODE,
             reading="The extracted text has a bare dot over a_i, whose rate is zero; read as the rate of the tilde, "
                     "which the first line of (26) prints. " + ONE_LETTER,
             correction=lambda: _rate_26(lambda rate, by: -(rate + by), own=True),
             corrected_statement=RATE_26 % ("-", r"\hat{a}"), note=SIGN_26)
def v2_rate_tilde() -> Goal:
    """An error in a alone, its estimate at rest."""
    return error_in_a(_rate_26(lambda rate, by: -rate + by, own=False))


@paper.claim("26.hat", "Rate of V_2 with the plant, the dotted letters read with hats", "identity",
             RATE_26 % ("", r"\hat{a}"), "refuted", premises=("24.mended", "26.a"), origin="ours", glyph="26",
             severity="cosmetic", scope=EVERY_MODE, note=SIGN_26)
def v2_rate_hat() -> Goal:
    """The same with the rates of the estimates."""
    return error_in_a(_rate_26(lambda rate, by: rate + by, own=False))


@paper.claim("26.mended", "Rate of V_2 with the plant", "identity", RATE_26 % ("-", r"\hat{a}"), "proved",
             premises=("24.mended", "26.a"), origin="ours", mends="26", scope=EVERY_MODE,
             note="Each parameter with its own indicator.")
def v2_rate_mended() -> Goal:
    """D(V_2) along the plant with the rates of the estimates free."""
    return _rate_26(lambda rate, by: -(rate + by), own=True)


def _law_claim(equation: str, i: int, printed: str, lost: str = "") -> None:
    """A law is what makes the coefficient of its estimation error in (26) zero, in every mode."""
    letter, by = ("a", "b", "c", r"\vartheta", "D")[i], REGRESSORS[i]
    gain, chi = sp.Symbol("Gamma", positive=True), sp.Symbol("chi", nonnegative=True)
    rate = sp.Symbol("hat_rate", real=True)
    left = printed.partition(" = ")[0]

    @paper.claim(equation, f"The law of the estimate of {letter.lstrip(chr(92))} cancels its error in the rate of V_2", "identity",
                 printed, "proved", premises=("26.a",), rests_on=("26",), scope="each mode", reading=lost,
                 where={left: rate, rf"\Gamma_{{{letter} i}}": gain, rf"\chi_{{{letter} i}}(t)": chi},
                 note="Decided as what the paper chooses it for: the rate for which the coefficient of the estimation "
                      "error in the rate of V_2 is zero, and no other.")
    def law() -> Goal:
        """The coefficient of the error: from its square in V_2, and from the resistance in z_2'."""
        return Goal((equal(rate, -gain * z_2 * chi * by),), (equal(-rate / gain - z_2 * chi * by, 0),))


LOST = "The extracted text lost an accent: the letter is the rate of the estimate, as the text before (27) says."
_law_claim("27", 0, r"\dot{\hat{a}}_i(t) = -\Gamma_{ai}z_2(t)\chi_{ai}(t)")
_law_claim("28", 1, r"\dot{b}_i(t) = -\Gamma_{bi}z_2(t)\chi_{bi}(t)x_2(t)", LOST)
_law_claim("29", 2, r"\dot{\hat{c}}_i(t) = -\Gamma_{ci}z_2(t)\chi_{ci}(t)x_2^2(t)")
_law_claim("30", 3, r"\hat{\vartheta}_i(t) = -\Gamma_{\vartheta i}z_2(t)\chi_{\vartheta i}(t)g", LOST)
_law_claim("31", 4, r"\hat{D}_i(t) = -0.004\Gamma_{Di}z_2(t)\chi_{Di}(t)", LOST)

open_loop: Flow = {**train(m_i * chi_mi * F), **estimates, rho_hat_i: rho_rate_i}


@paper.claim("32", "The known part of the rate of z_2", "identity",
             r"\eta(t) = x_1(t) - x_m(t) + r_1(\dot{x}_1(t) - \dot{x}_m(t)) - \ddot{x}_m(t)", "proved", premises=("7",),
             where={r"\eta(t)": x_1 - x_m - D(alpha_1)}, reading="What stands beside the train's forces in the rate of V_2: z_1 - alpha_1'.")
def known_part() -> Goal:
    """z_1 - D(alpha_1) along (7)."""
    return Goal((equal(x_1 - x_m - D(alpha_1), x_1 - x_m + r_1 * (D(x_1) - xdot_m) - xddot_m),),
                flow={x_1: x_2, x_m: xdot_m, xdot_m: xddot_m})


def _rate_33(own: bool) -> Goal:
    inside = m_i * chi_mi * F - zeta_i * (1 if own else chi_mi) + d_i * (chi_di if own else chi_mi)
    return Goal((equal(D(V), -r_1 * z_1**2 + z_2 * (eta + over_modes(inside)) + rho_part()),), flow=open_loop)


RATE_33 = (r"\dot{V}_2 = -r_1z_1^2(t) + z_2(t)\left(\eta(t) + \sum_{i=1}^{l}(m_i\chi_{%s}(t)F(t) - \zeta_i(t)%s + "
           r"\bar{d}_i(t)\chi_{%s}(t))\right) + \sum_{i=1}^{l}\frac{m_i}{\Gamma_{mi}}\tilde{\rho}_i(t)"
           r"\dot{\bar{\rho}}_i(t)")


@paper.claim("33", "The display before (32): Rate of V_2 under the laws (27)-(31)", "identity", RATE_33 % ("i", r"\chi_i(t)", "i"), "refuted",
             premises=("24.mended",), rests_on=("26", "27", "28", "29", "30", "31"), severity="cosmetic", scope=EVERY_MODE,
             where={"V_2": V, r"\chi_i(t)": chi_mi}, reading=ONE_LETTER, glyph="33.mended",
             correction=lambda: _rate_33(own=True), corrected_statement=RATE_33 % ("mi", "", r"\bar{d}i"),
             note="zeta_i of (33) holds the indicators already, and the disturbance has its own; (34) has them right.")
def v2_rate_laws() -> Goal:
    """An instant at which the disturbance's indicator is 1/2."""
    return ramp_time(_rate_33(own=False))


@paper.claim("33.mended", "Rate of V_2 under the laws (27)-(31), each parameter with its own indicator", "identity",
             RATE_33 % ("mi", "", r"\bar{d}i"), "proved", premises=("24.mended", "27", "28", "29", "30", "31"),
             origin="ours", mends="33", glyph="33", scope=EVERY_MODE, where={"V_2": V})
def v2_rate_laws_mended() -> Goal:
    """D(V_2) along the plant with F free."""
    return _rate_33(own=True)


def _rate_34(damped: bool) -> Goal:
    inner = F - rho_i * zeta_i + rho_i * d_i * chi_di + rho_i * eta + (rho_i * r_2 * z_2 if damped else 0)
    stated = -r_1 * z_1**2 + z_2 * over_modes(m_i * chi_mi * inner) - (r_2 * z_2**2 if damped else 0) + rho_part()
    return Goal((equal(D(V), stated),), one_region, open_loop)


RATE_34 = (r"\dot{V}_2 = -r_1z_1^2(t) + z_2(t)\sum_{i=1}^{l}m_i\chi_{mi}(t)\left(F(t) - \rho_i\zeta_i(t) + "
           r"\rho_i\bar{d}_i(t)\chi_{\bar{d}i}(t) + \rho_i\eta(t)%s\right)%s + \sum_{i=1}^{l}\frac{m_i}{\Gamma_{mi}}"
           r"\tilde{\rho}_i(t)\dot{\bar{\rho}}_i(t)")
BAR = "The bar over the last rho_i is a tilde, as in (25) and (26)."


@paper.claim("34.a", "Rate of V_2 with rho_i", "identity", RATE_34 % ("", ""), "proved", premises=("33.mended",),
             rests_on=("33",), scope=EVERY_MODE, where={"V_2": V}, reading=BAR,
             note="The first display of (34). The chi_mi are 0 or 1 and sum to 1, and the indicators of idle modes are "
                  "zero.")
def v2_rate_rho() -> Goal:
    """m_i rho_i = 1 in the active mode."""
    return _rate_34(damped=False)


@paper.claim("34", "Rate of V_2 with the damping split off", "identity",
             RATE_34 % (r" + \rho_i(t)r_2z_2(t)", " - r_2z_2^2(t)"), "proved", premises=("34.a",), scope=EVERY_MODE,
             where={"V_2": V}, reading=BAR, note="rho_i(t) before r_2 z_2 is the constant rho_i.")
def v2_rate_damped() -> Goal:
    """r_2 z_2^2 added and taken away."""
    return _rate_34(damped=True)
