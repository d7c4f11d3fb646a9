"""The gains of jiao2025: certified norms against its own recursion, a grid of gains, and frequencies."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from proofs.jiao2025 import gains
from workbench.files.toml import read_toml
from workbench.gains.lifted import Filter, exact_bound, fixed_gain, norm, norms
from workbench.gains.stated import Stated

FILE = Path(__file__).parents[3] / "proofs" / "jiao2025" / "study.toml"
LENGTH = 2000


@pytest.fixture(scope="module")
def train():
    return gains.train_of(Stated(FILE, read_toml(FILE)), "kN")


def test_fractions_confirm_what_floats_find_and_nothing_beyond(train):
    g = gains.monotone_gain_at(train, LENGTH)
    vertices = [(a, a * g, 1 - g) for a in train.range]
    numbers = exact_bound(vertices, Fraction(1), LENGTH)
    assert numbers is not None
    assert len(numbers) == LENGTH + 1
    beyond = g * Fraction(101, 100)
    assert exact_bound([(a, a * beyond, 1 - beyond) for a in train.range], Fraction(1), LENGTH) is None
    # The standing train alone is what limits it: its norm is above 1 there.
    assert norm([fixed_gain(float(train.slow), float(beyond))], LENGTH) > 1


def test_a_train_of_every_length_stays_monotone_up_to_twice_its_damping(train):
    """|1 - g/(1 - a exp(-iw))| <= 1 for all w just when g <= 2 (1 - a), so no certificate can say more."""
    g, found = gains.monotone_gain(train)
    assert float(g) <= 2 * float(1 - train.slow)
    assert float(g) >= 0.98 * 2 * float(1 - train.slow)
    frequencies = np.concatenate([[0.0], np.geomspace(1e-8, np.pi, 4000)])
    for a in train.range:
        answer = 1 - float(g) / (1 - float(a) * np.exp(-1j * frequencies))
        assert np.abs(answer).max() <= 1 + 1e-12
    assert found.margin > 0


def test_the_difference_law_contracts_as_certified(train):
    """(18) with K_d on the difference, run as a recursion of the train over a whole trip."""
    share, found = gains.best_difference(train)
    theta = float(found.values[gains.contraction]) ** 0.5
    K_p, K_d = (float(k) for k in gains.difference_gains(train, share))
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
    filters = [Filter(*map(float, vertex)) for vertex in gains.inverse_vertices(train, share)]
    assert norm(filters, LENGTH) <= theta


def test_no_gain_of_14_comes_near(train):
    """The least norm of (14) over a trip, on a grid of gains that is not the search's."""
    _, least = gains.best_contraction_at(train, LENGTH)
    grid = np.geomspace(1e-7, 1e-3, 30)
    others = norms([fixed_gain(float(a), grid) for a in train.range], LENGTH)
    assert least <= others.min() + 1e-7
    assert least > 0.9999
