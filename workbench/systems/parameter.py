"""A constant of a plant, and what a value must be to be one's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from workbench.systems.declared import contradicted
from workbench.systems.symbols import Limits, interval, plain, symbols_of


@dataclass(frozen=True)
class Parameter:
    """A constant of a plant: its symbol, value and unit; known: the interval in which it is known to lie.

    Raises ValueError for a value that is no finite number or lies outside the interval.
    """

    symbol: sp.Symbol
    value: float
    unit: str = ""
    known: Limits | None = None

    def __post_init__(self) -> None:
        symbols_of([self.symbol], "parameter")
        where = f"parameter '{self.symbol}'"
        object.__setattr__(self, "value", checked_value(self.symbol, self.value, where))
        if self.known is not None:
            low, high = interval(self.known, f"{where}: known")
            object.__setattr__(self, "known", (low, high))
            if not low <= self.value <= high:
                raise ValueError(f"{where} = {self.value:g} lies outside the known interval [{low:g}, {high:g}]: "
                                 "correct one of them")
            if not (math.isfinite(low) and math.isfinite(high)):
                raise ValueError(f"{where}: known = ({low:g}, {high:g}) has no end: a sweep draws from it, give two "
                                 "finite numbers")
            for end, what in ((low, "begins"), (high, "ends")):  # a sweep draws from it, and gains are proved for it
                if end != 0 and (kind := contradicted(self.symbol, end)):
                    raise ValueError(f"{where}: known {what} at {end:g}, and the symbol is declared {kind}: correct "
                                     "one of them")


def checked_value(symbol: sp.Symbol, value: Any, where: str) -> float:
    """A finite number that is what the symbol is declared; ValueError otherwise."""
    value = plain(value)
    if isinstance(value, bool | complex | str) or not isinstance(value, int | float | np.number):
        raise ValueError(f"{where} = {value!r} is no real number: give one")
    try:
        number = float(value)
    except OverflowError:  # an int of hundreds of digits
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{where} = {number} is not finite: give a number")
    if kind := contradicted(symbol, number):
        raise ValueError(f"{where} = {number:g}, but the symbol is declared {kind}: correct one of them")
    return number
