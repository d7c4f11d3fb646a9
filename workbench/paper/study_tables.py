"""Tables that most studies have: what is printed beside what was obtained, and what changes of assumed values do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from workbench.paper.cells import Cell, Column
from workbench.paper.results import ResultTable


def printed_columns(quantities: Sequence[Column], ratio: bool = False) -> tuple[Column, ...]:
    """For each quantity what the paper prints, with all its digits, what was obtained and, if asked, their ratio."""
    return tuple(column for quantity in quantities for column in (
        replace(quantity, title=f"{quantity.title} printed", digits=None), replace(quantity, title="obtained"),
        *((Column("ratio"),) if ratio else ())))


def printed_cells(pairs: Iterable[tuple[float | None, float | None]], ratio: bool = False) -> tuple[Cell, ...]:
    """The cells under `printed_columns` of (printed, obtained) in SI; None for what there is not."""
    return tuple(cell for printed, obtained in pairs for cell in (
        printed, obtained, *((obtained / printed if printed and obtained is not None else None,) if ratio else ())))


def statement_table(title: str, source: str, columns: Sequence[str], rows: Iterable[Sequence[Cell]],
                    note: str) -> ResultTable:
    """What a paper says in words beside what came out; rows: the statement, what is printed, a cell for each column."""
    return ResultTable(title, source, ("Statement", "Printed", *columns), tuple(map(tuple, rows)), note)


def sensitivity_table(title: str, header: Sequence[Column | str],
                      entries: Iterable[tuple[str, Iterable[Sequence[Cell]]]], note: str) -> ResultTable:
    """What each change of assumed values does; entries: (the change in words, its rows without these)."""
    return ResultTable(title, "sensitivity, not in the paper", ("change", *header),
                       tuple((change, *row) for change, rows in entries for row in rows), note)
