"""Goals are kept as they are typed: nothing is cancelled on the way, and what has no meaning is refused in one line."""

from __future__ import annotations

import random
import threading
from fractions import Fraction

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.building import built
from workbench.proof.checker import CertificateError, Context, bounds, number, substitute
from workbench.proof.claim import Claim, D, Goal, at_least, at_most, equal, greater
from workbench.proof.decide.engine import attempted_proof, decide, prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.text import text
from workbench.proof.typed import as_typed, evaluated

x, y, c, u, t = sp.symbols("x y c u t", real=True)
p = sp.Symbol("p", positive=True)
j, n = sp.Symbol("j", integer=True), sp.Symbol("n")
W = sp.IndexedBase("W", real=True)[j]
one = sp.Integer(1)


def over(term: sp.Expr) -> sp.Expr:
    return sp.Sum(term, (j, 1, n))


def claim_of(build, kind="identity"):
    return Claim(id="a:1", title="t", kind=kind, printed="t", recorded="proved", build=build)


KEPT = {
    "x/x": lambda: x / x, "0*(1/x)": lambda: 0 * (1 / x), "x - x": lambda: x - x, "sqrt(x)**2": lambda: sp.sqrt(x) ** 2,
    "exp(log(x))": lambda: sp.exp(sp.log(x)), "abs(p)": lambda: sp.Abs(p),
    "x/y at y = x": lambda: (x / y).xreplace({y: x}),
    "a sum of three": lambda: sum([x, x, x]), "a function inside": lambda: sp.tanh(x / x),
    "Max(x, x/x)": lambda: sp.Max(x, x / x),
}


@pytest.mark.parametrize("name", KEPT)
def test_what_is_written_down_is_kept(name):
    with as_typed():
        kept = KEPT[name]()
    assert kept != KEPT[name]() or name == "Max(x, x/x)"
    assert evaluated(kept) == KEPT[name]()


def test_what_sympy_calculates_is_as_sympy_gives_it():
    def calculations():
        square = (x + p) ** 2 / p
        return (sp.expand(square), sp.diff(square, x), sp.integrate(x**2 * p, (x, 0, 1)), sp.factor(x**2 - p**2),
                sp.Matrix([[x, p], [1, x]]).det(), sp.together(1 / x + 1 / p), sp.limit(x / (x + 1), x, sp.oo))

    usual = calculations()
    with as_typed():
        assert tuple(map(evaluated, calculations())) == usual


def test_other_threads_and_later_code_evaluate():
    seen = []
    with as_typed():
        other = threading.Thread(target=lambda: seen.append(x / x))
        other.start()
        other.join()
    assert seen == [1]
    assert x / x == 1


def _random_tree(rng: random.Random, depth: int) -> sp.Expr:
    if depth == 0:
        return rng.choice([x, y, sp.Integer(rng.randint(-3, 3)), sp.Rational(rng.randint(-5, 5), 3)])
    a, b = _random_tree(rng, depth - 1), _random_tree(rng, depth - 1)
    return rng.choice([lambda: a + b, lambda: a - b, lambda: a * b, lambda: a / b, lambda: -a, lambda: a**2,
                       lambda: a ** -1, lambda: a ** -3, lambda: sp.Abs(a), lambda: sp.Max(a, b)])()


def test_the_text_means_what_was_typed():
    """The checker's value of the text is sympy's value of the tree, wherever it has one."""
    rng, compared = random.Random(1), 0
    for _ in range(400):
        with as_typed():
            tree = _random_tree(rng, 3)
        context = Context({}, [])
        point = {"x": Fraction(7, 5), "y": Fraction(-11, 3)}
        try:
            exact = evaluated(tree.xreplace({x: sp.Rational(7, 5), y: sp.Rational(-11, 3)}))
            value = substitute(context, context.read(text(tree)), {name: number(v) for name, v in point.items()})
        except (CertificateError, ValueError, TypeError):  # it divides by zero on the way
            continue
        if not exact.is_Rational:
            continue
        assert bounds(context, value)[0] == Fraction(int(exact.p), int(exact.q)), text(tree)
        compared += 1
    assert compared > 200


UNDEFINED_SOMEWHERE = {"x/x == 1": lambda: Goal((equal(x / x, 1),)),
                       "0*(1/x) == 0": lambda: Goal((equal(0 * (1 / x), 0),)),
                       "sqrt(x)**2 == x": lambda: Goal((equal(sp.sqrt(x) ** 2, x),))}


@pytest.mark.parametrize("name", UNDEFINED_SOMEWHERE)
def test_a_lost_domain_is_not_proved(name):
    decision = decide(claim_of(UNDEFINED_SOMEWHERE[name]))
    assert decision.verdict == "undecided"
    assert "undefined at x = " in decision.method or "not shown" in decision.method


def test_the_domain_stated_makes_it_true():
    assert decide(claim_of(lambda: Goal((equal(x / x, 1),), (greater(x, 0),)))).verdict == "proved"


