"""Section 3, Theorem 1 for the data model: what its equations force, what breaks it as printed, and its mended form.

The paper cites its proof; all steps here are ours.
"""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, differ, equal, greater, less

from ..laws import (
    Delta_u,
    e_next,
    e_prev,
    epsilon,
    estimate_step,
    eta,
    gamma,
    lamda,
    mu,
    phi,
    phi_first,
    phi_i,
    phi_prev,
    rho,
)
from ..notation import epsilon_bar, p, p_k
from ..paper import paper
from ..plant import u_prev
from .section_2c_algorithm import after_reset, fires, least_estimate, share_of_new, small_epsilon, updated
from .section_3a_random_lengths import missed, reached
from .section_3b_improved_laws import with_gamma

phi_c, phi_hat = sp.symbols("phi_c phi_hat_c", positive=True)  # by Assumption 4 and 13.mended, with a positive first estimate
phi_upper, M_1 = sp.symbols("Phi M_1", positive=True)
g = sp.Symbol("g", positive=True)
contraction = rho * phi_c * phi_hat / (lamda + phi_hat**2)
largest = sp.Symbol("s", positive=True)  # rho p/(2 sqrt lambda), below 2 where lambda > rho^2 p^2/16
lambda_is_large = (less(largest, 2), at_least(4 * lamda * largest**2, rho**2 * p**2))


@paper.claim("theorem1.estimate", "The estimate is a mean of the last one and phi_c", "identity",
             r"\hat\phi_c(k,i) = (1-\omega)\hat\phi_c(k,i-1) + \omega\phi_c(k,i-1),\ \omega = \frac{\gamma\eta\Delta u^2}{\mu + \Delta u^2} \in [0, 1]",
             "proved", premises=("5", "15"), origin="ours")
def estimate_is_mean() -> Goal:
    """(15) with (5)."""
    new = phi_prev + estimate_step(Delta_u, gamma * (phi * Delta_u - phi_prev * Delta_u))
    share = gamma * eta * Delta_u**2 / (mu + Delta_u**2)
    return Goal((equal(new, (1 - share) * phi_prev + share * phi), at_least(share, 0), at_most(share, 1)),
                (at_least(gamma, 0), at_most(gamma, 1), at_most(eta, 1)))


@paper.claim("theorem1.estimate.bounded", "The estimate is bounded", "implication",
             r"0 \le \hat\phi_c(k,i-1) \le \Phi,\ 0 \le \phi_c \le \Phi \Rightarrow 0 \le \hat\phi_c(k,i) \le \Phi,\quad "
             r"\Phi = \max(p, \hat\phi_c(k,1))", "proved", premises=("theorem1.estimate",), origin="ours")
def estimate_bounded() -> Goal:
    """A mean of two numbers lies between them; a reset to phi_hat(k,1) too."""
    mean = (1 - share_of_new) * phi_prev + share_of_new * phi
    return Goal((at_most(mean, phi_upper), at_least(mean, 0)), (
        at_least(share_of_new, 0), at_most(share_of_new, 1), at_most(phi_prev, phi_upper), at_least(phi_prev, 0),
        at_most(phi, phi_upper), at_least(phi, 0)))


@paper.claim("theorem1.step", "Error of the next trial", "identity",
             r"e(k+1,i) = \left(1 - \gamma(k+1,i-1)\frac{\rho\phi_c(k,i)\hat\phi_c(k,i)}{\lambda + |\hat\phi_c(k,i)|^2}\right)e(k+1,i-1)",
             "proved", premises=("6", "6.unchanged", "14"), origin="ours",
             note="By (6) and (14). At gamma = 0 it says e(k+1,i) = e(k+1,i-1), by 6.unchanged.")
def error_step() -> Goal:
    """(6) with (14), both subtracted from v_d(k+1)."""
    law, = paper.shown("14")
    after = e_prev - phi * (law.right.xreplace(with_gamma) - u_prev)
    return Goal((equal(after, (1 - gamma * rho * phi * phi_i / (lamda + phi_i**2)) * e_prev),))


