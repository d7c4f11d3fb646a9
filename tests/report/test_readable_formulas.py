"""The certificate language as a reader would write it, in LaTeX, in one line of Unicode and in Typst."""

import ast
import re
from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from workbench.proof.checker import Context, bounds, read_point, substitute
from workbench.proof.text import text
from workbench.report.certificate_latex import (
    _tidied,
    assignments_latex,
    expression_latex,
    numbers_put_in,
    parse,
    relation_latex,
    value_latex,
)
from workbench.report.errata.typst_formulas import typst_formula
from workbench.report.formulas import formula, in_html
from workbench.report.plain_formulas import plain_formula


@pytest.mark.parametrize(("written", "shown"), [
    ("-8*t**2 - 8*t/3", "−8 t² − 8 t/3"), ("0 + a*1 - (-b)", "a + b"), ("(-1)*x*y", "−x y"), ("x*(a + b)", "x (a + b)"),
    ("(a + b)/(2*c)", "(a + b)/(2 c)"), ("1/250*D_hat", "1/250 D̂"), ("exp(log_m)*exp(-log_g)", "m 1/g"),
    ("abs(z_2)*k", "|z₂| k"), ("sqrt(x + 1)", "√(x + 1)"), ("a_star**2", "a*²"), ("D(V)", "d/dt V")])
def test_expressions_are_written_as_a_reader_would(written, shown):
    assert plain_formula(expression_latex(written)).replace(" ", "") == shown.replace(" ", "")


def test_relations_have_their_signs():
    assert plain_formula(relation_latex("z_1 <= 0")) == "z₁ ≤ 0"
    assert relation_latex("x != y_1") == r"x \ne y_{1}"


@pytest.mark.parametrize(("value", "shown"), [
    ("3", "3"), ("-1/2", "-0.5"), ("1/3", r"\frac{1}{3}"), ("7/6250000", r"1.12 \times 10^{-6}"),
    ("2000000", r"2 \times 10^{6}"), ("123456789/987654321", r"\approx 0.125"), ("-4/15", r"-\frac{4}{15}")])
def test_numbers_are_short_and_say_when_they_are_rounded(value, shown):
    assert value_latex(Fraction(value)) == shown


def test_a_root_in_a_counterexample_is_told_by_a_number_near_it():
    shown = assignments_latex({"x": "root near -0.4795831523", "y": "1/2", "z": "root near 2.5e-07"})
    assert [plain_formula(line) for line in shown] == ["x ≈ −0.4796 (a root)", "y = 0.5", "z ≈ 2.5 × 10⁻⁷ (a root)"]


NAMES = sp.symbols("a b c", positive=True)
LEAVES = st.one_of(st.sampled_from(NAMES), st.integers(-2, 3).map(sp.Integer))


def combined(parts):
    pair = st.tuples(parts, parts)
    return st.one_of(pair.map(lambda p: sp.Add(*p, evaluate=False)), pair.map(lambda p: sp.Mul(*p, evaluate=False)),
                     parts.map(lambda p: sp.Pow(p, 2, evaluate=False)),
                     parts.map(lambda p: sp.Mul(-1, p, evaluate=False)))


@given(st.recursive(LEAVES, combined, max_leaves=8))
def test_leaving_out_ones_and_zeros_changes_no_value(expression):
    written = text(expression)
    tidied = ast.unparse(ast.fix_missing_locations(ast.Expression(_tidied(parse(written)))))
    context = Context({}, [])
    point = read_point({"a": "2", "b": "-3/7", "c": "5"})
    values = [bounds(context, substitute(context, context.read(one), point)) for one in (written, tidied)]
    assert values[0] == values[1]


def test_numbers_are_put_in_without_being_multiplied_out():
    values = {"k": Fraction(2), "z": Fraction(-1, 2)}
    assert numbers_put_in("k*z + 1", values) == r"2 \cdot \left(-0.5\right) + 1" or "2" in numbers_put_in("k*z", values)
    assert numbers_put_in("D(k*z)", values) is None
    assert numbers_put_in("k*unknown", values) is None


