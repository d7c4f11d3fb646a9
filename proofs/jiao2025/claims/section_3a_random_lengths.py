"""Section 3, trials of random length: gamma, its probability, and the modified error and innovation."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal, greater, less

from ..laws import gamma
from ..notation import T_d, T_min, gamma_mean, p_k
from ..paper import paper

sample = sp.Symbol("k", real=True)


@paper.claim("3.redundant", "Data that a trial longer than T_d brings are redundant", "inequality",
             r"T_d \leq T_i \leq T_{\max}:\ \text{the data in } [T_d, T_{\max}] \text{ are redundant}", "refuted", severity="cosmetic", match="words",
             reading="Redundant are samples that are not among the desired ones, k > T_d.",
             note="k = T_d itself is a desired sample; the redundant ones are those of [T_d + 1, T_max]. The paper then takes T_i <= T_d alone.")
def redundant_samples() -> Goal:
    """A sample of the interval lies beyond T_d."""
    return Goal((greater(sample, T_d),), (at_least(sample, T_d), greater(T_d, 0)))


@paper.claim("gamma", "gamma = 1 has a probability strictly between 0 and 1 at every k", "condition",
             r"0 < p(k) < 1", "violated", at={p_k: Fraction(1)}, severity="cosmetic",
             note="For k in [0, T_d]. The text itself goes on to p(k) = 1 on [0, T_min] and to 0 < p(k) <= 1.")
def strictly_between() -> Goal:
    """p(k) on [0, T_min], where the text sets it to 1."""
    return Goal((greater(p_k, 0), less(p_k, 1)))


@paper.claim("gamma.union", "The events of the union are defined for k in [T_min, T_d]", "condition",
             r"P[\gamma(k, i) = 1] = P\left[\bigcup_{l=k-T_{\min}}^{T_d-T_{\min}} H_l\right],\ k \in [T_{\min}, T_d],\ l \in \{1, \dots, T_d - T_{\min}\}", "violated",
             at={sample: Fraction(1900), T_min: Fraction(1900), T_d: Fraction(2000)}, severity="cosmetic",
             repair={sample: Fraction(1901), T_min: Fraction(1900), T_d: Fraction(2000)},
             reading="The first index l = k - T_min of the union lies in the set in which H_l is defined.",
             note="At k = T_min the union starts with H_0 and the sum with p_0, which Assumption 3 does not define. "
                  "The formula for p(k) that follows starts at T_min + 1.")
def union_is_defined() -> Goal:
    """The first index of the union at k = T_min."""
    return Goal((at_least(sample - T_min, 1), at_most(sample - T_min, T_d - T_min)))


reach, reach_next, total, total_next, p_l = sp.symbols("P_reach P_reach_next S_k S_next p_l", real=True)


@paper.claim("gamma.p", "Probability that a trial reaches k", "identity",
             r"P[\gamma(k, i) = 1] = \sum_{l=k-T_{\min}}^{T_d-T_{\min}} P[H_l] = \sum_{l=k-T_{\min}}^{T_d-T_{\min}} p_l", "proved", rests_on=("A3",),
             scope="every T_d, T_min and distribution, by downward induction over k in [T_min + 1, T_d]",
             reading="Downward induction: a trial that reaches k ends there, which is H_l with l = k - T_min, or reaches k + 1, and both exclude each other; the sum from l on is p_l and the sum from l + 1 on. "
                     "Beyond T_d both are zero.",
             note="The same sum is p(k) in the formula that follows; for k up to T_min every trial gets there and p(k) = 1.")
def reaching_probability() -> Goal:
    """From k + 1 to k, and the start at T_d."""
    return Goal((equal(reach, total),), (equal(reach, p_l + reach_next), equal(total, p_l + total_next), equal(reach_next, total_next)))


@paper.claim("gamma.p.step", "The simulated distribution in closed form", "identity",
             r"p_l = \tfrac{1}{T_d - T_{\min}}:\ p(k) = \frac{T_d - k + 1}{T_d - T_{\min}},\ k \in [T_{\min}+1, T_d]", "proved",
             premises=("gamma.p",), origin="ours", scope="every T_d and T_min, by downward induction",
             note="Base case k = T_d, step from k+1 to k, and the value 1 at T_min + 1, where it meets p(k) = 1. At the end it "
                  "is p(2000) = 1/100.")
def uniform_closed_form() -> Goal:
    """Base, step and first value of the sum."""
    count = T_d - T_min

    def closed(at: sp.Expr) -> sp.Expr:
        return (T_d - at + 1) / count

    return Goal((equal(closed(T_d), 1 / count), equal(closed(sample), closed(sample + 1) + 1 / count),
                 equal(closed(T_min + 1), 1)), (greater(count, 0),))


p_last = sp.Symbol("p_last", real=True)  # probability of the greatest length
other_reaching, other_short = sp.symbols("p_other_reaching p_short", nonnegative=True)


def _reaching(last_occurs: bool) -> Goal:
    """p(k): the last length, the other lengths that reach k, and those that do not, which sum to one."""
    distribution = (equal(p_last + other_reaching + other_short, 1), at_least(p_last, 0), less(p_last, 1), equal(p_k, p_last + other_reaching))
    occurs = (greater(p_last, 0),) if last_occurs else ()
    return Goal((greater(p_k, 0), at_most(p_k, 1)), (*distribution, *occurs))


@paper.claim("gamma.positive", "Obviously 0 < p(k) <= 1", "inequality", r"0 < p(k) \leq 1", "refuted", premises=("gamma.p",), rests_on=("gamma.p", "A3"),
             correction=lambda: _reaching(last_occurs=True),
             corrected_statement=r"0 \le p_l < 1,\ \sum_l p_l = 1,\ p_{T_d - T_{\min}} > 0 \Rightarrow 0 < p(k) \le 1",
             note="Assumption 3 allows p_l = 0. If the longest length never occurs p(T_d) = 0, nothing is ever learned "
                  "at T_d, and Theorem 1 fails there. With p_l = 1/100, as simulated, it holds.")
def reaching_is_possible() -> Goal:
    """p(k) for any distribution that Assumption 3 allows."""
    return _reaching(last_occurs=False)


@paper.claim("gamma.positive.mended", "Where the longest length occurs every k is reached with a probability above zero", "inequality",
             r"p_{T_d - T_{\min}} > 0 \Rightarrow 0 < p(k) \le 1", "proved", premises=("gamma.p",), origin="ours", mends="gamma.positive")
def reaching_mended() -> Goal:
    """p(k) is at least the probability of the longest length."""
    return _reaching(last_occurs=True)


reached, missed = sp.symbols("gamma_reached gamma_missed", real=True)  # the two values of gamma


@paper.claim("gamma.mean", "Expectation of gamma", "identity", r"E\{\gamma(k, i)\} = 1 \cdot p(k) + 0 \cdot (1 - p(k)) = p(k)",
             "proved", premises=("gamma.p",), reading="The mean of a variable with the values 1 and 0 and the probabilities p(k) and 1 - p(k).")
def bernoulli_mean() -> Goal:
    """The mean of a variable that is 1 with probability p(k) and else 0."""
    return Goal((equal(gamma_mean, p_k),), (equal(gamma_mean, reached * p_k + missed * (1 - p_k)), equal(reached, 1), equal(missed, 0)))


def _modified(equation: str, name: str, latex: str, note: str) -> None:
    plain = sp.Symbol(name, real=True)

    @paper.claim(equation, f"Modified {name}: what is missing counts as zero", "identity",
                 rf"{latex}^*(k, i) = \begin{{cases}} {latex}(k, i), & k \in [0, T_i], \\ 0, & k \in [T_i + 1, T_d]. \end{{cases}}", "proved",
                 reading=f"With the definition {name}* = gamma {name} that stands above it: one case for each value of gamma, which is 1 just for k <= T_i.", note=note)
    def modified() -> Goal:
        cases = sp.symbols(f"{name}_reached {name}_missed", real=True)
        return Goal((equal(cases[0], plain), equal(cases[1], 0)),
                    (equal(cases[0], (gamma * plain).xreplace({gamma: reached})), equal(cases[1], (gamma * plain).xreplace({gamma: missed})),
                     equal(reached, 1), equal(missed, 0)))


_modified("14.error", "e", "e", "gamma(k,i) = 1 just for k <= T_i, as the event is described. That gamma is Bernoulli, the "
          "reason given, would not suffice: the gammas of one trial are not independent of one another.")
_modified("15.innovation", "xi", r"\xi", "As 14.error.")
_modified("18.error", "e", "e", "14.error once more, for the PD law.")
