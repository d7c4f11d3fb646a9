"""The stated numbers of a paper's file, exactly as they are written."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import sympy as sp

from workbench.errors import InputError
from workbench.gains.exact import rational


class Stated:
    """A file's numbers by dotted key; a key that is missing or no number is an InputError that names it."""

    def __init__(self, path: Path, data: Mapping[str, Any]) -> None:
        self.path, self.data = path, data

    def entry(self, key: str) -> Any:
        """What stands at a dotted key."""
        found: Any = self.data
        for part in key.split("."):
            if not isinstance(found, dict) or part not in found:
                raise InputError(self.path, key, "is missing: the search of gains needs it")
            found = found[part]
        return found

    def number(self, key: str) -> Fraction:
        """A number as the decimal that is written."""
        return self._exact(key, self.entry(key))

    def numbers(self, key: str) -> list[Fraction]:
        """A list of numbers."""
        found = self.entry(key)
        if not isinstance(found, list):
            raise InputError(self.path, key, "is no list of numbers: correct it")
        return [self._exact(key, value) for value in found]

    def symbols(self, table: str, symbols: Iterable[sp.Symbol]) -> dict[sp.Expr, sp.Expr]:
        """Values of symbols by their names in a table."""
        return {s: rational(self.number(f"{table}.{s}")) for s in symbols}

    def _exact(self, key: str, value: Any) -> Fraction:
        if not isinstance(value, int | float) or isinstance(value, bool) or not abs(value) < 1e300:
            raise InputError(self.path, key, f"{value!r} is no finite number: correct it")
        return Fraction(str(value))
