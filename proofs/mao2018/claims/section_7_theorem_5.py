"""mao2018, section VII: the bound (65) of the rate of V_2, Theorem 5 and Remark 4."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, greater, less

from ..active_mode import (
    chi_d,
    chis,
    failure_hat,
    hats,
    k_1,
    k_2,
    lambda_0,
    m,
    nu_damp,
    nu_failed,
    rho_0,
    rho_k_hat,
    rho_law_61_true,
)
from ..counterexamples import already, at_instant, exact, failing, unit_gains
from ..error_dynamics import (
    ALL_SIGNALS,
    Flow,
    b_0,
    c_0,
    disturbed,
    failure,
    filippov,
    k_v,
    uncertain,
    uncertain_train,
    within,
)
from ..growing_error import GROWING_ERROR, growing_error
from ..leakage_proof import idle_mode, leakage_goals, rate_of_every_mode
from ..lyapunov import V_0, V_40, J, V_t, V_true, constant, decay, w_t
from ..paper import paper
from ..plant import Delta_b, Delta_c, drag, r_1, r_2, t, x_2, z_1, z_2
from ..steady_state_error import LAWS_VII, STEADY_STATE_ERROR, Xi_hat, epsilon, steady_state_error
from .section_3_signals import B, X_max
from .section_4_theorem_2 import ALONE_44, REPAIR, WEIGHTS
from .section_7_design import LAW_61, printed_loop

LEAKAGE = leakage_goals()
MENDED_65 = (r"\dot{V}_2 \leq -r_1z_1^2 - r_2z_2^2 + \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}\ \text{with}\ +\nu_\Delta\ "
             r"\text{in (61),}\ +\ \text{in (44),}\ " + WEIGHTS)


def _bound_65(mended: bool) -> Goal:
    damped = z_2 * (nu_damp - drag)
    V = V_true if mended else V_40
    flow = uncertain_train(rho_law_61_true) if mended else printed_loop
    return Goal((at_most(D(V), decay + constant),),
                (*filippov, *disturbed, *uncertain, at_most(chi_d, 1), at_least(m * k_v, rho_0)), flow,
                lemmas=(*within, at_most(Delta_b**2, b_0**2), at_most(Delta_c**2, c_0**2), at_most(damped, constant),
                        at_most(D(V), decay + damped)))


def driven(goal: Goal) -> Goal:
    """The instant of (45) with nothing uncertain about the resistance."""
    zero: Flow = dict.fromkeys((Delta_b, Delta_c), sp.Integer(0))
    return at_instant(failing(goal), zero | dict.fromkeys((k_1, k_2, b_0, c_0, x_2), sp.Integer(1)))


DRIVEN = ALONE_44 + "Since these estimates are exact, the sign of (61) plays no part either. "


@paper.claim("63.bound", "The display after (63): Rate of V_2 with the bounds of the uncertain resistance", "inequality",
             r"\dot{V}_2 \leq -r_1z_1^2(t) - r_2z_2^2(t) + \bigg(-k_1z_2^2(t)x_2^2(t) + b_0|z_2(t)||x_2(t)| - "
             r"k_2z_2^2(t)x_2^4(t) + c_0|z_2(t)|x_2^2(t)\bigg)", "refuted", premises=("39", "25.idle"),
             rests_on=("44", "37.failures", "61", "63", "63.drag", "43"), scope=ALL_SIGNALS, closed_loop=True,
             where={"V_2": V_40, "|z_2(t)|": sp.Abs(z_2), "|x_2(t)|": sp.Abs(x_2)}, reading=DRIVEN,
             note="Mended as 65.mended.")
def v2_bound_sizes() -> Goal:
    """D(V_2) along (58)-(62)."""
    stated = decay + (-k_1 * z_2**2 * x_2**2 + b_0 * sp.Abs(z_2) * sp.Abs(x_2) - k_2 * z_2**2 * x_2**4
                      + c_0 * sp.Abs(z_2) * x_2**2)
    goal = _bound_65(mended=False)
    return driven(Goal((at_most(D(V_40), stated),), goal.assume, goal.flow))


@paper.claim("65", "Bound of the rate of V_2 with nonlinear damping: the whole argument", "inequality",
             r"\dot{V}_2 \leq -r_1z_1^2(t) - r_2z_2^2(t) + \left(\frac{b_0^2}{4k_1} + \frac{c_0^2}{4k_2}\right)", "refuted",
             premises=("39", "25.idle"), rests_on=("63.bound", "64"), scope=ALL_SIGNALS, closed_loop=True,
             where={"V_2": V_40}, reading=DRIVEN, note="Mended as 65.mended. " + REPAIR)
def v2_bound_damping() -> Goal:
    """D(V_2) along (58)-(62)."""
    return driven(_bound_65(mended=False))


@paper.claim("65.mended", "Bound of the rate of V_2 with nonlinear damping, laws and weights mended", "inequality",
             MENDED_65, "proved", premises=("39", "25.idle", "44.mended", "61.glyph"), origin="ours", mends="65",
             scope=ALL_SIGNALS, note=REPAIR)
def v2_bound_damping_mended() -> Goal:
    """The same with (44) and (61) mended, the weights fitting."""
    return _bound_65(mended=True)


K = sp.Symbol("K", positive=True)
inequality_65 = at_most(w_t, decay + K)


@paper.claim("65.negative", "Where (65) holds, V_2 falls outside a ball of z_1 and z_2", "implication",
             r"\text{Since } r_1 \text{ and } r_2 \text{ are positive constants, it is always true that } \dot{V}_2 "
             r"\text{ is negative outside some ball}", "proved", rests_on=("65",), match="words",
             reading="Where (65) holds with the constant K, and r_1 z_1^2 + r_2 z_2^2 > K.")
def falls_outside() -> Goal:
    """(65) outside the ellipse."""
    return Goal((less(w_t, 0),), (inequality_65, greater(-decay, K)))


@paper.claim("65.ball", "Outside the ball of (65) the errors shrink", "implication",
             r"r_1z_1^2 + r_2z_2^2 > \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2} \Rightarrow \tfrac{d}{dt}(z_1^2 + z_2^2) < 0", "gap",
             premises=("65.mended",), origin="ours", scope=ALL_SIGNALS,
             note="'V_2' is negative outside some ball, so the solution is uniformly bounded' would need V_2 to be a "
                  "function of z_1 and z_2. It contains the estimation errors, for which (65) has no term: outside "
                  "the ball V_2 falls while z_1^2 + z_2^2 may rise. Shown for the mended laws.")
def errors_shrink() -> Goal:
    """D(z_1^2 + z_2^2) along (58)-(61) repaired, with an error in the estimate of a alone."""
    values: Flow = {**{x: v for x, v in (exact | unit_gains).items() if x not in (hats[0], z_1)}, k_v: sp.Integer(15),
                    rho_k_hat: sp.Rational(1, 15), **dict.fromkeys((x_2, Delta_b, Delta_c, failure, failure_hat), sp.Integer(0)),
                    **dict.fromkeys((k_1, k_2, b_0, c_0, *chis), sp.Integer(1))}
    flow = uncertain_train(rho_law_61_true)
    rises = Goal((less(D(z_1**2 + z_2**2), 0),), (*filippov, greater(-decay, constant)), {z: flow[z] for z in (z_1, z_2)})
    return at_instant(already(rises, values), {hats[0]: sp.Integer(-3), z_1: sp.Integer(0), z_2: sp.Integer(-1)})


@paper.claim("65.bounded", "The text after (65): (65) makes the solution bounded", "limit",
             r"\text{It concludes that for any initial states } z_1(0) \text{ and } z_2(0) \text{, the solution of the "
             r"closed-loop system is uniformly bounded}", "gap", rests_on=("65", "65.negative"), match="words",
             reading="Decided as what boundedness of V_2 would give, V_2 <= t from some time on; V_2 = 1 + 2t with z_1 = "
                     "z_2 = 0 and K = 2 obeys (65).",
             note="It is a solution of the inequality, not of the closed loop; leakage or projection in the adaptive laws, "
                  "which the paper mentions in section VI, would close this step, see theorem5.mended for leakage.")
def damped_bounded() -> Goal:
    """V_2 = 1 + 2 t."""
    always = (inequality_65, at_least(V_t, z_1**2 / 2 + z_2**2 / 2))
    values: Flow = {z_1: sp.Integer(0), z_2: sp.Integer(0), r_1: sp.Integer(1), r_2: sp.Integer(1), K: sp.Integer(2)}
    return Goal((at_most(V_t, t),), (), {t: sp.Integer(1), V_t: w_t}, always, eventually=t,
                model={**values, V_t: 1 + 2 * t}, inputs=(w_t, z_1, z_2))


damped_constants: Flow = {lambda_0: sp.Integer(1), b_0: sp.Integer(1), c_0: sp.Integer(1),
                          Delta_b: sp.Integer(0), Delta_c: sp.Integer(0)}


@paper.claim("65.errors", "The text after (65): The tracking errors are bounded", "limit",
             r"\text{It can concluded that the distance and speed tracking errors are bounded}", "refuted", match="words", closed_loop=True,
             rests_on=("65", "65.bounded"), scope=ALL_SIGNALS,
             reading="Of the distance: decided as what a bounded z_1 would give, z_1^2 <= t from some time on.",
             note="False as printed: " + GROWING_ERROR % LAWS_VII + "Delta_b = Delta_c = 0 and k_1 = k_2 = 7/25. It is "
                  "the tracking error itself that is not bounded, while all that is given is.")
def errors_grow() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1 + t."""
    return growing_error(at_most(z_1**2, t), nu_failed, damped_constants, *disturbed, *uncertain, damped=True, begins=1)


