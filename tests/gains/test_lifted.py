"""The norm of a lifted trip: against matrices written out and Lanczos."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.gains.lifted import bounded, dense_norm, fixed_gain, lanczos_norm, norm, norms

LENGTH = 2000
FAST = 1 - 2e-5  # a of a train at high speed over a sample of 0.1 s: it hardly forgets


def lifted(a, g, length):
    """I - g L, with L the train's lower triangular map, entry by entry as claim intro.lift has it."""
    matrix = np.zeros((length, length))
    for column in range(length):
        z = 0.0
        for row in range(length):
            z = a * z + g * (row == column)
            matrix[row, column] = (row == column) - z
    return matrix


@settings(max_examples=30)
@given(st.floats(min_value=0.3, max_value=1.0), st.floats(min_value=0.0, max_value=1.9), st.integers(1, 40))
def test_the_recursion_gives_the_norm_of_the_matrix(a, g, length):
    expected = np.linalg.norm(lifted(a, g, length), 2)
    assert norm([fixed_gain(a, g)], length) == pytest.approx(expected, rel=1e-8, abs=1e-10)
    assert dense_norm(fixed_gain(a, g), length) == pytest.approx(expected, rel=1e-10, abs=1e-12)


def test_lanczos_says_when_it_cannot_tell():
    assert lanczos_norm(fixed_gain(1 - 2e-5, 1e-5), LENGTH) is None


@pytest.mark.parametrize("g", [4e-4, 0.244])
def test_at_two_thousand_samples_it_agrees_with_lanczos_and_the_whole_matrix(g):
    of = fixed_gain(FAST, g)
    assert norm([of], LENGTH) == pytest.approx(lanczos_norm(of, LENGTH), rel=1e-9)
    assert norm([of], LENGTH) == pytest.approx(dense_norm(of, LENGTH), rel=1e-9)


def test_many_maps_at_once_are_those_one_by_one():
    gains = np.array([0.0, 1e-3, 0.1, 0.7])
    together = norms([fixed_gain(0.99, gains)], 60)
    assert together == pytest.approx([norm([fixed_gain(0.99, g)], 60) for g in gains], rel=1e-10)


@settings(max_examples=15)
@given(st.integers(0, 2**32 - 1))
def test_a_bound_over_a_range_holds_for_every_sequence_in_it(seed):
    """Damping that changes from sample to sample, errors drawn at random or nearly the worst."""
    low, high, g, length = 0.97, 1.0, 0.02, 50
    theta = norm([fixed_gain(low, g), fixed_gain(high, g)], length)
    rng = np.random.default_rng(seed)
    a = rng.uniform(low, high, length) if seed % 2 else rng.choice([low, high], length)
    matrix = np.eye(length)
    for column in range(length):
        z = 0.0
        for row in range(length):
            z = a[row] * z + g * (row == column)
            matrix[row, column] -= z
    assert np.linalg.norm(matrix, 2) <= theta * (1 + 1e-9)


def test_a_theta_below_the_norm_is_no_bound():
    of = fixed_gain(0.95, 0.3)
    theta = norm([of], 200)
    assert bounded(np.array([theta * (1 - 1e-9), theta * (1 + 1e-9)]), [of], 200).tolist() == [False, True]
