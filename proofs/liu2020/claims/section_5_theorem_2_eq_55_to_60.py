"""Section 5, Theorem 2: the decay of V_2, (55)-(60)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..error_dynamics import delta_off, delta_tilde, r_v, t, theta, theta_off, theta_tilde, tracking_loop
from ..goal_forms import small_hidden, with_gain, within
from ..laws import alpha_1, alpha_2, beta_1, beta_2, e_v, g_v, gamma_2, h_v, k_5, kappa_2, sigma_v
from ..lyapunov import (
    V_1,
    V_2,
    V_tracking,
    bounded_by_eigenvalue,
    delta_size,
    lambda_f,
    lambda_v,
    largest_f,
    largest_v,
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
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi
from ..smooth_sign import constant, constant_suffices, smooth_sign, smooth_sign_facts
from .section_5_theorem_1_eq_36_to_40 import free_1
from .section_5_theorem_1_eq_41_to_43 import bound_43, mu_1_stated
from .section_5_theorem_1_eq_44_to_48 import (
    W_1,
    W_2,
    V_1_dot,
    V_start,
    after_decay,
    bound_47,
    bounded_43,
    entry_1,
    entry_2,
    norm_48,
    robust_size,
    weights_decay_claim,
)
from .section_5_theorem_2_eq_49_to_54 import bound_theta, bound_v

bound_tracking = (-k_5 * e_v**2 + constant * kappa_2 * theta_size + bound_v + bound_theta)
theta_bounds = (at_least(theta, 0), *within(r_v, theta))
smooth_2 = (*smooth_sign(e_v, kappa_2),
            at_most(e_v * r_v - e_v * gamma_2(e_v) * theta, constant * kappa_2 * theta))
TRACKING_55 = (r"-k_5e_v^2 + 0.2785\kappa_2|\theta| - \frac{\sigma_v}{2}\|\tilde W_v\|^2 + \frac{\sigma_v}{2}"
               r"\|W_v - W_{v0}\|^2 - \frac{\beta_2}{2}\tilde\theta^2 + \frac{\beta_2}{2}(\theta - \theta_0)^2")
TURNED = (r"\text{With}\ \dot{\hat W}_v = \Gamma_v(+h_ve_v - \sigma_v(\hat W_v - W_{v0})),\ \text{a minus sign in (35), a "
          r"constant}\ \theta \ge |\varepsilon_v - \tfrac{M}{\chi}d|")


def _mended_55() -> Goal:
    return Goal((at_most(D(V_tracking), positive(bound_tracking)),), theta_bounds, tracking_loop(-1, 1, r_v),
                facts=smooth_sign_facts(e_v, kappa_2), lemmas=(constant_suffices, *smooth_2))


@paper.claim("55.first", "Bound of the rate of V_2", "inequality", r"\dot V_2 \le \dot V_1 " + TRACKING_55, "refuted",
             premises=("53.mended",), rests_on=("53", "54.theta", "54.theta.size", "54.weights", "54.estimate"),
             scope=EVERY_NETWORK, where=ERRORS, correction=_mended_55,
             corrected_statement=TURNED + r":\quad \dot V_2 \le \dot V_1 " + TRACKING_55,
             reading="The first inequality of (55); the accent over theta in (theta - theta_0)^2 as Lemma 1 forces it.",
             note="Three causes: the sign of the leakage, the sign of (32), and a theta that may be negative "
                  "(54.theta.size); broken here for a constant theta >= 0.")
def v2_rate_bound() -> Goal:
    """D(V_2) along the laws as printed, for theta >= 0 and any rates of the observer's errors."""
    return Goal((at_most(D(V_2), D(V_1) + bound_tracking),), (at_least(theta, 0), *small_hidden(h_v), *with_gain(g_v)),
                free_1 | tracking_loop())


@paper.claim("55.mended", "Bound of the rate of V_2 - V_1, signs turned", "inequality",
             r"\dot V_2 - \dot V_1 \le -k_5e_v^2 + 0.2785\kappa_2\theta - \frac{\sigma_v}{2}\|\tilde W_v\|^2 + "
             r"\frac{\sigma_v}{2}\|W_v - W_{v0}\|^2 - \frac{\beta_2}{2}\tilde\theta^2 + \frac{\beta_2}{2}"
             r"(\theta - \theta_0)^2", "proved", origin="ours", mends="55.first",
             premises=("53.mended", "54.theta.mended", "54.weights.mended", "54.estimate.mended"), rests_on=(),
             scope=EVERY_NETWORK, where=ERRORS,
             reading="As the rate of V_2 - V_1, from which the letters of V_1 cancel.",
             note="For plus before h_v e_v in (32), minus before the leakage of (32) and (35), and a constant theta that "
                  "bounds |eps_v - (M/chi) d|.")
def v2_rate_bound_mended() -> Goal:
    """D(V_2 - V_1) along the loop with the signs turned."""
    return _mended_55()


