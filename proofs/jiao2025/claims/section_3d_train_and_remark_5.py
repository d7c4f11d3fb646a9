"""Section 3 held against the train: what of Theorem 1 it keeps, Remark 5, and the stated parameters."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, differ, equal, greater, less

from ..laws import e_prev, epsilon, input_step, lamda, phi_first, rho
from ..notation import Delta_v_k, p_k, v_d
from ..paper import paper
from ..plant import M, T_s, next_speed, u_i, u_prev, v_i
from ..stated_values import EVERY_LENGTH, STATED, TRIALS, Reading, newton, per_mass, per_mass_1s, stated
from .section_2a_train import a, b, f_a_i, f_a_prev
from .section_2b_data_model import damped
from .section_3c_theorem_1 import (
    contraction,
    error,
    g,
    geometric_term,
    j,
    lambda_min_exists,
    m_i,
    m_prev,
    mean_of,
    phi_hat,
    shortfall,
)


@paper.claim("theorem1.train.lambda", "For the train no lambda_min makes (14) contract at every sample", "inequality",
             r"\forall\lambda, \rho, \hat\phi_c\ \exists\,\Delta v(k,i):\ |e(k+1,i)| = 2|e(k+1,i-1)|", "proved",
             premises=("5.trials", "14"), origin="ours",
             note="phi_c = T_s/M + a Delta v(k)/Delta u(k) takes every value, and with it the factor of theorem1.step every value, here -2: the "
                  "error at k + 1 doubles because of what earlier inputs did. That the theorem's conclusion can still hold in the limit is theorem1.train.")
def error_doubles() -> Goal:
    """The speed difference that makes e(k+1,i) = -2 e(k+1,i-1), for any nonzero error."""
    step = input_step(phi_hat, e_prev)
    needed = (3 * e_prev - b * step) / a
    after = e_prev - (a * needed + b * step)
    return Goal((equal(after, -2 * e_prev),), (greater(a, 0), differ(e_prev, 0)))


@paper.claim("conclusion", "Section 5: the analysis shows that the train's expected error converges", "limit",
             r"\text{strict theoretical analysis shows that the expectation of the tracking error converges asymptotically as the number of trials grows}", "gap",
             premises=("5.trials", "14"), rests_on=("theorem1", "A2", "A4"), severity="result", match="words",
             reading="The step of the analysis for the train (1)-(3): the error at each sample shrinks from trial to trial, whatever lambda.",
             note="Section 5 says it of the train's system, of which nothing is known. The analysis needs Assumptions 2 and 4, which the train breaks, so that the error of a sample may double. "
                  "The limit itself holds under the conditions of theorem1.train, by another proof.")
def analysis_of_the_train() -> Goal:
    """5.trials with the step of (14)."""
    step = input_step(phi_hat, e_prev)
    after = e_prev - (a * Delta_v_k + b * step)
    return Goal((at_most(after**2, e_prev**2),), damped)


share = sp.Symbol("gamma_01", real=True)


@paper.claim("theorem1.train.step", "The train's error of the next trial, one sample", "inequality",
             r"|e(k+1,i)| \le |1 - \gamma g|\,|e(k+1,i-1)| + |\Delta v(k,i)|", "proved", premises=("5.trials", "14"), origin="ours",
             note="g = (T_s/M) rho phi_hat/(lambda + phi_hat^2), for any estimate; 0 <= a <= 1.")
def train_error_step() -> Goal:
    """The triangle inequality on e - a Delta v(k) - gamma g e."""
    after = e_prev - (a * Delta_v_k + g * share * e_prev)
    return Goal((at_most(sp.Abs(after), sp.Abs(1 - share * g) * sp.Abs(e_prev) + sp.Abs(Delta_v_k)),), damped)


least = sp.Symbol("d", positive=True)  # what every estimate in use takes at least from the error: |1 - g| <= 1 - d
disturbance, slack = (sp.IndexedBase(name, real=True) for name in ("z_j", "s"))


@paper.claim("theorem1.train.mean", "The train's expected error of the next trial, one sample", "implication",
             r"|1 - g| \le 1 - d \Rightarrow E|e(k+1,i)| \le (1 - p(k+1)d)\,E|e(k+1,i-1)| + E|\Delta v(k,i)|", "proved",
             premises=("theorem1.train.step", "gamma.mean"), origin="ours", scope="every finite number of outcomes, which lengths with finitely many values make",
             note="As theorem1.mean: outcome j has the chance r_j^2, the error e_j, the change z_j of the speed before, and errors that are t_j^2 and s_j^2 below the bounds of "
                  "theorem1.train.step with and without data. gamma(k+1,i-1) is independent of the outcome.")
def train_expected_step() -> Goal:
    """Both values of gamma, probabilities multiplied."""
    with_data = (1 - least) * error[j] + disturbance[j] - shortfall[j] ** 2
    without_data = error[j] + disturbance[j] - slack[j] ** 2
    after = p_k * mean_of(with_data) + (1 - p_k) * mean_of(without_data)
    return Goal((at_most(after, (1 - p_k * least) * mean_of(error[j]) + mean_of(disturbance[j])),), (at_least(p_k, 0), at_most(p_k, 1)))


r_rate, c_rate, Z, C = sp.symbols("r c Z C", positive=True)
z_now = sp.Symbol("z", nonnegative=True)


@paper.claim("theorem1.train", "The train's expected errors converge, sample after sample", "implication",
             r"c = 1 - p(k+1)d < r < 1,\ E|\Delta v(k,i)| \le Zr^i \Rightarrow E|e(k+1,i)| \le Cr^i,\ "
             r"E|\Delta v(k+1,i)| \le 2Cr^{i-1}", "proved", premises=("theorem1.train.mean",), rests_on=(), scope=EVERY_LENGTH, origin="ours", severity="result",
             mends="conclusion",
             note="Not the paper's argument, and what is left of Theorem 1 for the train: for estimates that stay between two bounds with |1 - g| < 1 there, 0 <= a <= 1, independent lengths, the same start "
                  "and f_a in every trial, d = min(g, 2-g) > 0 over them and p(k+1) > 0; induction over k with C >= m_0 and C >= Z r/(r - c). So the limit exists, but C grows from "
                  "sample to sample: see intro.growth. theta is r^(i-1).")
def train_converges() -> Goal:
    """One trial on, in powers of r; then the difference that the next sample is disturbed by."""
    power = geometric_term
    mean, = paper.shown("theorem1.train.mean")
    bounded = mean.subs({mean.left: m_i, mean_of(error[j]): m_prev, mean_of(disturbance[j]): z_now})
    given = (less(c_rate, r_rate), less(r_rate, 1), at_most(m_prev, C * power), at_most(z_now, Z * r_rate * power),
             at_least(C * (r_rate - c_rate), Z * r_rate), bounded, at_least(c_rate, 1 - p_k * least))
    return Goal((at_most(m_i, C * r_rate * power), at_most(m_i + m_prev, 2 * C * power)), given,
                lemmas=(at_most(m_i, c_rate * m_prev + z_now), at_most(c_rate * m_prev, c_rate * C * power), at_least(C * (r_rate - c_rate) * power, Z * r_rate * power),
                        at_most(m_i, C * r_rate * power), at_most(C * r_rate * power, C * power)))


c_shift = sp.Symbol("v_0", real=True)
alternating = 2 * a * c_shift / (2 - g)


@paper.claim("remark5.persists", "The error when the initial speed alternates", "identity",
             r"v(0,i) = (-1)^iv_0:\quad e(1,i) = (-1)^{i+1}\frac{2av_0}{2-g}\ \text{solves}\ e(1,i) = (1-g)e(1,i-1) - a\Delta v(0,i)",
             "proved", premises=("5.trials", "14"), origin="ours", note="For the train and a fixed estimate, g = b rho phi_hat/(lambda + phi_hat^2) < 2.")
def alternating_start() -> Goal:
    """An even trial after an odd one; odd after even is the same with the sign of v_0 turned."""
    return Goal((equal(-alternating, (1 - g) * alternating - a * 2 * c_shift),), (less(g, 2),))


coasted_odd, coasted_even = sp.symbols("w_odd w_even", real=True)  # what (1) makes of the initial speed without an input


def _odd_and_even() -> tuple[sp.Expr, tuple[Relation, ...]]:
    """The first sample of the train in odd and even trials: the error of the even ones, and (14) from each to the other."""
    odd = v_d - (coasted_odd + T_s / M * u_prev)
    step = input_step(phi_first, odd)  # (14)
    even = v_d - (coasted_even + T_s / M * (u_prev + step))
    return even, (equal(step + input_step(phi_first, even), 0), at_most(step**2, epsilon**2))  # the second test of (13): the estimate in use is the first one


@paper.claim("remark5", "Remark 5: identical initial conditions are not needed", "limit",
             r"\text{the convergence analysis does not need identical initial conditions, so the design relaxes the basic assumption of strictly identical initial conditions}", "refuted",
             premises=("1", "13", "14"), rests_on=("theorem1", "6"), severity="result", closed_loop=True, match="words",
             reading="A motion of the train (1)-(3) under (13)-(15) that repeats itself every second trial has no error at the first sample, whatever its initial speeds.",
             note="With initial speeds that alternate between two values the error at the first sample alternates and never shrinks (its size for a fixed estimate: remark5.persists). The input "
                  "changes by at most epsilon, so that (13) puts the first estimate back in every trial and the motion is exact. The proof does not see it because "
                  "(5) takes all of Delta v(1,i) for an effect of Delta u(0,i).")
def start_does_not_matter() -> Goal:
    """Both trials of the motion, by (1) and (14); the first estimate is above epsilon."""
    error, loop = _odd_and_even()
    forward = (greater(v_d, 0), at_least(coasted_odd, 0), at_least(coasted_even, 0))
    return Goal((equal(error, 0),), (*loop, *forward, greater(phi_first, epsilon), at_most(rho, 1), greater(lamda, rho**2 * (T_s / M) ** 2 / 4)))


@paper.claim("remark5.distribution", "Remark 5: the condition of convergence does not depend on p(k)", "implication",
             r"\text{the convergence condition of this paper has nothing to do with the probability distribution } p(k)", "proved", premises=("theorem1.lambda",),
             rests_on=("theorem1",), severity="result", match="words",
             reading="One lambda_min, rho^2 p^2/4, serves every p(k) in (0, 1]: the factor of the expected error lies in [0, 1).",
             note="p(k) must be above zero, which Assumption 3 does not give: gamma.positive. The rate does depend on it: remark5.end. Assumption 3 and Remark 3 take the distribution "
                  "as known; no law uses it.")
def any_distribution() -> Goal:
    """1 - p(k) g for every p(k), by theorem1.lambda."""
    factor = 1 - p_k * contraction
    given = (*lambda_min_exists().assume, *paper.shown("theorem1.lambda"), greater(p_k, 0), at_most(p_k, 1))
    return Goal((at_least(factor, 0), less(factor, 1)), given, lemmas=(greater(p_k * contraction, 0), at_most(p_k * contraction, contraction)))


@paper.claim("remark5.end", "Expected error at the last sample after 150 trials", "condition",
             r"\frac{E\{e(T_d,150)\}}{E\{e(T_d,0)\}} = (1 - \rho\,p(T_d))^{150} \ge 1 - 150\rho\,p(T_d) \ge \tfrac{63}{100}", "proved",
             premises=("theorem1.step", "gamma.p.step"), at={rho: STATED[rho], p_k: Fraction(1, 100)}, origin="ours",
             note="The condition of Theorem 1 is free of p(k), as Remark 5 says, its rate is not: by the paper's own recursion, with phi_hat = phi_c "
                  "(where g is below rho), more than 63 per cent of the expected error at k = 2000 is left after all 150 trials.")
def last_sample() -> Goal:
    """Bernoulli's bound of the power, at the stated rho and p(T_d) = 1/100."""
    return Goal((at_least(1 - TRIALS * rho * p_k, sp.Rational(63, 100)),))


