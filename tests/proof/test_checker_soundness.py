"""Certificates of false claims, each made to slip through one gap; the checker must refuse them all."""

import json

import pytest
from verdicts import assert_refused

from workbench.proof.checker import check, check_file, check_folder

IDENTITY = {"rule": "identity"}


def proved(show, proof, assume=(), example=None, **goal):
    return {"version": 1, "verdict": "proved", "example": example or {}, "proofs": [proof],
            "goal": {"assume": list(assume), "show": [show], **goal}}


def refuted(show, point, assume=(), **goal):
    return {"version": 1, "verdict": "refuted", "point": point,
            "goal": {"assume": list(assume), "show": [show], **goal}}


def combination(*terms, **more):
    return {"rule": "combination", "terms": [{"coefficient": c, "factors": list(f)} for c, *f in terms], **more}


def model(functions, point=None, **goal):
    """A model of 'x <= 0 from some time on' that is said to fail; the goal's parts can be replaced."""
    whole = {"show": ["x <= 0"], "assume": [], "always": [], "flow": {"t": "1", "x": "w"}, "eventually": "t"} | goal
    whole.setdefault("inputs", sorted(rate for rate in whole["flow"].values()
                                      if rate.isidentifier() and rate not in whole["flow"]))
    return {"version": 1, "verdict": "gap", "goal": whole, "functions": functions, "point": point or {},
            "always": [], "fails": combination(("1",))}


DECREASE = {"rule": "nonincreasing", "function": "x", "decrease": combination(("1", {"assume": 0})),
            "then": combination(("1", {"assume": 0}))}
UNRELATED = {"t": "0", "x": "0", "w": "0"}

