"""Each rule of the checker, close to where it would be wrong: none accepts what does not follow."""

from itertools import pairwise

import pytest

from workbench.proof import checker
from workbench.proof.checker import CertificateError, check, goal_digest

IDENTITY = {"rule": "identity"}
X, Y = {"x": "1"}, {"x": "0", "y": "1"}


def of(show, proof, *assume, example=None, **goal):
    return {"claim": "doe2026:1", "verdict": "proved", "goal": {"assume": list(assume), "show": [show], **goal},
            "example": example or {"x": "1", "y": "1", "u": "1", "v": "1"}, "proofs": [proof]}


def add(*terms, **more):
    return {"rule": "combination", "terms": [{"coefficient": c, "factors": list(f)} for c, f in terms], **more}


def fact(name, **of):
    return add(("1", [{"fact": name, **of}]))


def contra(*terms, **more):
    return add(*terms, **more) | {"rule": "contradiction"}


def cut(lemma, proof, then):
    return {"rule": "cut", "lemma": lemma, "proof": proof, "then": then}


def cases(what, **proofs):
    return {"rule": "cases", "of": what, **proofs}


def monotone(start, derivative, at_start, variable="x"):
    return {"rule": "monotone", "variable": variable, "from": start, "derivative": derivative, "at_start": at_start}


def down(start, derivative, at_start):
    return {"rule": "monotone", "variable": "x", "to": start, "derivative": derivative, "at_start": at_start}


def falls(function, decrease, then):
    return {"rule": "nonincreasing", "function": function, "decrease": decrease, "then": then}