@paper.claim("figure4", "An error of zero does not stay zero when f_a changes from trial to trial", "implication",
             r"e(k+1,i-1) = 0,\ \Delta u_f(k,i) = 0,\ \Delta v(k,i) = 0 \Rightarrow e(k+1,i) = \tfrac{T_s}{M}\Delta f_a", "proved", premises=("1", "14"), origin="ours",
             note="The simulation lets f_a change from trial to trial (Figure 4). Then e(k+1,i) = (T_s/M) Delta f_a with nothing learned or to learn: "
                  "neither (5) nor Theorem 1 has room for a disturbance that does not repeat.")
def changing_resistance() -> Goal:
    """(1) in two trials with the same speed and input."""
    change = next_speed(v_i, u_i, f_a_i) - next_speed(v_i, u_i, f_a_prev)
    return Goal((equal(e_prev - change, T_s / M * (f_a_i - f_a_prev)),), (equal(e_prev, 0),))


def _lambda_condition(reading: Reading, quarter: int, holds: bool, note: str) -> None:
    suffix = {4: "", 16: ".contracts"}[quarter]
    sign, than = (">", "< 1" if quarter == 4 else "< 2") if holds else (r"\le", r"\ge 1" if quarter == 4 else r"\ge 2")
    what = "meet" if holds else "miss"

    @paper.claim(f"theorem1.stated.{reading.suffix}{suffix}", f"The stated lambda and rho {what} theorem1.lambda{suffix} ({reading.title})", "condition",
                 rf"\lambda {sign} \tfrac{{1}}{{{quarter}}}\rho^2b^2\ \Leftrightarrow\ \max_{{\hat\phi}}"
                 rf"\frac{{\rho b\hat\phi}}{{\lambda + \hat\phi^2}} {than}", "proved", origin="ours",
                 premises=("theorem1.lambda",), at={**stated(rho, lamda), b: reading.gain}, note=note)
    def lambda_is_large_enough() -> Goal:
        limit = rho**2 * b**2 / quarter
        return Goal((greater(lamda, limit) if holds else at_most(lamda, limit),))


_lambda_condition(newton, 4, True, "b = T_s/M is the least that p can be; for the train with its memory no p is enough (A2.every).")
_lambda_condition(per_mass, 4, False, "The paper prints no value of lambda_min; this is the one that theorem1.lambda gives, with p = b = 0.1, the "
                  "least possible. The error may change its sign from trial to trial; it still shrinks (next claim).")
_lambda_condition(per_mass, 16, True, "|1 - g| < 1 for every positive estimate, at this one sample.")
_lambda_condition(per_mass_1s, 16, False, "At the estimate phi_hat = sqrt(lambda) the error of the first sample is multiplied by about -16 in every trial.")
