"""Numbers that differ by less than a float tells, and what is remembered while checking: neither passes for a proof."""

from fractions import Fraction

import pytest

from workbench.proof.checker import ACCEPTED, CertificateError, Context, Ratio, check, digest_of, goal_digest, number

IDENTITY = {"rule": "identity"}
TINY, LONG = 10**17, 10**400  # beyond a float's digits, and beyond the length at which denominators are made one
NEARLY_EQUAL = (
    f"x*{TINY + 1}/{TINY} == x", f"x/3 == x*{TINY // 3}/{TINY}", f"(x + 1/{TINY})**2 == x**2 + 2*x/{TINY}",
    f"(x/{LONG} + 1)*(x + 1/{LONG}) == x + 1/{LONG} + x**2/{LONG}", f"({TINY + 1}*x**2 + x)/({TINY}*x + 1) == x",
    f"(x**2/{LONG} - 1/{LONG + 1})/(x - 1) == (x + 1)/{LONG}", f"(x + y)/({TINY + 1}*x) == (x + y)/({TINY}*x)")


def certificate(show: str, proof: dict, *assume: str) -> dict:
    names = {name: "2" for name in ("x", "y") if name in show}
    return {"claim": "forged2020:1", "version": 1, "verdict": "proved", "example": names, "proofs": [proof],
            "goal": {"assume": ["x > 1", *assume], "show": [show]}}


def test_numbers_nearly_equal_differ():
    for show in NEARLY_EQUAL:
        with pytest.raises(CertificateError, match="differ"):
            check(certificate(show, IDENTITY, "x > 0"))


def test_a_combination_that_nearly_adds_up_is_refused():
    proof = {"rule": "combination", "terms": [{"coefficient": f"{TINY}/{TINY + 1}", "factors": [{"assume": 0}]}]}
    with pytest.raises(CertificateError, match="add up"):
        check(certificate("x >= 1", proof))


def test_no_number_of_a_value_is_a_float():
    context = Context({}, [])
    for text in ("3/7*x + 1/2", "(x**2 - 1)/(2*x - 2)", "(2*x*y + 4*y)/(6*y)", "((x + 1/3)/5)**3", "x/2/3 - x/6",
                 "abs(-3/2)", "1/(7*x)", "(x/2 + 1/3)*(x/5 - 1/7)/(x/2 + 1/3)"):
        value: Ratio = context.read(text)
        assert {type(c) for c in (*value.num.values(), *value.den.values())} <= {int, Fraction}, text
    assert number(Fraction(4, 2)).num[()] == 2


def test_a_theorem_is_remembered_with_its_goal_alone():
    """What was accepted is remembered by all that it says: a theorem whose own proof was exchanged is checked."""
    honest = certificate("x >= 1", {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 0}]}]})
    honest["goal_digest"] = goal_digest(honest)
    check(honest)
    ACCEPTED.add(digest_of(honest))
    forged = honest | {"goal": {"assume": ["x > 1"], "show": ["x >= 2"]}}
    forged["goal_digest"] = goal_digest(forged)
    parts = {"certificates": {}, "cited": {}, "links": [], "assumes": {"1": ["x > 1"]}}
    check(honest | {"composition": parts})
    with pytest.raises(CertificateError, match="add up"):
        check(forged | {"composition": parts})
