"""Piecewise-linear functions of the position on a line, and their mean over the length of a train."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class AlongLine:
    """A function that is linear between positions and may jump at them; the end values hold beyond the ends.

    position_m: shape (n + 1,), m, increasing; value: shape (n, 2), at the start and the end of each piece.
    """

    position_m: Array
    value: Array

    def mean(self, front_m: Array, length_m: float, inside_m: Array) -> Array:
        """The mean over [front - length, front]; both arrays may have any one shape.

        Of a train without length the value itself; at a jump that of the side on which `inside_m` lies.
        """
        if length_m == 0.0:
            return self._at(front_m, self._piece(inside_m))
        rear = front_m - length_m
        # Within one piece the mean is the value in the middle, free of the cancellation of two long integrals.
        first, last = self._piece(rear), self._piece(np.nextafter(front_m, -np.inf))
        across = (self._integral(front_m) - self._integral(rear)) / length_m
        inside = (first == last) & (rear >= self.position_m[0])
        return np.where(inside, self._at(front_m - length_m / 2, first), across)

    def _piece(self, x: Array) -> NDArray[np.intp]:
        return np.clip(np.searchsorted(self.position_m, x, side="right") - 1, 0, len(self.value) - 1)

    def _at(self, x: Array, piece: NDArray[np.intp]) -> Array:
        start, end = self.position_m[piece], self.position_m[piece + 1]
        share = np.clip((x - start) / (end - start), 0.0, 1.0)
        low, high = self.value[piece, 0], self.value[piece, 1]
        return np.asarray(low + share * (high - low))

    def _integral(self, x: Array) -> Array:
        """The integral from the first position to x; negative behind it."""
        widths = np.diff(self.position_m)
        whole = np.concatenate(([0.0], np.cumsum(widths * self.value.mean(axis=1))))
        piece = self._piece(x)
        inside = np.clip(x, self.position_m[0], self.position_m[-1])
        part = (inside - self.position_m[piece]) * (self.value[piece, 0] + self._at(inside, piece)) / 2
        beyond = (x - inside) * np.where(x < inside, self.value[0, 0], self.value[-1, 1])
        return np.asarray(whole[piece] + part + beyond)


def steps(start_m: Sequence[float], value: Sequence[float], end_m: float) -> AlongLine:
    """A piecewise-constant function: value k holds from start_m[k] on, the last one up to end_m."""
    return AlongLine(np.array([*start_m, end_m]), np.repeat(np.array(value, dtype=float)[:, None], 2, axis=1))
