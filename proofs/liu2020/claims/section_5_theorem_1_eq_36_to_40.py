"""Section 5, Theorem 1: the rate of V_1, (36)-(40), and (40) for Table 2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, equal

from ..error_dynamics import (
    W_f_off,
    W_f_tilde,
    delta,
    delta_off,
    delta_tilde,
    eps_tilde,
    observer_loop,
    theta_tilde,
    w_f,
    w_v,
)
from ..goal_forms import moves_alike, small_hidden, with_gain
from ..laws import alpha_1, beta_1, delta_hat, e_v, g_f, gamma_1, h_f, indexed, k_1, k_2, k_3, s_tilde, sigma_f, v_tilde
from ..lyapunov import V_1
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..stated_values import exactly, stated

paper.definition("36.definition", "The Lyapunov function V_1",
                 r"V_1 = \frac{1}{2}\tilde{s}^2 + \frac{1}{2}\tilde{v}^2 + \frac{1}{2}\tilde{W}_f^T\Gamma_f^{-1}\tilde{W}_f + "
                 r"\frac{1}{2\alpha_1}\tilde{\delta}^2")


@paper.claim("36", "V_1 is not negative", "inequality", r"V_1 \ge 0", "proved", origin="implied", scope=EVERY_NETWORK,
             note="What makes (36) a Lyapunov function, and the left half of (47).")
def v1_not_negative() -> Goal:
    """Squares with positive weights."""
    return Goal((at_least(V_1, 0),))


s_rate, v_rate, delta_rate, e_rate, theta_rate = sp.symbols("sdot vdot deltadot edot thetadot", real=True)
w_f_rate, w_v_rate = indexed("wdot_f"), indexed("wdot_v")
free_1 = {s_tilde: s_rate, v_tilde: v_rate, w_f: w_f_rate, delta_tilde: delta_rate}
free_2 = free_1 | {e_v: e_rate, w_v: w_v_rate, theta_tilde: theta_rate}
rate_37 = (s_tilde * s_rate + v_tilde * v_rate + over_neurons(w_f * w_f_rate) + delta_tilde * delta_rate / alpha_1)


@paper.claim("37", "Rate of V_1 before the laws are put in", "identity",
             r"\dot V_1 = \tilde s\dot{\tilde s} + \tilde v\dot{\tilde v} + \tilde W_f^T\Gamma_f^{-1}\dot{\tilde W}_f + "
             r"\frac{1}{\alpha_1}\tilde\delta\dot{\tilde\delta}", "proved", rests_on=(), scope=EVERY_NETWORK, where=ERRORS,
             note="(38) prints the same line once more.")
def v1_rate_open() -> Goal:
    """D(V_1) with free rates."""
    return Goal((equal(D(V_1), rate_37),), flow=free_1)


@paper.claim("38", "Rate of V_1 once more", "identity",
             r"\dot V_1 = \tilde s\dot{\tilde s} + \tilde v\dot{\tilde v} + \tilde W_f^T\Gamma_f^{-1}\dot{\tilde W}_f + "
             r"\frac{1}{\alpha_1}\tilde\delta\dot{\tilde\delta}", "proved", severity="cosmetic", rests_on=("37",),
             scope=EVERY_NETWORK, where=ERRORS,
             note="Letter by letter (37). With the rates of the estimates in the place of those of the errors, as (39) "
                  "uses it, see 38.delta.")
def v1_rate_again() -> Goal:
    """D(V_1) with free rates."""
    return Goal((equal(D(V_1), rate_37),), flow=free_1)


@paper.claim("38.delta", "The error of the estimate of delta moves as the estimate does", "implication",
             r"\tilde\delta = \hat\delta - \delta,\ \delta = \tilde\varepsilon_f(z_1) \Rightarrow "
             r"\dot{\tilde\delta} = \dot{\hat\delta}", "gap", origin="implied", rests_on=("38",),
             correction=lambda: moves_alike(delta_hat, delta, constant_truth=True),
             corrected_statement=r"\delta\ \text{constant} \Rightarrow \dot{\tilde\delta} = \dot{\hat\delta}",
             note="The step from (38) to (39). delta = eps_tilde(z_1) changes with position, speed and input, so "
                  "-delta_tilde delta'/alpha_1 is missing from (39). A constant bound delta of |eps_tilde| avoids it, "
                  "such as that of 18.bound, and that reading also mends 42.delta.")
def delta_moves() -> Goal:
    """D(delta_hat - delta) with a moving delta."""
    return moves_alike(delta_hat, delta)


quadratic_part = (-k_1 * s_tilde**2 - k_3 * v_tilde**2 + (1 - k_2 + k_1 * k_3) * s_tilde * v_tilde)
leak_f = sigma_f * over_neurons(W_f_tilde * (W_f_tilde + W_f_off))
leak_delta = beta_1 * delta_tilde * (delta_tilde + delta_off)


def _lines_39(residual: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Both lines of (39), `residual` being what the networks leave, delta in print."""
    first = (s_tilde * (v_tilde - k_1 * s_tilde)
             + v_tilde * (-k_3 * v_tilde - (k_2 - k_1 * k_3) * s_tilde + over_neurons(W_f_tilde * h_f)
                          - gamma_1(v_tilde) * (delta_tilde + delta) + residual)
             + over_neurons(W_f_tilde * (-h_f * v_tilde + sigma_f * (W_f_tilde + W_f_off)))
             + delta_tilde * (gamma_1(v_tilde) * v_tilde + beta_1 * (delta_tilde + delta_off)))
    second = quadratic_part + v_tilde * (-gamma_1(v_tilde) * delta + residual) + leak_f + leak_delta
    return first, second


