"""Facts of textbooks that need a tangent at the right place, a quotient of logarithms, or the square of a margin."""

import json
from pathlib import Path

import pytest

from workbench.proof.checker import check
from workbench.proof.decide.obligations import belongs, decide_obligation

FACTS = json.loads((Path(__file__).parents[2] / "benchmarks" / "textbook" / "facts.json").read_text(encoding="utf-8"))
NEEDED = ("log grows", "abs and tanh, with 0.2785", "Minkowski in two dimensions", "trace bounds the form",
          "a transient below its supremum")


@pytest.mark.parametrize("name", NEEDED)
def test_it_is_proved_with_a_certificate_of_its_own(name):
    fact, = (fact for fact in FACTS if fact["problem"].endswith(name))
    outcome = decide_obligation(fact)
    assert outcome.verdict == "proved"
    for certificate in outcome.certificates:
        check(certificate)
    assert belongs(fact, "proved", outcome.certificates)


def test_what_is_a_little_too_sharp_is_refuted():
    smoothing = {"assume": [[">", "k", "0"]], "show": ["<=", "abs(x) - x*tanh(x/k)", "278/1000*k"]}
    assert decide_obligation(smoothing).verdict == "refuted"
    transient = {"assume": [[">=", "x", "0"]], "show": ["<=", "x*exp(-x)", "367/1000"]}
    assert decide_obligation(transient).verdict == "refuted"
