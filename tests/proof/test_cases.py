"""Which statements with abs, sign, saturation, roots and tanh the deciders prove, and which they must not."""

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import check
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less, saturation
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.text import goal_text

x, y, z, g, h, low, high, d = sp.symbols("x y z g h low high d", real=True)
kappa, p, c_1, c_2, c_3 = sp.symbols("kappa p c_1 c_2 c_3", positive=True)
bound, phi = sp.symbols("bound phi", nonnegative=True)
j, n = sp.Symbol("j", integer=True), sp.Symbol("n", integer=True, positive=True)
W = sp.IndexedBase("W", real=True)[j]
constant = sp.Rational(557, 2000)  # 0.2785, a little more than the root of c = exp(-(1 + c))


def total(term):
    return sp.Sum(term, (j, 1, n))


def tanh_lemma(c):
    facts = tuple(turn * 2 * x / kappa + sp.log(constant) for turn in (1, -1))
    return Goal((at_most(sp.Abs(x) - x * sp.tanh(x / kappa), c * kappa),), facts=facts)


TRUE = {
    "triangle": Goal((at_most(sp.Abs(x + y), sp.Abs(x) + sp.Abs(y)),)),
    "reverse triangle": Goal((at_most(sp.Abs(sp.Abs(x) - sp.Abs(y)), sp.Abs(x - y)),)),
    "a root of a size, signed": Goal((at_most(D(x**2 / 2), -p * sp.Abs(x) ** sp.Rational(3, 2)),),
                                     flow={x: -p * sp.sqrt(sp.Abs(x)) * sp.sign(x)}),
    "the same with a linear term": Goal((equal(D(x**2), -2 * p * sp.Abs(x) ** sp.Rational(3, 2) - 2 * kappa * x**2),),
                                        flow={x: -p * sp.sqrt(sp.Abs(x)) * sp.sign(x) - kappa * x}),
    "a root of a size of a sum": Goal((equal((x + y) * sp.sqrt(sp.Abs(x + y)) * sp.sign(x + y),
                                             sp.Abs(x + y) ** sp.Rational(3, 2)),)),
    "what is below a barrier's logarithm": Goal(
        (equal(D(sp.log((1 + x / p) / (1 - x / p))), -2 * kappa * x / (p * (1 - x**2 / p**2))),), (less(x**2, p**2),),
        flow={x: -kappa * x, p: sp.S.Zero}),
    "a barrier's two walls": Goal((at_least(1 / (p - x) + 1 / (p + x), 2 / p),), (less(3 * x**2, 3 * p**2),)),
    "sign and size": Goal((equal(x * sp.sign(x), sp.Abs(x)),)),
    "a switched term beats a bounded disturbance": Goal((at_most(-bound * z * sp.sign(z) + z * d, 0),),
                                                        (at_most(sp.Abs(d), bound),)),
    "the same along a flow": Goal((at_most(D(z**2), 0),), (at_most(sp.Abs(d), bound),),
                                  flow={z: -bound * sp.sign(z) + d}),
    "projection": Goal((at_most((g - saturation(g, low, high)) * (h - saturation(g, low, high)), 0),),
                       (at_most(low, h), at_most(h, high))),
    "saturation keeps the limits": Goal((at_least(saturation(g, low, high), low), at_most(
        saturation(g, low, high), high)), (at_most(low, high),)),
    "the least of two rates": Goal((at_most(-c_1 * x**2 - c_2 * y**2, -sp.Min(c_1, c_2) * (x**2 + y**2)),)),
    "the least of three rates": Goal((at_most(-c_1 * x**2 - c_2 * y**2 - c_3 * z**2,
                                              -sp.Min(c_1, c_2, c_3) * (x**2 + y**2 + z**2)),)),
    "a norm is below the sum of sizes": Goal((at_most(sp.sqrt(x**2 + y**2), sp.Abs(x) + sp.Abs(y)),)),
    "a norm from an energy, any dimension": Goal(
        (at_most(sp.sqrt(x**2 + total(W**2)), sp.sqrt(2 * phi)),), (at_most((x**2 + total(W**2)) / 2, phi),)),
    "a case that cannot be": Goal((equal(sp.Abs(x), x),), (greater(x, 0),)),
    "tanh is below one": Goal((less(sp.tanh(x), 1),)),
    "tanh has the sign of its argument": Goal((at_least(x * sp.tanh(x), 0),)),
    "a smooth sign costs at most kappa": Goal((at_most(sp.Abs(x), x * sp.tanh(x / kappa) + kappa),)),
    "a smooth sign costs at most 0.2785 kappa": tanh_lemma(constant),
    "decay": Goal((at_most(sp.exp(-p * x), 1),), (at_least(x, 0),)),
    "numbers": Goal((less(sp.log(2) + sp.sqrt(2), sp.Rational(211, 100)), greater(sp.exp(1), sp.Rational(27, 10)))),
}
FALSE = {
    "triangle turned": Goal((at_least(sp.Abs(x + y), sp.Abs(x) + sp.Abs(y)),)),
    "a disturbance beyond the bound": Goal((at_most(-bound * z * sp.sign(z) + 2 * z * d, 0),),
                                           (at_most(sp.Abs(d), bound),)),
    "projection of a point outside": Goal(
        (at_most((g - saturation(g, low, high)) * (h - saturation(g, low, high)), 0),), (at_most(low, h),)),
    "the greatest of two rates": Goal((at_most(-c_1 * x**2 - c_2 * y**2, -sp.Max(c_1, c_2) * (x**2 + y**2)),)),
    "a norm from too little": Goal((at_most(sp.sqrt(x**2 + y**2), (sp.Abs(x) + sp.Abs(y)) / 2),)),
    "a smooth sign costs less than 0.27 kappa": tanh_lemma(sp.Rational(27, 100)),
    "a root of a size, as if it were no less than the size": Goal(
        (at_most(D(x**2 / 2), -p * x**2),), flow={x: -p * sp.sqrt(sp.Abs(x)) * sp.sign(x)}),
    "sign of zero is not one": Goal((equal(sp.sign(x) ** 2, 1),)),
}


@pytest.mark.parametrize("name", TRUE)
def test_true_statements_are_proved(name):
    found = prove_goal(TRUE[name])
    assert found is not None
    check(found)
    assert find_counterexample(TRUE[name], "refuted") is None


@pytest.mark.parametrize("name", FALSE)
def test_false_statements_are_refuted_at_a_point(name):
    found = find_counterexample(FALSE[name], "refuted")
    assert found is not None
    check(found)


def test_the_goal_is_written_with_the_functions_by_name():
    right = sp.sqrt(x**2 + 1) * sp.tanh(x) + sp.Abs(sp.sign(x) - y)
    record = goal_text(Goal((at_most(saturation(g, 0, high), right),)))
    assert record["show"] == ["Min(Max(0, g), high) <= sqrt(1 + x**2)*tanh(x) + abs(y - sign(x))"]


@pytest.mark.parametrize("expr", [sp.Abs(x), sp.sign(x), sp.Max(x, y), saturation(x, 0, 1)])
def test_what_has_no_derivative_everywhere_is_not_derived(expr):
    goal = Goal((at_most(D(expr * z), z),), flow={x: y})
    with pytest.raises(ClaimError, match="no derivative everywhere"):
        prove_goal(goal)
