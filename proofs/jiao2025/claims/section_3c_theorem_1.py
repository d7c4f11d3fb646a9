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
from .section_2c_algorithm import share_of_new
from .section_3b_improved_laws import with_gamma

phi_c, phi_hat = sp.symbols("phi_c phi_hat_c", positive=True)  # by Assumption 4 and 13.mended, with a positive first estimate
phi_upper, M_1 = sp.symbols("Phi M_1", positive=True)
g = sp.Symbol("g", positive=True)
contraction = rho * phi_c * phi_hat / (lamda + phi_hat**2)
contraction_lemmas = (greater(4 * lamda, rho**2 * phi_c**2), greater(lamda + phi_hat**2, rho * phi_c * phi_hat))


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


@paper.claim("theorem1.lambda", "lambda_min = rho^2 p^2/4 makes the factor a contraction", "implication",
             r"\lambda > \lambda_{\min} = \tfrac14\rho^2p^2 \Rightarrow 0 < \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} < 1",
             "proved", premises=("lemma1",), origin="ours",
             note="The paper only says that a lambda_min exists. This one keeps the sign of the error; |1 - .| < 1 alone needs a quarter of it.")
def lambda_min_exists() -> Goal:
    """The square (phi_hat - rho phi_c/2)^2 does it."""
    return Goal((greater(contraction, 0), less(contraction, 1)),
                (at_most(phi_c, p), greater(lamda, rho**2 * p**2 / 4)),
                lemmas=contraction_lemmas)


lowest = rho * epsilon_bar * epsilon / (lamda + phi_upper**2)
uniform_lemmas = (at_least(phi_c * phi_hat, epsilon_bar * epsilon), at_least(phi_upper**2, phi_hat**2))


@paper.claim("theorem1.low", "The contraction is uniform", "implication",
             r"\phi_c > \bar\varepsilon,\ \varepsilon < \hat\phi_c \le \Phi \Rightarrow \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} \ge "
             r"\frac{\rho\bar\varepsilon\varepsilon}{\lambda + \Phi^2}", "proved", premises=("13.mended", "theorem1.estimate.bounded"), origin="ours")
def contraction_uniform() -> Goal:
    """Numerator and denominator one by one."""
    return Goal((at_least(contraction, lowest),), (greater(phi_c, epsilon_bar), greater(phi_hat, epsilon), at_most(phi_hat, phi_upper)),
                lemmas=uniform_lemmas)


e_learned = sp.Symbol("e_learned", real=True)


@paper.claim("theorem1.whole", "From (6), (14) and the assumptions to the contraction, in one certificate", "implication",
             r"\gamma = 1,\ e(k+1,i-1) \ge 0 \Rightarrow 0 \le e(k+1,i) \le (1 - M_1)e(k+1,i-1),\quad 0 < M_1 = "
             r"\frac{\rho\bar\varepsilon\varepsilon}{\lambda + \Phi^2} < 1", "proved",
             premises=("theorem1.step", "lemma1", "13.mended", "theorem1.estimate.bounded"), origin="ours",
             note="The same with all signs turned for e(k+1,i-1) < 0. Assumptions 2 and 4 enter as epsilon_bar < phi_c <= p. Theorem 1's algebra is sound.")
def contraction_whole() -> Goal:
    """theorem1.step at gamma = 1; M_1 written out."""
    step, = paper.shown("theorem1.step")
    positive = {phi: phi_c, phi_i: phi_hat}
    learned = step.right.xreplace({**positive, gamma: sp.Integer(1)})
    given = (at_least(e_prev, 0), at_most(phi_c, p), greater(lamda, rho**2 * p**2 / 4), greater(phi_c, epsilon_bar),
             greater(phi_hat, epsilon), at_most(phi_hat, phi_upper))
    return Goal((at_least(learned, 0), at_most(learned, (1 - lowest) * e_prev), less(lowest, 1)), given,
                lemmas=(*contraction_lemmas, *uniform_lemmas, less(contraction, 1), at_least(contraction, lowest)))


def named_contraction() -> tuple[Relation, ...]:
    """What theorem1.whole shows, with letters for M_1 and for the error after a trial with data."""
    above, below, below_one = paper.shown("theorem1.whole")
    names = {above.left: e_learned, 1 - lowest: 1 - M_1, lowest: M_1}
    return above.subs(names), below.subs(names), below_one.subs(names)


e_one, e_two = sp.symbols("e_1 e_2", real=True)
m_i, m_prev = sp.symbols("m_i m_prev", nonnegative=True)  # E|e| of trials i and i-1
j, outcomes = sp.symbols("j n")
root_of_chance, error, shortfall = (sp.IndexedBase(name, real=True) for name in ("r", "e_j", "t"))


def mean_of(value: sp.Expr) -> sp.Expr:
    """The mean over the outcomes of the trials before, with the chances r_j^2."""
    return sp.Sum(root_of_chance[j] ** 2 * value, (j, 1, outcomes))


@paper.claim("theorem1.mean", "Expectation of the error of the next trial, lengths independent of the error", "implication",
             r"E|e(k+1,i)| \le (1 - p(k+1)M_1)\,E|e(k+1,i-1)|", "proved", premises=("theorem1.whole", "theorem1.step", "gamma.mean"), origin="ours",
             scope="every finite number of outcomes, which lengths with finitely many values make",
             note="Outcome j of the trials before has the chance r_j^2, the error e_j and, where data arrive, an error that is t_j^2 below the bound of theorem1.whole. "
                  "Uses that gamma(k+1,i-1) and e(k+1,i-1) are independent, which Assumption 3 does not say: theorem1.lengths.")
