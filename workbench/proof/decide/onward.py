"""How a motion goes on from a point at time zero so that what always holds keeps holding: at rest, or by functions of
time that solve its rates one after the other."""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.checker import SUM
from workbench.proof.claim import Goal, Relation, at_least, name_of
from workbench.proof.decide.landscape import plain
from workbench.proof.decide.names import free_name
from workbench.proof.decide.proposals import Point
from workbench.proof.decide.search import search
from workbench.proof.text import text

Motion = dict[sp.Expr, sp.Expr]


def needs_path(goal: Goal) -> bool:
    """Whether what always holds speaks of what moves, so that a point alone says nothing of later instants."""
    moving = {s for s, rate in goal.flow.items() if rate != 0}
    return any(r.margin.free_symbols & {x for s in moving for x in s.free_symbols} for r in goal.always)


def onward(goal: Goal, point: Point) -> dict[str, Any] | None:
    """What a certificate says of a motion that starts at the point and keeps what always holds; None where none is
    found. Inputs stay as they are, and sums have one term."""
    if any(isinstance(s, sp.Indexed) for s in goal.moving()):
        return None
    taken = {name_of(s) for s in goal.symbols()} | {SUM}
    time = sp.Symbol(free_name("time", taken), real=True)
    values = {s if isinstance(s, sp.Symbol) else sp.Symbol(name_of(s), real=True): sp.Rational(
        point[name_of(s)].numerator, point[name_of(s)].denominator) for s in goal.symbols() if name_of(s) in point}
    rates = {s: plain(goal, rate) for s, rate in goal.flow.items() if rate != 0}
    for motion in (_at_rest(rates, values), _solved(rates, values, time)):
        if motion is not None and (proofs := _kept(goal, values | motion, time)) is not None:
            return {"path": {name_of(s): text(f) for s, f in motion.items()}, "time": str(time), "duration": "0",
                    "always": proofs}
    return None


def _at_rest(rates: Motion, values: Motion) -> Motion | None:
    if any(rate.xreplace(values) != 0 for rate in rates.values()):
        return None
    return {s: values[s] for s in rates}


def _solved(rates: Motion, values: Motion, time: sp.Symbol) -> Motion | None:
    """Each rate a polynomial of time, or linear in its own symbol, coefficients being numbers; the others known."""
    constant = {s: value for s, value in values.items() if s not in rates}
    motion: Motion = {}
    while len(motion) < len(rates):
        before = len(motion)
        for s in [s for s in rates if s not in motion]:
            rate = sp.expand(rates[s].xreplace(constant).xreplace(motion))
            slope = sp.diff(rate, s)
            rest = sp.expand(rate - slope * s)
            if slope == 0 and rest.free_symbols <= {time} and rest.is_polynomial(time):
                motion[s] = values[s] + sp.Poly(rest, time).integrate().as_expr()
            elif slope.is_Rational and rest.is_Rational:
                motion[s] = (values[s] + rest / slope) * sp.exp(slope * time) - rest / slope
        if len(motion) == before:
            return None
    return motion


def _kept(goal: Goal, motion: Motion, time: sp.Symbol) -> list[dict[str, Any]] | None:
    """A proof that each relation which always holds does so along a motion, or None."""
    proofs = []
    for relation in goal.always:
        along = Relation(plain(goal, relation.left).xreplace(motion), relation.operator,
                         plain(goal, relation.right).xreplace(motion))
        asked = Goal((along,), (at_least(time, 0),))
        found = search(asked, along, asked.assume)
        if found is None:
            return None
        proofs.append(found)
    return proofs
