"""Break a bound of a later instant: constant inputs move everything in straight lines until the bound fails."""

from __future__ import annotations

from fractions import Fraction
from itertools import islice
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Goal, Relation, Verdict, at_least, name_of
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.proposals import Point, proposals
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import goal_text

LOOKS = 30
SAMPLES = (sp.Integer(0), sp.Rational(1, 2), sp.Integer(1), sp.Integer(100))  # of the duration; `always` goes on


def find_path(goal: Goal, verdict: Verdict, seed: int, quick: bool = False) -> dict[str, Any] | None:
    """A certificate with a point that the flow reaches from its initial values along a straight line, or None."""
    moving = {s for s, rate in goal.flow.items() if rate != 0}
    curved = any(rate.free_symbols & moving for rate in goal.flow.values())
    if not moving or set(goal.initial) != set(goal.flow) or curved:
        return None
    if any(isinstance(s, sp.Indexed) for s in goal.symbols()):
        return None
    taken = {name_of(s) for s in goal.symbols()}
    duration, time = (sp.Symbol(next(n for n in (name, f"{name}_", f"{name}__") if n not in taken), **sign)
                      for name, sign in (("duration", {"positive": True}), ("time", {"real": True})))
    record = goal_text(goal)
    for point in _ends(goal, duration, seed, quick):
        certificate = _certificate(goal, record, point, duration, time)
        if certificate is not None:
            certificate["verdict"] = verdict
            try:
                check(certificate)
            except CertificateError:
                continue
            return certificate
    return None


def _along(goal: Goal, relation: Relation, time: sp.Expr) -> Relation:
    """The relation some time after the start."""
    line = {s: goal.initial[s] + rate * time for s, rate in goal.flow.items()}
    sides = (expand_derivatives(side, goal.flow).xreplace(line) for side in (relation.left, relation.right))
    left, right = sides
    return Relation(left, relation.operator, right)


def _ends(goal: Goal, duration: sp.Symbol, seed: int, quick: bool) -> list[Point]:
    """Points by constants, inputs and the duration at which the goal at the end of the line seems to fail."""
    held = [_along(goal, r, part * duration) for r in goal.always for part in SAMPLES]
    try:
        at_end = Goal(tuple(_along(goal, r, duration) for r in goal.show),
                      (*(_along(goal, r, duration) for r in goal.assume), *held, *_signs(goal)))
        return list(islice(proposals(at_end, seed, True, quick), LOOKS))
    except ClaimError:
        return []


def _signs(goal: Goal) -> tuple[Relation, ...]:
    """What keeps symbols in the goal that its relations do not mention: they need values all the same."""
    unseen = {s for e in (*goal.flow.values(), *goal.initial.values()) for s in e.free_symbols}
    return tuple(at_least(s**2, 0) for s in sorted(unseen, key=str))


def _certificate(goal: Goal, record: dict[str, Any], point: Point, duration: sp.Symbol,
                 time: sp.Symbol) -> dict[str, Any] | None:
    """The certificate for constants, inputs and a duration; None without a proof of what must always hold."""
    lasting = point[str(duration)]
    constants = {s: sp.Rational(point[str(s)].numerator, point[str(s)].denominator)
                 for s in goal.symbols() if str(s) in point}
    ends = dict(point)
    del ends[str(duration)]
    for s, rate in goal.flow.items():
        end = (goal.initial[s] + rate * sp.Rational(lasting.numerator, lasting.denominator)).xreplace(constants)
        if not end.is_Rational:
            return None
        ends[str(s)] = Fraction(int(end.p), int(end.q))
    later = (at_least(time, 0),)
    proofs = []
    for relation in goal.always:
        along = _along(goal, relation, time).subs(constants)
        if along.operator in ("==", "<=", ">=") and find_identity(Goal((along,)), along):
            proofs.append({"rule": "identity"})
            continue
        found = find_combination(Goal((along,)), along, later)
        if found is None:
            return None
        proofs.append(found)
    return {"version": 1, "verdict": "", "goal": record, "point": {name: str(v) for name, v in ends.items()},
            "duration": str(lasting), "time": str(time), "always": proofs}
