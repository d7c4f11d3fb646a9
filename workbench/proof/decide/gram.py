"""Sums of squares as linear equations in Gram matrices, over monomial bases kept small.

target = sum_k weight_k * b_k^T Q_k b_k + sum_l free_l * value_l, with Q_k positive semidefinite.

A generator p known >= 0 is written as the square of another one, so that p times a square is a square again:
sign symmetry then splits the bases into the blocks that belong to 1, p, q, p q, ... by itself. Monomials that no
sum of squares can need are dropped: those outside the Newton polytope (seen from a fixed set of directions), then,
again and again, those whose square nothing can cancel.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from sympy.polys.rings import PolyRing

from workbench.proof.decide.atoms import Item
from workbench.proof.decide.laurent import Exponents
from workbench.proof.decide.situation import Polynomial

MOST_CANDIDATES, MOST_PAIRS, MOST_ROWS, MOST_UNKNOWNS = 10_000, 200_000, 30, 900


class TooLargeError(Exception):
    """A program beyond the bounds of this decider; it is not tried."""


@dataclass(frozen=True)
class Weight:
    """What squares are multiplied by: the factor items, and their value in the program and as stated.

    A strict weight is positive and takes part with non-negative numbers instead of squares.
    """

    items: tuple[Item, ...]
    value: Polynomial
    stated: Polynomial
    strict: bool = False


@dataclass(frozen=True)
class Block:
    """One Gram matrix: a weight and the basis, polynomials b_i of the squares' roots."""

    weight: Weight
    basis: tuple[Polynomial, ...]


@dataclass(frozen=True)
class Multiple:
    """A weight that is zero, times a monomial."""

    zero: Weight
    monomial: Polynomial

    @property
    def value(self) -> Polynomial:
        """The polynomial, zero wherever the assumptions hold."""
        return self.zero.value * self.monomial


