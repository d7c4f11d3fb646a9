"""What a proof takes of a premise beyond what that shows is told: the premise's own assumptions, signs and rates."""

from fractions import Fraction

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less
from workbench.proof.decide.engine import decide_all
from workbench.proof.paper import Paper

x, y, z = sp.symbols("x y z", real=True)
z_declared = sp.Symbol("z", positive=True)
HALF = sp.Rational(1, 2)


def judged(*builders):
    """Decisions on claims 1, 2, ..., each built from what the one before shows; the last is a headline."""
    paper = Paper("p2030", "none")
    for number, build in enumerate(builders, 1):
        premises = (str(number - 1),) if number > 1 else ()
        severity = "result" if number == len(builders) else "step"
        collect = paper.claim(str(number), "A line", "inequality", "x", "proved", premises=premises, severity=severity)
        collect(lambda build=build, premises=premises: build(paper.shown(premises[0]) if premises else ()))
    found = decide_all(paper.claims)
    assert {d.verdict for d in found} == {"proved"}
    return found


def beyond_one(shown):
    return Goal((at_least(x**2, 1),), (*shown, at_least(x, 1)))


def everywhere(shown):
    """False of x = 0 where nothing but x**2 >= 1 for x >= 1 is shown."""
    return Goal((at_least(x**2, HALF),), shown)


NARROWER = {
    "an assumption": ((beyond_one, everywhere), ("x >= 1 (1)",)),
    "an assumption two steps below": (
        (beyond_one, everywhere, lambda shown: Goal((at_least(2 * x**2, 1),), shown)), ("x >= 1 (1)",)),
    "a sign that is declared": ((lambda _: Goal((greater(z_declared**3, 0),)), lambda shown: Goal(
        (greater(z, 0),), tuple(r.subs({z_declared: z}) for r in shown))), ("z > 0 (1)",)),
    "rates of another flow": ((lambda _: Goal((at_most(D(x**2), 0),), flow={x: -x}), lambda shown: Goal(
        (at_most(D(x**2), 1),), shown, flow={x: x})), ("rates are as in (1)",)),
    "of a rate that is derived again": ((lambda _: Goal((at_most(D(D(x)), 0),), flow={x: y, y: sp.S.NegativeOne}),
        lambda shown: Goal((at_most(z, 0),), shown, flow={x: y, y: z})), ("rates are as in (1)",)),
    "of a letter that stands in the rates": ((lambda _: Goal((at_most(D(x**2), 0),), (at_least(z, 0),), {x: -z * x}),
        lambda shown: Goal((at_most(D(x**4), 0),), shown, {x: -z * x})), ("z >= 0 (1)",)),
    "of an input": ((lambda _: Goal((at_most(D(x**2), 0),), (at_most(x * y, 0),), {x: y - x}, inputs=(y,)),
        lambda shown: Goal((at_most(D(x**4), 0),), shown, {x: y - x}, inputs=(y,))), ("x*y <= 0 (1)",)),
    "of another motion": ((lambda _: Goal(
        (at_most(x**2, 0),), flow={x: -x}, initial={x: sp.S.Zero}, decreasing=x**2),
        lambda shown: Goal((equal(D(x), 0),), shown, {x: -3 * x})), ("rates are as in (1)",)),
    "of another start": ((lambda _: Goal(
        (at_most(x**2, 0),), flow={x: -x}, initial={x: sp.S.Zero}, decreasing=x**2),
        lambda shown: Goal((at_most(x, y**2),), shown, {x: -x}, initial={x: -y**2})),
        ("initial values are as in (1)",)),
    "what always holds": ((lambda _: Goal(
        (at_most(x, 0),), flow={x: y}, inputs=(y,), initial={x: sp.S.Zero}, always=(at_most(y, 0),), decreasing=x),
        lambda shown: Goal((at_most(x + y**2, y**2),), shown)), ("y <= 0 (1)",)),
}
AS_WIDE = {
    "the same assumption": (beyond_one, lambda shown: Goal((at_least(x**2, HALF),), (*shown, at_least(x, 1)))),
    "no assumption": (lambda _: Goal((at_least(x**2, 0),)), lambda shown: Goal((at_least(x**2 + 1, 1),), shown)),
    "letters of its own": (lambda _: Goal((at_least(x, 0),), (at_least(x - y, 0), at_least(y, 0))),
                           lambda shown: Goal((at_least(x + 1, 1),), shown)),
    "the same rates": (lambda _: Goal((at_most(D(x**2), 0),), flow={x: -x}), lambda shown: Goal(
        (at_most(D(x**2), 1),), shown, flow={x: -x, y: x})),
    "what is not used": (beyond_one, lambda _: Goal((at_least(x**2 + 1, 1),))),
}


