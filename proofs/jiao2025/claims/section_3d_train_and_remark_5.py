"""Section 3 held against the train: what of Theorem 1 it keeps, Remark 5, and the stated parameters."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, differ, equal, greater, less

from ..laws import e_prev, gamma, input_step, lamda, phi, phi_first, phi_i, rho
from ..notation import Delta_u_i, Delta_v_k, e_i, p, p_k, v_d
from ..paper import paper
from ..plant import M, T_s, next_speed, u_i, u_prev, v_i
from ..stated_values import STATED, TRIALS, Reading, newton, per_mass, per_mass_1s, stated
from .section_2a_train import a, b, f_a_i, f_a_prev
from .section_2b_data_model import change_at_rest, damped_little, nearby, slope, stated_gain, two_trials_after
from .section_2c_algorithm import after_reset, small_epsilon
from .section_3b_improved_laws import with_gamma
from .section_3c_theorem_1 import (
    contraction,
    e_two,
    g,
    i_trial,
    lambda_min_exists,
    m_0,
    m_i,
    m_prev,
    phi_c,
    phi_hat,
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


@paper.claim("conclusion", "the analysis shows that the train's expected error converges", "limit",
             r"\text{strict theoretical analysis shows that the expectation of the tracking error converges asymptotically as the number of trials grows}", "gap",
             premises=("5.trials", "13", "14"), rests_on=("theorem1", "remark2.inherent", "A4.train"), severity="result", match="words",
             reading="The analysis is Theorem 1's, by which no trial with data makes the error of a sample larger. Asked of the train (1)-(3), of which section 5 speaks, with T_s/M of section 4, in m/s per N, at the second "
                     "sample (k = 1) of the first trial that learns: both trials start alike, trial 0 has the error -0.4 m/s at k = 1 and 0.1 m/s at k + 1 = 2, and both samples have the positive first estimate 2 T_s/M. rho = 1 and lambda = 4 T_s^2/M^2, which is above "
                     "rho^2 p^2/4 for p = T_s/M; a is put at 0.9999, less than (3) and (17) make it at the speeds of the trip with (17) in N.",
             note="The analysis, Theorem 1, rests on a positive estimate as well (13.keeps); asked here with one, so that it fails even then. In the numbers (14) takes a quarter of each error: trial 1 is slower by 0.1 m/s at k = 1, and by some 0.075 m/s at k = 2, whose error grows from 0.1 to 0.175 m/s. The train meets neither Assumption 2 nor Assumption 4, so that Theorem 1 does not speak of it: an error can grow because of what earlier inputs did, for every lambda (theorem1.train.lambda). The limit "
                  "itself holds for the train where 0 <= a <= 1 in all trials and phi_hat(k,1) > 0, among other conditions, by another proof: theorem1.train. The way there need not be monotone: for u in N/kg one trial can multiply the error norm by ten (intro.growth), "
                  "while section 1 says of the method that it converges monotonically in the 2-norm.")
def analysis_of_the_train() -> Goal:
    """5.trials with (14) at the first two samples of trial 1, from equal starts, with the first estimate in use."""
    estimate = (*paper.shown("13"), equal(phi_first, 2 * b), small_epsilon)
    law = (equal(lamda, 4 * b**2), equal(rho, 1), greater(lamda, rho**2 * b**2 / 4))
    errors = (equal(e_two, sp.Rational(-2, 5)), equal(e_prev, sp.Rational(1, 10)))  # of trial 0
    changed = (equal(Delta_v_k, b * input_step(after_reset, e_two)), equal(Delta_u_i, input_step(after_reset, e_prev)))
    return Goal((at_most(e_prev - two_trials_after, e_prev),), (stated_gain, damped_little, *estimate, *law, *errors, *changed))


c_shift = sp.Symbol("v_0", real=True)
alternating = 2 * a * c_shift / (2 - g)


@paper.claim("remark5.persists", "The error when the initial speed alternates", "identity",
             r"v(0,i) = (-1)^iv_0:\quad e(1,i) = (-1)^{i+1}\frac{2av_0}{2-g}\ \text{solves}\ e(1,i) = (1-g)e(1,i-1) - a\Delta v(0,i)",
             "proved", premises=("5.trials", "14"), origin="ours", note="For the train and a fixed estimate, g = b rho phi_hat/(lambda + phi_hat^2) < 2.")
def alternating_start() -> Goal:
    """An even trial after an odd one; odd after even is the same with the sign of v_0 turned."""
    return Goal((equal(-alternating, (1 - g) * alternating - a * 2 * c_shift),), (less(g, 2),))


bound, gain_most = sp.symbols("delta G", positive=True)
gain_used = sp.Symbol("g_used", real=True)  # b times the factor of (14)
coasted_odd, coasted_even = sp.symbols("w_odd w_even", real=True)  # what (1) makes of the initial speed without an input


def _odd_and_even() -> tuple[sp.Expr, sp.Expr]:
    """The errors of the first sample of the train in an odd trial and in the even one after it, by (1) and (14)."""
    return v_d - (coasted_odd + u_prev * b), v_d - (coasted_even + b * u_prev + gain_used * e_prev)


@paper.claim("remark5.always", "While initial speeds alternate the errors of two trials are never both small", "implication",
             r"|e(1,i-1)|, |e(1,i)| \le \delta \Rightarrow |w_{\text{even}} - w_{\text{odd}}| \le (2 + G)\,\delta,\ G = \max_{\hat\phi}\tfrac{T_s}{M}\tfrac{\rho|\hat\phi|}{\lambda + \hat\phi^2}", "proved",
             premises=("1", "14"), origin="ours",
             note="For every lambda, rho, epsilon and every sequence of estimates, of either sign: by (14) the input no longer changes when the error is gone, and then the speed changes by what the start does.")
def never_both_small() -> Goal:
    """Two successive trials of the first sample; G bounds the gain of (14)."""
    odd, even = _odd_and_even()
    small = (at_most(e_prev, bound), at_least(e_prev, -bound), at_most(even, bound), at_least(even, -bound))
    reach = (2 + gain_most) * bound
    return Goal((at_most(coasted_even - coasted_odd, reach), at_least(coasted_even - coasted_odd, -reach)),
                (equal(e_prev, odd), *small, at_least(gain_used, -gain_most), at_most(gain_used, gain_most)),
                lemmas=(at_most(gain_used * e_prev, gain_most * bound), at_least(gain_used * e_prev, -gain_most * bound)))


@paper.claim("remark5", "Remark 5: the design relaxes the assumption of identical initial conditions", "limit",
             r"\text{this design can relax the basic assumption of ILC systems that the initial conditions need to be strictly identical}", "gap",
             premises=("1", "14"), rests_on=("remark2.inherent", "6"), severity="result", match="words",
             reading="For the train (1)-(3) with T_s/M of section 4, in m/s per N, and any factor of (14): an error that has gone at the first sample stays away in the next trial, whatever its initial speed.",
             note="True of the systems of Theorem 1, of which v(1,i) depends on u(0,i) alone: remark5.mended. It does not carry over to the train, which is no such system. By (14) the input no longer changes when the error "
                  "is gone, and then the speed changes by what the start does: while initial speeds alternate between two values no lambda, rho, epsilon and estimates make the error vanish (remark5.always; its size for a "
                  "fixed estimate: remark5.persists).")
def start_does_not_matter() -> Goal:
    """The first sample of two trials, by (1) and (14)."""
    odd, even = _odd_and_even()
    return Goal((equal(even, 0),), (stated_gain, greater(gain_used, 0), equal(e_prev, odd), equal(e_prev, 0), greater(v_d, 0), at_least(coasted_odd, 0), at_least(coasted_even, 0)))


start_effect = sp.Symbol("x_start", real=True)
small_change = sp.Symbol("h", nonnegative=True)


@paper.claim("remark5.mended", "Where Assumption 2 holds for any two runs no start enters the error of the first sample", "implication",
             r"\text{Assumption 1, Assumption 2 for any two runs} \Rightarrow e(1,i) = \left(1 - \gamma(1,i-1)\frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2}\right)e(1,i-1)\ \text{for all}\ v(0,i), v(0,i-1)",
             "proved", premises=("6.unchanged", "14"), rests_on=(), origin="ours", severity="result", mends="remark5",
             reading="x_start, what the two starts make v(1) differ by at the same input, is at most (p + L_u) h for every h, by 6.unchanged: here for the h with 2 (p + L_u) h = |x_start|.",
             note="So theorem1.mended needs no identical starts. A system whose v(1) depends on the start as well does not meet Assumption 2 for any two runs.")
def no_start_enters() -> Goal:
    """The start's effect is zero, and (14) makes the rest of the change."""
    least = (p + slope) * small_change
    bounds = tuple(relation.subs({change_at_rest: start_effect, nearby: small_change}) for relation in paper.shown("6.unchanged"))
    law, = paper.shown("14")
    change = start_effect + phi * (law.right.xreplace(with_gamma) - u_prev)
    step = (1 - gamma * rho * phi * phi_i / (lamda + phi_i**2)) * e_prev
    return Goal((equal(start_effect, 0), equal(e_i, step)), (*bounds, equal(4 * least**2, start_effect**2), equal(e_i, e_prev - change)),
                lemmas=(at_most(start_effect**2, least**2), at_most(start_effect**2, 0), equal(start_effect, 0)))


