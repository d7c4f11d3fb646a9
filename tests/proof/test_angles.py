"""Sines and cosines in goals: what books state of them is proved, what is proved holds at random points."""

import pytest
import sympy as sp
from independent import Evaluated

from workbench.proof.claim import Claim, D, Goal, at_least, at_most, equal, greater, less
from workbench.proof.decide.engine import decide
from workbench.proof.typed import kept_as_typed

x, y, w = sp.symbols("x y w", real=True)
q = sp.Symbol("q", nonnegative=True)
m, g, r, d, k = sp.symbols("m g r d k", positive=True)
s, c = sp.sin, sp.cos
ENERGY = m*r**2*w**2/2 + m*g*r*(1 - c(x))
PENDULUM = {x: w, w: -g/r*s(x) - d*w}

TRUE = {
    "circle": lambda: Goal((equal(s(x)**2 + c(x)**2, 1),)),
    "bounded": lambda: Goal((at_most(s(x), 1), at_least(c(x), -1), at_most(sp.Abs(s(x)), 1))),
    "parabola": lambda: Goal((at_most(1 - c(x), x**2/2),)),
    "below its angle": lambda: Goal((at_most(s(q), q),)),
    "square below that of its angle": lambda: Goal((at_most(s(x)**2, x**2),)),
    "twice an angle": lambda: Goal((equal(s(2*x), 2*s(x)*c(x)), equal(c(2*x), 1 - 2*s(x)**2))),
    "sum": lambda: Goal((equal(s(x + y), s(x)*c(y) + c(x)*s(y)), equal(c(x - y), c(x)*c(y) + s(x)*s(y)))),
    "energy of a pendulum": lambda: Goal((equal(D(ENERGY), -d*m*r**2*w**2), at_most(D(ENERGY), 0)), flow=PENDULUM),
    "energy is not negative": lambda: Goal((at_least(ENERGY, 0),)),
    "gravity compensated": lambda: Goal((equal(D(w**2/2 + k*x**2/2), -d*w**2),),
                                        flow={x: w, w: -g/r*s(x) + (g/r*s(x) - k*x - d*w)}),
    "series of the sine": lambda: Goal((at_least(s(q), q - q**3/6), at_most(s(q), q - q**3/6 + q**5/120))),
    "sum in exp": lambda: Goal((equal(sp.exp(x + y), sp.exp(x)*sp.exp(y)), equal(sp.exp(x - y)*sp.exp(y), sp.exp(x)))),
    "product in log": lambda: Goal((equal(sp.log(m*g), sp.log(m) + sp.log(g)), equal(sp.log(m**2), 2*sp.log(m)))),
}
FALSE = {
    "energy that grows": lambda: Goal((less(D(ENERGY), 0),), flow=PENDULUM),
    "energy that vanishes at rest alone": lambda: Goal((greater(ENERGY, 0),)),
    "gravity compensated with the wrong sign": lambda: Goal(
        (at_most(D(w**2/2 + k*x**2/2), 0),), flow={x: w, w: -g/r*s(x) + (-g/r*s(x) - k*x - d*w)}),
}


def decided(goal):
    return decide(Claim(id="angles2020:1", title="t", kind="inequality", printed="x", recorded="proved",
                        build=kept_as_typed(goal)))


@pytest.mark.parametrize("name", TRUE)
def test_it_is_proved_and_holds_at_random_points(name):
    assert decided(TRUE[name]).verdict == "proved"
    assert Evaluated(TRUE[name]()).falsifying_point(3, batches=1, count=2_000) is None


@pytest.mark.parametrize("name", FALSE)
def test_it_is_refuted(name):
    assert decided(FALSE[name]).verdict == "refuted"
