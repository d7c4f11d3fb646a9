"""tan and arctan: what is not so is refused by the checker, whatever fact is named, and by the deciders."""

from fractions import Fraction
from itertools import product

import mpmath
import pytest

from workbench.proof.checker import ARCTAN, CertificateError, Context, arctan_bounds, bounds, check, number
from workbench.proof.decide.obligations import decide_obligation

IDENTITY = {"rule": "identity"}
BOUNDED = ("x >= 0", "x <= 1")


def certificate(show: str, proof: dict, assume: tuple[str, ...] = (), **others: object) -> dict:
    names = {name: "1" for name in ("x", "y") if name in f"{show} {assume}".replace("exp", "")}
    return {"claim": "forged2020:1", "version": 1, "verdict": "proved", "example": names, "proofs": [proof],
            "goal": {"assume": list(assume), "show": [show], **others}}


def by(*factors: dict, coefficient: str = "1") -> dict:
    return {"rule": "combination", "terms": [{"coefficient": coefficient, "factors": list(factors)}]}


def rising(between: list[dict], derivative: dict) -> dict:
    return {"rule": "monotone", "variable": "x", "from": "0", "derivative": derivative, "at_start": IDENTITY} | (
        {"between": between} if between else {})


# cos x >= 1 - x**2/2 > 0 between 0 and 1, where `rising` holds x >= 0 and x <= 1 as its last two assumptions.
def cosine_lemma(last: int) -> dict:
    return {"lemma": "cos(x) > 0", "proof": {"rule": "combination", "terms": [
        {"coefficient": "1", "factors": [{"fact": "cosine_parabola", "of": "x"}]},
        {"coefficient": "1/2", "factors": [{"assume": last}]},
        {"coefficient": "1/2", "factors": [{"assume": last - 1}, {"assume": last}]},
        {"coefficient": "1/2", "factors": []}]}}


SQUARED = by({"square": "sin(x)/cos(x)"})
GENUINE = {
    "the sine of the angle": certificate("sin(arctan(x)) == x*cos(arctan(x))", by({"fact": "arctan_sine", "of": "x"})),
    "its cosine": certificate("cos(arctan(x)) > 0", by({"fact": "arctan_cosine", "of": "x"})),
    "its limit": certificate("arctan(x) < 2*arctan(1)", by({"fact": "arctan_limit", "of": "x"})),
    "its tangent": certificate("arctan(x) <= x", by({"fact": "arctan_tangent", "of": "x"}), ("x >= 0",)),
    "its sector": certificate("arctan(x)**2 <= x*arctan(x)", by({"fact": "arctan_sector", "of": "x"})),
    "its slope": certificate("x*arctan(x)*(1 + x**2) >= x**2", by({"fact": "arctan_slope", "of": "x"})),
    "its rate": certificate("D(arctan(x)) == y/(1 + x**2)", IDENTITY, flow={"x": "y"}),
    "a number enclosed": certificate("4*arctan(1) >= 3", by({"fact": "enclosure", "of": "4*arctan(1) - 3"})),
    "a tangent": certificate("tan(x)*cos(x) == sin(x)", IDENTITY, ("cos(x) > 0",)),
    "a tangent that rises": certificate("tan(x) >= x", {
        "rule": "cut", **cosine_lemma(1), "then": rising([cosine_lemma(4)], SQUARED)}, BOUNDED),
}
POLES = ("x >= 0", "cos(x) > 0")
FALSE = ("arctan(x) <= x", "arctan(x) >= x", "arctan(x) > 0", "arctan(x)**2 >= x**2", "arctan(x) < 3/2",
         "x < 2*arctan(1)", "sin(arctan(x)) == x", "sin(arctan(x)) <= 0", "cos(arctan(x)) >= 1",
         "arctan(x) == 2*arctan(1)", "x <= arctan(x)",
         "x*arctan(x) > 0", "x*arctan(x) >= x**2", "arctan(x)*(x - arctan(x)) > 0", "arctan(x)*(1 + x**2) >= x",
         "arctan(x)*(1 + x**2) <= x", "cos(x) > 0", "sin(x) == x*cos(x)", "tan(x) == x", "arctan(x) > 2*arctan(1)",
         "arctan(1) >= 4/5", "4*arctan(1) >= 22/7", "arctan(x + y) == arctan(x) + arctan(y)", "arctan(-x) == arctan(x)",
         "x*arctan(y) >= 0", "arctan(x)**2 <= x*arctan(x)/2", "tan(x)**2 <= 1", "tan(x)*cos(x) == sin(x)",
         "1 + tan(x)**2 >= 1", "arctan(tan(x)) == x", "tan(arctan(x)) >= 2*x", "arctan(1/x)*x <= 1")
