"""Tables that most studies have: a run a row, what is printed beside what was obtained, what assumed values do."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

from workbench.paper.cells import Cell, Column, Phrase, Quantity
from workbench.paper.results import ResultTable

T = TypeVar("T")
# A column of a table of runs: its heading, and what it says of a run.
ColumnOf = tuple[Column | str, Callable[[T], Cell]]


def printed_columns(quantities: Sequence[Column], ratio: bool = False) -> tuple[Column, ...]:
    """For each quantity what the paper prints, with all its digits, what was obtained and, if asked, their ratio."""
    return tuple(column for quantity in quantities for column in (
        replace(quantity, title=f"{quantity.title} printed", digits=None), replace(quantity, title="obtained"),
        *((Column("ratio"),) if ratio else ())))


def printed_cells(pairs: Iterable[tuple[float | None, float | None]], ratio: bool = False) -> tuple[Cell, ...]:
    """The cells under `printed_columns` of (printed, obtained) in SI; None for what there is not."""
    return tuple(cell for printed, obtained in pairs for cell in (
        printed, obtained, *((obtained / printed if printed and obtained is not None else None,) if ratio else ())))


def run_table(title: str, source: str, labels: Sequence[Column | str], runs: Iterable[tuple[Sequence[Cell], T]],
              columns: Iterable[ColumnOf[T]], note: str = "") -> ResultTable:
    """A table of one run a row: what names the run, then what each column says of it.

    labels: the headings of what names a run; runs: those cells and the run; columns: a heading and its cell of a run.
    """
    says = list(columns)
    return ResultTable(title, source, (*labels, *(heading for heading, _ in says)), tuple(
        (*names, *(cell(run) for _, cell in says)) for names, run in runs), note)


def statement_table(title: str, source: str, runs: Mapping[str, T],
                    statements: Iterable[tuple[str, str, Callable[[T], Cell]]], note: str) -> ResultTable:
    """What a paper says in words beside what came out in runs, by their titles.

    statements: what it says, where it says so, and what a run says of it.
    """
    return ResultTable(title, source, ("Statement", "Printed", *runs), tuple(
        (statement, printed, *map(says, runs.values())) for statement, printed, says in statements), note)


def verdict(holds: bool, words: str, numbers: Sequence[float | Quantity | None]) -> Phrase:
    """Whether a statement holds, and the numbers that say so."""
    return Phrase(f"{'yes' if holds else 'no'}: {words}", tuple(numbers))


def sensitivity_table(title: str, header: Sequence[Column | str],
                      entries: Iterable[tuple[str, Iterable[Sequence[Cell]]]], note: str) -> ResultTable:
    """What each change of assumed values does; entries: (the change in words, its rows without these)."""
    return ResultTable(title, "sensitivity, not in the paper", ("change", *header),
                       tuple((change, *row) for change, rows in entries for row in rows), note)
