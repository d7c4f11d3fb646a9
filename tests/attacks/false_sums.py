"""False statements and forged certificates with products of sums, tangents and squares of what is to be shown."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less

a, b, r, s, x, y = sp.symbols("a b r s x y", real=True)
k = sp.Symbol("k", positive=True)
j, n = sp.Symbol("j", integer=True), sp.Symbol("n", integer=True, positive=True)
u, v, w = (sp.IndexedBase(name, real=True)[j] for name in ("u", "v", "w"))
R = sp.Rational


def total(term: sp.Expr) -> sp.Expr:
    """The sum of a term over the index."""
    return sp.Sum(term, (j, 1, n))


NORMS = (at_least(r, 0), at_least(s, 0), equal(r**2, total(u**2)), equal(s**2, total(v**2)))

STATEMENTS: dict[str, Goal] = {
    # one term: u = v = 1, or of two terms: u = (1, 1), v = (1, 0)
    "Cauchy with a half": Goal((at_most(2 * total(u*v)**2, total(u**2) * total(v**2)),)),
    "Cauchy turned": Goal((at_least(total(u*v)**2, total(u**2) * total(v**2)),)),
    "Cauchy strict": Goal((less(total(u*v)**2, total(u**2) * total(v**2)),)),
    "Cauchy as an equality": Goal((equal(total(u*v)**2, total(u**2) * total(v**2)),)),
    "Cauchy without a square": Goal((at_most(total(u*v), total(u**2) * total(v**2)),)),
    "Cauchy with another sum": Goal((at_most(total(u*w)**2, total(u**2) * total(v**2)),)),
    "Cauchy with 0.99": Goal((at_most(100 * total(u*v)**2, 99 * total(u**2) * total(v**2)),)),
    "Cauchy of three": Goal((at_most(total(u*v*w)**2, total(u**2) * total(v**2)),)),
    "the root of one sum": Goal((at_most(total(u*v), sp.sqrt(total(u**2))),)),
    "the mean's square without a count": Goal((at_most(total(u)**2, total(u**2)),)),
    "the mean's square turned": Goal((at_least(total(u)**2, total(1) * total(u**2)),)),
    "half of the count": Goal((at_most(2 * total(u)**2, total(1) * total(u**2)),)),
    "a product of sums is the sum of products": Goal((equal(total(u) * total(v), total(u*v)),)),
    "a product of sums bounds the sum of products": Goal((at_least(total(u) * total(v), total(u*v)),)),
    "the square of a sum is the sum of squares": Goal((equal(total(u)**2, total(u**2)),)),
    "sums of fourth powers": Goal((at_least(total(u**4), total(u**2)**2),)),
    "a square of a sum, the mixed term lost": Goal((equal(total(u + v)**2, total(u)**2 + total(v)**2),)),
    "a product of three sums": Goal((at_least(total(u) * total(v) * total(w), 0),)),
    "a product of positive sums": Goal((at_least(total(u**2) * total(v**2), 1),), (greater(total(u**2), 0),
                                                                                  greater(total(v**2), 1))),
    "a quotient of sums": Goal((at_most(total(u**2) / (1 + total(u**2)), R(1, 2)),)),
    "a quotient that is no one": Goal((equal(total(u) / (1 + total(u)**2), 1),)),
    "division by a sum that may be zero": Goal((equal(total(u) / total(u), 1),), (at_least(total(u), 0),)),
    "a projection longer than the vector": Goal((at_least(total(u*v)**2 / total(v**2), total(u**2)),),
                                                (greater(total(v**2), 0),)),
    "Minkowski turned": Goal((at_least(total((u + v)**2), (r + s)**2),), NORMS),
    "Minkowski strict": Goal((less(total((u + v)**2), (r + s)**2),), NORMS),
    "Minkowski without the norms' sign": Goal((at_most(total((u + v)**2), (r + s)**2),), NORMS[2:]),
    "Minkowski with half a norm": Goal((at_most(total((u + v)**2), (r + s / 2)**2),), NORMS),
    "Minkowski of roots, turned": Goal((at_least(sp.sqrt(total((u + v)**2)), sp.sqrt(total(u**2)) + sp.sqrt(
        total(v**2))),)),
    "the reverse triangle, turned": Goal((at_least((r - s)**2, total((u - v)**2)),), NORMS),
    "Young with too small a weight": Goal((at_most(2 * a * total(u*v), total(u**2) * total(v**2) + a**2 / 2),)),
    "bounds of norms, multiplied wrongly": Goal((at_most(total(u*v)**2, a**2 + b**2),), (
        at_most(total(u**2), a**2), at_most(total(v**2), b**2))),
    "the rate of a square of a sum": Goal((equal(D(total(u)**2), 2 * total(u*v)),), flow={u: v}),
    "the rate of a product of sums": Goal((equal(D(total(u) * total(w)), total(v) * total(w)),), flow={u: v, w: v}),
    "the rate of a fourth power of a norm": Goal((at_most(D(total(u**2)**2), -5 * total(u**2)**2),), flow={u: -u}),
    # tangents and squares of the margin
    "smoothing with 0.2784": Goal((at_most(sp.Abs(x) - x * sp.tanh(x / k), R(2784, 10_000) * k),)),
    "x exp(-x) below 0.367": Goal((at_most(x * sp.exp(-x), R(367, 1_000)),), (at_least(x, 0),)),
    "x exp(-x) strictly below 1/e": Goal((less(x * sp.exp(-x), sp.exp(-1)),), (at_least(x, 0),)),
    "log shrinks": Goal((at_least(sp.log(x), sp.log(y)),), (greater(x, 0), at_most(x, y))),
    "log grows by the difference": Goal((at_most(sp.log(y) - sp.log(x), y - x),), (greater(x, 0), at_most(x, y))),
    "the trace bounds twice the form": Goal((at_most(2 * (a*x**2 + 2*r*x*y + b*y**2), (a + b) * (x**2 + y**2)),), (
        at_least(a, 0), at_least(b, 0), at_least(a * b, r**2))),
    "a product's root, without its sign": Goal((at_least(a * b, r),), (at_least(a**2 * b**2, r**2), equal(a, -b))),
}


def _proved(show: str, *proof: Any, assume: tuple[str, ...] = (), **goal: Any) -> dict[str, Any]:
    return {"claim": "doe2026:1", "version": 1, "verdict": "proved", "goal": {
        "assume": list(assume), "show": [show], "indexed": ["u", "v"], **goal},
        "example": {"u": "1", "v": "1", "x": "1"}, "proofs": [proof[0] if proof else {"rule": "identity"}]}


def _sum(*terms: tuple[str, list[dict[str, Any]]], **more: Any) -> dict[str, Any]:
    return {"rule": "combination", "terms": [{"coefficient": c, "factors": list(f)} for c, f in terms], **more}


def forged() -> Iterator[tuple[str, dict[str, Any]]]:
    """Certificates of what is false, each close to one that is sound."""
    above, square = {"assume": 0}, {"sum_of_squares": "v"}
    root = "(Sum(v**2)*(Sum(u**2) + 1) + Sum(u*v)**2 - Sum(u**2)*Sum(v**2))*u - Sum(u*v)*(Sum(u**2) + 1)*v"
    terms = [("1", [{"sum_of_squares": root}]), ("1", [above, above, {"positive": "Sum(u**2) + 2"}]),
             ("1", [above, {"square": "Sum(u**2) + 1"}, square])]
    cauchy = _sum(*terms) | {"rule": "contradiction"}
    yield "Cauchy's proof for half", _proved("2*Sum(u*v)**2 <= Sum(u**2)*Sum(v**2)", cauchy)
    yield "Cauchy's proof, strictly", _proved("Sum(u*v)**2 < Sum(u**2)*Sum(v**2)", cauchy)
    yield "Cauchy's proof, turned", _proved("Sum(u*v)**2 >= Sum(u**2)*Sum(v**2)", cauchy)
    yield "Cauchy's proof for a product of terms", _proved("Sum(u*v)**2 <= Sum(u**2*v**2)", cauchy)
    yield "Cauchy's proof without its square", _proved(
        "Sum(u*v)**2 <= Sum(u**2)*Sum(v**2)", _sum(*terms[1:]) | {"rule": "contradiction"})
    yield "nothing strict in Cauchy's proof", _proved(
        "Sum(u*v)**2 <= Sum(u**2)*Sum(v**2)", _sum(terms[0], terms[2]) | {"rule": "contradiction"})
    for number, show in enumerate((
            "Sum(u)*Sum(v) == Sum(u*v)", "Sum(u)**2 == Sum(u**2)", "Sum(Sum(u)*v) == Sum(u*v)",
            "Sum(u*Sum(v)) == Sum(u*v)", "Sum(u*(v + Sum(u))) == Sum(u*v + u**2)", "Sum(Sum(u)) == Sum(u)",
            "Sum(u*Sum(u))/Sum(u**2 + 1) == Sum(u**2)/Sum(u**2 + 1)", "Sum((u + Sum(v))**2) == Sum(u + v)**2",
            "Sum(u/(1 + Sum(v)**2)) == Sum(u/(1 + v**2))", "Sum(u)*Sum(1/(1 + v**2)) == Sum(u/(1 + v**2))",
            "Sum(1)**2 == Sum(1)", "Sum(1)*Sum(u) == Sum(u)")):
        yield f"an identity that is none {number}", _proved(show)
    for number, (show, flow) in enumerate((
            ("Sum(D(x*u)) == Sum(u*v)", {"x": "Sum(v)"}),
            ("Sum(D(x/(1 + u**2))) == Sum(v/(1 + u**2))", {"x": "Sum(v)"}),
            ("D(Sum(u)) == Sum(v)", {"u": "Sum(v)"}), ("D(Sum(u)**2) == 2*Sum(u*v)", {"u": "v"}),
            ("D(Sum(u)*Sum(v)) == Sum(2*u*v)", {"u": "v", "v": "u"}), ("Sum(u*D(x)) == Sum(u*v)", {"x": "Sum(v)"}),
            ("D(Sum(x*u)) == Sum(u*v)", {"x": "Sum(v)"}))):
        yield f"a rate that is none {number}", _proved(show, flow=flow)
    yield "a sum of squares of a sum of another index", _proved(
        "Sum(u*v) >= 0", _sum(("1", [{"sum_of_squares": "Sum(u)*v"}])))
    yield "a square that is a sum of squares", _proved("Sum(u**2) >= 1", _sum(("1", [{"square": "Sum(u)"}])))
    yield "a sum called positive", _proved("Sum(u) > 0", _sum(("1", [{"positive": "Sum(u)"}])))
    yield "a sum of squares called positive", _proved("Sum(u**2) > 0", _sum(("1", [{"positive": "Sum(u**2)"}])))
    yield "an even sum beside an odd one", _proved("1 + Sum(u**3) > 0", _sum(("1", [{"positive": "1 + Sum(u**3)"}])))
    yield "an index beside its sum", _proved(
        "Sum(1/(1 + u*Sum(u))) == Sum(1/(1 + u*Sum(u))) + 0", assume=("Sum(u**2) >= 0",))
    yield "the root of what is no sum of squares", _proved("sqrt(Sum(u*v))**2 >= -1", {
        "rule": "combination", "terms": [{"coefficient": "1", "factors": [{"square": "sqrt(Sum(u*v))"}]}]})
    yield "an enclosure of a product of counts", _proved(
        "Sum(1)*Sum(1) >= 1", _sum(("1", [{"fact": "enclosure", "of": "Sum(1)*Sum(1) - 1"}])))
    yield "the inverse of a sum that may be zero", _proved(
        "1/Sum(u**2) >= 0", _sum(("1", [{"inverse": 0}])), assume=("Sum(u**2) >= 0",))
    yield "a relation defined by a lemma that is not shown", _proved("log(x) == log(x) + 0", {
        "rule": "cut", "lemma": "x > 0", "proof": {"rule": "identity"}, "then": {"rule": "identity"}})
    yield "a relation defined by an undefined lemma", _proved("log(x) == log(x) + 0", {
        "rule": "cut", "lemma": "exp(log(x)) > 0", "proof": _sum(("1", [{"fact": "exp_positive", "of": "log(x)"}])),
        "then": {"rule": "identity"}})
    refuted = {"claim": "doe2026:1", "version": 1, "verdict": "refuted"}
    yield "refuted where a total is zero", refuted | {
        "goal": {"assume": [], "show": ["1/Sum(u) >= 0"], "indexed": ["u"]}, "point": {},
        "terms": [{"u": "1"}, {"u": "-1"}]}
    yield "refuted at no term, undefined", refuted | {
        "goal": {"assume": [], "show": ["1/Sum(u**2) <= 0"], "indexed": ["u"]}, "point": {}, "terms": []}
    yield "Cauchy refuted", refuted | {
        "goal": {"assume": [], "show": ["Sum(u*v)**2 <= Sum(u**2)*Sum(v**2)"], "indexed": ["u", "v"]}, "point": {},
        "terms": [{"u": "1", "v": "1"}, {"u": "2", "v": "-1"}]}
    yield "refuted, a term's own denominator zero", refuted | {
        "goal": {"assume": [], "show": ["Sum(1/(u - Sum(u)/2)) >= 0"], "indexed": ["u"]}, "point": {},
        "terms": [{"u": "1"}, {"u": "1"}]}