@paper.claim("remark5.distribution", "Remark 5: the condition of convergence does not depend on p(k)", "implication",
             r"\text{the convergence condition of this paper has nothing to do with the probability distribution } p(k)", "proved", premises=("theorem1.lambda",),
             rests_on=("theorem1",), severity="result", match="words",
             reading="One lambda_min, rho^2 p^2/16, serves every p(k) in (0, 1]: the factor of the expected size of the error, p(k)|1 - c| + 1 - p(k) with the c of theorem1.lambda, is below 1. Both signs of 1 - c stand.",
             note="p(k) must be above zero, as the definition of gamma has it. The rate depends on it: remark5.end; for (6) with a true estimate, Table 1 and p(T_d) = 1/100 more than 63 per cent are left after 150 trials, remark5.end.number. Assumption 3 and Remark 3 take the distribution "
                  "as known; no law uses it.")
def any_distribution() -> Goal:
    """p(k)|1 - c| + 1 - p(k) for every p(k), by theorem1.lambda."""
    given = (*lambda_min_exists().assume, *paper.shown("theorem1.lambda"), greater(p_k, 0), at_most(p_k, 1))
    missed = 1 - p_k
    return Goal((less(p_k * (1 - contraction) + missed, 1), less(p_k * (contraction - 1) + missed, 1)), given,
                lemmas=(greater(p_k * contraction, 0), less(contraction, 2), greater(p_k * (2 - contraction), 0)))


