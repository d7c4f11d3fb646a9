"""The size of a sum is that of a number: nothing is proved that forgets which sum stands in it."""

import pytest

from workbench.proof.checker import CertificateError, check
from workbench.proof.decide.obligations import decide_obligation

CASES = {"rule": "cases", "of": "Sum(u)", "nonnegative": {"rule": "identity"}, "nonpositive": {"rule": "identity"}}
SQUARE = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"fact": "abs_square", "of": "Sum(u)"}]}]}


def certificate(show, proof, **goal):
    return {"claim": "doe2026:1", "version": 1, "verdict": "proved", "example": {"u": "1", "v": "1", "x": "1"},
            "goal": {"assume": [], "show": [show], "indexed": ["u", "v"], **goal}, "proofs": [proof]}


GENUINE = {
    "its square": certificate("abs(Sum(u))**2 == Sum(u)**2", SQUARE),
    "even": certificate("abs(-Sum(u)) == abs(Sum(u)) + 0", {"rule": "identity"}),
}
IDENTITIES = (
    "abs(Sum(u)) == Sum(abs(u))", "abs(Sum(u)) == Sum(u)", "abs(Sum(u))**2 == Sum(u**2)", "abs(Sum(u)) == abs(Sum(v))",
    "abs(Sum(u*v)) == abs(Sum(u))*abs(Sum(v))", "Sum(u*abs(Sum(v))) == Sum(u*abs(v))", "abs(Sum(u*x)) == x*abs(Sum(u))",
    "Sum(abs(Sum(u))) == abs(Sum(u))", "abs(Sum(1)) == 1", "abs(Sum(u) + x) == abs(Sum(u + x))",
    "sqrt(Sum(u)**2) == abs(Sum(u))", "abs(Sum(u)*Sum(v)) == abs(Sum(u*v))", "exp(abs(Sum(u))) == exp(Sum(abs(u)))",
)
FORGED = {
    **{f"identity {text}": certificate(text, {"rule": "identity"}) for text in IDENTITIES},
    **{f"by cases {text}": certificate(text, CASES) for text in IDENTITIES if "x" not in text},
    "the square of the terms": certificate("abs(Sum(u))**2 == Sum(u**2)", SQUARE),
    "another sum's square": certificate("abs(Sum(v))**2 == Sum(u)**2", SQUARE),
    "one case": certificate("abs(Sum(u)) == Sum(u)", {k: v for k, v in CASES.items() if k != "nonpositive"}),
    "a rate": certificate("D(abs(Sum(u))) == abs(Sum(v))", {"rule": "identity"}, flow={"u": "v"}),
    "a size called positive": certificate("abs(Sum(u)) > 0", {"rule": "combination", "terms": [
        {"coefficient": "1", "factors": [{"positive": "abs(Sum(u))"}]}]}),
    "below a fraction bar": certificate("abs(Sum(u))/abs(Sum(u)) == 1", {"rule": "identity"}),
    "a size below zero": {"claim": "doe2026:1", "version": 1, "verdict": "refuted", "point": {}, "terms": [
        {"u": "1"}, {"u": "-2"}], "goal": {"assume": [], "show": ["abs(Sum(u)) >= 1"], "indexed": ["u"]}},
    "a size of no term": {"claim": "doe2026:1", "version": 1, "verdict": "refuted", "point": {}, "terms": [], "goal": {
        "assume": [], "show": ["abs(Sum(u)) <= 0"], "indexed": ["u"]}},
}


@pytest.mark.parametrize("name", GENUINE)
def test_what_holds_is_accepted(name):
    check(GENUINE[name])


@pytest.mark.parametrize("name", FORGED)
def test_what_does_not_is_refused(name):
    with pytest.raises(CertificateError):
        check(FORGED[name])


@pytest.mark.parametrize(("show", "verdict"), [
    (["<=", "abs(Sum(u*v))", "sqrt(Sum(u**2))*sqrt(Sum(v**2))"], "proved"),
    (["<=", "Sum(u)", "abs(Sum(u))"], "proved"),
    (["<=", "abs(Sum(u*v))", "sqrt(Sum(u**2))*sqrt(Sum(v**2))/2"], "refuted"),
    (["<=", "abs(Sum(u))", "Sum(u)"], "refuted"),
])
def test_a_size_is_decided_rightly(show, verdict):
    found = decide_obligation({"assume": [], "show": show, "indexed": ["u", "v"]})
    assert found.verdict == verdict
    for each in found.certificates:
        check(each)