REST = {"x": "0", "y": "0", "t": "0"}
CLOCK = {"flow": {"x": "1", "t": "1"}, "initial": {"x": "0", "t": "0"}}
FALLING = {"flow": {"x": "y", "y": "-1", "t": "1"}, "initial": REST}
ONE, FIRST = add(("1", [])), add(("1", [{"assume": 0}]))
BOTH = {"nonnegative": IDENTITY, "nonpositive": IDENTITY}
SIGNS = {"negative": IDENTITY, "positive": IDENTITY, "zero": IDENTITY}
FORGED = {
    # identity
    "a strict identity": of("x**2 < x**2 + 0", IDENTITY), "a difference": of("x + 1 != x", IDENTITY),
    "a rate of an input": of("D(x) == D(y)", IDENTITY, flow={"y": "u"}, inputs=["u", "x"]),
    "a pole that cancels": of("(x**2 - x)/x == x - 1", IDENTITY),
    "a logarithm's domain": of("exp(log(x)) == x", IDENTITY),
    "a root of a square": of("sqrt(x**2) == x", IDENTITY), "a sign's size": of("sign(x)*abs(x) == x", IDENTITY),
    "one more to choose from": of("Max(x, y) == Max(x, y, 0)", IDENTITY),
    "a power of zero": of("(x/x)**0 == 1", IDENTITY),
    "a square of tanh": of("tanh(x)**2 == 1", IDENTITY),
    "a sum's rate": of("D(Sum(u)) == Sum(u)", IDENTITY, flow={"u": "v"}, indexed=["u", "v"]),
    # combination
    "a negative square": of("x**2 <= 0", add(("-1", [{"square": "x"}]))),
    "a weak multiplier": of("x >= 0", add(("1", [{"square": "x"}]), multiplier=[{"assume": 0}]), "x >= -1"),
    "a square as multiplier": of("1 >= 2", add(("1", []), multiplier=[{"square": "x"}])),
    "another equality": of("x >= 0", add(("1", [{"assume": 0}, {"any": "x"}])), "y == 1"),
    "an assumption from behind": of("x >= 5", add(("1", [{"assume": -5}])), "x >= 0"),
    "an assumption by a truth value": of("x >= 5", add(("1", [{"assume": False}])), "x >= 0"),
    "a weak inverse": of("1/x > 0", add(("1", [{"inverse": 0}])), "x >= 0"),
    "a weak square": of("x**2 > 0", add(("1", [{"square_of": 0}])), "x >= 0"),
    "nothing is positive": of("0 > 0", add()), "nothing is all": of("x >= 0", add()),
    "an enclosed symbol": of("x >= 1", fact("enclosure", of="x")),
    "a number too high": of("exp(1) >= 2719/1000", fact("enclosure", of="exp(1) - 2719/1000")),
    "an undefined number": of("log(-1) >= 0", fact("enclosure", of="log(-1)")),
    "a logarithm of anything": of("log(x) <= x - 1", fact("log_tangent", of="x")),
    "a logarithm of two negatives": of("log(x*y) == log(x) + log(y)", fact("log_product", **{"of": "x", "and": "y"}),
                                       "x*y > 0"),
    "a sine of anything": of("sin(x) <= x", fact("sine_tangent", of="x")),
    "a root above zero": of("sqrt(x) > 0", fact("sqrt_positive", of="x"), "x >= 0"),
    "a root of anything": of("sqrt(x)**2 == x", fact("sqrt_square", of="x")),
    "a size above zero": of("abs(x) > 0", fact("abs_nonnegative", of="x")),
    "an equality by one side": of("x == 0", FIRST, "x >= 0", example={"x": "0"}),
    "squares without a sum": of("u**2 >= 0", add(("1", [{"sum_of_squares": "u"}])), indexed=["u"]),
    "squares of a product": of("Sum(u*v) >= 0", add(("1", [{"sum_of_squares": "u*v"}])), indexed=["u", "v"]),
    "a power of ten": of("x**2 >= 0", add(("1e0", [{"square": "x"}]))),
    "digits of another script": of("x**2 >= 0", add(("\u0661", [{"square": "x"}]))),
    # cut
    "a lemma by itself": of("x >= 1", cut("x >= 1", FIRST, FIRST)),
    "an undefined lemma": of("x >= 0", cut("1/x == 1/x", IDENTITY, add(("1", [{"any": "1/x"}, {"assume": 0}])))),
    "a lemma of two": of("x >= 0", cut("0 < x < 1", IDENTITY, IDENTITY)),
    "a lemma that differs": of("x**2 > 0", cut("x != 0", IDENTITY, add(("1", [{"square_of": 0}])))),
    "a lemma on a rate": of("D(x) >= 0", cut("D(x) == 1", IDENTITY, add(("1", [{"assume": 0}]), ("1", []))),
                            flow={"x": "-1"}),
    # cases
    "one case": of("abs(x) == x", cases("x", nonnegative=IDENTITY)),
    "cases of what is undefined": of("x**2 >= 0", cases("1/x", **BOTH)),
    "a sign at zero": of("sign(x)**2 == 1", cases("x", **BOTH)),
    "three signs": of("sign(x)**2 == 1", cases("x", **SIGNS)),
    "cases of another": of("abs(x) == y", cases("y", **BOTH)),
    "cases of a sum": of("Sum(abs(u)) == Sum(u)", cases("Sum(u)", **BOTH), indexed=["u"]),
    "cases too many": of("abs(x) == x", cases("x", zero=IDENTITY, **BOTH)),
    # contradiction
    "a contradiction of nothing": of("x >= 0", contra()), "a weak one": of("x >= 0", contra(("1", [{"square": "x"}]))),
    "an assumption that is none": of("x >= 0", contra(("1", [{"assume": 7}]))),
    "the opposite, squared": of("x > 0", contra(("1", [{"assume": 0}, {"assume": 0}]))),
    "one side of an equality": of("x == 0", contra(("1", [{"assume": 1}]), ("1", [{"assume": 0}])), "x >= 0", example={
        "x": "0"}),
    "the opposite as multiplier": of("x >= 0", contra(("1", [{"assume": 0}]), multiplier=[{"assume": 0}])),
    # monotone
    "from nowhere": of("x >= 0", monotone("0", ONE, IDENTITY)),
    "over a pole": of("-1/x + 10 >= 0", monotone("-1", add(("1", [{"square": "1/x"}])), add(("11", []))), "x + 1 >= 0",
                      "x != 0"),
    "an equality that rises": of("x == 0", monotone("0", ONE, IDENTITY), "x >= 0", example={"x": "0"}),
    "over a jump": of("1 - sign(y - x) >= 0", monotone("0", IDENTITY, IDENTITY), "x >= 0"),
    "from itself": of("x >= 0", monotone("x", ONE, IDENTITY), "x >= 0"),
    "over a corner": of("1 - abs(x - 1) >= 0", monotone("0", IDENTITY, IDENTITY), "x >= 0"),
    "the end's assumption between": of("x*(y - x) >= 0", monotone("0", add(("1", [{"assume": 1}])), IDENTITY), "x >= 0",
                                       "y - 2*x >= 0 - 5", "y - x + 1 >= 0", example={"x": "0", "y": "0"}),
    "a bound from below, on the way up": of("x**2 - 2*x + 1/2 >= 0", monotone("0", add(("2", [{"assume": 3}])), add((
        "1/2", []))), "x >= 0", "x >= 1", example={"x": "2"}),
    "a bound from above, on the way down": of("x**2 + 2*x + 1/2 >= 0", down("0", add(("2", [{"assume": 3}])), add((
        "1/2", []))), "x <= 0", "x <= -1", example={"x": "-2"}),
    "a bound that moves, on the way up": of(
        "y**2 - (x - y)**2 >= 0", monotone("0", add(("2", [{"assume": 3}])), IDENTITY), "x >= 0", "y - 2*x + 1 >= 0",
        example={"x": "0", "y": "0"}),
    "down to nowhere": of("-x >= 0", down("0", ONE, IDENTITY)),
    "down the wrong way": of("x >= 0", down("0", ONE, IDENTITY), "x <= 0", example={"x": "0"}),
    "down where it is assumed to be up": of("1 - x >= 0", down("1", ONE, IDENTITY), "x >= 1"),
    "up and down": of("x >= 0", monotone("0", ONE, IDENTITY) | {"to": "0"}, "x <= 0", example={"x": "0"}),
    "neither up nor down": of("x >= 0", {"rule": "monotone", "variable": "x", "derivative": ONE, "at_start": IDENTITY}),
    "down over a pole": of("1/x + 10 >= 0", down("1", add(("1", [{"square": "1/x"}])), add(("11", []))), "x <= 1",
                           "x != 0"),
    "down to itself": of("-x >= 0", down("x", ONE, IDENTITY), "x - x >= 0"),
    "down over a corner": of("1 - abs(x + 1) >= 0", down("0", IDENTITY, IDENTITY), "x <= 0", example={"x": "0"}),
    "the end's assumption between, downwards": of(
        "-x*(y + x) >= 0", down("0", add(("1", [{"assume": 1}])), IDENTITY), "x <= 0", "y + 2*x >= 0 - 5",
        "y + x + 1 >= 0", example={"x": "0", "y": "0"}),
    # nonincreasing
    "from no start": of("x <= 0", falls("x", ONE, FIRST), flow={"x": "-1"}, example={"x": "0"}),
    "the end's assumption before": of("x <= 0", falls("x", FIRST, add(("1", [{"assume": 1}]))), "y <= 1", flow={
        "x": "y", "y": "-1"}, initial={"x": "0", "y": "1"}, example=Y),
    "an input that falls": of("u <= 0", falls("u", IDENTITY, FIRST), flow={"x": "-1"}, initial={"x": "0"}, inputs=["u"],
                              example={"x": "0", "u": "0"}),
    "one start of two": of("x <= 0", falls("x", ONE, FIRST), flow={"x": "-1", "y": "1"}, initial={"x": "0"}, example=Y),
    "a size that rises": of("abs(x) <= 0", falls("abs(x)", IDENTITY, FIRST), flow={"x": "1"}, initial={"x": "0"},
                            example={"x": "0"}),
    "over a pole in time": of("-1/x >= 1", falls("1/x", add(("1", [{"square": "1/x"}])), FIRST), flow={"x": "1"},
                              initial={"x": "-1"}, example={"x": "-1"}),
    "a start that moves": of("x <= y", falls("x", IDENTITY, IDENTITY), flow={"x": "0", "y": "-1"}, initial={
        "x": "y", "y": "0"}, example={"x": "0", "y": "0"}),
    "a sign as a rate": of("abs(x) <= 0", falls("x**2", add(("2", [{"fact": "abs_nonnegative", "of": "x"}])), IDENTITY),
                           flow={"x": "sign(x)"}, initial={"x": "0"}, example={"x": "0"}),
    # an example whose motion breaks at once what always holds: of no motion anything would follow
    "an equality that is left": of("t**2 <= 0", falls("x**2", add(("-2", [{"assume": 0}])), falls(
        "t**2/2 - x*t", add(("1", [{"assume": 1}])), add(
            ("4", [{"assume": 1}]), ("1", [{"square": "t - 2*x"}]), ("4", [{"assume": 0}])))), example=REST, **CLOCK,
                                   always=["x == 0"]),
    "left at the second rate": of("y**2 >= 0", add(("1", [{"square": "y"}])), example=REST, always=["x >= 0"],
                                  **FALLING),
    "left at the third rate": of("y**2 >= 0", add(("1", [{"square": "y"}])), example=REST, always=["x >= 0"], **(
        FALLING | {"flow": {"x": "-y**2", "y": "1", "t": "1"}})),
    # no rule
    "on trust": of("x >= 0", {"rule": "trust"}), "a list of rules": of("x >= 0", {"rule": ["identity"]}),
}


