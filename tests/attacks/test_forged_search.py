"""Short proofs of false lines, by all rules and facts of the checker, about what the lines are made of: none holds."""

import re
from itertools import combinations_with_replacement, product

import pytest

from workbench.proof.checker import CertificateError, check

IDENTITY, RULES = {"rule": "identity"}, ("combination", "contradiction")
FACTS = ("log_tangent", "exp_tangent", "exp_positive", "circle", "cosine_parabola", "sine_tangent", "arctan_sine",
         "arctan_cosine", "arctan_limit", "arctan_tangent", "arctan_sector", "arctan_slope", "enclosure", "abs_square",
         "abs_nonnegative", "sqrt_square", "sqrt_nonnegative", "sqrt_positive")
PAIRS = ("sine_sum", "cosine_sum", "exp_sum", "log_product")
INDEXED = {"indexed": ["u", "v"]}
# A line that is false somewhere, what is assumed, what else the goal says, and what proofs may be about.
FALSE = {
    "a size": ("abs(x) <= x", (), {}, ("x", "-x")),
    "a size of a sum": ("abs(x + y) == abs(x) + abs(y)", (), {}, ("x", "y")),
    "a size of sums": ("abs(Sum(u)) == Sum(abs(u))", (), INDEXED, ("Sum(u)",)),
    "a size of sums, above": ("Sum(abs(u)) <= abs(Sum(u))", (), INDEXED, ("Sum(u)", "Sum(abs(u))")),
    "a sum's square": ("Sum(u)**2 <= Sum(u**2)", (), INDEXED, ("Sum(u)",)),
    "a product of sums": ("Sum(u)*Sum(v) == Sum(u*v)", (), INDEXED, ("Sum(u)", "Sum(v)")),
    "an empty sum": ("Sum(1) >= 1", (), INDEXED, ("Sum(1)",)), "an empty sum of x": (
        "Sum(x) >= x", ("x >= 0",), INDEXED, ("Sum(x)", "x")),
    "a mean": ("Sum(u)/Sum(1) <= Sum(u)", ("Sum(1) > 0",), INDEXED, ("Sum(u)", "Sum(1)")),
    "the sign of a sum's parts": ("Sum(u*v) >= 0", ("Sum(u) >= 0", "Sum(v) >= 0"), INDEXED, ("Sum(u)",)),
    "a sum's rate": ("D(Sum(u*x)) == Sum(v*x) + Sum(u*v)", (), {
        **INDEXED, "flow": {"u": "v", "x": "Sum(v)"}}, ("Sum(u)", "x")),
    "a rate with a sum": ("D(Sum(u)) == Sum(u*v)", (), {**INDEXED, "flow": {"u": "u*Sum(v)"}}, ("Sum(u)",)),
    "a root of a sum": ("sqrt(Sum(u**2)) == Sum(abs(u))", (), INDEXED, ("Sum(u**2)", "Sum(abs(u))")),
    "a root of a sum, above": ("sqrt(Sum(u**2)) >= Sum(u**2)", (), INDEXED, ("Sum(u**2)",)),
    "a root of a product": ("sqrt(x**2*y**2) == x*y", (), {}, ("x*y", "x**2*y**2")),
    "a root above": ("sqrt(x) >= x", ("x >= 0",), {}, ("x",)),
    "a root below": ("sqrt(x) <= x", ("x >= 0",), {}, ("x",)),
    "roots add": ("sqrt(x + y) >= sqrt(x) + sqrt(y)", ("x >= 0", "y >= 0"), {}, ("x", "y", "x + y")),
    "a root is positive": ("sqrt(x) > 0", ("x >= 0",), {}, ("x",)),
    "a size of nothing": ("abs(x) > 0", (), {}, ("x",)), "a sign's square": ("sign(x)**2 == 1", (), {}, ("x",)),
    "signs multiply": ("sign(x + y) == sign(x) + sign(y)", (), {}, ("x", "y", "x + y")),
    "a sign of a size": ("sign(abs(x)) == 1", (), {}, ("x", "abs(x)")),
    "a sign is a size": ("sign(x)*x >= x**2", (), {}, ("x",)),
    "the larger": ("Max(x, y) <= y", (), {}, ("x", "y", "x - y")),
    "the smaller": ("Min(x, y) >= x", (), {}, ("x - y",)),
    "a limit": ("Min(Max(x, -1), 1) == x", (), {}, ("x", "x + 1", "x - 1")),
    "a logarithm above": ("log(x) >= x - 1", ("x > 0",), {}, ("x", "1/x")),
    "a logarithm's sign": ("log(x) >= 0", ("x > 0",), {}, ("x", "1/x")),
    "a logarithm of a square": ("log(x**2) == 2*log(x)", ("x != 0",), {}, ("x", "x**2")),
    "a logarithm of a sum": ("log(x + y) == log(x) + log(y)", ("x > 0", "y > 0"), {}, ("x", "y")),
    "logarithms of two negatives": ("log(x*y) == log(-x) + log(y)", ("x*y > 0",), {}, ("x", "y", "-x")),
    "an exponential": ("exp(x) <= 1 + x", (), {}, ("x", "-x")), "an exponential above one": (
        "exp(x) >= 1", (), {}, ("x", "-x")),
    "exponentials add": ("exp(x + y) == exp(x) + exp(y)", (), {}, ("x", "y")),
    "an exponential's parabola": ("exp(x) >= 1 + x + x**2/2", (), {}, ("x", "x/2")),
    "an exponential's square": ("exp(2*x) == exp(x)", (), {}, ("x", "2*x")),
    "tanh": ("tanh(x) >= x", (), {}, ("x", "2*x")), "tanh is one": ("tanh(x) == 1", ("x > 0",), {}, ("x", "2*x")),
    "a sine": ("sin(x) <= x", (), {}, ("x", "-x")), "a sine at its slope": ("sin(x) >= x", ("x >= 0",), {}, ("x",)),
    "a sine of twice": ("sin(2*x) == 2*sin(x)", (), {}, ("x", "2*x")),
    "sine and cosine": ("sin(x) + cos(x) <= 1", (), {}, ("x",)),
    "a cosine": ("cos(x) >= 1 - x**2/4", (), {}, ("x", "x/2")),
    "a cosine is positive": ("cos(x) > 0", (), {}, ("x", "arctan(x)")),
    "an angle": ("arctan(tan(x)) == x", ("cos(x) > 0",), {}, ("x", "tan(x)")),
    "an angle's limit": ("arctan(x) <= 1", (), {}, ("x", "1")), "angles add": (
        "arctan(x) + arctan(y) == arctan(x + y)", (), {}, ("x", "y", "x + y")),
    "an angle's tangent": ("arctan(x) >= x", ("x >= 0",), {}, ("x",)),
    "an angle of an inverse": ("arctan(1/x) == 2*arctan(1) - arctan(x)", ("x != 0",), {}, ("x", "1/x")),
    "a product of margins": ("x*y >= 1", ("x + y >= 2",), {}, ("x", "y", "x - y")),
    "from a difference": ("x > 0", ("x != 0",), {}, ("x",)),
    "from an equality": ("x >= 0", ("x**2 == 1",), {}, ("x", "y")),
    "an inverse": ("1/x >= 0", ("x != 0",), {}, ("x", "1/x")),
    "an inverse above": ("1/x >= 1", ("x > 0",), {}, ("x", "1/x")),
    "an inverse of a difference": ("1/(x - y) > 0", ("x != y",), {}, ("x - y",)),
    "a rate": ("D(x) <= 0", ("x >= 0",), {"flow": {"x": "x"}}, ("x", "D(x)")),
    "a rate of a rate": ("D(D(x)) == D(x)", (), {"flow": {"x": "y", "y": "x"}}, ("x", "y")),
    "what falls": ("x <= 0", ("y <= 0",), {"flow": {"x": "y", "y": "1"}, "initial": {"x": "0", "y": "-1"}}, ("x", "y")),
    "what does not fall": ("x <= 1", (), {
        "flow": {"x": "d"}, "inputs": ["d"], "initial": {"x": "1"}}, ("x", "d", "x - d")),
    "what always holds, later": ("y <= 0", (), {
        "flow": {"x": "-x", "y": "x"}, "initial": {"x": "1", "y": "0"}, "always": ["x >= 0"]}, ("x", "y", "x + y")),
}


