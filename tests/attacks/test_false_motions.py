"""No motion that breaks what always holds refutes anything; no theorem is composed of motions that exclude another."""

import copy

import pytest
import sympy as sp

from workbench.proof.checker import CertificateError, check, goal_digest
from workbench.proof.claim import Goal, at_least, at_most, equal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.text import goal_text

x, y, a = sp.symbols("x y a", real=True)
CONSTANT, LINE = {"flow": {x: a}}, {"flow": {x: y, y: -y}}
# True of every motion that keeps what always holds for ever, though false at a point where it holds.
TRUE = {
    "leaves at once": (Goal((at_least(a, 0),), **CONSTANT, initial={x: sp.S.Zero}, always=(at_least(x, 0),)), -1, 0),
    "leaves later": (Goal((at_least(a, 0),), **CONSTANT, initial={x: sp.S.One}, always=(at_least(x, 0),)), -1, 1),
    "from anywhere": (Goal((at_most(a, 0),), **CONSTANT, always=(at_most(x, 5),)), 1, 0),
    "what is bounded stands still": (Goal((equal(a, 0),), **CONSTANT, always=(at_most(x**2, 1),)), 1, 0),
    "at rest for ever": (Goal((equal(y, 0),), **LINE, always=(equal(x, 0),)), 0, 0),
    "started at rest": (Goal((equal(y, 0),), **LINE, initial={x: sp.S.Zero, y: a}, always=(equal(x, 0),)), 1, 0),
}
FALSE = {
    "what stays": Goal((at_least(a, 0),), **CONSTANT, always=(at_most(x, 5),)),
    "what decays": Goal((at_most(x, 1),), flow={x: -x}, always=(at_least(x, 0),)),
    "what rests": Goal((at_least(x**2, 1),), flow={x: x - x**3}, always=(at_most(x, 7),)),
}


@pytest.mark.parametrize("name", TRUE)
def test_what_no_lasting_motion_breaks_is_not_refuted(name):
    goal, *values = TRUE[name]
    point = {"a": str(values[0]), "x": str(values[1]), "y": "1"}
    with pytest.raises(CertificateError, match="no path says"):
        check({"version": 1, "verdict": "refuted", "goal": goal_text(goal), "point": point})
    assert find_counterexample(goal, "refuted", quick=True) is None


@pytest.mark.parametrize("name", FALSE)
def test_what_a_lasting_motion_breaks_is_refuted(name):
    check(found := find_counterexample(FALSE[name], "refuted", quick=True))
    assert found["path"]


def bound(certificate):
    return certificate | {"version": 2, "goal_digest": goal_digest(certificate)}


def sum_of(*factors):
    return {"rule": "combination", "terms": [{"coefficient": "1", "factors": list(each)} for each in factors]}


RISES = bound({"claim": "doe2026:1", "verdict": "proved", "example": {"x": "0"}, "goal": {
    "assume": [], "show": ["x >= 0"], "flow": {"x": "1"}, "initial": {"x": "0"}}, "proofs": [{
        "rule": "nonincreasing", "function": "-x", "decrease": sum_of([]), "then": sum_of([{"assume": 0}])}]})


def composed(**moves):
    """x + 1 >= 0 by x >= 0, which is shown of x' = 1 from 0."""
    goal = {"assume": ["x >= 0"], "show": ["x + 1 >= 0"], **moves}
    return bound({"claim": "doe2026:2", "verdict": "proved", "goal": goal, "example": {"x": "5", "y": "0"},
                  "proofs": [sum_of([{"assume": 0}], [])], "premises": {"1": RISES["goal_digest"]}, "composition": {
                      "certificates": {"1": RISES}, "cited": {}, "assumes": {"1": [], "2": []},
                      "links": [{"of": "2", "assume": 0, "by": "1", "show": 0}]}})


@pytest.mark.parametrize("moves", [{}, {"flow": {"x": "1"}}, {"flow": {"y": "-x", "x": "1"}, "initial": {"y": "0"}},
                                   {"inputs": ["x"]}], ids=str)
def test_what_moves_alike_is_composed(moves):
    check(composed(**moves))


@pytest.mark.parametrize("moves", [
    {"flow": {"x": "-1"}}, {"flow": {"x": "1"}, "initial": {"x": "5"}}, {"flow": {"x": "0"}}, {"flow": {"y": "-x"}},
    {"inputs": ["y"]}, {"flow": {"x": "1 + y"}}], ids=str)
def test_what_moves_otherwise_is_not(moves):
    with pytest.raises(CertificateError, match="linked certificates"):
        check(composed(**moves))


def test_what_moves_otherwise_far_below_is_found():
    """The theorem rests on a line of one instant, which rests on the motion."""
    middle = composed()
    del middle["composition"]
    parts = {"1": RISES, "2": middle}
    top = {"claim": "doe2026:3", "verdict": "proved", "example": {"x": "5"}, "goal": {
        "assume": ["x + 1 >= 0"], "show": ["x + 2 >= 0"]}, "proofs": [sum_of([{"assume": 0}], [])],
        "premises": {"2": middle["goal_digest"]}, "composition": {
            "certificates": parts, "cited": {}, "assumes": {"1": [], "2": [], "3": []}, "links": [
                {"of": "2", "assume": 0, "by": "1", "show": 0}, {"of": "3", "assume": 0, "by": "2", "show": 0}]}}
    check(bound(top))
    otherwise = copy.deepcopy(top)
    otherwise["goal"]["flow"] = {"x": "-1"}
    with pytest.raises(CertificateError, match="different rates"):
        check(bound(otherwise))