def _printed_39(residual: str) -> str:
    return (r"\dot V_1 = \tilde s(\tilde v - k_1\tilde s) + \tilde v(-k_3\tilde v - (k_2 - k_1k_3)\tilde s + "
            rf"\tilde W_f^Th_f(\hat z_1) - \gamma(\dot{{\tilde s}} + k_1\tilde s)\hat\delta + {residual}) + "
            r"\tilde W_f^T\Gamma_f^{-1}\Gamma_f(-h_f(\hat z_1)(\dot{\tilde s} + k_1\tilde s) + "
            r"\sigma_f(\hat W_f - W_{f0})) + \frac{1}{\alpha_1}\tilde\delta\alpha_1(\gamma(\dot{\tilde s} + "
            r"k_1\tilde s)(\dot{\tilde s} + k_1\tilde s) + \beta_1(\hat\delta - \delta_0)) "
            r"= -k_1\tilde s^2 - k_3\tilde v^2 + (1 - k_2 + k_1k_3)\tilde s\tilde v + \tilde v(-\gamma(\tilde v)\delta + "
            rf"{residual}) + \sigma_f\tilde W_f^T(\hat W_f - W_{{f0}}) + \tilde\delta\beta_1(\hat\delta - \delta_0)")


PRINTED_39, MENDED_39 = _printed_39(r"\delta"), _printed_39(r"\tilde\varepsilon_f")
delta_dot = sp.Symbol("delta_dot", real=True)


def _rate_of_v1(moving_delta: bool, *given: Relation) -> Goal:
    """D(V_1) along (13), (18)-(21) against both lines of (39): delta the residual itself, or a constant beside it."""
    residual = delta if moving_delta else eps_tilde
    flow, (first, second) = observer_loop(residual=residual), _lines_39(residual)
    if moving_delta:
        flow = flow | {delta: delta_dot, delta_tilde: flow[delta_tilde] - delta_dot}
    return Goal((equal(D(V_1), first), equal(first, second)), given, flow=flow)


@paper.claim("39", "Rate of V_1 in closed loop", "identity", PRINTED_39, "refuted",
             premises=("18.glyph", "19.cancels", "20.cancels"), rests_on=("13", "18.glyph", "19", "20", "21", "38.delta"),
             scope=EVERY_NETWORK,
             where=ERRORS,
             reading="Hats and tildes over delta and W_f as (19) to (21) have them; eps_tilde_f = delta, as the text "
                     "defines delta.",
             correction=lambda: _rate_of_v1(moving_delta=False),
             corrected_statement=r"\dot\delta = 0:\quad " + MENDED_39,
             note="delta is the function eps_tilde_f(z_1), which moves; then -delta_tilde delta'/alpha_1 is missing, see "
                  "38.delta. For a constant delta, such as a bound of |eps_tilde_f|, both lines hold with eps_tilde_f in the "
                  "place of the delta that is not multiplied by gamma, see 39.mended. The leakage terms enter with plus, as "
                  "(19) and (21) have it.")
