"""Which inequalities the combination decider finds: textbook ones with weights, parameters and denominators."""

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Goal, at_least, at_most, equal, greater, less
from workbench.proof.decide.engine import prove_goal

x, y, z = sp.symbols("x y z", real=True)
p, q = sp.symbols("p q", positive=True)
half = sp.Rational(1, 2)
weights = st.fractions(min_value=-9, max_value=9, max_denominator=7)



def share(expr: sp.Expr) -> sp.Expr:
    """Of class K, and below one."""
    return sp.Abs(expr) / (1 + sp.Abs(expr))


TRUE = {
    "a completed square": Goal((at_least(sp.expand((x + 2 * y) ** 2), 0),)),
    "with a positive factor": Goal((at_least(sp.expand(p * (3 * x - 5 * y) ** 2), 0),)),
    "two squares": Goal((at_least(sp.expand((x - 2 * y) ** 2 + (y - 3 * z) ** 2), 0),)),
    "Young with a parameter": Goal((at_most(x * y, p * x**2 / 2 + y**2 / (2 * p)),)),
    "Young with numbers": Goal((at_most(x * y, 3 * x**2 + y**2 / 12),)),
    "means": Goal((at_most(p * q, (p**2 + q**2) / 2),)),
    "a share is below one": Goal((less(p / (1 + p), 1),)),
    "one over more than one": Goal((at_most(1 / (1 + p), 1),)),
    "a bounded fraction": Goal((at_most(x / (1 + x**2), half),)),
    "a bounded distance": Goal((at_most(share(x - y), share(x - z) + share(z - y)),)),
}
FALSE = {
    "too large a product": Goal((at_most(3 * x * y, x**2 + y**2),)),
    "strict where equality is met": Goal((less(1 / (1 + x**2), 1),)),
    "Young with too small a weight": Goal((at_most(x * y, 3 * x**2 + y**2 / 13),)),
    "a fraction bounded too low": Goal((at_most(x / (1 + x**2), sp.Rational(49, 100)),)),
    "a denominator of either sign": Goal((greater(1 / (1 + x), 0),)),
    "a distance bounded too low": Goal((at_most(share(x - z) + share(z - y), share(x - y)),)),
}


# Squares and products of these are beyond floating point, in which a combination is sought.
BEYOND = {
    "a bound": (Goal((less(x, 10**200),)), None),
    "a bound of a square": (Goal((less(x**2, 10**290),), (at_most(x, 10**150),)), None),
    "a sum of what is large": (Goal((at_least(x + 10**200 * y, 0),), (at_least(x, 0), at_least(y, 0))), True),
}


def test_a_case_in_which_a_term_has_no_value_ends_no_search():
    """Where the sign is 0 its logarithm is none."""
    sign, angle = sp.sign(y), sp.atan(x)
    goal = Goal((equal(sp.log(angle * sign), sp.log(angle) + sp.log(sign)),), (at_most(y**2, x), at_least(y, x)))
    assert prove_goal(goal) is None


@pytest.mark.parametrize("name", BEYOND)
def test_numbers_beyond_floating_point_end_no_search(name):
    goal, holds = BEYOND[name]
    assert (prove_goal(goal) is not None) == bool(holds)


@pytest.mark.parametrize("name", TRUE)
def test_true_inequalities_are_proved(name):
    found = prove_goal(TRUE[name])
    assert found is not None
    check(found)


@pytest.mark.parametrize("name", FALSE)
def test_false_inequalities_are_not(name):
    assert prove_goal(FALSE[name]) is None


@settings(max_examples=20)
@given(a=weights.filter(bool), b=weights, c=weights.filter(bool), d=weights)
def test_any_weighted_square_is_proved_and_no_smaller_one(a, b, c, d):
    square = sp.expand(p * (sp.Rational(a) * x + sp.Rational(b) * y) ** 2)
    assert prove_goal(Goal((at_least(square, 0),))) is not None
    # Just below: along (b, -a) the square vanishes and the rest is negative.
    below = square - p * (sp.Rational(c) * x + sp.Rational(d) * y) ** 2 / 1000 - p * x**2 / 10**6 - p * y**2 / 10**6
    assert prove_goal(Goal((at_least(sp.expand(below), 0),))) is None


@pytest.mark.parametrize("text", ["1/(1 + x)", "x", "1 - p", "-1", "0", "p - p", "x**2", "log(p)"])
def test_the_positive_factor_refuses_what_is_not_positive(text):
    certificate = {
        "version": 1, "verdict": "proved", "example": {"p": "1", "x": "1"},
        "goal": {"assume": ["p > 0"], "show": [f"{text} >= 0"]},
        "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"positive": text}]}]}],
    }
    with pytest.raises(CertificateError):
        check(certificate)


def test_the_positive_factor_takes_what_is_positive_by_its_terms():
    certificate = {
        "version": 1, "verdict": "proved", "example": {"p": "1", "x": "1"},
        "goal": {"assume": ["p > 0"], "show": ["p/(1 + p + x**2) > 0"]},
        "proofs": [{"rule": "combination", "terms": [
            {"coefficient": "1", "factors": [{"positive": "p/(1 + p + x**2)"}]}]}],
    }
    check(certificate)
