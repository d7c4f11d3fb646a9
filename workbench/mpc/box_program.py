"""Quadratic programs with bounds alone: 1/2 (x - best)'H(x - best) for low <= x <= high, H fixed and positive definite.

A guess of what lies at which bound is solved for the others and mended by the signs that come out, the primal-dual
active set method (Hintermüller, Ito and Kunisch 2003); when nothing is to be mended, the guess is proved right. Where
guesses do not come to rest, projected Newton steps (Bertsekas 1982) go on: what is at a bound and pushed against it
stays, the others take Newton's step, a search along the projected step makes the cost fall. H is inverted once; both
ways solve for the held unknowns or for the free ones, whichever are fewer.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve
from scipy.linalg.lapack import dpotrf, dpotrs

from workbench.errors import SolverError
from workbench.mpc.problem import Array

MOST_GUESSES = 8
MOST_STEPS = 100
# Steps of Armijo's search halve; a step smaller than this part of Newton's is none.
SMALLEST_SHARE = 2.0**-20
# A slope that is this small beside the largest that a step from bound to bound makes is none.
SMALL = 1e-10
Mask = NDArray[np.bool_]


class BoxProgram:
    """The programs of one H, shape (n, n); raises SolverError where it is not positive definite."""

    def __init__(self, H: Array) -> None:
        self._H = np.ascontiguousarray((H + H.T) / 2)
        try:
            inverse = cho_solve(cho_factor(self._H), np.eye(len(H)))
        except (LinAlgError, ValueError):
            raise SolverError("the program's Hessian is not positive definite: give every command a weight") from None
        self._inverse = np.ascontiguousarray((inverse + inverse.T) / 2)
        self._size = float(np.abs(np.diag(self._H)).max())
        # Of what was solved last: the held unknowns and the factor, which the next program often needs again.
        self._held: Mask = np.zeros(0, dtype=bool)
        self._factor: Array | None = None

    def unbounded(self, f: Array) -> Array:
        """`best` of programs whose linear part is f, shape (n,) or (n, programs): the minimiser without bounds."""
        return -self._inverse @ f

    def solve(self, best: Array, low: Array, high: Array, start: Array) -> tuple[Array, int]:
        """The minimiser, and the systems of equations it took; SolverError where there is none or it was not reached.

        start: what lies at a bound in it, or beyond, is the first guess of what does so in the minimiser.
        """
        if not (low <= high).all() or not np.isfinite(best).all():
            raise SolverError("the program has no answer: a lower bound is above its upper one or a number is none")
        found, guesses = self._guessed(best, low, high, start)
        if found is not None:
            return found, guesses
        found, steps = self._stepped(best, low, high, start)
        return found, guesses + steps

    def _guessed(self, best: Array, low: Array, high: Array, start: Array) -> tuple[Array | None, int]:
        """The minimiser by its active set, None where the guesses do not come to rest."""
        small = SMALL * self._size * max(1.0, float(np.abs(high - low).max()))
        near = 1e-12 * max(1.0, float(np.abs(high).max()), float(np.abs(low).max()))
        below, above = start <= low, start >= high
        for guesses in range(1, MOST_GUESSES + 1):
            held = below | above
            x, slope = self._held_at(np.where(above, high, low) - best, held)
            x += best
            # A bound holds what is pushed against it; and holds from now on what has passed it. Of two equal bounds
            # either sign is right.
            wrong = ((below & (slope < -small)) | (above & (slope > small))) & (low < high)
            under, over = ~held & (x < low - near), ~held & (x > high + near)
            if not (wrong.any() or under.any() or over.any()):
                return np.clip(x, low, high), guesses
            below, above = (below & ~wrong) | under, (above & ~wrong) | over
        return None, MOST_GUESSES

    def _held_at(self, apart: Array, held: Mask) -> tuple[Array, Array]:
        """x - best and the slope where the held unknowns are so far apart from the best and the others are free."""
        fixed = np.flatnonzero(held)
        slope = np.zeros(len(apart))
        if not len(fixed):
            return slope.copy(), slope
        if 2 * len(fixed) <= len(apart):
            rows = self._inverse[fixed]
            slope[fixed] = self._solved(rows[:, fixed], apart[fixed], held)
            x = rows.T @ slope[fixed]
        else:
            free = np.flatnonzero(~held)
            x = np.where(held, apart, 0.0)
            if len(free):
                rows = self._H[free]
                x[free] = -self._solved(rows[:, free], rows[:, fixed] @ apart[fixed], held)
            slope[fixed] = self._H[fixed] @ x
        x[fixed] = apart[fixed]
        return x, slope

    def _solved(self, matrix: Array, right: Array, held: Mask) -> Array:
        """The solution of the block that belongs to the held unknowns."""
        if self._factor is None or not np.array_equal(held, self._held):
            factor, trouble = dpotrf(matrix, lower=1, clean=0)
            if trouble:
                raise SolverError("the program's Hessian is hardly positive definite: give every command more weight")
            self._held, self._factor = held, factor
        solved, _ = dpotrs(self._factor, right, lower=1)
        return np.asarray(solved)

    def _stepped(self, best: Array, low: Array, high: Array, start: Array) -> tuple[Array, int]:
        """The minimiser by projected Newton steps."""
        x = np.clip(start, low, high)
        slope = self._H @ (x - best)
        small = SMALL * self._size * max(1.0, float(np.abs(high - low).max()))
        for steps in range(MOST_STEPS):
            held = ((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0))
            if float(np.abs(np.where(held, 0.0, slope)).max()) <= small:
                return x, steps
            x, slope = self._along(x, slope, self._direction(slope, held), low, high)
        raise SolverError(f"no answer after {MOST_STEPS} steps: the weights are too far apart")

    def _direction(self, slope: Array, held: Mask) -> Array:
        """Newton's step of the free unknowns, the held ones at rest."""
        fixed, free = np.flatnonzero(held), np.flatnonzero(~held)
        if len(fixed) > len(free):
            step = np.zeros(len(slope))
            step[free] = -np.linalg.solve(self._H[np.ix_(free, free)], slope[free])
            return step
        pull = np.where(held, 0.0, slope)
        step = -self._inverse @ pull
        if len(fixed):
            rows = self._inverse[fixed]
            step -= rows.T @ np.linalg.solve(rows[:, fixed], step[fixed])
            step[fixed] = 0.0
        return step

    def _along(self, x: Array, slope: Array, step: Array, low: Array, high: Array) -> tuple[Array, Array]:
        """The projected step that makes the cost fall enough, and the slope there."""
        share = 1.0
        while True:
            after = np.clip(x + share * step, low, high)
            moved = after - x
            bent = self._H @ moved
            # Exact for a quadratic: no cost is subtracted from another.
            if float(slope @ moved) * (1 - 1e-4) + 0.5 * float(moved @ bent) <= 0 or share < SMALLEST_SHARE:
                return after, slope + bent
            share /= 2
