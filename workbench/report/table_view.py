"""A table of results, ready to stand on a page."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from workbench.files.numbers import NOTHING
from workbench.paper.results import ResultTable, StudyResult

_NUMBER = re.compile(r"[-+−±≤≥<>~≈\[(]*\s*[\d∞]")
WORDY = 18  # a cell of more letters is words, and may be broken


@dataclass(frozen=True)
class TableView:
    """A table ready to show: `kinds` says of every column whether it holds numbers, short texts or words."""

    anchor: str
    table: ResultTable
    kinds: tuple[str, ...]


@dataclass(frozen=True)
class GainsView:
    """What is known of a paper's gains: tables, and sentences above them."""

    tables: tuple[TableView, ...]
    notes: tuple[str, ...]


def table_views(tables: Iterable[ResultTable], prefix: str = "table") -> list[TableView]:
    """The tables in their order, with anchors `prefix`-1, `prefix`-2, ..."""
    return [_view(f"{prefix}-{number}", table) for number, table in enumerate(tables, start=1)]


def gains_view(result: StudyResult | None) -> GainsView | None:
    """The section on gains, or none."""
    return GainsView(tuple(table_views(result.tables, "gains")), tuple(result.findings)) if result else None


def caption(title: str, source: str, note: str) -> str:
    """A caption of a figure."""
    return f"{title} ({source}). {note}".strip()


def _view(anchor: str, table: ResultTable) -> TableView:
    columns = list(zip(*table.text, strict=True)) if table.rows else [() for _ in table.header]
    return TableView(anchor, table, tuple(map(_kind, columns)))


def _kind(cells: Sequence[str]) -> str:
    """`number` for a column of numbers, `words` for one of sentences, else `text`."""
    if max(map(len, cells), default=0) > WORDY:
        return "words"
    return "number" if all(_NUMBER.match(cell) for cell in cells if cell not in ("", NOTHING)) else "text"
