"""The parts of an expression are sympy's own, each once, however often they stand in it."""

import pytest
import sympy as sp
from sympy import Integer

from workbench.compile.literals import require_short
from workbench.compile.parts import free_symbols, parts
from workbench.errors import CompileError

x, y = sp.symbols("x y", real=True)
i, n = sp.symbols("i n", integer=True)
w = sp.IndexedBase("w", real=True)
EXPRESSIONS = [
    sp.Integer(3), x, x**2 + sp.sin(x * y) - x**2 * y, sp.Piecewise((x, x < y), (y + 1, True)),
    sp.Sum(x * w[i], (i, 1, n)) + y, sp.Derivative(sp.Function("f")(x, y), x), sp.sqrt(sp.Rational(2, 7) + x) / y,
    sp.Max(x, y, 0) + sp.Abs(x), sp.Integral(sp.exp(-x * y), (x, 0, y)), w[i] + w[2], sp.Lambda(x, x + y)]


@pytest.mark.parametrize("expr", EXPRESSIONS, ids=str)
def test_they_are_what_sympy_finds(expr):
    found = [*parts(expr)]
    assert len(found) == len(set(found)) and found[0] == expr
    assert set(found) == {one for one in sp.preorder_traversal(expr) if isinstance(one, sp.Basic)}
    assert free_symbols(expr) == expr.free_symbols


def test_what_stands_in_it_a_thousand_million_times_is_looked_at_once():
    expr = x
    for k in range(2, 60):
        expr = (expr + k) * (expr + y)  # each twice in the next
    assert len(parts(expr)) < 500
    assert free_symbols(expr) == {x, y}
    require_short([expr])


@pytest.mark.parametrize(("hidden", "said"), [
    (Integer(2) ** 70, "beyond 64 bits"), (1 / Integer(2) ** 70, "beyond 64 bits"), (sp.I, "is no real number"),
    (sp.nan, "is no real number"), (sp.Float("1e400"), "that no float holds"), (y**20001, "exponent beyond 10000")])
def test_a_number_that_cannot_be_calculated_with_is_found_wherever_it_stands(hidden, said):
    with pytest.raises(CompileError, match=said):
        require_short([x, sp.sin(sp.Add(1, sp.Mul(x, sp.cos(hidden, evaluate=False), evaluate=False), evaluate=False))])
