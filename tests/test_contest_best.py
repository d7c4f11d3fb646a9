"""The first table of a contest's page."""

import numpy as np
import pytest
from contests import common, few, only

from workbench.contest.best_trackers import best_trackers_table
from workbench.contest.matches import METRICS, Match
from workbench.contest.told import Told
from workbench.paper.cells import Phrase, numbers_in


def played(name: str, draw: int, entry: str, value: float) -> Match:
    """A match whose errors are all this value."""
    return Match(name, draw, entry, dict.fromkeys(METRICS, value) | {"stopping_error": 0.0}, None, 1.0, 1.0, {})


def test_the_best_trackers_are_told_with_intervals_and_ties_as_such() -> None:
    """pid alone under one condition; under the other nobody can tell it from pocrac, whose mean is a little larger."""
    small = few(common(), "ten", "noise", seeds=16)
    rng = np.random.default_rng(5)
    noise = {(name, entry): rng.normal(scale=0.3, size=16) for name in ("ten", "noise") for entry in ("pid", "pocrac")}
    level = {("ten", "pid"): 2.0, ("ten", "pocrac"): 4.0, ("noise", "pid"): 2.0, ("noise", "pocrac"): 2.05}
    at_5ms = {entry: [level[name, entry] + noise[name, entry] for name in ("ten", "noise")]
              for entry in ("pid", "pocrac")}
    matches = tuple(played(name, draw, entry, float(values[i][draw])) for entry, values in at_5ms.items()
                    for i, name in enumerate(("ten", "noise")) for draw in range(16))
    matches += tuple(played(name, draw, "mpc_linear", 1.0 + draw) for name in ("ten", "noise") for draw in range(16))
    table = best_trackers_table(Told(small, only(common().world, "pid", "pocrac", "mpc_linear"), matches, None))
    assert table is not None and "95 % intervals" in table.note
    (_, alone, _), (_, tied, _) = table.rows
    values = at_5ms["pid"][0]
    mean, low, high = numbers_in(alone)
    assert isinstance(alone, Phrase) and alone.words == "pid: {} [{}, {}]" and mean == pytest.approx(values.mean())
    # By hand: the normal interval, which BCa's is near for sixteen values of a normal law.
    half = 1.96 * values.std(ddof=1) / 4
    assert low == pytest.approx(mean - half, abs=0.1) and high == pytest.approx(mean + half, abs=0.1)
    assert isinstance(tied, Phrase) and tied.words.startswith("tie: ")
    means = [float(at_5ms[name][1].mean()) for name in ("pid", "pocrac")]
    assert list(numbers_in(tied))[::3] == pytest.approx(sorted(means))
