"""Section 3 held against the train: what is left of Theorem 1 for it, by another proof, sample after sample.

D(k,i) = |Delta v(k,i)| + (T_s/M) L |Delta s(k,i)| is what earlier samples make trials i-1 and i differ by at k + 1: the speeds,
and f_a at another place, where it is Lipschitz with the constant L.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, less

from ..laws import Delta_u, Delta_v, e_prev, epsilon, estimate_step, eta, gamma, phi_prev
from ..notation import Delta_v_k, p_k
from ..paper import paper
from ..stated_values import EVERY_LENGTH
from .section_2a_train import a, b
from .section_2b_data_model import Delta_f
from .section_3c_theorem_1 import error, g, j, largest, m_i, m_prev, mean_of, phi_upper, shortfall

share = sp.Symbol("gamma_01", real=True)
before = sp.Symbol("D_i", nonnegative=True)
factor, size_before, speeds, resistances = sp.symbols("c_g x_prev V_k F_k", nonnegative=True)


def _within(value: sp.Expr, most: sp.Expr) -> tuple[Relation, Relation]:
    return at_most(value, most), at_least(value, -most)


@paper.claim("theorem1.train.step", "The train's error of the next trial, one sample", "inequality",
             r"|e(k+1,i)| \le |1 - \gamma g|\,|e(k+1,i-1)| + D(k,i),\ D = |\Delta v(k,i)| + \tfrac{T_s}{M}L|\Delta s(k,i)|", "proved", premises=("5.trials.place", "14"), origin="ours",
             reading="Each size stands as a bound from both sides: c_g of 1 - gamma g, x_prev of e(k+1,i-1), V_k of Delta v(k,i), F_k of Delta f_a(k,i), which is at most L|Delta s(k,i)|.",
             note="g = (T_s/M) rho phi_hat/(lambda + phi_hat^2), for any estimate; 0 <= a <= 1, and f_a a function of the place alone, the same in every trial and Lipschitz with the constant L.")
def train_error_step() -> Goal:
    """The triangle inequality on e - a Delta v(k) + b Delta f_a - gamma g e."""
    kept, after = (1 - share * g) * e_prev, e_prev - (a * Delta_v_k - b * Delta_f + g * share * e_prev)
    most = factor * size_before
    given = (*_within(1 - share * g, factor), *_within(e_prev, size_before), *_within(Delta_v_k, speeds), *_within(Delta_f, resistances), at_least(a, 0), at_most(a, 1))
    return Goal(_within(after, most + speeds + b * resistances), given,
                lemmas=(at_least((factor - 1 + share * g) * (size_before + e_prev), 0), at_least((factor + 1 - share * g) * (size_before - e_prev), 0), at_most(kept, most),
                        at_least((factor - 1 + share * g) * (size_before - e_prev), 0), at_least((factor + 1 - share * g) * (size_before + e_prev), 0), at_least(kept, -most),
                        at_most(a * Delta_v_k, speeds), at_least(a * Delta_v_k, -speeds)))


@paper.claim("theorem1.train.estimate", "The train's estimates are bounded where its speeds are", "implication",
             r"|\Delta v(k+1,i-1)| \le \varepsilon\Phi,\ |\Delta u_f(k,i-1)| > \varepsilon,\ \hat\phi_c(k,i-1) \le \Phi \Rightarrow \hat\phi_c(k,i) \le \Phi", "proved",
             premises=("15",), origin="ours",
             note="With Phi at least phi_hat(k,1), so that a reset by (13), which comes where |Delta u| <= epsilon, is below Phi too. It need not be assumed that estimates are bounded, nor that phi_c is.")
def train_estimate_bounded() -> Goal:
    """(15) where its innovation is of the train."""
    new = phi_prev + estimate_step(Delta_u, gamma * (Delta_v - phi_prev * Delta_u))
    return Goal((at_most(new, phi_upper),), (at_most(phi_prev, phi_upper), at_least(Delta_u**2, epsilon**2), at_most(Delta_v**2, epsilon**2 * phi_upper**2),
                                             at_least(gamma, 0), at_most(gamma, 1), at_most(eta, 1)),
                lemmas=(at_most(Delta_v**2, Delta_u**2 * phi_upper**2), at_most(Delta_u * Delta_v, Delta_u**2 * phi_upper),
                        at_most(gamma * eta * (Delta_u * Delta_v - Delta_u**2 * phi_upper), 0),
                        at_most((1 - gamma * eta) * Delta_u**2 * (phi_prev - phi_upper), 0)))


least = sp.Symbol("d", positive=True)  # what every estimate in use takes at least from the error: |1 - g| <= 1 - d
change, size, size_prev, size_start, sum_change, sum_before = sp.symbols("y x_i x_prev x_0 Y_prev D_prev", nonnegative=True)


@paper.claim("theorem1.train.sum", "What the speeds of a sample change by over all trials is bounded", "implication",
             r"\sum_{i' \le i}|\Delta v(k+1,i')| + \tfrac{s}{d}|e(k+1,i)| \le \tfrac{s}{d}|e(k+1,0)| + (1 + \tfrac{s}{d})\sum_{i' \le i}D(k,i')", "proved",
             premises=("theorem1.train.step",), origin="ours", scope=EVERY_LENGTH,
             reading="The step from i - 1 to i; x_i, x_prev and x_0 are the sizes of the errors of trials i, i-1 and 0, y is |Delta v(k+1,i)|, Y_prev and D_prev are the sums up to i - 1, D_i is D(k,i), and gamma is 1 or 0.",
             note="Where |1 - g| <= 1 - d and g <= s. In every run, whatever the lengths: so |e(k+1,i)| and |Delta v(k+1,i)| are bounded over i, and, since |Delta s(k+1,i)| <= |Delta s(k,i)| + T_s |Delta v(k,i)|, "
                  "so are the sums of D(k+1,i). The induction over k starts from the same speed and place in every trial, D(0,i) = 0. d follows at each k from the bound of |Delta v(k+1,i)|, by theorem1.train.estimate; "
                  "that bound needs |1 - g| <= 1 alone.")
def sums_bounded() -> Goal:
    """|Delta v| = |w + gamma g e|, and what a trial with data takes from the error."""
    ratio = largest / least
    given = (at_most(change, before + largest * share * size_prev), at_most(size, (1 - share * least) * size_prev + before),
             at_most(sum_change + ratio * size_prev, ratio * size_start + (1 + ratio) * sum_before))
    return Goal((at_most(sum_change + change + ratio * size, ratio * size_start + (1 + ratio) * (sum_before + before)),), given,
                lemmas=(at_most(ratio * size, ratio * ((1 - share * least) * size_prev + before)),))


disturbance, without, slack = (sp.IndexedBase(name, real=True) for name in ("z_j", "zeta_j", "s_j"))


@paper.claim("theorem1.train.mean", "The train's expected error of the next trial, one sample", "implication",
             r"|1 - g| \le 1 - d \Rightarrow E|e(k+1,i)| \le (1 - p(k+1)d)\,E|e(k+1,i-1)| + E\,D(k,i)", "proved",
             premises=("theorem1.train.step", "gamma.mean"), origin="ours", scope="every finite number of outcomes, which lengths with finitely many values make",
             note="As theorem1.mean: outcome j has the chance q_j^2, an error of the size e_j, and errors that are t_j^2 and s_j^2 below the bounds of "
                  "theorem1.train.step with and without data. gamma(k+1,i-1) is independent of the outcome, A3.independent.mended; D(k,i) is not independent of gamma, it is z_j with data and zeta_j without.")
def train_expected_step() -> Goal:
    """Both values of gamma, probabilities multiplied."""
    with_data = (1 - least) * error[j] + disturbance[j] - shortfall[j] ** 2
    without_data = error[j] + without[j] - slack[j] ** 2
    after = p_k * mean_of(with_data) + (1 - p_k) * mean_of(without_data)
    return Goal((at_most(after, (1 - p_k * least) * mean_of(error[j]) + p_k * mean_of(disturbance[j]) + (1 - p_k) * mean_of(without[j])),), (at_least(p_k, 0), at_most(p_k, 1)))


r_rate, c_rate, Z, C = sp.symbols("r c Z C", positive=True)
power_of_r = sp.Symbol("theta_r", nonnegative=True)  # r^(i-1)
z_now, z_with, z_without = sp.symbols("z z_with z_without", nonnegative=True)


@paper.claim("theorem1.train", "The train's expected errors converge where 0 <= a <= 1 in all trials, the starts v(0,i), s(0,i) are equal, f_a is Lipschitz in the place, phi_hat(k,1) > 0, and the lengths are independent of each other and of all else", "limit",
             r"\text{(1)-(3)},\ 0 \le a \le 1\ \text{at all}\ k, i,\ |\Delta f_a| \le L|\Delta s|,\ \text{the same } v(0,i), s(0,i)\ \text{for all}\ i,\ \rho, \eta \in (0, 1],\ \mu > 0,\ \hat\phi_c(k,1) > 0,\ v(0,i), s(0,i), u_f(k,0), \hat\phi_c(k,1)\ \text{not random},\ "
             r"\lambda > \tfrac{1}{16}\rho^2\tfrac{T_s^2}{M^2},\ T_0, T_1, \ldots\ \text{independent of each other and of all else that is random, each as in Assumption 3},\ 0 < p(k) \le 1 \Rightarrow "
             r"E|e(k,i)| \le C_kr_k^i \to 0,\ k \ge 1", "proved", premises=("theorem1.train.mean", "theorem1.train.sum", "theorem1.train.estimate", "13.mended", "theorem1.lambda", "theorem1.low", "gamma.positive", "A3.independent.mended"),
             rests_on=(), scope=EVERY_LENGTH, origin="ours", severity="result", mends="conclusion",
             reading="The step of the induction over i at a sample, and what it hands on to the next: with c = 1 - p(k+1)d < r < 1 and E D(k,i) <= Z r^i it is E|e(k+1,i)| <= C r^i and E|Delta v(k+1,i)| <= 2C r^(i-1), "
                     "for C >= E|e(k+1,0)| and C >= Z r/(r - c); theta_r is r^(i-1).",
             note="Not the paper's argument, and what is left of Theorem 1 for the train. Starts, first input and first estimate are numbers: with random ones C and r need not exist. a is the share of 5.trials. That it stays within [0, 1] in all trials is a condition on the loop: at the speeds of the trip it does (5.loss), but speeds may be far from them while the errors still grow (intro.growth). By 13.mended and theorem1.train.estimate the estimates lie "
                  "between two bounds, by theorem1.lambda with p = T_s/M, and by theorem1.low, d = min(g, 2 - g) > 0 over them. At the next sample E D(k+1,i) is again below such a power. C grows from sample to sample. What v and e are beyond T_i the paper does not say: they are taken as what (1) makes of the inputs.")
def train_converges() -> Goal:
    """One trial on, in powers of r; then the difference that the next sample is disturbed by."""
    power = power_of_r
    mean, = paper.shown("theorem1.train.mean")
    bounded = mean.subs({mean.left: m_i, mean_of(error[j]): m_prev, mean_of(disturbance[j]): z_with, mean_of(without[j]): z_without})
    given = (less(c_rate, r_rate), less(r_rate, 1), at_most(m_prev, C * power), equal(z_now, p_k * z_with + (1 - p_k) * z_without), at_most(z_now, Z * r_rate * power),
             at_least(C * (r_rate - c_rate), Z * r_rate), bounded, at_least(c_rate, 1 - p_k * least))
    return Goal((at_most(m_i, C * r_rate * power), at_most(m_i + m_prev, 2 * C * power)), given,
                lemmas=(at_most(m_i, c_rate * m_prev + z_now), at_most(c_rate * m_prev, c_rate * C * power), at_least(C * (r_rate - c_rate) * power, Z * r_rate * power),
                        at_most(m_i, C * r_rate * power), at_most(C * r_rate * power, C * power)))
