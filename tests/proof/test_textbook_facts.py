"""Facts of textbooks that need a tangent at the right place, a quotient of logarithms, the square of a margin, the sign
of what is divided by shown first, or cases by the signs of factors."""

import json
from pathlib import Path

import pytest

from workbench.errors import ClaimError
from workbench.proof.checker import check
from workbench.proof.decide.obligations import belongs, decide_obligation

BOOKS = Path(__file__).parents[2] / "benchmarks" / "textbook"
FACTS = [fact for name in ("facts.json", "control_books.json", "slopes.json")
         for fact in json.loads((BOOKS / name).read_text(encoding="utf-8"))]
NEEDED = ("log grows", "abs and tanh, with 0.2785", "Minkowski in two dimensions", "trace bounds the form",
          "a transient below its supremum", "Minkowski in every dimension",
          "class K: a root grows", "class K: x/(1+x) grows", "interconnection: a composite function",
          "convexity: the inverse", "Lipschitz: sizes", "boundary layer: rate outside",
          # a margin that grows towards zero from below; signs of factors; an upper bound on the way; sizes below a bar;
          # the square of a number's root
          "tanh is smaller than its argument", "tanh lies in the sector [0, 1]",
          "energy bounds the angle from below", "twisting: the energy falls", "scattering keeps the power",
          # a product in cases by the polynomial part of its factors; parts that share no symbol
          "tanh grows, as a product", "co-coercivity of tanh", "Lipschitz: squares of sin",
          "energy of two neurons of gain 1/2")


@pytest.mark.parametrize("name", NEEDED)
def test_it_is_proved_with_a_certificate_of_its_own(name):
    fact, = (fact for fact in FACTS if fact["problem"].endswith(name))
    outcome = decide_obligation(fact)
    assert outcome.verdict == "proved"
    for certificate in outcome.certificates:
        check(certificate)
    assert belongs(fact, "proved", outcome.certificates)


def test_a_certificate_of_other_names_under_the_sums_does_not_belong():
    fact, = (fact for fact in FACTS if fact["problem"].endswith("Cauchy-Schwarz in every dimension"))
    outcome = decide_obligation(fact)
    assert belongs(fact, "proved", outcome.certificates)
    for other in (["x"], ["x", "z"], ["z"]):  # with x alone, y is a number and the statement another
        assert not belongs(fact | {"indexed": other}, "proved", outcome.certificates)


@pytest.mark.parametrize(("obligation", "said"), [
    ({"assume": [], "show": ["<=", "Sum(x)", "x"], "indexed": ["x"]}, "no sum binds"),
    ({"assume": [], "show": ["<=", "Sum(Sum(x))", "1"], "indexed": ["x"]}, "a sum runs from 1"),
    ({"assume": [], "show": ["<=", "Sum(x)", "1"], "indexed": "x"}, "list of names"),
    ({"assume": [], "show": ["<=", "Sum(x)", "count_"], "indexed": ["x"]}, "another name")])
def test_sums_that_have_no_meaning_are_refused_in_a_line(obligation, said):
    with pytest.raises(ClaimError, match=said):
        decide_obligation(obligation)


@pytest.mark.parametrize("show", [
    [">=", "log(1 + exp(x))", "max(x, 0)"], ["=", "sqrt(2)*sqrt(3)*x", "sqrt(6)*x"],
    ["=", "sqrt(2)*sqrt(3)*sqrt(5)*x", "sqrt(30)*x"], ["=", "x*sqrt(6)/sqrt(2)", "sqrt(3)*x"],
    ["=", "sqrt(8)*x", "2*sqrt(2)*x"], ["=", "sqrt(1/2)*sqrt(6)*x", "sqrt(3)*x"]])
def test_logarithms_below_lines_and_products_of_roots_are_proved(show):
    """The tangent of exp at the margin; a root that is a product of others, by a lemma on their squares."""
    outcome = decide_obligation({"assume": [], "show": show})
    assert outcome.verdict == "proved"
    for certificate in outcome.certificates:
        check(certificate)


def test_what_is_a_little_too_sharp_is_refuted():
    smoothing = {"assume": [[">", "k", "0"]], "show": ["<=", "abs(x) - x*tanh(x/k)", "278/1000*k"]}
    assert decide_obligation(smoothing).verdict == "refuted"
    transient = {"assume": [[">=", "x", "0"]], "show": ["<=", "x*exp(-x)", "367/1000"]}
    assert decide_obligation(transient).verdict == "refuted"
    for show in (["<=", "abs(tanh(x))", "abs(x)/2"], [">=", "tanh(x)*(x/2 - tanh(x))", "0"],
                 ["=", "(x/sqrt(2))**2", "x**2/3"], ["=", "sqrt(2)*sqrt(3)*x", "sqrt(5)*x"],
                 ["=", "sqrt(8)*x", "3*sqrt(2)*x"], ["=", "sqrt(2) + sqrt(3)", "sqrt(5)"],
                 ["=", "sqrt(6)*x/sqrt(2)", "-sqrt(3)*x"], [">=", "log(1 + exp(x))", "max(x, 1)"],
                 [">=", "log(1 + exp(x))", "max(x, 0) + exp(-10)"]):
        assert decide_obligation({"assume": [], "show": show}).verdict == "refuted"
    size = {"assume": [["!=", "s", "1"]], "show": ["=", "s/abs(s)*abs(s)", "s"]}  # undefined where s is zero
    assert decide_obligation(size).verdict != "proved"
