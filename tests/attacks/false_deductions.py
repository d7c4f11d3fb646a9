"""False statements near to what is proved in several steps: lemmas first, minors, tangents, two sides, cut motions.

Each is false at the values that are named beside it, or undefined somewhere.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, differ, equal, greater, less

x, y, z, a, b, r, u = sp.symbols("x y z a b r u", real=True)
p, q, k = sp.symbols("p q k", positive=True)
t = sp.Symbol("t", nonnegative=True)
e, ln, sq = sp.exp, sp.log, sp.sqrt
R = sp.Rational
j, n = sp.Symbol("j", integer=True), sp.Symbol("n", integer=True, positive=True)
v, w = (sp.IndexedBase(name, real=True)[j] for name in ("v", "w"))
FORM = a*x**2 + 2*r*x*y + b*y**2
ORDER = (at_least(x, 0), at_most(x, y))


def total(term: sp.Expr) -> sp.Expr:
    """The sum of a term over the index."""
    return sp.Sum(term, (j, 1, n))


FALSE: dict[str, Callable[[], Goal]] = {
    # a sign has to be shown first, and it is another, or none
    "a fraction that falls": lambda: Goal((at_least(x/(1 + x), y/(1 + y)),), ORDER),
    "a fraction without its sign": lambda: Goal((at_most(x/(1 + x), y/(1 + y)),), (at_most(x, y),)),
    "beyond the pole": lambda: Goal((at_most(x/(1 - x), y/(1 - y)),), ORDER),
    "a fraction, strictly": lambda: Goal((less(x/(1 + x), y/(1 + y)),), ORDER),
    "a root that falls": lambda: Goal((at_least(sq(1 + x), sq(1 + y)),), ORDER),
    "a logarithm that falls": lambda: Goal((at_least(ln(1 + x), ln(1 + y)),), ORDER),
    "a reciprocal over the sign": lambda: Goal((at_most(1/y, 1/x),), (at_most(x, y), differ(x, 0), differ(y, 0))),
    "a power's domain": lambda: Goal((equal(y**(x/x), y),)),
    "a power's domain, added": lambda: Goal((equal(y**(1 + (x - x)/x), y),)),
    "a power that is none": lambda: Goal((equal((x/x)**0, 1),)),
    "nothing times what is undefined": lambda: Goal((equal(0*ln(x), 0),)),
    "a fraction raised to nothing": lambda: Goal((equal((1/x)**0 + y, 1 + y),)),
    "the larger of what is undefined": lambda: Goal((at_least(sp.Max(1/x, 1), 1),)),
    "a half power": lambda: Goal((equal(x**R(3, 2)*x**R(1, 2), x**2),)),
    "a half power of a square": lambda: Goal((equal((x**2)**R(3, 2), x**3),)),
    "a negative half power": lambda: Goal((greater(x**R(-1, 2), 0),), (at_least(x, 0),)),
    "a root below a fraction bar": lambda: Goal((at_most(1/sq(1 + x**2), R(9, 10)),)),
    "a root of what may be negative": lambda: Goal((at_most(1/sq(1 + x**3), 1),)),
    "an exponential's half": lambda: Goal((equal(sq(e(2*x)), e(-x)),)),
    # quadratic forms: x = 1, y = -1 or a = b = 1, r = 2, or on the edge
    "minors of another sign": lambda: Goal((at_least(FORM, 0),), (at_least(a*b, r**2),)),
    "one minor alone": lambda: Goal((at_least(FORM, 0),), (greater(a, 0), greater(b, 0))),
    "the determinant turned": lambda: Goal((at_least(FORM, 0),), (greater(a, 0), at_most(a*b, r**2))),
    "definite at nothing": lambda: Goal((greater(FORM, 0),), (greater(a, 0), greater(a*b, r**2))),
    "a form above its trace": lambda: Goal((at_least(FORM, (a + b)*(x**2 + y**2)),), (
        greater(a, 0), greater(b, 0), greater(a*b, r**2))),
    "a form above its smaller entry": lambda: Goal((at_least(FORM, a*x**2),), (greater(a, 0), greater(a*b, r**2))),
    "three by three from two minors": lambda: Goal((at_least(x**2 + y**2 + z**2 + 2*r*(x*y + y*z + x*z), 0),), (
        at_most(r**2, 1),)),
    "a form with a parameter": lambda: Goal((at_least(k*x**2 + 2*p*x*y + k*y**2, 0),), (at_most(p, 2*k),)),
    "a Schur complement, turned": lambda: Goal((at_least(a - r**2/b, b),), (greater(a, 0), greater(a*b, r**2),
                                                                          greater(b, 0))),
    # two sides, and squares that are none
    "a square that is one": lambda: Goal((equal(x, y),), (at_most((x - y)**2, r**2),)),
    "two inequalities of one side": lambda: Goal((equal(x, y),), (at_most(x, y), at_most(x, y + 1))),
    "an equality of squares": lambda: Goal((equal(x, y),), (equal(x**2, y**2),)),
    "an equality of products": lambda: Goal((equal(x, y),), (equal(a*x, a*y),)),
    "an equality of sizes": lambda: Goal((equal(sp.Abs(x*y), x*sp.Abs(y)),), (at_least(y, 0),)),
    "a product that is none": lambda: Goal((equal(x, 0),), (equal(x*y, 0),)),
    "a sum of squares of one": lambda: Goal((equal(x, 0),), (equal(x**2 + y**2, r**2),)),
    "a sum that is none": lambda: Goal((equal(x, 0),), (equal(x + y, 0), at_least(x, 0))),
    # tangents: x = 0 and y = 1, or far out
    "Jensen, turned": lambda: Goal((at_least(e((x + y)/2), (e(x) + e(y))/2),)),
    "Jensen with weights that are none": lambda: Goal((at_most(e((x + y)/2), e(x)/3 + e(y)/3),)),
    "Jensen, strictly": lambda: Goal((less(e((x + y)/2), (e(x) + e(y))/2),)),
    "Jensen of logarithms, turned": lambda: Goal((at_most(ln((p + q)/2), (ln(p) + ln(q))/2),)),
    "a tangent too steep": lambda: Goal((at_least(e(x), 1 + 2*x),)),
    "a tangent too high": lambda: Goal((at_least(e(x), e(1)*x + R(1, 100)),)),
    "a chord below": lambda: Goal((at_most(e(x), 1 + x),), (at_least(x, 0), at_most(x, 1))),
    "a chord too flat": lambda: Goal((at_most(e(x), 1 + R(17, 10)*x),), (at_least(x, 0), at_most(x, 1))),
    "an exponential that falls": lambda: Goal((at_most(e(y), e(x)),), (at_most(x, y),)),
    "an exponential below its square": lambda: Goal((at_least(e(x), x**2),)),
    "a quadratic tangent everywhere": lambda: Goal((at_least(e(x), 1 + x + x**2/2),)),
    "tanh above its argument": lambda: Goal((at_least(sp.tanh(x), x - x**3/4),), (at_least(x, 0),)),
    "tanh apart": lambda: Goal((equal(sp.tanh(x + y), sp.tanh(x) + sp.tanh(y)),)),
    "smoothing by half": lambda: Goal((at_most(sp.Abs(x), x*sp.tanh(x/k) + k/4),)),
    # sums
    "a mean of squares": lambda: Goal((at_most(total(v)**2, total(v**2)),)),
    "a sum of sizes": lambda: Goal((at_most(total(sp.Abs(v)), sp.Abs(total(v))),)),
    "a largest term": lambda: Goal((at_most(total(v**2), total(v)**2),), (at_least(total(v), 0),)),
    "a count": lambda: Goal((at_least(total(sp.S.One), 1),)),
    "a count of one": lambda: Goal((equal(total(v*x), total(v)),)),
    # motions: from what holds at first
    "below its start": lambda: Goal((less(x, p),), flow={x: -x}, initial={x: p}),
    "driven beyond its start": lambda: Goal((at_most(x**2, p**2),), flow={x: -x + u}, initial={x: p}, inputs=(u,)),
    "an assumption of the end, used before": lambda: Goal(
        (at_most(x, 0),), (at_most(y, 0),), flow={x: y, y: -1}, initial={x: sp.S.Zero, y: sp.S.One}),
    "what holds at first holds always": lambda: Goal((at_least(y, 0),), flow={y: -1, t: sp.S.One},
                                                     initial={y: sp.S.One, t: sp.S.Zero}),
    "a decrease too fast": lambda: Goal((at_most(D(x**2), -3*x**2),), flow={x: -x}),
    "a rate of a constant's square": lambda: Goal((at_most(D(x**2*k), -3*k*x**2),), flow={x: -x}),
    "a bound that drifts": lambda: Goal((at_most(x, q),), flow={x: p, t: sp.S.One},
                                        initial={x: sp.S.Zero, t: sp.S.Zero}),
    "a circle that is left": lambda: Goal((at_most(x, R(9, 10)*p),), flow={x: y, y: -x}, initial={x: p, y: sp.S.Zero}),
}
TRUE: dict[str, Callable[[], Goal]] = {
    "a fraction that grows": lambda: Goal((at_most(x/(1 + x), y/(1 + y)),), ORDER),
    "a form": lambda: Goal((at_least(FORM, 0),), (greater(a, 0), at_least(a*b, r**2))),
    "a square that is none": lambda: Goal((equal(x, y),), (at_most((x - y)**2, 0),)),
    "two sides": lambda: Goal((equal(x, y),), (at_most(x, y), at_least(x, y))),
    "a half power where it is": lambda: Goal((equal(p**R(3, 2)*p**R(1, 2), p**2),)),
    "a root of an exponential": lambda: Goal((equal(sq(e(2*x)), e(x)),)),
    "a mean of a mean": lambda: Goal((at_most(total(v)**2, total(sp.S.One)*total(v**2)),)),
    "a size": lambda: Goal((at_most(sp.Abs(x + y), sp.Abs(x) + sp.Abs(y)),)),
}