@paper.claim("theorem5", "Theorem 5: all signals are bounded with nonlinear damping", "limit",
             r"\text{The adaptive failure compensation controller (60), with the adaptive scheme (27)-(33), (41), (43) and "
             r"(44) applied to the system (58)-(59) with actuator failures (13)-(15), guarantees that all the closed-loop "
             r"signals are bounded}", "refuted", match="words", severity="result", closed_loop=True,
             rests_on=("65", "65.bounded"), scope=ALL_SIGNALS,
             reading="Decided as what a bounded xi_hat^T varpi would give, (xi_hat^T varpi)^2 <= t from some time on. "
                     "(61) and (62) belong to the laws, which the theorem's list leaves out.",
             note="False as printed: " + STEADY_STATE_ERROR % LAWS_VII + "Delta_b = Delta_c = 0, k_1 = k_2 = 1, and xi_hat "
                  "grows without end; along the motion of 65.errors the position error does so too. With a plus in (61) Theorem 5 falls "
                  "too (theorem5.reading). With a plus in (44) and (61) as well (65) holds, but boundedness of the estimates still does not follow from it (65.bounded); with leakage it does.")
def theorem_5() -> Goal:
    """The printed closed loop, with a motion along which xi_hat grows without end."""
    return _damped_loop(at_most(Xi_hat**2, t), 1, begins=1)