FORGED = {
    **{f"{show} by {fact} of {of}, {coefficient}": certificate(
        show, by({"fact": fact, "of": of}, coefficient=coefficient))
       for show, fact, of, coefficient in product(FALSE, ARCTAN, ("x", "-x"), ("1", "-1"))},
    **{f"{show} as an identity": certificate(show, IDENTITY) for show in FALSE},
    "an angle that may be negative": certificate(
        "arctan(x) <= x", by({"fact": "arctan_tangent", "of": "x"}), ("x <= 0",)),
    "of what has no value": certificate("0 <= 1", by({"fact": "arctan_cosine", "of": "1/x"})),
    "of a sum": certificate("arctan(Sum(x)) < 2", by({"fact": "arctan_limit", "of": "Sum(x)"}), indexed=["x"]),
    "of two": certificate("arctan(x) < 2*arctan(1)", by({"fact": "arctan_limit", "of": ["x", "y"]})),
    "an angle used as positive": certificate("arctan(x) > 0", by({"positive": "arctan(x)"})),
    "a tangent used as defined": certificate("x == x*tan(y)/tan(y)", IDENTITY),
    "a cosine that may vanish": certificate("tan(x)*cos(x) == sin(x)", IDENTITY, ("cos(x) >= 0",)),
    "a cosine of another angle": certificate("tan(x)*cos(x) == sin(x)", IDENTITY, ("cos(y) > 0",)),
    "a tangent divided by": certificate("1/tan(x) == cos(x)/sin(x)", IDENTITY, ("cos(x) > 0",)),
    "a rate without what it divides by": certificate("D(tan(x)) >= 0", by({"square": "1/cos(x)"}), flow={"x": "1"}),
    "another rate": certificate("D(arctan(x)) == y/(1 - x**2)", IDENTITY, ("x**2 != 1",), flow={"x": "y"}),
    "a rate of an input": certificate("D(arctan(x)) == 0", IDENTITY, flow={"y": "1"}, inputs=["x"]),
    "a number enclosed too well": certificate(
        "4*arctan(1) >= 22/7", by({"fact": "enclosure", "of": "4*arctan(1) - 22/7"})),
    "a number enclosed that is none": certificate("arctan(x) >= -2", by({"fact": "enclosure", "of": "arctan(x) + 2"})),
    # tan x >= x fails from its pole on: no way leads there through cosines that are positive at its end alone
    "a pole on the way": certificate("tan(x) >= x", rising([], SQUARED), POLES),
    "a pole on the way, denied": certificate(
        "tan(x) >= x", rising([{"lemma": "cos(x) > 0", "proof": by({"assume": 1})}], SQUARED), POLES),
    "a pole on the way, denied later": certificate(
        "tan(x) >= x", rising([{"lemma": "cos(x) > 0", "proof": by({"assume": 3})}], SQUARED), POLES),
    "a lemma by itself": certificate(
        "tan(x) >= x", rising([{"lemma": "cos(x) > 0", "proof": by({"assume": 2})}], SQUARED), POLES),
    "a lemma of what is shown": certificate(
        "tan(x) >= x", rising([{"lemma": "tan(x) >= x", "proof": IDENTITY}], SQUARED), POLES),
    "a lemma without a proof": certificate("tan(x) >= x", rising([{"lemma": "cos(x) > 0"}], SQUARED), BOUNDED),
    "a lemma of too long a way": certificate("tan(x) >= x", {
        "rule": "cut", **cosine_lemma(1), "then": rising([cosine_lemma(4)], SQUARED)}, ("x >= 0", "x <= 2")),
    "a lemma with a start that is none": certificate("arctan(x) <= x", rising([{"lemma": "x >= 0", "proof": by(
        {"assume": 0})}], by({"any": "x"})), ()),
}


