"""Certificates with abs, sign, sqrt, Max, Min and tanh: their rules, and genuine ones."""

from test_checker_soundness import IDENTITY, combination, model, proved, refuted

W, WV = {"indexed": ["W"]}, {"indexed": ["V", "W"]}
MIXED = "Sum(1)*sqrt(Sum(V**2*W**2))"  # is not what Sum(sqrt(Sum(V**2)*W**2)) is, though both are one formally


def fact(name, of):
    return {"fact": name, "of": of}


def cases(of, **proofs):
    return {"rule": "cases", "of": of, **proofs}


def two(of, nonnegative, nonpositive):
    return cases(of, nonnegative=nonnegative, nonpositive=nonpositive)


def three(of, negative, zero, positive):
    return cases(of, negative=negative, zero=zero, positive=positive)


def impossible(*terms):
    return combination(*terms) | {"rule": "contradiction"}


def monotone(variable, start, derivative, at_start):
    return {"rule": "monotone", "variable": variable, "from": start, "derivative": derivative, "at_start": at_start}


def nonincreasing(function, decrease, then):
    return {"rule": "nonincreasing", "function": function, "decrease": decrease, "then": then}


def assumed(place, coefficient="1"):
    return combination((coefficient, {"assume": place}))


FACTS = ("abs_square", "abs_nonnegative", "sqrt_square", "sqrt_nonnegative", "sqrt_positive", "log_tangent",
         "exp_tangent", "exp_positive", "enclosure")
AT_ONE = {"x": "1", "y": "1"}
ADDED = combination(("2", {"assume": 1}), ("2", {"assume": 2}))
TRIANGLE = two("x + y",
               two("x", two("y", IDENTITY, assumed(2, "2")), two("y", assumed(1, "2"), ADDED)),
               two("x", two("y", ADDED, assumed(1, "2")), two("y", assumed(2, "2"), IDENTITY)))