def _damped_loop(show: Relation, k: int, turned: bool = False, begins: int = 0) -> Goal:
    constants = {**damped_constants, **dict.fromkeys((k_1, k_2), sp.Integer(k))}
    if not begins:
        constants[epsilon] = sp.Rational(1, 4)
    return steady_state_error(show, nu_failed, constants, *disturbed, *uncertain, damped=True, turned=turned, begins=begins)


@paper.claim("theorem5.reading", "Theorem 5 with a plus before nu_Delta in (61) alone", "limit", LAW_61 % ""
             + r"\ \Rightarrow\ \hat\xi\ \text{is bounded}", "refuted", origin="ours", closed_loop=True, rests_on=(), scope=ALL_SIGNALS,
             reading="Decided as Theorem 5 is, at k_1 = k_2 = 1.", note="xi_hat grows like t.")
def theorem_5_in_the_other_reading() -> Goal:
    """(44) as printed, (61) with a plus."""
    return _damped_loop(at_most(Xi_hat**2, t), 1, turned=True, begins=1)


LEAKY = (r"-\kappa\ \text{times the estimate in each adaptive law, of every mode at all times,}\ +\ \text{in (44) and (61),}\ "
         + WEIGHTS + r":\ ")
E_0 = (r"E_0 = \tfrac{mk_\nu}{2\Gamma_{k\nu}}\rho_{k\nu}^2 + \tfrac{m}{2\Gamma_\xi}\xi^T\xi + \sum_{i=1}^{l}\left(\tfrac{mk_\nu}"
       r"{2\Gamma_{mi}}\rho_i^2 + \tfrac{1}{2\Gamma_{ai}}a_i^2 + \dots + \tfrac{1}{2\Gamma_{Di}}D_i^2\right)")


