"""Certificates with abs, sign, sqrt, Max, Min and tanh that prove what is false, and why each is refused."""

from function_certificates import (
    AT_ONE,
    MIXED,
    WV,
    W,
    assumed,
    cases,
    fact,
    impossible,
    monotone,
    nonincreasing,
    three,
    two,
)
from test_checker_soundness import IDENTITY, combination, model, proved, refuted

ATTACKS = {
    # facts about something else than they say
    **{f"an argument that closes the bracket of {name}": (
        proved("-1 >= 0", combination(("1", fact(name, text)))), "cannot read")
       for name, text in (("abs_nonnegative", "0) - abs(1"), ("sqrt_nonnegative", "0) - sqrt(1"),
                          ("sqrt_positive", "1) - sqrt(4"), ("abs_square", "0) - abs(1"),
                          ("sqrt_square", "1) + sqrt(1"), ("exp_positive", "0) - exp(1"),
                          ("exp_tangent", "0) - exp(1"), ("log_tangent", "1) + log(1"))},
    "an argument that is two": (proved("x >= 0", combination(("1", fact("abs_nonnegative", "x, y")))), "not an expr"),
    "a fact about a relation": (proved("x >= 0", combination(("1", fact("abs_nonnegative", "x >= 0")))), "not an expr"),
    "an enclosure of a sum, which is that of one neuron": (
        proved("Sum(1) <= 1", combination(("1", fact("enclosure", "1 - Sum(1)")))), "not a number that"),
    "an enclosure of the root of a sum": (
        proved("sqrt(Sum(1)) <= 1", combination(("1", fact("enclosure", "1 - sqrt(Sum(1))")))), "not a number that"),
    "an enclosure of a symbol": (
        proved("x >= 0", combination(("1", fact("enclosure", "x"))), example=AT_ONE), "not a number that"),
    "an enclosure that is too wide": (
        proved("sqrt(2) >= 3/2", combination(("1", fact("enclosure", "sqrt(2) - 3/2")))), "not a number that"),
    "a strict enclosure": (
        proved("sqrt(2)**2 > 2", combination(("1", fact("enclosure", "sqrt(2)**2 - 2")))), "not a number that"),
    "an enclosure of what cannot be computed": (
        proved("exp(1000000) > 1", combination(("1", fact("enclosure", "exp(1000000) - 1")))), "too large"),
    "an enclosure of what is undefined": (
        proved("1 > 1", combination(("1", fact("enclosure", "sqrt(log(1/2))")))), "sqrt of a negative"),
    # sums inside functions
    "a root of a sum inside a sum": (
        proved(f"Sum(sqrt(Sum(V**2)*W**2)) == {MIXED}", IDENTITY, **WV), "a sum inside a sum"),
    "a root of a sum inside a sum, elsewhere": (
        proved("Sum(sqrt(Sum(V**2)*W**2)) == Sum(sqrt(Sum(V**2*W**2)))", IDENTITY, **WV), "a sum inside a sum"),
    "a root of a sum inside other functions inside a sum": (
        proved("Sum(exp(abs(sqrt(Sum(V**2)*W**2)))) == Sum(1)*exp(abs(sqrt(Sum(V**2*W**2))))", IDENTITY, **WV),
        "a sum inside a sum"),
    "a derivative with a sum inside a sum": (
        proved(f"Sum(sqrt(D(x)*W**2)) == {MIXED}", IDENTITY, flow={"x": "Sum(V**2)"}, **WV), "a sum inside a sum"),
    "a sum inside the rate of an index": (
        proved(f"D(Sum(W)) == {MIXED}", IDENTITY, flow={"W": "sqrt(Sum(V**2)*W**2)"}, **WV), "a sum inside a sum"),
    "a sum inside a sum of squares": (
        proved(f"{MIXED}*sqrt(Sum(V**2*W**2)) >= 0",
               combination(("1", {"sum_of_squares": "sqrt(Sum(V**2)*W**2)"})), **WV), "a sum inside a sum"),
    "an initial value that is a sum, inside a sum": (
        proved(f"x <= x0 + {MIXED} - Sum(sqrt(c*W**2))",
               nonincreasing("x + Sum(sqrt(c*W**2))", assumed(1), assumed(1)), ["c >= 0"],
               {"x": "0", "x0": "0", "c": "0", "w": "0", "V": "0", "W": "1"}, flow={"x": "w", "c": "0"}, inputs=["w"],
               always=["w <= 0"], initial={"x": "x0", "c": "Sum(V**2)"}, **WV), "a sum inside a sum"),
    "a point of one neuron for sums inside sums": (
        refuted("Sum(sqrt(Sum(V**2)*W**2)) <= 0", {"V": "1", "W": "1"}, **WV), "a sum inside a sum"),
    "a root of a sum is no sum of roots": (
        proved("sqrt(Sum(W**2)) == Sum(sqrt(W**2))", IDENTITY, **W), "sides differ"),
    "the square of a root of a sum is no sum of squares": (
        proved("sqrt(Sum(W**2)*x)**2 == Sum(W**2*x)**2", IDENTITY, ["x > 0"], AT_ONE, **W), "two sides differ"),
    "division by what is a sum": (
        proved("Sum(W**2)/sqrt(Sum(W**2))**2 == 1", IDENTITY, example={"W": "1"}, **W), "not shown non-zero"),
    **{f"{name} of a sum": (
        proved(f"{name}(Sum(W)) == Sum({name}(W))", IDENTITY, **W), f"(of a sum|{name} of a sum|sides differ)")
       for name in ("abs", "sign", "tanh", "exp")},
    "Max of a sum": (proved("Max(Sum(W), 0) == Sum(Max(W, 0))", IDENTITY, **W), "the two sides differ"),
    "no neuron, no sum": (proved("Sum(exp(W)) > 0", combination(("1", {"positive": "Sum(exp(W))"})), **W),
                          "not shown positive"),
    "no neuron": (proved("Sum(1) > 0", combination(("1", {"positive": "Sum(1)"}))), "not shown positive"),
    "a root of a sum of unknown sign": (proved("sqrt(Sum(W))**2 == Sum(W)", IDENTITY, **W), "not shown non-negative"),
    "a sum of roots where only the sum is known": (
        proved("Sum(sqrt(W)) >= 0", combination(("1", {"positive": "Sum(sqrt(W))"})), ["Sum(W) >= 0"], {"W": "1"}, **W),
        "not shown non-negative"),
    # where functions are undefined
    "the square of a root of anything": (
        proved("sqrt(x)**2 == x", combination(("1", fact("sqrt_square", "x"))), example=AT_ONE), "not shown non-neg"),
    "roots of a product": (
        proved("sqrt(x)*sqrt(y) == sqrt(x*y)", IDENTITY, ["x*y >= 0"], AT_ONE), "not shown non-negative"),
    "a root of one over a number of unknown sign": (
        proved("sqrt(1/x)**2 == 1/x", combination(("1", fact("sqrt_square", "1/x"))), ["x != 0"], AT_ONE),
        "not shown non-negative"),
    "a root that cancels": (proved("sqrt(x) - sqrt(x) == 0", IDENTITY, example=AT_ONE), "not shown non-negative"),
    "a root of a negative number": (proved("sqrt(-1) == sqrt(-1)", IDENTITY), "sqrt of a negative|not shown non-neg"),
    "one over a root that may be zero": (
        proved("1/sqrt(x) > 0", combination(("1",)), ["x >= 0"], AT_ONE), "not shown non-zero"),
    "one over an absolute value": (
        proved("abs(x)/abs(x) == 1", IDENTITY, example=AT_ONE), "not shown non-zero"),
    "one over a sign": (proved("sign(x)**2/sign(x)**2 == 1", IDENTITY, example=AT_ONE), "not shown non-zero"),
    "log of an absolute value": (
        proved("log(abs(x)) <= abs(x) - 1", combination(("1", fact("log_tangent", "abs(x)"))), example=AT_ONE),
        "not shown positive"),
    "exp of twice a logarithm": (proved("exp(2*log(x)) == x**2", IDENTITY, example=AT_ONE), "not shown positive"),
    "exp of a logarithm over what may be zero": (
        proved("exp(y*log(x)/y) == x", IDENTITY, ["x > 0"], AT_ONE), "not shown non-zero"),
    "exp of a sum over what may be zero": (
        proved("exp((y*log(x) + z)/y) == x*exp(z/y)", IDENTITY, ["x > 0"], AT_ONE), "not shown non-zero"),
    "tanh of a logarithm": (
        proved("tanh(log(x)) == (x**2 - 1)/(x**2 + 1)", IDENTITY, example=AT_ONE), "not shown positive"),
    "a rate with a root": (
        proved("D(x) == sqrt(y)", combination(), example=AT_ONE, flow={"x": "sqrt(y)"}), "not shown non-negative"),
    "an initial value with a root": (
        proved("x == x", IDENTITY, example=AT_ONE, flow={"x": "1"}, initial={"x": "sqrt(y)"}), "not shown non-neg"),
    "a lemma with a root": (
        proved("x >= 0", {"rule": "cut", "lemma": "sqrt(x)**2 == x", "proof": combination(
            ("1", fact("sqrt_square", "x"))), "then": combination(("1", {"square": "sqrt(x)"}), ("-1", {"assume": 0}))},
               example=AT_ONE), "not shown non-negative"),
    # signs
    "an absolute value is not positive": (
        proved("abs(x) > 0", combination(("1", fact("abs_nonnegative", "x"))), example=AT_ONE), "no strictly positive"),
    "an absolute value taken for positive": (
        proved("abs(x) > 0", combination(("1", {"positive": "abs(x)"})), example=AT_ONE), "not shown positive"),
    "a root is not positive": (
        proved("sqrt(x) > 0", combination(("1", fact("sqrt_positive", "x"))), ["x >= 0"], AT_ONE), "not shown pos"),
    "a root taken for positive": (
        proved("sqrt(x) > 0", combination(("1", {"positive": "sqrt(x)"})), ["x >= 0"], AT_ONE), "not shown positive"),
    "a root of a square is positive": (
        proved("sqrt(x**2) > 0", combination(("1", {"positive": "sqrt(x**2)"})), example=AT_ONE), "not shown positive"),
    "a sign taken for non-negative": (
        proved("sign(x) + 1 > 0", combination(("1", {"positive": "sign(x) + 1"})), example=AT_ONE),
        "not shown positive"),
    "the square of a sign is not one": (
        proved("sign(x)**2 == 1", three("x", IDENTITY, IDENTITY, IDENTITY), example=AT_ONE), "sides differ"),
    "a root of a square is not the number": (
        proved("sqrt(x**2) == x", combination(("1", fact("sqrt_square", "x**2"))), example=AT_ONE), "add up"),
    "abs is not odd": (proved("abs(-x) == -abs(x)", IDENTITY, example=AT_ONE), "sides differ"),
    "sign is not even": (proved("sign(-x) == sign(x)", IDENTITY, example=AT_ONE), "sides differ"),
    "a root is neither": (
        proved("sqrt(-x) == sqrt(x)", IDENTITY, ["x == 0", "x >= 0", "-x >= 0"], {"x": "0"}), "sides differ"),
    # cases
    **{f"cases {' and '.join(names) or 'none'}": (
        proved("x >= 0", cases("x", **{name: assumed(0) for name in names}), example=AT_ONE), "are not all the cases")
       for names in ((), ("nonnegative",), ("nonpositive",), ("positive", "negative"), ("nonnegative", "negative"),
                     ("positive", "zero"), ("positive", "nonnegative"), ("nonnegative", "nonpositive", "zero"),
                     ("positive", "negative", "zero", "other"), ("Nonnegative", "nonpositive"))},
    "cases of an undefined quotient": (
        proved("x >= 0", two("1/x", IDENTITY, IDENTITY), example=AT_ONE), "not shown non-zero"),
    "cases of an undefined logarithm": (
        proved("x >= 0", two("log(x)", IDENTITY, IDENTITY), example=AT_ONE), "not shown positive"),
    "cases of an undefined root": (
        proved("x >= 0", two("sqrt(x)", IDENTITY, IDENTITY), example=AT_ONE), "not shown non-negative"),
    "cases of an index": (proved("Sum(abs(W)) == Sum(W)", two("W", IDENTITY, IDENTITY), **W), "outside a sum"),
    "cases of two": (proved("x >= 0", two("x, y", IDENTITY, IDENTITY), example=AT_ONE), "not an expression"),
    "cases of a relation": (proved("x >= 0", two("x >= 0", IDENTITY, IDENTITY), example=AT_ONE), "not an expression"),
    "a case that is used in the other": (
        proved("abs(x) >= 2*x", two("x", assumed(0), assumed(0, "3")), example=AT_ONE), "may be|add up"),
    "a case that outlives its proof": (
        proved("x >= 0", {"rule": "cut", "lemma": "abs(x) >= 0", "proof": two("x", assumed(0), assumed(0)),
                          "then": assumed(1)}, example=AT_ONE), "malformed"),
    "the weak case taken for the strict one": (
        proved("abs(x) > 0", two("x", assumed(0), assumed(0)), example=AT_ONE), "no strictly positive"),
    "the zero case taken for a strict one": (
        proved("abs(x) > 0", three("x", assumed(0), assumed(0), assumed(0)), example=AT_ONE), "no strictly positive"),
    "a sign left open": (
        proved("x*sign(x) == abs(x)", two("x", IDENTITY, IDENTITY), example=AT_ONE), "sides differ"),
    "the sign of the opposite": (
        proved("x*sign(-x) == abs(x)", three("x", IDENTITY, IDENTITY, IDENTITY), example=AT_ONE), "sides differ"),
    "the sign of something else": (
        proved("sign(x - 1) == 1", three("x", impossible(("1", {"assume": 0}), ("1", {"assume": 1})), impossible(
            ("1", {"assume": 0}), ("-1", {"assume": 1})), IDENTITY), ["x > 0"], {"x": "2"}), "sides differ"),
    "the absolute value of twice as much": (
        proved("abs(2*x) == 2*x", two("x", IDENTITY, IDENTITY), example=AT_ONE), "sides differ"),
    "a denominator that vanishes in a case": (
        proved("1/(abs(x) - x) >= 1", two("x", IDENTITY, combination(("1", {"inverse": 0}))), ["abs(x) - x > 0"],
               {"x": "-1"}), "division by zero"),
    "an outer absolute value after the inner one": (
        proved("abs(abs(x) - 1) == abs(x - 1)", two("x", IDENTITY, IDENTITY), example=AT_ONE), "sides differ"),
    "an equality from one case only": (
        proved("abs(x) == x", two("x", IDENTITY, impossible(("1", {"assume": 0}))), example=AT_ONE), "no strictly"),
    "the final sign taken for that of earlier instants": (
        proved("x <= x0", two("w", impossible(), nonincreasing("x", assumed(0), assumed(1))),
               example={"x": "0", "x0": "0", "w": "0"}, flow={"x": "w"}, inputs=["w"], initial={"x": "x0"}),
        "no strictly|add up"),
    "the final sign, in the other order": (
        proved("x <= x0", two("-w", nonincreasing("x", assumed(0), assumed(1)), impossible()),
               example={"x": "0", "x0": "0", "w": "0"}, flow={"x": "w"}, inputs=["w"], initial={"x": "x0"}), "add up"),
    # contradiction
    "a contradiction without one": (
        proved("x >= 1", impossible(), example=AT_ONE), "no strictly positive"),
    "a contradiction that is weak": (
        proved("x >= 1", impossible(("1", {"assume": 0}), ("1", {"assume": 1})), ["x >= 0", "-x >= 0"], {"x": "0"}),
        "no strictly positive"),
    "a contradiction that does not add up": (
        proved("x >= 1", impossible(("1", {"assume": 0})), ["x > 0"], AT_ONE), "add up"),
    "an equality from a contradiction that is none": (
        proved("x == 2", impossible(("1",), ("-1", {"any": "1"})), example=AT_ONE), "may be negative"),
    "everything from nothing": (
        proved("x >= 1", impossible(("1", {"assume": 0}), ("1", {"assume": 1})), ["x > 0", "-x > 0"], AT_ONE),
        "example breaks"),
    # derivatives
    **{f"a derivative of {text}": (
        proved(f"D({text}) >= 0", IDENTITY, ["x >= 0"], AT_ONE, flow={"x": "1"}), "derivative of (abs|sign|sqrt)")
       for text in ("abs(x)", "sign(x)", "sqrt(x)", "Max(x, 0)", "Min(x, y)", "exp(abs(x))", "x*sign(x)",
                    "log(1 + abs(x))", "Sum(abs(x))", "abs(x)**2")},
    "a derivative of the root of a sum": (
        proved("D(sqrt(Sum(W**2))) == 0", IDENTITY, flow={"W": "1"}, **W), "derivative of sqrt"),
    "monotone over a kink": (
        proved("abs(x - 1) >= 1", monotone("x", "0", combination(), IDENTITY), ["x >= 0"], AT_ONE),
        "derivative of abs"),
    "monotone over a jump": (
        proved("-sign(x - 1) >= 1", monotone("x", "0", combination(), IDENTITY), ["x >= 0"], AT_ONE),
        "derivative of sign"),
    "monotone from the wrong side in a case": (
        proved("x >= 0", two("x", assumed(0), monotone("x", "0", combination(("1",)), combination())), example=AT_ONE),
        "not among"),
    "a function with a kink along a flow": (
        proved("abs(x) <= abs(x0)", nonincreasing("abs(x)", combination(), assumed(0)), example={"x": "1", "x0": "1"},
               flow={"x": "x"}, initial={"x": "x0"}), "derivative of abs"),
    "an input hidden in a sign": (
        proved("x*sign(w) <= x0*sign(w)", nonincreasing("x*sign(w)", combination(), assumed(0)),
               example={"x": "0", "x0": "0", "w": "0", "y": "0"}, inputs=["w"],
               flow={"x": "abs(w) - abs(w) + w - w + 0*w", "y": "w"}, initial={"x": "x0", "y": "0"}), "input"),
    # language
    **{f"the text {text}": (proved(f"{text} >= 0", IDENTITY, example=AT_ONE), reason) for text, reason in (
        ("Max(x)", "unknown function"), ("Min()", "not an expression"), ("Max(*x, y)", "not an expression"),
        ("Max((x, y), x)", "not an expression"), ("abs(x, y)", "not an expression"), ("(x, y)", "not an expression"),
        ("x,", "not an expression"), ("abs(*x)", "not an expression"), ("sqrt()", "not an expression"),
        ("max(x, y)", "not an expression"), ("Abs(x)", "unknown function"), ("Sum(x, y)", "not an expression"),
        ("Max(x for x in y)", "unknown function|not an expression"), ("x*Max", "sides differ"),
        ("abs(x)(y)", "not an expression"), ("x if y else 1", "not an expression"))},
    "Max by a name": (proved("Max(x, y=1) >= 1", IDENTITY), "not an expression"),
    "a symbol named as a function": (proved("sqrt*sqrt == 2", IDENTITY, example={"sqrt": "1"}), "sides differ"),
    "an index named as a function": (proved("abs(abs) == 1", IDENTITY, indexed=["abs"]), "outside a sum"),
    "deep nesting": (proved("abs(" * 3000 + "x" + ")" * 3000 + " >= 0", IDENTITY, example=AT_ONE),
                     "cannot read|malformed"),
    "a root of a tower of powers": (proved("sqrt(((2**64)**64)**64) >= 0", IDENTITY), "more than 20000 bits"),
    "half a power": (proved("x**(1/2) == sqrt(x)", IDENTITY, ["x > 0"], AT_ONE), "whole numbers"),
    # true statements at points that do not refute them
    "a point where the goal holds": (refuted("x*sign(x) >= 0", {"x": "-3"}), "holds at the point"),
    "a point where the least holds": (refuted("Min(x, y, 1) <= x", AT_ONE), "holds at the point"),
    "a point where a root is undefined": (refuted("0*sqrt(x) >= 1", {"x": "-1"}), "undefined at the point"),
    "a point where a logarithm is undefined": (refuted("log(abs(x)) <= abs(x)", {"x": "0"}), "undefined at the point"),
    "a point where a quotient is undefined": (refuted("abs(x)/x <= 1", {"x": "0"}), "undefined at the point"),
    "a point where a sign is not known": (refuted("sign(sqrt(2)**2 - 2) == 0", {}), "too wide"),
    "a point where an absolute value is not known": (refuted("abs(log(4) - 2*log(2)) == 0", {}), "too wide"),
    "a point where a root is not known": (refuted("sqrt(2)*sqrt(2) == 2", {}), "too wide"),
    "a point where there is no derivative": (refuted("D(abs(x)) >= -1", {"x": "0"}, flow={"x": "1"}),
                                             "derivative of abs"),
    "an assumption with a root that is undefined": (refuted("x >= 0", {"x": "-1"}, ["sqrt(x) >= 0"]),
                                                    "not shown non-negative"),
    # models
    "a model with a kink": (model({"x": "abs(t - 1) + 1"}), "derivative of abs"),
    "a model with a jump": (model({"x": "2 + sign(t - 1)"}), "derivative of sign"),
    "a model with a root": (model({"x": "1 + sqrt(t)"}), "derivative of sqrt"),
    "a model where a root is undefined": (model({"x": "-1"}, show=["sqrt(x) <= 0"]),
                                          "not shown defined|negative number"),
}
