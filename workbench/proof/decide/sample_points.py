"""Points at which a sign is looked at before a proof of it is sought, since a look costs less."""

from __future__ import annotations

import math
import random

import sympy as sp

from workbench.proof.claim import Relation

Given = tuple[Relation, ...]
Point = dict[sp.Symbol, float]

NEAR_ZERO = 1e-9  # what rounding may leave
POINTS = 60


def sample_points(shown: Relation, given: Given) -> list[Point]:
    """Some points at which what is given holds, the same ones at every call."""
    symbols = sorted(set().union(*(r.margin.free_symbols for r in (shown, *given))), key=str)
    drawn = random.Random(1)
    found = []
    for _ in range(10 * POINTS):
        point = {s: drawn.uniform(-1, 1) * 10 ** drawn.uniform(-1, 1) for s in symbols}
        if all(holds_at(r, point) for r in given):
            found.append(point)
        if len(found) == POINTS:
            break
    return found


def holds_at(relation: Relation, point: Point) -> bool:
    """Whether an inequality holds at a point, as far as rounding tells."""
    value = value_at(relation.margin, point)
    return value is not None and (value > 0 if relation.strict else value >= 0)


def value_at(expr: sp.Expr, point: Point) -> float | None:
    """The value at a point; None where it is none, or not real."""
    try:
        value = complex(expr.subs(point))
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        return None
    return value.real if math.isfinite(value.real) and abs(value.imag) < 1e-12 else None
