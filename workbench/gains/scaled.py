"""Families of squares in floats, in units of typical sizes of states and unknowns: what a search is given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

from workbench.gains.problem import Exponents, Family

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Scaled:
    """The families in floats, in scaled units: coefficients = constant + slopes u = sum of the blocks' square forms.

    rows: (constant, slopes) of each family, of shapes (monomials,) and (monomials, unknowns); maps: of each block the
    matrix that makes coefficients of vec(Q); owners: the family of each block; sizes: its rows; tops: what each family
    was divided by.
    """

    families: tuple[Family, ...]
    rows: list[tuple[Array, Array]]
    maps: list[Array]
    owners: list[int]
    sizes: list[int]
    tops: list[float]


def scaled(families: Sequence[Family], state_scales: Sequence[Fraction],
           unknown_scales: Sequence[Fraction]) -> Scaled:
    """The families with states and unknowns in units of their typical sizes, divided by their largest coefficients."""
    rows, maps, owners, sizes, tops = [], [], [], [], []
    for place, family in enumerate(families):
        products = {e for b in family.blocks for one, two in combinations_with_replacement(b.basis, 2)
                    for e in (_sum(one, two, w) for w in b.weight)}
        monomials = sorted(products | set(family.terms))
        size = {e: float(np.prod([float(s) ** n for s, n in zip(state_scales, e, strict=True)])) for e in monomials}
        values = np.array([[float(c * s) for c, s in zip(family.terms[e], (Fraction(1), *unknown_scales), strict=True)]
                           if e in family.terms else [0.0] * (1 + len(unknown_scales)) for e in monomials])
        values *= np.array([[size[e]] for e in monomials])
        tops.append(max(1e-300, float(np.abs(values).max(initial=0.0))))
        values /= tops[-1]
        rows.append((values[:, 0], values[:, 1:]))
        for block in family.blocks:
            n = len(block.basis)
            matrix = np.zeros((len(monomials), n * n))
            for i, one in enumerate(block.basis):
                for j, two in enumerate(block.basis):
                    for e, weight in block.weight.items():
                        whole = _sum(one, two, e)
                        # The weight in the same units; a common factor of a block is of no matter.
                        matrix[monomials.index(whole), i * n + j] += float(weight) * size[whole] / size_of(
                            state_scales, one) / size_of(state_scales, two)
            if n:
                maps.append(matrix / max(1e-300, float(np.abs(matrix).max(initial=0.0))))
                owners.append(place)
                sizes.append(n)
    return Scaled(tuple(families), rows, maps, owners, sizes, tops)


def size_of(scales: Sequence[Fraction], exponents: Exponents) -> float:
    """The typical size of a monomial."""
    return float(np.prod([float(s) ** n for s, n in zip(scales, exponents, strict=True)]))


def _sum(*exponents: Exponents) -> Exponents:
    return tuple(map(sum, zip(*exponents, strict=True)))
