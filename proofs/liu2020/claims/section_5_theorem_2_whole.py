"""Section 5: Theorem 2 as a whole, as printed and with its signs turned."""

from __future__ import annotations

from workbench.proof.claim import D, Goal, at_most

from ..error_dynamics import t, theta_tilde, w_v
from ..exact_motions import hidden_v, tracking_motion, weight_v
from ..laws import alpha_2, beta_2, e_v, k_5, sigma_v
from ..lyapunov import V_2, V_tracking, bounded_by_eigenvalue, largest_v, norm_v, positive, rho, square_v
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi
from .section_5_theorem_1_eq_36_to_40 import free_2
from .section_5_theorem_1_eq_41_to_43 import mu_1_stated
from .section_5_theorem_1_eq_44_to_48 import ends_near, errors_vanish, near_end
from .section_5_theorem_2_eq_55_to_60 import bound_tracking, mu_2_stated


@paper.claim("theorem2", "Theorem 2: all signals of the closed loop are ultimately bounded", "limit",
             r"\text{all the signals in the closed-loop systems}\ (33)\ \text{are uniformly ultimately bounded}", "refuted",
             severity="result", match="words", closed_loop=True, rests_on=("23.bounded", "26.input", "28", "43", "55.first"),
             scope="one neuron in each network",
             reading="Along (13), (18) to (21), (26), (28), (31) to (35): a bounded signal is in the end below t. Decided of "
                     "-W_v_tilde^T h_v, a term of (33) but for its sign.",
             note="The leakage alone does it: with the plus sign of (35) theta_hat leaves its prior as exp(alpha_2 beta_2 t) while all "
                  "other errors are zero, for all gains (60.zero). In the motion here theta_hat, and with it D_2, grows as exp(t) "
                  "and W_v_hat^T h_v as -exp(t), while e_v stays where it is; networks are exact (eps_tilde = 0, theta = 0), "
                  "priors right, (40) holds. A train realises it: it stands, u = f_d = a_0 = 1 and d = 0, s_d rests, W_f* = 0, W_v* = 2, "
                  "and the inputs of both networks are constant. Section 7 speaks of the tracking and estimation errors alone: they stay "
                  "bounded in this motion, and whether they do in every one is open. With the leakage and (32) turned V_2 - V_1 decays, see "
                  "theorem2.mended, but that rests on (28), whose f_v contains the input and is no function of z_2, so that "
                  "a bounded eps_v presupposes the bounded input that is to be shown (26.input, 28.function): Theorem 2 is "
                  "not mended by the signs alone. (12), (20), (21), as laws that are taken, and (40) are missing among its "
                  "hypotheses.")
def theorem_2() -> Goal:
    """-W_v_tilde h_v = exp(t) - a constant along the printed loop."""
    return tracking_motion(at_most(-weight_v * hidden_v, t), width=1)


errors_vanish(2, "60", ("28", "43", "55.first"))


mu_tracking = positive(mu_2_stated - mu_1_stated)
BOUND_21 = r"2\left(\frac{\mu_{21}}{\rho} + c\right)"


@paper.claim("theorem2.decay", "V_2 - V_1 decays with the signs turned", "inequality",
             r"\dot V_{21} \le -\rho V_{21} + \mu_{21}", "proved", origin="ours", rests_on=(),
             premises=("55.mended", "56.weights.mended", "56.rates"), scope=EVERY_NETWORK,
             where={r"\rho": rho, "V_{21}": V_tracking, r"\mu_{21}": mu_tracking},
             note="V_21 is V_2 - V_1 and mu_21 is mu_2 - mu_1. For all ten columns of Table 2; plus before h_v e_v in (32), "
                  "minus before the leakage of (32) and (35), a constant theta that bounds |eps_v - (M/chi) d|, and rho at "
                  "most 2 chi k_5/M, alpha_2 beta_2 and sigma_v/lambda_max(Gamma_v^-1).")
def mended_decay() -> Goal:
    """From 55.mended."""
    rates = (at_most(rho * M, 2 * chi * k_5), at_most(rho, alpha_2 * beta_2), at_most(rho * largest_v, sigma_v))
    return Goal((at_most(D(V_tracking), -rho * V_tracking + mu_tracking),),
                (*paper.shown("55.mended"), *rates, bounded_by_eigenvalue(square_v, norm_v, largest_v)),
                {moving: free_2[moving] for moving in (e_v, w_v, theta_tilde)},
                lemmas=(at_most(positive(bound_tracking), -rho * V_tracking + mu_tracking),))