@dataclass
class Program:
    """Blocks and free multiples of zero polynomials that shall add up to the target.

    `columns` are the values that the unknowns multiply, `places` (block, i, j) with i <= j of a Gram entry or
    (-1, l, l) of a multiple; multiples first, then off-diagonal entries, then diagonal ones.
    """

    target: Polynomial
    blocks: list[Block]
    multiples: list[Multiple] = field(default_factory=list)
    columns: list[Polynomial] = field(default_factory=list)
    places: list[tuple[int, int, int]] = field(default_factory=list)
    rows: dict[Exponents, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.places = [(-1, index, index) for index in range(len(self.multiples))]
        self.columns = [m.value for m in self.multiples]
        entries = [(k, i, j) for k, block in enumerate(self.blocks)
                   for j in range(len(block.basis)) for i in range(j + 1)]
        for k, i, j in sorted(entries, key=lambda e: e[1] == e[2]):
            block = self.blocks[k]
            value = block.weight.value * block.basis[i] * block.basis[j]
            self.places.append((k, i, j))
            self.columns.append(value if i == j else 2 * value)
        monomials = {e for column in (self.target, *self.columns) for e in column}
        self.rows = {e: row for row, e in enumerate(sorted(monomials))}


# --- choosing the bases --------------------------------------------------------------------------------------


def directions(size: int) -> np.ndarray:
    """Integer vectors that polytopes are bounded along, of shape (count, size)."""
    if size <= 5:
        return np.array([w for w in product((-1, 0, 1), repeat=size) if any(w)])
    unit = np.eye(size, dtype=int)
    pairs = [s * unit[i] + t * unit[j] for i in range(size) for j in range(i) for s in (1, -1) for t in (1, -1)]
    rows = [*unit, *-unit, *pairs, np.ones(size, dtype=int), -np.ones(size, dtype=int)]
    return np.array(rows + [row - 1 for row in 2 * unit] + [1 - row for row in 2 * unit])


def support(polynomials: Iterable[Polynomial]) -> np.ndarray:
    """The exponents of polynomials, of shape (monomials, generators)."""
    return np.array(sorted({e for p in polynomials for e in p}), dtype=np.int64)


class Shape:
    """A polytope of exponents, known by its bounds along `directions`."""

    def __init__(self, points: np.ndarray) -> None:
        self.points, self.along = points, directions(points.shape[1]).astype(float)  # whole numbers, multiplied fast
        self.most = (self.along @ points.T).max(axis=1)

    def bases(self, weight: Polynomial, times: int) -> np.ndarray:
        """Exponents m with weight * x^(times m) inside the polytope, of shape (count, generators).

        Where the box around them holds too many, only the middles between two points of the polytope are taken.
        Raises TooLargeError where these are too many as well.
        """
        terms = support([weight])
        room = (self.points.max(axis=0) - terms.max(axis=0)) // times
        if room.min() < 0:
            return np.empty((0, len(room)), dtype=np.int64)
        if np.prod(room + 1.0) <= MOST_CANDIDATES:
            grid = np.stack(np.meshgrid(*(np.arange(n + 1) for n in room), indexing="ij"), axis=-1)
            candidates = grid.reshape(-1, len(room))
        else:
            candidates = self._middles(terms, times)
        slack = self.most - (self.along @ terms.T).max(axis=1)
        return candidates[np.all(times * candidates @ self.along.T <= slack, axis=1)]

    def _middles(self, terms: np.ndarray, times: int) -> np.ndarray:
        """Exponents m with times * m halfway between two points of the polytope, less a term of the weight."""
        if len(self.points) ** 2 * len(terms) > MOST_PAIRS:
            raise TooLargeError
        found = []
        for term in terms:
            left = self.points - term
            left = left[np.all(left >= 0, axis=1)]
            sums = (left[:, None] + left[None]).reshape(-1, left.shape[1])
            found.append(sums[np.all(sums % (2 * times) == 0, axis=1)] // (2 * times))
        return np.unique(np.concatenate(found), axis=0)


def parities(polynomials: Iterable[Polynomial], size: int) -> list[np.ndarray]:
    """Sign changes of generators that leave all polynomials as they are: vectors r with r.e even, a basis."""
    reduced: dict[int, np.ndarray] = {}
    for e in support(polynomials) % 2:
        row = e
        for pivot, known in reduced.items():
            row = (row + known) % 2 if row[pivot] else row
        if row.any():
            pivot = int(np.argmax(row))
            reduced = {p: (k + row) % 2 if k[pivot] else k for p, k in reduced.items()} | {pivot: row}
    kernel = []
    for column in (c for c in range(size) if c not in reduced):
        vector = np.zeros(size, dtype=np.int64)
        vector[column] = 1
        for pivot, row in reduced.items():
            vector[pivot] = row[column]
        kernel.append(vector)
    return kernel


def assemble(ring: PolyRing, target: Polynomial, weights: list[Weight], zeros: list[Weight],
             shape: Shape) -> Program | None:
    """The program with all basis monomials that fit the shape; None when the target is plainly out of reach.

    Raises TooLargeError beyond the bounds of this decider.
    """
    symmetries = parities([target, *(w.value for w in (*weights, *zeros))], ring.ngens)
    even = np.array(symmetries, dtype=np.int64).reshape(-1, ring.ngens)
    groups: list[tuple[Weight, np.ndarray]] = []
    for weight in weights:
        bases = np.zeros((1, ring.ngens), dtype=np.int64) if weight.strict else shape.bases(weight.value, 2)
        kinds, kind_of = np.unique(bases @ even.T % 2, axis=0, return_inverse=True)
        groups += [(weight, bases[kind_of.ravel() == kind]) for kind in range(len(kinds))]
    multiples = []
    for zero in zeros:
        bases = shape.bases(zero.value, 1)
        for m in bases[~np.any(bases @ even.T % 2, axis=1)]:
            multiples.append(Multiple(zero, ring.from_dict({tuple(map(int, m)): 1})))
    kept = _pruned(target, groups, multiples)
    if kept is None:
        return None
    sizes = [len(b) for _, b in kept]
    if max(sizes, default=0) > MOST_ROWS or sum(n * (n + 1) // 2 for n in sizes) + len(multiples) > MOST_UNKNOWNS:
        raise TooLargeError
    blocks = [Block(weight, tuple(ring.from_dict({tuple(map(int, m)): 1}) for m in bases)) for weight, bases in kept]
    return Program(target, blocks, multiples)


def _pruned(target: Polynomial, groups: list[tuple[Weight, np.ndarray]],
            multiples: list[Multiple]) -> list[tuple[Weight, np.ndarray]] | None:
    """The groups without monomials whose squares nothing can cancel; None if a term cannot be matched at all."""
    if sum(len(bases) ** 2 * len(weight.value) for weight, bases in groups) > MOST_PAIRS:
        raise TooLargeError
    ring = target.ring
    highest = 2 * max((int(bases.max()) for _, bases in groups if len(bases)), default=0) + max(
        max(e) for p in (target, *(w.value for w, _ in groups), *(m.value for m in multiples)) for e in p)
    code = [(highest + 1) ** i for i in range(ring.ngens)]  # of an exponent vector: sums of codes are codes of sums
    if (highest + 1) ** ring.ngens >= 2**62:
        raise TooLargeError

    def codes(polynomial: Polynomial, sign: int = 0) -> np.ndarray:
        """Codes of a polynomial's monomials, those with a coefficient of the given sign only if one is given."""
        return np.array([sum(n * c for n, c in zip(e, code, strict=True)) for e, c in polynomial.terms()
                         if not sign or (c > 0) == (sign > 0)], dtype=np.int64)

    wanted, free = codes(target), np.concatenate([codes(ring.zero), *(codes(m.value) for m in multiples)])
    terms = {id(w): (codes(w.value), codes(w.value, 1), codes(w.value, -1)) for w, _ in groups}
    own = [bases @ np.array(code, dtype=np.int64) for _, bases in groups]
    while True:
        crossed, diagonal = [free], {1: [free[:0]], 2: [free[:0]]}
        for (weight, _), monomials in zip(groups, own, strict=True):
            upper = np.triu_indices(len(monomials), 1)
            pairs = np.unique(monomials[upper[0]] + monomials[upper[1]])
            crossed.append(np.add.outer(pairs, terms[id(weight)][0]).ravel())
            for sign in (1, 2):
                diagonal[sign].append(np.add.outer(2 * monomials, terms[id(weight)][sign]).ravel())
        movable = np.unique(np.concatenate([wanted, *crossed]))
        # What positive terms of diagonal entries bring, negative ones and crossings can cancel; and the reverse.
        against = {sign: np.union1d(movable, np.concatenate(diagonal[3 - sign])) for sign in (1, 2)}
        if not np.all(np.isin(wanted, np.concatenate([*crossed, *diagonal[1], *diagonal[2]]))):
            return None
        keep = []
        for (weight, _), monomials in zip(groups, own, strict=True):
            kept = np.full(len(monomials), True)
            for sign in (1, 2):
                reached = np.add.outer(2 * monomials, terms[id(weight)][sign])
                kept &= np.all(np.isin(reached, against[sign]), axis=1)
            keep.append(kept)
        if all(kept.all() for kept in keep):
            return groups
        groups = [(w, bases[kept]) for (w, bases), kept in zip(groups, keep, strict=True) if kept.any()]
        own = [monomials[kept] for monomials, kept in zip(own, keep, strict=True) if kept.any()]
