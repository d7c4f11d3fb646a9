"""Named lemmas: of systems that a lemma is of, every hypothesis is proved; of one that breaks a hypothesis it is that
one which fails."""

from fractions import Fraction

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof import lemmas
from workbench.proof.claim import D, at_least, at_most, differ, equal, greater, less
from workbench.proof.decide.engine import decide
from workbench.proof.paper import Paper

x, y, p, d, v, z, t = sp.symbols("x y p d v z t", real=True)
level = sp.Symbol("V_0", nonnegative=True)
HALF, TWO = sp.Rational(1, 2), sp.Integer(2)
FALLS, ADAPTS = {x: -x}, {x: -x - p * x, p: x**2}
ENERGY = x**2 / 2 + p**2 / 2


def delayed(gain):
    """x' = -2 x + gain y with y = x(t - r)."""
    return lemmas.razumikhin(x**2, {x: y}, 1, 1, sp.Rational(121, 100), HALF, {x: -2 * x + gain * y})


# What holds, what does not, and which hypothesis fails then.
CASES = {
    "comparison": (lambda: lemmas.comparison(x**2, TWO, sp.Integer(0), FALLS),
                   lambda: lemmas.comparison(x**2, sp.Integer(3), sp.Integer(0), FALLS), "rate"),
    "ultimate bound": (lambda: lemmas.ultimate_bound(x**2, sp.Integer(1), sp.Integer(1), {x: -x + d},
                                                     (at_most(d**2, 1),), (d,)),
                       lambda: lemmas.ultimate_bound(x**2, sp.Integer(1), HALF, {x: -x + d}, (at_most(d**2, 1),), (d,)),
                       "rate"),
    "finite time": (lambda: lemmas.finite_time(v, sp.Integer(1), HALF, {v: -2 * sp.sqrt(v)}, (at_least(v, 0),)),
                    lambda: lemmas.finite_time(v, sp.Integer(1), TWO, {v: -2 * v**2}, (at_least(v, 0),)),
                    "power.below"),
    "input to state": (lambda: lemmas.input_to_state(x**2, (x,), HALF, TWO, sp.Integer(1), sp.Integer(1), (d,),
                                                     {x: -x + d}),
                       lambda: lemmas.input_to_state(x**2, (x,), TWO, TWO, sp.Integer(1), sp.Integer(1), (d,),
                                                     {x: -x + d}), "lower"),
    "Barbalat": (lambda: lemmas.barbalat(ENERGY, x**2, level, 4 * level * (1 + level), ADAPTS),
                 lambda: lemmas.barbalat(ENERGY, x**2, level, sp.Integer(1), ADAPTS), "steepest.above"),
    "LaSalle-Yoshizawa": (lambda: lemmas.lasalle_yoshizawa(ENERGY, (x, p), HALF, HALF, x**2, ADAPTS),
                          lambda: lemmas.lasalle_yoshizawa(ENERGY, (x, p), HALF, HALF, x, FALLS | {p: 0}), "decrease"),
    "Razumikhin": (lambda: delayed(1), lambda: delayed(2), "rate"),
    "Nagumo": (lambda: lemmas.nagumo(1 - x**2, {x: -x + d}, (at_most(d**2, HALF),), (d,)),
               lambda: lemmas.nagumo(1 - x**2, {x: -x + d}, (at_most(d**2, 1),), (d,)), "border"),
    "Darboux": (lambda: lemmas.darboux(x, y, {x: x * y, y: -y}), lambda: lemmas.darboux(x, y, {x: x * y + 1, y: -y}),
                "rate"),
}


def verdicts(lemma):
    paper = Paper("lemmas", "none")
    paper.lemma("1", "A conclusion", "", lemma)
    *hypotheses, conclusion = paper.claims
    assert conclusion.axiom == lemma.source
    assert conclusion.printed == lemma.conclusion
    assert set(conclusion.premises) == {claim.id for claim in hypotheses}
    assert all(claim.origin == "implied" for claim in hypotheses)
    return {claim.id.partition("1.")[2]: decide(claim).verdict for claim in hypotheses}