@paper.claim("theorem1.lambda", "lambda_min = rho^2 p^2/16 makes the factor a contraction", "implication",
             r"\lambda > \lambda_{\min} = \tfrac{1}{16}\rho^2p^2 \Rightarrow 0 < \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} \le s < 2,\ "
             r"\text{so that } \left|1 - \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2}\right| < 1",
             "proved", premises=("lemma1",), origin="ours", reading="s = rho p/(2 sqrt lambda), which is below 2 just for such lambda; then 4 lambda s^2 = rho^2 p^2.",
             note="The paper only says that a lambda_min exists. No smaller one serves for every positive first estimate: at phi_c = p and phi_hat = sqrt(lambda) the quotient is s, and (13) puts a first estimate back where the input hardly changes. Where lambda > rho^2 p^2/4 the error "
                  "keeps its sign too: theorem1.lambda.sign.")
def lambda_min_exists() -> Goal:
    """The square (2 s phi_hat - rho phi_c)^2 does it."""
    return Goal((greater(contraction, 0), at_most(contraction, largest)), (at_most(phi_c, p), *lambda_is_large),
                lemmas=(at_least(4 * lamda * largest**2, rho**2 * phi_c**2), at_least(largest * (lamda + phi_hat**2), rho * phi_c * phi_hat)))


@paper.claim("theorem1.lambda.sign", "With lambda > rho^2 p^2/4 the error keeps its sign", "implication",
             r"\lambda > \tfrac14\rho^2p^2 \Rightarrow 0 < \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} < 1", "proved", premises=("lemma1",), origin="ours",
             note="Four times the least lambda; the theorem does not need it.")
def sign_is_kept() -> Goal:
    """The square (phi_hat - rho phi_c/2)^2 does it."""
    return Goal((greater(contraction, 0), less(contraction, 1)), (at_most(phi_c, p), greater(lamda, rho**2 * p**2 / 4)),
                lemmas=(greater(4 * lamda, rho**2 * phi_c**2), greater(lamda + phi_hat**2, rho * phi_c * phi_hat)))


lowest = rho * epsilon_bar * least_estimate / (lamda + phi_upper**2)


@paper.claim("theorem1.low", "The contraction is uniform", "implication",
             r"\phi_c > \bar\varepsilon,\ m = \min(\varepsilon, \hat\phi_c(k,1)) \le \hat\phi_c \le \Phi \Rightarrow \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} \ge "
             r"\frac{\rho\bar\varepsilon m}{\lambda + \Phi^2}", "proved", premises=("13.mended", "theorem1.estimate.bounded"), origin="ours")
def contraction_uniform() -> Goal:
    """Numerator and denominator one by one."""
    return Goal((at_least(contraction, lowest),), (greater(phi_c, epsilon_bar), at_least(phi_hat, least_estimate), at_most(phi_hat, phi_upper)),
                lemmas=(at_least(phi_c * phi_hat, epsilon_bar * least_estimate), at_least(phi_upper**2, phi_hat**2)))


e_learned = sp.Symbol("e_learned", real=True)


@paper.claim("theorem1.whole", "From (6), (14) and the assumptions to the contraction", "implication",
             r"\gamma = 1 \Rightarrow |e(k+1,i)| \le (1 - M_1)|e(k+1,i-1)|,\quad M_1 = \min\left(\frac{\rho\bar\varepsilon m}{\lambda + \Phi^2}, 2 - s, \tfrac12\right) > 0", "proved",
             premises=("theorem1.step", "theorem1.lambda", "theorem1.low"), origin="ours", reading="For e(k+1,i-1) >= 0, and with all signs turned for the opposite; M_1 is at most each of the three numbers.",
             note="Shown for e(k+1,i-1) >= 0; for the opposite all signs turn. Assumptions 2 and 4 enter as epsilon_bar < phi_c <= p.")
