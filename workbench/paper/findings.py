"""Findings of a study: sentences of numbers that its runs may lack; one that lacks any is left out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

from workbench.files.numbers import number
from workbench.proof import wording

T = TypeVar("T")
R = TypeVar("R")


class LackingError(Exception):
    """What a finding is about was not run, or its run failed."""


def needed(value: T | None) -> T:
    """The value, if there is one; else the finding that asks for it is left out."""
    if value is None:
        raise LackingError
    return value


def required(holds: bool) -> None:
    """Leaves out the finding that asks for it, where something that it says does not hold."""
    if not holds:
        raise LackingError


def some(values: Iterable[T]) -> list[T]:
    """All values, of which there must be one; else the finding that asks for them is left out."""
    if not (every := list(values)):
        raise LackingError
    return every


def found(makers: Sequence[Callable[[R], str | Iterable[str]]], results: R) -> Iterator[str]:
    """What makers of findings say of the results, a sentence or more each, in their order; none of what they lack."""
    for maker in makers:
        try:
            said = maker(results)
            yield from (said,) if isinstance(said, str) else said
        except LackingError:
            continue


def listed(words: Iterable[str]) -> str:
    """`a, b and c`; a finding without any word is left out."""
    return wording.listed(some(words))


def span(values: Iterable[float]) -> str:
    """From the least to the largest, `0.2 to 3.1`; one number where both read alike."""
    every = some(values)
    low, high = number(min(every)), number(max(every))
    return low if low == high else f"{low} to {high}"