@pytest.mark.parametrize("name", CASES)
def test_every_hypothesis_is_decided_as_theory_has_it(name):
    holds, fails, failing = CASES[name]
    assert set(verdicts(holds()).values()) == {"proved"}
    found = verdicts(fails())
    assert found[failing] in ("refuted", "gap")


def test_every_builder_has_its_case_and_says_whose_it_is():
    builders = [name for name in lemmas.__all__ if name.islower()]
    assert len(builders) == len(CASES) == len({holds().source for holds, _, _ in CASES.values()})


@pytest.mark.parametrize(("wrong", "words"), [
    (lambda: lemmas.comparison(y, TWO, sp.Integer(0), FALLS), "no symbol that the flow moves"),
    (lambda: lemmas.comparison(x**2, p, sp.Integer(0), ADAPTS), "p moves: give a bound"),
    (lambda: lemmas.ultimate_bound(x**2, TWO, d**2, {x: -x + d}, (), (d,)), "d moves: give a bound"),
    (lambda: lemmas.lasalle_yoshizawa(ENERGY, (x,), HALF, HALF, x**2 + p**2, ADAPTS), "the flow moves p too"),
    (lambda: lemmas.lasalle_yoshizawa(ENERGY, (x, p), HALF, HALF, t * x**2, ADAPTS | {t: 1}), "t moves: give a bound"),
    (lambda: Paper("a", "b").lemma("1", "A line", "", lemmas.nagumo(x, FALLS), recorded={"rate": "gap"}),
     "no hypothesis 'rate': choose of border"),
])
def test_what_a_lemma_does_not_speak_of_is_told(wrong, words):
    with pytest.raises(ClaimError, match=words):
        wrong()


# --- false conclusions, each of a system that breaks what the theorem asks ---

p_declared, d_declared = sp.Symbol("p", positive=True), sp.Symbol("d", positive=True)
y_declared, t_declared = sp.Symbol("y", nonnegative=True), sp.Symbol("t", nonnegative=True)
FALLING = {p_declared: sp.Integer(-1)}  # p(0) > 0 or not, p is negative in the end
DELAYED = {x: y}
ROOT = sp.sqrt(sp.Abs(x))
QUADRATIC = (HALF, HALF)


def yoshizawa(W, flow, assume=(), inputs=()):
    state = tuple(one for one in flow if one != t)
    return lemmas.lasalle_yoshizawa(sum(one**2 for one in state) / 2, state, *QUADRATIC, W, flow, assume, inputs)


def hale(V, past, flow, assume=()):
    return lemmas.razumikhin(V, past, *QUADRATIC, TWO, HALF, flow, assume)


