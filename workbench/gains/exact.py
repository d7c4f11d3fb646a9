"""Exact arithmetic around a search: simple rationals near floats, and matrices as sums of squares by LDL^T."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

import sympy as sp

Matrix = list[list[Fraction]]
Square = tuple[Fraction, tuple[Fraction, ...]]  # pivot > 0 and the coefficients of what is squared


def rational(value: Fraction) -> sp.Rational:
    """A fraction as sympy's number."""
    return sp.Rational(value.numerator, value.denominator)


def fraction(value: sp.Expr) -> Fraction:
    """sympy's rational number as a fraction; TypeError for what is none."""
    if not isinstance(value, sp.Rational):
        raise TypeError(f"{value} is no rational number")
    return Fraction(int(value.p), int(value.q))


def simplest(value: float, relative: float) -> Fraction:
    """The rational of the smallest denominator within a relative distance of a float."""
    low, high = sorted(Fraction(value) * (1 + Fraction(sign * relative)) for sign in (-1, 1))
    if low < 0:
        return -_between(-high, -low)
    return _between(low, high)


def _between(low: Fraction, high: Fraction) -> Fraction:
    """The simplest rational of 0 <= low <= x <= high, down the continued fractions of both."""
    whole = math.floor(low)
    if low == whole:
        return Fraction(whole)
    if high >= whole + 1:
        return Fraction(whole + 1)
    return whole + 1 / _between(1 / (high - whole), 1 / (low - whole))


def squares_of(matrix: Matrix) -> list[Square] | None:
    """A symmetric matrix as sum of d l l^T with d > 0, exactly (LDL^T); None when it is not positive semidefinite."""
    rest = [row[:] for row in matrix]
    size, found = len(rest), []
    for pivot in range(size):
        top = rest[pivot][pivot]
        if top < 0 or (top == 0 and any(rest[pivot][pivot:])):
            return None
        if top == 0:
            continue
        row = tuple(Fraction(0) if j < pivot else rest[pivot][j] / top for j in range(size))
        found.append((top, row))
        for i in range(pivot, size):
            for j in range(pivot, size):
                rest[i][j] -= top * row[i] * row[j]
    return found


def solve_exactly(matrix: Matrix, right: Sequence[Fraction]) -> list[Fraction] | None:
    """A solution of matrix x = right by elimination, free unknowns zero; None where there is none."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    width, pivots, done = (len(matrix[0]) if matrix else 0), [], 0
    for column in range(width):
        place = next((i for i in range(done, len(rows)) if rows[i][column]), None)
        if place is None:
            continue
        rows[done], rows[place] = rows[place], rows[done]
        rows[done] = [x / rows[done][column] for x in rows[done]]
        for i, row in enumerate(rows):
            if i != done and row[column]:
                rows[i] = [x - row[column] * y for x, y in zip(row, rows[done], strict=True)]
        pivots.append(column)
        done += 1
    if any(row[-1] for row in rows[done:]):
        return None
    found = [Fraction(0)] * width
    for row, column in zip(rows, pivots, strict=False):
        found[column] = row[-1]
    return found
