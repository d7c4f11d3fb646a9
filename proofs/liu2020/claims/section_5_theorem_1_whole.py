"""Section 5: Theorem 1 as a whole, as printed and mended."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal

from ..error_dynamics import delta_tilde, eps_tilde, observer_loop, t
from ..exact_motions import hidden_f, observer_motion, weight_f
from ..laws import alpha_1, beta_1, k_1, k_2, k_3, kappa_1, s_tilde, sigma_f, v_tilde
from ..lyapunov import V_f, bounded_by_eigenvalue, largest_f, norm_f, rho, square_f
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..smooth_sign import smooth_sign_facts
from .section_5_theorem_1_eq_36_to_40 import free_1
from .section_5_theorem_1_eq_41_to_43 import delta_bounds, smooth_1
from .section_5_theorem_1_eq_44_to_48 import ends_near, errors_vanish, near_end
from .section_5_theorem_1_mended import mu_1_bound


@paper.claim("theorem1", "Theorem 1: all signals of the observer are ultimately bounded", "limit",
             r"\text{all the signals in the closed-loop systems}\ (13)\ \text{and}\ (14)\ \text{are uniformly "
             r"ultimately bounded}", "refuted",
             severity="result", match="words", closed_loop=True, rests_on=("15", "43"), scope="one neuron",
             reading="Along (13), (18) to (21): a bounded signal is in the end below t. Decided of W_f_tilde^T h_f, which is f_hat - f of "
                     "(14) where the network is exact. Time is not limited, as in (47) and (48); Assumption 2 alone "
                     "speaks of a finite interval. Assumption 5 is taken for speeds within a bound: for all speeds no train meets it, "
                     "v_2 = (L_1 + L_2)/(2 a_2) and v_1 = v_2 + 1 break it for all L_1 and L_2 (10.everywhere).",
             note="The leakage alone does it: with the plus sign of (21) delta_hat leaves its prior as exp(alpha_1 beta_1 t) while all "
                  "other errors are zero, for all gains (48.zero). In the motion here f_hat of (14) grows as exp(t) and D_1 as -exp(t), "
                  "while v_tilde stays where it is; the network is exact (eps_tilde = delta = 0), the priors are right, (40) holds. "
                  "A train realises it: it stands, u = f_d = a_0, d = 0 and W_f* = 0, so that f = 0, and z_1_hat rests in the "
                  "neuron's centre. "
                  "That delta is not constant (38.delta) is a gap of the proof beside it. With minus signs before the leakage "
                  "and a constant delta >= |eps_tilde_f| the theorem holds, see theorem1.mended. (40), and (21) as a law that is "
                  "taken, are missing among its hypotheses.")
def theorem_1() -> Goal:
    """W_f_tilde h_f = exp(t) + a constant along the printed loop."""
    return observer_motion(at_most(weight_f * hidden_f, t))


errors_vanish(1, "48", ("43",))


V_weighted = (k_2 + k_1 * k_3) * s_tilde**2 / 2 + v_tilde**2 / 2 + V_f + delta_tilde**2 / (2 * alpha_1)
s_tilde_rate = sp.Symbol("s_tilde_rate", real=True)
rate_of_s = equal(s_tilde_rate, v_tilde - k_1 * s_tilde)  # (13)
damped = (-k_1 * k_2 * s_tilde**2 - k_3 * s_tilde_rate**2 - sigma_f / 2 * norm_f - beta_1 / 2 * delta_tilde**2
          + mu_1_bound)


@paper.claim("theorem1.damped", "Rate of a Lyapunov function of the mended observer, without (40)", "inequality",
             r"\dot V \le -k_1k_2\tilde s^2 - k_3\dot{\tilde s}^2 - \frac{\sigma_f}{2}\|\tilde W_f\|^2 - "
             r"\frac{\beta_1}{2}\tilde\delta^2 + \mu_1", "proved", origin="ours", rests_on=(),
             premises=("40.needless", "42.delta.mended", "42.weights.mended", "42.estimate.mended"), scope=EVERY_NETWORK,
             where=ERRORS | {"V": V_weighted, r"\mu_1": mu_1_bound, r"\dot{\tilde s}": s_tilde_rate},
             note="For all k_i > 0, with minus signs before the leakage of (19), (21) and a constant delta >= "
                  "|eps_tilde_f|. V = ((k_2 + k_1 k_3) s_tilde^2 + v_tilde^2 + W_f_tilde^T Gamma_f^-1 W_f_tilde + "
                  "delta_tilde^2/alpha_1)/2.")
def mended_rate() -> Goal:
    """D(V) along (13), (18)-(21) with the leakage turned."""
    return Goal((at_most(D(V_weighted), damped),), (rate_of_s, *delta_bounds), observer_loop(-1, eps_tilde),
                facts=smooth_sign_facts(v_tilde, kappa_1), lemmas=smooth_1)


@paper.claim("theorem1.decay", "The Lyapunov function of the mended observer decays", "inequality",
             r"\dot V \le -\rho V + \mu_1", "proved", origin="ours", rests_on=(), premises=("theorem1.damped",),
             scope=EVERY_NETWORK, where=ERRORS | {"V": V_weighted, r"\rho": rho, r"\mu_1": mu_1_bound},
             note="For all ten columns of Table 2, V that of theorem1.damped and rho at most k_3, "
                  "2 k_1 k_2/(k_2 + k_1 k_3 + 2 k_1^2), sigma_f/lambda_max(Gamma_f^-1) and alpha_1 beta_1.")
def mended_decay() -> Goal:
    """From theorem1.damped, by v_tilde^2 <= 2 s_tilde'^2 + 2 k_1^2 s_tilde^2."""
    rates = (at_most(rho, k_3), at_most(rho * (k_2 + k_1 * k_3 + 2 * k_1**2), 2 * k_1 * k_2),
             at_most(rho * largest_f, sigma_f), at_most(rho, alpha_1 * beta_1))
    return Goal((at_most(D(V_weighted), -rho * V_weighted + mu_1_bound),),
                (rate_of_s, *paper.shown("theorem1.damped"), *rates, bounded_by_eigenvalue(square_f, norm_f, largest_f)),
                free_1, lemmas=(at_most(v_tilde**2, 2 * s_tilde_rate**2 + 2 * k_1**2 * s_tilde**2),
                                at_most(damped, -rho * V_weighted + mu_1_bound)))