mu_2_stated = (mu_1_stated + beta_2 / 2 * theta_off**2 + sigma_v / 2 * prior_v
               + constant * kappa_2 * theta_size)
bound_55 = bound_43 + bound_tracking


@paper.claim("55.second", "Bound of the rate of V_2, with (43)", "implication",
             r"\dot V_1 " + TRACKING_55 + r" \le -k_1\tilde s^2 - k_3\tilde v^2 - \frac{\sigma_f}{2}\|\tilde W_f\|^2 - "
             r"\frac{\beta_1}{2}\tilde\delta^2 - k_5e_v^2 - \frac{\sigma_v}{2}\|\tilde W_v\|^2 - "
             r"\frac{\beta_2}{2}\tilde\theta^2 + \frac{\sigma_f}{2}\|W_f - W_{f0}\|^2 + \frac{\beta_1}{2}"
             r"(\delta - \delta_0)^2 + 0.2785\kappa_1|\delta| + \frac{\beta_1}{2}(\delta - \delta_0)^2 + "
             r"0.2785\kappa_2|\theta| + \frac{\sigma_v}{2}\|W_v - W_{v0}\|^2 + \frac{\beta_2}{2}"
             r"\|\theta - \theta_0\|^2", "proved", premises=("43",), rests_on=("43", "55.first"), scope=EVERY_NETWORK,
             where=ERRORS | {r"\dot V_1": V_1_dot, r"|\delta|": robust_size, r"\|\theta - \theta_0\|": sp.Abs(theta_off)},
             reading="The second inequality of (55), from (43).",
             note="The term (beta_1/2)(delta - delta_0)^2 stands there twice, once too often; (56) counts it once.")
def v2_rate_bound_whole() -> Goal:
    """The printed bound with its doubled term, |delta| one number."""
    sizes = {delta_size: robust_size}
    printed = (bound_55 + beta_1 / 2 * delta_off**2).xreplace(sizes)
    return Goal((at_most(V_1_dot + bound_tracking, printed),), (bounded_43(),))


paper.definition("56", "The bound mu and the rate rho of V_2",
                 r"\mu := \frac{\sigma_f}{2}\|W_f - W_{f0}\|^2 + \frac{\beta_1}{2}(\delta - \delta_0)^2 + \frac{\beta_2}{2}(\theta - "
                 r"\theta_0)^2 + \frac{\sigma_v}{2}\|W_v - W_{v0}\|^2 + 0.2785(\kappa_1|\delta| + \kappa_2|\theta|),\ "
                 r"\rho := \min\left\{2k_1, 2k_3, \frac{2\chi k_5}{M}, \frac{\sigma_f}{\lambda_{\min}(\Gamma_u^{-1})}, "
                 r"\alpha_1\beta_1, \frac{\sigma_v}{\lambda_{\min}(\Gamma_v^{-1})}, \alpha_2\beta_2\right\}",
                 reading="The accents over delta and theta in the squares are read as in (43) and (55).",
                 note="(57) calls them mu_2 and rho_2. Here the entry of delta is alpha_1 beta_1, in (44) it is beta_1/alpha_1.")

weights_decay_claim("56", "v", sigma_v, lambda_v, largest_v, norm_v, square_v)


@paper.claim("56.rates", "The other entries of (56)", "inequality",
             r"-k_5e_v^2 \le -\rho\frac{M}{2\chi}e_v^2,\ -\frac{\beta_1}{2}\tilde\delta^2 \le "
             r"-\rho\frac{1}{2\alpha_1}\tilde\delta^2,\ -\frac{\beta_2}{2}\tilde\theta^2 \le "
             r"-\rho\frac{1}{2\alpha_2}\tilde\theta^2", "proved", origin="implied", rests_on=(), where={r"\rho": rho},
             note="For rho at most 2 chi k_5/M, alpha_1 beta_1 and alpha_2 beta_2.")
def other_rates() -> Goal:
    """The rates of e_v and of the estimates."""
    return Goal((at_most(-k_5 * e_v**2, -rho * M / (2 * chi) * e_v**2),
                 at_most(-beta_1 / 2 * delta_tilde**2, -rho * delta_tilde**2 / (2 * alpha_1)),
                 at_most(-beta_2 / 2 * theta_tilde**2, -rho * theta_tilde**2 / (2 * alpha_2))), rates_scalar)


rates_2 = (*rates_1(largest_f), *rates_scalar, at_most(rho * largest_v, sigma_v))
largest = (bounded_by_eigenvalue(square_f, norm_f, largest_f), bounded_by_eigenvalue(square_v, norm_v, largest_v))
V_2_dot = sp.Symbol("Vdot_2", real=True)
theta_number = sp.Symbol("theta_size", nonnegative=True)  # |theta|
mu_2 = sp.Symbol("mu_2", real=True)
# V_2 and (55) where all errors but the weights of the tracking network, two of them, are zero.
V_2_weights = (entry_1 * W_1**2 + entry_2 * W_2**2) / 2
bound_55_weights = -sigma_v / 2 * (W_1**2 + W_2**2) + mu_2