@pytest.mark.parametrize("name", NARROWER)
def test_what_a_premise_assumes_is_said_of_what_uses_it(name):
    builders, taken = NARROWER[name]
    last = judged(*builders)[-1]
    assert last.besides == taken
    assert last.fate.word == "stands"
    assert f"holds where {taken[0]}, which it does not state" in last.fate.why


def test_a_headline_whose_own_way_fails_says_it_too():
    paper = Paper("p2030", "none")
    paper.claim("0", "A line", "inequality", "x", "refuted")(lambda: Goal((at_least(x, 0),)))
    paper.claim("1", "A line", "inequality", "x", "proved")(lambda: beyond_one(()))
    paper.claim("2", "A line", "inequality", "x", "proved", premises=("1",), rests_on=("0",), severity="result")(
        lambda: everywhere(paper.shown("1")))
    last = decide_all(paper.claims)[-1]
    assert last.fate.word == "stands with corrections"
    assert "holds where x >= 1 (1), which it does not state, but not by the way of the text" in last.fate.why


def test_what_holds_by_definition_is_no_condition():
    """An integral of squares is not negative, and the least of two numbers is at most each; what is only assumed of a
    letter that is neither is told."""
    paper, c, a, big, V = Paper("p2030", "none"), *sp.symbols("c a Z V", real=True)

    def stated(equation, printed, goal, premises=(), severity="step"):
        paper.claim(equation, "A line", "inequality", printed, "proved", premises=premises, severity=severity)(
            lambda: goal() if callable(goal) else goal)

    stated("least", r"c = \min(a, b),\ c^2 \ge 0", Goal((at_least(c**2, 0),)))
    stated("square", "Z", lambda: Goal((at_least(big, 0),), flow={big: x**2}, inputs=(x,), initial={big: sp.S.Zero},
                                       decreasing=-big))
    stated("defined", "V", Goal((at_least(V, 0),), (equal(V, x**2 + z_declared * x**2), greater(z_declared, 0))))
    stated("1", "x", Goal((at_most(c + y, a + y),), (at_most(c, a), at_least(big, 0), at_least(V, 0), at_least(y, 0))),
           ("square",))
    stated("2", "x", lambda: Goal((at_most(c + y, a + y + big**2 + V**2),), paper.shown("1")), ("1",), "result")
    last = decide_all(paper.claims)[-1]
    assert last.besides == ("y >= 0 (1)",)


@pytest.mark.parametrize("name", AS_WIDE)
def test_nothing_is_said_where_a_premise_assumes_no_more(name):
    last = judged(*AS_WIDE[name])[-1]
    assert last.besides == ()
    assert last.fate.why == "holds, and no line that the text uses to get there fails"


def test_a_claim_names_what_it_takes():
    """Else a headline would stand on a line that fails, and nobody would hear of it."""
    paper = Paper("p2030", "none")
    paper.claim("1", "A line", "inequality", "x", "refuted")(lambda: Goal((at_least(x**2, 1),)))
    paper.claim("2", "Another", "inequality", "x", "proved", severity="result")(
        lambda: Goal((at_least(x**2, HALF),), paper.shown("1")))
    with pytest.raises(ClaimError, match="claim p2030:2: takes what claim p2030:1 shows, which is none of its prem"):
        decide_all(paper.claims)


def test_what_a_premise_takes_of_its_own_needs_no_name():
    assert judged(beyond_one, everywhere, lambda shown: Goal((at_least(2 * x**2, 1),), shown))[-1].verdict == "proved"


def test_a_condition_at_numbers_is_one_of_who_takes_it():
    """4 y < x^2 is shown at x = 3, y = 1; that 2 y < x^2 follows from it holds where it does."""
    paper = Paper("p2030", "none")
    paper.claim("1", "The gains", "condition", "x", "proved", at={x: Fraction(3), y: Fraction(1)})(
        lambda: Goal((less(4 * y, x**2),)))
    paper.claim("2", "A line", "inequality", "x", "proved", premises=("1",), severity="result")(
        lambda: Goal((less(2 * y, x**2),), (*paper.shown("1"), greater(y, 0))))
    paper.claim("3", "The same", "condition", "x", "proved", premises=("1",), at={x: Fraction(3), y: Fraction(1)})(
        lambda: Goal((less(2 * y, x**2),), paper.shown("1")))
    found = decide_all(paper.claims)
    assert [d.besides for d in found] == [(), ("4*y < x**2 (1)",), ()]
    assert "holds where 4*y < x**2 (1), which it does not state" in found[1].fate.why
