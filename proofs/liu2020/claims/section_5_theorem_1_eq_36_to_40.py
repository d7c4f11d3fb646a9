"""Section 5, Theorem 1: the rate of V_1, (36)-(40), and (40) for Table 2."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, equal

from ..error_dynamics import W_f_off, W_f_tilde, delta, delta_off, delta_tilde, observer_loop, theta_tilde, w_f, w_v
from ..goal_forms import moves_alike
from ..laws import alpha_1, beta_1, delta_hat, e_v, gamma_1, h_f, indexed, k_1, k_2, k_3, s_tilde, sigma_f, v_tilde
from ..lyapunov import V_1
from ..paper import EVERY_NETWORK, paper
from ..stated_values import exactly, stated


@paper.claim("36", "V_1 is not negative", "inequality", r"V_1 \ge 0", "proved", scope=EVERY_NETWORK)
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
             r"\tfrac1{\alpha_1}\tilde\delta\dot{\tilde\delta}", "proved", scope=EVERY_NETWORK)
def v1_rate_open() -> Goal:
    """D(V_1) with free rates."""
    return Goal((equal(D(V_1), rate_37),), flow=free_1)


@paper.claim("38", "The error of the estimate of delta moves as the estimate does", "implication",
             r"\tilde\delta = \hat\delta - \delta,\ \delta = \tilde\varepsilon_f(z_1) \Rightarrow "
             r"\dot{\tilde\delta} = \dot{\hat\delta}", "gap", premises=("37",),
             correction=lambda: moves_alike(delta_hat, delta, constant_truth=True),
             corrected_statement=r"\delta\ \text{constant} \Rightarrow \dot{\tilde\delta} = \dot{\hat\delta}",
             note="The step from (37) to (39). delta = eps_tilde(z_1) changes with position, speed and input, so "
                  "-delta_tilde delta'/alpha_1 is missing from (39). A constant bound delta of |eps_tilde| avoids it, "
                  "and that reading also mends 42.delta.")
def delta_moves() -> Goal:
    """D(delta_hat - delta) with a moving delta."""
    return moves_alike(delta_hat, delta)


quadratic_part = (-k_1 * s_tilde**2 - k_3 * v_tilde**2 + (1 - k_2 + k_1 * k_3) * s_tilde * v_tilde)
leak_f = sigma_f * over_neurons(W_f_tilde * (W_f_tilde + W_f_off))
leak_delta = beta_1 * delta_tilde * (delta_tilde + delta_off)
rate_39 = quadratic_part + v_tilde * (-gamma_1(v_tilde) * delta + delta) + leak_f + leak_delta


@paper.claim("39", "Rate of V_1 in closed loop", "identity",
             r"\dot V_1 = -k_1\tilde s^2 - k_3\tilde v^2 + (1 - k_2 + k_1k_3)\tilde s\tilde v + \tilde v(-\gamma(\tilde v)"
             r"\delta + \delta) + \sigma_f\tilde W_f^T(\hat W_f - W_{f0}) + \beta_1\tilde\delta(\hat\delta - \delta_0)",
             "proved", premises=("18", "19", "20", "38"), scope=EVERY_NETWORK,
             note="Both lines of (39), for eps_tilde = delta and delta' = 0. The leakage terms enter with plus, as "
                  "(19) and (21) have it.")
def v1_rate_closed() -> Goal:
    """D(V_1) along (13), (18)-(21)."""
    loop = observer_loop()
    first_line = (s_tilde * (v_tilde - k_1 * s_tilde)
                  + v_tilde * (-k_3 * v_tilde - (k_2 - k_1 * k_3) * s_tilde + over_neurons(W_f_tilde * h_f)
                               - gamma_1(v_tilde) * (delta_tilde + delta) + delta)
                  + over_neurons(-W_f_tilde * h_f * v_tilde) + leak_f
                  + delta_tilde * gamma_1(v_tilde) * v_tilde + leak_delta)
    return Goal((equal(D(V_1), first_line), equal(first_line, rate_39)), flow=loop)


linear_part = {s_tilde: v_tilde - k_1 * s_tilde, v_tilde: -k_3 * v_tilde - (k_2 - k_1 * k_3) * s_tilde}


@paper.claim("40", "(40) removes the cross term", "implication",
             r"-k_2 + k_1k_3 + 1 = 0 \Rightarrow \frac{d}{dt}\tfrac12(\tilde s^2 + \tilde v^2) = -k_1\tilde s^2 - "
             r"k_3\tilde v^2", "proved", note="Along the linear part of (13), (18).")
def no_cross_term() -> Goal:
    """The quadratic part of V_1 with k_2 = 1 + k_1 k_3."""
    along = {error: rate.xreplace({k_2: 1 + k_1 * k_3}) for error, rate in linear_part.items()}
    return Goal((equal(D(s_tilde**2 / 2 + v_tilde**2 / 2), -k_1 * s_tilde**2 - k_3 * v_tilde**2),), flow=along)


@paper.claim("40.needless", "Another weight on the position estimate's error does without (40)", "identity",
             r"\frac{d}{dt}\tfrac12\left((k_2 + k_1k_3)\tilde s^2 + \tilde v^2\right) = -k_1k_2\tilde s^2 - "
             r"k_3(\tilde v - k_1\tilde s)^2", "proved",
             note="Not in the paper. For all positive k_1, k_2, k_3, so also for those of Table 2, which break (40); the "
                  "adaptation laws need no change.")
def other_weight() -> Goal:
    """The linear part of (13), (18)."""
    weighted = (k_2 + k_1 * k_3) * s_tilde**2 / 2 + v_tilde**2 / 2
    return Goal((equal(D(weighted), -k_1 * k_2 * s_tilde**2 - k_3 * (v_tilde - k_1 * s_tilde) ** 2),),
                flow=linear_part)


def _stated_gains(column: int, gains: tuple[Fraction, ...]) -> None:
    one, two, three = gains
    left = 1 - two + one * three
    damped = left**2 < 4 * one * three
    verdict = "outweigh it nevertheless" if damped else "do not outweigh it either"

    @paper.claim(f"40.value{column}", f"(40) holds for Value {column} of Table 2", "condition",
                 r"-k_2 + k_1k_3 + 1 = 0", "violated", at=dict(zip((k_1, k_2, k_3), gains, strict=True)),
                 repair={k_1: one, k_2: 1 + one * three, k_3: three}, premises=("40",),
                 note=f"The cross term {float(left):.4g} s_tilde v_tilde stays in (39); the squares {verdict} "
                      f"(4 k_1 k_3 = {float(4 * one * three):.4g} against its square {float(left**2):.4g}). "
                      "The repair takes k_2 = 1 + k_1 k_3; see 40.needless for a proof that keeps the stated gains.")
    def cross_term_vanishes() -> Goal:
        return Goal((equal(-k_2 + k_1 * k_3 + 1, 0),))


for column, values in enumerate(zip(*(stated["gains"][name] for name in ("k_1", "k_2", "k_3")), strict=True), start=1):
    _stated_gains(column, tuple(map(exactly, values)))
