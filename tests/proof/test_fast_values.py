"""Values that deciders look at: on tapes as numpy has them, modulo a prime as algebra has them, exact as sympy has
them; and margins that grow."""

from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.proof.checker import check
from workbench.proof.claim import Goal, at_least, at_most
from workbench.proof.decide import growth
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.exact_values import exact_function
from workbench.proof.decide.method import method_of
from workbench.proof.decide.tape import Tape
from workbench.proof.decide.vanishing import vanishes

x, y, a = sp.symbols("x y a", real=True)
p = sp.Symbol("p", positive=True)
s = sp.Symbol("s", nonnegative=True)
NUMBERS = st.fractions(-4, 4, max_denominator=6)
LEAVES = st.one_of(st.sampled_from([x, y, p]), NUMBERS.map(lambda q: sp.Rational(q.numerator, q.denominator)))
RATIONAL = st.recursive(LEAVES, lambda inner: st.one_of(
    st.tuples(inner, inner).map(lambda t: t[0] + t[1]), st.tuples(inner, inner).map(lambda t: t[0] * t[1]),
    st.tuples(inner, st.integers(2, 3)).map(lambda t: t[0] ** t[1]), inner.map(lambda e: e / (p + e**2))), max_leaves=4)
ANY = st.recursive(RATIONAL, lambda inner: st.one_of(
    *(inner.map(f) for f in (sp.tanh, sp.Abs, sp.sign)), inner.map(lambda e: sp.sqrt(1 + e**2)),
    inner.map(lambda e: sp.log(1 + e**2)), inner.map(lambda e: sp.exp(-e**2)),
    st.tuples(inner, inner).map(lambda t: sp.Max(t[0], t[1])),
    st.tuples(inner, inner).map(lambda t: sp.Min(t[0], t[1]))),
    max_leaves=3)


@settings(max_examples=15)
@given(ANY, st.integers(0, 1000))
def test_a_tape_gives_what_sympy_evaluates(expr, seed):
    columns = np.abs(np.random.default_rng(seed).normal(size=(3, 4))) + 0.1
    (values,) = Tape((x, y, p), (expr,))(*columns)
    values = np.broadcast_to(values, (4,))
    for place in range(4):
        exact = expr.subs(dict(zip((x, y, p), map(sp.Float, columns[:, place]), strict=True)))
        assert values[place] == pytest.approx(float(exact), rel=1e-9, abs=1e-9)


def test_sizes_are_the_sums_of_the_terms_sizes():
    value, size = Tape((x, y), (x - 2 * y,), sizes=True)(np.array([3.0]), np.array([5.0]))
    assert (value[0], size[0]) == (-7.0, 13.0)


@settings(max_examples=15)
@given(RATIONAL, RATIONAL)
def test_what_vanishes_is_what_algebra_cancels(one, two):
    product = one * two + one
    assert vanishes(product - sp.expand(product))
    assert vanishes(one - two) == (sp.cancel(sp.together(one - two)) == 0)


def test_functions_are_numbers_of_their_own_and_powers_of_exp_are_related():
    assert vanishes(sp.log(x)**2 - sp.log(x) * sp.log(x))
    assert not vanishes(sp.log(x) - sp.log(y))
    assert vanishes(sp.exp(x, evaluate=False)**2 - sp.exp(2 * x))
    assert not vanishes(sp.exp(x) - 1)


@settings(max_examples=15)
@given(RATIONAL, NUMBERS, NUMBERS, NUMBERS.filter(bool))
def test_exact_values_are_those_of_sympy(expr, one, two, three):
    at = {"x": one, "y": two, "p": three}
    here = expr.xreplace({symbol: sp.Rational(at[str(symbol)].numerator, at[str(symbol)].denominator)
                          for symbol in (x, y, p)})
    expected = Fraction(int(here.p), int(here.q)) if here.is_Rational else None
    assert exact_function(expr)(at) == expected


GROWING = {
    "second order of exp": Goal((at_least(sp.exp(s), 1 + s + s**2 / 2),)),
    "from a start of its own": Goal((at_least(sp.exp(y - a), 1 + (y - a) + (y - a)**2 / 2),), (at_least(y, a),)),
    "tanh below its argument": Goal((at_most(sp.tanh(s), s),)),
}


@pytest.mark.parametrize("name", GROWING)
def test_a_margin_that_grows_is_proved(name):
    certificate = prove_goal(GROWING[name])
    assert method_of(certificate["proofs"]) == "a margin that grows"
    check(certificate)


def test_a_margin_that_grows_from_below_is_not_proved():
    from_below = Goal((at_least(sp.exp(s), 1 + 2 * s),))
    assert growth.find_by_growth(from_below, from_below.show[0], ()) is None
