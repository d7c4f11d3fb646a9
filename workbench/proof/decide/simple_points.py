"""The simplest counterexample near one that was found: small whole numbers, zeros and ones, few letters that matter.

A point is looked at exactly as the search looks at it, so that what comes out breaks the goal, too, within its domain.
The number of looks is bounded; what they find depends on goal and point alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, product

from workbench.proof.decide.exact_look import Exact, Point

# The simpler the earlier.
LADDER = tuple(map(Fraction, (
    "0", "1", "-1", "2", "1/2", "-2", "3", "-1/2", "-3", "4", "1/3", "-4", "5", "1/4", "10", "-5", "1/10", "-10", "100",
    "1/100", "-1/10", "-100", "1000", "1/1000")))
PLAIN = LADDER[:7]
PASSES = 4
FEW = 6  # letters that are moved together
LOOKS = 400  # in all; a goal with functions has fewer, since each look encloses them
LOOKS_WITH_FUNCTIONS = 60


def cost(value: Fraction) -> int:
    """How hard a number is to read: its place in the ladder, else beyond its end by its digits."""
    if value in LADDER:
        return LADDER.index(value)
    return len(LADDER) + len(str(abs(value.numerator))) + 2 * len(str(value.denominator))


def plainer_point(exact: Exact, point: Point) -> Point:
    """A point that breaks the goal too, each value in turn made as simple as can be: zero first, then one."""
    for name, value in sorted(point.items()):
        rank = PLAIN.index(value) if value in PLAIN else len(PLAIN)
        for simpler in PLAIN[:rank]:
            tried = point | {name: simpler}
            if exact.breaks(tried):
                point = tried
                break
    return point


def simplest_point(exact: Exact, point: Point) -> Point:
    """A point that breaks the goal as the given one does, its values simpler where such ones were found."""
    looks = _Looks(exact)
    for _ in range(PASSES):
        before = point
        point = _one_by_one(looks, point)
        point = _two_by_two(looks, point)
        if point == before or not looks.left:
            break
    return point


class _Looks:
    """Looks at points, so many and no more."""

    def __init__(self, exact: Exact) -> None:
        self._exact = exact
        self.left = LOOKS_WITH_FUNCTIONS if exact.context.functions else LOOKS

    def breaks(self, point: Point) -> bool:
        """Whether a point breaks the goal; False where no look is left."""
        if not self.left:
            return False
        self.left -= 1
        return self._exact.breaks(point)


def _one_by_one(looks: _Looks, point: Point) -> Point:
    """Each value in turn made as simple as can be, the hardest first."""
    for name in sorted(point, key=lambda name: (-cost(point[name]), name)):
        for simpler in _simpler(point[name]):
            if looks.breaks(point | {name: simpler}):
                point = point | {name: simpler}
                break
    return point


def _two_by_two(looks: _Looks, point: Point) -> Point:
    """Two of the hardest values together, the simplest pairs first."""
    hard = sorted((name for name, value in point.items() if cost(value) > 1),
                  key=lambda name: (-cost(point[name]), name))[:FEW]
    for pair in combinations(hard, 2):
        now = sum(cost(point[name]) for name in pair)
        for values in sorted(product(LADDER[:9], repeat=2), key=lambda values: sum(map(cost, values))):
            if sum(map(cost, values)) >= now:
                break
            tried = point | dict(zip(pair, values, strict=True))
            if looks.breaks(tried):
                point = tried
                break
    return point


def _simpler(value: Fraction) -> Iterator[Fraction]:
    """Numbers that are simpler than one, the simplest first, then those near it."""
    yield from (one for one in LADDER if cost(one) < cost(value))
    if value not in LADDER:
        near = dict.fromkeys(Fraction(round(value * parts), parts) for parts in (1, 2, 5, 10, 20, 50, 100, 200, 1000))
        yield from (one for one in near if one not in LADDER and cost(one) < cost(value))
