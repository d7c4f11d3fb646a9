"""Search for a point where the assumptions hold and a relation fails; the checker has the last word."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

from workbench.proof.checker import (
    CertificateError,
    Context,
    bounds,
    check,
    holds,
    number,
    split_relation,
    substitute,
)
from workbench.proof.claim import Goal, Verdict, name_of
from workbench.proof.decide.model import find_model
from workbench.proof.text import goal_text

SPECIAL = (Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(2), Fraction(-2), Fraction(3))
TRIES = 4000


def find_counterexample(goal: Goal, verdict: Verdict, seed: int = 1) -> dict[str, Any] | None:
    """A certificate with a rational point that falsifies the goal, or None."""
    if goal.eventually is not None:
        return find_model(goal, verdict)
    record = goal_text(goal)
    for point in sample_points(goal, seed):
        if _breaks(record, point):
            certificate = {"version": 1, "verdict": verdict, "goal": record,
                           "point": {name: str(value) for name, value in point.items()}}
            try:
                check(certificate)
            except CertificateError:
                continue
            return certificate
    return None


def find_example(goal: Goal, seed: int = 1) -> dict[str, str] | None:
    """A rational point that meets all assumptions of a goal, so that nothing is proved from nothing."""
    record = goal_text(goal)
    texts = [*record["assume"], *record.get("always", [])]
    for point in sample_points(goal, seed):
        if _all_hold(record, texts, point):
            return {name: str(value) for name, value in point.items()}
    return None


def sample_points(goal: Goal, seed: int) -> Any:
    """Rational points by name: special values first, then random ones of several magnitudes.

    A symbol that an assumption sets equal to an expression of others takes that value.
    """
    rng = random.Random(seed)
    symbols = goal.symbols()
    equations = [r for r in goal.assume if r.operator == "==" and r.left.is_Symbol
                 and not r.right.has(r.left)]
    for attempt in range(TRIES):
        point: dict[str, Fraction] = {}
        for symbol in symbols:
            value = rng.choice(SPECIAL) if rng.random() < 0.5 or attempt < 50 else _random(rng)
            if symbol.is_positive or symbol.is_nonnegative:
                value = abs(value) or (Fraction(1) if symbol.is_positive else value)
            point[name_of(symbol)] = value
        for relation in equations:
            values = {s: point[name_of(s)] for s in relation.right.free_symbols if name_of(s) in point}
            right = relation.right.subs({s: v for s, v in values.items()})
            if right.is_Rational:
                point[str(relation.left)] = Fraction(int(right.p), int(right.q))
        yield point


def _random(rng: random.Random) -> Fraction:
    scale = rng.choice((Fraction(1, 100), Fraction(1, 10), Fraction(1), Fraction(10), Fraction(100)))
    return Fraction(rng.randint(-100, 100), 40) * scale


def _context(record: dict[str, Any]) -> Context:
    return Context(record.get("flow", {}), record.get("indexed", []))


def _all_hold(record: dict[str, Any], texts: list[str], point: dict[str, Fraction]) -> bool:
    context = _context(record)
    values = {name: number(value) for name, value in point.items()}
    try:
        return all(holds(context, text, values) for text in texts)
    except CertificateError:
        return False


def _breaks(record: dict[str, Any], point: dict[str, Fraction]) -> bool:
    if not _all_hold(record, [*record["assume"], *record.get("always", [])], point):
        return False
    context = _context(record)
    values = {name: number(value) for name, value in point.items()}
    try:
        return not all([holds(context, text, values) for text in record["show"]])
    except CertificateError:
        return False


def value_at(goal: Goal, point: dict[str, str]) -> str:
    """The sides of the first relation that fails (or of the last) at a point, as exact or rounded numbers."""
    record = goal_text(goal)
    context = _context(record)
    values = {name: number(Fraction(v)) for name, v in point.items()}
    for shown in record["show"]:
        if not holds(context, shown, values) or shown is record["show"][-1]:
            break
    left, operator, right = split_relation(shown)
    sides = [bounds(context, substitute(context, context.read(side), values)) for side in (left, right)]
    a, b = (f"{float(low):.6g}" if low == high or float(low) == float(high) else f"{float((low + high) / 2):.6g}"
            for low, high in sides)
    return f"{a} {operator} {b}"
