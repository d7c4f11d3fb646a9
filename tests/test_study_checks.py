"""What records of studies check: names that are there, entries in order, one key within another, trials run."""

from typing import ClassVar

import pytest
from pydantic import ValidationError

from workbench.paper.checks import LearningTrials, at_most, increasing, one_of


class Trials(LearningTrials):
    SHOWN: ClassVar[tuple[str, ...]] = ("shown", "drawn")
    shown: tuple[int, ...]
    drawn: tuple[int, ...] = ()


def test_what_is_in_order_passes_and_what_is_not_names_the_key():
    increasing("starts_s", (0.0, 1.0, 2.0))
    increasing("starts_s", (0.0, 1.0, 1.0), repeated=True)
    increasing("starts_s", ())
    for values, repeated in (((0.0, 1.0, 1.0), False), ((1.0, 0.0), True)):
        with pytest.raises(ValueError, match="starts_s must increase from entry to entry: sort them"):
            increasing("starts_s", values, repeated)


def test_a_value_lies_up_to_that_of_another_key():
    at_most("low_kg", 2.0, "high_kg", 2.0)
    with pytest.raises(ValueError, match=r"low_kg = 2\.5 is above high_kg = 2: lower it"):
        at_most("low_kg", 2.5, "high_kg", 2.0)


def test_a_name_is_one_of_those_that_are_there():
    one_of("shown", "law", "pd", ("pd", "pid"))
    with pytest.raises(ValueError, match="shown: there is no law 'p': choose one of pd, pid"):
        one_of("shown", "law", "p", ("pd", "pid"))


def test_trials_that_are_named_are_run():
    assert Trials(count=3, shown=(1, 3)).count == 3
    for named in ({"shown": (4,)}, {"shown": (1,), "drawn": (2, 4)}):
        with pytest.raises(ValidationError, match="= 4 is above count = 3: lower it"):
            Trials(count=3, **named)
