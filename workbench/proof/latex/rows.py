"""A paper's rows and letters as two tables, and the claims that can be made of them so far.

`rows.toml` has the printed lines in the paper's order, `symbols.toml` what is known of each letter. A row becomes a
goal as soon as it can be read and all its letters are filled in; until then its claim says what is missing.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from workbench.errors import ClaimError, InputError
from workbench.files.toml import FileRecord, Record, Text, load_record
from workbench.proof.claim import D, Goal, Kind
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.question import asked
from workbench.proof.latex.read import read_line
from workbench.proof.latex.statement import parted
from workbench.proof.latex.symbols import Symbols, SymbolsFile, symbols_in
from workbench.proof.latex.tree import Chain, Letter
from workbench.proof.paper import Paper
from workbench.proof.verdict import Verdict

ROWS, SYMBOLS = "rows.toml", "symbols.toml"
# What a row is to the paper: a claim is decided; the others are taken as they are, and named by what rests on them.
Role = Literal["claim", "definition", "dynamics", "assumption", "words"]
TAKEN: dict[Role, str] = {"definition": "taken as a definition of this paper", "dynamics": "taken as the dynamics",
                          "assumption": "an assumption of this paper"}

_LAYOUT = re.compile(r"\\(?:begin|end)\s*\{(?:aligned|split|gathered)\}|(?<!\\)&")


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
    """A row: its number, what it is called, its printed LaTeX, the line as it is read where that differs."""

    id: Text
    title: Text
    role: Role
    printed: Text
    line: Text | None = None
    rests_on: tuple[Text, ...] = ()
    severity: Literal["result", "step"] = "step"
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
        goal = known.goal(row)
    except (LatexError, ClaimError) as trouble:
        paper.unstated(row.id, row.title, row.printed, str(trouble), rests_on=row.rests_on, severity=row.severity)
        return
    paper.claim(row.id, row.title, _kind(goal), row.printed, row.recorded, rests_on=row.rests_on,
                severity=row.severity, where=known.symbols.notation,
                reading=f"Read as {row.line}." if row.line else "")(_giving(goal))


class _Known:
    """What definitions, dynamics and the table of letters give, as far as they are filled in."""

    def __init__(self, folder: Path, rows: tuple[RowEntry, ...], table: dict[str, LetterEntry]) -> None:
        self.table, self.rows = table, {row.id: row for row in rows}
        filled = {letter: entry.kind for letter, entry in table.items() if entry.kind}
        definitions = {left: right for row in rows if row.role == "definition"
                       for left, right in sides_of(text_of(row))}
        flow = {left: right for row in rows if row.role == "dynamics" for left, right in moving_sides(text_of(row))}
        self._defining = definitions
        self.definitions = _in_order(definitions, set(filled))
        self.flow = {letter: right for letter, right in flow.items()
                     if letter in filled and letters_of_text(right) <= filled.keys() | self.definitions.keys()}
        record = SymbolsFile(symbols=filled, definitions=self.definitions, flow=self.flow) if filled else None
        self.symbols = symbols_in(record, folder / SYMBOLS) if record else Symbols({}, {})

    def goal(self, row: RowEntry) -> Goal:
        """The goal of a row; LatexError or ClaimError with what is missing."""
        if row.role == "words":
            raise LatexError("a statement in words: state its goal by hand")
        line = text_of(row)
        assumed = self._assumed(row)
        missing = sorted({letter for text in (line, *map(text_of, assumed)) for letter in self._unknown(text, set())})
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            raise LatexError(f"{SYMBOLS} does not say what {', '.join(missing)} {verb}: fill in kind, or add a row "
                             "of role 'definition'")
        goal = asked(line, self.symbols)
        given = [relation for one in assumed for relation in asked(text_of(one), self.symbols).show]
        goal = replace(goal, assume=(*goal.assume, *given))
        return self._with_inputs(goal) if goal.flow else goal

    def _assumed(self, row: RowEntry) -> list[RowEntry]:
        """The assumptions that a row rests on, by themselves or by the statement in which they stand."""
        named = [self.rows[one] for one in row.rests_on if one in self.rows]
        inside = [self.rows[one] for stated in named if stated.role == "words" for one in stated.rests_on
                  if one in self.rows and stated.title.startswith("Assumption")]
        return [one for one in dict.fromkeys((*named, *inside)) if one.role == "assumption"]

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
            if symbol in goal.flow or entry.role == "constant":
                continue
            if entry.role == "input":
                inputs.append(symbol)
            elif symbol in derived or entry.role == "state":
                raise LatexError(f"{letter} stands in a rate: give it a role in {SYMBOLS}, and a state its dynamics")
        return replace(goal, inputs=tuple(inputs))


def _giving(goal: Goal) -> Callable[[], Goal]:
    def build() -> Goal:
        return goal

    return build


def text_of(row: RowEntry) -> str:
    """The line of a row as it is read."""
    return row.line or row.printed


def letters_of_text(text: str) -> set[str]:
    """The letters of a line, in LaTeX, each with its marks; none of a line that cannot be read."""
    try:
        return {letter_latex(one) for one in _letters(read_line(text))}
    except LatexError:
        return set()


def letter_latex(letter: Letter) -> str:
    """A letter with its marks in LaTeX."""
    text = letter.name
    for accent in letter.accents:
        if accent not in ("dot", "ddot", "dddot"):
            text = rf"\{accent}{{{text}}}"
    return text + (f"_{{{letter.index}}}" if letter.index else "") + (f"^{{{letter.mark}}}" if letter.mark else "")


def _letters(node: Any) -> Iterator[Letter]:
    if isinstance(node, Letter):
        yield node
    elif isinstance(node, tuple):
        for part in node:
            yield from _letters(part)
    elif is_dataclass(node):
        for one in fields(node):
            yield from _letters(getattr(node, one.name))


def sides_of(text: str) -> Iterator[tuple[str, str]]:
    """Of every `letter = expression` in a line the letter, and the expression as it is typed."""
    for letter, right in _equations(text):
        if not set(letter.accents) & {"dot", "ddot", "dddot"}:
            yield letter_latex(letter), right


def moving_sides(text: str) -> Iterator[tuple[str, str]]:
    """Of every `rate of a letter = expression` the letter, and the expression as it is typed."""
    for letter, right in _equations(text):
        if letter.accents[-1:] == ("dot",) and "dot" not in letter.accents[:-1]:
            yield letter_latex(letter), right


def _equations(text: str) -> Iterator[tuple[Letter, str]]:
    try:
        line = read_line(text)
        claimed, conditions = parted(line)
    except LatexError:
        return
    if conditions or any(words not in ((), (",",)) for words in line.separators):
        return
    ends = [*(chain.position for chain in claimed[1:]), len(text)]
    for chain, end in zip(claimed, ends, strict=True):
        if chain.signs == ("=",) and isinstance(chain.sides[0], Letter):
            start = chain.sides[1].position
            right = _LAYOUT.sub(" ", text[_start(text, chain, start):end])
            yield chain.sides[0], " ".join(right.split()).rstrip(",;. \\")


def _start(text: str, chain: Chain, near: int) -> int:
    """Where the right side begins: behind the equality sign."""
    return max(place + len(sign) for sign in ("=", r"\triangleq", r"\coloneqq")
               if (place := text.rfind(sign, chain.position, near + 1)) >= 0)


def _in_order(definitions: dict[str, str], filled: set[str]) -> dict[str, str]:
    """The definitions whose letters are known, each behind those that it uses."""
    found: dict[str, str] = {}
    left = {letter: right for letter, right in definitions.items() if letter not in filled}
    while ready := [letter for letter, right in left.items() if letters_of_text(right) <= filled | found.keys()]:
        for letter in ready:
            found[letter] = left.pop(letter)
    return found


def _kind(goal: Goal) -> Kind:
    if goal.assume:
        return "implication"
    return "identity" if all(one.operator == "==" for one in goal.show) else "inequality"

