"""What sympy cancels or makes one power of, in goals kept as they are typed: y (x/y), p/sqrt(p) and the like."""

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from typed_goals import proved, require_broken

from workbench.proof.claim import D, Goal, at_least, at_most, equal
from workbench.proof.decide.engine import prove_goal
from workbench.proof.typed import as_typed

x, y = sp.symbols("x y", real=True)
k, p = sp.symbols("k p", positive=True)
TENTH = sp.Rational(1, 10)

TRUE = {
    "a root squared": lambda: Goal((equal(sp.sqrt(p) * sp.sqrt(p), p),)),
    "a power of it": lambda: Goal((equal(sp.sqrt(y) ** 4, y**2),), (at_least(y, 0),)),
    "over a root": lambda: Goal((equal(p / sp.sqrt(p), sp.sqrt(p)),)),
    "over a root that is assumed positive": lambda: Goal((equal(y / sp.sqrt(y), sp.sqrt(y)),), (at_least(y, TENTH),)),
    "of a sum": lambda: Goal((equal((x**2 + p) / sp.sqrt(x**2 + p), sp.sqrt(x**2 + p)),)),
    "finite time": lambda: Goal((at_most(-k * p / (2 * sp.sqrt(p)), -(k / 2) * sp.sqrt(p)),)),
    "a norm squared": lambda: Goal((at_most(-k * sp.sqrt(x**2 + y**2) * sp.sqrt(x**2 + y**2), -k * x**2),)),
    "super-twisting": lambda: Goal((at_most(-k * sp.sqrt(sp.Abs(x)) * sp.Abs(x) - p * x**2, 0),)),
    "its power": lambda: Goal((equal(x * (-k * sp.sqrt(sp.Abs(x)) * sp.sign(x)),
                                     -k * sp.Abs(x) * sp.sqrt(sp.Abs(x))),)),
    "a quotient that cancels": lambda: Goal((equal(y * (k * x / y), k * x),), (at_least(y, TENTH),)),
    "a sum that cancels": lambda: Goal((equal((1 + x) * (k * x / (1 + x)), k * x),), (at_least(1 + x, TENTH),)),
    "a law that inverts the plant": lambda: Goal((equal(D(x**2 / 2), -k * x**2),), (at_least(sp.cos(x), TENTH),),
                                                 {x: sp.cos(x) * (-k * x / sp.cos(x))}),
}
FALSE = {
    "a root that is none": lambda: Goal((equal(sp.sqrt(p) * sp.sqrt(p), sp.sqrt(p)),)),
    "too much": lambda: Goal((equal(p / sp.sqrt(p), p),)),
    "super-twisting the wrong way": lambda: Goal((at_least(-k * sp.sqrt(sp.Abs(x)) * sp.Abs(x) - p * x**2, 0),)),
    "too quick": lambda: Goal((at_most(-k * p / (2 * sp.sqrt(p)), -k * sp.sqrt(p)),)),
}
NOWHERE = {
    "zero below": lambda: Goal((equal(y * (k * x / y), k * x),)),
    "a cosine below": lambda: Goal((equal(sp.cos(x) * (k * x / sp.cos(x)), k * x),)),
    "a negative number below the root": lambda: Goal((equal(sp.sqrt(y) * sp.sqrt(y), y),)),
    "zero below the root that divides": lambda: Goal((equal(y / sp.sqrt(y), sp.sqrt(y)),), (at_least(y, 0),)),
}


@pytest.mark.parametrize("goal", TRUE.values(), ids=TRUE)
def test_what_sympy_makes_one_of_the_checker_is_shown(goal):
    proved(goal)


@pytest.mark.parametrize("goal", FALSE.values(), ids=FALSE)
def test_what_is_false_of_it_is_broken(goal):
    require_broken(goal)


@pytest.mark.parametrize("goal", NOWHERE.values(), ids=NOWHERE)
def test_what_has_no_value_somewhere_is_not_proved(goal):
    with as_typed():
        stated = goal()
    assert prove_goal(stated) is None


@settings(max_examples=15, deadline=None)
@given(st.integers(1, 4), st.integers(0, 4), st.fractions("1/3", 5, max_denominator=3))
def test_with_any_powers(above, below, number):
    """(sqrt(p))**a / (sqrt(p))**b is the power (a - b)/2 of p, written by whole powers and one root."""
    with as_typed():
        root = sp.sqrt(number * p)
        whole, rest = divmod(above - below, 2)
        stated = Goal((equal(root**above / root**below, (number * p) ** whole * root**rest),))
        wrong = Goal((equal(root**above / root**below, 2 * (number * p) ** whole * root**rest),))
    assert prove_goal(stated) is not None
    assert prove_goal(wrong) is None
