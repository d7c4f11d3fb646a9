"""Who wins under each condition and at what price, as sentences made of the rows of a study's table of winners."""

from __future__ import annotations

from workbench.files.numbers import NOTHING
from workbench.paper.cells import Column
from workbench.paper.results import ResultTable


def standings(table: ResultTable | None) -> tuple[str, ...]:
    """A sentence a row: its condition, who wins, what the columns say of the winner, and the others at the end.

    table: as `paper/winners.py` makes it: a condition, a winner, then what is told of them, `the others` among it.
    """
    return () if table is None else tuple(_sentence(table, row) for row in table.text)


def parted(sentence: str) -> tuple[str, str]:
    """A sentence as its condition and what is said of it."""
    condition, _, rest = sentence.partition(": ")
    return condition, rest


def _sentence(table: ResultTable, row: tuple[str, ...]) -> str:
    condition, winner, *values = row
    told = [(column, value) for column, value in zip(table.columns[2:], values, strict=True) if value != NOTHING]
    price = [_named(column, value) for column, value in told if column.title != "the others"]
    others = [f"; {column.heading}: {value}" for column, value in told if column.title == "the others"]
    return f"{condition}: {', '.join([winner, *price])}{''.join(others)}."


def _named(column: Column, value: str) -> str:
    return f"{column.title} {value} {column.unit}".strip()
