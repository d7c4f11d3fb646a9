"""A printed ranking is called reproduced only where the runs tell its members apart."""

from types import SimpleNamespace

import numpy as np
import pytest

from workbench.report.headline import _ranking

NAMES = {"a": "A", "b": "B", "c": "C"}


def rows(means, runs=40, spread=1.0):
    """Rows of a sweep with largest errors of these means; what a run makes hard for one it makes hard for all."""
    generator = np.random.default_rng(5)
    hard = generator.uniform(0, 5, runs)
    return [SimpleNamespace(controller=name, run=run, failed=None, position_error_min=-(mean + hard[run]) / 2,
                            position_error_max=mean + hard[run] + spread * generator.uniform(-0.5, 0.5))
            for name, mean in means.items() for run in range(runs)]


@pytest.mark.parametrize(("means", "runs", "words"), [
    ({"a": 1.0, "b": 2.0, "c": 3.0}, 40, "is reproduced"),
    ({"a": 1.0, "b": 3.0, "c": 2.0}, 40, "is not reproduced"),
    ({"a": 1.0, "b": 2.0, "c": 2.0}, 40, "is neither reproduced nor contradicted (B and C are not told apart)"),
    ({"a": 1.0, "b": 2.0, "c": 3.0}, 3,
     "is neither reproduced nor contradicted (A and B; B and C are not told apart)"),
])
def test_a_ranking_is_said_only_where_intervals_separate(means, runs, words):
    assert _ranking(list("abc"), rows(means, runs), NAMES) == words


def test_two_that_differ_by_less_than_their_runs_scatter_are_level():
    """7.57 against 7.60 mm in 20 runs."""
    assert "not told apart" in _ranking(["a", "b"], rows({"a": 7.57, "b": 7.60}, 20, 0.5), NAMES)


def test_runs_that_fail_are_left_out_and_without_runs_nothing_is_told():
    found = rows({"a": 1.0, "b": 2.0})
    for row in found[:5]:
        row.failed, row.position_error_max = "diverged", 1e9
    assert _ranking(["a", "b"], found, NAMES) == "is reproduced"
    assert "not told apart" in _ranking(["a", "b"], [], NAMES)
