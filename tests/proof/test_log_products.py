"""Sums of logarithms are decided by the product of their arguments; what is false by a little is not proved."""

import pytest

from workbench.proof.checker import check
from workbench.proof.decide.obligations import belongs, decide_obligation

POSITIVE = [[">", "x", "0"], [">", "y", "0"]]
INSIDE = [[">", "k", "0"], ["<", "x", "k"], [">", "x", "-k"]]
TRUE = {
    "the logarithm is concave": (POSITIVE, ">=", "log((x + y)/2)", "log(x)/2 + log(y)/2"),
    "the mean of three": ([*POSITIVE, [">", "z", "0"]], ">=", "3*log((x + y + z)/3)", "log(x) + log(y) + log(z)"),
    "a barrier bounds the square": (INSIDE, ">=", "log(k**2/(k**2 - x**2))", "x**2/k**2"),
    "a barrier on two sides": (INSIDE, ">=", "log(k/(k - x)) + log(k/(k + x))", "x**2/k**2"),
    "a denominator that cancels": ([[">", "x", "0"], [">", "y", "1"]], ">", "log(x*y)", "log(x)"),
    "no sign is assumed of y": ([[">=", "x", "1"], [">=", "y", "x"]], ">=", "log(y) - log(x)", "0"),
}
FALSE = {
    "the logarithm is not convex": (POSITIVE, "<=", "2*log((x + y)/2)", "log(x) + log(y)"),
    "Bernoulli with too much": ([[">", "y", "0"]], ">=", "2*log(1 + y)", "log(1 + 3*y)"),
    "a factor may be below 1": (POSITIVE, ">=", "log(x*y) - log(x)", "0"),
}


@pytest.mark.parametrize("name", TRUE)
def test_a_sum_of_logarithms_is_proved_with_a_certificate_of_its_own(name):
    assume, *show = TRUE[name]
    fact = {"assume": assume, "show": show}
    outcome = decide_obligation(fact)
    assert outcome.verdict == "proved"
    for certificate in outcome.certificates:
        check(certificate)
    assert belongs(fact, "proved", outcome.certificates)


@pytest.mark.parametrize("name", FALSE)
def test_what_is_false_by_a_little_is_refuted(name):
    assume, *show = FALSE[name]
    assert decide_obligation({"assume": assume, "show": show}).verdict == "refuted"