ATTACKS = {
    # what a point may name
    "a point that gives the sum itself a value":
        (refuted("Sum(x**2) >= 0", {"x": "1", "Sum()": "-1"}, indexed=["x"]), "not the name of a symbol"),
    "a point that gives a logarithm a value":
        (refuted("log(x) <= x", {"x": "1", "log#0": "9"}), "not the name of a symbol"),
    "a flow for the sum itself":
        (proved("D(Sum(c)) == c", IDENTITY, example={"c": "1"}, flow={"Sum()": "1"}), "not the name"),
    "a flow for an atom":
        (proved("x == x", IDENTITY, flow={"log#0": "1"}), "not the name of a symbol"),
    "monotone in the number of neurons":
        (proved("Sum(1) >= 1", {"rule": "monotone", "variable": "Sum()", "from": "1",
                                "derivative": combination(("1",)), "at_start": IDENTITY}, ["Sum(1) >= 1"]),
         "not the name of a symbol"),
    # numbers that are none
    **{f"coefficient {value!r}": (proved("x**2 >= 0", combination((value, {"square": "x"})), example={"x": "1"}),
                                  "not a rational number")
       for value in (1, 1.0, True, float("inf"), float("nan"), None, ["1"], "nan", "inf", "1e5", "1/0x2", " 1", "1.0",
                     "0b1", "\u0661", "1_0", "+1")},
    "coefficient 1/0": (proved("x**2 >= 0", combination(("1/0", {"square": "x"})), example={"x": "1"}), "ZeroDivision"),
    "a point with a float": (refuted("x <= 0", {"x": 0.5}), "not a rational number"),
    "a power of ten that fills the memory": (refuted("x <= 0", {"x": "1e999999999"}), "not a rational number"),
    "true as a number": (proved("True == 1", IDENTITY), "not an expression"),
    "a float in a relation": (proved("0.5 * 2 == 1", IDENTITY), "not an expression"),
    "a comment in a relation": (proved("x == x #", IDENTITY, example={"x": "1"}), "not an expression"),
    "letters that look alike": (proved("\ufb01 == fi", IDENTITY, example={"fi": "1"}), "not an expression"),
    "two operators": (proved("0 <= x < 1", IDENTITY), "no single relation"),
    "two operators, one hidden": (proved("0 <= x<1", IDENTITY), "not an expression"),
    "an assignment": (proved("(x := 1) == 1", IDENTITY), "not an expression"),
    # shapes
    "texts instead of lists": (proved("x == x", IDENTITY, indexed="x"), "lists and maps"),
    "a goal in one text": ({**proved("x == x", IDENTITY), "goal": {"show": "x == x"}}, "lists and maps"),
    "an unknown part of a goal": (proved("x == x", IDENTITY, assumes=["x > 0"]), "a goal has no assumes"),
    "no relation": ({"version": 1, "verdict": "proved", "goal": {"show": []}, "proofs": [], "example": {}},
                    "one proof"),
    "fewer proofs than relations": ({**proved("x == x", IDENTITY), "proofs": []}, "one proof"),
    "deep nesting": (proved("-" * 5000 + "x == x", IDENTITY, example={"x": "1"}), "cannot read|malformed"),
    "deep brackets": (proved("(" * 5000 + "x" + ")" * 5000 + " == x", IDENTITY, example={"x": "1"}), "cannot read"),
    "a tower of powers": (proved("((2**64)**64)**64 >= 0", IDENTITY), "too large|more than"),
    "an expansion without end": (proved("((((a+b+c+d)**64)**64)**64) == 1", IDENTITY), "too large|more than"),
    "an exponential without end": (refuted("exp(x) <= 1", {"x": "1000000000000"}), "too large|more than"),
    "a huge power": (proved("x**1000000000 >= 0", IDENTITY), "up to 64"),
    "an unknown verdict": ({**proved("x == x", IDENTITY), "verdict": "assumed"}, "not for this checker"),
    # where things are undefined
    "a cancelled denominator": (proved("x/x == 1", IDENTITY, example={"x": "1"}), "not shown non-zero"),
    "a cancelled power": (proved("x**2*x**(-2) == 1", IDENTITY, example={"x": "1"}), "not shown non-zero"),
    "a hidden exponent": (proved("x**(1-2)*x == 1", IDENTITY, example={"x": "1"}), "not shown non-zero"),
    "a logarithm that cancels": (proved("log(x) - log(x) == 0", IDENTITY, example={"x": "1"}), "not shown positive"),
    "exp undoes log": (proved("exp(log(x)) == x", IDENTITY, example={"x": "1"}), "not shown positive"),
    "log of a square": (proved("log(x**2) <= x**2 - 1", combination(("1", {"fact": "log_tangent", "of": "x**2"})),
                               example={"x": "1"}), "not shown positive"),
    "a denominator assumed weakly": (proved("x/x == 1", IDENTITY, ["x >= 0"], {"x": "1"}), "not shown non-zero"),
    "a denominator of a square": (proved("1/(x**2) > 0", combination(("1", {"square": "1/x"})), example={"x": "1"}),
                                  "not shown non-zero"),
    "a false point where undefined": (refuted("x/x <= 0", {"x": "0"}), "undefined at the point|zero"),
    "a false point at log 0": (refuted("0*log(x) >= 1", {"x": "0"}), "undefined at the point|not positive"),
    "an undefined assumption at the point": (refuted("x >= 1", {"x": "0"}, ["1/x*x <= 1"]),
                                             "not shown non-zero|undefined"),
    "a rate that is undefined at the point": (refuted("D(x) <= 0", {"x": "1", "y": "0"}, flow={"x": "y/y"}),
                                              "undefined at the point"),
    "a rate that is undefined": (proved("D(x) == 1", IDENTITY, example={"x": "1", "y": "1"}, flow={"x": "y/y"}),
                                 "not shown non-zero"),
    "a rate with exp log": (proved("D(x) == y", IDENTITY, example={"x": "1", "y": "1"}, flow={"x": "exp(log(y))"}),
                            "not shown positive"),
    "an undefined initial value": (proved("x == x", IDENTITY, example={"x": "1", "y": "1"}, flow={"x": "1"},
                                          initial={"x": "y/y"}), "not shown non-zero"),
    "a factor of zero that is undefined": (proved("x == 0", combination(("1", {"assume": 0}, {"any": "y/y"})),
                                                  ["x == 0"], {"x": "0", "y": "1"}), "not shown non-zero"),
    # sums
    "an index that no sum binds": (proved("x == x", IDENTITY, indexed=["x"]), "outside a sum"),
    "an index bound by another sum": (proved("x*Sum(1) == Sum(x)", IDENTITY, indexed=["x"]), "outside a sum"),
    "a product of sums": (proved("Sum(x)*Sum(y) == Sum(x*y)", IDENTITY, indexed=["x", "y"]), "two sides differ"),
    "a sum of a sum": (proved("Sum(Sum(x)*y) == Sum(x)", IDENTITY, indexed=["x", "y"]), "two sides differ"),
    "division by a sum": (proved("Sum(x)/Sum(x) == 1", IDENTITY, ["Sum(x) >= 0"], {"x": "1"}, indexed=["x"]),
                          "not shown non-zero"),
    "log of a sum": (proved("log(Sum(x)) == Sum(log(x))", IDENTITY, indexed=["x"]), "log of a sum|not shown positive"),
    "exp of a sum": (proved("exp(Sum(x)) == Sum(exp(x))", IDENTITY, indexed=["x"]), "exp of a sum"),
    "a sum of one": (proved("Sum(1) == 1", IDENTITY), "sides differ"),
    "a sum that is not positive": (proved("Sum(x**2) > 0", combination(("1", {"sum_of_squares": "x"})),
                                          indexed=["x"], example={"x": "1"}), "no strictly positive"),
    "a sum of squares with a sign": (proved("Sum(a*x**2) >= 0", combination(("1", {"sum_of_squares": "x"},
                                                                            {"any": "a"})), indexed=["x"],
                                            example={"x": "1", "a": "1"}), "may be negative"),
    "a square with a free index": (proved("x >= 0", combination(("1", {"square": "x"})), indexed=["x"]),
                                   "outside a sum"),
    "a rate of an index that is no rate of a sum": (
        proved("D(s) == 0", IDENTITY, flow={"s": "x"}, indexed=["x"], example={"s": "1"}), "outside a sum"),
    "an index of rates from another index": (
        proved("D(Sum(x)) == Sum(y)", IDENTITY, flow={"x": "Sum(y)"}, indexed=["x", "y"]), "two sides differ"),
    # signs
    "a weak multiplier": (proved("x >= 0", combination(multiplier=[{"assume": 0}]), ["y >= 0"], {"x": "1", "y": "0"}),
                          "multiplier"),
    "a multiplier that is zero": (proved("x >= 0", combination(multiplier=[{"assume": 0}]), ["y == 0"],
                                         {"x": "1", "y": "0"}), "multiplier"),
    "a negative coefficient": (proved("-x**2 >= 0", combination(("-1", {"square": "x"})), example={"x": "0"}),
                               "negative"),
    "an unequal factor": (proved("x >= 0", combination(("1", {"assume": 0})), ["x != 0"], {"x": "1"}), "negative"),
    "strict from weak": (proved("x > 0", combination(("1", {"assume": 0})), ["x >= 0"], {"x": "1"}), "strictly"),
    "strict from a coefficient of zero": (proved("x > 0", combination(("1", {"assume": 0}), ("0",)), ["x >= 0"],
                                                 {"x": "1"}), "strictly"),
    "strict from a zero": (proved("x > 0", combination(("1", {"assume": 0}, {"any": "1"})), ["x == 0"], {"x": "0"}),
                           "strictly"),
    "the inverse of a weak sign": (proved("1/x >= 0", combination(("1", {"inverse": 0})), ["x >= 0", "x != 0"],
                                          {"x": "1"}), "unknown factor"),
    "equality from an inequality": (proved("x == 0", combination(("1", {"assume": 0})), ["x >= 0"], {"x": "0"}),
                                    "equality"),
    "difference from nothing": (proved("x != 0", combination(), example={"x": "1"}), "add up"),
    "an assumption that does not exist": (proved("x >= 0", combination(("1", {"assume": 3})), example={"x": "1"}),
                                          "malformed"),
    "nothing from nothing": (proved("x >= 1", combination(("1", {"assume": 0}), ("1", {"assume": 1})),
                                    ["x > 0", "x < 0"], {"x": "1"}), "example breaks"),
    "a lemma without proof": (proved("x >= 0", {"rule": "cut", "lemma": "x >= 0", "proof": combination(),
                                                "then": combination(("1", {"assume": 0}))}, example={"x": "1"}),
                              "add up"),
    "a lemma that proves itself": (proved("x >= 0", {
        "rule": "cut", "lemma": "x >= 0", "proof": combination(("1", {"assume": 0})),
        "then": combination(("1", {"assume": 0}))}, example={"x": "1"}), "malformed"),
    "a tangent of an undefined logarithm": (
        proved("x - 1 - log(x) >= 0", combination(("1", {"fact": "log_tangent", "of": "x"})), ["x >= 0"], {"x": "1"}),
        "not shown positive"),
    "an argument that closes the bracket": (
        proved("x >= 0", combination(("1", {"fact": "log_tangent", "of": "1) + log(1"})), example={"x": "1"}),
        "cannot read"),
    # monotone
    "monotone proves an equality": (proved("x == 0", {
        "rule": "monotone", "variable": "x", "from": "0", "derivative": combination(("1",)), "at_start": IDENTITY},
        ["x >= 0"], {"x": "0"}), "no more"),
    "monotone with what holds only at the end": (proved("x**2 - 2*x >= -1/2", {
        "rule": "monotone", "variable": "x", "from": "0",
        "derivative": combination(("2", {"assume": 1})), "at_start": combination(("1/2",))},
        ["x >= 0", "x >= 1"], {"x": "2"}), "add up"),
    "monotone across a pole": (proved("-1/(x - 1) >= 1", {
        "rule": "monotone", "variable": "x", "from": "0", "derivative": combination(("1", {"square": "1/(x - 1)"})),
        "at_start": IDENTITY}, ["x >= 0", "x != 1"], {"x": "0"}), "not shown non-zero"),
    "monotone below the start": (proved("x >= 0", {
        "rule": "monotone", "variable": "x", "from": "0", "derivative": combination(("1",)), "at_start": IDENTITY},
        ["x >= -1"], {"x": "0"}), "not among the assumptions"),
    "monotone from a moving start": (proved("x >= 0", {
        "rule": "monotone", "variable": "x", "from": "x", "derivative": combination(("1",)),
        "at_start": combination()}, ["x - x >= 0"], {"x": "0"}), "not among|depends"),
    "monotone with a flow inside": (proved("(x - x0)**2 >= x0**2", {
        "rule": "monotone", "variable": "x", "from": "0",
        "derivative": {"rule": "nonincreasing", "function": "-x", "decrease": combination(("1", {"assume": 2})),
                       "then": combination(("2", {"assume": 2}))}, "at_start": IDENTITY},
        ["x >= 0"], {"x": "1", "w": "0"}, flow={"x": "w"}, always=["w >= 0"], initial={"x": "x0"}),
        "no initial values"),
    # along a flow
    "the final rate is not the rate": (proved("x <= x0", DECREASE, ["w <= 0"], UNRELATED, flow={"x": "w"},
                                              initial={"x": "x0"}), "add up"),
    "a final rate hidden in a function": (
        proved("x <= x0", {**DECREASE, "decrease": combination(
            ("1", {"fact": "exp_positive", "of": "w"}, {"fact": "exp_tangent", "of": "-w"}),
            ("1", {"fact": "exp_positive", "of": "w"}, {"assume": 0})), "then": combination(("1", {"assume": 1}))},
               ["w <= 0"], {"x": "0", "w": "0"}, flow={"x": "exp(w) - 1"}, initial={"x": "x0"}), "add up"),
    "an input taken for a constant": (
        proved("w*x <= w*x0 + w**2*t", {"rule": "nonincreasing", "function": "w*x - w**2*t",
                                        "decrease": combination(), "then": combination(("1", {"assume": 0}))},
               example=UNRELATED, flow={"t": "1", "x": "w"}, initial={"t": "0", "x": "x0"}), "input"),
    "no initial value for one symbol": (
        proved("x <= x0", DECREASE, example=UNRELATED, flow={"x": "w", "y": "1"}, always=["w <= 0"],
               initial={"x": "x0"}), "no initial values"),
    "initial values that move": (
        proved("x <= y", DECREASE, example=UNRELATED | {"y": "0"}, flow={"x": "w", "y": "1"}, always=["w <= 0"],
               initial={"x": "y", "y": "0"}), "initial values are constants"),
    "a constant that starts elsewhere": (
        proved("x <= x0 - 5", {"rule": "nonincreasing", "function": "x - 5*c", "decrease": combination(
            ("1", {"assume": 0})), "then": combination(("1", {"assume": 0}))}, example=UNRELATED | {"c": "0"},
               flow={"x": "w", "c": "0"}, always=["w <= 0"], initial={"x": "x0", "c": "c + 1"}), "initial value of c"),
    "a rate that is read before the other": (
        proved("D(x) == 0", IDENTITY, example={"x": "1"}, flow={"x": "D(y)", "y": "1"}), "given by a derivative"),
    "a function that is undefined on the way": (
        proved("1/t <= 1/t0", {"rule": "nonincreasing", "function": "1/t",
                               "decrease": combination(("1", {"square": "1/t"})),
                               "then": combination(("1", {"assume": 1}))},
               ["t != 0"], {"t": "1", "t0": "1"}, flow={"t": "1"}, initial={"t": "t0"}), "not shown non-zero"),
    "a rate that is undefined on the way": (
        proved("x <= x0", DECREASE | {"decrease": combination(), "then": combination(("1", {"assume": 1}))},
               ["y != 0"], {"x": "0", "y": "1", "x0": "0"},
               flow={"x": "y/y - 1", "y": "1"}, initial={"x": "x0", "y": "-1"}), "not shown non-zero"),
    "a state that the flow cannot reach": (
        refuted("x <= x0", {"x": "1", "x0": "0", "w": "-1"}, flow={"x": "w"}, always=["w <= 0"], initial={"x": "x0"}),
        "reaches the point"),
    "a point against a claim of later times": (refuted("x <= 0", {"x": "1"}, eventually="t"), "later times"),
    "a later time proved now": (proved("x <= 0", combination(), eventually="t"), "naming that time"),
    # models
    "a model that stops time": (
        model({"x": "1 - t"}, {"t": "0"}), "constants only"),
    "a model with a constant that moves": (model({"x": "1"}, {"x": "1"}), "constants only"),
    "a model that names its rate": (model({"x": "1"}, {"w": "0"}), "constants only"),
    "one rate for two symbols": (
        model({"x": "1 + t", "y": "1"}, flow={"t": "1", "x": "w", "y": "w"}, show=["x <= 0"], always=["w <= 0"])
        | {"always": [IDENTITY], "fails": combination(("1",), ("1", {"assume": 0}))}, "each its own"),
    "time as a rate": (model({"x": "1"}, flow={"t": "1", "x": "t"}), "each its own"),
    "a symbol as its own rate": (model({"x": "1"}, flow={"t": "1", "x": "x"}), "each its own"),
    "a derivative in the model": (
        model({"x": "1 + t"}, always=["D(x) <= 0"])
        | {"always": [IDENTITY], "fails": combination(("1",), ("1", {"assume": 0}))}, "sides differ"),
    "a model that is undefined at some time": (
        model({"x": "1 + 0/(t - 1)"}), "not shown defined at all times"),
    "a relation that is undefined along the model": (
        model({"x": "0"}, show=["x/x <= 0"]) | {"fails": combination(("1",))}, "not shown defined|zero|non-zero"),
    "a model with an unknown symbol": (model({"x": "q**2 + 1"}), "mentions more"),
    "a model that starts elsewhere": (model({"x": "1"}, initial={"x": "x0", "t": "0"}) | {"point": {"x0": "2"}},
                                      "does not start"),
    "a model that starts late": (model({"x": "1"}, initial={"t": "5", "x": "x0"}) | {"point": {"x0": "1"}},
                                 "does not start"),
    "a model that breaks an assumption": (model({"x": "c"}, {"c": "1"}, assume=["c >= 2"]), "breaks the assumption"),
    "a model without time": (model({"x": "1"}, flow={"t": "2", "x": "w"}), "function of time"),
    "a model that misses what always holds": (model({"x": "1"}, always=["x <= 0"]), "malformed"),
    "a model with a free index": (
        model({"x": "1"}, show=["Sum(W**2) <= 0"], indexed=["W"]), "constants only"),
}


