"""A paper's rows and letters as two tables, and the claims that can be made of them so far.

`rows.toml` has the printed lines in the paper's order, `symbols.toml` what is known of each letter. A row becomes a
goal as soon as it can be read and all its letters are filled in; until then its claim says what is missing.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import takewhile
from pathlib import Path
from typing import Literal

from pydantic import Field

from workbench.errors import ClaimError, InputError
from workbench.files.toml import FileRecord, Record, Text, load_record
from workbench.proof.claim import D, Goal, Kind
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import spelled
from workbench.proof.latex.question import asked
from workbench.proof.latex.sides import (
    RATES,
    in_order,
    letter_latex,
    letters_in,
    letters_of_text,
    motions_in,
    moving_sides,
    sides_of,
)
from workbench.proof.latex.symbols import Kind as LetterKind
from workbench.proof.latex.symbols import Symbols, SymbolsFile, symbols_in
from workbench.proof.paper import Paper
from workbench.proof.verdict import Verdict

ROWS, SYMBOLS = "rows.toml", "symbols.toml"
# What a row is to the paper: a claim is decided; the others are taken as they are, and named by what rests on them.
Role = Literal["claim", "definition", "dynamics", "assumption", "words"]
TAKEN: dict[Role, str] = {"definition": "taken as a definition of this paper", "dynamics": "taken as the dynamics",
                          "assumption": "an assumption of this paper"}
_ASSUMING = re.compile(r"\b(?:assumptions?|hypothes[ie]s|conditions?|axioms?|postulates?)\b", re.IGNORECASE)


class LetterEntry(Record):
    """What is known of a letter: its kind and sign, and what it is to the paper; empty where nobody has said.

    role: a constant; a state, which a row of dynamics moves; an input, which may vary in time as it likes.
    """

    kind: Literal["", "real", "positive", "nonnegative", "vector"] = ""
    role: Literal["", "constant", "state", "input"] = ""


class LettersFile(FileRecord):
    """The table of letters, by their LaTeX."""

    letters: dict[Text, LetterEntry] = Field(default_factory=dict)


class RowEntry(Record):
    """A row: its number, what it is called, its printed LaTeX, the line as it is read where that differs.

    unread: what of the paper's text must be read to know whether it is claimed.
    """

    id: Text
    title: Text
    role: Role
    printed: Text
    line: Text | None = None
    rests_on: tuple[Text, ...] = ()
    severity: Literal["result", "step"] = "step"
    unread: Text | None = None
    recorded: Verdict = "undecided"


class RowsFile(FileRecord):
    """All rows in the paper's order."""

    rows: tuple[RowEntry, ...] = Field(min_length=1)


def state_rows(paper: Paper, folder: Path) -> None:
    """State a claim for every row of a folder's `rows.toml`; InputError for what the two tables have wrong."""
    rows, table = load_record(folder / ROWS, RowsFile).rows, load_record(folder / SYMBOLS, LettersFile).letters
    taken: set[str] = set()
    for at, row in enumerate(rows):
        if row.id in taken:
            raise InputError(folder / ROWS, f"rows[{at}].id", f"'{row.id}' is the id of another row too: give each its "
                             "own")
        taken.add(row.id)
    known = _Known(folder, rows, table)
    for at, row in enumerate(rows):
        try:
            _state(paper, known, row)
        except ClaimError as trouble:
            raise InputError(folder / ROWS, f"rows[{at}]", str(trouble)) from None


def _state(paper: Paper, known: _Known, row: RowEntry) -> None:
    """State the claim of one row."""
    if row.role in TAKEN:
        paper.axiom(row.id, row.title, row.printed, TAKEN[row.role], hypotheses=row.rests_on, severity=row.severity)
        return
    try:
        goal, kind = known.goal(row)
    except (LatexError, ClaimError) as trouble:
        paper.unstated(row.id, row.title, row.printed, str(trouble), rests_on=row.rests_on, severity=row.severity)
        return
    paper.claim(row.id, row.title, kind, row.printed, row.recorded,
                premises=tuple(one.id for one in known.assumed(row)), rests_on=row.rests_on,
                severity=row.severity, where=known.symbols.notation,
                reading=_reading(row))(_giving(goal))


