"""Points at which a goal may fail, or its assumptions may hold, as far as floating point can tell.

Small numbers first, so that what is easy to refute is refuted by numbers that are easy to read; then random ones, on
the whole domain and on families where assumptions, the relation itself or coincidences hold with equality; then what
climbing reaches. All are fractions; the exact check is the caller's.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import count, islice
from typing import Any

import numpy as np
import sympy as sp

from workbench.proof.claim import Goal, equal, name_of
from workbench.proof.decide.boundary_points import Family, families
from workbench.proof.decide.landscape import Landscape
from workbench.proof.decide.local_search import climb
from workbench.proof.decide.sampling import tidy_fraction, trial_columns

SPECIAL = (Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(2), Fraction(-2), Fraction(3))
SCALES = (Fraction(1, 100), Fraction(1, 10), Fraction(1), Fraction(10), Fraction(100))
FIRST_BLOCKS = (40, 160, 400, 1_400)  # `quick` does without the last
POINTS = 600
FAMILIES, CLIMBS = 60, 8
LOOKS = 5  # exact looks for each batch of points

Point = dict[str, Fraction]


def proposals(goal: Goal, seed: int, break_shown: bool, quick: bool = False) -> Iterator[Point]:
    """Points that floating point does not rule out; with `quick`, only those that cost next to nothing.

    Raises ClaimError for a derivative that does not exist everywhere.
    """
    landscape = Landscape(goal)
    yield from _familiar(goal, landscape, seed, break_shown, quick)
    if quick:
        return
    chance, rng = random.Random(seed), np.random.default_rng(seed)
    tried: list[Family] = []
    for family in families(landscape, chance, FAMILIES):
        tried.append(family)
        chosen = trial_columns(family.free, POINTS, rng)
        yield from _worth_a_look(landscape, family, chosen, break_shown)
        if len(tried) <= CLIMBS:
            yield from _worth_a_look(landscape, family, climb(landscape, family, break_shown, rng), break_shown)


def _worth_a_look(landscape: Landscape, family: Family, chosen: dict[sp.Symbol, Any],
                  break_shown: bool) -> Iterator[Point]:
    """The rows that pass in floating point, clear failures before possible ones, in their order."""
    if not chosen and family.free:
        return
    violation, excess = landscape.look(family.columns(chosen))
    passes = violation == 0
    if break_shown:
        passes &= excess > 0
    rows = np.flatnonzero(passes)
    if break_shown:
        rows = rows[np.argsort(excess[rows] < 1e-6, kind="stable")]
    for row in rows[:LOOKS]:
        point = family.exact({s: tidy_fraction(float(c[row])) for s, c in chosen.items()})
        if point is not None:
            yield point


def _familiar(goal: Goal, landscape: Landscape, seed: int, break_shown: bool, quick: bool) -> Iterator[Point]:
    """Special values and a few random ones."""
    source = sample_points(goal, seed)
    names = [name_of(s) for s in goal.symbols()]
    for block in FIRST_BLOCKS[:-1] if quick else FIRST_BLOCKS:
        points = list(islice(source, block))
        violation, excess = landscape.look([np.array([float(p[name]) for p in points]) for name in names])
        passes = violation == 0
        if break_shown:
            passes &= excess > 0
        for row in np.flatnonzero(passes)[:10 * LOOKS]:
            yield points[row]


def sample_points(goal: Goal, seed: int) -> Iterator[Point]:
    """Rational points by name without end: special values first, then random ones of several magnitudes.

    A symbol that an assumption sets equal to an expression of others takes that value.
    """
    rng = random.Random(seed)
    symbols = [(name_of(s), bool(s.is_positive), bool(s.is_nonnegative)) for s in goal.symbols()]
    equations = [r for r in goal.assume if r.operator == "==" and r.left.is_Symbol
                 and not r.right.has(r.left)]
    # Only the first instant is known to be reached, so a counterexample stands there.
    equations += [equal(s, value) for s, value in goal.initial.items()]
    for attempt in count():
        point: Point = {}
        for name, positive, nonnegative in symbols:
            value = rng.choice(SPECIAL) if rng.random() < 0.5 or attempt < 50 else _random(rng)
            if nonnegative:
                value = abs(value) or (Fraction(1) if positive else value)
            point[name] = value
        for relation in equations:
            right = relation.right.xreplace({
                s: sp.Rational(point[name_of(s)].numerator, point[name_of(s)].denominator)
                for s in relation.right.free_symbols if name_of(s) in point})
            if right.is_Rational:
                point[str(relation.left)] = Fraction(int(right.p), int(right.q))
        yield point


def _random(rng: random.Random) -> Fraction:
    return _scaled(rng.randint(-100, 100), rng.choice(SCALES))


@cache
def _scaled(fortieths: int, scale: Fraction) -> Fraction:
    return Fraction(fortieths, 40) * scale
