"""A pasted line is read as a mathematician reads it, or refused: what it becomes is compared as text."""

import pytest

from workbench.errors import WorkbenchError
from workbench.proof.latex.question import answer, asked
from workbench.proof.latex.symbols import load_symbols
from workbench.proof.text import relation_text

SYMBOLS = r"""
inputs = ['w']
[symbols]
'x' = "real"
'y' = "real"
'z' = "real"
'w' = "real"
'd' = "real"
'e' = "real"
'x_1' = "real"
'x_2' = "real"
'x_{1,d}' = "real"
'\theta' = "real"
'a' = "real"
'b' = "real"
'c' = "positive"
'k' = "positive"
'\epsilon' = "positive"
'\tau' = "nonnegative"
'v' = "vector"
'W' = "vector"
[definitions]
'V' = '\tfrac12 x^2 + \frac{1}{2c}\theta^2'
's' = 'x + a'
'U' = 'x s'
'R' = 's^2 + b U'
'H(x, a)' = 'x s'
[flow]
'x' = '-k x + w'
'y' = 'z'
'z' = '-y - z'
"""
READ = {
    # powers, products and fractions
    "-x^2 <= 0": "-x**2 <= 0", r".5 x^2 \ge -.25": "x**2/2 >= -1/4", "x^{-1}y = 1": "y/x == 1",
    "x/y^2 = 1": "x/y**2 == 1", r"\frac12x^2+\frac12y^2 \geq xy": "x**2/2 + y**2/2 >= x*y", "2(x) = y": "2*x == y",
    "k(x + y) = 1": "k*(x + y) == 1", "(x)(y) = 1": "x*y == 1", "x_1^2 = x_2": "x_1**2 == x_2",
    r"x^{2^2} = 1": "x**4 == 1", r"a \times b = 1": "a*b == 1", r"10^{-3} x = 1": "x/1000 == 1",
    r"5\% x = 1": "x/20 == 1", "2 e - 3 = x": "-3 + 2*e == x",
    # functions
    r"\sin^2 x = y": "sin(x)**2 == y", r"\sin 2x = 2 \sin x \cos x": "sin(2*x) == 2*cos(x)*sin(x)",
    r"\text{sgn}(x) x = y": "x*sign(x) == y", r"\mathrm{e}^{-\tau} \le 1": "exp(-tau) <= 1",
    r"\ln x^2 = 1": "log(x**2) == 1", r"\sqrt x y = 1": "y*sqrt(x) == 1", r"\max\{x, y\} = 1": "Max(x, y) == 1",
    # sizes and sums
    "|x||y| = 1": "abs(x)*abs(y) == 1", "||x| - |y|| = 1": "abs(-abs(y) + abs(x)) == 1", r"\|x\|^2 = y": "x**2 == y",
    r"\|v\|_1 \ge \|v\|": "Sum(abs(v)) >= sqrt(Sum(v**2))", r"v^{\mathrm{T}} W = 1": "Sum(W*v) == 1",
    r"\left| \sum_{i=1}^n v_i W_i \right| = 1": "abs(Sum(W*v)) == 1",
    r"\sum_{i=1}^n a v_i + c = 1": "c + Sum(a*v) == 1",
    r"\left(\sum_{i=1}^n v_i\right)^2 \le n\|v\|^2": "Sum(v)**2 <= Sum(1)*Sum(v**2)",
    r"\sum_{i=1}^{2} x_i^2 = 1": "x_1**2 + x_2**2 == 1", r"v(t)^T W(t) = 1": "Sum(W*v) == 1",
    # derivatives
    r"\dot{x}^2 = 1": "D(x)**2 == 1", r"\frac{d^2 y}{dt^2} = 1": "D(D(y)) == 1",
    r"\frac{\mathrm{d}}{\mathrm{d}t} x^2 = 1": "D(x**2) == 1", r"\frac{\partial V}{\partial x} = y": "x == y",
    "x(t)^2 = 1": "x**2 == 1", r"\frac{dy}{dt} = 1": "D(y) == 1",
    r"\frac{d s^2}{d x} = 1": "2*a + 2*x == 1", r"\frac{\partial H(x, a)}{\partial x} = 1": "a + 2*x == 1",
    r"\frac{\partial}{\partial x}\frac{\partial s^3}{\partial x} = 1": "6*a + 6*x == 1",
    # what is claimed, and of what
    r"0 < a \le b": "0 < a, a <= b", r"x^2 \ge 1 \quad (3)": "x**2 >= 1",
    r"x^2 \ge 1 \label{eq:1} \tag{3}": "x**2 >= 1", r"x^2 \ge 0 \quad \forall x \in \mathbb{R}, t \ge 0": "x**2 >= 0",
    r"x^2 \ge y \text{ for all } x, y": "x**2 >= y", r"\forall x > 0: x^3 > 0": "x > 0 |- x**3 > 0",
    r"\text{if } x > 0, \text{ then } x^3 > 0": "x > 0 |- x**3 > 0",
    r"\frac1x \le x \quad (x \ge 1)": "x >= 1 |- 1/x <= x", "x != 0 \\implies x^2 > 0": "x != 0 |- x**2 > 0",
    "y := x^2": "y == x**2", r"(x + y)^2 > 0 \text{ for } x, y > 0": "x > 0, y > 0 |- (x + y)**2 > 0",
    r"\forall x, y > 0: x y > -x": "x > 0, y > 0 |- x*y > -x", r"\forall x > 0, y: x y^2 \ge 0": "x > 0 |- x*y**2 >= 0",
    r"(x + y)^2 > 0\ \forall x > 0, y \in [0, 1]": "x > 0, 0 <= y, y <= 1 |- (x + y)**2 > 0",
}
REFUSED = {
    "a/bc = 1": "slash", "a/2b = 1": "slash", "1/2 x^2 = 1": "slash", r"\sin x y = 1": "argument of 'sin'",
    "x^10 = 1": "digits", r"\sin (x)^2 = 1": "power may belong", r"V(0) \le 1": "in these brackets",
    "k(x) = 1": "in these brackets", r"x^2 \ge 1 (3)": "in these brackets", "1e-3 x = 1": "power of ten",
    r"\pm x = 1": "two things", "x! = 1": "'!'", r"\frac{d x}{d y} = 1": "derivative other than",
    r"\frac{\partial a}{\partial x} = 0": "derivative other than", "v^T W v = 1": "row and two columns",
    r"\frac1x \le x, \quad x \ge 1": "claimed or a condition", "c^x = 1": "its exponent", "x^{1/3} = 1": "power 1/3",
    r"a \ll b": "none of a goal's relations", "a << b": "none of a goal's relations", r"\exists x: x > 0": "exists",
    r"\|v\|_\infty = 1": "norm", r"x \approx y": "none of a goal's",
    r"\operatorname{sat}(x) = 1": "without its limits", r"\sup_{x} x^2 = 1": "'sup'",
    r"\sum_{i=1}^n c = 1": "index 'i'", "x^a = 1": "its exponent",
    # what a derivative by a letter holds: a definition that moves with it, beside the letter itself, at any depth
    r"\frac{\partial U}{\partial x} = s": "holds 's'", r"\frac{\partial}{\partial x}(x s) = s": "holds 's'",
    r"\forall x, |y| \le 1: x^2 \ge y^2 - 1": "or none",
    r"\frac{\partial R}{\partial x} = 2s": "holds 's'", r"(x + y)^2 > 0 \text{ for } x > 0, y > 0": "may be claimed",
}


