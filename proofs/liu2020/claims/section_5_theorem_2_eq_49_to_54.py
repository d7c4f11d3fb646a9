"""Section 5, Theorem 2: the rate of V_2, (49)-(54)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, equal

from ..error_dynamics import W_v_off, W_v_tilde, r_v, theta, theta_off, theta_tilde, tracking_loop, w_v
from ..goal_forms import moves_alike, small_hidden, with_gain
from ..laws import alpha_2, beta_2, e_v, g_v, gamma_2, h_v, k_5, kappa_2, sigma_v, theta_hat
from ..lyapunov import V_1, V_2, norm_v, prior_v
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi, d
from .section_5_theorem_1_eq_36_to_40 import e_rate, free_1, free_2, theta_rate, w_v_rate
from .section_5_theorem_1_eq_41_to_43 import OPPOSITE, leak_claims, robust_claims

paper.definition("49.definition", "The Lyapunov function V_2",
                 r"V_2 = V_1 + \frac{M}{2\chi}e_v^2 + \frac{1}{2}\tilde{W}_v^T\Gamma_v^{-1}\tilde{W}_v + "
                 r"\frac{1}{2\alpha_2}\tilde{\theta}^2")


@paper.claim("49", "V_2 is not negative", "inequality", r"V_2 \ge 0", "proved", origin="implied", premises=("36",),
             scope=EVERY_NETWORK, note="What makes (49) a Lyapunov function, and the left half of (59).")
def v2_not_negative() -> Goal:
    """Squares with positive weights."""
    return Goal((at_least(V_2, 0),))


rate_tracking = M / chi * e_v * e_rate + over_neurons(w_v * w_v_rate) + theta_tilde * theta_rate / alpha_2
PRINTED_50 = (r"\dot V_2 = \dot V_1 + \frac{M}{\chi}e_v\dot e_v + \tilde W_v^T\Gamma_v^{-1}\dot{\tilde W}_v + "
              r"\frac{1}{\alpha_2}\tilde\theta\dot{\tilde\theta}")


@paper.claim("50", "Rate of V_2 before the laws are put in", "identity", PRINTED_50, "proved", premises=("37",),
             rests_on=("37",), scope=EVERY_NETWORK, where=ERRORS,
             reading="For a constant M, as (1), (9) and section 6 have it.",
             note="Of M(t), as (2), (3) and (4) write it, the term with the rate of M, times e_v^2/(2 chi), would be missing.")
def v2_rate_open() -> Goal:
    """D(V_2) with free rates, M at rest."""
    return Goal((equal(D(V_2), D(V_1) + rate_tracking),), flow=free_2)


@paper.claim("51", "Rate of V_2 once more", "identity",
             r"\dot V_2 = \frac{M}{\chi}e_v\dot e_v + \tilde W_v^T\Gamma_v^{-1}\dot{\tilde W}_v + \frac{1}{\alpha_2}"
             r"\dot{\tilde\theta}", "refuted", severity="cosmetic", rests_on=("50",), scope=EVERY_NETWORK, where=ERRORS,
             correction=lambda: Goal((equal(D(V_2), D(V_1) + rate_tracking),), flow=free_2),
             corrected_statement=PRINTED_50,
             note="V_1' has been lost, and theta_tilde in the last term; (52) has both again, so nothing follows from the "
                  "slip.")
def v2_rate_without_v1() -> Goal:
    """D(V_2) without D(V_1)."""
    last = theta_rate / alpha_2
    return Goal((equal(D(V_2), M / chi * e_v * e_rate + over_neurons(w_v * w_v_rate) + last),), flow=free_2)


@paper.claim("52.theta", "The error of the estimate of theta moves as the estimate does", "implication",
             r"\tilde\theta = \hat\theta - \theta,\ \theta = \varepsilon_v(z_2) - \tfrac{M}{\chi}d(t) \Rightarrow "
             r"\dot{\tilde\theta} = \dot{\hat\theta}", "gap", origin="implied", rests_on=("50",),
             correction=lambda: moves_alike(theta_hat, theta, constant_truth=True),
             corrected_statement=r"\theta\ \text{constant} \Rightarrow \dot{\tilde\theta} = \dot{\hat\theta}",
             note="theta contains d(t), which (70) and (71) let oscillate and (71) jump at t = 1000 s; the term -theta_tilde theta'/alpha_2 is missing "
                  "from (52). As with 38.delta, a constant bound theta of |eps_v - (M/chi) d| is needed.")
def theta_moves() -> Goal:
    """D(theta_hat - theta) with a moving theta."""
    return moves_alike(theta_hat, theta)


leak_v = sigma_v * over_neurons(W_v_tilde * (W_v_tilde + W_v_off))
leak_theta = beta_2 * theta_tilde * (theta_tilde + theta_off)
robust_52 = gamma_2(e_v) * (theta + theta_tilde)  # (34)


def _bracket_52(sign: int, residual: sp.Expr) -> sp.Expr:
    """The first bracket of (52) times e_v; eps_v - (M/chi) d is the residual."""
    return e_v * (-k_5 * e_v + sign * over_neurons(W_v_tilde * h_v) + residual - robust_52)


learning_52 = over_neurons(W_v_tilde * (-h_v * e_v + sigma_v * (W_v_tilde + W_v_off)))
estimate_52 = theta_tilde * (gamma_2(e_v) * e_v + beta_2 * (theta_tilde + theta_off))


def _rate_52(sign: int, residual: sp.Expr, h_limited: bool = False) -> Goal:
    stated = D(V_1) + _bracket_52(sign, residual) + learning_52 + estimate_52
    return Goal((equal(D(V_2), stated),), (*small_hidden(h_v), *with_gain(g_v)) if h_limited else (),
                flow=free_1 | tracking_loop(residual=residual))


def _printed_52(sign: str) -> str:
    return (rf"\dot V_2 = \dot V_1 + e_v(-k_5e_v {sign} \tilde W_v^Th_v(z_2) + \varepsilon_v(z_2) - "
            r"\frac{M}{\chi}d(t) - D_2) + \tilde W_v^T\Gamma_v^{-1}\Gamma_v(-h_v(z_2)e_v + "
            r"\sigma_v(\hat W_v - W_{v0})) + \frac{1}{\alpha_2}\tilde\theta(\alpha_2(\gamma(e_v)e_v + "
            r"\beta_2(\hat\theta - \theta_0)))")


LETTERS_52 = ERRORS | {"D_2": robust_52, r"\varepsilon_v(z_2)": theta + M / chi * d}  # theta as the text defines it
MENDED_52 = LETTERS_52 | {r"\varepsilon_v(z_2)": r_v + M / chi * d}  # theta any constant


@paper.claim("52", "Rate of V_2 with the laws", "identity", _printed_52("+"), "refuted", premises=("33.mended", "50"),
             rests_on=("32", "33", "35", "50", "52.theta"),
             scope=EVERY_NETWORK, where=LETTERS_52, correction=lambda: _rate_52(-1, r_v),
             corrected_statement=r"\dot\theta = 0:\quad " + _printed_52("-"),
             reading="The second bracket has z_2 where (32) has e_v, which is read; theta_tilde moves as theta_hat does.",
             note="The sign of (33): W_v_tilde^T h_v enters with minus. The extracted text has h_v(z_2) z_2 in the second bracket; "
                  "e_v is read, as (32) has it.")
def v2_rate_laws() -> Goal:
    """D(V_2) along the closed loop as printed, for any rates of the observer's errors."""
    return _rate_52(1, theta, h_limited=True)


