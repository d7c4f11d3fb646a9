"""The norm of a lifted trip: against matrices written out, Lanczos, exact fractions, and jiao2025's own recursion."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.jiao2025 import gains as jiao2025
from workbench.gains.lifted import Filter, bounded, dense_norm, exact_bound, fixed_gain, lanczos_norm, norm, norms
from workbench.gains.stated import Stated

FILE = Path(__file__).parents[2] / "benchmarks" / "jiao2025.toml"
LENGTH = 2000


@pytest.fixture(scope="module")
def train():
    return jiao2025.train_of(Stated(FILE), "kN")


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
def test_at_two_thousand_samples_it_agrees_with_lanczos_and_the_whole_matrix(train, g):
    of = fixed_gain(float(train.fast), g)
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


def test_fractions_confirm_what_floats_find_and_nothing_beyond(train):
    g = jiao2025.monotone_gain_at(train, LENGTH)
    vertices = [(a, a * g, 1 - g) for a in train.range]
    numbers = exact_bound(vertices, Fraction(1), LENGTH)
    assert numbers is not None
    assert len(numbers) == LENGTH + 1
    beyond = g * Fraction(101, 100)
    assert exact_bound([(a, a * beyond, 1 - beyond) for a in train.range], Fraction(1), LENGTH) is None
    # The standing train alone is what limits it: its norm is above 1 there.
    assert norm([fixed_gain(float(train.slow), float(beyond))], LENGTH) > 1


def test_a_theta_below_the_norm_is_no_bound():
    of = fixed_gain(0.95, 0.3)
    theta = norm([of], 200)
    assert bounded(np.array([theta * (1 - 1e-9), theta * (1 + 1e-9)]), [of], 200).tolist() == [False, True]


def test_a_train_of_every_length_stays_monotone_up_to_twice_its_damping(train):
    """|1 - g/(1 - a exp(-iw))| <= 1 for all w just when g <= 2 (1 - a), so no certificate can say more."""
    g, found = jiao2025.monotone_gain(train)
    assert float(g) <= 2 * float(1 - train.slow)
    assert float(g) >= 0.98 * 2 * float(1 - train.slow)
    frequencies = np.concatenate([[0.0], np.geomspace(1e-8, np.pi, 4000)])
    for a in train.range:
        answer = 1 - float(g) / (1 - float(a) * np.exp(-1j * frequencies))
        assert np.abs(answer).max() <= 1 + 1e-12
    assert found.margin > 0


def test_the_difference_law_contracts_as_certified(train):
    """(18) with K_d on the difference, run as a recursion of the train over a whole trip."""
    share, found = jiao2025.best_difference(train)
    theta = float(found.values[jiao2025.contraction]) ** 0.5
    K_p, K_d = (float(k) for k in jiao2025.difference_gains(train, share))
    rng = np.random.default_rng(1)
    for a in (float(train.fast), float(train.slow), None):
        errors = np.cumsum(rng.normal(size=LENGTH)) if a else np.ones(LENGTH)
        z, after = 0.0, np.zeros(LENGTH)
        for k in range(LENGTH):
            own = a or rng.uniform(float(train.fast), float(train.slow))
            before = errors[k - 1] if k else 0.0
            z = own * z + float(train.b) * (K_p * errors[k] + K_d * (errors[k] - before))
            after[k] = errors[k] - z
        assert np.linalg.norm(after) <= theta * np.linalg.norm(errors)
    filters = [Filter(*map(float, vertex)) for vertex in jiao2025.inverse_vertices(train, share)]
    assert norm(filters, LENGTH) <= theta


def test_no_gain_of_14_comes_near(train):
    """The least norm of (14) over a trip, on a grid of gains that is not the search's."""
    _, least = jiao2025.best_contraction_at(train, LENGTH)
    grid = np.geomspace(1e-7, 1e-3, 30)
    others = norms([fixed_gain(float(a), grid) for a in train.range], LENGTH)
    assert least <= others.min() + 1e-7
    assert least > 0.9999