SIGNED = three("x", IDENTITY, assumed(0, "-1"), IDENTITY)  # where x is zero, abs(x) is x
GENUINE = {
    "the square of an absolute value": proved(
        "abs(x)**2 == x**2", combination(("1", fact("abs_square", "x"))), example=AT_ONE),
    "an absolute value": proved("abs(x) >= 0", combination(("1", fact("abs_nonnegative", "x"))), example=AT_ONE),
    "an absolute value by cases": proved("abs(x) >= x", two("x", IDENTITY, assumed(0, "2")), example=AT_ONE),
    "an assumption with an absolute value": proved("x <= 1", two(
        "x", assumed(0), combination(("1", {"assume": 0}), ("2", {"assume": 1}))), ["abs(x) <= 1"], AT_ONE),
    "abs is even": proved("abs(x - y) == abs(y - x)", IDENTITY, example=AT_ONE),
    "sign is odd": proved("sign(x - y) == -sign(y - x)", IDENTITY, example=AT_ONE),
    "sign and size": proved("x*sign(x) == abs(x)", SIGNED, example=AT_ONE),
    "sign and size of the opposite": proved("-x*sign(-x) == abs(-x)", SIGNED, example=AT_ONE),
    "the triangle inequality": proved("abs(x + y) <= abs(x) + abs(y)", TRIANGLE, example=AT_ONE),
    "an outer absolute value in a case": proved("abs(abs(x) + 1) == abs(x) + 1", two(
        "x", two("x + 1", IDENTITY, impossible(("1", {"assume": 0}), ("1", {"assume": 1}), ("1",))),
        two("1 - x", IDENTITY, impossible(("1", {"assume": 0}), ("1", {"assume": 1}), ("1",)))), example=AT_ONE),
    "the square of a root": proved(
        "sqrt(x)**2 == x", combination(("1", fact("sqrt_square", "x"))), ["x >= 0"], AT_ONE),
    "the square of a root of a square": proved(
        "sqrt(x**2)**2 == x**2", combination(("1", fact("sqrt_square", "x**2"))), example=AT_ONE),
    "a root": proved("sqrt(x**2 + y**2) >= 0", combination(("1", fact("sqrt_nonnegative", "x**2 + y**2"))),
                     example=AT_ONE),
    "a positive root": proved("sqrt(x) > 0", combination(("1", fact("sqrt_positive", "x"))), ["x > 0"], AT_ONE),
    "one over a positive root": proved(
        "1/sqrt(x) > 0", combination(("1",), multiplier=[fact("sqrt_positive", "x")]), ["x > 0"], AT_ONE),
    "one over a root that is positive by its terms": proved(
        "1/sqrt(1 + x**2) > 0", combination(("1",), multiplier=[{"positive": "sqrt(1 + x**2)"}]), example=AT_ONE),
    "a root of a margin": proved(
        "sqrt(x - y)**2 == x - y", combination(("1", fact("sqrt_square", "x - y"))), ["x >= y"], AT_ONE),
    "the root of a sum": proved("sqrt(Sum(W**2))**2 == Sum(W**2)", combination(
        ("1", fact("sqrt_square", "Sum(W**2)"))), example={"W": "1"}, **W),
    "a sum times the root of a sum": proved(
        "Sum(sqrt(V**2)*x)*sqrt(Sum(W**2)) == x*sqrt(Sum(W**2))*Sum(sqrt(V**2))", IDENTITY, example=AT_ONE, **WV),
    "a sum of absolute values": proved("1 + Sum(abs(W)) > 0", combination(("1", {"positive": "1 + Sum(abs(W))"})),
                                       example={"W": "1"}, **W),
    "a number": proved("log(2) + sqrt(2) < 211/100", combination(
        ("1", fact("enclosure", "2109/1000 - log(2) - sqrt(2)")), ("1/1000",))),
    "a root that is a number": proved("sqrt(9/4) == 3/2", IDENTITY),
    "a root of zero": proved("sqrt(x - x) == abs(x - x)", IDENTITY, example=AT_ONE),
    "a case that cannot be": proved("abs(x) == x", two("x", IDENTITY, impossible(
        ("1", {"assume": 0}), ("1", {"assume": 1}))), ["x > 0"], AT_ONE),
    "the greater of two": proved("Max(x, y) >= y", two("x - y", assumed(0), IDENTITY), example=AT_ONE),
    "the least of three": proved("Min(x, z, y) <= y", two(
        "(x + z - abs(x - z))/2 - y", IDENTITY, assumed(0)), example=AT_ONE | {"z": "1"}),
    "the greatest of numbers": proved("Max(1, 3, 2) == 3", IDENTITY),
    "the greater of two sums": proved("Max(Sum(W), Sum(W) + 1) == Sum(W) + 1", IDENTITY, example={"W": "1"}, **W),
    "tanh by exp": proved("tanh(x) == (exp(2*x) - 1)/(exp(2*x) + 1)", IDENTITY, example=AT_ONE),
    "tanh is odd": proved("tanh(-x) == -tanh(x)", IDENTITY, example=AT_ONE),
    "tanh is below one": proved("tanh(x) < 1", combination(("2",), multiplier=[{"positive": "exp(2*x) + 1"}]),
                                example=AT_ONE),
    "tanh of a logarithm": proved("tanh(log(x)) == (x**2 - 1)/(x**2 + 1)", IDENTITY, ["x > 0"], AT_ONE),
    "exp of a number more": proved("exp(x + 1) == exp(x)*exp(1)", IDENTITY, example=AT_ONE),
    "exp of a logarithm over what is not zero": proved(
        "exp((y*log(x) + 1)/y - 1/2) == x*exp(1/y)*exp(-1/2)", IDENTITY, ["x > 0", "y != 0"], AT_ONE),
    "monotone in a case": proved("abs(x)**3 >= 0", two(
        "x", monotone("x", "0", combination(("3", {"square": "x"})), IDENTITY),
        combination(("1", {"assume": 0}, {"square": "x"}))), example=AT_ONE),
    "monotone beside a constant root": proved(
        "x*sqrt(y) >= 0", monotone("x", "0", combination(("1", fact("sqrt_nonnegative", "y"))), IDENTITY),
        ["y >= 0", "x >= 0"], AT_ONE),
    "a rate with the size of a constant": proved("x**2 <= x0**2", nonincreasing(
        "x**2", combination(("2", fact("abs_nonnegative", "c"), {"square": "x"})), assumed(0)),
        example={"x": "1", "x0": "1", "c": "1"}, flow={"x": "-abs(c)*x", "c": "0"}, initial={"x": "x0", "c": "c"}),
    "a rate with a sign": proved("D(x**2) <= 0", three("x", assumed(0, "2"), IDENTITY, assumed(0, "2")), example=AT_ONE,
                                 flow={"x": "-sign(x)"}),
    "decrease by cases": proved("x**2 <= x0**2", nonincreasing("x**2", three(
        "x", assumed(0, "2"), IDENTITY, assumed(0, "2")), assumed(0)), example={"x": "1", "x0": "1"},
        flow={"x": "-sign(x)"}, initial={"x": "x0"}),
    "an initial value that is a sum": proved("x <= sqrt(Sum(W**2))", nonincreasing("x", IDENTITY, assumed(0)),
                                             example={"x": "0", "W": "0"}, flow={"x": "0"},
                                             initial={"x": "sqrt(Sum(W**2))"}, **W),
    "a derivative of a constant root": proved("D(x*sqrt(y**2)) == sqrt(y**2)", IDENTITY, example=AT_ONE,
                                              flow={"x": "1"}),
    "a point against a root": refuted("sqrt(x) <= 1", {"x": "2"}),
    "a point against a root of a sum": refuted("sqrt(Sum(W**2) + x) <= 2", {"x": "1", "W": "2"}, **W),
    "a point against a sign": refuted("sign(x)**2 == 1", {"x": "0"}),
    "a point against a size": refuted("abs(x) <= x", {"x": "-1/3"}),
    "a point against the greatest": refuted("Max(x, y, 1) <= 2", {"x": "1", "y": "3"}),
    "a point against tanh": refuted("tanh(x) >= x", {"x": "1"}),
    "numbers against a number": refuted("sqrt(2) <= 7/5", {}),
    "a model with tanh": model({"x": "1 + tanh(t)"}) | {"fails": combination(
        ("2", fact("exp_positive", "2*t")), multiplier=[{"positive": "exp(2*t) + 1"}])},
    "a model with a root": model({"x": "sqrt(c)"}, {"c": "2"}) | {
        "fails": combination(("1", fact("sqrt_positive", "2")))},
}