def proofs(show, assumed, about):
    """Short proofs: identities, a product of one or two factors or a sum of two, its contradiction, by cases, upwards,
    downwards and along the flow."""
    known = [{"assume": i} for i in range(len(assumed))]
    single = known + [{what: i} for what in ("inverse", "square_of") for i in range(len(assumed))]
    single += [{key: part} for key in ("square", "positive", "any", "sum_of_squares") for part in about]
    facts = [{"fact": fact, "of": part} for fact in FACTS for part in about]
    single += facts + [{"fact": fact, "of": a, "and": b} for fact in PAIRS for a, b in product(about, repeat=2)]
    left, _, right = re.split(" (==|>=|<=|!=|>|<) ", show)
    single += [{key: f"({left}) - ({right})"} for key in ("any", "square", "positive")]
    last = [{"assume": -1}, {"assume": -2}]
    products = [[], *([one] for one in single), *map(list, combinations_with_replacement(single[:10], 2))]
    plain = [IDENTITY, *(of(rule, (c, f)) for f in products for c in ("1", "-1", "2") for rule in RULES)]
    yield from plain
    for one, two in product(known + single[:4] + last, last):
        yield from (of(rule, (a, [one]), (b, [two])) for a, b in (("1", "1"), ("1", "-1")) for rule in RULES)
    short = [IDENTITY, *(of("combination", (c, f)) for c in ("1", "-1", "2") for f in ([], *([one] for one in last)))]
    for one, two, part in product(short, short, about):
        yield {"rule": "cases", "of": part, "nonnegative": one, "nonpositive": two}
        yield {"rule": "cases", "of": part, "negative": two, "zero": IDENTITY, "positive": one}
        yield {"rule": "nonincreasing", "function": part, "decrease": one, "then": two}
        yield {"rule": "cut", "lemma": f"{part} >= 0", "proof": one, "then": two}
    slopes = short + [of("combination", ("1", [one])) for one in facts]
    for one, two, way, start in product(slopes, short[:5], ("from", "to"), ("0", "1")):
        yield {"rule": "monotone", "variable": "x", way: start, "derivative": one, "at_start": two}