@paper.claim("52.mended", "Rate of V_2 with the laws, the weights' sign turned", "identity", _printed_52("-"), "proved",
             origin="ours", mends="52", premises=("33.mended", "50"), rests_on=(), scope=EVERY_NETWORK,
             where=MENDED_52, note="For any constant theta, whether it is eps_v - (M/chi) d or a bound of it.")
def v2_rate_laws_mended() -> Goal:
    """D(V_2) along the closed loop with the sign of 33.mended."""
    return _rate_52(-1, r_v)


def _printed_53(residual: str) -> str:
    return (rf"\dot V_2 = \dot V_1 - k_5e_v^2 + e_v({residual} - \gamma(e_v)\theta) + \tilde W_v^T\sigma_v(\hat W_v - W_{{v0}}) + "
            r"\tilde\theta\beta_2(\hat\theta - \theta_0)")


PRINTED_53, MENDED_53 = _printed_53(r"\theta"), _printed_53(r"\varepsilon_v(z_2) - \frac{M}{\chi}d(t)")


def _rate_53(learn: int, residual: sp.Expr, h_limited: bool = False) -> Goal:
    rate = -k_5 * e_v**2 + e_v * (residual - gamma_2(e_v) * theta) + leak_v + leak_theta
    return Goal((equal(D(V_2), D(V_1) + rate),), (*small_hidden(h_v), *with_gain(g_v)) if h_limited else (),
                flow=free_1 | tracking_loop(learn=learn, residual=residual))