@paper.claim("theorem2.mended", "Theorem 2 with the signs turned, if (28) holds", "implication",
             r"\text{With (32) and the leakage of (32) and (35) turned, a constant}\ \theta \ge "
             r"|\varepsilon_v - \tfrac{M}{\chi}d|,\ V_{21} = \tfrac{M}{2\chi}e_v^2 + \tfrac12\tilde W_v^T\Gamma_v^{-1}\tilde W_v + "
             r"\tfrac{1}{2\alpha_2}\tilde\theta^2,\ \rho = \min\left\{\frac{2\chi k_5}{M}, \alpha_2\beta_2, "
             r"\frac{\sigma_v}{\lambda_{\max}(\Gamma_v^{-1})}\right\},\ \mu_{21} = \frac{\sigma_v}{2}\|W_v^* - W_{v0}\|^2 + "
             r"\frac{\beta_2}{2}(\theta - \theta_0)^2 + 0.2785\kappa_2\theta:\ \text{for every}\ c > 0\ \text{from some time on}\ "
             rf"\frac{{M}}{{\chi}}e_v^2 \le {BOUND_21},\ \tilde W_v^T\Gamma_v^{{-1}}\tilde W_v \le {BOUND_21},\ "
             rf"\tilde\theta^2 \le \alpha_2 \cdot {BOUND_21}",
             "proved", origin="ours", severity="result", rests_on=(),
             premises=("28", "theorem1.mended", "theorem2.decay", "comparison.end", "23.bounded"), scope=EVERY_NETWORK,
             note="No mended form of Theorem 2: it needs (28) with an eps_v that is bounded along the motion, for an f_v that "
                  "contains the input and the estimated weights. Where that is so, V_21 = V_2 - V_1 decays (theorem2.decay), "
                  "comes near to mu_21/rho (comparison.end), and the tracking error e_s is in the end at most B/k_4, B being a bound of "
                  "|e_v + k_1 s_tilde| (23.bounded); the train's own, s_d - s = e_s + s_tilde, adds what theorem1.mended "
                  "says of s_tilde.")
def theorem_2_mended() -> Goal:
    """What a V_2 - V_1 near mu/rho means for each signal."""
    return ends_near(V_tracking, mu_tracking, at_most(M / chi * e_v**2, 2 * near_end), at_most(square_v, 2 * near_end),
                     at_most(theta_tilde**2, 2 * alpha_2 * near_end))


mu_2_bound = positive(mu_2_stated)
RHO_2_TURNED = (r"\rho_2 = \min\left\{2k_1, 2k_3, \frac{2\chi k_5}{M}, \frac{\sigma_f}{\lambda_{\max}(\Gamma_f^{-1})}, "
                r"\alpha_1\beta_1, \frac{\sigma_v}{\lambda_{\max}(\Gamma_v^{-1})}, \alpha_2\beta_2\right\},\ "
                r"\mu_2\ \text{the}\ \mu\ \text{of (56)}:\ ")
TURNED_2 = (r"\text{With the leakage of (19), (21), (32), (35) and the first sign of (32) turned, (40), constants}\ \delta \ge "
            r"|\tilde\varepsilon_f|,\ \theta \ge |\varepsilon_v - \tfrac{M}{\chi}d|,\ " + RHO_2_TURNED)


@paper.claim("57.turned", "V_2 decays with the signs turned and (56) corrected, if (28) holds", "implication",
             TURNED_2 + r"\dot V_2 \le -\rho_2V_2 + \mu_2", "proved", origin="ours",
             premises=("28", "45.turned", "theorem2.decay"), scope=EVERY_NETWORK, where={r"\rho_2": rho, r"\mu_2": mu_2_bound})
def decay_turned() -> Goal:
    """The sum of 45.turned and theorem2.decay."""
    return Goal((at_most(D(V_2), -rho * V_2 + mu_2_bound),), (*paper.shown("45.turned"), *paper.shown("theorem2.decay")), free_2)


@paper.claim("60.mended", "V_2 comes as near to phi_2 as is wanted, with the signs turned, if (28) holds", "implication",
             TURNED_2 + r"\forall c > 0\ \exists T\ \forall t > T:\ V_2(t) \le \frac{\mu_2}{\rho_2} + c", "proved", origin="ours",
             rests_on=(), premises=("57.turned", "comparison.end"), scope=EVERY_NETWORK,
             note="No mended form of the sentence after (60): (28) is open, as for Theorem 2. V_2 decays (57.turned), so that (59) "
                  "holds, at the latest from t = V_2(0)/(rho_2 c) on.")
def comes_near_turned() -> Goal:
    """(59) for large t."""
    return ends_near(V_2, mu_2_bound, at_most(V_2, near_end))