REFUSED = {
    "complex roots": (lambda: Goal((equal(sp.sqrt(-2) * sp.sqrt(-3), -sp.sqrt(6)),)), "no real value"),
    "division by zero": (lambda: Goal((equal(1 / (x - x), 0),)), "value"),
    "a log of the negative": (lambda: Goal((equal(0 * sp.log(-p), 0),)), "no real value"),
    "the same on both sides": (lambda: Goal((equal(x + y, x + y),)), "states nothing"),
    "an upper limit that is a number": (lambda: Goal((equal(sp.Sum(1, (j, 1, 3)), 3),)),
                                        "write a sum of so many terms out"),
    "an empty range": (lambda: Goal((at_least(sp.Sum(1, (j, 1, -5)), 0),)), "write a sum of so many terms out"),
    "a lower limit": (lambda: Goal((at_least(sp.Sum(W**2, (j, 2, n)), 0),)), "from 1 to a symbol"),
    "the count as a number": (lambda: Goal((equal(over(one), n),)), "stands elsewhere"),
    "D of a constant": (lambda: Goal((equal(D(c), 0),), flow={x: u}), "does not move"),
    "D of an input": (lambda: Goal((equal(D(u), 0),), flow={x: u}, inputs=(u,)), "needs the rate of the input"),
    "D(D(x)) along an input": (lambda: Goal((equal(D(D(x)), 0),), flow={x: u}, inputs=(u,)),
                               "needs the rate of the input"),
    "an input with a rate": (lambda: Goal((at_least(x**2, 0),), flow={x: one}, inputs=(x,)), "give one of the two"),
    "a large number": (lambda: Goal((greater(sp.Integer(10) ** 2000 * x, 0),)), "digits|too large"),
    "a large power": (lambda: Goal((at_least(x**100, 0),)), "too large"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_meaning_is_refused_in_one_line(name):
    build, said = REFUSED[name]
    with pytest.raises(ClaimError, match=said) as caught:
        built(claim_of(build), claim_of(build).build)
    assert "\n" not in str(caught.value)


def test_second_derivatives_and_e():
    assert prove_goal(Goal((equal(D(D(x)), -x),), flow={x: y, y: -x})) is not None
    assert prove_goal(Goal((greater(sp.E, 2),))) is not None
    assert decide(claim_of(lambda: Goal((at_least(sp.E**x, 1 + x),)), "inequality")).verdict == "proved"


def test_the_sign_of_a_moving_symbol_is_an_assumption():
    goal = Goal((at_least(p * y**2, 0),), flow={p: y})
    proof = prove_goal(goal)
    assert proof is not None
    assert proof["goal"]["assume"] == ["p > 0"]


def test_only_declared_inputs_vary():
    """x' <= c with a constant c gives x <= c t; with a c that may fall in time it does not."""
    def goal(*inputs):
        return Goal((at_most(x, c * t),), (), {t: one, x: u}, (at_most(u, c),), {x: sp.Integer(0), t: sp.Integer(0)},
                    decreasing=x - c * t, inputs=inputs)

    assert prove_goal(goal(u)) is not None
    assert find_counterexample(goal(u), "gap") is None
    assert prove_goal(goal(u, c)) is None
    assert find_counterexample(goal(u, c), "gap") is not None


def test_a_later_instant_that_is_never_reached_proves_nothing():
    """x' = 1 from 0 never comes to -1; it comes to 3, along a path that the certificate states."""
    never = Goal((at_most(1, 0),), (at_most(x, -1),), {x: one}, initial={x: sp.Integer(0)}, decreasing=-x)
    assert isinstance(attempted_proof(never), str)
    later = prove_goal(Goal((at_least(x, 0),), (at_least(x, 3),), {x: one}, initial={x: sp.Integer(0)}, decreasing=-x))
    assert later is not None
    assert later["path"] == {"x": "time"}


COUNTED = {"false for none": (greater(over(W**2 + 1), 0), 0), "false for three": (at_most(over(one), 2), 3),
           "false for two": (at_most(over(sp.Abs(W)), sp.sqrt(over(W**2))), 2)}


@pytest.mark.parametrize("name", COUNTED)
def test_sums_are_refuted_at_other_numbers_of_terms(name):
    shown, count = COUNTED[name]
    found = find_counterexample(Goal((shown,)), "refuted")
    assert found is not None
    assert len(found["terms"]) == count


def test_counterexamples_are_simple():
    point = find_counterexample(Goal((at_most(x * y, x**2 + y**2 - 1),)), "refuted")["point"]
    assert set(point.values()) <= {"0", "1", "-1"}


def test_what_is_put_in_for_a_term_built_elsewhere_is_put_in_or_told():
    """A saturation of the law, replaced by a sign within the goal, stayed as it was and another line was decided."""
    law = -sp.Max(-1, sp.Min(1, (x + y) / p))
    first = claim_of(lambda: Goal((at_most(law.subs(sp.Max(-1, sp.Min(1, (x + y) / p)), sp.sign(x + y)), 1),)))
    with pytest.raises(ClaimError, match=r"claim a:1: nothing is put in for Max.* build both above it"):
        built(first, first.build)
    second = claim_of(lambda: Goal((at_most(law.subs({x: y, y: x}).subs(x * y, 1), 1),)))
    assert built(second, second.build).show
    assert law.subs(sp.Max(-1, sp.Min(1, (x + y) / p)), 0) == 0
