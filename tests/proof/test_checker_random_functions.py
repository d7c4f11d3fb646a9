"""abs, sign, sqrt, Max, Min and tanh in the checker: random tries, against values computed apart from it."""

from fractions import Fraction

import pytest
from function_certificates import FACTS, fact
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from plain_values import CLOSE, COUNT, FAILURES, TooLargeError, UndefinedError, mp, points, reading, value

from workbench.proof.checker import (
    CertificateError,
    Context,
    Relations,
    _factor,
    bounds,
    number,
    sqrt_bounds,
    substitute,
    symbol,
)

LEAVES, OF_AN_INDEX = ("0", "1", "2", "1/2", "x", "y", "z"), ("V", "W")
ONE_PLACE = ("-({})", "({})**2", "({})**(-1)", "abs({})", "sign({})", "sqrt({})", "sqrt(({})**2)", "log({})", "exp({})",
             "tanh({})", "exp(2*log({}))")
TWO_PLACES = ("({}) + ({})", "({}) - ({})", "({})*({})", "({})/({})", "Max({}, {})", "Min({}, {})",
              "exp(log({}) + ({}))", "sqrt(({})**2*({})**2)")
ASSUMED = ("x > 0", "y >= 0", "z != 0", "x >= y", "abs(y) > 0", "Sum(W**2) > 0", "Sum(V) >= 0", "x*y > 0",
           "abs(x) - x > 0", "sqrt(x) >= y", "sign(z) > 0", "Sum(1) > 0")


def expressions(depth, indexed=False):
    """Texts of the certificate language; sums may stand anywhere, also where the checker must refuse them."""
    leaves = st.sampled_from(LEAVES + OF_AN_INDEX * indexed)
    if depth == 0:
        return leaves
    part, term = expressions(depth - 1, indexed), expressions(depth - 1, True)
    return st.one_of(
        leaves, st.tuples(st.sampled_from(ONE_PLACE), part).map(lambda p: p[0].format(p[1])),
        st.tuples(st.sampled_from(TWO_PLACES), part, part).map(lambda p: p[0].format(*p[1:])),
        term.map("Sum({})".format), term.map("sqrt(Sum(({})**2))".format))


ANY = expressions(3)
GIVEN = st.lists(st.sampled_from(ASSUMED), max_size=2, unique=True)
SEEDS = st.integers(0, 10**9)
MANY = settings(max_examples=125)


def read(context, text):
    try:
        return context.read(text)
    except CertificateError:
        assume(False)


@MANY
@given(ANY, SEEDS)
def test_reading_keeps_the_value_for_every_number_of_neurons(text, seed):
    context = Context({}, ["V", "W"])
    ratio = read(context, text)
    for point in points(seed):
        try:
            expected = value(text, point)
        except FAILURES:
            continue
        try:
            found = reading(context, ratio, point)
        except UndefinedError:  # what all terms share is written once, also where there is no term
            assert point[COUNT] == 0
            continue
        assert abs(found - expected) <= CLOSE * (1 + abs(expected))


@MANY
@given(ANY, GIVEN, SEEDS)
def test_what_is_shown_to_be_defined_is_defined(text, assumed_relations, seed):
    context = Context({}, ["V", "W"])
    given_relations = Relations(context, [])
    try:
        given_relations.assume(assumed_relations)
        given_relations.require_defined(text)
        ratio = context.read(text)
    except CertificateError:
        assume(False)
    signs = [wanted for wanted in ("positive", "non-zero", "non-negative") if given_relations.fits(ratio, wanted)]
    for point in points(seed, assumed_relations):
        try:
            found = value(text, point)
        except TooLargeError:
            continue
        assert found > 0 or "positive" not in signs
        assert found != 0 or "non-zero" not in signs
        assert found > -CLOSE or "non-negative" not in signs


@MANY
@given(st.sampled_from(FACTS), ANY, GIVEN, SEEDS)
def test_facts_hold_wherever_they_are_used(name, text, assumed_relations, seed):
    context = Context({}, ["V", "W"])
    try:
        given_relations = Relations(context, assumed_relations)
        ratio, sign = _factor(given_relations, fact(name, text))
    except CertificateError:
        assume(False)
    for point in points(seed, assumed_relations):
        try:
            found = reading(context, ratio, point)
            size = 1 if name == "enclosure" else 1 + abs(value(text, point)) ** 2  # of a number, whatever cancelled
        except TooLargeError:
            continue
        assert {">": found > 0, ">=": found >= -CLOSE * size, "==": abs(found) <= CLOSE * size}[sign]


@MANY
@given(ANY, expressions(2), SEEDS)
def test_substitution_is_that_of_values(text, replacement, seed):
    context = Context({}, ["V", "W"])
    ratio, put = read(context, text), read(context, replacement)
    try:
        replaced = substitute(context, ratio, {"x": put})
    except CertificateError:
        assume(False)
    for point in points(seed):
        try:
            there = point | {"x": reading(context, put, point)}
            expected = reading(context, ratio, there)
            assert abs(reading(context, replaced, point) - expected) <= CLOSE * (1 + abs(expected))
        except FAILURES:
            continue


@MANY
@given(ANY, SEEDS)
def test_bounds_enclose_the_value_at_a_point(text, seed):
    """One neuron at the point, which is what a point of a certificate means."""
    context = Context({}, ["V", "W"])
    ratio = read(context, text)
    for point in points(seed, ["Sum(1) == 1"], most=2):
        exact = {name: number(Fraction(str(v[0] if isinstance(v, list) else v))) for name, v in point.items()
                 if name in ("x", "y", "z", "V", "W")}
        try:
            low, high = bounds(context, substitute(context, ratio, exact))
            expected = value(text, point)
        except (CertificateError, *FAILURES):
            continue
        slack = mp.mpf(10) ** -25 * (1 + abs(expected))
        assert to_mp(low) - slack <= expected <= to_mp(high) + slack


def to_mp(x):
    return mp.mpf(x.numerator) / x.denominator


FRACTIONS = st.fractions(min_value=-10**6, max_value=10**6, max_denominator=10**9)


@given(FRACTIONS, FRACTIONS, st.fractions(min_value=0, max_value=1))
def test_abs_and_sign_are_enclosed_tightly(one, other, share):
    low, high = sorted((one, other))
    inside = low + share * (high - low)
    for name, true in (("abs", abs), ("sign", lambda v: (v > 0) - (v < 0))):
        context = Context({}, [])
        below, above = bounds(context, context.call(name, symbol("x")), {"x": (low, high)})
        assert below <= true(inside) <= above
        assert {below, above} <= {Fraction(true(v)) for v in (low, high, *([Fraction(0)] if low <= 0 <= high else []))}


@given(st.fractions(min_value=0, max_value=10**12, max_denominator=10**12) | st.sampled_from(
    [Fraction(0), Fraction(1, 10**90), Fraction(10**90 + 1), Fraction(10**80 - 1, 10**80)]))
def test_sqrt_is_enclosed_exactly(x):
    low, high = sqrt_bounds(x)
    assert 0 <= low**2 <= x <= high**2
    assert high - low <= Fraction(1, 10**39)
    assert sqrt_bounds(x * x) == (x, x)


@pytest.mark.parametrize("x", [Fraction(-1), Fraction(-1, 10**60)])
def test_sqrt_of_what_is_negative_is_refused(x):
    with pytest.raises(CertificateError, match="sqrt of a negative"):
        sqrt_bounds(x)