def _mended_57() -> Goal:
    """The right side of (55) against that of (57)."""
    sizes = {delta_size: robust_size, theta_size: theta_number}
    return Goal((at_most(bound_55.xreplace(sizes), (-rho * V_2 + mu_2_stated).xreplace(sizes)),), (*rates_2, *largest))


@paper.claim("57", "V_2 decays up to mu_2", "implication", r"\dot V_2 \le -\rho_2V_2 + \mu_2", "gap", premises=("55.second",),
             rests_on=("55.second", "56.rates", "56.weights", "44.weights"),
             where={r"\dot V_2": V_2_dot, "V_2": V_2_weights, r"\mu_2": mu_2, r"\rho_2": rho},
             scope="two neurons in the controller's network, diagonal gain, all other errors zero", correction=_mended_57,
             corrected_statement=r"\text{With}\ \lambda_{\max}\ \text{in place of}\ \lambda_{\min}\ \text{in (56)}:\quad "
                                 r"\dot V_2 \le -\rho_2V_2 + \mu_2",
             reading="rho_2 is at most each entry of (56), mu_2 is its mu.",
             note="From (55), its doubled term counted once as in (56); see 56.weights for the entry that fails.")
def decay_2() -> Goal:
    """From (55), met with equality, with the smallest eigenvalue of the tracking network's inverse gain."""
    return Goal((at_most(V_2_dot, -rho * V_2_weights + mu_2),),
                (equal(V_2_dot, bound_55_weights), *rates_1(lambda_f), *rates_scalar, equal(lambda_v, entry_1),
                 at_most(entry_1, entry_2), at_most(rho * lambda_v, sigma_v)))


after_decay(2, "57", "58", "59", "49")

smaller = sp.Symbol("rho_smaller", positive=True)


@paper.claim("59.small", "V_2 is bounded because rho can be decreased", "implication",
             r"\text{Equation (59) shows that}\ V_1(t)\ \text{is bounded because the value of}\ \rho_1\ "
             r"\text{can be decreased}", "gap", match="words", severity="cosmetic", rests_on=("59",),
             reading="A smaller rho gives no larger bound phi = mu/rho.",
             correction=lambda: Goal((at_most(mu / rho, mu / smaller),), (at_most(smaller, rho),)),
             corrected_statement=r"\rho' \le \rho \Rightarrow \frac{\mu}{\rho} \le \frac{\mu}{\rho'}",
             note="It is the other way round, and after (47) the text says 'increasing'. V_1 and rho_1 stand for V_2 and "
                  "rho_2.")
def decreased() -> Goal:
    """mu/rho for two values of rho."""
    return Goal((at_most(mu / smaller, mu / rho),), (at_most(smaller, rho),))


# Where (59) is met with equality, and the roots of alpha_i do not matter.
at_the_end = (equal(V_start, mu / rho), equal(V_2, V_start), equal(alpha_1, 1), equal(alpha_2, 1))
norm_60 = norm_48 + delta_tilde**2 / alpha_1 + M / chi * e_v**2 + square_v
size_60 = norm_48 + (delta_tilde / alpha_1) ** 2 + M / chi * e_v**2 + square_v + (theta_tilde / alpha_2) ** 2
NORM_60 = (r"\left\|\tilde s, \tilde v, \sqrt{\tilde W_f^T\Gamma_f^{-1}\tilde W_f}, \frac{1}{\alpha_1}\tilde\delta, "
           r"\sqrt{\frac{M}{\chi}}e_v, \sqrt{\tilde W_v^T\Gamma_v^{-1}\tilde W_v}, \frac{\tilde\theta}{\alpha_2}\right\|")


@paper.claim("60", "Norm of all errors", "implication",
             NORM_60 + r" \le \sqrt{\varphi_2 + (V_2(0) - \varphi_2)e^{-\rho_2t}}", "gap", premises=("59",),
             scope=EVERY_NETWORK,
             where={NORM_60: sp.sqrt(size_60), r"\varphi_2": mu / rho, r"\rho_2": rho, "V_2(0)": V_start, "t": t},
             correction=lambda: Goal((equal(norm_60 + theta_tilde**2 / alpha_2, 2 * V_2),)),
             corrected_statement=r"\left\|\tilde s, \tilde v, \ldots, \tfrac1{\sqrt{\alpha_1}}\tilde\delta, \ldots, "
                                 r"\tfrac{1}{\sqrt{\alpha_2}}\tilde\theta\right\| = \sqrt{2V_2}",
             note="From (59). The factor 2 of (48) is missing, and alpha_i stand without their roots: the bound is too "
                  "small by the factor sqrt(2) where alpha_i = 1, decided there; of no consequence for the theorem.")
def norm_bound_2() -> Goal:
    """The norm against the bound of (59)."""
    return Goal((at_most(sp.sqrt(size_60), sp.sqrt(mu / rho + (V_start - mu / rho) * sp.exp(-rho * t))),),
                (at_least(t, 0), at_most(V_2, bound_47), *at_the_end))
