"""cosh and sinh are read as what they are of exp, and the bounds of ln cosh that control papers use are decided."""

import pytest
import sympy as sp

from workbench.errors import ClaimError, WorkbenchError
from workbench.proof.checker import check
from workbench.proof.claim import Goal, at_least, cosh
from workbench.proof.decide.obligations import belongs, decide_obligation
from workbench.proof.latex.question import answer
from workbench.proof.latex.symbols import load_symbols

TRUE = {
    r"\ln\cosh x \ge 0": [">=", "log(cosh(x))", "0"],
    r"\ln\cosh x \le |x|": ["<=", "log(cosh(x))", "abs(x)"],
    r"\ln\cosh(x) \ge |x| - \ln 2": [">=", "log(cosh(x))", "abs(x) - log(2)"],
    r"\ln\cosh x \le x\tanh x": ["<=", "log(cosh(x))", "x*tanh(x)"],
    r"\ln\cosh x \le \tfrac12 x^2": ["<=", "log(cosh(x))", "x**2/2"],
    r"\cosh x \ge 1": [">=", "cosh(x)", "1"],
    r"\cosh^2 x - \sinh^2 x = 1": ["=", "cosh(x)**2 - sinh(x)**2", "1"],
}
FALSE = {
    r"\ln\cosh x \le \tfrac14 x^2": ["<=", "log(cosh(x))", "x**2/4"],
    r"\ln\cosh x \ge |x| - \tfrac12": [">=", "log(cosh(x))", "abs(x) - 1/2"],
    r"\sinh x \ge x": [">=", "sinh(x)", "x"], r"\cosh x = \sinh x": ["=", "cosh(x)", "sinh(x)"],
}


@pytest.fixture(scope="module")
def symbols(tmp_path_factory):
    path = tmp_path_factory.mktemp("letters") / "symbols.toml"
    path.write_text("[symbols]\nx = 'real'\ny = 'real'\n")
    return load_symbols(path)


@pytest.mark.parametrize("line", TRUE)
def test_it_is_proved_with_a_certificate_of_its_own(line):
    fact = {"assume": [], "show": TRUE[line]}
    outcome = decide_obligation(fact)
    assert outcome.verdict == "proved"
    for certificate in outcome.certificates:
        check(certificate)
    assert belongs(fact, "proved", outcome.certificates)


@pytest.mark.parametrize("line", FALSE)
def test_what_is_false_is_refuted(line):
    assert decide_obligation({"assume": [], "show": FALSE[line]}).verdict == "refuted"


@pytest.mark.parametrize(("line", "verdict"), [
    (r"\ln\cosh x \ge 0", "proved"), (r"\ln \cosh (x) \ge 0", "proved"), (r"\cosh^2 x - \sinh^2 x = 1", "proved"),
    (r"\ln\cosh 2x \ge 0", "proved"), (r"\ln\cosh x \le \tfrac14 x^2", "refuted"), (r"\cosh x = \sinh x", "refuted"),
])
def test_lines_of_latex_say_it(line, verdict, symbols):
    assert answer(line, symbols).decision.verdict == verdict


@pytest.mark.parametrize("line", [r"\ln\cosh(x) y \ge 0", r"\ln\cosh x y \ge 0", r"\ln\cosh \ge 0"])
def test_what_the_argument_is_of_must_be_plain(line, symbols):
    with pytest.raises(WorkbenchError, match="argument"):
        answer(line, symbols)


def test_sympys_own_is_told_what_to_write():
    x = sp.Symbol("x", real=True)
    with pytest.raises(ClaimError, match=r"write cosh of workbench\.proof\.claim"):
        Goal((at_least(sp.cosh(x), 1),))
    assert sp.simplify(cosh(x).rewrite(sp.cosh) - sp.cosh(x)) == 0
