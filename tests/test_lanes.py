"""Vectors in kernels: every lane has the bits of the same expressions of one float."""

import math

import numpy as np
import pytest
from numba import njit
from numba.core.errors import TypingError

from workbench.compile.lanes import lanes_of, sum_of_lanes, where_less

LANES = 4


def of_one(x, y):
    """Whatever generated functions do with numbers."""
    total = 0.0
    total += x * y - x / y
    least = min(0.5, max(-0.5, y))
    return -total + 2 * abs(x) + x**2 + math.sin(x) * math.exp(y) - (1 / 2) * least + 3 / (x - 1.5)


_of_one = njit(of_one, error_model="numpy")


@njit(error_model="numpy")
def in_lanes(x, y, found, less, sums):
    """`of_one`, a choice and the sum of all lanes, row by row."""
    a, b, c, d = lanes_of(x, LANES), lanes_of(y, LANES), lanes_of(found, LANES), lanes_of(less, LANES)
    for row in range(a.shape[0]):
        c[row] = _of_one(a[row], b[row])
        d[row] = where_less(a[row], b[row], 1.0, a[row])
        sums[row] = sum_of_lanes(b[row])


def test_lanes_have_the_bits_of_floats_whatever_they_hold():
    draw = np.random.default_rng(3)
    x, y = draw.normal(size=(2, 50, LANES)) * 10.0 ** draw.integers(-8, 8, (2, 50, LANES))
    x[0], y[0] = (math.inf, -math.inf, math.nan, 0.0), (0.0, -0.0, 1.0, math.nan)
    x[1], y[1] = (1.5, 0.5, -0.5, -0.0), (0.5, -0.5, 0.0, 0.0)
    found, less, sums = np.zeros_like(x), np.zeros_like(x), np.zeros(50)
    in_lanes(x, y, found, less, sums)
    alone = np.array([[_of_one(a, b) for a, b in zip(*rows, strict=True)] for rows in zip(x, y, strict=True)])
    assert np.array_equal(found, alone, equal_nan=True)
    assert np.array_equal(less, np.where(x < y, 1.0, x), equal_nan=True)
    assert np.array_equal(sums, ((y[:, 0] + y[:, 1]) + y[:, 2]) + y[:, 3], equal_nan=True)


def test_a_power_that_is_no_square_has_no_lanes():
    @njit
    def cube(x):
        return lanes_of(x, LANES)[0] ** 3

    with pytest.raises(TypingError):
        cube(np.zeros((1, LANES)))
