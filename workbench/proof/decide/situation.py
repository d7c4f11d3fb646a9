"""What a search for sums of squares starts from: polynomials of known sign in one ring, and one to be shown.

Two coordinates are used. Goals and certificates speak of the ring's generators. Programs speak of *roots*: there a
generator known >= 0 is the square of the one at its place, so that p times a square is a square again, and every
generator is scaled by a power of two, so that coefficients of very different sizes come near each other.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from sympy.polys.rings import PolyRing

from workbench.proof.decide.atoms import Item
from workbench.proof.text import text

Polynomial = Any  # sympy.polys.rings.PolyElement over the rationals
SAMPLES = 4_000
WIDE = 4.0  # from this spread of coefficients on, in powers of two, generators are scaled


@dataclass(frozen=True)
class Signed:
    """A polynomial, the factor items whose product it is, and its sign: > 0, >= 0 or == 0."""

    items: tuple[Item, ...]
    value: Polynomial
    sign: str


@dataclass(frozen=True)
class Substitution:
    """A generator, by place, and the polynomial it equals, because `difference` = generator - value is zero.

    `cofactors` say why: difference is the sum of their products with the equalities stated.
    """

    place: int
    value: Polynomial
    difference: Polynomial
    cofactors: tuple[Polynomial, ...]


@dataclass(frozen=True)
class Situation:
    """target >= 0 (> 0 if strict) is to be shown, target being `multiplier` times the margin.

    `signs` gives, by place in the ring, the item of a generator known >= 0 and whether it is known > 0. `zeros` are
    all equalities; `substitutions`, which follow from them, are not made in `target` and `known` themselves, and
    `known` leaves out what they use up. `sampled` says that the ring's generators are symbols, free of each other.
    """

    ring: PolyRing
    target: Polynomial
    strict: bool
    multiplier: tuple[Item, ...]
    known: tuple[Signed, ...]
    signs: dict[int, tuple[Item, bool]]
    names: tuple[sp.Symbol, ...]
    sampled: bool
    zeros: tuple[Signed, ...] = ()
    substitutions: tuple[Substitution, ...] = ()
    scales: tuple[int, ...] = ()

    def text(self, value: Polynomial) -> str:
        """A polynomial of the ring in the certificate language."""
        return text(value.as_expr(*self.names))

    def substituted(self, value: Polynomial) -> Polynomial:
        """A polynomial with every substitution made."""
        for s in self.substitutions:
            value = value.compose(self.ring.gens[s.place], s.value)
        return value

    def rooted(self, value: Polynomial) -> Polynomial:
        """A polynomial in the coordinates of programs."""
        terms = {tuple(2 * n if i in self.signs else n for i, n in enumerate(e)): c for e, c in value.terms()}
        return self.ring.from_dict({e: c * self._scale(e) for e, c in terms.items()})

    def unrooted(self, value: Polynomial) -> tuple[list[int], Polynomial]:
        """Places p, q, ... and a polynomial r of the ring, such that p q ... r^2 is the square of a program's root.

        The exponents of a root's monomials must have the same parity at every place known >= 0.
        """
        lead = next(iter(value))
        odd = [i for i in self.signs if lead[i] % 2]
        return odd, self.ring.from_dict({tuple(n // 2 if i in self.signs else n for i, n in enumerate(e)):
                                         c / self._scale(e) for e, c in value.terms()})

    def coordinate(self, place: int, root: float) -> float:
        """A generator's value from that in the coordinates of programs."""
        number = root * 2.0 ** (self.scales[place] if self.scales else 0)
        return number**2 if place in self.signs else number

    def _scale(self, exponents: tuple[int, ...]) -> Any:
        return sp.QQ(2) ** sum(s * n for s, n in zip(self.scales, exponents, strict=False))

    def balance(self) -> tuple[int, ...]:
        """Scales, as powers of two, that bring the target's coefficients together; none where they are near already."""
        rows = [(*e, 1) for e in self.rooted(self.substituted(self.target))]
        sizes = [float(np.log2(abs(float(c)))) for c in self.substituted(self.target).coeffs()]
        if max(sizes) - min(sizes) < WIDE:
            return ()
        fit = np.linalg.lstsq(np.array(rows, dtype=float), np.array(sizes), rcond=1e-9)[0]
        return tuple(-round(float(s)) for s in fit[:-1])

    def multiples(self, rest: Polynomial) -> list[tuple[tuple[Item, ...], Polynomial]] | None:
        """rest as a sum of multiples of equalities, given by their items, that substitution finds, or None."""
        factors = [self.ring.zero] * len(self.zeros)
        for s in self.substitutions:
            after = rest.compose(self.ring.gens[s.place], s.value)
            quotient = (rest - after).exquo(s.difference)
            factors = [f + quotient * c for f, c in zip(factors, s.cofactors, strict=True)]
            rest = after
        if rest:
            return None
        return [(zero.items, factor) for zero, factor in zip(self.zeros, factors, strict=True)]

    def false_somewhere(self) -> bool:
        """Whether sampling finds a point where everything known holds and the target is negative.

        Only a filter that spares hopeless attempts: a goal is refuted elsewhere, exactly.
        """
        if not self.sampled or any(k.sign == "==" for k in self.known):
            return False
        rng, size = np.random.default_rng(1), self.ring.ngens
        points = rng.normal(size=(SAMPLES, size)) * rng.choice([0.1, 1.0, 1.0, 10.0], size=(SAMPLES, size))
        points[::2] = rng.integers(-3, 4, size=points[::2].shape)
        signed = list(self.signs)
        points[:, signed] = np.abs(points[:, signed]) + 1e-3
        for known in self.known:
            points = points[values_at(self.substituted(known.value), points)[0] > 0]
        values, sizes = values_at(self.substituted(self.target), points)
        return bool(np.any(values < -1e-9 * sizes))


def values_at(polynomial: Polynomial, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values at points, and the sums of the terms' sizes; both of shape (points,)."""
    values, sizes = np.zeros(len(points)), np.zeros(len(points))
    for exponents, coefficient in polynomial.terms():
        term = np.full(len(points), float(coefficient))
        for i, n in enumerate(exponents):
            if n:
                term *= points[:, i] ** n
        values, sizes = values + term, sizes + np.abs(term)
    return values, sizes