FALSE = [
    # p > 0 "for ever" of p' = -1: a sign that is declared of a state is one of its start.
    (lambda: lemmas.darboux(p_declared, -1 / p_declared, FALLING), "p moves and is declared positive"),
    (lambda: lemmas.nagumo(x, FALLING | {x: p_declared + 1}), "p moves and is declared positive"),
    (lambda: lemmas.comparison(x**2, TWO, sp.Integer(0), FALLING | {x: -x * (1 + p_declared)}), "declared positive"),
    (lambda: lemmas.ultimate_bound(p_declared, HALF, sp.Integer(0), FALLING), "declared positive"),
    (lambda: lemmas.finite_time(x**2, TWO, HALF, FALLING | {x: -p_declared * x}), "declared positive"),
    (lambda: lemmas.input_to_state(x**2, (x,), HALF, TWO, TWO, TWO, (d,), FALLING | {x: -x * (1 + p_declared)}),
     "declared positive"),
    (lambda: lemmas.barbalat(p_declared, sp.Integer(1) + 0 * x, level, sp.Integer(0), FALLING), "declared positive"),
    (lambda: yoshizawa(p_declared, FALLING), "declared positive"),
    (lambda: hale(p_declared**2, {p_declared: y}, FALLING), "declared positive"),
    # The same, assumed: of inputs and constants alone may something be known at all times.
    (lambda: lemmas.darboux(p, -1 / p, {p: -1}, (greater(p, 0),)), "p is of the state"),
    (lambda: lemmas.nagumo(p, {p: -1}, (greater(p + d, 0),), (d,)), "p is of the state"),
    (lambda: hale(x**2 / 2, DELAYED, {x: x}, (equal(x, 0),)), "x is of the state"),
    # An assumption of a rate is what was to be shown.
    (lambda: lemmas.comparison(x**2, TWO, sp.Integer(0), {x: x}, (at_most(D(x**2), -2 * x**2),)), "is of a rate"),
    # Delayed values: their signs, one for two states, the state itself, one that moves, in V, in what is assumed.
    (lambda: hale(x**2 / 2, {x: y_declared}, {x: -x - y_declared}), "has a sign that is not known"),
    (lambda: hale((x**2 + p**2) / 2, {x: y, p: y}, {x: -x + y, p: -p}), "one delayed value"),
    (lambda: hale(x**2 / 2, {x: x}, {x: -2 * x}), "x has a rate of its own"),
    (lambda: hale((x**2 + y**2) / 2, {x: y, y: z}, {x: -x + y, y: -y + z}), "y has a rate of its own"),
    (lambda: hale(x**2 / 2 + y**2, DELAYED, {x: -2 * x}), "y moves: give a bound"),
    (lambda: hale(x**2 / 2, DELAYED, {x: x + y}, (at_most(y, -2 * x),)), "is of the state"),
    # The rest of the state may escape, or the state be another.
    (lambda: hale(x**2 / 2, DELAYED, {x: -2 * x + y, p: p**2}), "the flow moves p too"),
    (lambda: lemmas.lasalle_yoshizawa(x**2 / 2, (x,), *QUADRATIC, x**2, {x: -x, p: p**2}), "the flow moves p too"),
    (lambda: lemmas.lasalle_yoshizawa((x - p)**2 / 2, (x - p, x, p), *QUADRATIC, x**2, ADAPTS), "is no symbol of the"),
    # The time makes rates as large as it likes, as does an input without a bound: W need not vanish.
    (lambda: yoshizawa(x**2, {x: -x + t * p, p: -t * x, t: 1}), "changes with the time t"),
    (lambda: yoshizawa(x**2, {x: -x + p / (2 - sp.sin(t)), p: -x / (2 - sp.sin(t)), t: 1}), "changes with the time t"),
    (lambda: hale(x**2 / 2, DELAYED, {x: -2 * x + sp.exp(t) * (y - x), t: 1}), "changes with the time t"),
    (lambda: hale(x**2 / 2 + t * x**2, DELAYED, {x: -2 * x + y, t: 1}), "t moves: give a bound"),
    (lambda: yoshizawa(x**2, {x: -x + d * p, p: -d * x}, (), (d,)), "no bound of the input d"),
    (lambda: yoshizawa(x**2, {x: -x + d * p, p: -d * x}, (at_least(d**2, 1),), (d,)), "no bound of the input d"),
    (lambda: yoshizawa(x**2, {x: -x + d * p, p: -d * x}, (at_most(d**2, z**2),), (d, z)), "no bound of the input d"),
    # d turns (0, 1) by a right angle and back in a time that falls like 1/sqrt(t), again and again: x does not vanish.
    (lambda: yoshizawa(x**2, {x: -x + d * p, p: -d * x, t: 1}, (at_most(d**2, t),), (d,)), "no bound of the input d"),
    (lambda: yoshizawa(x**2, {x: -x + d * p, p: -d * x}, (at_most(d**2, t),), (d,)), "no bound of the input d"),
    (lambda: yoshizawa(x**2, {x: -x + d * p, p: -d * x}, (differ(p, 0), at_most(d**2, 1 / p**2)), (d,)),
     "no bound of the input d"),
    # What an input comes as close to as it likes: h' = -h/d with d = 1 - t; x' = d - sqrt(abs(x)) with x = -t**2/16.
    (lambda: lemmas.darboux(x, -1 / d_declared, {x: -x / d_declared}, (), (d_declared,)), "the input d is declared"),
    (lambda: lemmas.darboux(x, -1 / d, {x: -x / d}, (greater(d, 0),), (d,)), "lets the input d come as close"),
    (lambda: lemmas.darboux(x, -1 / d, {x: -x / d}, (differ(d, 0),), (d,)), "lets the input d come as close"),
    (lambda: lemmas.nagumo(x, {x: d - ROOT}, (greater(d, 0),), (d,)), "lets the input d come as close"),
    (lambda: yoshizawa(x**2, {x: -x / d}, (less(d, 1), greater(d, 0), at_most(d**2, 1)), (d,)), "as close to the"),
    # Rates that jump: x' = 1 at x = 0 alone is never met; an equality may hold on the surface of a jump alone.
    (lambda: lemmas.nagumo(x, {x: 1 - 2 * sp.Abs(sp.sign(x))}), "jumps with sign"),
    (lambda: lemmas.darboux(x, y, {x: x * y, y: -sp.sign(y)}), "jumps with sign"),
    (lambda: lemmas.darboux(x, sp.sign(y), {x: x * sp.sign(p), y: -y, p: -p}), "jumps with sign"),
    (lambda: yoshizawa(x**2, {x: -sp.sign(x)}), "jumps with sign"),
    (lambda: yoshizawa(x**2 * sp.sign(x)**2, {x: -x}), "sign.x. jumps"),
    (lambda: hale(x**2 / 2, DELAYED, {x: -x - sp.sign(y)}), "jumps with sign"),
    (lambda: lemmas.input_to_state(x**2, (x,), HALF, TWO, TWO, TWO, (d,), {x: -x - sp.sign(x - d)}), "jumps with"),
    (lambda: lemmas.comparison(p**2, TWO, sp.Integer(0), {x: -2 * sp.sign(x), p: -p + 2 * p * sp.sign(x)**2},
                               (equal(x, 0),)), "the surface of the jump alone"),
    # A cofactor, or W, that is the quotient of a rate is shown of whatever has one.
    (lambda: lemmas.darboux(p, D(p) / p, {p: -1}), "is given by a rate"),
    (lambda: yoshizawa(-D(x) * x, {x: -x}), "is given by a rate"),
    # The level is V(0), which no parameter of the system is.
    (lambda: lemmas.barbalat(ENERGY, x**2, p, sp.Integer(1), ADAPTS), "moves: give a bound|symbol of its own"),
    (lambda: lemmas.barbalat(x**2, level * x**2, level, level**2, {x: -level * x}), "use a symbol of its own"),
    (lambda: lemmas.barbalat(x**2, x**2, level, TWO, {x: -x}, (at_most(level, 1),)), "use a symbol of its own"),
    (lambda: lemmas.barbalat(x**2, x**2, sp.Integer(1), TWO, {x: -x}), "is a symbol of its own"),
    # One name for two symbols: what is known of the one would be said of the other.
    (lambda: lemmas.comparison(x**2, sp.Symbol("x", positive=True), sp.Integer(0), {x: -x}), "are named 'x'"),
    (lambda: lemmas.darboux(x, sp.Symbol("x", positive=True), {x: x**2}), "are named 'x'"),
]


