"""Points at which a goal may fail, or its assumptions may hold, as far as floating point can tell.

Small numbers first, so that what is easy to refute is refuted by numbers that are easy to read; then random ones, on
the whole domain and on families where assumptions, the relation itself or coincidences hold with equality; then what
local search reaches. All are fractions; the exact check is the caller's.
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
from workbench.proof.decide.descent import descended, rounded
from workbench.proof.decide.exact_values import exact_function
from workbench.proof.decide.innermost import innermost
from workbench.proof.decide.landscape import Landscape, landscape_of
from workbench.proof.decide.local_search import local_search
from workbench.proof.decide.once import once_per_goal
from workbench.proof.decide.quadrics import on_quadrics
from workbench.proof.decide.sampling import tidy_fraction, trial_columns

SPECIAL = (Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(2), Fraction(-2), Fraction(3))
SCALES = (Fraction(1, 4000), Fraction(1, 400), Fraction(1, 40), Fraction(1, 4), Fraction(5, 2))
FIRST_BLOCKS = (40, 160, 400, 1_400)  # `quick` does without the last
POINTS = 600
FAMILIES, SEARCHED = 60, 8  # families of points, and among them those that local search starts from
FEW_SYMBOLS = 2  # of goals on which a local search costs next to nothing
NEAR = 1e-2  # violation, in all, of points beside which equalities may hold
INNERMOST = 3  # points reached by least squares from which one farther inside is sought
LOOKS = 5  # exact looks for each batch of points

Point = dict[str, Fraction]


def proposals(goal: Goal, seed: int, break_shown: bool, quick: bool = False) -> Iterator[Point]:
    """Points that floating point does not rule out; with `quick`, only those that cost next to nothing.

    Raises ClaimError for a derivative that does not exist everywhere.
    """
    landscape = landscape_of(goal)
    yield from _familiar(goal, landscape, seed, break_shown, quick)
    if (curved := on_quadrics(goal)) is not None:
        yield from _worth_a_look(landscape, curved, trial_columns(curved.free, POINTS, np.random.default_rng(seed)),
                                 break_shown)
    if quick and len(landscape.symbols) > FEW_SYMBOLS:
        return
    chance, rng = random.Random(seed), np.random.default_rng(seed)
    tried: list[Family] = []
    for family in families(landscape, chance, 1 if quick else FAMILIES):
        tried.append(family)
        chosen = trial_columns(family.free, POINTS, rng)
        yield from _worth_a_look(landscape, family, chosen, break_shown)
        if len(tried) <= SEARCHED:
            yield from _worth_a_look(landscape, family, local_search(landscape, family, break_shown, rng), break_shown)


def first_proposals(goal: Goal) -> Iterator[Point]:
    """Those of them that cost least: special values, and a few random ones."""
    return _familiar(goal, landscape_of(goal), 1, True, True)


@once_per_goal
def _descents(goal: Goal) -> dict[tuple[int, bool], list[tuple[Point, bool]]]:
    return {}


def descents(goal: Goal, seed: int, break_shown: bool) -> list[tuple[Point, bool]]:
    """Points that least squares reach, and whether they only come near: what is assumed equal may be so beside them."""
    known = _descents(goal)
    if (seed, break_shown) not in known:
        known[seed, break_shown] = list(_descended(landscape_of(goal), seed, break_shown))
    return known[seed, break_shown]


def _descended(landscape: Landscape, seed: int, break_shown: bool) -> Iterator[tuple[Point, bool]]:
    family = next(families(landscape, random.Random(seed), 1))
    if not family.free:
        return
    reached = descended(landscape, family, break_shown, np.random.default_rng(seed))
    inside = innermost(landscape, family, break_shown, reached[:INNERMOST])
    for chosen in (*rounded(family, reached), *rounded(family, inside)):
        violation, excess = landscape.look(family.columns(chosen))
        near = violation < NEAR
        if break_shown:
            near &= excess > 0
        for row in np.flatnonzero(near)[:LOOKS]:
            point = family.exact({s: tidy_fraction(float(c[row])) for s, c in chosen.items()})
            if point is not None:
                yield point, violation[row] > 0


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
    source = _drawn(goal).at(seed)
    for block in FIRST_BLOCKS[:-1] if quick else FIRST_BLOCKS:
        drawn = list(islice(source, block))
        violation, excess = landscape.look(list(np.array([numbers for _, numbers in drawn]).T))
        passes = violation == 0
        if break_shown:
            passes &= excess > 0
        for row in np.flatnonzero(passes)[:10 * LOOKS]:
            yield drawn[row][0]


class _Drawn:
    """The sample points of a goal, by seed, drawn once for all that look at them."""

    def __init__(self, goal: Goal) -> None:
        self._goal, self._names = goal, [name_of(s) for s in goal.symbols()]
        self._points: dict[int, tuple[list[tuple[Point, list[float]]], Iterator[Point]]] = {}

    def at(self, seed: int) -> Iterator[tuple[Point, list[float]]]:
        """The points from the first on, and as floats in the order of the goal's symbols; nobody may change them."""
        points, source = self._points.setdefault(seed, ([], sample_points(self._goal, seed)))
        for place in count():
            if place == len(points):
                point = next(source)
                points.append((point, [float(point[name]) for name in self._names]))
            yield points[place]


@once_per_goal
def _drawn(goal: Goal) -> _Drawn:
    return _Drawn(goal)


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
    follow = [(name_of(r.left), exact_function(r.right)) for r in equations]
    for attempt in count():
        point: Point = {}
        for name, positive, nonnegative in symbols:
            value = rng.choice(SPECIAL) if rng.random() < 0.5 or attempt < 50 else _random(rng)
            if nonnegative:
                value = abs(value) or (Fraction(1) if positive else value)
            point[name] = value
        for name, value_of in follow:
            follows = value_of(point)
            if follows is not None:
                point[name] = follows
        yield point


def _random(rng: random.Random) -> Fraction:
    return _scaled(rng.randint(-100, 100), rng.choice(range(len(SCALES))))


@cache
def _scaled(count: int, place: int) -> Fraction:
    return count * SCALES[place]
