"""Two sides are called the same only when they are: held against values at points, which the comparison never uses."""

import mpmath
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from latex_trees import LETTERS, VECTORS, V, W, expressions, h, k, over, theta, x, y

from workbench.proof.claim import D, Goal, Relation
from workbench.proof.derive import expand_derivatives
from workbench.proof.latex.compare import Comparison
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.limits import MOST_TERMS
from workbench.proof.latex.match import limits_of, match
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.read import read_line
from workbench.proof.latex.statement import statement

FLOW = {x: -x * y, y: k - theta, theta: x}
POINTS = ({x: "0.7", y: "-1.3", k: "2.1", theta: "0.4", V: "-0.9"},
          {x: "-1.1", y: "0.6", k: "0.3", theta: "-2", V: "1.7"})
COMPONENTS = ([("0.2", "1.9"), ("-0.8", "0.5"), ("1.4", "-0.6")], [("1.3", "0.1")])


def value(expr, point, components):
    """The value at a point, with sums over some components; None where it is not defined."""
    expr = expand_derivatives(expr, FLOW)
    numbers = {symbol: sp.Rational(text) for symbol, text in point.items()}

    def summed(term, *_):
        return sp.Add(*(term.xreplace({W: sp.Rational(w), h: sp.Rational(g)}) for w, g in components))

    found = sp.N(expr.replace(sp.Sum, summed).xreplace(numbers), 40)
    return found if found.is_real and found.is_finite else None


def differ_somewhere(first, second):
    for point in POINTS:
        for components in COMPONENTS:
            values = value(first, point, components), value(second, point, components)
            if None not in values and abs(values[0] - values[1]) > mpmath.mpf("1e-20") * (1 + abs(values[0])):
                return True
    return False


def nested(expr):
    """Whether a derivative is of something without one everywhere, or of what does not move."""
    return any(d.args[0].has(sp.Abs, sp.sign, sp.Max, sp.Min) or not d.args[0].has(*FLOW) for d in expr.atoms(D))


@settings(max_examples=40, deadline=None, derandomize=True)
@given(expressions, expressions, st.sampled_from(["swap", "double", "negate", "letter", "other"]))
def test_what_is_called_the_same_has_the_same_values(expr, other, change):
    assume(not nested(expr) and not nested(other))
    changed = {"swap": expr.xreplace({x: y, y: x}), "double": expr.xreplace({sp.Integer(2): sp.Integer(3)}),
               "negate": expr.xreplace({x: -x}), "letter": expr.xreplace({theta: V}), "other": other}[change]
    if Comparison(FLOW).same(expr, changed):
        assert not differ_somewhere(expr, changed)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(expressions, st.sampled_from(["expand", "together", "carried", "doubled"]))
def test_what_algebra_alone_changes_stays_the_same(expr, change):
    assume(not nested(expr) and all(power.exp.is_Integer for power in expr.atoms(sp.Pow)))
    rewritten = {"expand": sp.expand(expr, deep=False), "together": sp.together(expr, deep=False),
                 "carried": expand_derivatives(expr, FLOW), "doubled": (expr * y + x * expr) / (x + y)}[change]
    comparison = Comparison(FLOW)
    factors = [factor for part in sp.preorder_traversal(expr) for factor in sp.Mul.make_args(part)]
    multiplied = sum(factor.has(sp.Sum) for factor in factors) > 1
    assert comparison.same(expr, rewritten) or multiplied or comparison.too_large


MUTATIONS = [("+", "-"), ("- ", ""), ("2", "3"), ("x_{1}", "y"), ("y", "k"), (r"\tanh", r"\exp"), ("k", "x_1"),
             (r"\max", r"\min"), (r"\left(", r"\left(-"), (r"\frac{d}{dt}", "2"), ("h_", r"\tilde W_"),
             ("^{2}", "^{4}"), (r"\le", "<"), ("=", r"\ge"), (r"\hat{\theta}_{2}", "V^*")]


@settings(max_examples=40, deadline=None, derandomize=True)
@given(expressions, expressions, st.sampled_from(["==", "<=", "<"]), st.sampled_from(MUTATIONS), st.integers(0, 5))
def test_a_mutated_page_is_parsed_only_where_it_says_the_same(left, right, operator, mutation, place):
    assume(left != right and not nested(left) and not nested(right))
    relation = Relation(left, operator, right)
    goal = Goal((relation,), flow=FLOW)
    parts = relation.latex().split(mutation[0])
    assume(len(parts) > 1)
    cut = place % (len(parts) - 1) + 1
    mutant = mutation[0].join(parts[:cut]) + mutation[1] + mutation[0].join(parts[cut:])
    notation = {**LETTERS, **VECTORS}
    if match(mutant, notation, goal).parsed:
        (said,) = statement(read_line(mutant), Converter(Notation(notation), limits_of(goal))).claimed
        assert said.operators == (operator,)
        assert not differ_somewhere(said.sides[0], left) and not differ_somewhere(said.sides[1], right)


@pytest.mark.parametrize(("first", "second"), [
    (sp.Abs(x), x * sp.sign(x)), (over(W * h) * k, over(k * W * h)), (over(W**2) - over(h), over(W**2 - h)),
    (sp.tanh(x + y - x), sp.tanh(y)), (sp.log(sp.expand((x + y) ** 2)), sp.log((x + y) ** 2)),
    (sp.Max(x, y + 1), sp.Max(1 + y, x)), (D(x**2), -2 * x**2 * y), (D(D(x)), x * y**2 - x * (k - theta)),
    (sp.exp(x) * (1 + sp.exp(-x)), sp.exp(x) + 1), (sp.exp(x + 1) + sp.E, sp.E * (sp.exp(x) + 1)),
    (sp.sqrt(x**2 + 2 * x * y + y**2 + 1), sp.sqrt((x + y) ** 2 + 1)), ((x**2 - y**2) / (x - y), x + y),
])
def test_exact_algebra_is_seen_through(first, second):
    assert Comparison(FLOW).same(first, second)
    assert not differ_somewhere(first, second)


@pytest.mark.parametrize(("first", "second"), [
    (over(W * h), over(W) * over(h)), (over(W) ** 2, over(W**2)), (sp.Abs(x), x), (sp.sqrt(x**2 + y**2), x + y),
    (sp.log(x**2 * k), sp.log(x**2)), (sp.Max(x, y), sp.Min(x, y)), (D(x), x), (over(W), W),
    (sp.exp(x) * y, sp.exp(y) * x), (sp.exp(2 * x), sp.exp(x)), (sp.exp(x / 2), sp.exp(x)),
    (sp.Sum(W, (W.indices[0], 2, sp.Symbol("n"))), over(W)),
])
def test_what_differs_is_told_apart(first, second):
    assert not Comparison(FLOW).same(first, second)


def test_what_is_too_large_is_not_called_the_same():
    comparison = Comparison({})
    large = (x + y + k + theta + V) ** 80
    assert not comparison.same(large * (x + 1), large * x + sp.expand((x + y) ** 2) / (x + y) ** 2 * large)
    assert comparison.too_large and MOST_TERMS < 10**6
