"""Tests of one file run in one process, those that are named as sharing nothing are there; and what ran before a
property test in its process changes none of its examples."""

from pathlib import Path

import pytest
from hypothesis.internal.conjecture.providers import HypothesisProvider
from shared_work import APART, unit_of

ROOT = Path(__file__).resolve().parent.parent


@pytest.mark.parametrize("prefix", APART)
def test_every_prefix_names_tests_that_are_there(prefix):
    path, _, name = prefix.partition("::")
    assert f"\ndef {name or 'test_'}" in (ROOT / path).read_text(encoding="utf-8")


def test_a_unit_is_a_file_or_a_test_that_shares_nothing():
    assert unit_of("tests/test_wheel.py::test_one[a::b]") == unit_of("tests/test_wheel.py::test_two") == (
        "tests/test_wheel.py")
    alone = "tests/test_closed_loop.py::test_one[a::b]"
    assert unit_of(alone) == alone


def test_examples_are_no_constants_of_the_modules_that_happen_to_be_imported():
    assert len(HypothesisProvider(None)._local_constants) == 0