@pytest.mark.parametrize("name", ATTACKS)
def test_false_certificate_is_refused_for_the_right_reason(name):
    certificate, reason = ATTACKS[name]
    initial = certificate["goal"].get("initial") if isinstance(certificate["goal"], dict) else None
    assert_refused(certificate, f"{reason}|no instant of a motion" if initial else reason)


GENUINE = {
    "an identity": proved("(x + 1)**2 == x**2 + 2*x + 1", IDENTITY, example={"x": "1"}),
    "a square": proved("x**2 >= 0", combination(("1", {"square": "x"})), example={"x": "1"}),
    "a denominator": proved("x/x == 1", IDENTITY, ["x > 0"], {"x": "1"}),
    "exp undoes log": proved("exp(log(x)) == x", IDENTITY, ["x > 0"], {"x": "1"}),
    "monotone": proved("x**3 >= 0", {"rule": "monotone", "variable": "x", "from": "0",
                                     "derivative": combination(("3", {"square": "x"})), "at_start": IDENTITY},
                       ["x >= 0"], {"x": "1"}),
    "a flow that decreases": proved(
        "x <= x0", DECREASE, example={"x": "0", "x0": "0", "w": "0"}, flow={"x": "w"}, inputs=["w"],
        always=["w <= 0"], initial={"x": "x0"}),
    "a constant with a rate of zero": proved(
        "exp(m*t)*x <= x0", {"rule": "nonincreasing", "function": "exp(m*t)*x", "decrease": combination(),
                             "then": combination(("1", {"assume": 0}))},
        example={"x": "1", "m": "1", "t": "0", "x0": "1"}, flow={"t": "1", "x": "-m*x", "m": "0"},
        initial={"t": "0", "x": "x0", "m": "m"}),
    "a start as counterexample": refuted("x <= 0", {"x": "1", "x0": "1", "w": "0"}, flow={"x": "w"},
                                         always=["w <= 0"], initial={"x": "x0"}),
    "a model": model({"x": "1"}),
}


@pytest.mark.parametrize("name", GENUINE)
def test_true_certificate_of_the_same_form_is_accepted(name):
    check(GENUINE[name])


def test_a_key_that_stands_twice_is_refused(tmp_path):
    text = json.dumps(GENUINE["a square"]).replace('"show": [', '"show": ["x <= 0"], "show": [')
    (tmp_path / "twice.json").write_text(text)
    _, _, reason = check_file(tmp_path / "twice.json")
    assert reason == "a key stands twice in one object"


@pytest.mark.parametrize("text", ["", "[]", "null", "1", '"proved"', "{}", "{", "\x00", "[" * 100_000])
def test_what_is_no_certificate_is_invalid_not_a_crash(tmp_path, text):
    (tmp_path / "x.json").write_text(text)
    (tmp_path / "folder.json").mkdir()
    results = check_folder(tmp_path)
    assert len(results) == 2
    assert all(reason for _, _, reason in results)
