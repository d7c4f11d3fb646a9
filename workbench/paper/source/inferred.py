"""What follows of letters of which a text says little: that they are numbers, and that gains do not move."""

from __future__ import annotations

import re
from collections.abc import Iterator

from workbench.paper.source.letters import (
    INLINE,
    kinds_in,
    printed_of_time,
    rated,
    said_of,
    table_of,
    valued_elsewhere,
)
from workbench.paper.source.reading import DEFINE, MOVE
from workbench.proof.latex.rows import LetterEntry, RowEntry, text_of
from workbench.proof.latex.scalars import scalar_letters
from workbench.proof.latex.sides import letters_of_text, moving_sides, sides_of

# What a letter may be called that is a number, and not any real one.
_NO_REAL = re.compile(
    r"\b(?:integers?|natural|complex|matri(?:x|ces)|vectors?|ind(?:ex|ices)|orders?|degrees?|dimensions?|numbers? of|"
    r"binary|boolean|logical|probabilit\w+|modes?|signs?|functionals?|operators?|sequences?|sets?|phasors?|switch\w*|"
    r"fractions?|ratios?|percentages?|negative|nonzero|non-zero|not|definite|semidefinite|small\w*|large\w*|unit)\b",
    re.IGNORECASE)


def letters_with_what_follows(rows: list[RowEntry], facts: str, text: str) -> dict[str, LetterEntry]:
    """Every letter of the rows, as `table_of`, with what its words and the formulas that are taken show besides.

    A letter is real where it is shown to be a number and its words say nothing else of it; constant where a law states
    its sign and nothing else is ever said of it, as of the gains in `with $k, c > 0$`.
    """
    entries = table_of(rows, facts, text)
    taken = [row for row in rows if row.role in ("definition", "dynamics", "assumption")]
    said, moved = said_of(facts), {letter for row in taken for sides in (sides_of, moving_sides)
                                   for letter, _ in sides(text_of(row))}
    bound = {letter for row in taken if row.role == "assumption" for letter in letters_of_text(text_of(row))} - {*said}
    unclear = {*valued_elsewhere(text)} - moved
    numbers = scalar_letters(map(text_of, taken), {
        letter for letter, entry in entries.items() if entry.kind not in ("", "vector")})
    fixed = {*_signed_alone(facts)} - printed_of_time(text, rows) - rated(rows)
    found = {}
    for letter, entry in entries.items():
        told = letter in moved | bound or (letter in said and not _NO_REAL.search(said[letter]))
        kind = "real" if not entry.kind and letter in numbers - unclear and told else entry.kind
        role = "constant" if not entry.role and letter in fixed else entry.role
        found[letter] = entry.model_copy(update={"kind": kind, "role": role})
    return found


def _signed_alone(facts: str) -> Iterator[str]:
    """The letters of which all that is ever said is their sign."""
    other: set[str] = set()
    signed: set[str] = set()
    for fact in (part for whole in facts.split("\n\n")
                 if not whole.startswith((DEFINE, MOVE)) for part in _parts(whole)):
        formulas = [inline[1] or inline[2] for inline in INLINE.finditer(fact)]
        kinds = [dict(kinds_in(one.strip(" .,;"))) for one in formulas]
        bare = not INLINE.sub(" ", fact).strip(" .,;") and all(one and "real" not in one.values() for one in kinds)
        (signed if bare else other).update(letter for one in formulas for letter in letters_of_text(one))
    yield from signed - other


def _parts(fact: str) -> Iterator[str]:
    """A fact in its parts: what it says in the singular is said of its last letter alone."""
    before, is_, behind = fact.partition(" is ")
    *first, last = before.split(" and ")
    yield from first
    yield f"{last}{is_}{behind}"
