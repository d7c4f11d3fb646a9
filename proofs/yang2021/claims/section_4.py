"""yang2021, section 4: the barrier, Lemma 1 and Lemma 2."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import Goal, at_least, at_most, differ, equal, greater, less

from ..error_dynamics import EVERY_NETWORK, W_tilde, e_1, e_2, lambdas, tildes
from ..laws import chi, k
from ..lyapunov import (
    V_0,
    V_1,
    V_estimates,
    V_t,
    V_t_rate,
    V_weights,
    along_v,
    barrier,
    decaying,
    from_zero,
    inside,
    l_,
    level,
    mu,
    t,
)
from ..paper import paper
from ..stated_values import stated_k

paper.definition("18", "The error system of Lemma 1", r"\dot{e} = f(t, e)")
paper.definition("19", "The decay that Lemma 1 asks for",
                 r"\dot{V} = \frac{\partial V}{\partial x}f \leq -\mu V + l",
                 note="A hypothesis, see lemma1. l is called lambda below (20), and x stands for e.")
paper.definition("20.definition", "The symmetric barrier function",
                 r"V_1(e_1) = \frac{1}{2}\log\frac{k^2}{k^2 - e_1^2}")


@paper.claim("20", "V_1 is positive away from zero", "inequality", r"V(x) > 0\ (x \neq 0)", "proved",
             reading="V is V_1 of (20) and x its argument e_1, within the constraint.")
def barrier_positive() -> Goal:
    """V_1 > 0 away from zero."""
    return Goal((greater(V_1, 0),), (inside, differ(e_1, 0)))


@paper.claim("20.zero", "V_1 vanishes at zero", "inequality", r"V(0) = 0", "proved",
             reading="V is V_1 of (20), taken where e_1 = 0, and is neither above nor below 0.")
def barrier_zero() -> Goal:
    """V_1 where e_1 = 0."""
    return Goal((at_most(V_1, 0), at_least(V_1, 0)), (inside, equal(e_1, 0)),
                lemmas=(at_most(sp.log(barrier), e_1**2 / (k**2 - e_1**2)),))


@paper.claim("20.barrier", "V_1 grows beyond every bound at the constraint", "limit",
             r"e_1 \rightarrow -k \text{ or } e_1 \rightarrow k,\ V_1(e_1) \rightarrow \infty", "proved",
             reading="With the distance named: V_1 >= B as soon as e_1^2 >= k^2 (1 - exp(-2B)), for every B.")
def barrier_unbounded() -> Goal:
    """V_1 >= B close enough to the constraint, for every B."""
    close = at_least(e_1**2, k**2 * (1 - sp.exp(-2 * level)))
    return Goal((at_least(V_1, level),), (inside, close), facts=(2 * level - sp.log(barrier),))


@paper.claim("20.bounded", "V is bounded", "implication",
             r"\text{It can be seen from } \dot{V} \leq -\mu V + \lambda \text{ that } V \text{ is a bounded}", "proved",
             match="words",
             reading="V is between V(0) and lambda/mu at all times, or below; lambda is the l of (19), and mu > 0.")
def bounded_by_decay() -> Goal:
    """Every V with V' <= -mu V + l at all times, from V(0)."""
    share = sp.exp(-mu * t)
    return Goal((at_most(V_t, V_0 * share + (1 - share) * l_ / mu),), (), along_v, decaying, from_zero,
                decreasing=sp.exp(mu * t) * (V_t - l_ / mu), inputs=(V_t_rate,))


@paper.claim("20.band", "The text after (20): k = 0.21 constrains the position error to 0.2 m", "implication",
             r"\text{the maximum position error is constrained as $e_1(t) = 0.2$, due to $|e_1(t)| < k$; taking $k = 0.21$}", "gap",
             match="words", reading="|e_1(t)| < k and k = 0.21 bring |e_1(t)| <= 0.2.", correction=lambda: _band(sp.Rational(2, 10)),
             corrected_statement=r"k = 0.2,\ |e_1(t)| < k \Rightarrow |e_1(t)| \le 0.2",
             note="The barrier at k only keeps the error below 0.21 m: k = 0.2 would do.")
def band_from_barrier() -> Goal:
    """|e_1| < 0.21 does not bring |e_1| <= 0.2."""
    return _band(sp.Rational(21, 100))


