"""Section 5: Theorem 2 as a whole, as printed and with its signs turned."""

from __future__ import annotations

from workbench.proof.claim import D, Goal, at_most, greater

from ..error_dynamics import t, theta_tilde, w_v
from ..exact_motions import tracking_motion
from ..laws import alpha_2, beta_2, e_v, k_5, sigma_v
from ..lyapunov import V_tracking, bounded_by_eigenvalue, lambda_v, mu, norm_v, positive, rho, square_v
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi
from .section_5_theorem_1_eq_36_to_40 import free_2
from .section_5_theorem_1_eq_41_to_43 import mu_1_stated, slack
from .section_5_theorem_1_eq_44_to_48 import V_t
from .section_5_theorem_2_eq_55_to_60 import bound_tracking, mu_2_stated


@paper.claim("theorem2", "Theorem 2: all signals of the closed loop are ultimately bounded", "limit",
             r"\text{all the signals in the closed-loop systems}\ (33)\ \text{are uniformly ultimately bounded}", "refuted",
             severity="result", match="words", closed_loop=True, rests_on=("23.bounded", "28", "59"),
             scope="one neuron in each network",
             reading="A bounded signal is in the end below t, so theta_tilde would be, along (13), (18) to (21), (26), "
                     "(28), (31) to (35).",
             note="With exact networks (eps_tilde = 0, theta = 0), right priors and (40) the printed loop has a solution in "
                  "which theta_hat, and with it D_2, grows as exp(t) and W_v_hat^T h_v as -exp(t), while e_v stays at "
                  "log(3)/2. The signs of the leakage and of (32) do it; with them turned V_2 decays, see "
                  "theorem2.mended, but that rests on (28), whose f_v contains the input and is no function of z_2 "
                  "(27.input, 28.function): this gap remains, so Theorem 2 is not mended by the signs alone.")
def theorem_2() -> Goal:
    """theta_tilde = 2 exp(t) - log(3)/2 along the printed loop."""
    return tracking_motion(at_most(theta_tilde, t))


mu_tracking = positive(mu_2_stated - mu_1_stated)


@paper.claim("theorem2.decay", "V_2 - V_1 decays with the signs turned", "inequality",
             r"\dot V_{21} \le -\rho V_{21} + \mu_{21}", "proved", origin="ours", rests_on=(),
             premises=("55.mended", "56.weights.mended", "56.rates"), scope=EVERY_NETWORK,
             where={r"\rho": rho, "V_{21}": V_tracking, r"\mu_{21}": mu_tracking},
             note="V_21 is V_2 - V_1 and mu_21 is mu_2 - mu_1. For all ten columns of Table 2; plus before h_v e_v in (32), minus before the leakage of (32) and (35), "
                  "a constant theta that bounds |eps_v - (M/chi) d|, lambda_max in place of lambda_min.")
def mended_decay() -> Goal:
    """From 55.mended."""
    rates = (at_most(rho * M, 2 * chi * k_5), at_most(rho, alpha_2 * beta_2), at_most(rho * lambda_v, sigma_v))
    return Goal((at_most(D(V_tracking), -rho * V_tracking + mu_tracking),),
                (*paper.shown("55.mended"), *rates, bounded_by_eigenvalue(square_v, norm_v, lambda_v)),
                {moving: free_2[moving] for moving in (e_v, w_v, theta_tilde)},
                lemmas=(at_most(positive(bound_tracking), -rho * V_tracking + mu_tracking),))


@paper.claim("theorem2.mended", "Theorem 2 with the signs turned, if (28) holds", "implication",
             r"\text{With (32) and the leakage of (32) and (35) turned and a constant}\ \theta \ge "
             r"|\varepsilon_v - \tfrac{M}{\chi}d|, \text{for every}\ c > 0\ \text{from some time on:}\ "
             r"\frac{M}{\chi}e_v^2 \le 2\left(\frac{\mu_2}{\rho_2} + c\right),\ \tilde W_v^T\Gamma_v^{-1}\tilde W_v \le "
             r"2\left(\frac{\mu_2}{\rho_2} + c\right),\ \tilde\theta^2 \le 2\alpha_2\left(\frac{\mu_2}{\rho_2} + c\right)",
             "proved", origin="ours", mends="theorem2", severity="result", rests_on=(),
             premises=("28", "theorem1.mended", "theorem2.decay", "comparison", "60.mended", "23.bounded"), scope=EVERY_NETWORK,
             where=ERRORS | {r"\mu_2": mu, r"\rho_2": rho, "c": slack},
             note="For every c > 0 from some time on: V_2 - V_1 decays (theorem2.decay), so it meets the bound of "
                  "60.mended, and e_s follows (23.bounded). It needs (28) with a bounded eps_v along the motion, for an "
                  "f_v that contains the input and the estimated weights.")
def theorem_2_mended() -> Goal:
    """What a V_2 - V_1 near mu/rho means for each signal."""
    ultimate, = paper.shown("60.mended")
    bound = 2 * (mu / rho + slack)
    return Goal((at_most(M / chi * e_v**2, bound), at_most(square_v, bound),
                 at_most(theta_tilde**2, 2 * alpha_2 * (mu / rho + slack))),
                (ultimate.subs({V_t: V_tracking}), greater(slack, 0)))
