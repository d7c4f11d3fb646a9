"""Section 3, trials of random length: the distribution, Assumption 3, iCFDL-MFAILC (14), (15) where data are missing."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less

from ..laws import (
    Delta_u,
    Delta_v,
    e_prev,
    e_prev2,
    epsilon,
    estimate_step,
    gamma,
    gamma_prev2,
    input_step,
    phi_i,
    phi_prev,
)
from ..paper import paper
from ..plant import u_prev

T_d, T_min, sample = sp.symbols("T_d T_min k", real=True)
p_k = sp.Symbol("p_k", real=True)
probabilities = sp.symbols("p_1:5", nonnegative=True)  # p_1..p_4: T_d - T_min = 4 written out


def p_of(distance: int) -> sp.Expr:
    """p(k) as printed, at k = T_min + distance > T_min, for the distribution written out."""
    return sp.Add(*(probabilities[number - 1] for number in range(distance, len(probabilities) + 1)))


def _distribution(last_positive: bool = False) -> Goal:
    total = equal(probabilities[0], 1 - sp.Add(*probabilities[1:]))
    given = (total, *(less(x, 1) for x in probabilities))
    given = (*given, greater(probabilities[-1], 0)) if last_positive else given
    lengths = range(1, len(probabilities) + 1)
    return Goal((*(greater(p_of(d), 0) for d in lengths), *(at_most(p_of(d), 1) for d in lengths)), given)


@paper.claim("gamma", "gamma = 1 has a probability strictly between 0 and 1 at every k", "condition",
             r"0 < p(k) < 1,\ k \in [0, T_d]", "violated", at={p_k: Fraction(1)},
             note="Cosmetic: the text itself goes on to p(k) = 1 on [0, T_min] and to 0 < p(k) <= 1.")
def strictly_between() -> Goal:
    """p(k) on [0, T_min], where the text sets it to 1."""
    return Goal((greater(p_k, 0), less(p_k, 1)))


@paper.claim("gamma.union", "The events of the union are defined for k in [T_min, T_d]", "condition",
             r"l = k - T_{\min} \in \{1, \ldots, T_d - T_{\min}\}\ \text{for}\ k \in [T_{\min}, T_d]", "violated",
             at={sample: Fraction(1900), T_min: Fraction(1900), T_d: Fraction(2000)},
             repair={sample: Fraction(1901), T_min: Fraction(1900), T_d: Fraction(2000)},
             note="At k = T_min the union starts with H_0 and the sum with p_0, which Assumption 3 does not define. Cosmetic: "
                  "the formula for p(k) that follows starts at T_min + 1.")
def union_is_defined() -> Goal:
    """The first index of the union at k = T_min."""
    return Goal((at_least(sample - T_min, 1), at_most(sample - T_min, T_d - T_min)))


@paper.claim("gamma.p", "Probability that a trial reaches k", "identity",
             r"P[\gamma(k,i) = 1] = \sum_{l=k-T_{\min}}^{T_d-T_{\min}} p_l = p(k),\quad p(T_{\min}+1) = 1", "proved",
             scope="T_d - T_min = 4, every distribution; every number by gamma.p.step",
             note="The left side is the sum over all lengths T_i >= k; the events H_l exclude one another.")
def reaching_probability() -> Goal:
    """Indicator of T_i >= k summed over the distribution, against the printed range."""
    lengths = range(1, len(probabilities) + 1)
    reaching = [sp.Add(*(probabilities[number - 1] * int(number >= d) for number in lengths)) for d in lengths]
    return Goal((*(equal(left, p_of(d)) for left, d in zip(reaching, lengths, strict=True)), equal(p_of(1), 1)),
                (equal(probabilities[0], 1 - sp.Add(*probabilities[1:])),))


@paper.claim("gamma.p.step", "The same for every number of lengths: the simulated distribution in closed form", "identity",
             r"p_l = \tfrac{1}{T_d - T_{\min}}:\ p(k) = \frac{T_d - k + 1}{T_d - T_{\min}},\ k \in [T_{\min}+1, T_d]", "proved",
             premises=("gamma.p",), scope="every T_d and T_min, by downward induction",
             note="Base case k = T_d, step from k+1 to k, and the value 1 at T_min + 1, where it meets p(k) = 1. At the end it "
                  "is p(2000) = 1/100.")
def uniform_closed_form() -> Goal:
    """Base, step and first value of the sum."""
    count = T_d - T_min

    def closed(at: sp.Expr) -> sp.Expr:
        return (T_d - at + 1) / count

    return Goal((equal(closed(T_d), 1 / count), equal(closed(sample), closed(sample + 1) + 1 / count),
                 equal(closed(T_min + 1), 1)), (greater(count, 0),))


@paper.claim("gamma.positive", "Obviously 0 < p(k) <= 1", "implication",
             r"0 \le p_l < 1,\ \sum_l p_l = 1 \Rightarrow 0 < p(k) \le 1", "gap", premises=("gamma.p",),
             correction=lambda: _distribution(last_positive=True),
             corrected_statement=r"0 \le p_l < 1,\ \sum_l p_l = 1,\ p_{T_d - T_{\min}} > 0 \Rightarrow 0 < p(k) \le 1",
             scope="T_d - T_min = 4, every distribution",
             note="Assumption 3 allows p_l = 0. If the longest length never occurs p(T_d) = 0, nothing is ever learned "
                  "at T_d, and Theorem 1 fails there. With p_l = 1/100, as simulated, it holds.")
def reaching_is_possible() -> Goal:
    """p(k) for any distribution that Assumption 3 allows."""
    return _distribution()


reached, missed = sp.symbols("gamma_reached gamma_missed", real=True)  # the two values of gamma


@paper.claim("gamma.mean", "Expectation of gamma", "identity", r"E\{\gamma(k,i)\} = 1\cdot p(k) + 0\cdot(1-p(k)) = p(k)",
             "proved", premises=("gamma.p",))
def bernoulli_mean() -> Goal:
    """The mean of a variable that is 1 with probability p(k) and else 0."""
    return Goal((equal(reached * p_k + missed * (1 - p_k), p_k),), (equal(reached, 1), equal(missed, 0)))


count = sp.Symbol("N", positive=True)


@paper.claim("A3.range", "T_i in [1900, 2000], each value with probability 1/100", "condition",
             r"\sum_{T_i = 1900}^{2000} \tfrac{1}{100} = 1", "violated", premises=("gamma.p",),
             at={T_d: Fraction(2000), T_min: Fraction(1900), count: Fraction(100)},
             repair={T_d: Fraction(2000), T_min: Fraction(1901), count: Fraction(100)},
             note="Cosmetic: [1900, 2000] has 101 values and l = 1..100 only the 100 values from 1901 on.")
def range_of_lengths() -> Goal:
    """Number of values times their probability."""
    return Goal((equal((T_d - T_min + 1) / count, 1),))


def _modified(equation: str, name: str, latex: str) -> None:
    quantity = sp.Symbol(name, real=True)

    @paper.claim(equation, f"Modified {name}: what is missing counts as zero", "identity",
                 rf"{latex}^*(k,i) = \gamma(k,i){latex}(k,i) = {latex}(k,i)\ (k \le T_i),\ 0\ (k > T_i)", "proved",
                 note="A definition, with gamma(k,i) = 1 just for k <= T_i, as the event is described. That gamma is Bernoulli, the "
                      "reason given, would not suffice: the gammas of one trial are not independent of one another.")
    def modified() -> Goal:
        return Goal((equal(reached * quantity, quantity), equal(missed * quantity, 0)),
                    (equal(reached, 1), equal(missed, 0)))


_modified("14.error", "e", "e")
_modified("15.innovation", "xi", r"\xi")


@paper.claim("14", "Where data are missing the input is kept", "implication",
             r"\gamma(k+1,i-1) = 0 \Rightarrow u_f(k,i) = u_f(k,i-1)", "proved", premises=("14.error",))
def kept_input() -> Goal:
    """(14) at gamma = 0."""
    return Goal((equal(u_prev + input_step(phi_i, gamma * e_prev), u_prev),), (equal(gamma, 0),))


@paper.claim("14.range", "The error that (14) uses is defined for all k in [0, T_d]", "condition",
             r"k + 1 \in [0, T_d]\ \text{for}\ k \in [0, T_d]", "violated", at={sample: Fraction(2000), T_d: Fraction(2000)},
             repair={sample: Fraction(1999), T_d: Fraction(2000)},
             note="Cosmetic, in (5), (14), (15) and (18) alike: k = T_d would need v(T_d + 1). They hold for k up to T_d - 1.")
def error_is_defined() -> Goal:
    """k + 1 <= T_d at k = T_d."""
    return Goal((at_most(sample + 1, T_d),))


step_before = input_step(phi_prev, gamma_prev2 * e_prev2)  # Delta u(k, i-1) by (14)


@paper.claim("15", "Where data are missing the estimate is kept", "implication",
             r"\gamma(k+1,i-1) = 0 \Rightarrow \hat\phi_c(k,i) = \hat\phi_c(k,i-1)", "proved", premises=("15.innovation",),
             note="Before the reset (13), which puts phi_hat(k,1) in its place one trial later: 15.reset.")
def kept_estimate() -> Goal:
    """(15) at gamma = 0."""
    innovation = Delta_v - phi_prev * Delta_u
    return Goal((equal(phi_prev + estimate_step(Delta_u, gamma * innovation), phi_prev),), (equal(gamma, 0),))


@paper.claim("15.data", "(15) needs no speed of a trial that had ended", "implication",
             r"\gamma(k+1,i-2) = 0 \Rightarrow \frac{\partial\hat\phi_c(k,i)}{\partial v(k+1,i-2)} = 0", "proved",
             premises=("14",),
             note="Not printed but needed: xi(k+1,i-1) contains v(k+1,i-2), and the gamma before it is that of trial i-1. Where trial i-2 "
                  "had ended, (14) has kept the input, and the missing speed is multiplied by zero.")
def no_missing_speed() -> Goal:
    """D of (15) by the speed of trial i-2."""
    now, missing = sp.symbols("v_next_prev v_next_prev2", real=True)
    new = phi_prev + estimate_step(step_before, gamma * (now - missing - phi_prev * step_before))
    return Goal((equal(D(new), 0),), (equal(gamma_prev2, 0),), {missing: sp.Integer(1)})


@paper.claim("15.reset", "A trial that ends early makes (13) forget the estimate", "implication",
             r"\gamma(k+1,i-2) = 0 \Rightarrow |\Delta u_f(k,i-1)| \le \varepsilon\ \text{and (13) sets}\ "
             r"\hat\phi_c(k,i) = \hat\phi_c(k,1)", "proved", premises=("14",),
             note="Not printed. Near the end of the trip, where a trial rarely gets to (1 in 100 at k = 2000), an estimate is learned only when "
                  "two trials running reach k + 1, and is forgotten after the next that does not: the adaptation is out of work there.")
def early_end_resets() -> Goal:
    """Delta u(k,i-1) of (14) at gamma(k+1,i-2) = 0."""
    return Goal((at_most(step_before**2, epsilon**2),), (equal(gamma_prev2, 0),))
