"""Obligations stated as data are read as they stand, decided with certificates of their own, and never wrongly."""

import json
import random
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest
import sympy as sp
from sympy.polys.orderings import grevlex
from sympy.polys.rings import PolyRing

from workbench.errors import ClaimError
from workbench.files.time_limit import OutOfTime, at_most_seconds
from workbench.proof.checker import check
from workbench.proof.decide.ideals import groebner_basis
from workbench.proof.decide.obligations import belongs, decide_obligation
from workbench.proof.decide.reduced import reduced
from workbench.proof.obligation import expression, goals_of
from workbench.proof.text import goal_text

FILE = Path(__file__).parents[2] / "benchmarks" / "peers" / "ode_invariants.json"
PEERS = json.loads(FILE.read_text(encoding="utf-8"))
# Some of every kind, and of every way in which they are decided; each takes a fraction of a second.
SAMPLE = (0, 46, 59, 93, 97, 128, 176, 185)
MONOMIALS = [sp.sympify(text) for text in ("x*y", "x", "y**2", "z", "x*z", "1")]


def stated(show, *assume):
    """An obligation."""
    return {"assume": list(assume), "show": show}


def outcome_of(obligation):
    """The verdict, after its certificates are checked and found to be of the obligation."""
    outcome = decide_obligation(obligation)
    for certificate in outcome.certificates:
        check(certificate)
    assert outcome.verdict == "undecided" or belongs(obligation, outcome.verdict, outcome.certificates)
    return outcome.verdict


@pytest.mark.parametrize("number", SAMPLE)
def test_the_peers_obligations_are_decided_as_they_are_known(number):
    assert outcome_of(PEERS[number]) == {"true": "proved", "false": "refuted"}[PEERS[number]["known"]]


@pytest.mark.parametrize(("obligation", "goals"), [
    (stated(["and", ["<=", "x", "1"], [">", "x", "0"]], ["=", "y", "x"]),
     [(["y == x"], "x <= 1"), (["y == x"], "x > 0")]),
    (stated(["or", ["<=", "x", "1"], [">", "y", "0"]]), [(["x > 1"], "y > 0")]),
    (stated([">", "x", "0"], ["or", ["=", "x", "1"], ["and", ["=", "x", "2"], ["<", "y", "0"]]]),
     [(["x == 1"], "x > 0"), (["x == 2", "y < 0"], "x > 0")]),
    (stated(["not", ["and", ["=", "x", "0"], ["not", ["<", "y", "0"]]]]), [(["x == 0"], "y < 0")]),
    (stated(["<=", "x/2 - 1", "x/2 - 1"], ["<", "x", "y"]), [([], "x/2 - 1 - (x/2 - 1) <= 0")]),
])
def test_an_obligation_is_read_as_its_goals(obligation, goals):
    found = [(record["assume"], record["show"][0]) for record in map(goal_text, goals_of(obligation))]
    assert found == goals


@pytest.mark.parametrize("statement", [
    ["<=", "__import__('os')", "0"], ["<=", "x.real", "0"], ["<=", "[x]", "0"], ["<=", "x if y else z", "0"],
    ["<=", "lambda: x", "0"], ["<=", "0.1*x", "0"], ["<=", "'x'", "0"], ["<=", "x**y", "0"], ["<=", "True", "0"],
    ["=<", "x", "0"], ["<=", "x"], ["<=", ["x"], "0"], "x <= 0", ["and"], ["xor", ["<", "x", "0"], ["<", "y", "0"]],
    ["<=", "(" * 3000 + "x" + ")" * 3000, "0"], ["<=", "", "0"], ["<=", "f(x)", "0"], ["<=", "1/0", "x"],
])
def test_what_is_no_obligation_is_refused_in_one_line(statement):
    with pytest.raises(ClaimError) as trouble:
        goals_of(stated(statement))
    assert "\n" not in str(trouble.value)


