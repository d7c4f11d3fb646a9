"""The sine beside its argument, within a sector: pendulums, droop, oscillators."""

import pytest
import sympy as sp
from typed_goals import proved, require_broken

from workbench.proof.claim import D, Goal, at_least, at_most, differ, greater

x, y, d = sp.symbols("x y d", real=True)
k, p = sp.symbols("k p", positive=True)


def within(bound):
    return at_most(sp.Abs(x), bound)


TRUE = {
    "a quarter turn": lambda: Goal((at_least(x * sp.sin(x), 0),), (within(sp.pi / 2),)),
    "two sides": lambda: Goal((at_least(x * sp.sin(x), 0),), (at_most(x, 2), at_least(x, -2))),
    "by squares": lambda: Goal((at_least(x * sp.sin(x), 0),), (at_most(x**2, 4),)),
    "a sector": lambda: Goal((at_least(x * sp.sin(x), x**2 / 2),), (within(sp.Rational(3, 2)),)),
    "not zero": lambda: Goal((greater(x * sp.sin(x), 0),), (within(sp.Rational(3, 2)), differ(x, 0))),
    "beside others": lambda: Goal((at_most(-k * x * sp.sin(x) - p * y**2, 0),), (within(sp.pi / 2),)),
    "a rate": lambda: Goal((at_most(D(x**2 / 2), 0),), (within(sp.pi / 2),), {x: -k * sp.sin(x)}),
    "a rate with a disturbance": lambda: Goal(
        (at_most(D(x**2 / 2), -k * x**2 / 2 + sp.Abs(x) * p),), (within(sp.Rational(3, 2)), at_most(sp.Abs(d), p)),
        {x: -k * sp.sin(x) + d, d: 0}),
}
FALSE = {
    "more than the sine": lambda: Goal((at_least(x * sp.sin(x), x**2),), (within(sp.Rational(3, 2)),)),
    "beyond half a turn": lambda: Goal((at_least(x * sp.sin(x), 0),), (within(4),)),
    "a wide sector": lambda: Goal((at_least(x * sp.sin(x), x**2 / 2),), (within(sp.Rational(5, 2)),)),
}


@pytest.mark.parametrize("goal", TRUE.values(), ids=TRUE)
def test_the_sine_has_the_sign_of_its_argument_near_zero(goal):
    proved(goal)


@pytest.mark.parametrize("goal", FALSE.values(), ids=FALSE)
def test_what_is_false_of_it_is_broken(goal):
    require_broken(goal)