def _band(barrier_at: sp.Rational) -> Goal:
    return Goal((at_most(sp.Abs(e_1), sp.Rational(2, 10)),), (less(sp.Abs(e_1), k), equal(k, barrier_at)))


def _lemma_2(strict: bool) -> Goal:
    relation = less if strict else at_most
    return Goal((relation(sp.log(barrier), e_1**2 / (k**2 - e_1**2)),), (inside,))


@paper.claim("21", "Lemma 2", "inequality",
             r"\log \frac{k^2}{k^2 - e_1^2} < \frac{e_1^2}{k^2 - e_1^2}", "refuted", severity="cosmetic",
             correction=lambda: _lemma_2(strict=False),
             corrected_statement=r"\log\frac{k^2}{k^2 - e_1^2} \le \frac{e_1^2}{k^2 - e_1^2}",
             note="Both sides are 0 at e_1 = 0, which the lemma's domain contains. The non-strict form holds and is "
                  "all that the proof needs; the lemma is cited from [28].")
def lemma_2() -> Goal:
    """The strict inequality as printed."""
    return _lemma_2(strict=True)


@paper.claim("21.mended", "Lemma 2, not strict", "inequality",
             r"\log \frac{k^2}{k^2 - e_1^2} \leq \frac{e_1^2}{k^2 - e_1^2}", "proved", origin="ours", mends="21")
def lemma_2_mended() -> Goal:
    """The tangent of the logarithm."""
    return _lemma_2(strict=False)


c_low, c_high = sp.symbols("chi_low chi_high", positive=True)
V_rest = e_2**2 / 2 + V_weights + V_estimates
all_squares = e_2**2 + over_neurons(W_tilde**2) + sum((s**2 for s in tildes), sp.Integer(0))


@paper.claim("lemma1.2", "Hypothesis 2: V_2 lies between class K-infinity functions", "inequality",
             r"\chi_1(\|e_2\|) \leq V_2(e_2) \leq \chi_2(\|e_2\|)", "proved", scope=EVERY_NETWORK,
             where={r"\chi_1(\|e_2\|)": c_low * all_squares, "V_2(e_2)": V_rest, r"\chi_2(\|e_2\|)": c_high * all_squares},
             reading="In Theorem 1 V_2 is all of (38) but V_1, and e_2 stands for (e_2, W-tilde, a-tilde, b-tilde, c-tilde); "
                     "chi_1 and chi_2 are the smallest and the largest weight times the square.")
def between_comparison_functions() -> Goal:
    """Quadratic bounds of V - V_1."""
    weights = (chi, *lambdas)
    low = (at_most(c_low, sp.Rational(1, 2)), *(at_most(2 * c_low * w, 1) for w in weights))
    high = (at_least(c_high, sp.Rational(1, 2)), *(at_least(2 * c_high * w, 1) for w in weights))
    return Goal((at_most(c_low * all_squares, V_rest), at_most(V_rest, c_high * all_squares)), (*low, *high))


start_error = sp.Symbol("e_1_0", real=True)


@paper.claim("lemma1.0", "The stated initial state is inside the constraint, where the desired curve starts at 0", "condition", r"|e_1(0)| < k", "proved",
             where={"e_1(0)": start_error}, at={start_error: Fraction(0), k: stated_k},
             note="x_1(0) = 0 is stated; x_d(0) stands in Figure 3 alone and is taken as 0.")
def starts_inside() -> Goal:
    """At the stated initial state and k."""
    return Goal((less(sp.Abs(start_error), k),))


paper.axiom("lemma1", "Lemma 1: a barrier function that obeys (19) keeps the constraint",
            r"\dot{V} = \frac{\partial V}{\partial x} f \leq -\mu V + l,\ |e_1(0)| < k \Rightarrow |e_1(t)| < k, "
            r"\forall t \in [0, \infty)",
            "Ren, Ge, Tee and Lee 2010 (the paper's [28])", hypotheses=("lemma1.0", "20.barrier", "lemma1.2", "51"),
            reading="(19) with what the lemma supposes and concludes; the derivative is by the errors e.",
            note="As printed it is of a V_1(e_1) + V_2(e_2), for an e of two errors; (38) has those of the estimates too, which lemma1.2 takes into e_2. It does not say that mu is "
                 "positive, as it must be (49.positive), and the text after (20) writes lambda for l. It supposes that solutions exist; with the steps of Table 1 in f they do in "
                 "Caratheodory's sense.")
