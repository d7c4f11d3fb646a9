"""yang2021, section 4: the barrier, Lemma 1 and Lemma 2."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import Goal, at_least, at_most, differ, equal, greater, less

from ..error_dynamics import EVERY_NETWORK, W_tilde, e_1, e_2, lambdas, tildes
from ..laws import chi, k
from ..lyapunov import V_1, V_estimates, V_weights, barrier, inside, level
from ..paper import paper
from ..stated_values import stated_k


@paper.claim("20", "V_1 is positive definite", "inequality",
             r"V_1(0) = 0,\quad V_1(e_1) > 0\ (0 < |e_1| < k)", "proved")
def barrier_positive() -> Goal:
    """V_1 > 0 away from zero."""
    return Goal((greater(V_1, 0),), (inside, differ(e_1, 0)))


@paper.claim("20.zero", "V_1 vanishes at zero", "identity", r"V_1(0) = 0", "proved")
def barrier_zero() -> Goal:
    """V_1 at e_1 = 0."""
    return Goal((equal(V_1.xreplace({e_1: sp.Integer(0)}), 0),))


@paper.claim("20.barrier", "V_1 grows beyond every bound at the constraint", "limit",
             r"e_1 \to \pm k \Rightarrow V_1(e_1) \to \infty", "proved",
             note="Decided with the distance named: V_1 >= B as soon as e_1^2 >= k^2 (1 - exp(-2B)), for every B.")
def barrier_unbounded() -> Goal:
    """V_1 >= B close enough to the constraint, for every B."""
    close = at_least(e_1**2, k**2 * (1 - sp.exp(-2 * level)))
    return Goal((at_least(V_1, level),), (inside, close), facts=(2 * level - sp.log(barrier),))


@paper.claim("20.band", "k = 0.21 constrains the position error to 0.2 m", "implication",
             r"|e_1| < k = 0.21 \Rightarrow |e_1| \le 0.2", "gap",
             note="The text constrains the error to 0.2 m 'due to |e_1| < k; taking k = 0.21'. The barrier at k "
                  "only keeps the error below 0.21 m.")
def band_from_barrier() -> Goal:
    """|e_1| < 0.21 does not bring |e_1| <= 0.2."""
    given = (equal(k, sp.Rational(21, 100)), less(e_1, k), greater(e_1, -k))
    return Goal((at_most(e_1**2, sp.Rational(1, 25)),), given)


def _lemma_2(strict: bool) -> Goal:
    relation = less if strict else at_most
    return Goal((relation(sp.log(barrier), e_1**2 / (k**2 - e_1**2)),), (inside,))


@paper.claim("21", "Lemma 2", "inequality",
             r"\log\frac{k^2}{k^2 - e_1^2} < \frac{e_1^2}{k^2 - e_1^2}", "refuted",
             correction=lambda: _lemma_2(strict=False),
             corrected_statement=r"\log\frac{k^2}{k^2 - e_1^2} \le \frac{e_1^2}{k^2 - e_1^2}",
             note="Both sides are 0 at e_1 = 0, which the lemma's domain contains. The non-strict form holds and is "
                  "all that the proof needs.")
def lemma_2() -> Goal:
    """The strict inequality as printed."""
    return _lemma_2(strict=True)


c_low, c_high = sp.symbols("chi_low chi_high", positive=True)
V_rest = e_2**2 / 2 + V_weights + V_estimates
all_squares = e_2**2 + over_neurons(W_tilde**2) + sum((s**2 for s in tildes), sp.Integer(0))


@paper.claim("lemma1.2", "Hypothesis 2 of Lemma 1: V_2 lies between class K-infinity functions", "inequality",
             r"\chi_1(\|e_2\|) \le V_2(e_2) \le \chi_2(\|e_2\|)", "proved", scope=EVERY_NETWORK,
             note="In Theorem 1 V_2 is all of V but V_1, and e_2 stands for (e_2, W_tilde, a_tilde, b_tilde, "
                  "c_tilde). Decided for chi_1 = c_low |.|^2 and chi_2 = c_high |.|^2 with the smallest and "
                  "largest weight.")
def between_comparison_functions() -> Goal:
    """Quadratic bounds of V - V_1."""
    weights = (chi, *lambdas)
    low = (at_most(c_low, sp.Rational(1, 2)), *(at_most(2 * c_low * w, 1) for w in weights))
    high = (at_least(c_high, sp.Rational(1, 2)), *(at_least(2 * c_high * w, 1) for w in weights))
    return Goal((at_least(V_rest, c_low * all_squares), at_most(V_rest, c_high * all_squares)), (*low, *high))


start_error = sp.Symbol("e_1_0", real=True)


@paper.claim("lemma1.0", "The stated initial state is inside the constraint", "condition", r"|e_1(0)| < k", "proved",
             at={start_error: Fraction(0), k: stated_k},
             note="x_1(0) = 0 is stated, and the desired curve starts at 0.")
def starts_inside() -> Goal:
    """At the stated initial state and k."""
    return Goal((less(start_error, k), greater(start_error, -k)))


paper.axiom("lemma1", "Lemma 1: a barrier function that obeys (19) keeps the constraint",
            r"|e_1(0)| < k,\ \dot V \le -\mu V + l \Rightarrow |e_1(t)| < k\ \forall t \ge 0",
            "Ren, Ge, Tee and Lee 2010 (the paper's [28])", hypotheses=("lemma1.0", "20.barrier", "lemma1.2", "51"),
            note="It supposes that solutions exist; with the steps of Table 1 in f they do in Caratheodory's sense.")