@pytest.mark.parametrize(("obligation", "verdict"), [
    (stated(["!=", "x", "0"], [">", "x**2 + y**2", "0"], ["=", "y", "0"]), "proved"),
    (stated([">", "x*y", "x"], [">", "x", "0"], [">", "y", "1"]), "proved"),
    (stated([">=", "z", "7"], ["<", "x", "0"], [">", "x", "1"]), "proved"),  # nothing meets what is assumed
    (stated(["<=", "x + y", "2"], ["=", "x**2 + y**2", "3"]), "refuted"),  # no rational point lies on that circle
    (stated(["<=", "x + y", "5/2"], ["=", "x**2 + y**2", "3"]), "proved"),
    (stated(["<=", "x**2 + y*(y + 10)/8 + 1961/13", "40*x"], ["<=", "(x - 9)**2 + (y - 20)**6", "4"]), "proved"),
    (stated(["or", ["<=", "x", "y"], ["<=", "y", "x"]]), "proved"),
    (stated(["=", "x*y", "y"], [">=", "x", "1"], ["<=", "x", "1"]), "proved"),
    (stated(["=", "y**2 - 4*cos(x)", "-1"], ["=", "x", "0"], ["=", "y**2", "3"]), "proved"),  # two inequalities
    (stated(["<=", "y**2 - 4*cos(x)", "-1"], ["=", "x", "0"], ["=", "y**2", "3"]), "proved"),
    (stated(["=", "x*z", "y"], ["=", "x", "1"], ["=", "y**2", "-1"]), "proved"),  # nothing meets what is assumed
    (stated(["=", "y**3", "2*y"], ["=", "x**2", "2"], ["=", "x*y", "2"]), "proved"),  # two coupled roots meet it
    (stated(["=", "y", "x"], ["=", "x**2", "2"], ["=", "y**2", "2"]), "refuted"),
    (stated(["=", "x", "y"], ["=", "x**2 + y**2", "1"], ["=", "x*y", "1/2"]), "proved"),  # by its square alone
    (stated(["=", "2*(x**4 + y**4 + z**4)", "1"], ["=", "x + y + z", "0"], ["=", "x**2 + y**2 + z**2", "1"]), "proved"),
    (stated(["<=", "y", "2"], ["=", "y**2 - 4*cos(x)", "-1"]), "proved"),  # beside points that are no roots
    (stated(["and", [">=", "x**2", "0"], ["<=", "x", "x**2"]]), "refuted"),
    (stated(["=", "y", "0"], ["=", "x*y", "0"], ["!=", "x", "0"]), "proved"),  # a division by what is not zero
    (stated(["=", "y", "0"], ["=", "x*y", "0"], ["=", "x**2", "x"]), "refuted"),
    (stated(["=", "y", "0"], ["=", "x**2", "1"], ["<", "x", "1"], [">", "x", "-1"]), "proved"),  # nothing meets it
    (stated(["!=", "z", "0"], ["=", "x*y", "1"], ["=", "x*z", "2"]), "proved"),
    (stated(["!=", "x*z", "2"], ["=", "x*y", "1"], ["=", "y*z", "2"]), "refuted"),
    (stated(["=", "a**2 + c**2", "1"], ["=", "a**2 + b**2", "1"], ["=", "c**2 + d**2", "1"], ["=", "a*c + b*d", "0"]),
     "proved"),  # rows are orthonormal, so columns are
    (stated(["or", ["=", "x", "0"], ["=", "y", "0"]], ["or", ["=", "x*y", "0"], ["=", "x**2", "1"]], ["<", "x", "1"],
            [">", "x", "-1"]), "proved"),
    (stated(["<=", "x*z**2 - x*z", "6*z**2"], ["=", "x**2 + y**2 + z**2", "100"], ["<=", "y**2", "1"], [">=", "z", "0"],
            ["<=", "x", "5"]), "refuted"),  # far from where x and y are bounded
    (stated(["<=", "x - 2*x*y - y**2 - 2*z**2 - 2*w**4", "0"], ["=", "x**2/2 + y**2 + z**2 + w**2", "1/10000"]),
     "refuted"),  # a small sphere, seen from afar
    (stated(["<=", "a + b", "141/100"], ["<=", "a**2 + b**2 + c**2 + d**2 + e**2", "1"]), "refuted"),  # narrow
    (stated([">", "c", "1/2"], ["<=", "y**2 + 2*(1 - c)", "1"], ["=", "s**2 + c**2", "1"]), "refuted"),  # at two points
    (stated(["<=", "x", "y"], ["<=", "x + v**2/(2*b)", "y + w**2/(2*b)"], [">", "b", "0"]), "refuted"),  # b comes later
    (stated([">=", "(u - a)**2", "s**2"], [">=", "(x - a)**2", "(r + s)**2"], [">", "r", "0"], [">", "s", "0"],
            ["<=", "(u - x)**2", "r**2"]), "proved"),  # distances alone
    (stated(["<=", "x**2*(1 - y) + y**2*(1 - z) + z**2*(1 - x)", "1"], [">=", "x", "0"], ["<=", "x", "1"],
            [">=", "y", "0"], ["<=", "y", "1"], [">=", "z", "0"], ["<=", "z", "1"]), "proved"),  # products of three
    (stated(["<=", "(p - a*y)*(p - b*y)", "0"], ["!=", "y", "0"], ["<=", "a*y**2", "y*p"], ["<=", "y*p", "b*y**2"]),
     "proved"),
    (stated([">", "(1 + x)**2 + y**2", "0"], ["<", "x**2 + y**2", "1"]), "proved"),  # the square of what is positive
    (stated(["<=", "log(x)", "7/10"], ["<=", "x", "2"], [">", "x", "0"]), "proved"),
    (stated(["<=", "log(x)", "69/100"], ["<=", "x", "2"], [">", "x", "0"]), "refuted"),
    (stated(["<=", "abs(x)/sqrt(1 + x**2)", "1"]), "proved"),
    (stated(["<", "x/sqrt(x**2)", "1"], ["!=", "x", "0"]), "refuted"),
])
def test_each_way_of_deciding(obligation, verdict):
    assert outcome_of(obligation) == verdict


