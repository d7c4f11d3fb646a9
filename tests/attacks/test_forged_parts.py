"""Certificates with one part that is not what its rule asks for: a factor, a fact, a case, a lemma, a start, a root."""

import pytest
from test_forged_rules import (
    BOTH,
    CLOCK,
    FIRST,
    IDENTITY,
    ONE,
    REST,
    add,
    bound,
    cases,
    contra,
    cut,
    fact,
    falls,
    monotone,
    of,
)

from workbench.proof.checker import CertificateError, check

PARTS_OF_GOALS = {"flow", "initial", "always", "indexed", "inputs"}


def square(text):
    return add(("1", [{"square": text}]))


def false(show, point, *assume, **more):
    parts = {name: more.pop(name) for name in PARTS_OF_GOALS & more.keys()}
    return {
        "claim": "doe2026:1",
        "verdict": "refuted",
        "goal": {"assume": list(assume), "show": [show], **parts},
        "point": point,
        **more,
    }


FORGED = {
    # combination
    "a product of an equality and a pole": of(
        "x >= 1", add(("1", [{"assume": 0}, {"any": "1/y"}])), "x == 1", "y >= 0", example={"x": "1", "y": "1"}
    ),
    "an inverse of an equality": of("1/x == 1", add(("1", [{"inverse": 0}])), "x == 1"),
    "an inverse of a difference": of("1/x > 0", add(("1", [{"inverse": 0}])), "x != 0"),
    "a square of a weak margin as multiplier": of(
        "x >= 0", add(("1", [{"assume": 0}, {"assume": 0}]), multiplier=[{"square_of": 0}]), "x**3 >= 0"
    ),
    "a positive that is weak": of("x + 1 > 0", add(("1", [{"positive": "x + 1"}])), "x >= -1", example={"x": "0"}),
    "a positive by a square": of("x**2 > 0", add(("1", [{"positive": "x**2"}]))),
    "a positive sum": of("Sum(u**2) > 0", add(("1", [{"positive": "Sum(u**2)"}])), indexed=["u"]),
    "a positive sum of exps": of("Sum(exp(u)) > 0", add(("1", [{"positive": "Sum(exp(u))"}])), indexed=["u"]),
    "a positive number of terms": of("Sum(1) > 0", add(("1", [{"positive": "Sum(1)"}]))),
    "one term at least": of("Sum(1) >= 1", add(("1", [{"square": "Sum(1)"}]))),
    "a coefficient below zero on an assumption": of("x <= 0", add(("-1", [{"assume": 0}])), "x >= 0"),
    "an even product of unknown signs": of("x*y >= 0", add(("1", [{"any": "x"}, {"any": "y"}]))),
    "an equality's square as strict": of("x**2 > 0", add(("1", [{"assume": 0}, {"assume": 0}])), "x == 0"),
    "a sum beside its own factor": of(
        "Sum(u)*x >= 0", add(("1", [{"assume": 0}, {"sum_of_squares": "u"}])), "x >= 0", indexed=["u"]
    ),
    "squares with an outer sum": of(
        "Sum(u*v)**2 <= Sum(u**2)", add(("1", [{"sum_of_squares": "u - v*Sum(u*v)"}])), indexed=["u", "v"]
    ),
    # facts
    "exp's tangent from above": of("exp(x) <= 1 + x", add(("-1", [{"fact": "exp_tangent", "of": "x"}]))),
    "a cosine from above": of("cos(x) <= 1 - x**2/2", add(("-1", [{"fact": "cosine_parabola", "of": "x"}]))),
    "a sine of less": of("sin(x) <= x", fact("sine_tangent", of="x"), "x >= -1"),
    "an enclosure of a sine far away": of("sin(100) >= 1/2", fact("enclosure", of="sin(100) - 1/2")),
    "an enclosure at zero": of("cos(0) - 1 > 0", fact("enclosure", of="cos(0) - 1")),
    "an enclosure with a symbol that cancels": of("exp(x - x) >= 2", fact("enclosure", of="exp(x - x) - 2")),
    "a sum of sines": of("sin(x + y) == sin(x) + sin(y)", fact("sine_sum", **{"of": "x", "and": "y"})),
    "exp of a sum over an index": of(
        "exp(Sum(u)) == exp(Sum(u))*exp(0)", fact("exp_sum", **{"of": "Sum(u)", "and": "0"}), indexed=["u"]
    ),
    "a root's square of a negative": of("sqrt(x**2 - 1)**2 == x**2 - 1", fact("sqrt_square", of="x**2 - 1")),
    "a positive root of a square": of("sqrt(x**2) > 0", fact("sqrt_positive", of="x**2")),
    "a size's square beside a sign": of("abs(x)*x == x**2", fact("abs_square", of="x")),
    "a fact of no name": of("x >= 0", fact("trust", of="x")),
    "a log of a product of roots": of(
        "log(sqrt(x)*sqrt(y)) == log(x)/2 + log(y)/2",
        fact("log_product", **{"of": "sqrt(x)", "and": "sqrt(y)"}),
        "x > 0",
        "y > 0",
    ),
    # cases
    "cases that forget zero": of("sign(x)**2 >= 1", cases("x", negative=IDENTITY, positive=IDENTITY)),
    "the case of another size": of("abs(x + y) == x + y", cases("x", **BOTH)),
    "cases inside a sum": of("Sum(sign(u)*u) >= 0", cases("Sum(u)", **BOTH), indexed=["u"]),
    "a case kept for the other": of("x >= 0", cases("x", nonnegative=FIRST, nonpositive=add(("1", [{"assume": 0}])))),
    # cut
    "a lemma of the goal's opposite": of(
        "x >= 1", cut("x < 1", contra(("1", [{"assume": 0}])), contra(("1", [{"assume": 0}])))
    ),
    "a lemma with a rate of an input": of("x >= 0", cut("D(u) == 0", IDENTITY, FIRST), flow={"x": "u"}, inputs=["u"]),
    "a lemma of an index": of("x >= 0", cut("u**2 >= 0", square("u"), FIRST), indexed=["u"]),
    # monotone
    "an indexed variable": of("Sum(u) >= 0", monotone("0", ONE, IDENTITY, "u"), "Sum(u) >= 0", indexed=["u"]),
    "monotone downward": of("1 - x >= 0", monotone("0", ONE, ONE), "x >= 0"),
    "monotone past a strict start": of("x > 0", monotone("0", ONE, IDENTITY), "x >= 0", example={"x": "1"}),
    "monotone with a moving start": of(
        "x - y >= 0", monotone("y**2", ONE, square("y")), "x - y**2 >= 0", example={"x": "1", "y": "1"}
    ),
    "the variable in an assumption of another": of(
        "y*x >= 0",
        monotone("0", add(("1", [{"assume": 1}])), IDENTITY),
        "x >= 0",
        "y*x - y**3 >= 0",
        example={"x": "1", "y": "1"},
    ),
    # flow
    "a function that rises": of("x <= 0", falls("x", IDENTITY, FIRST), example=REST, **CLOCK),
    "backwards in time": of("t <= 0", falls("-t", ONE, FIRST), example=REST, **CLOCK),
    "no time passes": of("x == 0", falls("x", ONE, IDENTITY), example=REST, **CLOCK),
    # refuted
    "a point where it is undefined": false("1/x >= 0", {"x": "0"}),
    "a point by a hair of a root": false("x**2 == 2", {"x": "1"}, "x**2 == 2"),
    "a point off its start": false("x >= 0", {"x": "-1"}, flow={"x": "0"}, initial={"x": "0"}),
    "a point that does not keep": false("x >= 1", {"x": "0"}, flow={"x": "1"}, always=["x >= 0"]),
    "terms that are not there": false("Sum(u) >= 0", {}, indexed=["u"], terms=[{"v": "-1"}]),
    "a root of no polynomial": false(
        "x >= 2", {"x": "1"}, "exp(x) == 3", roots=[{"of": "x", "from": "1", "to": "2", "equality": "exp(x) == 3"}]
    ),
    "a root without a change of sign": false(
        "x >= 2", {"x": "0"}, "x**2 == 0", roots=[{"of": "x", "from": "-1", "to": "1", "equality": "x**2 == 0"}]
    ),
    "a root outside": false(
        "x >= 0", {"x": "5"}, "x**2 == 2", roots=[{"of": "x", "from": "-2", "to": "-1", "equality": "x**2 == 2"}]
    ),
    "a root of another assumption": false(
        "x >= 0", {"x": "-1"}, "x**2 == 2", roots=[{"of": "x", "from": "-2", "to": "-1", "equality": "x**2 == 3"}]
    ),
    "a path that jumps": false(
        "x <= 1",
        {"x": "2"},
        flow={"x": "1"},
        initial={"x": "0"},
        path={"x": "2*tau"},
        time="tau",
        duration="1",
        always=[],
    ),
    "a path back in time": false(
        "x >= 0", {"x": "-1"}, flow={"x": "1"}, initial={"x": "0"}, path={"x": "tau"}, time="tau", duration="-1"
    ),
}


# What these are refused by is no slip in how they are written.
SLIPS = ("malformed: KeyError", "malformed: TypeError", "malformed: AttributeError", "version")


def test_none_is_accepted_and_each_is_refused_for_what_it_says():
    for name, forged in FORGED.items():
        with pytest.raises(CertificateError) as refused:
            check(bound(forged))
        assert not str(refused.value).startswith(SLIPS), name
    assert len(FORGED) >= 50
