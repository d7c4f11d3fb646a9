"""What the command line shows of a study: its tables, in the shape that the screen has room for, and its findings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE_HEAD
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from workbench.cli.console import err_console, out_console

if TYPE_CHECKING:
    from workbench.paper.results import ResultTable, StudyResult

Lines = Sequence[Sequence[str]]
BESIDE, AROUND = 3, 2  # characters of room between two columns, and at the sides of a table


def print_study(result: StudyResult) -> None:
    """Tables and findings of a study; on standard error a line for every run that failed."""
    from workbench.report.plain_formulas import plain_words

    for table in result.tables:
        out_console.print(result_table(table, plain_words if table.letters else str))
    for finding in result.findings:
        out_console.print(f"• {plain_words(finding)}", highlight=False)
    for run, why in result.failures:
        err_console.print(f"{run}: {why}", style="red", soft_wrap=True, highlight=False)


def result_table(found: ResultTable, shown: Callable[[str], str] = str) -> RenderableType:
    """A study's table, its source beside its title; one that is too wide for the screen with a row a column, and one in
    which words would be broken even so with a row below the other. shown: what is made of the text of a cell."""
    title = shown(f"{found.title} ({found.source})")
    headings, *rows = [tuple(map(shown, line)) for line in (found.headings, *found.text)]
    lines: Lines = [headings, *rows]
    turned = list(zip(*lines, strict=True))
    if _width(lines) > out_console.width and _width(turned) < _width(lines):
        lines, turned = turned, list(lines)
    if _least_width(lines) > out_console.width:
        if _least_width(turned) > out_console.width:
            return _below_each_other(title, headings, rows)
        lines = turned
    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False)
    for column in zip(*lines, strict=True):
        table.add_column(column[0], overflow="fold", min_width=_longest_word(column))
    for row in lines[1:]:
        table.add_row(*row)
    return table


def _width(lines: Lines) -> int:
    """How wide a table of these lines is where no cell is broken."""
    columns = zip(*lines, strict=True)
    return sum(max(len(part) for cell in column for part in cell.split("\n")) + BESIDE for column in columns)


def _least_width(lines: Lines) -> int:
    """How wide a table of these lines is at least where no word is broken."""
    columns = zip(*lines, strict=True)
    return sum(_longest_word(column) + BESIDE for column in columns) + AROUND


def _longest_word(cells: Sequence[str]) -> int:
    return max((len(word) for cell in cells for word in cell.split()), default=0)


def _below_each_other(title: str, headings: Sequence[str], rows: Lines) -> RenderableType:
    """A row below the other, its first cell above the others, each behind the heading of its column."""
    parts: list[RenderableType] = [Text(title, "italic"), ""]
    for first, *others in rows:
        card = Table.grid(padding=(0, 2))
        card.add_column(overflow="fold", max_width=out_console.width // 2)
        card.add_column(overflow="fold")
        for heading, cell in zip(headings[1:], others, strict=True):
            card.add_row(Text(" ".join(heading.split()), "dim"), cell)
        parts += [Text(" ".join(first.split()), "bold"), Padding(card, (0, 0, 1, 2))]
    return Group(*parts)