@pytest.fixture(scope="module")
def symbols(tmp_path_factory):
    path = tmp_path_factory.mktemp("pasted") / "symbols.toml"
    path.write_text(SYMBOLS)
    return load_symbols(path)


def test_a_line_is_read_as_it_is_meant(symbols):
    def shown(line):
        goal = asked(line, symbols)
        given, claimed = (", ".join(map(relation_text, part)) for part in (goal.assume, goal.show))
        return f"{given} |- {claimed}" if given else claimed

    assert {line: shown(line) for line in READ} == READ


def test_what_can_be_read_in_two_ways_or_in_none_is_refused_in_one_line(symbols):
    for line, why in REFUSED.items():
        with pytest.raises(WorkbenchError) as refused:
            asked(line, symbols)
        assert why in str(refused.value) and "\n" not in str(refused.value), line


@pytest.mark.parametrize("line", [
    r"|v^T W| \le \|v\| \|W\|", r"\|v + W\| \le \|v\| + \|W\|", "|x y| = |x||y|", r"\frac1x \le x \text{ for } x \ge 1",
    r"x \ge 2 \Rightarrow \frac{\ln x}{x - 1} \ge 0", r"|x + y| \le |x| + |y|",
    r"1/\sqrt{1 + w^2} \le 1", r"\dot V \le -k x^2 + x w"])
def test_what_control_papers_use_is_proved(symbols, line):
    assert answer(line, symbols).decision.verdict == "proved"
