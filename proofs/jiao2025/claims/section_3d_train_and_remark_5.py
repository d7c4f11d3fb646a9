"""Section 3 held against the train: what of Theorem 1 it keeps, Remark 5, and the stated parameters."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, differ, equal, greater, less

from ..laws import e_next, e_prev, epsilon, input_step, lamda, phi_first, phi_i, rho
from ..notation import p_k, v_d
from ..paper import paper
from ..plant import M, T_s, next_speed, u_i, u_prev, v_i
from ..stated_values import STATED, TRIALS, Reading, newton, per_mass, per_mass_1s, stated
from .section_2a_train import a, b, f_a_i, f_a_prev
from .section_3c_theorem_1 import (
    contraction,
    g,
    lambda_min_exists,
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
             premises=("1", "13", "14"), rests_on=("theorem1", "remark2.inherent", "A4.train"), severity="result", match="words",
             reading="For the train (1)-(3), of which section 5 speaks: a motion under (13)-(15) that is the same in every trial has no error.",
             note="The analysis is Theorem 1, and the train meets neither Assumption 2 nor Assumption 4. As there, a first estimate of zero keeps the input for ever. The limit "
                  "itself holds for the train under the conditions of theorem1.train, by another proof; the way there may lead through much larger errors (intro.growth).")
def analysis_of_the_train() -> Goal:
    """The train in two trials that are equal, by (14) with the estimate after a reset."""
    law, = paper.shown("14")
    same = law.right.xreplace({e_next: e_prev, phi_i: phi_first})
    return Goal((equal(e_prev, 0),), (equal(e_prev, v_d - next_speed(v_i, u_prev)), equal(same, u_prev), greater(v_d, 0), at_least(v_i, 0), at_most(rho, 1)))


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


def _odd_and_even() -> tuple[sp.Expr, tuple[Relation, ...]]:
    """The first sample of the train in odd and even trials: the error of the even ones, and (14) from each to the other."""
    odd = v_d - (coasted_odd + T_s / M * u_prev)
    step = input_step(phi_first, odd)  # (14)
    even = v_d - (coasted_even + T_s / M * (u_prev + step))
    return even, (equal(step + input_step(phi_first, even), 0), at_most(step**2, epsilon**2))  # the second test of (13): the estimate in use is the first one


@paper.claim("remark5.always", "While initial speeds alternate the errors of two trials are never both small", "implication",
             r"|e(1,i-1)|, |e(1,i)| \le \delta \Rightarrow |w_{\text{even}} - w_{\text{odd}}| \le (2 + G)\,\delta,\ G = \max_{\hat\phi}\tfrac{T_s}{M}\tfrac{\rho\hat\phi}{\lambda + \hat\phi^2}", "proved",
             premises=("1", "14"), origin="ours",
             note="For every lambda, rho, epsilon and every sequence of estimates: by (14) the input no longer changes when the error is gone, and then the speed changes by what the start does.")
def never_both_small() -> Goal:
    """Two successive trials of the first sample; G bounds the gain of (14)."""
    odd, even = v_d - (coasted_odd + u_prev * b), v_d - (coasted_even + b * u_prev + gain_used * e_prev)
    small = (at_most(e_prev, bound), at_least(e_prev, -bound), at_most(even, bound), at_least(even, -bound))
    reach = (2 + gain_most) * bound
    return Goal((at_most(coasted_even - coasted_odd, reach), at_least(coasted_even - coasted_odd, -reach)),
                (equal(e_prev, odd), *small, at_least(gain_used, 0), at_most(gain_used, gain_most)),
                lemmas=(at_most(gain_used * e_prev, gain_most * bound), at_least(gain_used * e_prev, -gain_most * bound)))


@paper.claim("remark5", "Remark 5: the design relaxes the assumption of identical initial conditions", "limit",
             r"\text{this design can relax the basic assumption of ILC systems that the initial conditions need to be strictly identical}", "refuted",
             premises=("1", "13", "14"), rests_on=("remark2.inherent", "6"), severity="result", closed_loop=True, match="words",
             reading="A motion of the train (1)-(3) under (13)-(15) that repeats itself every second trial has no error at the first sample, whatever its initial speeds.",
             note="Say the error at the first sample vanished while the initial speeds alternate between two values. By (14) the change of u(0,i) would vanish with it, and Delta v(1,i) would come down to what the start "
                  "alternates by, which is not zero: so the error does not vanish, whatever lambda, rho, epsilon and the estimates are (remark5.always; its size for a fixed estimate: remark5.persists). In the motion "
                  "here the input changes by at most epsilon, so that (13) puts the first estimate back in every trial. That the convergence analysis does not need identical starts, as the remark says "
                  "before, is true of systems that meet Assumption 2, by which Delta v(1,i) comes from Delta u(0,i) alone; the train is none.")
def start_does_not_matter() -> Goal:
    """Both trials of the motion, by (1) and (14); the first estimate is above epsilon."""
    error, loop = _odd_and_even()
    forward = (greater(v_d, 0), at_least(coasted_odd, 0), at_least(coasted_even, 0))
    return Goal((equal(error, 0),), (*loop, *forward, greater(phi_first, epsilon), at_most(rho, 1), greater(lamda, rho**2 * (T_s / M) ** 2 / 4)))


@paper.claim("remark5.distribution", "Remark 5: the condition of convergence does not depend on p(k)", "implication",
             r"\text{the convergence condition of this paper has nothing to do with the probability distribution } p(k)", "proved", premises=("theorem1.lambda",),
             rests_on=("theorem1",), severity="result", match="words",
             reading="One lambda_min, rho^2 p^2/16, serves every p(k) in (0, 1]: the factor of the expected size of the error, p(k)|1 - c| + 1 - p(k) with the c of theorem1.lambda, is below 1. Both signs of 1 - c stand.",
             note="p(k) must be above zero, as the definition of gamma has it. The rate does depend on it: remark5.end. Assumption 3 and Remark 3 take the distribution "
                  "as known; no law uses it.")
def any_distribution() -> Goal:
    """p(k)|1 - c| + 1 - p(k) for every p(k), by theorem1.lambda."""
    given = (*lambda_min_exists().assume, *paper.shown("theorem1.lambda"), greater(p_k, 0), at_most(p_k, 1))
    missed = 1 - p_k
    return Goal((less(p_k * (1 - contraction) + missed, 1), less(p_k * (contraction - 1) + missed, 1)), given,
                lemmas=(greater(p_k * contraction, 0), less(contraction, 2), greater(p_k * (2 - contraction), 0)))


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
    asked = "what keeps the error's sign" if quarter == 4 else "what theorem1.lambda asks"

    @paper.claim(f"theorem1.stated.{reading.suffix}{suffix}", f"The stated lambda and rho {what} {asked} ({reading.title})", "condition",
                 rf"\lambda {sign} \tfrac{{1}}{{{quarter}}}\rho^2b^2\ \Leftrightarrow\ \max_{{\hat\phi}}"
                 rf"\frac{{\rho b\hat\phi}}{{\lambda + \hat\phi^2}} {than}", "proved", origin="ours",
                 premises=("theorem1.lambda", "theorem1.lambda.sign"), at={**stated(rho, lamda), b: reading.gain}, note=note)
    def lambda_is_large_enough() -> Goal:
        limit = rho**2 * b**2 / quarter
        return Goal((greater(lamda, limit) if holds else at_most(lamda, limit),))


_lambda_condition(newton, 4, True, "b = T_s/M is the least that p can be; for the train with its memory no p is enough (A2.every).")
_lambda_condition(per_mass, 4, False, "With p = b = 0.1, the least possible: the error may change its sign from trial to trial; it still shrinks (next claim).")
_lambda_condition(per_mass, 16, True, "The paper prints no value of lambda_min; this is that of theorem1.lambda. |1 - g| < 1 for every positive estimate, at this one sample.")
_lambda_condition(per_mass_1s, 16, False, "At the estimate phi_hat = sqrt(lambda) the error of the first sample is multiplied by about -16 in every trial.")
