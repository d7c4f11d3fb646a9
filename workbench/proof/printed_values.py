"""Values that a paper's files state, held against the numbers that the paper prints."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, equal


def exact_decimal(value: float) -> Fraction:
    """A stated value as the decimal that it is written as."""
    return Fraction(str(value))


@dataclass(frozen=True)
class PrintedValues:
    """Stated values (`at` of a claim) and what makes the goal that each is the number that is printed."""

    at: dict[sp.Expr, Fraction]
    goal: Callable[[], Goal]


def as_printed(values: Mapping[str, tuple[float, str]]) -> PrintedValues:
    """Of values by the names of their symbols: what a file states, and the decimal that is printed.

    A number that is changed in the file makes the claim fail.
    """
    symbols = {sp.Symbol(name, real=True): pair for name, pair in values.items()}
    return PrintedValues(
        {symbol: exact_decimal(value) for symbol, (value, _) in symbols.items()},
        lambda: Goal(tuple(equal(symbol - sp.Rational(text), 0) for symbol, (_, text) in symbols.items())))
