"""Section 5, Theorem 2: the decay of V_2, (55)-(60), and the theorem."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..error_dynamics import delta_off, delta_tilde, eps_v, observer_loop, theta, theta_off, theta_tilde, tracking_loop
from ..goal_forms import within
from ..laws import alpha_1, alpha_2, beta_1, beta_2, e_v, gamma_2, k_5, kappa_2, sigma_v
from ..lyapunov import (
    V_2,
    V_tracking,
    bounded_by_eigenvalue,
    lambda_f,
    lambda_v,
    mu,
    norm_f,
    norm_v,
    positive,
    prior_v,
    rates_1,
    rates_scalar,
    rho,
    square_f,
    square_v,
    theta_size,
)
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi
from ..smooth_sign import constant, constant_suffices, smooth_sign, smooth_sign_facts
from .section_5_theorem_1_eq_41_to_43 import bound_43, mu_1_stated
from .section_5_theorem_1_eq_44_to_48 import (
    W_1,
    W_2,
    after_decay,
    entry_1,
    entry_2,
    norm_48,
    runaway,
    weights_decay_claim,
)
from .section_5_theorem_2_eq_49_to_54 import bound_theta, bound_v

bound_tracking = (-k_5 * e_v**2 + constant * kappa_2 * theta_size + bound_v + bound_theta)
theta_bounds = (at_least(theta, 0), *within(eps_v, theta))  # eps_v stands for eps_v - (M/chi) d
smooth_2 = (*smooth_sign(e_v, kappa_2),
            at_most(e_v * eps_v - e_v * gamma_2(e_v) * theta, constant * kappa_2 * theta))
CORRECTED_LAWS = (r"\text{for}\ \dot{\hat W}_v = \Gamma_v(+h_ve_v - \sigma_v(\hat W_v - W_{v0})),\ \text{a minus sign in "
                  r"(35), a constant}\ \theta \ge |\varepsilon_v - \tfrac{M}{\chi}d|")


@paper.claim("55.first", "Bound of the rate of V_2", "inequality",
             r"\dot V_2 \le \dot V_1 - k_5e_v^2 + 0.2785\kappa_2|\theta| - \tfrac{\sigma_v}{2}\|\tilde W_v\|^2 + "
             r"\tfrac{\sigma_v}{2}\|W_v^* - W_{v0}\|^2 - \tfrac{\beta_2}{2}\tilde\theta^2 + \tfrac{\beta_2}{2}"
             r"(\theta - \theta_0)^2", "refuted",
             premises=("53", "54.theta.size", "54.weights", "54.estimate"), scope=EVERY_NETWORK,
             correction=lambda: Goal((at_most(D(V_tracking), positive(bound_tracking)),), theta_bounds,
                                     tracking_loop(-1, 1, eps_v), facts=smooth_sign_facts(e_v, kappa_2),
                                     lemmas=(constant_suffices, *smooth_2)),
             corrected_statement=r"\text{the same}\ " + CORRECTED_LAWS,
             note="For V_2 - V_1. Three causes: the sign of the leakage, the sign of (32), and a theta that may be negative "
                  "(54.theta.size); broken here for theta >= 0.")
def v2_rate_bound() -> Goal:
    """D(V_2 - V_1) along the laws as printed, for theta >= 0."""
    return Goal((at_most(D(V_tracking), positive(bound_tracking)),), (at_least(theta, 0),), tracking_loop())


mu_2_stated = (mu_1_stated + beta_2 / 2 * theta_off**2 + sigma_v / 2 * prior_v
               + constant * kappa_2 * theta_size)
bound_55 = bound_43 + bound_tracking
V_1_dot = sp.Symbol("Vdot_1", real=True)


@paper.claim("55.second", "Bound of the rate of V_2, with (43)", "implication",
             r"\dot V_1 \le \text{(43)} \Rightarrow \dot V_2 \le -k_1\tilde s^2 - k_3\tilde v^2 - \tfrac{\sigma_f}{2}"
             r"\|\tilde W_f\|^2 - \tfrac{\beta_1}{2}\tilde\delta^2 - k_5e_v^2 - \tfrac{\sigma_v}{2}\|\tilde W_v\|^2 - "
             r"\tfrac{\beta_2}{2}\tilde\theta^2 + \tfrac{\sigma_f}{2}\|W_f^* - W_{f0}\|^2 + \beta_1(\delta - \delta_0)^2 + "
             r"0.2785(\kappa_1|\delta| + \kappa_2|\theta|) + \tfrac{\sigma_v}{2}\|W_v^* - W_{v0}\|^2 + \tfrac{\beta_2}{2}"
             r"(\theta - \theta_0)^2", "proved", premises=("43", "55.first"), scope=EVERY_NETWORK,
             note="The term (beta_1/2)(delta - delta_0)^2 stands there twice, once too often; (56) counts it once.")
def v2_rate_bound_whole() -> Goal:
    """The printed bound with its doubled term."""
    printed = bound_55 + beta_1 / 2 * delta_off**2
    return Goal((at_most(V_1_dot + bound_tracking, printed),), (at_most(V_1_dot, bound_43),))


weights_decay_claim("56", "v", sigma_v, lambda_v, norm_v, square_v)


@paper.claim("56.rates", "The other entries of (56)", "inequality",
             r"\rho \le \frac{2\chi k_5}{M},\ \rho \le \alpha_1\beta_1,\ \rho \le \alpha_2\beta_2 \Rightarrow -k_5e_v^2 \le "
             r"-\rho\tfrac{M}{2\chi}e_v^2,\ -\tfrac{\beta_i}{2}(\cdot)^2 \le -\rho\tfrac{1}{2\alpha_i}(\cdot)^2", "proved")
def other_rates() -> Goal:
    """The rates of e_v and of the estimates."""
    return Goal((at_most(-k_5 * e_v**2, -rho * M / (2 * chi) * e_v**2),
                 at_most(-beta_1 / 2 * delta_tilde**2, -rho * delta_tilde**2 / (2 * alpha_1)),
                 at_most(-beta_2 / 2 * theta_tilde**2, -rho * theta_tilde**2 / (2 * alpha_2))), rates_scalar)


rates_2 = (*rates_1, *rates_scalar, at_most(rho * lambda_v, sigma_v))
largest = (bounded_by_eigenvalue(square_f, norm_f, lambda_f), bounded_by_eigenvalue(square_v, norm_v, lambda_v))


@paper.claim("57", "V_2 decays up to mu_2", "implication",
             r"\rho_2 = \min\left\{2k_1, 2k_3, \frac{2\chi k_5}{M}, \frac{\sigma_f}{\lambda_{\min}(\Gamma_f^{-1})}, "
             r"\alpha_1\beta_1, \frac{\sigma_v}{\lambda_{\min}(\Gamma_v^{-1})}, \alpha_2\beta_2\right\} \Rightarrow "
             r"\dot V_2 \le -\rho_2V_2 + \mu_2", "gap", premises=("55.second", "56.rates", "56.weights", "44.weights"),
             scope="two neurons in one network, diagonal gain; the correction: " + EVERY_NETWORK,
             correction=lambda: Goal((at_most(bound_55, -rho * V_2 + mu_2_stated),), (*rates_2, *largest)),
             corrected_statement=r"\text{the same with}\ \lambda_{\max}\ \text{in place of}\ \lambda_{\min}",
             note="From (55), its doubled term counted once as in (56). In the counterexample all errors but the weights of "
                  "the tracking network are zero.")
def decay_2() -> Goal:
    """The weights' terms of (55) with the smallest eigenvalue."""
    shown = at_most(-sigma_v / 2 * (W_1**2 + W_2**2) + mu,
                    -rho / 2 * (entry_1 * W_1**2 + entry_2 * W_2**2) + mu)
    return Goal((shown,), (equal(lambda_v, entry_1), at_most(entry_1, entry_2), at_most(rho * lambda_v, sigma_v)))


