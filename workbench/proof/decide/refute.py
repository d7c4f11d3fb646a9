"""Search for a point where the assumptions hold and a relation fails; the checker has the last word."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

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
from workbench.proof.claim import Goal, Relation, Verdict, equal, name_of
from workbench.proof.decide.model import find_model
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import goal_text

SPECIAL = (Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(2), Fraction(-2), Fraction(3))
SCALES = (Fraction(1, 100), Fraction(1, 10), Fraction(1), Fraction(10), Fraction(100))
TRIES = 10_000
SLACK = 1e-9

Point = dict[str, Fraction]


def find_counterexample(goal: Goal, verdict: Verdict, seed: int = 1) -> dict[str, Any] | None:
    """A certificate with a rational point that falsifies the goal, or None."""
    if goal.eventually is not None:
        return find_model(goal, verdict)
    record = goal_text(goal)
    for point in _promising(goal, seed, break_shown=True):
        certificate = {"version": 1, "verdict": verdict, "goal": record, "point": _texts(point)}
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
    return next((_texts(point) for point in _promising(goal, seed, break_shown=False)
                 if _all_hold(record, texts, point)), None)


def _texts(point: Point) -> dict[str, str]:
    return {name: str(value) for name, value in point.items()}


def _promising(goal: Goal, seed: int, break_shown: bool) -> Iterator[Point]:
    """Sampled points that floating point does not rule out; the exact check is the caller's."""
    names = [name_of(s) for s in goal.symbols()]
    given = [_float_margin(goal, r) for r in (*goal.signs(), *goal.assume, *goal.always)]
    shown = [_float_margin(goal, r) for r in goal.show]
    for point in sample_points(goal, seed):
        values = [float(point[name]) for name in names]
        try:
            if any(not _may_hold(operator, margin(*values)) for operator, margin in given):
                continue
            if break_shown and not any(_may_fail(operator, margin(*values)) for operator, margin in shown):
                continue
        except (ZeroDivisionError, ValueError, OverflowError, TypeError):
            continue
        yield point


def _float_margin(goal: Goal, relation: Relation) -> tuple[str, Callable[..., float]]:
    """The relation's operator and its margin as a function of floats, for one neuron."""
    plain = expand_derivatives(relation.margin, goal.flow).replace(sp.Sum, lambda term, *_: term)
    names = {i: sp.Symbol(name_of(i)) for i in plain.atoms(sp.Indexed)}
    symbols = [sp.Symbol(name_of(s)) if isinstance(s, sp.Indexed) else s for s in goal.symbols()]
    return relation.operator, sp.lambdify(symbols, plain.xreplace(names), modules="math")


def _may_hold(operator: str, margin: float) -> bool:
    if operator == "==":
        return abs(margin) <= SLACK * 1e3
    return margin != 0 if operator == "!=" else margin >= -SLACK


def _may_fail(operator: str, margin: float) -> bool:
    if operator == "==":
        return abs(margin) > SLACK
    return abs(margin) <= SLACK if operator == "!=" else margin < SLACK


def sample_points(goal: Goal, seed: int) -> Iterator[Point]:
    """Rational points by name: special values first, then random ones of several magnitudes.

    A symbol that an assumption sets equal to an expression of others takes that value.
    """
    rng = random.Random(seed)
    symbols = goal.symbols()
    equations = [r for r in goal.assume if r.operator == "==" and r.left.is_Symbol
                 and not r.right.has(r.left)]
    # Only the first instant is known to be reached, so a counterexample stands there.
    equations += [equal(s, value) for s, value in goal.initial.items()]
    for attempt in range(TRIES):
        point: Point = {}
        for symbol in symbols:
            value = rng.choice(SPECIAL) if rng.random() < 0.5 or attempt < 50 else _random(rng)
            if symbol.is_positive or symbol.is_nonnegative:
                value = abs(value) or (Fraction(1) if symbol.is_positive else value)
            point[name_of(symbol)] = value
        for relation in equations:
            right = relation.right.xreplace({
                s: sp.Rational(point[name_of(s)].numerator, point[name_of(s)].denominator)
                for s in relation.right.free_symbols if name_of(s) in point})
            if right.is_Rational:
                point[str(relation.left)] = Fraction(int(right.p), int(right.q))
        yield point


def _random(rng: random.Random) -> Fraction:
    return Fraction(rng.randint(-100, 100), 40) * rng.choice(SCALES)


def _context(record: dict[str, Any]) -> Context:
    return Context(record.get("flow", {}), record.get("indexed", []))


def _all_hold(record: dict[str, Any], texts: list[str], point: Point) -> bool:
    context = _context(record)
    values = {name: number(value) for name, value in point.items()}
    try:
        return all(holds(context, text, values) for text in texts)
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