def contraction_whole() -> Goal:
    """theorem1.step at gamma = 1, with the bounds of its factor."""
    step, = paper.shown("theorem1.step")
    learned = step.right.xreplace({phi: phi_c, phi_i: phi_hat, gamma: sp.Integer(1)})
    (_, most), (least,) = paper.shown("theorem1.lambda"), paper.shown("theorem1.low")
    given = (at_least(e_prev, 0), most, least, at_most(M_1, lowest), less(largest, 2), at_most(M_1, 2 - largest), at_most(2 * M_1, 1))
    return Goal((at_least(learned, -(1 - M_1) * e_prev), at_most(learned, (1 - M_1) * e_prev), less(M_1, 1)), given,
                lemmas=(at_least(contraction, M_1), at_most(contraction, 2 - M_1)))


def named_contraction() -> tuple[Relation, ...]:
    """What theorem1.whole shows, with a letter for the error after a trial with data."""
    below, above, below_one = paper.shown("theorem1.whole")
    return above.subs({above.left: e_learned}), below.subs({below.left: e_learned}), below_one


e_one, e_two, e_start = sp.symbols("e_1 e_2 e_0", real=True)
m_i, m_prev = sp.symbols("m_i m_prev", nonnegative=True)  # E|e| of trials i and i-1
j, outcomes = sp.symbols("j n")
root_of_chance, error, shortfall = (sp.IndexedBase(name, real=True) for name in ("q_j", "e_j", "t_j"))


def mean_of(value: sp.Expr) -> sp.Expr:
    """The mean over the outcomes of the trials before, with the chances q_j^2."""
    return sp.Sum(root_of_chance[j] ** 2 * value, (j, 1, outcomes))


@paper.claim("theorem1.mean", "Expectation of the error of the next trial, lengths independent of the error", "implication",
             r"E|e(k+1,i)| \le (1 - p(k+1)M_1)\,E|e(k+1,i-1)|", "proved", premises=("theorem1.whole", "theorem1.step", "gamma.mean"), origin="ours",
             scope="every finite number of outcomes, which lengths with finitely many values make",
             note="Outcome j of the trials before has the chance q_j^2, an error of the size e_j and, where data arrive, one whose size is t_j^2 below the bound of theorem1.whole. "
                  "Uses that gamma(k+1,i-1) and e(k+1,i-1) are independent, which Assumption 3 does not say: A3.independent.")
def expected_step() -> Goal:
    """With data theorem1.whole, without data theorem1.step keeps the error."""
    bound = named_contraction()[0].right.xreplace({e_prev: error[j]})
    after = p_k * mean_of(bound - shortfall[j] ** 2) + (1 - p_k) * mean_of(error[j])
    return Goal((at_most(after, (1 - p_k * M_1) * mean_of(error[j])),), (at_least(p_k, 0),))


m_0, i_trial, delta = sp.symbols("m_0 i delta", positive=True)
power, power_of_g = sp.symbols("theta theta_g", nonnegative=True)  # (1 - p M_1)^(i-1) and (1 - g)^i
THEOREM = r"\exists \lambda_{\min} > 0:\ \lambda > \lambda_{\min} \Rightarrow \lim_{i \rightarrow \infty} E\{e(k, i)\} = 0"


left = sp.IndexedBase("x_j", real=True)


@paper.claim("A3.independent", "The lengths of different trials are independent of each other", "implication",
             r"E\{\gamma(k+1,i-1)\,e(k+1,i-1)\} = p(k+1)\,E\{e(k+1,i-1)\}", "gap", origin="implied", rests_on=("A3", "gamma.mean"), premises=("theorem1.step",),
             reading="The step from one expected error to the next, in which gamma(k+1,i-1) and the error that the trials before have left are taken as independent. Asked where all trials "
                     "have the same random length, T_i = T_0, as Assumption 3 allows: in trial 1 the error is (1 - g) e(k+1,0) with the probability p(k+1), and just then data arrive again, else it is e(k+1,0) > 0.",
             note="Assumption 3 gives the distribution of each T_i, not their dependence; the paper certainly means independent lengths: A3.independent.mended. In the numbers T_1 = T_0, the step is that to trial 2, and trial 0 has the error 1: the left side is p(1 - g) = 0.25, the right side p(p(1 - g) + 1 - p) = 0.375. Without independent lengths the theorem fails: theorem1.lengths.")
