"""mao2018, section VII: the bound (65) of the rate of V_2, Theorem 5 and Remark 4."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, greater, less

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
    rho_hat,
    rho_k_hat,
    rho_law_61,
    rho_law_61_true,
)
from ..counterexamples import already, exact, stopped, unit_gains
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
from ..lyapunov import V_0, J, V_t, V_true, constant, decay, w_t
from ..paper import paper
from ..plant import Delta_b, Delta_c, drag, r_1, r_2, t, x_2, z_1, z_2
from ..steady_state_error import STEADY_STATE_ERROR, Xi_hat, epsilon, steady_state_error
from .section_4_theorem_2 import REPAIR


def _bound_65(law: sp.Expr) -> Goal:
    damped = z_2 * (nu_damp - drag)
    return Goal((at_most(D(V_true), decay + constant),),
                (*filippov, *disturbed, *uncertain, at_most(chi_d, 1), at_least(m * k_v, rho_0)), uncertain_train(law),
                lemmas=(*within, at_most(Delta_b**2, b_0**2), at_most(Delta_c**2, c_0**2), at_most(damped, constant),
                        at_most(D(V_true), decay + damped)))


@paper.claim("65", "Bound of the rate of V_2 with nonlinear damping: the whole argument", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}", "gap",
             premises=("39", "45", "25.idle"), scope=ALL_SIGNALS, correction=lambda: _bound_65(rho_law_61_true),
             corrected_statement=r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}\ \text{with}\ "
                                 r"+\nu_\Delta\ \text{in (61)}",
             note=REPAIR + "All this granted, (61) as printed still breaks the bound, and its opposite sign mends it.")
def v2_bound_damping() -> Goal:
    """D(V_2) along (58)-(61), everything but (61) repaired."""
    rest: Flow = dict.fromkeys((Delta_b, Delta_c, b_0, c_0), sp.Integer(0))
    gains_one = {x: value for x, value in unit_gains.items() if x != rho_hat} | {x_2: sp.Integer(1)}
    return already(_bound_65(rho_law_61), exact | gains_one | rest | stopped | {
        k_v: sp.Integer(15), k_1: sp.Integer(1), k_2: sp.Integer(1), rho_k_hat: sp.Rational(1, 15)})


K = sp.Symbol("K", positive=True)
inequality_65 = at_most(w_t, decay + K)


@paper.claim("65.ball", "Outside the ball of (65) the errors shrink", "implication",
             r"r_1z_1^2 + r_2z_2^2 > \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2} \Rightarrow \tfrac{d}{dt}(z_1^2 + z_2^2) < 0", "gap",
             premises=("65",), scope=ALL_SIGNALS,
             note="'V_2' is negative outside some ball, so the solution is uniformly bounded' would need V_2 to be a "
                  "function of z_1 and z_2. It contains the estimation errors, for which (65) has no term: outside "
                  "the ball V_2 falls while z_1^2 + z_2^2 may rise. Shown for the repaired laws.")
def errors_shrink() -> Goal:
    """D(z_1^2 + z_2^2) along (58)-(61) repaired, with an error in the estimate of a alone."""
    values: Flow = {**{x: v for x, v in (exact | unit_gains).items() if x not in (hats[0], z_1)}, k_v: sp.Integer(15),
                    rho_k_hat: sp.Rational(1, 15), **dict.fromkeys((x_2, Delta_b, Delta_c, failure, failure_hat), sp.Integer(0)),
                    **dict.fromkeys((k_1, k_2, b_0, c_0, *chis), sp.Integer(1))}
    flow = uncertain_train(rho_law_61_true)
    return already(Goal((less(D(z_1**2 + z_2**2), 0),), (*filippov, greater(-decay, constant)),
                        {z: flow[z] for z in (z_1, z_2)}), values)


@paper.claim("65.bounded", "(65) makes V_2 bounded", "limit",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + K,\ V_2 \ge \tfrac12(z_1^2 + z_2^2) \Rightarrow V_2\ \text{bounded}", "gap",
             premises=("65",),
             note="Decided as what boundedness would give, V_2 <= t from some time on; V_2 = 1 + 2t with z_1 = z_2 = 0 "
                  "and K = 2 obeys (65). It is a solution of the inequality, not of the closed loop; leakage or "
                  "projection in the adaptive laws, which the paper mentions in section VI, would close this step.")
def damped_bounded() -> Goal:
    """V_2 = 1 + 2 t."""
    always = (inequality_65, at_least(V_t, z_1**2 / 2 + z_2**2 / 2))
    values: Flow = {z_1: sp.Integer(0), z_2: sp.Integer(0), r_1: sp.Integer(1), r_2: sp.Integer(1), K: sp.Integer(2)}
    return Goal((at_most(V_t, t),), (), {t: sp.Integer(1), V_t: w_t}, always, eventually=t,
                model={**values, V_t: 1 + 2 * t}, inputs=(w_t, z_1, z_2))


damped_constants: Flow = {lambda_0: sp.Integer(1), b_0: sp.Integer(1), c_0: sp.Integer(1),
                          Delta_b: sp.Integer(0), Delta_c: sp.Integer(0)}


@paper.claim("theorem5", "All signals are bounded with nonlinear damping", "limit",
             r"\hat\xi^T\varpi\ \text{bounded under (27)-(31), (41), (43), (44), (60)-(62)}", "gap", premises=("65", "65.bounded"),
             scope=ALL_SIGNALS,
             note="False as printed: " + STEADY_STATE_ERROR + "Delta_b = Delta_c = 0 and k_1 = k_2 = 1. Decided as what "
                  "boundedness would give, (xi_hat^T varpi)^2 <= t from some time on. Mended as 45 and 65 are, (65) "
                  "holds, but boundedness of the estimates still does not follow from it (65.bounded).")
def theorem_5() -> Goal:
    """The printed closed loop, with a motion along which xi_hat grows without end."""
    return steady_state_error(at_most(Xi_hat**2, t), nu_failed, {**damped_constants, k_1: sp.Integer(1), k_2: sp.Integer(1)},
                           *disturbed, *uncertain, damped=True)


@paper.claim("remark4.constant", "The constant of (65) can be made as small as desired", "implication",
             r"k_1 \ge \tfrac{b_0^2}{2\rho},\ k_2 \ge \tfrac{c_0^2}{2\rho} \Rightarrow \tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2} "
             r"\le \rho", "proved", note="For every rho > 0; it takes known bounds b_0 and c_0, which section VII lets "
                                         "be unknown.")
def small_constant() -> Goal:
    """Large k_1 and k_2."""
    rho = sp.Symbol("rho", positive=True)
    return Goal((at_most(constant, rho),), (at_least(k_1 * 2 * rho, b_0**2), at_least(k_2 * 2 * rho, c_0**2)))


@paper.claim("remark4.mean", "What (65) says of the errors: a bound of their mean squares", "implication",
             r"\dot V_2 \le -r_1z_1^2 - r_2z_2^2 + K \Rightarrow \tfrac1t\int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le \tfrac{V_2(0)}{t} + K",
             "proved", premises=("65",), note="Not printed; the part of Remark 4 that follows once (65) is repaired.")
def mean_square() -> Goal:
    """J + V - K t does not increase, where J is the integral."""
    return Goal((at_most(J, V_0 + K * t),), (at_least(V_t, 0), at_least(t, 0)),
                {t: sp.Integer(1), V_t: w_t, J: -decay}, (inequality_65,),
                {t: sp.Integer(0), V_t: V_0, J: sp.Integer(0)}, decreasing=J + V_t - K * t, inputs=(w_t, z_1, z_2))


@paper.claim("remark4", "Large k_1 and k_2 make the tracking errors small", "limit",
             r"k_1, k_2\ \text{large} \Rightarrow z_1^2 \le \epsilon\ \text{from some time on}", "gap",
             premises=("65", "remark4.constant"), scope=ALL_SIGNALS, correction=mean_square,
             corrected_statement=r"\text{with 65 repaired:}\ \tfrac1t\int_0^t(r_1z_1^2 + r_2z_2^2)\,d\tau \le \tfrac{V_2(0)}{t} + "
                                 r"\tfrac{b_0^2}{4k_1} + \tfrac{c_0^2}{4k_2}",
             note="False as printed, shown for k_1 = k_2 = 1000 and the same for all: " + STEADY_STATE_ERROR + "Even with the "
                  "laws repaired (65) bounds the errors in the mean only, not at each instant (65.ball).")
def remark_4() -> Goal:
    """The printed closed loop, with a motion along which z_1 = 1."""
    return steady_state_error(at_most(z_1**2, epsilon), nu_failed,
                           {**damped_constants, epsilon: sp.Rational(1, 4), k_1: sp.Integer(1000), k_2: sp.Integer(1000)},
                           *disturbed, *uncertain, damped=True)