def test_facts_are_accepted_and_what_they_do_not_say_is_refused():
    for genuine in GENUINE.values():
        check(genuine)
    accepted = []
    for name, forged in FORGED.items():
        try:
            check(forged)
            accepted.append(name)
        except CertificateError:
            pass
    assert not accepted
    assert len(FORGED) > 800


def test_facts_hold_at_numbers_and_bounds_are_tight():
    """Each fact by enclosures at many numbers, and arctan's bounds beside mpmath's values."""
    places = [Fraction(p, q) for p in (0, 1, 3, 99) for q in (1, 2, 7)] + [Fraction(10**12), Fraction(
        1, 10**12), Fraction(1, 2) + Fraction(1, 10**40)]
    with mpmath.workdps(40):
        for x in (*places, *(-x for x in places)):
            low, high = arctan_bounds(x)
            value = mpmath.atan(mpmath.mpf(x.numerator) / x.denominator)
            assert high - low < Fraction(1, 10**28)
            assert mpmath.mpf(low.numerator) / low.denominator <= value + mpmath.mpf(10)**-36
            assert mpmath.mpf(high.numerator) / high.denominator >= value - mpmath.mpf(10)**-36
            for fact, (say, sign, wanted) in ARCTAN.items():
                context = Context({}, [])
                if wanted is None or x >= 0:
                    least, most = bounds(context, say(context, number(x), context.call("arctan", number(x))))
                    assert most > 0 or sign != ">", (fact, x)
                    assert most >= 0 and (sign != "==" or least <= 0), (fact, x)


FALSE_LINES = [
    ["arctan(x)", "<=", "x"], ["tan(x)", ">=", "x"], ["tan(x)*cos(x)", "=", "sin(x)"], ["arctan(tan(x))", "=", "x"],
    ["1 + tan(x)**2", "=", "1/cos(x)**2"], ["arctan(x)", "<", "3/2"], ["arctan(x)", ">=", "x - x**3/4"],
    ["x*arctan(x)", ">=", "x**2"], ["4*arctan(1)", "=", "355/113"], ["sin(arctan(x))", "=", "x"],
    ["arctan(x) + arctan(y)", "=", "arctan((x + y)/(1 - x*y))"], ["arctan(1/x)", "=", "arctan(x)"],
    ["cos(arctan(x))", "=", "1/(1 + x**2)"], ["arctan(x)**2", "<=", "arctan(x**2)"],
    ["abs(arctan(x) - arctan(y))", "<=", "abs(x - y)/2"], ["arctan(abs(x))", "=", "arctan(x)"]]


def test_deciders_prove_no_false_line():
    for left, operator, right in FALSE_LINES:
        assert decide_obligation({"assume": [], "show": [operator, left, right]}).verdict != "proved", (left, right)
    for assume, show in (([["!=", "cos(x)", "0"]], ["<=", "tan(x)**2", "1"]),
                         ([[">=", "x", "0"]], [">=", "tan(x)", "x"]), ([], [">=", "4*arctan(1)", "22/7"]),
                         ([[">=", "x", "0"], [">", "cos(x)", "0"]], [">=", "tan(x)", "x"]),
                         ([["<=", "x", "y"]], ["<", "arctan(x)", "arctan(y)"]),
                         ([[">=", "x", "0"], ["<=", "x", "2"]], [">=", "tan(x)", "x"])):
        assert decide_obligation({"assume": assume, "show": show}).verdict == "refuted", show


@pytest.mark.parametrize(("assume", "show"), [
    ([], ["<=", "arctan(x)**2", "x**2"]), ([], ["=", "tan(arctan(x))", "x"]),
    ([], [">=", "x*arctan(x)", "x**2/(1 + x**2)"]), ([], ["<", "abs(arctan(x))", "8/5"]),
    ([["!=", "cos(x)", "0"]], ["=", "1 + tan(x)**2", "1/cos(x)**2"]),
    ([], ["=", "cos(arctan(x))**2*(1 + x**2)", "1"]), ([["<=", "x", "y"]], ["<=", "arctan(x)", "arctan(y)"]),
    ([[">=", "x", "0"], ["<=", "x", "1"]], [">=", "tan(x)", "x"]), ([], ["<", "4*arctan(1)", "22/7"])])
def test_deciders_prove_what_is_so(assume, show):
    outcome = decide_obligation({"assume": assume, "show": show})
    assert outcome.verdict == "proved", outcome.method
    for found in outcome.certificates:
        check(found)