after_decay(2, "57", "58", "59", "60", "49")

norm_60 = norm_48 + delta_tilde**2 / alpha_1 + M / chi * e_v**2 + square_v


@paper.claim("60", "Norm of all errors", "inequality",
             r"\left\|\tilde s, \tilde v, \ldots, \tfrac1{\alpha_1}\tilde\delta, \sqrt{\tfrac M\chi}e_v, "
             r"\sqrt{\tilde W_v^T\Gamma_v^{-1}\tilde W_v}, \tfrac{\tilde\theta}{\alpha_2}\right\| \le \sqrt{V_2} \le "
             r"\sqrt{\varphi_2 + (V_2(0) - \varphi_2)e^{-\rho_2t}}", "refuted", premises=("59",), scope=EVERY_NETWORK,
             correction=lambda: Goal((equal(norm_60 + theta_tilde**2 / alpha_2, 2 * V_2),)),
             corrected_statement=r"\left\|\tilde s, \tilde v, \ldots, \tfrac1{\sqrt{\alpha_1}}\tilde\delta, \ldots, "
                                 r"\tfrac{1}{\sqrt{\alpha_2}}\tilde\theta\right\| = \sqrt{2V_2}",
             note="In squares. The factor 2 of (48) is missing, and alpha_i stand without their roots: the bound is too "
                  "small by the factor sqrt(2); of no consequence for the theorem.")
def norm_bound_2() -> Goal:
    """The squares of the left side against V_2."""
    printed = norm_48 + (delta_tilde / alpha_1) ** 2 + M / chi * e_v**2 + square_v + (theta_tilde / alpha_2) ** 2
    return Goal((at_most(printed, V_2),))


mu_tracking = positive(mu_2_stated - mu_1_stated)


def _theorem_2_corrected() -> Goal:
    rates = (at_most(rho * M, 2 * chi * k_5), at_most(rho, alpha_2 * beta_2), at_most(rho * lambda_v, sigma_v))
    return Goal((at_most(D(V_tracking), -rho * V_tracking + mu_tracking),),
                (*theta_bounds, *rates, bounded_by_eigenvalue(square_v, norm_v, lambda_v)), tracking_loop(-1, 1, eps_v),
                facts=smooth_sign_facts(e_v, kappa_2),
                lemmas=(constant_suffices, *smooth_2, at_most(D(V_tracking), positive(bound_tracking))))


@paper.claim("theorem2", "Theorem 2: all signals of the closed loop are ultimately bounded", "limit",
             r"\exists B\ \exists T\ \forall t > T:\ \tilde\theta \le B\ \text{along (13), (18)-(21), (26), (28), "
             r"(31)-(35)}", "gap", premises=("57", "60", "23", "28"), scope="the correction: " + EVERY_NETWORK,
             correction=_theorem_2_corrected,
             corrected_statement=r"\frac{d}{dt}(V_2 - V_1) \le -\rho(V_2 - V_1) + \mu_2 - \mu_1\ " + CORRECTED_LAWS,
             note="False as printed: with perfect tracking and estimates of everything but theta the printed loop has a "
                  "solution in which theta_hat grows as exp(alpha_2 beta_2 t). The correction covers all ten columns of "
                  "Table 2 and, with 23, the tracking error; it rests on (28), whose f_v contains the input and is no "
                  "function of z_2 (27, 28.function): this gap remains, so Theorem 2 is not mended by the signs alone.")
def theorem_2() -> Goal:
    """theta_hat(t) = 101 exp(t) along the printed loop, one neuron in each network."""
    return runaway(observer_loop() | tracking_loop(), theta_tilde)
