"""The map from one trial's errors to the next one's, lifted to a whole trip: its 2-norm and what is certified of it.

A trial changes the error x(k) into d x(k) - w(k) with w(k+1) = a(k) w(k) + b x(k), w(0) = 0: a scalar filter. Its norm
over N samples is at most theta when there are numbers p_0, ..., p_N >= 0 with
(d x - w)^2 + p_{k+1} (a w + b x)^2 <= theta^2 x^2 + p_k w^2 for all x, w: a recursion of N steps, no matrix of N rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, svds

from workbench.gains.exact import simplest

Array = NDArray[np.float64]
MOST_RESTARTS = 500


@dataclass(frozen=True)
class Filter:
    """One vertex of the map: a, b, d as above; numbers, or arrays of one shape for many maps at once."""

    a: float | Array
    b: float | Array
    d: float | Array


def fixed_gain(a: float, g: float | Array) -> Filter:
    """Learning with a fixed gain g: e becomes e - z, z(k+1) = a z(k) + g e(k+1); as a `Filter` with w = z - g e."""
    return Filter(a, a * g, 1 - g)


def step(p: Array, theta_squared: Array, vertex: Filter) -> Array:
    """The least p_k for p_{k+1} = p, infinite where there is none; arrays of one shape."""
    with np.errstate(divide="ignore", invalid="ignore"):
        room = theta_squared - vertex.d**2 - p * vertex.b**2
        found = 1 + p * vertex.a**2 + (p * vertex.a * vertex.b - vertex.d) ** 2 / room
    return np.where((room > 0) & np.isfinite(p), found, np.inf)


def bounded(theta: Array, vertices: Sequence[Filter], length: int) -> NDArray[np.bool_]:
    """Whether theta bounds the norm over `length` samples for every sequence a(k) between the vertices; elementwise."""
    p, theta_squared = np.zeros_like(theta), theta**2
    for _ in range(length):
        p = np.max([step(p, theta_squared, vertex) for vertex in vertices], axis=0)
    return np.isfinite(p)  # before the first sample w = 0, so that p there need only exist


def norm(vertices: Sequence[Filter], length: int) -> float:
    """The least theta that is certified, to twelve digits: the norm itself for a single vertex."""
    return float(norms(vertices, length)[0])


def norms(vertices: Sequence[Filter], length: int) -> Array:
    """The same for many maps at once: shape (maps,)."""
    shape = np.broadcast_shapes((1,), *(np.shape(x) for v in vertices for x in (v.a, v.b, v.d)))
    low, high = np.zeros(shape), np.ones(shape)
    while not (good := bounded(high, vertices, length)).all():
        low, high = np.where(good, low, high), np.where(good, high, 2 * high)
    while np.any(high - low > 1e-12 * high):
        grid = low + (high - low) * np.linspace(0, 1, 66)[:, None]
        first = np.maximum(np.argmax(bounded(grid, vertices, length), axis=0), 1)
        places = np.arange(grid.shape[1])
        low, high = grid[first - 1, places], grid[first, places]
    return high


def lanczos_norm(of: Filter, length: int) -> float | None:
    """The same norm by Lanczos on the map and its transpose, each applied as a filter: no bound, but independent.

    None where it does not converge, because the largest singular values are next to equal.
    """
    numerator, denominator = np.array([of.d, -of.d * of.a - of.b]), np.array([1.0, -of.a])

    def forward(x: Array) -> Array:
        return np.asarray(lfilter(numerator, denominator, np.ravel(x)))

    operator = LinearOperator((length, length), matvec=forward, rmatvec=lambda x: forward(np.ravel(x)[::-1])[::-1],
                              dtype=float)
    try:
        found = svds(operator, k=1, return_singular_vectors=False, v0=np.ones(length), maxiter=MOST_RESTARTS)
    except ArpackNoConvergence:
        return None
    return float(found[0])


def dense_norm(of: Filter, length: int) -> float:
    """The same norm by the singular values of the matrix written out, for short trials."""
    matrix = np.eye(length) * of.d
    for column in range(length):
        below = np.arange(length - column - 1)
        matrix[column + 1:, column] = -of.b * of.a**below
    return float(np.linalg.norm(matrix, 2))


def exact_bound(vertices: Sequence[tuple[Fraction, Fraction, Fraction]], theta_squared: Fraction,
                length: int) -> list[Fraction] | None:
    """The numbers p_N, ..., p_0 in exact arithmetic, each rounded upwards; None where there are none.

    A vertex is (a, b, d). Every step is checked in fractions: the room is positive and the determinant not negative.
    """
    p, found = Fraction(0), [Fraction(0)]
    for _ in range(length):
        least = Fraction(0)
        for a, b, d in vertices:
            room = theta_squared - d * d - p * b * b
            if room <= 0:
                return None
            least = max(least, 1 + p * a * a + (p * a * b - d) ** 2 / room)
        above = simplest(float(least) * (1 + 1e-13), 1e-14)
        p = above if above >= least else least
        if not all(_holds(vertex, theta_squared, p, found[-1]) for vertex in vertices):
            return None
        found.append(p)
    return found


def _holds(vertex: tuple[Fraction, Fraction, Fraction], theta_squared: Fraction, now: Fraction,
           later: Fraction) -> bool:
    """(d x - w)^2 + later (a w + b x)^2 <= theta^2 x^2 + now w^2 for all x, w."""
    a, b, d = vertex
    of_x, of_w, cross = theta_squared - d * d - later * b * b, now - 1 - later * a * a, d - later * a * b
    return of_x >= 0 and of_w >= 0 and of_x * of_w >= cross * cross