def lengths_are_independent() -> Goal:
    """Where trial 1 is as long as trial 0, data arrive just where they did."""
    learned = (1 - g) * e_start
    return Goal((equal(p_k * learned, p_k * (p_k * learned + (1 - p_k) * e_start)),), (greater(p_k, 0), less(p_k, 1), less(g, 1), greater(e_start, 0)))


@paper.claim("A3.independent.mended", "The length of a trial is independent of those of the trials before, from trial 0 on", "identity",
             r"P[T_{i-1} = T_{\min} + l\,|\,T_0, \dots, T_{i-2}] = p_l\ \forall l,\ \text{also given all else that is random} \Rightarrow E\{\gamma(k+1,i-1)\,e(k+1,i-1)\} = p(k+1)\,E\{e(k+1,i-1)\}", "proved",
             premises=("gamma.p",), origin="ours", mends="A3.independent", scope="every finite number of outcomes, which lengths with finitely many values make",
             reading="Outcome j of the trials before has the chance q_j^2 and leaves the error x_j; trial i-1 then reaches k + 1, and gamma is 1, with the chance p(k+1), whatever j is; else gamma is 0.",
             note="Trial 0 belongs to them: (14) uses gamma(k+1,0) e(k+1,0) in trial 1. All else is the first input, the first estimate, the starts and phi_c: where they are random the lengths must be independent of them too; outcome j says what they are. That j occurs and data arrive has then the chance p(k+1) q_j^2, and nothing else is used.")
def product_of_means() -> Goal:
    """The mean of gamma e over outcomes and data."""
    with_data, without_data = (mean_of(value * left[j]) for value in (reached, missed))
    return Goal((equal(p_k * with_data + (1 - p_k) * without_data, p_k * mean_of(left[j])),), (equal(reached, 1), equal(missed, 0)))


@paper.claim("theorem1", "Theorem 1: under Assumptions 1 to 4 the expected error converges to zero", "limit", THEOREM, "gap",
             premises=("theorem1.step", "13", "14"), rests_on=("6", "6.unchanged", "13.keeps", "14", "15", "gamma.positive", "gamma.mean", "A3.independent"),
             severity="result",
             reading="A motion of (6), (13)-(15) that is the same in every trial has no error; k <= T_min, so that no trial ends before (gamma = 1). The assumptions are those of the theorem; epsilon is that of Table 1.",
             note="Two conditions are missing, each of a usual kind. phi_hat(k,1) > 0: take v(k+1) = u(k), which meets Assumptions 1, 2 and 4, and phi_hat(k,1) = 0, of which the paper asks nothing; (14) does not move "
                  "the input, (13) puts 0 back in every trial, and the error stays as it is, for every lambda (theorem1.frozen). With a first estimate of the wrong sign the error grows in every trial (theorem1.sign). "
                  "And independent lengths: theorem1.lengths. With both, and with Assumption 2 read of any two runs of the system, the theorem holds: theorem1.mended; that reading is needed where data are missing, since (14) then keeps the input and Lemma 1 leaves out Delta u_f(k,i) = 0. The paper prints no proof, it "
                  "refers to [22]; the steps here are those that its equations force. What v and e are for k > T_i, where trial i has ended, it does not say either: they are taken as what (6) makes of them. "
                  "That the train is no system of which the theorem speaks is another matter, see remark2.inherent and A4.train.")
