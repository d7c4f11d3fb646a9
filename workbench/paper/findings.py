"""Findings of a study: sentences of numbers that its runs may lack; one that lacks any is left out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

from workbench.files.numbers import number

T = TypeVar("T")
R = TypeVar("R")


class LackingError(Exception):
    """What a finding is about was not run, or its run failed."""


def needed(value: T | None) -> T:
    """The value, if there is one; else the finding that asks for it is left out."""
    if value is None:
        raise LackingError
    return value


def found(makers: Sequence[Callable[[R], str | Iterable[str]]], results: R) -> Iterator[str]:
    """What makers of findings say of the results, a sentence or more each, in their order; none of what they lack."""
    for maker in makers:
        try:
            said = maker(results)
            yield from (said,) if isinstance(said, str) else said
        except LackingError:
            continue


def listed(words: Sequence[str]) -> str:
    """`a, b and c`; LackingError where there is nothing to list."""
    if not words:
        raise LackingError
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def span(values: Iterable[float], digits: int = 3) -> str:
    """From the least to the largest, `0.2 to 3.1`, or one number where both read alike; LackingError without any."""
    ordered = sorted(values)
    if not ordered:
        raise LackingError
    low, high = number(ordered[0], digits), number(ordered[-1], digits)
    return low if low == high else f"{low} to {high}"
