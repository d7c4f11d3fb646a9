"""Inputs with an index, and initial values that are sums: decided rightly, with examples that are instants."""

import pytest
import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Claim, D, Goal, at_least, at_most, equal
from workbench.proof.decide.engine import decide

x, V = sp.symbols("x V", real=True)
k = sp.Symbol("k", positive=True)
j, n = sp.Symbol("j", integer=True), sp.Symbol("n", integer=True, positive=True)
W, U = sp.IndexedBase("W", real=True), sp.IndexedBase("U", real=True)


def total(term):
    return sp.Sum(term, (j, 1, n))


DRIVEN = {"flow": {W[j]: -W[j] + U[j]}, "inputs": (U[j],)}
DECAY = {"flow": {V: -k * V}, "initial": {V: total(W[j]**2)}, "always": (at_least(V, 0),), "decreasing": V}


@pytest.mark.parametrize(("goal", "verdict"), [
    (lambda: Goal((at_most(D(total(W[j]**2)), total(U[j]**2)),), **DRIVEN), "proved"),
    (lambda: Goal((at_most(D(total(W[j]**2)), 0),), **DRIVEN), "refuted"),
    (lambda: Goal((at_most(V, total(W[j]**2)),), **DECAY), "proved"),
    (lambda: Goal((at_most(V, total(W[j]**2)),), (at_least(total(W[j]**2), 1),), **DECAY), "proved"),
    (lambda: Goal((at_most(V, 0),), **DECAY), "refuted"),
    (lambda: Goal((equal(V, x),), (equal(total(W[j]), 0), at_least(total(W[j]**2), 1), equal(x, 0)),
                  flow={V: sp.Integer(0)}, initial={V: total(W[j]**2)}), "refuted"),
])
def test_it_is_decided_rightly(goal, verdict):
    found = decide(Claim(id="doe2026:1", title="t", kind="inequality", printed="x", recorded="proved", build=goal))
    assert found.verdict == verdict
    check(found.certificate)


def test_a_rate_of_an_indexed_input_is_not_known():
    with pytest.raises(ClaimError, match="needs the rate of the input"):
        Goal((at_most(D(total(U[j]**2)), 0),), **DRIVEN)
    with pytest.raises(ClaimError, match="has a rate and is an input"):
        Goal((at_most(D(total(W[j]**2)), 0),), flow={W[j]: -W[j]}, inputs=(W[j],))


GOAL = {"assume": [], "show": ["V <= 0"], "indexed": ["W"], "flow": {"V": "-V"}, "initial": {"V": "Sum(W**2)"}}


@pytest.mark.parametrize(("point", "terms", "sound"), [
    ({"V": "9", "W": "3"}, None, True), ({"V": "8", "W": "3"}, None, False),
    ({"V": "5"}, [{"W": "1"}, {"W": "2"}], True), ({"V": "9"}, [{"W": "1"}, {"W": "2"}], False),
    ({"V": "1"}, [], False)])
def test_a_point_is_time_zero_or_nothing_says_that_it_is_reached(point, terms, sound):
    made = {"claim": "doe2026:1", "version": 1, "verdict": "refuted", "goal": GOAL, "point": point}
    if terms is not None:
        made["terms"] = terms
    if sound:
        check(made)
    else:
        with pytest.raises(CertificateError, match="is not where it starts"):
            check(made)


def test_the_rule_for_initial_values_forgets_what_an_indexed_input_was():
    """Assumed of the last instant alone: x may have grown before, while U was large."""
    goal = {"assume": ["Sum(U**2) <= 0"], "show": ["x <= 0"], "indexed": ["U"], "inputs": ["U"],
            "flow": {"x": "Sum(U**2)"}, "initial": {"x": "0"}}
    decrease = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 0}]}]}
    proof = {"rule": "nonincreasing", "function": "x", "decrease": decrease,
             "then": {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 1}]}]}}
    with pytest.raises(CertificateError):
        check({"claim": "doe2026:1", "version": 1, "verdict": "proved", "goal": goal, "example": {"x": "0", "U": "0"},
               "proofs": [proof]})