@pytest.mark.parametrize("latex", [
    r"\dot{V}_2 \le -r_1 z_1^2", r"\text{for all } k \ge 1", r"\frac{a}{b}, \sum_{i=1}^{l} m_i", r"\hat{\rho}",
    r"\left|x\right| + \|x\|", r"\lim_{t \to \infty} e(t) = 0", r"[0, T)", r"\mathrm{word}_1", r"a*b, c; d \# e",
    "A sentence that was printed as it is, with z_1 in it"])
def test_typst_sets_every_formula(latex):
    typst = pytest.importorskip("typst")
    assert typst.compile(f"{typst_formula(latex)} {typst_formula(latex, display=True)}".encode(), format="pdf")


def test_a_fraction_too_wide_for_the_page_breaks_in_its_line():
    typst = pytest.importorskip("typst")
    wide = " + ".join(f"x_{{{i}}}" for i in range(40))
    assert "frac(" in typst_formula(r"\frac{a + b}{2}") and "frac(" not in typst_formula(rf"\frac{{{wide}}}{{2 m}}")
    text = typst_formula(rf"\frac{{{wide}}}{{2 m}}", display=True)
    pages = [typst.compile(f"#set page(width: {width}, height: auto, margin: 0pt)\n{text}".encode(), format="pdf")
             for width in ("10cm", "90cm")]
    heights = [float(found) for page in pages for found in re.findall(rb"/MediaBox\s*\[0 0 [\d.]+ ([\d.]+)\]", page)]
    assert len(heights) == 2 and heights[0] > 1.5 * heights[1]


def test_what_is_no_formula_stays_as_it_is():
    assert plain_formula(r"\nosuchcommand{x}") == r"\nosuchcommand{x}"
    assert typst_formula(r"\nosuchcommand{x}").startswith("#raw(")


def test_no_line_begins_with_the_punctuation_behind_a_formula():
    shown = in_html("with $a = 1$, $b$ and (as $c$) it says $d$.")
    assert shown.count('<span class="unbroken">') == 3
    for mark in (",", ")", "."):
        assert f"</math>{mark}</span>" in shown
    assert "</math>”,</span>" in in_html("“the rate of $V$”, which fails")
    assert str(in_html("<b> & $x$")) == "&lt;b&gt; &amp; " + str(formula("x"))


def test_two_primes_behind_an_index_stand_beside_each_other_and_bars_close_to_what_they_hold():
    assert "<msup>" not in formula("x_{m}''") and "<mi>″</mi>" in formula("x_{m}''")
    assert str(formula("|x|")).count('lspace="0" rspace="0"') == 2


def test_a_long_list_of_formulas_may_break_behind_its_commas():
    part = r"\gamma \left(\frac{a}{b} + \frac{c}{d} + \frac{e}{f}\right)"
    pieces = str(formula(f"{part}, {part}")).split("</math>")
    assert len(pieces) == 3 and pieces[0].endswith(",</mo></mrow>")
    assert str(formula("a, b")).count("<math") == 1


def test_a_line_may_break_within_long_brackets_and_loses_nothing():
    r"""As a whole `-c (a + ... )^2` was wider than a printed page, and cut there."""
    inner = " + ".join(rf"\gamma x_{{{i}}} \left(y_{{{i}}} - \phi\right)" for i in range(9))
    shown = formula(rf"-c_3\left({inner}\right)^2 \le k \quad\text{{given}}\ x")
    pieces = shown.split("</math>")
    assert len(pieces) > 10 and max(len(re.findall(r"<m[ion]\b", piece)) for piece in pieces) < 16
    assert "<math" in shown[shown.index("k</mi>"):shown.index("given")]
    letters = re.sub(r"<[^>]*>", "", shown)
    assert letters.count("(") == letters.count(")") == 10 and letters.count("\u03b3") == 9
    assert re.search(r"<msup><mo[^>]*>\)</mo><mn>2</mn></msup>", shown)  # the power stays at its bracket
    assert formula(r"\left(a + b\right)^2").count("<math") == 1
