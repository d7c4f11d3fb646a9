"""Views of a compiled function are numpy's own parts of the array, over the same memory; collection pauses, no more."""

import gc

import numpy as np
import pytest
from numba import njit

from workbench.compile.views import floats_at, integers_at
from workbench.compile.without_collection import without_collection


@njit
def read_and_written(numbers):
    row, table, cube = floats_at(numbers, 1, (4,)), floats_at(numbers, 5, (3, 2)), floats_at(numbers, 11, (2, 3, 4))
    whole = integers_at(numbers, 35, (2, 3))
    total = 0.0
    for i in range(3):
        for j in range(2):
            total += table[i, j] * (1 + i + 10 * j)
    for i in range(2):
        for j in range(3):
            for k in range(4):
                total += cube[i, j, k] * (1 + i + 10 * j + 100 * k)
    row[3], cube[1, 2, 3], whole[1, 0] = -1.5, -2.5, -7
    return total, row.shape, table.shape, cube.shape, whole.shape, cube.strides


def test_views_are_the_parts_that_numpy_gives():
    numbers = np.random.default_rng(1).normal(size=45)
    wanted, table, cube = numbers.copy(), numbers[5:11].reshape(3, 2), numbers[11:35].reshape(2, 3, 4)
    weights = np.add.outer(np.add.outer(1 + np.arange(2), 10 * np.arange(3)), 100 * np.arange(4))
    total = np.sum(table * np.add.outer(1 + np.arange(3), 10 * np.arange(2))) + np.sum(cube * weights)
    wanted[4], wanted[34] = -1.5, -2.5
    wanted[35:41].view(np.int64).reshape(2, 3)[1, 0] = -7
    found, *shapes = read_and_written(numbers)
    assert found == pytest.approx(total, rel=1e-12)
    assert shapes == [(4,), (3, 2), (2, 3, 4), (2, 3), cube.strides]
    assert numbers.tobytes() == wanted.tobytes()


@pytest.mark.parametrize("collecting", [True, False])
def test_collection_is_afterwards_what_it_was_before(collecting):
    before = gc.isenabled()
    try:
        (gc.enable if collecting else gc.disable)()
        with pytest.raises(KeyError), without_collection():
            assert not gc.isenabled()
            raise KeyError
        assert gc.isenabled() == collecting
    finally:
        (gc.enable if before else gc.disable)()