def v1_rate_closed() -> Goal:
    """D(V_1) along (13), (18)-(21), delta moving."""
    return _rate_of_v1(True, *small_hidden(h_f), *with_gain(g_f))


@paper.claim("39.mended", "Rate of V_1 in closed loop for a constant delta", "identity", MENDED_39, "proved",
             origin="ours", mends="39", premises=("18.glyph", "19.cancels", "20.cancels"), rests_on=(),
             scope=EVERY_NETWORK, where=ERRORS | {r"\tilde\varepsilon_f": eps_tilde},
             note="For any constant delta, whether it is eps_tilde_f or a bound of it.")
def v1_rate_constant_delta() -> Goal:
    """D(V_1) along (13), (18)-(21), delta at rest."""
    return _rate_of_v1(moving_delta=False)


linear_part = {s_tilde: v_tilde - k_1 * s_tilde, v_tilde: -k_3 * v_tilde - (k_2 - k_1 * k_3) * s_tilde}
columns = [tuple(map(exactly, values)) for values in zip(*(stated["gains"][name] for name in ("k_1", "k_2", "k_3")),
                                                         strict=True)]
crossing = [1 - two + one * three for one, two, three in columns]  # what (40) leaves of the cross term, per column
undamped = [str(column) for column, (left, (one, _, three)) in enumerate(zip(crossing, columns, strict=True), start=1)
            if left**2 >= 4 * one * three]  # where the squares of (39) do not outweigh it
worst = columns[-1]


@paper.claim("40", "(40) holds for the gains of Table 2", "condition", r"-k_2 + k_1k_3 + 1 = 0", "violated",
             at=dict(zip((k_1, k_2, k_3), worst, strict=True)), rests_on=(),
             note="No column meets it; decided for Value 10. Left sides of Values 1 to 10: "
                  f"{', '.join(f'{float(left):.{max(4, len(str(int(left))))}g}' for left in crossing)}. The cross term of "
                  f"(39) stays, and for {'Values ' + ', '.join(undamped) if undamped else 'no value'} the squares do not outweigh it. "
                  "(40) is no hypothesis of the theorems either. It can be dropped: with V of 40.needless, another weight on "
                  "s_tilde, the proof keeps the stated gains.")
def cross_term_vanishes() -> Goal:
    """The left side of (40) at the gains of Value 10."""
    return Goal((equal(-k_2 + k_1 * k_3 + 1, 0),))


@paper.claim("40.cross", "(40) removes the cross term", "implication",
             r"-k_2 + k_1k_3 + 1 = 0 \Rightarrow \frac{d}{dt}\left(\frac{1}{2}\tilde s^2 + \frac{1}{2}\tilde v^2\right) = "
             r"-k_1\tilde s^2 - k_3\tilde v^2", "proved", origin="implied", rests_on=(),
             note="Along the linear part of (13), (18).")
def no_cross_term() -> Goal:
    """The quadratic part of V_1 under (40)."""
    return Goal((equal(D(s_tilde**2 / 2 + v_tilde**2 / 2), -k_1 * s_tilde**2 - k_3 * v_tilde**2),),
                (equal(-k_2 + k_1 * k_3 + 1, 0),), linear_part)


@paper.claim("40.needless", "Another weight on the position estimate's error does without (40)", "identity",
             r"\frac{d}{dt}\left(\frac{1}{2}(k_2 + k_1k_3)\tilde s^2 + \frac{1}{2}\tilde v^2\right) = -k_1k_2\tilde s^2 - "
             r"k_3(\tilde v - k_1\tilde s)^2", "proved", origin="ours", rests_on=(),
             note="For all positive k_1, k_2, k_3, so also for those of Table 2, which break (40); the adaptation laws need "
                  "no change.")
def other_weight() -> Goal:
    """The linear part of (13), (18)."""
    weighted = (k_2 + k_1 * k_3) * s_tilde**2 / 2 + v_tilde**2 / 2
    return Goal((equal(D(weighted), -k_1 * k_2 * s_tilde**2 - k_3 * (v_tilde - k_1 * s_tilde) ** 2),),
                flow=linear_part)
