"""What records of studies check beyond the bounds of single values; each message names the key and the remedy."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import ClassVar, Self

from pydantic import model_validator

from workbench.files.toml import Count, SourcedRecord


def one_of(key: str, what: str, name: object, known: Iterable[object]) -> None:
    """ValueError where what a key names is not there: a law, a reading, a case."""
    if name not in (among := list(known)):
        raise ValueError(f"{key}: there is no {what} {name!r}: choose one of {', '.join(map(str, among))}")


def increasing(key: str, values: Iterable[float], repeated: bool = False) -> None:
    """ValueError where values of entries, in their order, do not increase; repeated: they may stay the same."""
    if any(after < before or (after == before and not repeated) for before, after in pairwise(values)):
        raise ValueError(f"{key} must increase from entry to entry: sort them")


def at_most(key: str, value: float, limit_key: str, limit: float) -> None:
    """ValueError where the value of one key lies above that of another."""
    if value > limit:
        raise ValueError(f"{key} = {value:g} is above {limit_key} = {limit:g}: lower it")


class LearningTrials(SourcedRecord):
    """The trials of laws that learn: how many; SHOWN: the fields that name some of them."""

    SHOWN: ClassVar[tuple[str, ...]] = ("shown",)
    count: Count

    @model_validator(mode="after")
    def _shown_trials_are_run(self) -> Self:
        for key in self.SHOWN:
            for trial in getattr(self, key):
                at_most(key, trial, "count", self.count)
        return self
