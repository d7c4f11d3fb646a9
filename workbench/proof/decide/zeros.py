"""Points with rational coordinates where a polynomial that is never negative vanishes.

There every square of its certificate must vanish as well, which is how tight inequalities become easy: the squares'
roots can be sought among polynomials that are zero at those points. Minima are found in floating point, from fixed
random starts, and count only where the polynomial is zero exactly.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from workbench.proof.decide.gram import Block
from workbench.proof.decide.rounding import Rows, simplest
from workbench.proof.decide.situation import Polynomial, Situation, values_at

STARTS, STEPS = 48, 30
MOST_TERMS, MOST_PLACES = 80, 6
SURE, SINGLE = 1e-3, 1e-6

Point = dict[int, Fraction]


def rational_zeros(situation: Situation) -> list[Point]:
    """Zeros of the target, by place in the ring, at which everything known holds; places it lacks are left out.

    None are found for targets that are too large, or with equalities that could not be substituted.
    """
    ring, target = situation.ring, situation.substituted(situation.target)
    places = [i for i in range(ring.ngens) if any(e[i] for e in target)]
    rooted = situation.rooted(target)
    if len(places) > MOST_PLACES or len(rooted) > MOST_TERMS or any(k.sign == "==" for k in situation.known):
        return []
    near = [[simplest(situation.coordinate(i, float(x)), SURE) for i, x in zip(places, row, strict=True)]
            for row in _minima(rooted, places)]
    candidates = sorted({tuple(x for x in numbers if x is not None) for numbers in near if None not in numbers})
    points = [dict(zip(places, numbers, strict=True)) for numbers in candidates]
    return [point for point in points if value_at(target, point) == 0
            and all(_may_hold(situation.substituted(k.value), point) for k in situation.known)]


def kernel_vectors(situation: Situation, zeros: list[Point], block: Block) -> Rows:
    """Vectors that a block's Gram matrix must map to zero, since its weight is positive at zeros of the target."""
    found: Rows = []
    weight = situation.substituted(block.weight.stated)
    parts = [situation.unrooted(b) for b in block.basis]
    for point in zeros:
        factor = value_at(weight, point)
        values = [value_at(root, point) for _, root in parts]
        if factor and all(point.get(i) for i in parts[0][0]):
            found += [[v for v in values if v is not None]] if None not in values else []
    return found


def value_at(polynomial: Polynomial, point: Point) -> Fraction | None:
    """The value at a point, exactly; None where the polynomial has other generators than the point has places."""
    total = Fraction(0)
    for exponents, coefficient in polynomial.terms():
        term = Fraction(int(coefficient.numerator), int(coefficient.denominator))
        for place, power in enumerate(exponents):
            if power and place not in point:
                return None
            term *= point[place] ** power if power else 1
        total += term
    return total


def _may_hold(polynomial: Polynomial, point: Point) -> bool:
    """Whether what is known to be >= 0 is so at a point; points that leave it open are not used."""
    number = value_at(polynomial, point)
    return number is not None and number >= 0


def _minima(polynomial: Polynomial, places: list[int]) -> np.ndarray:
    """Local minima with values near zero, of shape (points, places), by Newton steps along descending directions."""
    gens = [polynomial.ring.gens[i] for i in places]
    slopes = [polynomial.diff(g) for g in gens]
    curvatures = [[slope.diff(g) for g in gens] for slope in slopes]
    points = np.zeros((STARTS, polynomial.ring.ngens))
    spread = np.resize(np.array([0.3, 1.0, 3.0, 10.0]), (STARTS, 1))
    points[:, places] = np.random.default_rng(3).normal(size=(STARTS, len(places))) * spread
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            gradient = np.stack([values_at(s, points)[0] for s in slopes], axis=1)
            hessian = np.stack([np.stack([values_at(c, points)[0] for c in row], axis=1) for row in curvatures], axis=1)
            good = np.all(np.isfinite(hessian), axis=(1, 2)) & np.all(np.isfinite(gradient), axis=1)
            points, gradient, hessian = points[good], gradient[good], hessian[good]
            sizes, vectors = np.linalg.eigh(hessian)
            sizes = np.abs(sizes)
            single = sizes.min(axis=1, initial=np.inf) > SINGLE * sizes.max(axis=1, initial=0.0)
            sizes = np.maximum(sizes, 1e-8 * sizes.max(axis=1, initial=0.0)[:, None] + 1e-30)
            step = np.einsum("kij,kj->ki", vectors, np.einsum("kij,ki->kj", vectors, gradient) / sizes)
            longest = 1.0 + np.linalg.norm(points, axis=1)
            step *= np.minimum(1.0, longest / np.maximum(np.linalg.norm(step, axis=1), 1e-30))[:, None]
            points[:, places] -= step
        values, terms = values_at(polynomial, points)
    # Of minima that are not single, which ones are met is left to chance, and to the last digits of the machine.
    return points[single & (np.abs(values) <= 1e-9 * terms)][:, places]
