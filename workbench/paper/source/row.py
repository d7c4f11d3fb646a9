"""A piece of a paper's source as a row, and how its references become the rows that it rests on."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field


@dataclass
class Row:
    """A numbered piece of a paper: its id, what it is ("Equation", "Lemma", ...), number, LaTeX as printed, label.

    line: what is read instead, where it goes on from the row before it. within: the id of the theorem or assumption
    in whose text an equation stands; referred: labels that its text, the text before it, or its proof refers to.
    span: from where to where the text of a statement stands in the body. display: the number of the display in which
    an equation stands. aside: whether it stands in the text of a theorem, remark, example or proof; remark: whether in
    that of a remark or example, where no letter is defined.
    """

    id: str
    what: str
    number: str
    printed: str
    labels: tuple[str, ...] = ()
    title: str = ""
    line: str = ""
    within: str = ""
    span: tuple[int, int] = (0, 0)
    display: int = -1
    aside: bool = False
    remark: bool = False
    referred: list[str] = field(default_factory=list)
    rests_on: tuple[str, ...] = ()


_REFERENCE = re.compile(r"\\(eqref|ref)\s*\{([^{}]*)\}")


def with_numbers(text: str, rows: Iterable[Row]) -> str:
    r"""A text with the numbers that LaTeX prints for its references, `\eqref{x}` as (1); one to nothing stays."""
    numbers = {label: row.number for row in rows for label in row.labels if row.number}

    def printed(found: re.Match[str]) -> str:
        number = numbers.get(found[2])
        return found[0] if number is None else f"({number})" if found[1] == "eqref" else number

    return _REFERENCE.sub(printed, text).replace("~", " ")


def resolve(rows: list[Row], groups: dict[str, list[str]]) -> None:
    """Labels become ids; a row rests on earlier rows, a theorem on what its proof names as well, never in a circle."""
    ids = {label: [row.id] for row in rows for label in row.labels} | groups
    chains: dict[str, set[str]] = {}

    def reaches(start: str, goal: str) -> bool:
        seen, left = set(), [start]
        while left:
            one = left.pop()
            if one == goal:
                return True
            if one not in seen:
                seen.add(one)
                left += chains.get(one, ())
        return False

    for row in rows:
        found: list[str] = []
        for one in (one for label in row.referred for one in ids.get(label, ())):
            if one not in found and not reaches(one, row.id):
                found.append(one)
        row.rests_on = tuple(found)
        chains[row.id] = set(found)


def row_id(text: str) -> str:
    """A number as the name of a claim."""
    found = re.sub(r"[^A-Za-z0-9.+-]+", "-", text.replace("'", "prime")).strip("-.+") or "row"
    return found[:60]
