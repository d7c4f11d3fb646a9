"""Section 5, Theorem 2: the rate of V_2, (49)-(54)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, equal

from ..error_dynamics import W_v_off, W_v_tilde, eps_v, observer_loop, theta, theta_off, theta_tilde, tracking_loop, w_v
from ..goal_forms import moves_alike
from ..laws import alpha_2, beta_2, e_v, gamma_2, h_v, k_5, kappa_2, sigma_v, theta_hat
from ..lyapunov import V_1, V_2, norm_v, prior_v
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi
from .section_5_theorem_1_eq_36_to_40 import e_rate, free_2, theta_rate, w_v_rate
from .section_5_theorem_1_eq_41_to_43 import leak_claims, robust_claims


@paper.claim("49", "V_2 is not negative", "inequality", r"V_2 \ge 0", "proved", premises=("36",), scope=EVERY_NETWORK)
def v2_not_negative() -> Goal:
    """Squares with positive weights."""
    return Goal((at_least(V_2, 0),))


rate_tracking = M / chi * e_v * e_rate + over_neurons(w_v * w_v_rate) + theta_tilde * theta_rate / alpha_2


@paper.claim("50", "Rate of V_2 before the laws are put in", "identity",
             r"\dot V_2 = \dot V_1 + \tfrac{M}{\chi}e_v\dot e_v + \tilde W_v^T\Gamma_v^{-1}\dot{\tilde W}_v + "
             r"\tfrac{1}{\alpha_2}\tilde\theta\dot{\tilde\theta}", "proved", premises=("37",), scope=EVERY_NETWORK)
def v2_rate_open() -> Goal:
    """D(V_2) with free rates."""
    return Goal((equal(D(V_2), D(V_1) + rate_tracking),), flow=free_2)


@paper.claim("51", "Rate of V_2 once more", "identity",
             r"\dot V_2 = \tfrac{M}{\chi}e_v\dot e_v + \tilde W_v^T\Gamma_v^{-1}\dot{\tilde W}_v + \tfrac{1}{\alpha_2}"
             r"\tilde\theta\dot{\tilde\theta}", "refuted", premises=("50",), scope=EVERY_NETWORK,
             correction=lambda: Goal((equal(D(V_2), D(V_1) + rate_tracking),), flow=free_2),
             corrected_statement=r"\dot V_2 = \dot V_1 + \tfrac{M}{\chi}e_v\dot e_v + \ldots",
             note="V_1' has been lost; (52) has it again, so nothing follows from the slip. theta_tilde, missing in the last "
                  "term of the extracted text, is read from (50) and (52).")
def v2_rate_without_v1() -> Goal:
    """D(V_2) without D(V_1)."""
    return Goal((equal(D(V_2), rate_tracking),), flow=free_2)


@paper.claim("52.theta", "The error of the estimate of theta moves as the estimate does", "implication",
             r"\tilde\theta = \hat\theta - \theta,\ \theta = \varepsilon_v(z_2) - \tfrac{M}{\chi}d(t) \Rightarrow "
             r"\dot{\tilde\theta} = \dot{\hat\theta}", "gap", premises=("50",),
             correction=lambda: moves_alike(theta_hat, theta, constant_truth=True),
             corrected_statement=r"\theta\ \text{constant} \Rightarrow \dot{\tilde\theta} = \dot{\hat\theta}",
             note="theta contains d(t), which (70) and (71) let oscillate; the term -theta_tilde theta'/alpha_2 is missing "
                  "from (52). As with 38, a constant bound theta of |eps_v - (M/chi) d| is needed.")
def theta_moves() -> Goal:
    """D(theta_hat - theta) with a moving theta."""
    return moves_alike(theta_hat, theta)


leak_v = sigma_v * over_neurons(W_v_tilde * (W_v_tilde + W_v_off))
leak_theta = beta_2 * theta_tilde * (theta_tilde + theta_off)
learning_52 = over_neurons(-W_v_tilde * h_v * e_v) + leak_v
estimate_52 = theta_tilde * gamma_2(e_v) * e_v + leak_theta


def _bracket_52(sign: int) -> sp.Expr:
    return e_v * (-k_5 * e_v + sign * over_neurons(W_v_tilde * h_v) + theta - gamma_2(e_v) * (theta + theta_tilde))


def _rate_52(sign: int) -> Goal:
    loop = observer_loop() | tracking_loop()
    return Goal((equal(D(V_2), D(V_1) + _bracket_52(sign) + learning_52 + estimate_52),), flow=loop)


@paper.claim("52", "Rate of V_2 with the laws", "identity",
             r"\dot V_2 = \dot V_1 + e_v\left(-k_5e_v + \tilde W_v^Th_v(z_2) + \varepsilon_v - \tfrac{M}{\chi}d - D_2\right) + "
             r"\tilde W_v^T(-h_v(z_2)e_v + \sigma_v(\hat W_v - W_{v0})) + \tilde\theta(\gamma(e_v)e_v + "
             r"\beta_2(\hat\theta - \theta_0))", "refuted", premises=("33", "50", "52.theta"), scope=EVERY_NETWORK,
             correction=lambda: _rate_52(-1),
             corrected_statement=r"\dot V_2 = \dot V_1 + e_v\left(-k_5e_v - \tilde W_v^Th_v(z_2) + \ldots\right) + \ldots",
             note="The sign of (33). The text has z_2 for e_v in the second bracket. With theta' = 0.")
def v2_rate_laws() -> Goal:
    """D(V_2) along the closed loop as printed."""
    return _rate_52(1)


rate_53 = -k_5 * e_v**2 + e_v * (theta - gamma_2(e_v) * theta) + leak_v + leak_theta


@paper.claim("53", "Rate of V_2, collected", "identity",
             r"\dot V_2 = \dot V_1 - k_5e_v^2 + e_v(\theta - \gamma(e_v)\theta) + \sigma_v\tilde W_v^T(\hat W_v - W_{v0}) + "
             r"\beta_2\tilde\theta(\hat\theta - \theta_0)", "proved", premises=("52", "34"), scope=EVERY_NETWORK,
             note="From (52) as printed. In the loop as printed the term -2 e_v W_v_tilde^T h_v is missing; with (32) "
                  "corrected, see 32, (53) is what the loop gives. The text refers to (44) and (51) for (34) and (52).")
def v2_rate_collected() -> Goal:
    """The right side of (52) against that of (53)."""
    return Goal((equal(_bracket_52(1) + learning_52 + estimate_52, rate_53),))


robust_claims("54", "theta", (e_v, eps_v, theta, kappa_2),
              ("e_v", r"(\varepsilon_v - \tfrac{M}{\chi}d)", r"\theta", r"\kappa_2"), "eps_v - (M/chi) d")

bound_v = -sigma_v / 2 * norm_v + sigma_v / 2 * prior_v
bound_theta = -beta_2 / 2 * theta_tilde**2 + beta_2 / 2 * theta_off**2
leak_claims("54", "weights", leak_v, -norm_v + over_neurons(W_v_tilde * W_v_off), bound_v,
            (r"\sigma_v\tilde W_v^T(\hat W_v - W_{v0})", r"-\|\tilde W_v\|^2 + \tilde W_v^T(W_v^* - W_{v0})",
             r"-\tfrac{\sigma_v}{2}\|\tilde W_v\|^2 + \tfrac{\sigma_v}{2}\|W_v^* - W_{v0}\|^2"),
            "See 41; true when the leakage enters with minus. sigma_v is missing in the middle as well, a slip.")
leak_claims("54", "estimate", leak_theta, -beta_2 * theta_tilde**2 + beta_2 * theta_tilde * theta_off, bound_theta,
            (r"\beta_2\tilde\theta(\hat\theta - \theta_0)", r"-\beta_2\tilde\theta^2 + \beta_2\tilde\theta"
             r"(\theta - \theta_0)", r"-\tfrac{\beta_2}{2}\tilde\theta^2 + \tfrac{\beta_2}{2}(\theta - \theta_0)^2"),
            "See 41; true when the leakage enters with minus.")