@paper.claim("53", "Rate of V_2, collected", "identity", PRINTED_53, "refuted", premises=("33.mended", "50"),
             rests_on=("32.cancels", "52"), scope=EVERY_NETWORK, where=ERRORS, correction=lambda: _rate_53(1, r_v),
             corrected_statement=r"\text{with}\ +h_v(z_2)e_v\ \text{in (32) and}\ \dot\theta = 0:\quad " + MENDED_53,
             reading="The accent over the last theta is read as the index 0, as in (35).",
             note="It follows from (52) as printed. In the loop as printed the term -2 e_v W_v_tilde^T h_v is missing; "
                  "with (32) turned, see 32.turned, (53) is what the loop gives. For a constant theta that is a bound, "
                  "eps_v - (M/chi) d stands in the place of the first theta. The text refers to (44) and (51) for (34) "
                  "and (52).")
def v2_rate_collected() -> Goal:
    """D(V_2) along the loop as printed, for any rates of the observer's errors."""
    return _rate_53(-1, theta, h_limited=True)


@paper.claim("53.mended", "Rate of V_2, collected, for (32) turned", "identity", MENDED_53, "proved", origin="ours",
             mends="53", premises=("32.turned", "50"), rests_on=(), scope=EVERY_NETWORK,
             where=ERRORS | {r"\varepsilon_v(z_2)": r_v + M / chi * d},
             note="For any constant theta, whether it is eps_v - (M/chi) d or a bound of it.")
def v2_rate_collected_mended() -> Goal:
    """D(V_2) along the loop with plus before h_v e_v."""
    return _rate_53(1, r_v)


robust_claims("54", "theta", (e_v, r_v, theta, kappa_2),
              ("e_v", r"\varepsilon_v - \frac{M}{\chi}d", r"\theta", r"\kappa_2"), "eps_v - (M/chi) d")

bound_v = -sigma_v / 2 * norm_v + sigma_v / 2 * prior_v
bound_theta = -beta_2 / 2 * theta_tilde**2 + beta_2 / 2 * theta_off**2
leak_claims("54", "weights", leak_v, -norm_v + over_neurons(W_v_tilde * W_v_off), bound_v,
            (r"\tilde W_v^T\sigma_v(\hat W_v - W_{v0})", r"-\|\tilde W_v\|^2 + \tilde W_v^T(W_v - W_{v0})",
             r"-\frac{\sigma_v}{2}\|\tilde W_v\|^2 + \frac{\sigma_v}{2}\|W_v - W_{v0}\|^2"),
            "32.leakage", f"{OPPOSITE} sigma_v is missing in the middle as well.")
leak_claims("54", "estimate", leak_theta, -beta_2 * theta_tilde**2 + beta_2 * theta_tilde * theta_off, bound_theta,
            (r"\beta_2\tilde\theta(\hat\theta - \theta_0)", r"-\beta_2\tilde\theta^2 + \beta_2\tilde\theta"
             r"(\theta - \theta_0)", r"-\frac{\beta_2}{2}\tilde\theta^2 + \frac{\beta_2}{2}(\theta - \theta_0)^2"),
            "35.leakage", OPPOSITE)
