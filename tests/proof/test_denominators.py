"""Denominators whose sign the checker does not see without a lemma: inertias that depend on an angle, lengths."""

import pytest
import sympy as sp

from workbench.proof.checker import check
from workbench.proof.claim import Claim, D, Goal, at_least, at_most, equal, greater
from workbench.proof.decide import engine
from workbench.proof.decide.engine import prove_goal

q, v, x, u = sp.symbols("q v x u", real=True)
a, b, g = sp.symbols("a b g", positive=True)
inertia = a + b * sp.cos(q)
arm = {q: v, v: (u - g * sp.sin(q) + b * sp.sin(q) * v**2 / 2) / inertia}
two = {q: v, v: (u + sp.sin(q) * v**2 / 2) / (2 + sp.cos(q))}
d_1, d_2, x_1, x_2 = sp.symbols("d_1 d_2 x_1 x_2", real=True)
k, L, V = sp.symbols("k L V", positive=True)
length, apart = sp.sqrt(x_1**2 + x_2**2), greater(x_1**2 + x_2**2, 0)
unit_vector = {x_1: d_1 - k * x_1 / length, x_2: d_2 - k * x_2 / length}

TRUE = {
    "passivity of an arm": Goal((equal(D(inertia * v**2 / 2 - g * sp.cos(q)), u * v),), (greater(a, b),), arm,
                                inputs=(u,)),
    "an inertia of numbers": Goal((equal(D((2 + sp.cos(q)) * v**2 / 2), u * v),), flow=two, inputs=(u,)),
    "a polynomial inertia": Goal((equal(D(x**2), -2 * x**2 / (q**2 - q + 1)),), flow={x: -x / (q**2 - q + 1), q: v}),
    "a positive fraction": Goal((greater(1 / (2 + sp.cos(q)), 0),)),
    "at most": Goal((at_most(x**2 / (2 + sp.cos(q)), x**2),)),
    "at least": Goal((at_least(x**2 / (2 + sp.cos(q)), x**2 / 3),)),
    "unit vector control": Goal((at_most(D((x_1**2 + x_2**2) / 2), -(k - L) * length),),
                                (at_most(d_1**2 + d_2**2, L**2), apart), unit_vector, inputs=(d_1, d_2)),
    "a unit vector": Goal((equal(x_1**2 / length + x_2**2 / length, length),), (apart,)),
    "a size by V": Goal((at_most(sp.Abs(x), sp.sqrt(2 * V)),), (at_most(x**2 / 2, V),)),
    "a rate at most": Goal((at_most(D(v**2 / 2), -g * v**2 / 3),), flow={v: -g * v / (2 + sp.sin(q)), q: v}),
}
UNPROVED = {
    "an inertia that may vanish": Goal((equal(D(inertia * v**2 / 2 - g * sp.cos(q)), u * v),), (), arm, inputs=(u,)),
    "another sign": Goal((equal(D((2 + sp.cos(q)) * v**2 / 2), -u * v),), flow=two, inputs=(u,)),
    "too much": Goal((at_least(x**2 / (2 + sp.cos(q)), x**2 / 2),)),
    "too much of a length": Goal((at_most(x_1 * x_2 / length, length / 3),), (apart,)),
    "a length that may vanish": Goal((equal(x_1**2 / length + x_2**2 / length, length),)),
    "a size by too little": Goal((at_most(sp.Abs(x), sp.sqrt(V)),), (at_most(x**2 / 2, V),)),
    "no sign": Goal((greater(1 / (1 + 2 * sp.cos(q)), 0),)),
}


@pytest.mark.parametrize("goal", TRUE.values(), ids=TRUE)
def test_what_divides_by_a_positive_inertia_is_proved(goal):
    certificate = prove_goal(goal)
    assert certificate is not None
    check(certificate)


@pytest.mark.parametrize("goal", UNPROVED.values(), ids=UNPROVED)
def test_what_is_false_or_divides_by_zero_is_not(goal):
    assert prove_goal(goal) is None


@pytest.mark.parametrize(("goal", "said"), [
    (lambda: Goal((at_most(sp.log(k**2 / (k**2 - x**2)), x**2 / (k**2 - x**2)),), (at_most(sp.Abs(x), k),)),
     "there not k**2 - x**2 != 0"),
    (lambda: Goal((at_most(sp.sqrt(x), 1 + x**2),)), "there not x >= 0"),
], ids=["a barrier on its wall", "a root of any number"])
def test_what_is_undefined_where_all_assumed_holds_is_said_and_no_proof_sought(goal, said, monkeypatch):
    monkeypatch.setattr(engine, "attempted_proof", lambda goal: pytest.fail("in vain"))
    found = engine.decide(Claim(id="doe2026:1", title="bound", kind="inequality", printed="x", recorded="proved",
                                build=goal))
    assert found.verdict == "undecided"
    assert said in found.method
