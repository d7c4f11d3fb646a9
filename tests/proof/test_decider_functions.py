"""abs, sign, sqrt, Max, Min and tanh on the way from sympy to a certificate: nothing changes its value, and what is
proved of random expressions holds."""

import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from independent import Evaluated
from plain_values import TooLargeError, UndefinedError, holds, mp, points, value

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError, Context, bounds, check, number, read_rational, same, substitute
from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, greater, saturation
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.decide.tangents import _least
from workbench.proof.derive import Side, Size, unfold
from workbench.proof.text import text

x, y, z = sp.symbols("x y z", real=True)
p = sp.Symbol("p", positive=True)
HALF = sp.Rational(1, 2)
LEAVES = st.sampled_from([x, y, z, p, sp.Integer(0), sp.Integer(1), sp.Integer(-2), HALF, sp.Rational(-5, 3)])


def attempted(function, arguments, **more):
    """The function of the arguments, or the first of them where sympy finds no real number, or fails on the way."""
    try:
        result = function(*arguments, **more)
    except (ValueError, TypeError, ArithmeticError):
        return arguments[0]
    return arguments[0] if result.has(sp.oo, -sp.oo, sp.zoo, sp.nan, sp.I) else result


def written(function):
    """The function as sympy evaluates it by itself, or left as it is written."""
    return lambda drawn: attempted(function, drawn[1:], evaluate=drawn[0])


def combine(inner):
    evaluate = st.booleans()
    one, two = st.tuples(evaluate, inner), st.tuples(evaluate, inner, inner)
    power = st.tuples(evaluate, inner, st.sampled_from([*map(sp.Integer, (2, 3, -1)), HALF, -HALF, 3 * HALF]))
    return st.one_of(
        *(one.map(written(f)) for f in (sp.Abs, sp.sign, sp.tanh)),
        *(two.map(written(f)) for f in (sp.Add, sp.Mul, sp.Max, sp.Min)),
        st.tuples(inner, inner, inner).map(lambda a: attempted(saturation, a)),
        inner.map(lambda a: sp.sqrt(1 + a**2)), power.map(written(sp.Pow)))


EXPRESSIONS = st.recursive(LEAVES, combine, max_leaves=6)
MANY = settings(max_examples=100)


def sayable(expr):
    """Only what a goal may contain: sympy itself may find infinity or an imaginary number on the way."""
    try:
        Goal((at_least(expr, 0),))
    except ClaimError:
        assume(False)


def plain(expr):
    """With the functions of sympy for those that deciders leave unevaluated."""
    while expr.has(Size, Side):  # sympy may leave an outer one when it replaces the inner one
        expr = expr.replace(Size, sp.Abs).replace(Side, sp.sign)
    return expr


def same_number(expr, at, expected):
    """Whether an expression has that value at a point, if any."""
    found = sp.N(plain(expr).xreplace({s: sp.Rational(str(at[str(s)])) for s in plain(expr).free_symbols}), 50)
    return found.is_real and abs(mp.mpf(str(found)) - expected) <= mp.mpf(10) ** -25 * (1 + abs(expected))


def at_points(seed):
    return ({**point, "p": abs(point["c"]) + mp.mpf(1) / 8} for point in points(seed, most=3))


@MANY
@given(EXPRESSIONS, st.integers(0, 10**6))
def test_the_text_of_an_expression_has_its_value(expr, seed):
    sayable(expr)
    for point in at_points(seed):
        try:
            expected = value(text(expr), point)
        except (UndefinedError, TooLargeError):
            continue
        assert same_number(expr, point, expected)
        assert same_number(unfold(expr), point, expected)


@MANY
@given(EXPRESSIONS, st.integers(0, 10**6))
def test_the_checker_reads_the_text_as_that_value(expr, seed):
    sayable(expr)
    context = Context({}, [])
    try:
        ratio = context.read(text(expr))
    except CertificateError:  # such as 1/0, which sympy leaves as it stands when told to
        assume(False)
    for point in at_points(seed):
        exact = {s: number(read_rational(str(sp.Rational(str(point[s]))))) for s in "xyzp"}
        try:
            expected = value(text(expr), point)
            low, high = bounds(context, substitute(context, ratio, exact))
        except (UndefinedError, TooLargeError, CertificateError):
            continue
        slack = mp.mpf(10) ** -20 * (1 + abs(expected))
        assert mp.mpf(low.numerator) / low.denominator - slack <= expected
        assert expected <= mp.mpf(high.numerator) / high.denominator + slack


@MANY
@given(EXPRESSIONS)
def test_unfolding_is_what_the_checker_does(expr):
    sayable(expr)
    # sympy may pull a root apart, or make an absolute value of it; the value is the same, as is tested above
    assume(all(power.exp.is_Integer for power in expr.atoms(sp.Pow)))
    context = Context({}, [])
    try:
        one, two = context.read(text(expr)), context.read(text(unfold(expr)))
    except CertificateError:
        assume(False)
    assert not unfold(expr).has(sp.Abs, sp.sign, sp.Max, sp.Min, sp.tanh)
    assert same(one, two)


# Each is non-negative, so that about half of the goals are true, most of them barely.
terms = st.sampled_from([
    sp.Integer(1), sp.Abs(x) - x, sp.Abs(y), x * sp.sign(x), sp.Abs(x) + sp.Abs(y) - sp.Abs(x + y), sp.Max(x, y) - y,
    x - sp.Min(x, 1), 1 - saturation(x, -1, 1), (x - saturation(x, -1, 1)) * sp.sign(x), sp.sqrt(x**2 + y**2) - x,
    sp.sqrt(p), 1 - sp.tanh(x), x * sp.tanh(x), 1 - sp.sign(y) ** 2, x**2 - 2 * sp.Abs(x) + 1])
parts = st.lists(st.tuples(st.sampled_from([-1, 1, 1, 2, HALF]), terms), min_size=1, max_size=2)
conditions = st.lists(st.sampled_from([
    greater(x, 0), at_least(y, x), at_most(sp.Abs(x), 1), equal(y, 2 * x), at_most(sp.Max(x, y), p),
    at_most(x**2, p)]), max_size=1).map(tuple)


@settings(max_examples=15)
@given(parts, st.sampled_from([0, 0, 0, HALF, -HALF]), st.sampled_from([">=", ">=", ">", "=="]), conditions,
       st.integers(0, 10**6))
def test_whatever_is_proved_holds_at_random_points(summands, above, operator, assumed, seed):
    goal = Goal((Relation(sp.Add(*(c * term for c, term in summands)), operator, sp.sympify(above)),), assumed)
    # In the engine's order: a proof of what fails at a point that is quickly found would be sought for a long time.
    found = find_counterexample(goal, "refuted", quick=True) or prove_goal(goal) or find_counterexample(goal, "refuted")
    if found is None or found["verdict"] == "refuted":
        # what is near a root is no point at which the equality holds
        assert found is None or "roots" in found or Evaluated(goal, neurons=1).holds_at(found["point"]) == (True, False)
        return
    check(found)
    assert Evaluated(goal).falsifying_point(seed, batches=2, count=2_000, tight=4) is None
    record = found["goal"]
    for point in at_points(seed):
        if all(holds(relation, point) for relation in record["assume"]):
            assert all(holds(relation, point) for relation in record["show"])


def test_where_an_argument_has_a_pole_no_tangent_begins():
    """The least margin may lie where an argument is infinite minus infinite: deciding ended with an error there."""
    x = sp.Symbol("x", real=True)
    assert not [*_least(x**2, [1 / x - 2 / x - x / x**3, 1 + x], ())]
    assert [*_least(x**2, [1 + x], ())]
