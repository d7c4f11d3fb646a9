"""The checker's arithmetic against sympy's and mpmath's."""

from fractions import Fraction

import mpmath
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.proof.checker import (
    CertificateError,
    Context,
    circle_bounds,
    divide_exactly,
    exp_bounds,
    log_bounds,
    multiply,
    same,
)
from workbench.proof.checker import substitute as substitute_ratio
from workbench.proof.text import text

X, Y, Z = sp.symbols("x y z", positive=True)
RATE = {"x": "y*z - 2", "y": "x**2/3"}


def leaves():
    numbers = st.integers(-3, 3).map(sp.Integer) | st.sampled_from([sp.Rational(1, 2), sp.Rational(-5, 3)])
    return numbers | st.sampled_from([X, Y, Z])


def combine(inner):
    return (st.tuples(inner, inner).map(lambda p: sp.Add(*p, evaluate=False))
            | st.tuples(inner, inner).map(lambda p: sp.Mul(*p, evaluate=False))
            | st.tuples(inner, st.integers(0, 3)).map(lambda p: sp.Pow(*p, evaluate=False)))


polynomials = st.recursive(leaves(), combine, max_leaves=6)
positives = polynomials.map(lambda p: 1 + p**2)
rationals = st.tuples(polynomials, positives).map(lambda p: p[0] / p[1])
with_functions = st.tuples(rationals, positives, polynomials).map(lambda p: p[0] * sp.log(p[1]) + sp.exp(p[2] / p[1]))
settings.register_profile("few", derandomize=True, deadline=None, max_examples=40)
FEW = settings(settings.get_profile("few"))


def to_sympy(context, ratio):
    """A Ratio as a sympy expression, its atoms spelled out."""
    def atom(name):
        if name in context.functions:
            kind, argument = context.functions[name]
            return {"log": sp.log, "exp": sp.exp}[kind](to_sympy(context, argument))
        return {"x": X, "y": Y, "z": Z}[name]

    def poly(p):
        return sp.Add(*(sp.Rational(c.numerator, c.denominator) * sp.Mul(*(atom(a) ** n for a, n in m))
                        for m, c in p.items()))

    return poly(ratio.num) / poly(ratio.den)


def agree(one, two):
    """Whether two expressions have the same value, to 30 digits, at a few points off the beaten track."""
    for seed in (1, 2, 3):
        at = {s: sp.Rational(7 * i + 11 * seed, 13 + i * seed) for i, s in enumerate((X, Y, Z), 1)}
        a, b = sp.N(one.subs(at), 60), sp.N(two.subs(at), 60)
        if abs(a - b) > sp.Float("1e-30", 60) * (1 + abs(a)):
            return False
    return True


@FEW
@given(with_functions)
def test_reading_keeps_the_value(expr):
    context = Context({}, [])
    assert agree(to_sympy(context, context.read(text(expr))), expr)


@FEW
@given(rationals, rationals)
def test_sums_products_and_equality_of_rational_functions(a, b):
    context = Context({}, [])
    one, two = context.read(text(a)), context.read(text(b))
    assert agree(to_sympy(context, one + two), a + b)
    assert agree(to_sympy(context, one * two), a * b)
    assert same(one, two) == (sp.cancel(a - b) == 0)


@FEW
@given(polynomials, positives)
def test_exact_division_undoes_multiplication(a, b):
    context = Context({}, [])
    one, two = context.read(text(a)).num, context.read(text(b)).num
    assert divide_exactly(multiply(one, two), two) == one


@FEW
@given(with_functions.filter(lambda expr: expr.free_symbols & {X, Y}))  # D of what does not move is refused
def test_derivative_along_a_flow(expr):
    context = Context(RATE, [])
    expected = sp.diff(expr, X) * (Y * Z - 2) + sp.diff(expr, Y) * X**2 / 3
    assert agree(to_sympy(context, context.read(f"D({text(expr)})")), expected)


@FEW
@given(with_functions, polynomials)
def test_substitution_reaches_into_functions(expr, value):
    context = Context({}, [])
    replaced = substitute_ratio(context, context.read(text(expr)), {"x": context.read(text(1 + value**2))})
    assert agree(to_sympy(context, replaced), expr.subs(X, 1 + value**2))


@given(st.fractions(min_value=-60, max_value=60, max_denominator=10**6))
def test_exp_is_enclosed_tightly(x):
    low, high = exp_bounds(x)
    with mpmath.workdps(60):
        true = mpmath.exp(mpmath.mpf(x.numerator) / x.denominator)
        assert mpmath.mpf(low.numerator) / low.denominator <= true * (1 + mpmath.mpf(10) ** -55)
        assert mpmath.mpf(high.numerator) / high.denominator >= true * (1 - mpmath.mpf(10) ** -55)
    assert high - low <= Fraction(1, 10**20) * high


@given(st.fractions(min_value=Fraction(1, 10**9), max_value=10**9, max_denominator=10**9).filter(lambda x: x > 0))
def test_log_is_enclosed_tightly(x):
    low, high = log_bounds(x)
    with mpmath.workdps(60):
        true = mpmath.log(mpmath.mpf(x.numerator) / x.denominator)
        slack = mpmath.mpf(10) ** -50
        assert mpmath.mpf(low.numerator) / low.denominator <= true + slack
        assert mpmath.mpf(high.numerator) / high.denominator >= true - slack
    assert high - low <= Fraction(1, 10**25)


@given(st.fractions(min_value=-40, max_value=40, max_denominator=10**9),
       st.fractions(min_value=0, max_value=Fraction(1, 10), max_denominator=10**9), st.sampled_from(["sin", "cos"]))
def test_sine_and_cosine_are_enclosed_wherever_the_angle_lies(x, width, name):
    low, high = circle_bounds(name, x, x + width)
    for angle in (x, x + width / 3, x + width):
        with mpmath.workdps(60):
            true, slack = getattr(mpmath, name)(mpmath.mpf(angle.numerator) / angle.denominator), mpmath.mpf(10) ** -50
            assert mpmath.mpf(low.numerator) / low.denominator <= true + slack
            assert mpmath.mpf(high.numerator) / high.denominator >= true - slack
    assert -1 <= low <= high <= 1
    if abs(x) <= 32:
        assert high - low <= 2 * width + Fraction(1, 10**25)


@pytest.mark.parametrize("x", [Fraction(0), Fraction(-1), Fraction(-1, 10**30)])
def test_log_of_what_is_not_positive_is_refused(x):
    with pytest.raises(CertificateError):
        log_bounds(x)


def test_exp_of_zero_is_one():
    assert exp_bounds(Fraction(0)) == (1, 1)
    low, high = exp_bounds(Fraction(1))
    assert low <= Fraction(271828182845904523536028748, 10**26)
    assert high >= Fraction(271828182845904523536028747, 10**26)