@pytest.mark.parametrize("seed", range(6))
def test_a_basis_is_sympys_and_its_cofactors_make_it_of_the_equalities(seed):
    """Every element is the sum of its cofactors times the equalities, and both bases span the same ideal."""
    ring, rng = PolyRing("x, y, z", sp.QQ, grevlex), random.Random(seed)
    zeros = [sum((rng.randint(-2, 2) * m for m in map(ring.from_expr, MONOMIALS)), ring.zero) for _ in range(3)]
    found = groebner_basis(ring, zeros)
    for element in found:
        assert element.value == sum((c * z for c, z in zip(element.cofactors, zeros, strict=True)), ring.zero)
    theirs = sp.groebner([z.as_expr() for z in zeros], *ring.symbols, order="grevlex").polys
    assert all(not ring.from_expr(other.as_expr()).rem([element.value for element in found]) for other in theirs)


def test_what_is_shown_may_be_taken_less_multiples_of_equalities():
    goal, = goals_of(stated(["<=", "x**3 + x*y**2 + y", "3/2"], ["=", "x**2 + y**2", "1"], [">=", "x", "0"]))
    lower = reduced(goal)
    assert sp.expand(lower.goal.show[0].margin - (sp.Rational(3, 2) - sp.Symbol("x", real=True)
                                                  - sp.Symbol("y", real=True))) == 0
    # n**2, for the margin n of the opposite of what is left, is m**2 of that stated and a multiple of the circle.
    n, m = (-sp.expand(g.show[0].margin) for g in (lower.goal, goal))
    term, rest = lower.terms_as_stated([{"coefficient": "1", "factors": [{"assume": 2}, {"assume": 2}]}])
    circle = -(goal.assume[0].right - goal.assume[0].left)
    moved = expression(rest["factors"][1]["any"])
    assert term["factors"] == [{"assume": 2}, {"assume": 2}]
    assert sp.expand(m**2 + circle * moved - n**2) == 0
    assert outcome_of(stated(["<=", "x**3 + x*y**2 + y", "3/2"], ["=", "x**2 + y**2", "1"])) == "proved"


def test_certificates_of_another_obligation_do_not_belong():
    mine, other = stated([">=", "x*y", "x"], [">=", "x", "0"], [">=", "y", "1"]), stated([">=", "x*y", "2*x"],
                                                                                       [">=", "x", "0"],
                                                                                       [">=", "y", "1"])
    outcome = decide_obligation(mine)
    assert belongs(mine, "proved", outcome.certificates)
    assert not belongs(other, "proved", outcome.certificates)
    assert not belongs(mine, "refuted", outcome.certificates)
    assert not belongs(mine, "proved", ())
    assert not belongs(stated(mine["show"], [">=", "x", "0"]), "proved", outcome.certificates)


def random_obligation(rng):
    """Two random assumptions and what may follow of them, all of degree two at most in x and y."""
    def polynomial():
        terms = rng.sample(["x", "y", "x**2", "y**2", "x*y", "1"], rng.randint(2, 4))
        return " + ".join(f"{rng.choice([-2, -1, 1, 2])}*{term}" for term in terms).replace("+ -", "- ")

    return stated([rng.choice(["<", "<=", ">=", "!="]), polynomial(), "0"],
                  *([rng.choice(["<", "<=", "=", ">="]), polynomial(), "0"] for _ in range(2)))


def holds(statement, point):
    """Whether a statement holds at a point, by Python's own arithmetic of fractions."""
    operator, left, _ = statement
    value = eval(left, {"__builtins__": {}}, dict(point))  # noqa: S307 - this file's own polynomials
    return {"<": value < 0, "<=": value <= 0, "=": value == 0, "!=": value != 0, ">=": value >= 0}[operator]


def test_random_obligations_are_never_proved_against_a_point_that_breaks_them():
    rng, grid, decided = random.Random(20), [Fraction(n, 2) for n in range(-8, 9)], 0
    for _ in range(14):
        obligation = random_obligation(rng)
        broken = any(all(holds(a, point) for a in obligation["assume"]) and not holds(obligation["show"], point)
                     for point in ({"x": x, "y": y} for x, y in product(grid, grid)))
        try:
            with at_most_seconds(0.3):
                verdict = outcome_of(obligation)
        except OutOfTime:
            continue
        decided += verdict != "undecided"
        assert not (broken and verdict == "proved")
    assert decided >= 9


def test_every_textbook_fact_can_be_stated():
    facts = json.loads((Path(__file__).parents[2] / "benchmarks" / "textbook" / "facts.json").read_text())
    assert len({(fact["problem"], str(fact["show"])) for fact in facts}) == 166
    assert all(len(goals_of(fact)) == 1 for fact in facts)