@pytest.mark.parametrize("place", range(len(FALSE)))
def test_what_the_theorem_does_not_allow_is_refused_by_name(place):
    wrong, words = FALSE[place]
    with pytest.raises(ClaimError, match=words):
        wrong()


# Hypotheses that are not proved, and that nothing but they keep from a false conclusion.
@pytest.mark.parametrize(("wrong", "failing"), [
    # h'/h for the cofactor is shown of every h that has a rate; it is not defined where h is zero.
    (lambda: lemmas.darboux(p, -1 / p, {p: -1}), "continuous"),
    (lambda: lemmas.darboux(x, sp.log(x**2), {x: x * sp.log(x**2)}), "continuous"),
    (lambda: lemmas.darboux(x, 1 / d, {x: x / d}, (at_least(d, 0),), (d,)), "continuous"),
    # x = 0 is not kept where rates are a root: x = t**2/4 leaves it.
    (lambda: lemmas.darboux(x, 1 / ROOT, {x: x / ROOT}), "continuous"),
    # W has a jump at the origin; with p' = -p the rate of x is steeper and steeper.
    (lambda: yoshizawa(2 * x**2 * sp.exp(-sp.sin(sp.log(p))**2 / p),
                       {x: -x * sp.exp(-sp.sin(sp.log(p))**2 / p), p: -p}, (greater(p, 0),)), "continuous"),
    (lambda: yoshizawa(x**2, {x: -x * (1 + 1 / p**2), p: -p}, (greater(p, 0),)), "lipschitz"),
    (lambda: yoshizawa(x**2, {x: -x - ROOT * x}), "lipschitz"),
    (lambda: hale(x**2 / 2, DELAYED, {x: -2 * x + y / x}), "continuous"),
    # A premise that no state meets proves nothing, nor one that only a declared sign keeps from being met.
    (lambda: lemmas.nagumo(1 + x**2, {x: -x}), "border"),
    (lambda: lemmas.nagumo(x, {x: p + 1, p: -1}), "border"),
    (lambda: lemmas.nagumo(-x**2, {x: d}, (at_most(d**2, 1),), (d,)), "border"),
    (lambda: lemmas.nagumo(x, {x: sp.Abs(x)}), "border"),
    (lambda: lemmas.nagumo(x, {x: 1 + d}, (at_most(d, 1), at_least(d, 2)), (d,)), "border"),
])
def test_a_hypothesis_stands_between_a_system_and_a_false_conclusion(wrong, failing):
    assert verdicts(wrong())[failing] != "proved"


