"""Section 3, Theorem 1 and Remark 5: for the data model, for the train, and at the stated parameters."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Verdict, at_least, at_most, differ, equal, greater, less

from ..laws import Delta_u, e_prev, epsilon, estimate_step, eta, gamma, input_step, lamda, mu, phi, phi_prev, rho
from ..paper import paper
from ..plant import next_speed, u_i, v_i
from ..stated_values import EVERY_LENGTH, STATED, TRIALS, Reading, newton, per_mass, per_mass_1s, stated
from .section_2a_train import a, b, f_a_i, f_a_prev, p
from .section_2b_algorithm import weight
from .section_3a_random_lengths import p_k

phi_c, phi_hat = sp.symbols("phi_c phi_hat_c", positive=True)  # by Assumption 4 and (13), with a positive first estimate
phi_lower, phi_upper = sp.symbols("epsilon_bar Phi", positive=True)
g = sp.Symbol("g", positive=True)
contraction = rho * phi_c * phi_hat / (lamda + phi_hat**2)
contraction_lemmas = (greater(4 * lamda, rho**2 * phi_c**2), greater(lamda + phi_hat**2, rho * phi_c * phi_hat))


@paper.claim("theorem1.estimate", "The estimate is a mean of the last one and phi_c", "identity",
             r"\hat\phi_c(k,i) = (1-\omega)\hat\phi_c(k,i-1) + \omega\phi_c(k,i-1),\ \omega = \frac{\gamma\eta\Delta u^2}{\mu + \Delta u^2} \in [0, 1]",
             "proved", premises=("5", "15.innovation"))
def estimate_is_mean() -> Goal:
    """(15) with (5)."""
    new = phi_prev + estimate_step(Delta_u, gamma * (phi * Delta_u - phi_prev * Delta_u))
    share = gamma * eta * Delta_u**2 / (mu + Delta_u**2)
    return Goal((equal(new, (1 - share) * phi_prev + share * phi), at_least(share, 0), at_most(share, 1)),
                (at_least(gamma, 0), at_most(gamma, 1), at_most(eta, 1)))


@paper.claim("theorem1.estimate.bounded", "The estimate is bounded", "implication",
             r"0 \le \hat\phi_c(k,i-1) \le \Phi,\ 0 \le \phi_c \le \Phi \Rightarrow 0 \le \hat\phi_c(k,i) \le \Phi,\quad "
             r"\Phi = \max(p, \hat\phi_c(k,1))", "proved", premises=("theorem1.estimate", "lemma1", "A4", "13"))
def estimate_bounded() -> Goal:
    """A mean of two numbers lies between them; a reset to phi_hat(k,1) too."""
    mean = (1 - weight) * phi_prev + weight * phi
    return Goal((at_most(mean, phi_upper), at_least(mean, 0)), (
        at_least(weight, 0), at_most(weight, 1), at_most(phi_prev, phi_upper), at_least(phi_prev, 0),
        at_most(phi, phi_upper), at_least(phi, 0)))


@paper.claim("theorem1.step", "Error of the next trial", "identity",
             r"e(k+1,i) = \left(1 - \gamma(k+1,i-1)\frac{\rho\phi_c(k,i)\hat\phi_c(k,i)}{\lambda + |\hat\phi_c(k,i)|^2}\right)e(k+1,i-1)",
             "proved", premises=("6", "6.unchanged", "14"),
             note="By (6). At gamma = 0 it says e(k+1,i) = e(k+1,i-1), where Lemma 1 is silent and the train differs: 6.unchanged.")
def error_step() -> Goal:
    """e - phi_c Delta u with (14)."""
    return Goal((equal(e_prev - phi_c * input_step(phi_hat, gamma * e_prev), (1 - gamma * contraction) * e_prev),))


@paper.claim("theorem1.lambda", "lambda_min = rho^2 p^2/4 makes the factor a contraction", "implication",
             r"\lambda > \lambda_{\min} = \tfrac14\rho^2p^2 \Rightarrow 0 < \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} < 1",
             "proved", premises=("lemma1", "A4", "13"),
             note="The paper only says that a lambda_min exists. This one keeps the sign of the error; |1 - .| < 1 alone needs a quarter of it.")
def lambda_min_exists() -> Goal:
    """The square (phi_hat - rho phi_c/2)^2 does it."""
    return Goal((greater(contraction, 0), less(contraction, 1)),
                (at_most(phi_c, p), greater(lamda, rho**2 * p**2 / 4)),
                lemmas=contraction_lemmas)


lowest = rho * phi_lower * epsilon / (lamda + phi_upper**2)
uniform_lemmas = (at_least(phi_c * phi_hat, phi_lower * epsilon), at_least(phi_upper**2, phi_hat**2))


@paper.claim("theorem1.low", "The contraction is uniform", "implication",
             r"\phi_c > \bar\varepsilon,\ \varepsilon < \hat\phi_c \le \Phi \Rightarrow \frac{\rho\phi_c\hat\phi_c}{\lambda + \hat\phi_c^2} \ge "
             r"\frac{\rho\bar\varepsilon\varepsilon}{\lambda + \Phi^2}", "proved", premises=("A4", "13", "theorem1.estimate.bounded"))
def contraction_uniform() -> Goal:
    """Numerator and denominator one by one."""
    return Goal((at_least(contraction, lowest),), (greater(phi_c, phi_lower), greater(phi_hat, epsilon), at_most(phi_hat, phi_upper)),
                lemmas=uniform_lemmas)


@paper.claim("theorem1.whole", "From (6), (14) and the assumptions to the contraction, in one certificate", "implication",
             r"e(k+1,i-1) \ge 0 \Rightarrow 0 \le e(k+1,i) \le (1 - \gamma M_1)e(k+1,i-1),\quad M_1 = "
             r"\frac{\rho\bar\varepsilon\varepsilon}{\lambda + \Phi^2}", "proved",
             premises=("6", "6.unchanged", "14", "lemma1", "A4", "13", "theorem1.estimate.bounded"),
             note="The same with all signs turned for e(k+1,i-1) < 0. Theorem 1's algebra is sound; what fails is what it is told of the train.")
def contraction_whole() -> Goal:
    """(6) with (14) at gamma = 1 and at gamma = 0."""
    after = e_prev - phi_c * input_step(phi_hat, gamma * e_prev)
    learned, kept = (after.xreplace({gamma: sp.Integer(value)}) for value in (1, 0))
    given = (at_least(e_prev, 0), at_most(phi_c, p), greater(lamda, rho**2 * p**2 / 4), greater(phi_c, phi_lower),
             greater(phi_hat, epsilon), at_most(phi_hat, phi_upper))
    return Goal((at_least(learned, 0), at_most(learned, (1 - lowest) * e_prev), equal(kept, e_prev)), given,
                lemmas=(*contraction_lemmas, *uniform_lemmas))


q_1 = sp.Symbol("q_1", real=True)
e_one, e_two = sp.symbols("e_1 e_2", real=True)


@paper.claim("theorem1.mean", "Expectation of the error of the next trial, lengths independent of the error", "identity",
             r"E\{e(k+1,i)\} = (1 - p(k+1)\,g)\,E\{e(k+1,i-1)\}", "proved", premises=("theorem1.step", "gamma.mean"),
             scope="a fixed g, an error with two values; both sides are linear in its distribution",
             note="Uses that gamma(k+1,i-1) and e(k+1,i-1) are independent, which Assumption 3 does not say: theorem1.")
def expected_step() -> Goal:
    """Sum over the four cases of (gamma, e), probabilities multiplied."""
    cases = [(chance * share, factor * error) for chance, factor in ((p_k, 1 - g), (1 - p_k, sp.Integer(1)))
             for share, error in ((q_1, e_one), (1 - q_1, e_two))]
    mean = q_1 * e_one + (1 - q_1) * e_two
    return Goal((equal(sp.Add(*(c * x for c, x in cases)), (1 - p_k * g) * mean),))


x_rate, m_0, m_now, i_trial, delta = sp.symbols("x m_0 m_now i delta", positive=True)


@paper.claim("theorem1.limit", "The expectation converges to zero", "limit",
             r"m_i \le (1-x)\,m_{i-1},\ 0 < x < 1 \Rightarrow \lim_{i\to\infty} m_i = 0", "proved",
             premises=("theorem1.whole", "theorem1.mean", "gamma.positive"),
             note="m is E|e|, x = p(k+1) M_1. Decided as the step of m_i <= m_0/(1 + x i), with the trial named from which on m is below delta.")
def expectation_converges() -> Goal:
    """The bound m_0/(1 + x i) carries over to i+1, and is below delta for i >= m_0/(x delta)."""
    given = (less(x_rate, 1), at_most(m_now, m_0 / (1 + x_rate * i_trial)), at_least(i_trial, m_0 / (x_rate * delta)))
    return Goal((at_most((1 - x_rate) * m_now, m_0 / (1 + x_rate * (i_trial + 1))), at_most(m_now, delta)), given,
                lemmas=(at_most((1 + x_rate * i_trial) * m_now, m_0), at_least(x_rate * i_trial * delta, m_0)))


geometric_term = sp.Symbol("theta", nonnegative=True)


@paper.claim("theorem1", "Theorem 1: under Assumptions 1 to 4 the expected error converges to zero", "limit",
             r"\exists\lambda_{\min} > 0:\ \lambda > \lambda_{\min} \Rightarrow \lim_{i\to\infty}E\{e(k,i)\} = 0", "gap",
             premises=("theorem1.limit", "theorem1.lambda"),
             correction=expectation_converges,
             corrected_statement=r"E|e(k,i)| \le (1 - p(k)M_1)E|e(k,i-1)|\ (T_1, T_2, \ldots\ \text{independent},\ p(k) > 0,\ k \ge 1,\ "
                                 r"\lambda > \tfrac14\rho^2p^2) \Rightarrow \lim_{i\to\infty}E|e(k,i)| = 0",
             note="Assumption 3 gives the distribution of each T_i, not their dependence. If all trials have one and the same random length, k "
                  "is reached in all of them or in none, and E{e(k,i)}/e_0 = (1-p) + p (1-g)^i does not go to zero (theta is (1-g)^i). With "
                  "independent lengths, which the paper certainly means, and p(k) > 0 the theorem holds for the data model (5), (6). What it says of the "
                  "train is another matter: the train breaks Assumptions 2 and 4.")
def same_length_always() -> Goal:
    """E{e}/e_0 when T_i = T_1 for all i, from the trial on at which (1-g)^i <= delta."""
    mean = (1 - p_k) + p_k * geometric_term
    return Goal((at_most(mean, 2 * delta),), (greater(p_k, 0), less(p_k, 1), at_most(geometric_term, delta)))


@paper.claim("theorem1.train.lambda", "For the train no lambda_min makes (14) contract at every sample", "inequality",
             r"\forall\lambda, \rho, \hat\phi_c\ \exists\,\Delta v(k,i):\ |e(k+1,i)| = 2|e(k+1,i-1)|", "proved",
             premises=("5", "14"),
             note="phi_c = T_s/M + a Delta v(k)/Delta u(k) takes every value, and with it the factor of theorem1.step every value, here -2: the "
                  "error at k + 1 doubles because of what earlier inputs did. That the theorem's conclusion can still hold in the limit is theorem1.train.")
def error_doubles() -> Goal:
    """The speed difference that makes e(k+1,i) = -2 e(k+1,i-1), for any nonzero error."""
    step = input_step(phi_hat, e_prev)
    needed = (3 * e_prev - b * step) / a
    after = e_prev - (a * needed + b * step)
    return Goal((equal(after, -2 * e_prev),), (greater(a, 0), differ(e_prev, 0)))


r_rate, c_rate, Z, C = sp.symbols("r c Z C", positive=True)
m_prev, z_now = sp.symbols("m_prev z", nonnegative=True)


@paper.claim("theorem1.train", "The train's expected errors converge, sample after sample, for a fixed gain", "implication",
             r"E|e(k+1,i)| \le c\,E|e(k+1,i-1)| + E|\Delta v(k,i)|,\ E|\Delta v(k,i)| \le Zr^i \Rightarrow E|e(k+1,i)| \le Cr^i,\ "
             r"E|\Delta v(k+1,i)| \le 2Cr^{i-1}", "proved", premises=("5.trials", "gamma.mean"), scope=EVERY_LENGTH,
             note="Not the paper's argument, and what is left of Theorem 1 for the train: for a fixed estimate with |1 - g| < 1, 0 <= a <= 1, independent lengths, the same start "
                  "and f_a in every trial, c = 1 - p(k+1) min(g, 2-g) < r < 1, induction over k with C >= m_0 and C >= Z r/(r - c). So the limit exists, but C grows from "
                  "sample to sample: see intro.growth. theta is r^(i-1).")
def train_converges() -> Goal:
    """One trial on, in powers of r; then the difference that the next sample is disturbed by."""
    power = geometric_term
    given = (less(c_rate, r_rate), less(r_rate, 1), at_most(m_prev, C * power), at_most(z_now, Z * r_rate * power),
             at_least(C * (r_rate - c_rate), Z * r_rate), at_most(m_now, c_rate * m_prev + z_now))
    return Goal((at_most(m_now, C * r_rate * power), at_most(m_now + m_prev, 2 * C * power)), given,
                lemmas=(at_most(c_rate * m_prev, c_rate * C * power), at_least(C * (r_rate - c_rate) * power, Z * r_rate * power),
                        at_most(m_now, C * r_rate * power), at_most(C * r_rate * power, C * power)))


c_shift, start_error = sp.symbols("v_0 E", real=True)
alternating = 2 * a * c_shift / (2 - g)


@paper.claim("remark5.persists", "The error when the initial speed alternates", "identity",
             r"v(0,i) = (-1)^iv_0:\quad e(1,i) = (-1)^{i+1}\frac{2av_0}{2-g}\ \text{solves}\ e(1,i) = (1-g)e(1,i-1) - a\Delta v(0,i)",
             "proved", premises=("5.trials", "14"), note="Not printed. For the train, g = b rho phi_hat/(lambda + phi_hat^2) < 2.")
def alternating_start() -> Goal:
    """An even trial after an odd one; odd after even is the same with the sign of v_0 turned."""
    return Goal((equal(-alternating, (1 - g) * alternating - a * 2 * c_shift),), (less(g, 2),))


@paper.claim("remark5", "Remark 5: identical initial conditions are not needed", "limit",
             r"v(0,i)\ \text{arbitrary} \Rightarrow \lim_{i\to\infty}e(1,i) = 0", "gap", premises=("remark5.persists",),
             note="With initial speeds that alternate the train's error keeps the size E of remark5.persists for ever. The proof does not see it because "
                  "(5) takes all of Delta v(1,i) for an effect of Delta u(0,i).")
def start_does_not_matter() -> Goal:
    """The size of the error under alternating initial speeds is zero."""
    return Goal((equal(start_error, 0),), (greater(a, 0), less(a, 1), less(g, 2), equal(start_error, alternating)))


@paper.claim("figure4", "An error of zero stays zero although f_a changes from trial to trial (Figure 4)", "implication",
             r"e(k+1,i-1) = 0,\ \Delta u_f(k,i) = 0,\ \Delta v(k,i) = 0 \Rightarrow e(k+1,i) = 0", "gap", premises=("1", "14"),
             note="Not printed, but the simulation lets f_a change from trial to trial. Then e(k+1,i) = (T_s/M) Delta f_a with nothing learned or to learn: "
                  "neither (5) nor Theorem 1 has room for a disturbance that does not repeat.")
def changing_resistance() -> Goal:
    """(1) in two trials with the same speed and input."""
    change = next_speed(v_i, u_i, f_a_i) - next_speed(v_i, u_i, f_a_prev)
    return Goal((equal(e_prev - change, 0),), (equal(e_prev, 0),))


last_chance = {rho: STATED[rho], p_k: Fraction(1, 100)}


@paper.claim("remark5.end", "Expected error at the last sample after 150 trials", "condition",
             r"\frac{E\{e(T_d,150)\}}{E\{e(T_d,0)\}} = (1 - \rho\,p(T_d))^{150} \ge 1 - 150\rho\,p(T_d) \ge \tfrac{63}{100}", "proved",
             premises=("theorem1.mean", "gamma.p.step"), at=last_chance,
             note="Not printed. The condition of Theorem 1 is free of p(k), as Remark 5 says, its rate is not: by the paper's own recursion, with phi_hat = phi_c "
                  "(where g is below rho), more than 63 per cent of the expected error at k = 2000 is left after all 150 trials.")
def last_sample() -> Goal:
    """Bernoulli's bound of the power, at the stated rho and p(T_d) = 1/100."""
    return Goal((at_least(1 - TRIALS * rho * p_k, sp.Rational(63, 100)),))


