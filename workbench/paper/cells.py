"""What result tables hold: numbers with their units, words, and words with numbers in them. Text is made late."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from workbench.files.numbers import NOTHING, exact, fixed, grouped, number

# Units from the largest: name, what one of it is in SI, from which absolute value in SI on it is used.
LENGTHS = (("m", 1.0, 1.0), ("mm", 1e-3, 1e-3), ("µm", 1e-6, 1e-6), ("nm", 1e-9, 0.0))
FORCES = (("MN", 1e6, 1e7), ("kN", 1e3, 0.0))


@dataclass(frozen=True)
class Column:
    """What a column holds; the unit its numbers are shown in, and what one of that unit is in SI.

    Cells of the column hold SI numbers: `Column("energy", "kWh", 3.6e6)` takes joules. digits: significant ones shown,
    None for all that the number has; decimals: digits after the point, where their number is fixed instead.
    """

    title: str
    unit: str = ""
    si: float = 1.0
    digits: int | None = 3
    decimals: int | None = None

    @property
    def heading(self) -> str:
        """As the table is headed: the title and, unless it names it itself, the unit."""
        shown = f"({self.unit})"
        return f"{self.title} {shown}" if self.unit and shown not in self.title else self.title


@dataclass(frozen=True)
class Quantity:
    """A number in SI with the unit it is shown in, where that is not its column's; None for what there is not.

    si, digits, decimals: as of a Column.
    """

    value: float | None
    unit: str = ""
    si: float = 1.0
    digits: int | None = 3
    decimals: int | None = None


@dataclass(frozen=True)
class Scaled:
    """A number in SI in the unit that fits its size, `LENGTHS` or another scale: two digits, or all before the point.

    None for what there is not.
    """

    value: float | None
    units: tuple[tuple[str, float, float], ...] = LENGTHS

    def __str__(self) -> str:
        """As tables show it, for sentences."""
        return _at_its_scale(self)


@dataclass(frozen=True)
class Phrase:
    """Words with numbers in them, `Phrase("{} → {}", (235.0, 9.56))`: plain numbers are of the column's unit.

    numbers: words too, where what stands in a place is no number.
    """

    words: str
    numbers: tuple[str | float | Quantity | Scaled | None, ...]


# A plain number is of the column's unit; None: there is no such number.
Cell = str | float | None | Quantity | Scaled | Phrase
WORDS = Column("")


def numbers_in(cell: Cell) -> Iterator[float]:
    """All numbers of a cell, SI."""
    if isinstance(cell, Phrase):
        for part in cell.numbers:
            yield from numbers_in(part)
    elif isinstance(cell, Quantity | Scaled):
        yield from numbers_in(cell.value)
    elif isinstance(cell, int | float):
        yield cell


def cell_text(cell: Cell, column: Column = WORDS) -> str:
    """A cell as it is shown; a plain number without its unit, which stands in the heading."""
    match cell:
        case str():
            return cell
        case Phrase():
            return cell.words.format(*(cell_text(part, column) for part in cell.numbers))
        case Scaled():
            return str(cell)
        case Quantity():
            return NOTHING if cell.value is None else f"{_shown(cell.value, cell)} {cell.unit}".strip()
        case _:
            return _shown(cell, column)


def cell_value(cell: Cell, column: Column) -> float | str | list[float | None] | None:
    """A cell for programs: a number in its column's unit, all numbers of a phrase, or words.

    A number that brings its own unit is in SI, whatever it is shown in.
    """
    match cell:
        case str() | None:
            return cell
        case Quantity() | Scaled():
            return cell.value
        case Phrase():
            parts = [cell_value(part, column) for part in cell.numbers]
            return [part for part in parts if part is None or isinstance(part, int | float)]
        case _:
            return cell if column.si == 1 else cell / column.si


def is_finite(cell: Cell) -> bool:
    """Whether all numbers of a cell are finite, and none stands in it as the word for one that is not."""
    return all(map(math.isfinite, numbers_in(cell))) and cell not in ("nan", "inf", "-inf")


def _shown(value: float | None, how: Column | Quantity) -> str:
    if value is None:
        return NOTHING
    shown = value if how.si == 1 else value / how.si
    if how.decimals is not None:
        return fixed(shown, how.decimals)
    return exact(shown) if how.digits is None else number(shown, how.digits)


def _at_its_scale(cell: Scaled) -> str:
    if cell.value is None:
        return NOTHING
    size = abs(cell.value)
    unit, si, _ = next((one for one in cell.units if size >= one[2]), cell.units[-1])
    shown = cell.value / si
    return f"{grouped(f'{shown:.0f}' if abs(shown) >= 10 else f'{shown:.2g}')} {unit}"