def test_what_is_defined_everywhere_is_asked_and_shown():
    lemma = lemmas.darboux(x, 1 / (1 + x**2), {x: x / (1 + x**2)})
    assert verdicts(lemma) == {"rate": "proved", "continuous": "proved"}
    lemma = yoshizawa(x**2 / (1 + x**2), {x: -x / (1 + x**2) + d * p, p: -d * x}, (at_most(d**2, 1),), (d,))
    assert set(verdicts(lemma).values()) == {"proved"}
    assert {one.name for one in lemma.hypotheses} >= {"continuous", "lipschitz"}


def test_whole_numbers_and_fractions_may_be_given_as_such():
    given = [lemmas.comparison(x**2, 2, 0, FALLS), lemmas.ultimate_bound(x**2, Fraction(3, 2), 1, FALLS),
             lemmas.finite_time(v, 1, Fraction(1, 2), {v: -2 * sp.sqrt(v)}, (at_least(v, 0),)),
             lemmas.input_to_state(x**2, (x,), 1, 1, 1, 1, (d,), {x: -x + d}), lemmas.darboux(x, 1, {x: x})]
    assert {verdict for lemma in given for verdict in verdicts(lemma).values()} == {"proved"}


def test_the_time_may_be_nonnegative_and_a_constant_positive():
    k = sp.Symbol("k", positive=True)
    assert verdicts(lemmas.nagumo(k - x, {x: -1 - t_declared, t_declared: 1})) == {"border": "proved"}
    assert verdicts(lemmas.darboux(x, k, {x: k * x, p_declared: 0})) == {"rate": "proved"}


def test_what_is_assumed_at_all_times_is_said_of_the_conclusion():
    paper = Paper("lemmas", "none")
    paper.lemma("1", "A line", "", lemmas.comparison(x, TWO, sp.Integer(0), {x: -3 * x}, (at_least(x, 0),)))
    assert "At all times x >= 0 is taken to hold." in paper.claims[-1].note
    assert "At all times" not in lemmas.comparison(x**2, TWO, sp.Integer(0), FALLS).taken