@paper.claim("65.leakage.idle", "With leakage the part of V_2 of an idle mode decays", "inequality",
             r"\chi_{\varrho i} = 0:\ \dot V_i \le -\kappa V_i + \kappa E_i,\ V_i = \tfrac{1}{2\Gamma_{ai}}\tilde a_i^2 + \dots + "
             r"\tfrac{m_ik_\nu}{2\Gamma_{mi}}\tilde\rho_i^2,\ E_i = \tfrac{1}{2\Gamma_{ai}}a_i^2 + \dots + "
             r"\tfrac{m_ik_\nu}{2\Gamma_{mi}}\rho_i^2", "proved", origin="ours", scope="each idle mode")
def idle_mode_leaky() -> Goal:
    """Each estimate falls by itself."""
    return idle_mode()


@paper.claim("65.leakage", "Bound of the rate of V_2 with leakage", "inequality",
             LEAKY + r"\dot{V}_2 \leq -r_1z_1^2 - r_2z_2^2 - \kappa E + \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2} + \kappa E_0,\ " + E_0, "proved",
             premises=("39", "65.leakage.idle", "44.mended", "61.glyph"), origin="ours", scope=ALL_SIGNALS,
             reading="E is the part of V_2 that the estimation errors of all modes make, E_0 what it is while all estimates are zero. "
                     "Of the idle modes V_idle obeys 65.leakage.idle, summed over them.",
             note="The paper mentions robust adaptation in section VI, and prints no law with it.")
def v2_bound_leaky() -> Goal:
    """D(V_2) along the mended loop with leakage."""
    return rate_of_every_mode()


@paper.claim("65.leakage.decay", "The rate of V_2 with leakage is one of decay", "inequality",
             r"\mu = \min\{2r_1, 2r_2, \kappa\} \Rightarrow -r_1z_1^2 - r_2z_2^2 - \kappa E \le -\mu V_2", "proved", origin="ours",
             scope=ALL_SIGNALS)
def leaky_decay() -> Goal:
    """Term by term."""
    return LEAKAGE["decay"]


@paper.claim("62.bounded", "The nonlinear damping is bounded with the speed", "inequality",
             r"\nu_\Delta^2 \le 4B(k_1^2X^2 + k_2^2X^4)\ \text{for}\ z_2^2 \le 2B,\ x_2^2 \le X", "proved", origin="ours")
def damping_bounded() -> Goal:
    """Two terms, each bounded."""
    return Goal((at_most(nu_damp**2, 4 * B * (k_1**2 * X_max**2 + k_2**2 * X_max**4)),),
                (at_most(z_2**2, 2 * B), at_most(x_2**2, X_max)))


@paper.claim("theorem5.mended", "Theorem 5 with a plus in (44) and (61), leakage in the adaptive laws and one mass in all modes", "implication",
             r"\text{From } T_{\bar M} \text{ on, the last failure or change of its constants, time zero being then, with}\ " + LEAKY + r"V_2(t) \le \tfrac{\Lambda}{\mu} + \left(V_2(0) - "
             r"\tfrac{\Lambda}{\mu}\right)e^{-\mu t},\ \mu = \min\{2r_1, 2r_2, \kappa\},\ \Lambda = \tfrac{b_0^2}{4k_1} + "
             r"\tfrac{c_0^2}{4k_2} + \kappa E_0,\ " + E_0 + r"\text{; all signals are bounded, if}\ x_m, \dot x_m, \ddot x_m\ \text{and all}\ f_{j\rho}\ "
             r"\text{are}", "proved", origin="ours", mends="theorem5",
             severity="result", scope=ALL_SIGNALS,
             premises=("65.leakage", "65.leakage.decay", "40.mended", "46.jump", "25.switch", "theorem1.bounded", "62.bounded",
                       "47.signal.mended", "filippov"),
             reading="V_2 has no jump at a switch (25.switch), and a finite one at a failure (46.jump).",
             note="So z_1, z_2 and all estimation errors are bounded; x_2 by theorem1.bounded, nu_0 by 47.signal.mended with 62.bounded. "
                  "The errors end within a ball, they do not tend to zero.")
