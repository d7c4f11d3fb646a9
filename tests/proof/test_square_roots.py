"""Roots of squares, of which sympy makes sizes, in goals kept as they are typed; smooth switching beside them."""

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from typed_goals import proved, require_broken

from workbench.proof.claim import D, Goal, at_least, at_most, equal
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.typed import as_typed

s, d, e_1, e_2 = sp.symbols("s d e_1 e_2", real=True)
k, c, L, eps = sp.symbols("k c L epsilon", positive=True)
two, flow = sp.Integer(2), {s: -k * sp.sign(s)}
smooth, pushed = {s: d - k * sp.tanh(s / eps)}, (at_most(sp.Abs(d), L),)
ROUNDED = sp.Rational(2785, 10000)


def root_of_energy(gain):
    """The reaching law of finite time, as sliding mode papers print it: V' <= -gain sqrt(2) sqrt(V)."""
    return Goal((at_most(D(s**2 / 2), -gain * sp.sqrt(two) * sp.sqrt(s**2 / 2)),), flow=flow)


TRUE = {
    "finite time": lambda: root_of_energy(k),
    "of a surface": lambda: Goal((at_most(D((e_2 + c * e_1) ** 2 / 2),
                                          -k * sp.sqrt(two) * sp.sqrt((e_2 + c * e_1) ** 2 / 2)),),
                                 flow={e_1: e_2, e_2: -c * e_2 - k * sp.sign(e_2 + c * e_1)}),
    "with a decay": lambda: Goal((at_most(-k * sp.Abs(s) - c * s**2,
                                          -k * sp.sqrt(two) * sp.sqrt(s**2 / 2) - 2 * c * (s**2 / 2)),)),
    "of a square": lambda: Goal((equal(sp.sqrt(s**2), sp.Abs(s)),)),
    "less than the size": lambda: Goal((at_most(sp.sqrt(4 * s**2 / 9), sp.Abs(s)),)),
    "two of them": lambda: Goal((equal(sp.sqrt(e_1**2 / 3) * sp.sqrt(e_2**2 / 3), sp.Abs(e_1) * sp.Abs(e_2) / 3),)),
}
FALSE = {
    "too quick": lambda: root_of_energy(2 * k),
    "a size without its sign": lambda: Goal((equal(sp.sqrt(s**2), s),)),
    "more than the size": lambda: Goal((at_least(sp.sqrt(4 * s**2 / 9), sp.Abs(s)),)),
}


@pytest.mark.parametrize("goal", TRUE.values(), ids=TRUE)
def test_a_root_of_a_square_is_a_size_to_the_checker_too(goal):
    assert "sqrt(" in str(proved(goal)["goal"]["show"])


@pytest.mark.parametrize("goal", FALSE.values(), ids=FALSE)
def test_what_is_false_of_it_is_broken(goal):
    require_broken(goal)


@pytest.mark.parametrize("goal", [
    lambda: Goal((at_most(1 / sp.sqrt(s**2), 1),), (at_least(s**2, 1),)),
    lambda: Goal((at_most((s**2) ** sp.Rational(-3, 2), 1),), (at_least(s**2, 1),)),
    lambda: Goal((equal(s**2 / sp.sqrt(s**2), sp.Abs(s)),), (at_least(s, 1),)),
    lambda: Goal((at_most(sp.exp(-sp.sqrt(s**2)), 1),)),
    lambda: Goal((at_most(sp.sqrt(sp.pi * s**2), 2 * sp.Abs(s)),)),
    lambda: Goal((at_most(sp.exp(-sp.sqrt(s**2 + d**2)) / sp.sqrt(s**2 + d**2), 1),), (at_least(s**2 + d**2, 1),))],
    ids=["below", "below, cubed", "of a product", "in a function", "of pi", "a length in a function"])
def test_roots_where_none_is_told_apart_end_no_search(goal):
    """They are decided or not, as before: what the checker has not accepted is no proof."""
    with as_typed():
        stated = goal()
    certificate = prove_goal(stated)
    assert certificate is None or certificate["verdict"] == "proved"
    assert find_counterexample(stated, "refuted", quick=True) is None


@settings(max_examples=12, deadline=None)
@given(st.fractions(min_value="1/9", max_value=9, max_denominator=9), st.fractions(0, 5, max_denominator=3))
def test_with_any_numbers(number, factor):
    with as_typed():
        goal = Goal((at_most(factor * sp.sqrt(sp.Rational(number) * s**2), 9 * factor * sp.Abs(s)),))
    assert prove_goal(goal) is not None


def test_smooth_switching_costs_what_papers_say():
    goal = Goal((at_most(D(s**2 / 2), -(k - L) * sp.Abs(s) + ROUNDED * k * eps),), assume=pushed, flow=smooth,
                inputs=(d,))
    assert prove_goal(goal) is not None


def test_a_smaller_cost_is_broken():
    goal = Goal((at_most(D(s**2 / 2), -(k - L) * sp.Abs(s) + sp.Rational(27, 100) * k * eps),), assume=pushed,
                flow=smooth, inputs=(d,))
    assert find_counterexample(goal, "refuted") is not None