def of(rule, *terms):
    return {"rule": rule, "terms": [{"coefficient": c, "factors": factors} for c, factors in terms]}


ONES = {"x": "1", "y": "1", "u": "1", "v": "1", "d": "1"}
EXAMPLES = {"what falls": {"x": "0", "y": "-1"}, "what always holds, later": {"x": "1", "y": "0"},
            "an inverse of a difference": ONES | {"y": "0"}, "what does not fall": {"x": "1", "d": "0"}}
# The same proofs show what is so.
TRUE = {
    "a size": ("abs(x) >= x", (), {}, ("x",)), "a rise": ("exp(x) >= 1", ("x >= 0",), {}, ("x",)),
    "an exponential": ("exp(x) >= 1 + x", (), {}, ("x",)), "a sum of squares": ("Sum(u**2) >= 0", (), INDEXED, ("u",)),
    "a margin": ("1/x > 0", ("x > 0",), {}, ("x",)), "a sum of sines": (
        "sin(x + y) == sin(x)*cos(y) + cos(x)*sin(y)", (), {}, ("x", "y")),
    "what falls": ("x <= 0", (), {"flow": {"x": "-1"}, "initial": {"x": "0"}}, ("x",)),
    "by contradiction": ("x != 0", ("x > 0",), {}, ("x",)),
}


def accepted(name, show, assumed, goal, tried):
    """The first of the proofs that the checker accepts, None where it accepts none."""
    for proof in tried:
        certificate = {"claim": "doe2026:1", "version": 1, "verdict": "proved", "proofs": [proof],
                       "goal": {"assume": list(assumed), "show": [show], **goal}, "example": EXAMPLES.get(name, ONES)}
        try:
            check(certificate)
        except CertificateError:
            continue
        return proof
    return None


@pytest.mark.parametrize("name", FALSE)
def test_no_short_proof_of_a_false_line_is_accepted(name):
    show, assumed, goal, about = FALSE[name]
    assert accepted(name, show, assumed, goal, proofs(show, assumed, about)) is None
    square = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"square": "x + 1"}]}]}
    assert accepted(name, "(x + 1)**2 >= 0", assumed, goal, [square]), "the goal itself is refused"


@pytest.mark.parametrize("name", TRUE)
def test_a_true_line_is_shown_by_one_of_them(name):
    show, assumed, goal, about = TRUE[name]
    assert accepted(name, show, assumed, goal, proofs(show, assumed, about))