def expected_step() -> Goal:
    """With data theorem1.whole, without data theorem1.step keeps the error."""
    bound = named_contraction()[1].right.xreplace({e_prev: error[j]})
    after = p_k * mean_of(bound - shortfall[j] ** 2) + (1 - p_k) * mean_of(error[j])
    return Goal((at_most(after, (1 - p_k * M_1) * mean_of(error[j])),), (at_least(p_k, 0),))


m_0, i_trial, delta = sp.symbols("m_0 i delta", positive=True)
geometric_term = sp.Symbol("theta", nonnegative=True)
THEOREM = r"\exists \lambda_{\min} > 0:\ \lambda > \lambda_{\min} \Rightarrow \lim_{i \rightarrow \infty} E\{e(k, i)\} = 0"


@paper.claim("theorem1", "Theorem 1: under Assumptions 1 to 4 the expected error converges to zero", "limit", THEOREM, "refuted",
             premises=("theorem1.step", "13", "14"), rests_on=("A1", "A2", "A3", "A4", "6", "6.unchanged", "13.keeps", "14", "15", "gamma.positive", "gamma.mean"),
             severity="result", closed_loop=True,
             reading="A motion of (6), (13)-(15) that is the same in every trial has no error; k <= T_min, so that no trial ends before (gamma = 1).",
             note="The paper asks nothing of the first estimate. With phi_hat(k,1) = 0 the reset (13) puts 0 back in every trial, and the error stays as it is. With one of the wrong sign "
                  "(13) keeps the sign wrong, and the error grows in every trial (theorem1.sign). Two more conditions are missing: the lengths of different trials are independent "
                  "(theorem1.lengths) and the longest one occurs (gamma.positive). With a first estimate above epsilon and both of them the theorem holds for the data model: theorem1.mended. "
                  "What it says of the train is another matter: conclusion.")
def constant_error() -> Goal:
    """The printed loop in two trials that are equal: (14), and (13) with Delta u = 0, whose second test fires."""
    law, = paper.shown("14")
    step, = paper.shown("theorem1.step")
    in_use = {e_next: e_prev, phi_i: phi_first, gamma: sp.Integer(1)}
    same_in_every_trial = (equal(law.right.xreplace(in_use), u_prev), equal(step.right.xreplace(in_use), e_prev))
    assumptions = (greater(phi, epsilon_bar), at_most(phi, p), greater(lamda, rho**2 * p**2 / 4), at_most(rho, 1))
    return Goal((equal(e_prev, 0),), (*same_in_every_trial, *assumptions))


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
             r"T_i = T_1\ \forall i \Rightarrow \lim_{i\to\infty}E\{e(k,i)\} = 0", "gap", premises=("theorem1.step",), origin="ours",
             note="Assumption 3 gives the distribution of each T_i, not their dependence. If all trials have one and the same random length, k "
                  "is reached in all of them or in none, and E{e(k,i)}/e_0 = (1-p) + p (1-g)^i does not go to zero (theta is (1-g)^i). The paper certainly means independent lengths.")
def same_length_always() -> Goal:
    """E{e}/e_0 when T_i = T_1 for all i, from the trial on at which (1-g)^i <= delta."""
    mean = (1 - p_k) + p_k * geometric_term
    return Goal((at_most(mean, 2 * delta),), (greater(p_k, 0), less(p_k, 1), at_most(geometric_term, delta)))


@paper.claim("theorem1.mended", "Theorem 1 with its missing conditions, for the data model", "limit",
             r"\lambda > \tfrac14\rho^2p^2,\ \hat\phi_c(k,1) > \varepsilon,\ T_1, T_2, \ldots\ \text{independent},\ p_{T_d - T_{\min}} > 0 \Rightarrow "
             r"\lim_{i\to\infty}E|e(k,i)| = 0,\ k \ge 1", "proved", premises=("theorem1.mean", "theorem1.whole", "gamma.positive.mended", "13.mended", "theorem1.estimate.bounded"),
             rests_on=(), origin="ours", severity="result", mends="theorem1",
             note="m is E|e|, which is at least |E e|. Decided as the step of m_i <= m_0/(1 + p M_1 i), with the trial named from which on m is below delta. The assumptions on lambda, the first "
                  "estimate, phi_c and the distribution are those under which the premises are proved.")
def expectation_converges() -> Goal:
    """The bound m_0/(1 + p M_1 i) carries over to i+1, and is below delta for i >= m_0/(p M_1 delta)."""
    rate = p_k * M_1
    below_one = named_contraction()[-1]
    mean, = paper.shown("theorem1.mean")
    given = (mean.subs({mean.left: m_i, mean_of(error[j]): m_prev}), *paper.shown("gamma.positive.mended"), below_one,
             at_most(m_prev, m_0 / (1 + rate * i_trial)), at_least(i_trial, m_0 / (rate * delta)))
    return Goal((at_most(m_i, m_0 / (1 + rate * (i_trial + 1))), at_most(m_prev, delta)), given,
                lemmas=(less(rate, 1), at_most((1 + rate * i_trial) * m_prev, m_0), at_least(rate * i_trial * delta, m_0)))