def bound(certificate):
    return certificate | {"version": 2, "goal_digest": goal_digest(certificate)}


@pytest.mark.parametrize("name", FORGED)
def test_what_does_not_follow_is_refused(name):
    with pytest.raises(CertificateError):
        check(bound(FORGED[name]))


@pytest.mark.parametrize("honest", [
    of("x**2 + y**2 >= 0", add(("1", [{"square": "x"}]), ("1", [{"square": "y"}]))),
    of("abs(x)**2 == x**2", cases("x", **BOTH)),
    of("x >= 0", contra(("1", [{"assume": 0}]), ("1", [{"assume": 1}])), "x > 0"),
    of("exp(x) - 1 >= 0", monotone("0", fact("exp_positive", of="x"), IDENTITY), "x >= 0"),
    of("2*x - x**2 >= 0", monotone("0", add(("2", [{"assume": 3}])), IDENTITY), "x >= 0", "x <= 1"),
    of("-2*x - x**2 >= 0", down("0", add(("2", [{"assume": 3}])), IDENTITY), "x <= 0", "x >= -1", example={"x": "-1"}),
    of("1 - exp(x) >= 0", down("0", fact("exp_positive", of="x"), IDENTITY), "x <= 0", example={"x": "-1"}),
    of("x <= 0", falls("x", ONE, FIRST), flow={"x": "-1"}, initial={"x": "0"}, example={"x": "0"}),
    of("y**2 >= 0", add(("1", [{"square": "y"}])), example=REST, always=["x >= 0"], initial=REST,
       flow={"x": "y", "y": "1", "t": "1"}),
    of("y**2 + 1 > 0", add(("1", [{"square": "y"}]), ("1", [])), example=REST, always=["x == 0"], initial=REST,
       flow={"x": "x*y", "y": "1", "t": "1"}),
    of("log(y) == log(y) + 0", cut("y > 0", add(("1", [{"assume": 0}]), ("1", [{"assume": 1}])), IDENTITY), "x > 0",
       "y - x >= 0"),
], ids=lambda honest: honest["goal"]["show"][0])
def test_what_follows_is_accepted(honest):
    check(bound(honest))


def chain(parts):
    """So many certificates of one line, each of which assumes what the one before shows."""
    whole, before = [], {}
    for number in range(parts):
        one = of("x**2 >= 0", add(("1", [{"square": "x"}])), *["x**2 >= 0"][:number], flow={"x": "1"}, example=X)
        whole.append(bound(one | {"claim": f"doe2026:{number}", "premises": before}))
        before = {str(number): whole[-1]["goal_digest"]}
    names = [str(number) for number in range(parts)]
    links = [{"of": two, "assume": 0, "by": one, "show": 0} for one, two in pairwise(names)]
    return whole[-1] | {"composition": {"certificates": dict(zip(names[:-1], whole[:-1], strict=True)), "cited": {},
                                        "links": links, "assumes": {name: [] for name in names}}}


def test_a_theorem_of_many_parts_is_refused_before_it_takes_long(monkeypatch):
    monkeypatch.setattr(checker, "MOST_WORK", 10_000)
    check(chain(10))
    with pytest.raises(CertificateError, match="takes more than 10000 steps of work"):  # of how they hang together
        check(chain(60))
    monkeypatch.setattr(checker, "MOST_OF_PARTS", 500)
    with pytest.raises(CertificateError, match="all parts together"):
        check(chain(40))
