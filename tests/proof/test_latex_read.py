"""Lines of LaTeX as trees: what is typed differently and reads the same is the same; every line ends in a moment."""

import time

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.limits import LONGEST_LINE
from workbench.proof.latex.read import read_line
from workbench.proof.latex.tree import Letter, Power, Product, Quotient, Size, Terms, Transposed


def side(text):
    line = read_line(text)
    assert len(line.chains) == 1 and not line.chains[0].signs
    return line.chains[0].sides[0]


@pytest.mark.parametrize("same", [
    ("x_1", "x_{1}", "{x}_1", "x _ 1", "{x_{1}}", r"x_{\mathrm{1}}"),
    (r"\hat\theta_1^2", r"\hat{\theta}_1^{2}", r"\hat{\theta_1}^2", r"\widehat\theta{}_1^2".replace("{}", "")),
    (r"W_f^{*T}h", r"W_f^*{}^Th".replace("{}", ""), r"W^{\ast\top}_fh"),
    (r"\dot{\tilde\rho}_{k\nu}", r"\dot{\tilde{\rho}}_{k\nu}", r"\dot{\tilde\rho_{k\nu}}"),
    (r"\tfrac12 x", r"\frac{1}{2}x", r"\dfrac1{2}\,x", r"\frac 1 2 x"),
    (r"\left|x\right|^2", "|x|^2", r"\lvert x\rvert^{2}"),
    (r"\left\| x\right\|_2", r"\|x\|_2", r"\lVert x\rVert_{2}"),
    (r"x \leq y", r"x\le y", r"x \leqslant{} y".replace("{}", "")),
    (r"\operatorname{sgn}(x)", r"\mathrm{sgn}\left(x\right)", r"\mathrm{sign}\big( x \big)", r"\sgn(x)"),
    (r"\dot V_2", r"\dot{V}_2", r"\dot{V_2}"),
    ("x^2_1", "x_1^2", "{x_1}^2"),
    (r"\begin{aligned} a &= b \\ &\le c \end{aligned}", r"a = b \le c"),
    (r"\begin{cases} a = b, \\ c = d \end{cases}", r"\begin{cases} a = b \\ c = d \end{cases}", "a = b, c = d"),
    (r"98\%", "0.98", r"\!0.98"),
    (r"x_{max}", r"x_{\max}", r"x_{\mathrm{max}}", r"x_{\text{max}}"),
])
def test_ways_of_typing_one_piece_give_one_tree(same):
    assert len({read_line(text) for text in same}) == 1


@pytest.mark.parametrize("pair", [
    ("x_1", "x^1"), ("x_{12}", "x_1 2"), ("x^2 3", "x^{23}"), (r"\hat x", "x"), (r"\dot{\hat x}", r"\hat{\dot x}"),
    ("x < y", r"x \le y"), ("x = y", r"x \ne y"), ("x + y", "x - y"), ("x_1", "x_{1,1}"), (r"W^T h", r"W h"),
    ("|x|", r"\|x\|"), (r"\Delta u", r"\delta u"), ("x^*", "x"), ("x^*", "x^2"), (r"\rho_i^0", r"\rho_i"),
    ("a(b)", "ab"), (r"a \Rightarrow b = c", "a, b = c"), ("f(x)", "f(y)"), ("[0, 1]", "(0, 1]"),
    (r"\sum_{j=1}^n x", r"\sum_{j=2}^n x"),
])
def test_what_says_something_else_gives_another_tree(pair):
    assert read_line(pair[0]) != read_line(pair[1])


def test_the_parts_of_a_line_are_what_tex_makes_of_them():
    assert side("x_1^2y") == Product((Power(Letter("x", index="1"), side("2")), Letter("y")))
    assert side(r"\tfrac12e") == Product((Quotient(side("1"), side("2")), Letter("e")))
    assert side(r"W_f^{*T}h") == Product((Transposed(Letter("W", index="f", mark="*")), Letter("h")))
    assert side("b_0|z_2||x_2|") == Product((Letter("b", index="0"), Size("|", (Letter("z", index="2"),)),
                                            Size("|", (Letter("x", index="2"),))))
    assert side("||a| - b|") == Size("|", (Terms(((1, Size("|", (Letter("a"),))), (-1, Letter("b")))),))
    assert side("c_ji") == Product((Letter("c", index="j"), Letter("i")))
    line = read_line(r"a = b \le c,\quad d > 0 \Rightarrow e < 1\ \text{for all } t")
    assert [chain.signs for chain in line.chains] == [("=", "<="), (">",), ("<",), ()]
    assert line.separators == ((), (",",), ("=>",), ("text for all",), ())