gain_at_truth = rho * phi_c**2 / (lamda + phi_c**2)


@paper.claim("remark5.end", "How slowly the expected error of the data model (6) falls where few trials arrive", "inequality",
             r"\hat\phi_c = \phi_c \Rightarrow E|e(k,i)| \ge (1 - i\rho\,p(k))\,E|e(k,0)|", "proved", premises=("theorem1.step", "gamma.mean"), origin="ours",
             reading="The step from i - 1 to i. With phi_hat = phi_c the factor of theorem1.step is 1 - gamma g with g = rho phi_c^2/(lambda + phi_c^2), below rho, so that errors keep their signs.",
             note="For the data model (6) with independent lengths and a true estimate; other estimates may make it fall faster, and the train is no such system. With Table 1 and p(T_d) = 1/100 more than "
                  "63 per cent are left after 150 trials: remark5.end.number.")
def falls_slowly() -> Goal:
    """One trial takes at most rho p(k) of the first error."""
    before = (1 - (i_trial - 1) * rho * p_k) * m_0
    given = (equal(m_i, (1 - p_k * gain_at_truth) * m_prev), at_least(m_prev, before), at_most(m_prev, m_0), greater(p_k, 0), at_most(p_k, 1), at_most(rho, 1))
    return Goal((at_least(m_i, (1 - i_trial * rho * p_k) * m_0), at_most(m_i, m_0)), given,
                lemmas=(at_most(gain_at_truth, rho), at_most(p_k * gain_at_truth * m_prev, p_k * rho * m_0), at_least(p_k * gain_at_truth * m_prev, 0)))


@paper.claim("remark5.end.number", "Expected error at the last sample after 150 trials, with a true estimate", "condition",
             r"1 - 150\rho\,p(T_d) \ge \tfrac{63}{100}", "proved",
             premises=("remark5.end", "gamma.p.step"), at={rho: STATED[rho], p_k: Fraction(1, 100)}, origin="ours",
             note="rho of Table 1, and p(T_d) = 1/100 of section 4.")
def last_sample() -> Goal:
    """The bound of remark5.end at the stated values."""
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
    what = f"is {'above' if holds else 'at most'} rho^2 p^2/{quarter}"
    p_name, gain = ("T_s", "T_s") if reading.suffix.startswith("mass") else ("T_s/M", r"\tfrac{T_s}{M}")  # (1) has no M for u in N/kg

    @paper.claim(f"theorem1.stated.{reading.suffix}{suffix}", f"The stated lambda {what} for p = {p_name} ({reading.title})", "condition",
                 rf"\lambda {sign} \tfrac{{1}}{{{quarter}}}\rho^2b^2\ \Leftrightarrow\ \max_{{\hat\phi}}"
                 rf"\frac{{\rho b\hat\phi}}{{\lambda + \hat\phi^2}} {than},\quad b = {gain}", "proved", origin="ours",
                 premises=("theorem1.lambda", "theorem1.lambda.sign"), at={**stated(rho, lamda), b: reading.gain}, note=note)
    def lambda_is_large_enough() -> Goal:
        limit = rho**2 * b**2 / quarter
        return Goal((greater(lamda, limit) if holds else at_most(lamda, limit),))


_lambda_condition(newton, 4, True, "b = T_s/M is the least that p can be; for the train with its memory no p is enough (A2.every).")
_lambda_condition(per_mass, 4, False, "With p = b = 0.1, the least possible: the error may change its sign from trial to trial; it still shrinks (next claim).")
_lambda_condition(per_mass, 16, True, "The paper prints no value of lambda_min; this is that of theorem1.lambda. |1 - g| < 1 for every positive estimate, at this one sample.")
_lambda_condition(per_mass_1s, 16, False, "At the estimate phi_hat = sqrt(lambda) the error of the first sample is multiplied by about -16 in every trial.")
