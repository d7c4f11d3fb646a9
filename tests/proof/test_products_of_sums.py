"""Products of sums over an index: what is read is what is written, and textbook inequalities hold for every n."""

import ast
from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from workbench.proof.checker import CertificateError, Context, at, bounds, check, number
from workbench.proof.claim import Goal, at_least, at_most, equal, greater
from workbench.proof.decide.engine import prove_goal

a, r, s = sp.symbols("a r s", real=True)
c = sp.Symbol("c", positive=True)
j, n = sp.Symbol("j", integer=True), sp.Symbol("n", integer=True, positive=True)
x, y = (sp.IndexedBase(name, real=True)[j] for name in "xy")


def total(term):
    return sp.Sum(term, (j, 1, n))


NORMS = (at_least(r, 0), at_least(s, 0), equal(r**2, total(x**2)), equal(s**2, total(y**2)))
TRUE = {
    "Cauchy and Schwarz": Goal((at_most(total(x*y)**2, total(x**2) * total(y**2)),)),
    "the same of norms": Goal((at_most(total(x*y), sp.sqrt(total(x**2)) * sp.sqrt(total(y**2))),)),
    "Minkowski": Goal((at_most(sp.sqrt(total((x + y)**2)), sp.sqrt(total(x**2)) + sp.sqrt(total(y**2))),)),
    "Minkowski of named norms": Goal((at_most(total((x + y)**2), (r + s)**2),), NORMS),
    "the square of a mean": Goal((at_most(total(x)**2, total(1) * total(x**2)),)),
    "a binomial": Goal((equal(total(x + y)**2, total(x)**2 + 2*total(x)*total(y) + total(y)**2),)),
    "a product of bounds": Goal((at_least(total(x**2) * total(y**2), 1),), (
        at_least(total(x**2), 1), at_least(total(y**2), 1))),
    "Young": Goal((at_most(2 * total(x*y) * a, c * total(x**2) * total(y**2) + a**2 / c),)),
    "a normalised step": Goal((at_most(total(x**2) / (1 + total(x**2)), 1),)),
    "a projection": Goal((at_most(total(x*y)**2 / total(y**2), total(x**2)),), (greater(total(y**2), 0),)),
}


@pytest.mark.parametrize("name", TRUE)
def test_textbook_inequalities_are_proved_for_every_number_of_terms(name):
    found = prove_goal(TRUE[name])
    assert found is not None
    check(found)


@st.composite
def texts(draw, inside=False, depth=3):
    """Texts of scalars, or of terms of a sum, with sums in sums, products, powers and quotients."""
    if depth == 0 or draw(st.booleans()):
        return draw(st.sampled_from(("x", "y", "a", "2") if inside else ("a", "3", "Sum(x)", "Sum(x*y)", "Sum(1)")))
    one = draw(texts(inside, depth - 1))
    match draw(st.sampled_from(("+", "-", "*", "**", "/", "Sum"))):
        case "Sum":
            return f"Sum({draw(texts(True, depth - 1))})"
        case "**":
            return f"({one})**2"
        case "/":
            return f"({one})/(1 + ({draw(texts(inside, depth - 1))})**2)"
        case sign:
            return f"({one}) {sign} ({draw(texts(inside, depth - 1))})"


def plain(node, point, rows, row):
    """The value of an expression by what it says, each sum written out."""
    match node:
        case ast.Constant(value=value):
            return Fraction(value)
        case ast.Name(id=name):
            return (row or {}).get(name, point.get(name))
        case ast.Call(args=[term]):
            return sum((plain(term, point, rows, here) for here in rows), Fraction(0))
        case ast.BinOp(left=left, op=op, right=right):
            one, two = plain(left, point, rows, row), plain(right, point, rows, row)
            return {ast.Add: lambda: one + two, ast.Sub: lambda: one - two, ast.Mult: lambda: one * two,
                    ast.Div: lambda: one / two, ast.Pow: lambda: one**int(two)}[type(op)]()
    raise AssertionError(ast.dump(node))


@given(texts(), st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), max_size=3), st.integers(-2, 2))
def test_what_is_read_is_what_is_written(text, pairs, value):
    context = Context({"a": "Sum(y)", "x": "a*y"}, ["x", "y"])
    rows = [{"x": Fraction(one), "y": Fraction(two)} for one, two in pairs]
    point = {"a": Fraction(value)}
    found = at(context, context.read(text), {"a": number(value)},
               [{name: number(v) for name, v in row.items()} for row in rows])
    wanted = plain(ast.parse(text, mode="eval").body, point, rows, None)
    assert bounds(context, found) == (wanted, wanted)
    closed = at(context, context.closed(context.read(text)), {"a": number(value)},
                [{name: number(v) for name, v in row.items()} for row in rows])
    assert bounds(context, closed) == (wanted, wanted)


@given(texts(), st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=1, max_size=2))
def test_rates_are_those_of_a_difference_quotient(text, pairs):
    context = Context({"a": "Sum(y)", "x": "a*y"}, ["x", "y"])
    try:
        rate = context.derivative(context.read(text), context.flow)
    except CertificateError as trouble:
        assert "a sum inside a sum" in str(trouble) or "two sums" in str(trouble)
        return
    step, tree = Fraction(1, 10**9), ast.parse(text, mode="eval").body
    rows = [{"x": Fraction(one), "y": Fraction(two)} for one, two in pairs]
    slope = sum(row["y"] for row in rows)
    found = bounds(context, at(context, rate, {"a": number(1)}, [
        {name: number(v) for name, v in row.items()} for row in rows]))[0]
    before, after = (plain(tree, {"a": 1 + h * slope}, [row | {"x": row["x"] + h * row["y"]} for row in rows], None)
                     for h in (-step, step))
    wanted = (after - before) / (2 * step)
    assert abs(found - wanted) <= Fraction(1, 10**6) * (1 + abs(wanted))