def theorem_5_mended() -> Goal:
    """exp(mu t)(V_2 - Lambda/mu) does not increase."""
    return LEAKAGE["bounded"]


@paper.claim("remark4.constant", "The constant of (65) can be made as small as desired", "implication",
             r"k_1 \text{ and } k_2 \text{ can be chosen to make the constant term } \frac{b_0^2}{4k_1} + "
             r"\frac{c_0^2}{4k_2} \text{ as small as desired}", "proved", match="words",
             reading="For every rho > 0, k_1 >= b_0^2/(2 rho) and k_2 >= c_0^2/(2 rho) make it at most rho.",
             note="It takes known bounds b_0 and c_0, which section VII lets be unknown.")
def small_constant() -> Goal:
    """Large k_1 and k_2."""
    rho = sp.Symbol("rho", positive=True)
    return Goal((at_most(constant, rho),), (at_least(k_1 * 2 * rho, b_0**2), at_least(k_2 * 2 * rho, c_0**2)))


@paper.claim("remark4.mean", "With (65) mended: a bound of the mean squares of the errors", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + K \Rightarrow \tfrac1t\int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le \tfrac{V_2(0)}{t} + K",
             "proved", premises=("65.mended",), origin="ours", mends="remark4", severity="result",
             note="The part of Remark 4 that follows from (65), which takes a plus in (44) and in (61) and one mass in all modes (65.mended).")
def mean_square() -> Goal:
    """J + V - K t does not increase, where J is the integral."""
    return Goal((at_most(J, V_0 + K * t),), (at_least(V_t, 0), at_least(t, 0)),
                {t: sp.Integer(1), V_t: w_t, J: -decay}, (inequality_65,),
                {t: sp.Integer(0), V_t: V_0, J: sp.Integer(0)}, decreasing=J + V_t - K * t, inputs=(w_t, z_1, z_2))


@paper.claim("remark4", "Remark 4: large k_1 and k_2 make the tracking errors small", "limit",
             r"\text{the tracking errors can achieve an arbitrary degree of accuracy. The larger the constants } k_1 > 0 "
             r"\text{ and } k_2 > 0 \text{ are, the smaller the tracking errors } z_1 \text{ and } z_2 \text{ are}",
             "refuted", match="words", severity="result", closed_loop=True, rests_on=("65", "remark4.constant"),
             scope=ALL_SIGNALS, reading="Decided as z_1^2 <= 1/4 from some time on, at k_1 = k_2 = 1000.",
             note="False as printed, shown for k_1 = k_2 = 1000: " + STEADY_STATE_ERROR % LAWS_VII + "With a plus in (61) Remark 4 falls too "
                  "(remark4.reading). Even with the laws repaired (65) bounds the errors in the mean only (remark4.mean), not at each "
                  "instant (65.ball).")
def remark_4() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return _damped_loop(at_most(z_1**2, epsilon), 1000)


@paper.claim("remark4.reading", "Remark 4 with a plus before nu_Delta in (61) alone", "limit", LAW_61 % "" + r",\ k_1 = k_2 = 1000\ "
             r"\Rightarrow\ \lim_{t\to\infty} z_1^2(t) \le \tfrac14", "refuted", origin="ours", closed_loop=True, rests_on=(),
             scope=ALL_SIGNALS)
def remark_4_in_the_other_reading() -> Goal:
    """(44) as printed, (61) with a plus."""
    return _damped_loop(at_most(z_1**2, epsilon), 1000, turned=True)
