"""Points with rational coordinates where a polynomial that is never negative vanishes.

There every square of its certificate must vanish as well, which is how tight inequalities become easy: the squares'
roots can be sought among polynomials that are zero at those points. Minima are found in floating point, from fixed
random starts, and count only where the polynomial is zero exactly.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import sympy as sp

from workbench.proof.decide.fractions_near import simplest
from workbench.proof.decide.situation import Polynomial, Situation, values_at

STARTS, STEPS = 48, 30
MOST_TERMS, MOST_PLACES = 80, 6
SURE = 1e-3

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
    points: list[Point] = []
    for row in _minima(rooted, places):
        numbers = [situation.coordinate(i, x) for i, x in zip(places, row, strict=True)]
        point = [simplest(x, SURE) for x in numbers]
        exact = {i: x for i, x in zip(places, point, strict=True) if x is not None}
        if len(exact) == len(places) and exact not in points and value(target, exact) == 0 and all(
                _may_hold(situation.substituted(k.value), exact) for k in situation.known):
            points.append(exact)
    return sorted(points, key=lambda p: tuple(p.values()))


def value(polynomial: Polynomial, point: Point) -> Fraction | None:
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
    number = value(polynomial, point)
    return number is not None and number >= 0


def _minima(polynomial: Polynomial, places: list[int]) -> np.ndarray:
    """Local minima with values near zero, of shape (points, places), by Newton steps along descending directions."""
    gens = [polynomial.ring.gens[i] for i in places]
    slopes = [polynomial.diff(g) for g in gens]
    curvatures = [[slope.diff(g) for g in gens] for slope in slopes]
    points = np.zeros((STARTS, polynomial.ring.ngens))
    points[:, places] = np.random.default_rng(3).normal(size=(STARTS, len(places))) * np.repeat([0.3, 1, 3, 10], STARTS // 4)[:, None]
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            gradient = np.stack([values_at(s, points)[0] for s in slopes], axis=1)
            hessian = np.stack([np.stack([values_at(c, points)[0] for c in row], axis=1) for row in curvatures], axis=1)
            good = np.all(np.isfinite(hessian), axis=(1, 2)) & np.all(np.isfinite(gradient), axis=1)
            points, gradient, hessian = points[good], gradient[good], hessian[good]
            eigenvalues, vectors = np.linalg.eigh(hessian)
            sizes = np.maximum(np.abs(eigenvalues), 1e-12 * np.abs(eigenvalues).max(axis=1, initial=1e-30)[:, None])
            along = np.einsum("kij,ki->kj", vectors, gradient) / sizes
            points[:, places] -= np.einsum("kij,kj->ki", vectors, along)
        values, terms = values_at(polynomial, points)
    return points[np.abs(values) <= 1e-9 * terms][:, places]
