"""What is written as LaTeX reads back as what was written."""

import sympy as sp
from hypothesis import given, settings
from latex_trees import LETTERS, VECTORS, W, expressions, h, over, theta, x, y

from workbench.proof.claim import D, at_most, equal
from workbench.proof.latex.compare import Comparison
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.letters import latex_name
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.read import read_line
from workbench.proof.latex.tidy import tidied
from workbench.proof.latex.write import latex, letters_of

FLOW = {x: -x, y: x, theta: -theta**2}


def read_back(text):
    limits = over(W).limits[0]
    return Converter(Notation({**LETTERS, **VECTORS}), limits).expression(read_line(text).chains[0].sides[0])


@settings(max_examples=80, deadline=None, derandomize=True)
@given(expressions)
def test_an_expression_reads_back_as_itself(expr):
    text = latex(expr)
    found = read_back(text)
    assert found == expr or Comparison(FLOW).same(found, expr), text


def test_derivatives_sums_and_functions_keep_what_belongs_to_them():
    for expr in (D(x) * y, D(x) ** 2, y * D(x * y) * theta, D(x * over(W)),
                 over(W) * y, over(W) ** 2, -over(W), y * over(W * h) * theta,
                 over(W) + y, over(W + 1), sp.tanh(x) ** 2, sp.log(1 + x**2) * y, sp.exp(x) ** 2 * y, x**-1,
                 (x + y) ** -2, sp.sqrt(1 + x**2) ** 3, sp.Abs(x) ** 3, -(x + y), 2 * D(x),
                 sp.Rational(-3, 7) * x, (x - y) * (y - theta), 1 / (x * y), x / (y * theta), sp.E * x):
        assert read_back(latex(expr)) == expr, latex(expr)


def test_products_as_typed_keep_their_signs():
    """Nested as they are typed, where sympy's own printer wrote y (-x) as y - x."""
    with sp.evaluate(False):
        typed = (-x * sp.tanh(x) * theta, theta * (-x * y), -x * y * theta, x * (-y / theta), (-x / y) / theta,
                 x - (-y * theta), -(-x * y), x - y * (-theta * x), -(x + y) * theta * y, x + (y - (theta + x)),
                 -sp.Rational(1, 2) * x * y, 2 * (-3) * x, (-x * y) ** 2, x / (-y * theta), y ** (-x * theta))
    for expr in typed:
        assert Comparison(FLOW).same(read_back(latex(expr)), expr.doit()), latex(expr)
    assert latex(typed[0]) == r"- \hat{\theta}_{2} x_{1} \tanh\left(x_{1}\right)"


def test_relations_are_written_with_their_sign():
    assert at_most(x, y**2).latex() == r"x_{1} \le y^{2}"
    assert equal(D(x), -x).latex({"x_1": "z"}) == r"\frac{d}{dt}\left[z\right] = - z"


def test_names_become_letters_with_accents_and_indices():
    for name, typed in {"x": "x", "x_1": "x_{1}", "x1": "x_{1}", "theta_hat_2": r"\hat{\theta}_{2}", "V_star": "V^{*}",
                        "W_f_star": "W_{f}^{*}", "zdot_1": r"\dot{z}_{1}", "lamda": r"\lambda", "F_mass": "F_{mass}",
                        "mass": r"\mathrm{mass}", "c_lambda": r"c_{\lambda}", "Delta": r"\Delta"}.items():
        assert latex_name(name) == typed


def test_no_two_symbols_look_alike():
    symbols = sp.symbols("x1 x_1 a_hat_b a_b_hat b_hat_", real=True)
    letters = letters_of(symbols)
    assert len(set(letters.values())) == len(letters) == len(symbols)


def test_zeros_and_ones_put_in_are_not_shown_and_nothing_else_is_worked_out():
    k, r = sp.symbols("k r", positive=True)
    j = sp.Symbol("j", integer=True)
    growth = sp.IndexedBase("log_m", real=True)[j]
    with sp.evaluate(False):
        shown = {
            r"x_{1}^{2}": 0 * (x**2 + 1) + x**2 + 0, "0": 0 * (x + y) * sp.exp(0),
            r"x_{1} \left(y + 1\right)": x * (y + sp.exp(0) + 0 * theta), r"\frac{x_{1}}{4}": x * 1 / (1 * sp.S(4)),
            r"\frac{y}{k}": 0**2 / (k**2 - 0**2) + 1**2 * y / k,
            r"y + \frac{0}{x_{1}}": y + 0 / x, r"y + 0 \ln\left(x_{1}\right)": y + 0 * sp.log(x),
            r"\frac{d}{dt}\left[x_{1}\right]": D(x + 0) + D(0 * y) + sp.Sum(0 * growth, (j, 1, 3)),
            r"x_{1} - 2 x_{1} + y": -2 * x + y + x, r"m_{j} + \frac{1}{m_{j}}": sp.exp(growth) + sp.exp(-growth)}
    for text, typed in shown.items():
        assert latex(tidied(typed)) == text
    assert tidied(x * (y + k) ** 2) == x * (y + k) ** 2
    # A letter with a star takes no second exponent without brackets: TeX refuses it.
    starred = sp.IndexedBase("W_star", real=True)[j]
    assert latex(starred**2 / r) == r"\frac{\left(W_{j}^{*}\right)^{2}}{r}"


@settings(max_examples=60, deadline=None, derandomize=True)
@given(expressions)
def test_what_is_tidied_has_the_same_value(expr):
    with sp.evaluate(False):
        typed = (0 * x + expr * 1) * sp.exp(0 * sp.S(1)) + 0 * (x**2 + 1)
    assert Comparison(FLOW).same(tidied(typed), expr), typed
