"""Quadratic programs with bounds alone: 1/2 x'Hx + f'x for low <= x <= high, H fixed and positive definite.

Projected Newton steps (Bertsekas 1982): what is at a bound and pushed against it stays, the others take Newton's step,
a search along the projected step makes the cost fall. H is inverted once; a step solves for the fixed unknowns or for
the free ones, whichever are fewer.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from workbench.errors import SolverError
from workbench.mpc.problem import Array

MOST_STEPS = 100
# Steps of Armijo's search halve; a step smaller than this part of Newton's is none.
SMALLEST_SHARE = 2.0**-20


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

    def solve(self, f: Array, low: Array, high: Array, start: Array) -> tuple[Array, int]:
        """The minimiser and the Newton steps it took; SolverError where there is none or it was not reached."""
        if not (low <= high).all() or not np.isfinite(f).all():
            raise SolverError("the program has no answer: a lower bound is above its upper one or a number is none")
        x = np.clip(start, low, high)
        slope = self._H @ x + f
        small = 1e-10 * self._size * max(1.0, float(np.abs(high - low).max()))
        for steps in range(MOST_STEPS):
            held = ((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0))
            if float(np.abs(np.where(held, 0.0, slope)).max()) <= small:
                return x, steps
            x, slope = self._along(x, slope, self._direction(slope, held), f, low, high)
        raise SolverError(f"no answer after {MOST_STEPS} steps: the weights are too far apart")

    def _direction(self, slope: Array, held: NDArray[np.bool_]) -> Array:
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

    def _along(self, x: Array, slope: Array, step: Array, f: Array, low: Array, high: Array) -> tuple[Array, Array]:
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