def constant_error() -> Goal:
    """The printed loop in two trials that are equal: (14), and (13) with Delta u = 0, whose second test fires."""
    law, = paper.shown("14")
    step, = paper.shown("theorem1.step")
    in_use = {e_next: e_prev, phi_i: after_reset, gamma: sp.Integer(1)}
    moved = law.right.xreplace(in_use)
    same_in_every_trial = (equal(moved, u_prev), equal(step.right.xreplace(in_use), e_prev))
    reset = (at_most((moved - u_prev) ** 2, epsilon**2), equal(fires, 1), equal(after_reset, fires * phi_first + (1 - fires) * updated))
    assumptions = (greater(phi, epsilon_bar), at_most(phi, p), greater(lamda, rho**2 * p**2 / 4), at_most(rho, 1), small_epsilon, equal(epsilon_bar, sp.Rational(1, 1000)), equal(phi, 1))
    return Goal((equal(e_prev, 0),), (*same_in_every_trial, *reset, *assumptions))


@paper.claim("theorem1.frozen", "With a first estimate of zero input and error never change, whatever lambda", "implication",
             r"\hat\phi_c(k,1) = 0 \Rightarrow u_f(k,i) = u_f(k,i-1),\ e(k+1,i) = e(k+1,i-1)\ \forall\lambda > 0", "proved", premises=("theorem1.step", "13", "14"), origin="ours",
             note="For every rho, phi_c and error. The input change is 0, so that the second test of (13) fires and puts 0 back.")
def frozen_input() -> Goal:
    """(14) and theorem1.step with the estimate after a reset."""
    (law,), (step,), (reset,) = (paper.shown(name) for name in ("14", "theorem1.step", "13"))
    return Goal((equal(law.right.xreplace({phi_i: reset.left}), u_prev), equal(step.right.xreplace({phi_i: reset.left}), e_prev)), (reset, equal(phi_first, 0)))


@paper.claim("theorem1.sign", "A first estimate of the wrong sign makes the error grow in every trial", "implication",
             r"\hat\phi_c(k,1) < 0 \Rightarrow |e(k+1,i)| \ge |e(k+1,i-1)|,\ \text{and} > \text{where data arrive}", "proved", premises=("theorem1.step", "13"), origin="ours",
             note="By (13) every estimate in use has the sign of the first one. Decided in squares, for gamma = 1 and any lambda, rho and phi_c > 0.")
def wrong_sign() -> Goal:
    """theorem1.step with a negative estimate."""
    step, = paper.shown("theorem1.step")
    factor = 1 - rho * phi_c * phi_i / (lamda + phi_i**2)
    return Goal((greater(step.right.xreplace({phi: phi_c, gamma: sp.Integer(1)}) ** 2, e_prev**2),), (greater(phi_i * phi_first, 0), less(phi_first, 0), less(phi_i, 0), differ(e_prev, 0)),
                lemmas=(greater(factor, 1), greater(factor**2, 1)))


@paper.claim("theorem1.lengths", "With one and the same random length in all trials the expected error does not vanish", "limit",
             r"T_i = T_0\ \forall i \Rightarrow \lim_{i\to\infty}E\{e(k,i)\} = 0", "gap", premises=("theorem1.step",), origin="ours",
             note="Assumption 3 gives the distribution of each T_i, not their dependence. If all trials have one and the same random length, k "
                  "is reached in all of them or in none, and E{e(k,i)}/e_0 = (1-p) + p (1-g)^i does not go to zero.")
def same_length_always() -> Goal:
    """E{e}/e_0 when T_i = T_0 for all i, from the trial on at which (1-g)^i <= delta."""
    mean = (1 - p_k) + p_k * power_of_g
    return Goal((at_most(mean, 2 * delta),), (greater(p_k, 0), less(p_k, 1), at_most(power_of_g, delta)))


