"""What result tables hold: numbers with their units, words, and words with numbers in them. Text is made late."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from workbench.files.numbers import NOTHING, number


@dataclass(frozen=True)
class Column:
    """What a column holds; the unit its numbers are shown in, and what one of that unit is in SI.

    Cells of the column hold SI numbers: `Column("energy", "kWh", 3.6e6)` takes joules. digits: significant ones shown.
    """

    title: str
    unit: str = ""
    si: float = 1.0
    digits: int = 3

    @property
    def heading(self) -> str:
        """As the table is headed."""
        return f"{self.title} ({self.unit})" if self.unit else self.title


@dataclass(frozen=True)
class Quantity:
    """A number in SI with the unit it is shown in, where that is not its column's; None for what there is not."""

    value: float | None
    unit: str = ""
    si: float = 1.0
    digits: int = 3


@dataclass(frozen=True)
class Phrase:
    """Words with numbers in them, `Phrase("{} → {}", (235.0, 9.56))`: plain numbers are of the column's unit."""

    words: str
    numbers: tuple[float | Quantity | None, ...]


# A plain number is of the column's unit; None: there is no such number.
Cell = str | float | None | Quantity | Phrase


def numbers_in(cell: Cell) -> Iterator[float]:
    """All numbers of a cell, SI."""
    if isinstance(cell, Phrase):
        for part in cell.numbers:
            yield from numbers_in(part)
    elif isinstance(cell, Quantity):
        yield from numbers_in(cell.value)
    elif isinstance(cell, int | float):
        yield cell


def cell_text(cell: Cell, column: Column) -> str:
    """A cell as it is shown; a plain number without its unit, which stands in the heading."""
    match cell:
        case str():
            return cell
        case None:
            return NOTHING
        case Quantity():
            if cell.value is None:
                return NOTHING
            shown = _shown(cell.value, cell.si, cell.digits)
            return f"{shown} {cell.unit}".strip()
        case Phrase():
            return cell.words.format(*(cell_text(part, column) for part in cell.numbers))
        case _:
            return _shown(cell, column.si, column.digits)


def cell_value(cell: Cell, column: Column) -> float | str | list[float | None] | None:
    """A cell for programs: a number in the unit it is shown in, all numbers of a phrase, or words."""
    match cell:
        case str() | None:
            return cell
        case Quantity():
            return None if cell.value is None else cell.value / cell.si
        case Phrase():
            parts = [cell_value(part, column) for part in cell.numbers]
            return [part for part in parts if part is None or isinstance(part, int | float)]
        case _:
            return cell if column.si == 1 else cell / column.si


def is_finite(cell: Cell) -> bool:
    """Whether all numbers of a cell are finite, and none stands in it as the word for one that is not."""
    return all(map(math.isfinite, numbers_in(cell))) and cell not in ("nan", "inf", "-inf")


def _shown(value: float, si: float, digits: int) -> str:
    return number(value if si == 1 else value / si, digits)