LAW_1 = (r"\text{With a minus sign before the leakage of (19) and (21), a constant}\ \delta \ge |\tilde\varepsilon_f|,\ "
         r"V = \tfrac12\left((k_2 + k_1k_3)\tilde s^2 + \tilde v^2 + \tilde W_f^T\Gamma_f^{-1}\tilde W_f + "
         r"\tfrac{1}{\alpha_1}\tilde\delta^2\right),\ "
         r"\rho = \min\left\{k_3, \frac{2k_1k_2}{k_2 + k_1k_3 + 2k_1^2}, \frac{\sigma_f}{\lambda_{\max}(\Gamma_f^{-1})}, "
         r"\alpha_1\beta_1\right\},\ \mu = \frac{\sigma_f}{2}\|W_f^* - W_{f0}\|^2 + \frac{\beta_1}{2}(\delta - \delta_0)^2 "
         r"+ 0.2785\kappa_1\delta:\ ")
BOUND_1 = r"2\left(\frac{\mu}{\rho} + c\right)"


@paper.claim("theorem1.mended", "Theorem 1 with the leakage turned, if a constant delta bounds |eps_tilde_f| for all t", "implication",
             LAW_1 + r"\text{for every}\ c > 0\ \text{from some time on}\ (k_2 + k_1k_3)\tilde s^2 \le " + BOUND_1 +
             rf",\ \tilde v^2 \le {BOUND_1},\ \tilde W_f^T\Gamma_f^{{-1}}\tilde W_f \le {BOUND_1},\ \tilde\delta^2 \le "
             rf"\alpha_1 \cdot {BOUND_1}", "proved", origin="ours", mends="theorem1", severity="result", rests_on=(),
             premises=("theorem1.decay", "comparison.end"), scope=EVERY_NETWORK,
             reading="rho is not that of (44): V has another weight on s_tilde, so that (40) is not needed.",
             note="For all k_i > 0 the four errors of the observer are uniformly ultimately bounded; s_hat itself grows with s. V "
                  "decays (theorem1.decay), and comparison.end says what follows: c counts at the "
                  "latest from t = V(0)/(rho c) on. delta bounds |eps_tilde_f| while z_1 stays in Omega (15.inside), see "
                  "18.bound for one that does. The laws still use v_tilde, which is not measured (19.measured).")
def theorem_1_mended() -> Goal:
    """What a V near mu/rho means for each signal."""
    return ends_near(V_weighted, mu_1_bound, at_most((k_2 + k_1 * k_3) * s_tilde**2, 2 * near_end),
                     at_most(v_tilde**2, 2 * near_end), at_most(square_f, 2 * near_end),
                     at_most(delta_tilde**2, 2 * alpha_1 * near_end))