def first_unreadable(rows: tuple[RowEntry, ...], table: dict[str, LetterEntry]) -> tuple[str, str] | None:
    """The first row that is taken as a definition or dynamics and cannot be read, and why; None where all can."""
    try:
        _Known(Path(), rows, table)
    except InputError as trouble:
        part, _, letter = trouble.key.partition(".")
        sides = {"definitions": sides_of, "flow": moving_sides}.get(part)
        row = next((row for row in rows if sides and row.role == ("definition" if part == "definitions" else "dynamics")
                    and letter in dict(sides(text_of(row)))), None)
        return (row.id, trouble.problem) if row else None
    return None


class _Known:
    """What definitions, dynamics and the table of letters give, as far as they are filled in."""

    def __init__(self, folder: Path, rows: tuple[RowEntry, ...], table: dict[str, LetterEntry]) -> None:
        self.table, self.rows = dict(table), {row.id: row for row in rows}
        filled = {letter: entry.kind for letter, entry in table.items() if entry.kind}
        definitions = {left: right for row in rows if row.role == "definition"
                       for left, right in sides_of(text_of(row))}
        motions = [one for row in rows if row.role == "dynamics" for one in motions_in(text_of(row))]
        flow = {letter_latex(one.letter): one.rate for one in motions if one.order == 1}
        for one in motions:
            letter = letter_latex(one.letter)
            if one.order == 2 and filled.get(letter, "vector") != "vector" and letter not in flow:
                filled[one.below], self.table[one.below] = "real", LetterEntry(kind="real", role="state")
                flow |= {letter: one.below, one.below: one.rate}
        self._defining = definitions
        self.definitions = in_order(definitions, set(filled))
        self.flow = {letter: right for letter, right in flow.items()
                     if letter in filled and letters_of_text(right) <= filled.keys() | self.definitions.keys()}
        self._let_inputs_move(filled)
        self._leave_out_unmoved()
        inputs = tuple(one for one in filled if one not in self.flow and self.table[one].role == "input")
        record = SymbolsFile(symbols=filled, definitions=self.definitions, flow=self.flow,
                             inputs=inputs) if filled else None
        self.symbols = symbols_in(record, folder / SYMBOLS) if record else Symbols({}, {})

    def _let_inputs_move(self, filled: dict[str, LetterKind]) -> None:
        """Give an input of which a rate is printed, as a reference, rates as letters, the last of which is free.

        All three have letters, since a printed first rate within a definition needs the second one in its rate.
        """
        printed = [one for row in self.rows.values() for one in letters_in(text_of(row)) if one.accents[-1:] and
                   one.accents[-1] in RATES]
        for letter in [one for one, kind in filled.items() if kind != "vector" and self.table[one].role == "input"]:
            rates = [one for one in printed if letter_latex(one) == letter]
            below = letter
            for accent in RATES if rates else ():
                rate = spelled(replace(rates[0], accents=(*rates[0].accents[:-1], accent)))
                filled[rate], self.table[rate] = "real", LetterEntry(kind="real", role="input")
                self.flow[below] = rate
                below = rate

    def _leave_out_unmoved(self) -> None:
        """Leave out rates in which rates stand of letters that have none, yet."""
        def made_of(letter: str) -> set[str]:
            right = self.definitions.get(letter)
            return {letter} if right is None else set().union(*map(made_of, letters_of_text(right)))

        def missing(right: str) -> bool:
            rates = {letter_latex(one) for one in letters_in(right) if set(one.accents) & set(RATES)}
            return any(one not in self.flow and self.table.get(one, LetterEntry()).role != "constant"
                       for one in set().union(*map(made_of, rates)))

        while gone := [letter for letter, right in self.flow.items() if missing(right)]:
            for letter in gone:
                del self.flow[letter]

    def goal(self, row: RowEntry) -> tuple[Goal, Kind]:
        """The goal of a row, and what its line is by itself; LatexError or ClaimError with what is missing."""
        if row.role == "words":
            raise LatexError(f"left to you: {row.unread}; where it is claimed, set its role to 'claim'" if row.unread
                             else "a statement in words: state its goal by hand")
        line = text_of(row)
        if r"\int" in line:
            raise LatexError("an integral is not read: write it as a letter, whose rate a row of role 'dynamics' gives")
        assumed = self.assumed(row)
        missing = sorted({letter for text in (line, *map(text_of, assumed)) for letter in self._unknown(text, set())})
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            raise LatexError(f"{SYMBOLS} does not say what {', '.join(missing)} {verb}: fill in kind, or add a row "
                             "of role 'definition'")
        goal = asked(line, self.symbols)
        kind = _kind(goal)
        given = [relation for one in assumed for relation in asked(text_of(one), self.symbols).show]
        goal = replace(goal, assume=(*goal.assume, *given))
        return self._with_inputs(goal) if goal.flow else goal, kind

    def assumed(self, row: RowEntry) -> list[RowEntry]:
        """The assumptions of a row: those it rests on, by themselves or by the statement in which they stand, and the
        paper's earlier ones that speak of its letters."""
        named = [self.rows[one] for one in row.rests_on if one in self.rows]
        inside = [self.rows[one] for stated in named if stated.role == "words" for one in stated.rests_on
                  if one in self.rows and is_assumption(stated.title)]
        found = [one for one in dict.fromkeys((*named, *inside)) if one.role == "assumption"]
        earlier = [one for one in takewhile(lambda one: one is not row, self.rows.values())
                   if one.role == "assumption" and one not in found and not self._unknown(text_of(one), set())]
        letters = set().union(*(self._speaks_of(text_of(one)) for one in (row, *found)))
        while near := [one for one in earlier if self._speaks_of(text_of(one)) & letters]:
            letters |= set().union(*(self._speaks_of(text_of(one)) for one in near))
            found += near
            earlier = [one for one in earlier if one not in near]
        return found

    def _speaks_of(self, text: str) -> set[str]:
        """The letters of a text, with those of the definitions and rates of its letters."""
        found: set[str] = set()
        left = letters_of_text(text)
        while left:
            letter = left.pop()
            found.add(letter)
            for right in (self._defining.get(letter), self.flow.get(letter)):
                left |= letters_of_text(right) - found if right else set()
        return found

    def _unknown(self, text: str, seen: set[str]) -> set[str]:
        """The letters of a text of which nothing is known, those of a definition instead of the letter it defines."""
        found = set()
        for letter in letters_of_text(text) - seen - self.symbols.notation.keys() - self.definitions.keys():
            seen.add(letter)
            found |= self._unknown(self._defining[letter], seen) if letter in self._defining else {letter}
        return found

    def _with_inputs(self, goal: Goal) -> Goal:
        """The same goal with what may vary in time; a letter of which nobody says whether it moves is refused."""
        by_symbol = {self.symbols.notation[letter]: (letter, entry) for letter, entry in self.table.items()
                     if letter in self.symbols.notation}
        derived = {s for r in goal.relations() for side in (r.left, r.right) for d in side.atoms(D)
                   for s in d.args[0].free_symbols}
        inputs = []
        for symbol in goal.symbols():
            letter, entry = by_symbol.get(symbol, ("", LetterEntry(role="constant")))
            if symbol in goal.flow or (entry.role == "constant" and symbol not in goal.inputs):
                continue
            if entry.role == "input" or symbol in goal.inputs:
                inputs.append(symbol)
            elif symbol in derived or entry.role == "state":
                raise LatexError(f"{letter} stands in a rate: give it a role in {SYMBOLS}, and a state its dynamics")
        return replace(goal, inputs=tuple(inputs))


def is_assumption(title: str) -> bool:
    """Whether a statement is taken as it is, by what it is called: `Standing Assumption 2: bounds`."""
    return _ASSUMING.search(title.partition(":")[0]) is not None


def _giving(goal: Goal) -> Callable[[], Goal]:
    def build() -> Goal:
        return goal

    return build


def _reading(row: RowEntry) -> str:
    """How a row is read, and what of the text may restrict it."""
    return " ".join(filter(None, (f"Read as {row.line}." if row.line else "",
                                  f"The text may restrict it: {row.unread}." if row.unread else "")))


def text_of(row: RowEntry) -> str:
    """The line of a row as it is read."""
    return row.line or row.printed


def _kind(goal: Goal) -> Kind:
    if goal.assume:
        return "implication"
    return "identity" if all(one.operator == "==" for one in goal.show) else "inequality"

