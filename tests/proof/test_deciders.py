"""What deciders prove is true: random statements whose truth is known otherwise."""

from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from independent import Evaluated

from workbench.proof.checker import check
from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, greater, less
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.refute import find_counterexample

x, y = sp.symbols("x y", real=True)
p, q = sp.symbols("p q", positive=True)
FEW = settings(max_examples=15)
whole = st.integers(-3, 3)


@FEW
@given(a=st.integers(1, 4), sign=st.sampled_from([1, -1]), c=whole, weight=st.sampled_from([1, p, p * q, p / q]))
def test_a_weighted_square_is_proved(a, sign, c, weight):
    """a weight (x + y)^2 + c^2 p y^2 >= 0 and the like with a minus, multiplied out."""
    goal = Goal((at_least(sp.expand(a * weight * (x + sign * y) ** 2 + c**2 * p * y**2), 0),))
    assert prove_goal(goal) is not None


@FEW
@given(a=st.integers(1, 5), more=st.integers(0, 5))
def test_youngs_inequality_with_a_parameter_is_proved(a, more):
    """2 a x y <= (a + more) p x^2 + a y^2 / p for every p > 0."""
    goal = Goal((at_most(2 * a * x * y, (a + more) * p * x**2 + a * y**2 / p),))
    assert prove_goal(goal) is not None


@FEW
@given(a=st.integers(1, 4), b=whole, c=st.integers(-4, 4))
def test_an_indefinite_form_is_refuted_and_not_proved(a, b, c):
    assume(b * b > a * c)
    goal = Goal((at_least(a * x**2 + 2 * b * x * y + c * y**2, 0),))
    assert prove_goal(goal) is None
    assert find_counterexample(goal, "refuted") is not None


@settings(max_examples=5)
@given(k=st.integers(1, 9), below=st.integers(1, 50))
def test_a_constant_that_is_a_little_too_small_is_not_proved(k, below):
    """x y <= k (x^2 + y^2)/2 for k >= 1 only; the tight case is true, anything less is false."""
    tight = Fraction(1) if k == 1 else Fraction(k)
    assert prove_goal(Goal((at_most(x * y, sp.Rational(tight) * (x**2 + y**2) / 2),))) is not None
    short = sp.Rational(10**below - 1, 10**below)
    assert prove_goal(Goal((at_most(x * y, short * (x**2 + y**2) / 2),))) is None


relations = st.sampled_from(["<=", "<", ">=", ">", "=="])
monomials = st.sampled_from([sp.Integer(1), x, y, x * y, x**2, y**2, p, p * x, p * x**2, x**2 / p, 1 / p,
                             sp.log(p), sp.exp(x), sp.exp(-x), sp.log(1 + p)])
expressions = st.lists(st.tuples(st.sampled_from([-2, -1, 1, 2, sp.Rational(1, 2)]), monomials), min_size=1,
                       max_size=3).map(lambda terms: sp.Add(*(c * m for c, m in terms)))
conditions = st.lists(st.sampled_from([greater(x, 0), at_least(y, x), at_most(x, 1), less(p, 1), equal(y, 2 * x),
                                       at_least(x * y, 1)]), max_size=2, unique_by=str).map(tuple)


@settings(max_examples=20)
@given(left=expressions, operator=relations, right=expressions, given_=conditions, seed=st.integers(0, 10**6))
def test_whatever_is_proved_holds_at_random_points(left, operator, right, given_, seed):
    """Twenty statements of these; many more, made of the claims themselves, are those of test_mutants.py."""
    goal = Goal((Relation(left, operator, right),), given_)
    # In the engine's order: a proof of what fails at a point that is quickly found would be sought for a long time.
    found = find_counterexample(goal, "refuted", quick=True) or prove_goal(goal) or find_counterexample(goal, "refuted")
    if found is not None and found["verdict"] == "proved":
        check(found)
        assert Evaluated(goal).falsifying_point(seed, batches=2, count=2_000) is None
    elif found is not None and "roots" not in found:  # near a root the equality does not hold
        assert Evaluated(goal, neurons=1).holds_at(found["point"]) == (True, False)


TRUE = {
    "log tangent": Goal((at_most(sp.log(p), p - 1),)),
    "exp tangent": Goal((at_least(sp.exp(x), 1 + x),)),
    "weak sum of strict and weak": Goal((greater(x + y, 0),), (greater(x, 0), at_least(y, 0))),
    "product of positives": Goal((greater(p * q, 0),)),
    "substituted equality": Goal((equal(x**2, 4 * y**2),), (equal(x, 2 * y),)),
    "inverse": Goal((greater(1 / (1 + x**2), 0),), (greater(1 + x**2, 0),)),
}
ALMOST = {
    "log tangent, strict": Goal((less(sp.log(p), p - 1),)),
    "exp tangent, a little more": Goal((at_least(sp.exp(x), 1 + x + x**2 / 2),)),
    "strict sum of weak": Goal((greater(x + y, 0),), (at_least(x, 0), at_least(y, 0))),
    "product of unknown signs": Goal((at_least(x * y, 0),), (greater(x + y, 0),)),
    "root of an equality": Goal((equal(x, 2 * y),), (equal(x**2, 4 * y**2),)),
    "inverse without the sign": Goal((at_most(1 / (1 + x), 1),), (greater(x, -1),)),
}


@pytest.mark.parametrize("name", TRUE)
def test_true_statement_is_proved(name):
    assert prove_goal(TRUE[name]) is not None


def test_a_positive_denominator_of_a_positive_symbol_ends():
    """The rewriting of 1/(1 + p) once went round for ever; whether it is proved is another matter."""
    goal = Goal((at_most(1 / (1 + p), 1),), (greater(1 + p, 0),))
    assert find_counterexample(goal, "refuted") is None
    prove_goal(goal)


@pytest.mark.parametrize("name", ALMOST)
def test_almost_true_statement_is_not_proved(name):
    assert prove_goal(ALMOST[name]) is None
    assert find_counterexample(ALMOST[name], "refuted") is not None


def test_the_independent_search_finds_what_is_false():
    """The net that the other tests are spread over has no large holes."""
    assert all(Evaluated(goal).falsifying_point(1) is not None for name, goal in ALMOST.items()
               if name not in ("root of an equality", "log tangent, strict", "strict sum of weak"))
    assert all(Evaluated(goal).falsifying_point(1) is None for goal in TRUE.values())
    assert len(Evaluated(ALMOST["product of unknown signs"]).points(np.random.default_rng(1), 500)[0][0]) > 100