@pytest.mark.parametrize(("text", "place"), [
    ("x +", 3), (r"x \le \le y", 7), ("a/bc", 3), ("2 3", 3), (r"\frac{1}", 8), ("x}", 2), (r"\unknown x", 1),
    (r"\text x", 6), ("x^", 2), ("(x", 2), ("x)", 2), ("|x", 2), (r"|x\|", 3), ("x_1_2", 4), (r"\sqrt[3]{x}", 1),
    ("é = 1", 1), ("2^3^2", 5), ("x^a_1^b", 7), ("1,000 = 1000", 1), ("x < 12,500", 5),
    ("x # y", 3), ("(a + b)_1", 8), ("x = {}", 6), (r"\frac{}{2}", 7), ("*", 1),
    (r"\Gamma_{\varthetai}", 9), (r"\begin{cases} a & b\end{cases}", 17), ("a & b", 3), (r"\begin{matrix}", 1),
    (r"\end{cases}", 1),
])
def test_what_cannot_be_read_is_refused_with_its_place(text, place):
    with pytest.raises(LatexError) as refused:
        read_line(text)
    message = str(refused.value)
    assert message.startswith(f"at character {place}: "), message
    assert "\n" not in message and ": " in message.partition(": ")[2]


LONGEST_S = 5.0  # of this process; the slowest takes some hundredths


@pytest.mark.parametrize("text", [
    "x" * 100_000, "{" * 100_000, "(" * 100_000, "{" * 50_000 + "}" * 50_000, "{" * 2000 + "}" * 2000,
    "(" * 2000 + "x" + ")" * 2000, "|" * 4000, r"\|" * 2000, "x^" * 2000, "x^{" * 1000 + "}" * 1000, "x_" * 2000,
    r"\dot" * 1000 + "x", r"\frac" * 700 + "x", r"\sqrt" * 700, "+" * 4000, "-" * 4000, "x," * 2000, "=" * 4000,
    "9" * 4000, r"\left" * 700, "x/" * 2000, "^" * 4000, "'" * 4000, r"\text{" * 600, r"\text{" + "{" * 3000,
    r"\hat{" * 700 + "x" + "}" * 700, r"\begin{cases}" * 300,
    r"\\" * 2000, "&" * 4000, r"1\%" + r"\%" * 1900, r"\sum_" * 700, r"\tanh" * 700, "[" * 25 + "x" + "]" * 25,
    "x" * LONGEST_LINE,
    "x+" * 1999 + "x", "\\", "\x00", "$" * 4000, "", " ", "x" + "\n" * 3000 + "y", "|x" * 2000, "(|" * 2000,
])
def test_no_line_takes_long(text):
    started = time.process_time()
    try:
        read_line(text)
    except LatexError as refused:
        assert "\n" not in str(refused) and len(str(refused)) < 300
    assert time.process_time() - started < LONGEST_S


PIECES = ["x", "y_1", r"\hat", r"\dot", "{", "}", "(", ")", "|", r"\|", "^", "_", "T", "*", "2", "0.5", "+", "-", "=",
          r"\frac", r"\tfrac", r"\sum", r"\int", "d", "t", r"\le", r"\Rightarrow", r"\text{for}", r"\left", r"\right",
          r"\sqrt", r"\max", r"\tanh", "[", "]", r"\{", r"\}", "'", "/", r"\cdot", r"\dots", ":", r"\forall", r"\in",
          ",", " ", "e"]


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
@example(r"\frac")
@example("^")
def test_any_mixture_is_read_or_refused_in_one_line(text):
    try:
        line = read_line(text)
    except LatexError as refused:
        assert "\n" not in str(refused)
    else:
        assert len(line.separators) == len(line.chains) + 1
