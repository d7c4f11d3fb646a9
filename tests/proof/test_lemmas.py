"""Named lemmas: of systems that a lemma is of, every hypothesis is proved; of one that breaks a hypothesis it is that
one which fails."""

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof import lemmas
from workbench.proof.claim import at_most
from workbench.proof.decide.engine import decide
from workbench.proof.paper import Paper

x, y, p, d = sp.symbols("x y p d", real=True)
level, v = sp.symbols("V_0 v", nonnegative=True)
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
    "finite time": (lambda: lemmas.finite_time(v, sp.Integer(1), HALF, {v: -2 * sp.sqrt(v)}),
                    lambda: lemmas.finite_time(v, sp.Integer(1), TWO, {v: -2 * v**2}), "power.below"),
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
    (lambda: lemmas.lasalle_yoshizawa(ENERGY, (x,), HALF, HALF, x**2 + p**2, ADAPTS), "p moves: give a bound"),
    (lambda: Paper("a", "b").lemma("1", "A line", "", lemmas.nagumo(x, FALLS), recorded={"rate": "gap"}),
     "no hypothesis 'rate': choose of border"),
])
def test_what_a_lemma_does_not_speak_of_is_told(wrong, words):
    with pytest.raises(ClaimError, match=words):
        wrong()