@paper.claim("theorem1.mended", "Theorem 1 where phi_hat(k,1) > 0, the lengths T_0, T_1, ... are independent of each other and of all else, and Assumption 2 holds for any two runs", "limit",
             r"\text{Assumptions 1 and 4},\ \text{Assumption 2 for any two runs},\ \rho, \eta \in (0, 1],\ \mu > 0,\ \lambda > \tfrac{1}{16}\rho^2p^2,\ \hat\phi_c(k,1) > 0,\ u_f(k,0), \hat\phi_c(k,1)\ \text{not random},\ "
             r"T_0, T_1, \ldots\ \text{independent of each other and of all else that is random, each as in Assumption 3},\ 0 < p(k) \le 1 \Rightarrow E|e(k,i)| \le (1 - p(k)M_1)^i\,E|e(k,0)| \to 0,\ k \ge 1,\ "
             r"M_1 = \min\left(\frac{\rho\bar\varepsilon m}{\lambda + \Phi^2}, 2 - s, \tfrac12\right),\ m = \min(\varepsilon, \hat\phi_c(k,1)),\ \Phi = \max(p, \hat\phi_c(k,1)),\ s = \frac{\rho p}{2\sqrt\lambda}", "proved",
             premises=("theorem1.mean", "theorem1.whole", "gamma.positive", "13.mended", "theorem1.estimate.bounded", "A3.independent.mended"),
             rests_on=(), origin="ours", severity="result", mends="theorem1",
             reading="m_i is E|e(k,i)|, which is at least |E e(k,i)|, and theta is (1 - p M_1)^(i-1). Decided as the step of m_i <= (1 - p M_1)^i m_0 and of (1 - p M_1)^i <= 1/(1 + p M_1 i), with the trial from which on m is below delta.",
             note="What the paper does not ask is phi_hat(k,1) > 0 and independent lengths, from trial 0 on, which (14) uses in trial 1; 0 < p(k) it lays down where it defines gamma. The first input and the first estimate are numbers, as in the paper: with random ones E|e(k,0)| need not be finite and m, Phi and M_1 are no numbers. k >= 1, since no input reaches e(0,i). The lambda that serves depends on the bound p of Assumption 2, which has to be known to choose it. The systems are those in which v(k+1) depends on "
                  "u(k) alone, by Assumption 2 for any two runs of the system, whatever their starts and inputs (6.unchanged); the train is none, see theorem1.train. E{e} alone could be zero while e is not, see intro.error; E|e| goes to zero like a geometric series, "
                  "so that e itself does with probability one, by Markov's inequality and the lemma of Borel and Cantelli. The conditions with m_i and theta are the step from trial i-1 to trial i.")
def expectation_converges() -> Goal:
    """Both bounds carry over to the next trial, and the second one is below delta/m_0 for i >= m_0/(p M_1 delta)."""
    rate, before = p_k * M_1, i_trial - 1
    below_one = named_contraction()[-1]
    mean, = paper.shown("theorem1.mean")
    given = (mean.subs({mean.left: m_i, mean_of(error[j]): m_prev}), *paper.shown("gamma.positive"), below_one, at_least(i_trial, 1),
             at_most(m_prev, power * m_0), at_most(power * (1 + rate * before), 1), at_least(i_trial, m_0 / (rate * delta)))
    return Goal((at_most(m_i, (1 - rate) * power * m_0), at_most((1 - rate) * power * (1 + rate * i_trial), 1), at_most(m_i, delta)), given,
                lemmas=(less(rate, 1), at_most((1 - rate) * m_prev, (1 - rate) * power * m_0), at_most(m_i, (1 - rate) * power * m_0),
                        at_most((1 - rate) * (1 + rate * i_trial), 1 + rate * before), at_most((1 - rate) * power * (1 + rate * i_trial), power * (1 + rate * before)),
                        at_least(rate * i_trial * delta, m_0), at_most((1 - rate) * power * rate * i_trial, 1), at_most((1 - rate) * power * m_0, delta)))