def _lambda_condition(reading: Reading, quarter: int, recorded: Verdict, note: str,
                      repair: dict[sp.Expr, Fraction] | None = None) -> None:
    suffix = {4: "", 16: ".contracts"}[quarter]
    shown = {4: "< 1", 16: "< 2"}[quarter]

    @paper.claim(f"theorem1.stated.{reading.suffix}{suffix}", f"The stated lambda and rho meet Theorem 1 ({reading.title})", "condition",
                 rf"\lambda > \tfrac{{1}}{{{quarter}}}\rho^2b^2\ \Leftrightarrow\ \max_{{\hat\phi}}"
                 rf"\frac{{\rho b\hat\phi}}{{\lambda + \hat\phi^2}} {shown}", recorded,
                 premises=("theorem1.lambda",), at={**stated(rho, lamda), b: reading.gain},
                 repair=None if repair is None else {**stated(rho), b: reading.gain, **repair}, note=note)
    def lambda_is_large_enough() -> Goal:
        return Goal((greater(lamda, rho**2 * b**2 / quarter),))


_lambda_condition(newton, 4, "proved", "b = T_s/M is the least that p can be; for the train with its memory no p is enough (A2.every).")
_lambda_condition(per_mass, 4, "violated", "The paper prints no value of lambda_min; this is the one that theorem1.lambda gives, with p = b = 0.1, the "
                  "least possible. The error may change its sign from trial to trial; it still shrinks (next claim).",
                  {lamda: Fraction(1, 1000)})
_lambda_condition(per_mass, 16, "proved", "|1 - g| < 1 for every positive estimate, at this one sample.")
_lambda_condition(per_mass_1s, 16, "violated", "At the estimate phi_hat = sqrt(lambda) the error of the first sample is multiplied by about -16 in every trial.",
                  {lamda: Fraction(1, 100)})
