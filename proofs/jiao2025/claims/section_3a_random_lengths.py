"""Section 3, trials of random length: gamma, its probability, and the modified error and innovation."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, greater, less

from ..laws import e_now, gamma
from ..notation import T_d, T_min, e_i, gamma_mean, p_k, xi, xi_star
from ..paper import paper
from ..stated_values import LENGTH, SHORTEST

sample = sp.Symbol("k", real=True)
length_i = sp.Symbol("T_i", real=True)


of_section_4 = (equal(T_min, SHORTEST), equal(T_d, LENGTH))


@paper.claim("3.redundant", "The text after (13): The redundant data of a longer trial begin at T_d", "inequality",
             r"T_d \leq T_i \leq T_{\max}:\ \text{the data in } [T_d, T_{\max}] \text{ are redundant}", "refuted", severity="cosmetic", match="words",
             reading="Redundant are samples that are not among the desired ones, k > T_d. T_d is that of section 4.",
             note="A slip of the end point: k = T_d is a desired sample; the redundant ones of trial i are those of [T_d + 1, T_i]. Nor is a trial with T_i = T_d longer. The paper then takes T_i <= T_d alone.")
def redundant_samples() -> Goal:
    """A sample of the interval lies beyond T_d."""
    return Goal((greater(sample, T_d),), (at_least(sample, T_d), equal(T_d, LENGTH)))


@paper.claim("3.available", "The text after (13): The data of trial i are available on [T_min, T_i]", "implication",
             r"\text{in the time interval } [T_{\min}, T_i] \text{ the system data are available}", "proved", severity="cosmetic", match="words",
             reading="As gamma has it, available are the samples with gamma(k,i) = 1: gamma is 0 or 1, and 0 only beyond T_i.",
             note="True, and less than what holds: data are available on [0, T_i].")
def available_samples() -> Goal:
    """A sample up to T_i is none at which gamma is 0."""
    reached_there = (equal(gamma * (1 - gamma), 0), at_least((1 - gamma) * (sample - length_i - 1), 0))
    return Goal((equal(gamma, 1),), (*reached_there, at_least(sample, T_min), at_most(sample, length_i)),
                lemmas=(at_most((1 - gamma) ** 2, 0),))


@paper.claim("gamma", "gamma = 1 has a probability below 1 at every k", "inequality",
             r"0 < p(k) < 1", "refuted", severity="cosmetic", rests_on=(),
             reading="For k in [0, T_d]; 0 < p(k) is a premise, of which nothing can be false. Asked where the text itself sets p(k) = 1, up to T_min.",
             note="The text goes on to p(k) = 1 on [0, T_min] and to 0 < p(k) <= 1. 0 < p(k) asks that the longest length occurs, since p(T_d) is its probability, and Assumption 3 has 0 <= p_l: it should ask that "
                  "this one is positive (gamma.positive.mended). With p_l = 1/100, as simulated, it is.")
def below_one() -> Goal:
    """p(k) on [0, T_min]."""
    return Goal((less(p_k, 1),), (at_most(sample, T_min), at_least(sample, 0), equal(p_k, 1), *of_section_4))


@paper.claim("gamma.union", "The events of the union are defined for k in [T_min, T_d]", "inequality",
             r"P[\gamma(k, i) = 1] = P\left[\bigcup_{l=k-T_{\min}}^{T_d-T_{\min}} H_l\right],\ k \in [T_{\min}, T_d],\ l \in \{1, \dots, T_d - T_{\min}\}", "refuted", severity="cosmetic", rests_on=(),
             reading="The first index l = k - T_min of the union lies in the set in which H_l is defined. T_min and T_d are those of section 4.",
             note="At k = T_min the union starts with H_0 and the sum with p_0, which Assumption 3 does not define. "
                  "The formula for p(k) that follows starts at T_min + 1.")
def union_is_defined() -> Goal:
    """The first index of the union."""
    return Goal((at_least(sample - T_min, 1),), (at_least(sample, T_min), at_most(sample, T_d), *of_section_4))


paper.axiom("remark3", "Remark 3: the probabilities of all lengths are known",
            r"\text{the probability of every time of arrival is assumed known; the same assumption is made in [23]}",
            "the paper's choice, after its reference [23]", hypotheses=("A3",), severity="cosmetic", match="words",
            note="No law uses them, as Remark 5 says: remark5.distribution.")

reach, reach_next, total, total_next, p_l = sp.symbols("P_reach P_reach_next P_sum P_sum_next p_l", real=True)


@paper.claim("gamma.p", "Probability that a trial reaches k", "identity",
             r"P[\gamma(k, i) = 1] = \sum_{l=k-T_{\min}}^{T_d-T_{\min}} P[H_l] = \sum_{l=k-T_{\min}}^{T_d-T_{\min}} p_l", "proved", rests_on=("A3",),
             scope="every T_d, T_min and distribution, by downward induction over k in [T_min + 1, T_d]",
             reading="Downward induction: a trial that reaches k ends there, which is H_l with l = k - T_min, or reaches k + 1, and both exclude each other; the sum from l on is p_l and the sum from l + 1 on. "
                     "Beyond T_d both are zero.",
             note="The same sum is p(k) in the formula that follows; for k up to T_min every trial gets there and p(k) = 1.")
def reaching_probability() -> Goal:
    """From k + 1 to k, and the start at T_d."""
    return Goal((equal(reach, total),), (equal(reach, p_l + reach_next), equal(total, p_l + total_next), equal(reach_next, total_next)))


@paper.claim("gamma.certain", "Every trial reaches the samples up to T_min", "identity", r"p(k) = 1, \quad \text{if } k \in [0, T_{\min}]", "proved",
             premises=("gamma.p",), rests_on=("A3",), scope="every T_d, T_min and distribution, by downward induction over k in [0, T_min]",
             reading="The first case of the printed p(k); the second one is gamma.p. No trial ends at k <= T_min, so that all that reach k also reach k + 1, which the whole distribution does at T_min + 1.")
def certain_samples() -> Goal:
    """From k + 1 to k where no trial ends."""
    return Goal((equal(p_k, 1),), (equal(p_k, p_l + reach_next), equal(p_l, 0), equal(reach_next, 1), at_least(sample, 0), at_most(sample, T_min)))


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


def _reaching(*more: Relation) -> Goal:
    """p(k): the last length, the other lengths that reach k, and those that do not, which sum to one."""
    distribution = (equal(p_last + other_reaching + other_short, 1), at_least(p_last, 0), less(p_last, 1), equal(p_k, p_last + other_reaching))
    return Goal((greater(p_k, 0), at_most(p_k, 1)), (*distribution, *more))


@paper.claim("gamma.positive", "0 < p(k) <= 1, where 0 < p(k) as laid down for gamma", "inequality", r"0 < p(k) \leq 1", "proved", premises=("gamma.p",), rests_on=("gamma.p", "A3"),
             reading="With 0 < p(k), which the text lays down where it defines gamma.",
             note="The text calls it obvious; Assumption 3 alone does not give 0 < p(k): A3.last.")
def reaching_is_possible() -> Goal:
    """p(k) for any distribution that Assumption 3 allows, with what is laid down of gamma."""
    return _reaching(greater(p_k, 0))


@paper.claim("A3.last", "Assumption 3 alone makes every sample reachable", "inequality", r"0 \le p_l < 1 \Rightarrow 0 < p(k)", "refuted", premises=("gamma.p",), origin="ours",
             correction=lambda: _reaching(greater(p_last, 0)),
             corrected_statement=r"0 \le p_l < 1,\ \sum_l p_l = 1,\ p_{T_d - T_{\min}} > 0 \Rightarrow 0 < p(k) \le 1",
             note="If the longest length never occurs p(T_d) = 0, and nothing is ever learned at T_d. The definition of gamma excludes that.")
def reaching_by_assumption_3() -> Goal:
    """p(k) for any distribution that Assumption 3 allows."""
    return _reaching()


@paper.claim("gamma.positive.mended", "Where the longest length occurs every k is reached with a probability above zero", "inequality",
             r"p_{T_d - T_{\min}} > 0 \Rightarrow 0 < p(k) \le 1", "proved", premises=("gamma.p",), origin="ours", mends="A3.last")
def reaching_mended() -> Goal:
    """p(k) is at least the probability of the longest length."""
    return _reaching(greater(p_last, 0))


reached, missed = sp.symbols("gamma_reached gamma_missed", real=True)  # the two values of gamma


@paper.claim("gamma.mean", "Expectation of gamma", "identity", r"E\{\gamma(k, i)\} = 1 \cdot p(k) + 0 \cdot (1 - p(k)) = p(k)",
             "proved", premises=("gamma.p",), reading="The mean of a variable with the values 1 and 0 and the probabilities p(k) and 1 - p(k).")
def bernoulli_mean() -> Goal:
    """The mean of a variable that is 1 with probability p(k) and else 0."""
    return Goal((equal(gamma_mean, p_k),), (equal(gamma_mean, reached * p_k + missed * (1 - p_k)), equal(reached, 1), equal(missed, 0)))


def _modified(equation: str, latex: str, starred: sp.Symbol, plain: sp.Symbol, note: str, section: str = "3", place: str = "") -> None:
    """Both lines of the cases of a modified quantity, from its definition gamma times the quantity."""
    reading = f"With the definition {latex}* = gamma {latex} that stands above it, gamma being 1 just for k <= T_i.".replace("\\", "")
    names = {rf"{latex}^*(k, i)": starred, rf"{latex}(k, i)": plain, "T_i": length_i}
    definition = equal(starred, gamma * plain)

    @paper.claim(equation, f"{place}What a trial has reached counts as it is", "identity",
                 rf"{latex}^*(k, i) = {latex}(k, i), \quad \text{{if }} k \in [0, T_i]", "proved", where=names, section=section, reading=reading, note=note)
    def with_data() -> Goal:
        return Goal((equal(starred, plain),), (definition, equal(gamma, 1), at_least(sample, 0), at_most(sample, length_i)))

    @paper.claim(f"{equation}.ended", f"{place}What a trial has not reached counts as zero", "identity",
                 rf"{latex}^*(k, i) = 0, \quad \text{{if }} k \in [T_i + 1, T_d]", "proved", where=names, section=section, reading=reading, note=note)
    def without_data() -> Goal:
        return Goal((equal(starred, 0),), (definition, equal(gamma, 0), at_least(sample, length_i + 1), at_most(sample, T_d)))


def _definition(equation: str, latex: str, starred: sp.Symbol, plain: sp.Symbol) -> None:
    """The definition of a modified quantity, from the two cases that the paper draws from it."""
    name = latex.replace("\\", "")

    @paper.claim(equation, f"The modified {'error' if latex == 'e' else 'innovation'}", "identity",
                 rf"{latex}^*(k, i) \triangleq \gamma(k, i){latex}(k, i)", "proved", rests_on=(),
                 where={rf"{latex}^*(k, i)": starred, rf"{latex}(k, i)": plain},
                 reading=f"A definition; decided as the one formula for both printed cases, {name}* = {name} where gamma = 1 and {name}* = 0 where gamma = 0.")
    def one_formula() -> Goal:
        """Either case, times gamma and times 1 - gamma."""
        return Goal((equal(starred, gamma * plain),), (equal(gamma * (starred - plain), 0), equal((1 - gamma) * starred, 0)))


_definition("14.definition", "e", e_now, e_i)
_definition("15.definition", r"\xi", xi_star, xi)
_modified("14.error", "e", e_now, e_i, "gamma(k,i) = 1 just for k <= T_i, as the event is described. That gamma is Bernoulli, the "
          "reason given, would not suffice: the gammas of one trial are not independent of one another.")
_modified("15.innovation", r"\xi", xi_star, xi, "As 14.error.")
_modified("18.error", "e", e_now, e_i, "14.error once more, for the law of the comparison.", "4", "The text after (18): ")
