"""Section 5, Theorem 1: what (45), (47), (48) and Remark 2 become with the leakage turned."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal

from ..error_dynamics import delta_tilde
from ..laws import alpha_1, beta_1, k_1, k_2, k_3, kappa_1, s_tilde, sigma_f, v_tilde
from ..lyapunov import V_1, bounded_by_eigenvalue, largest_f, mu, norm_f, positive, rates_1, rho, square_f
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..smooth_sign import constant
from .section_5_theorem_1_eq_36_to_40 import free_1
from .section_5_theorem_1_eq_41_to_43 import mu_1_stated
from .section_5_theorem_1_eq_44_to_48 import c, ends_near, near_end, norm_48, robust_size

mu_1_bound = positive(mu_1_stated)
TURNED_1 = (r"\text{With a minus sign before the leakage of (19) and (21), (40), a constant}\ \delta \ge |\tilde\varepsilon_f|,\ "
            r"\rho_1 = \min\left\{2k_1, 2k_3, \frac{\sigma_f}{\lambda_{\max}(\Gamma_f^{-1})}, \alpha_1\beta_1\right\},\ "
            r"\mu_1\ \text{of (44)}:\ ")


@paper.claim("45.turned", "V_1 decays with the leakage turned and (44) corrected", "implication",
             TURNED_1 + r"\dot V_1 \le -\rho_1V_1 + \mu_1", "proved", origin="ours", premises=("43.mended",), scope=EVERY_NETWORK,
             where=ERRORS | {r"\rho_1": rho, r"\mu_1": mu_1_bound})
def decay_turned() -> Goal:
    """(45) from 43.mended."""
    return Goal((at_most(D(V_1), -rho * V_1 + mu_1_bound),),
                (*paper.shown("43.mended"), *rates_1(largest_f), at_most(rho, alpha_1 * beta_1),
                 bounded_by_eigenvalue(square_f, norm_f, largest_f)), free_1)


@paper.claim("48.mended", "V_1 comes as near to phi_1 as is wanted, with the leakage turned, (40), (44) corrected and a constant delta that bounds "
             "|eps_tilde_f| for all t",
             "implication",
             TURNED_1 + r"\forall c > 0\ \exists T\ \forall t > T:\ \tilde s^2 + \tilde v^2 + \tilde W_f^T\Gamma_f^{-1}\tilde W_f "
             r"+ \tfrac{1}{\alpha_1}\tilde\delta^2 \le 2\left(\frac{\mu_1}{\rho_1} + c\right)", "proved", origin="ours",
             mends="48.zero", rests_on=(), premises=("45.turned", "comparison.end"), scope=EVERY_NETWORK,
             note="The left side is 2 V_1. V_1 decays (45.turned), so that (47) holds, at the latest from t = V_1(0)/(rho_1 c) on.")
def comes_near_turned() -> Goal:
    """(47) for large t."""
    return ends_near(V_1, mu_1_bound, at_most(norm_48 + delta_tilde**2 / alpha_1, 2 * near_end))


wanted = sp.Symbol("V_wanted", positive=True)
prior_size, off_size = sp.symbols("W_off_square delta_off_square", nonnegative=True)


@paper.claim("47.small.mended", "The bound mu_1/rho_1 can be made arbitrarily small by the gains", "implication",
             r"\rho_1 = \min\left\{2k_1, 2k_3, \frac{\sigma_f}{\lambda_{\max}(\Gamma_f^{-1})}, \alpha_1\beta_1\right\}:\ "
             r"\text{for fixed}\ \delta, \delta_0, W_{f0}, \kappa_1\ \text{and every}\ \varphi > 0\ \text{there are gains with (40) and}\ "
             r"\frac{\mu_1}{\rho_1} \le \varphi", "proved", origin="ours",
             mends="47.small", rests_on=(), premises=("44.weights.mended", "44.estimate.glyph"),
             note="Witness, for mu_1 > 0; for mu_1 = 0 any gains with (40) do: sigma_f = beta_1 = 1, rho = mu_1/phi, Gamma_f = rho times the "
                  "identity, alpha_1 = rho, k_1 = k_3 = rho/2, k_2 = 1 + k_1 k_3.")
def arbitrarily_small() -> Goal:
    """The entries of the corrected rho_1 and the bound phi for the gains of the witness."""
    total = prior_size / 2 + off_size / 2 + constant * kappa_1 * robust_size
    witness = (equal(sigma_f, 1), equal(beta_1, 1), equal(rho * wanted, total), equal(largest_f * rho, 1),
               equal(alpha_1, rho), equal(2 * k_1, rho), equal(2 * k_3, rho), equal(k_2, 1 + k_1 * k_3))
    return Goal((*rates_1(largest_f), at_most(rho, alpha_1 * beta_1), at_most(total / rho, wanted),
                 equal(-k_2 + k_1 * k_3 + 1, 0)), witness)


@paper.claim("remark2.mended", "Remark 2 with the leakage turned, if one delta bounds |eps_tilde_f| for all t and all gains", "implication",
             r"\text{With a minus sign before the leakage of (19) and (21) and one constant}\ \delta \ge |\tilde\varepsilon_f|\ "
             r"\text{for all gains and times}, \delta_0, W_{f0}, \kappa_1\ \text{fixed}: \forall r > 0\ \text{there are gains with}\ \frac{\mu_1}{\rho_1} \le "
             r"\tfrac{r^2}{4},\ \text{and from some time on}\ |\tilde s| \le r,\ |\tilde v| \le r", "proved", origin="ours",
             mends="remark2", severity="result", rests_on=(), premises=("47.small.mended", "48.mended"), scope=EVERY_NETWORK,
             reading="mu_1 is that of (44), rho_1 = min{2 k_1, 2 k_3, sigma_f/lambda_max(Gamma_f^-1), alpha_1 beta_1}; such "
                     "gains are those of 47.small.mended. The motion, and with it eps_tilde_f, changes with the gains: one delta "
                     "bounds all of them where z_1 stays in Omega, see 18.bound.",
             note="2 V_1 is in the end at most 2 mu_1/rho_1 + r^2/2 (48.mended, c = r^2/4), with gains that meet (40). The larger "
                  "they are, the smaller r.", section="3")
def estimates_settle_mended() -> Goal:
    """What 2 V_1 <= r^2 means for its first two squares."""
    r = sp.Symbol("r", positive=True)
    return Goal((at_most(sp.Abs(s_tilde), r), at_most(sp.Abs(v_tilde), r)),
                (*paper.shown("48.mended"), equal(c, r**2 / 4), at_most(mu / rho, r**2 / 4)),
                lemmas=(at_most(s_tilde**2, r**2), at_most(v_tilde**2, r**2)))
