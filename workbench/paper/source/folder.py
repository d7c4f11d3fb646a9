"""A paper's folder made from its LaTeX source: rows and letters as tables, decided as far as they are filled in."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath

from workbench.errors import InputError
from workbench.files.text import read_text
from workbench.files.writing import write_text, write_tree
from workbench.paper.new_paper import new_folder
from workbench.paper.source.bounded import bounds_said, unclear_bounds
from workbench.paper.source.bounds import bounded_in
from workbench.paper.source.deciding import (
    as_read,
    asked_of,
    doubted,
    given_otherwise,
    left_out,
    left_to_the_author,
    standings,
)
from workbench.paper.source.document import MOST_SHOWN, TOO_MUCH, Source, read_source
from workbench.paper.source.inferred import letters_with_what_follows
from workbench.paper.source.letters import (
    assumed_formulas,
    defined_in_text,
    functions_in,
    on_condition,
)
from workbench.paper.source.lines import ENDS_WITH_RELATION, system_lines
from workbench.paper.source.macros import SourceError, without_comments
from workbench.paper.source.reading import MOVE
from workbench.paper.source.roles import with_roles
from workbench.paper.source.row import Row, with_numbers
from workbench.paper.source.shown import Standing
from workbench.proof.latex.rows import (
    ROWS,
    SYMBOLS,
    LetterEntry,
    RowEntry,
    first_unreadable,
    is_assumption,
    text_of,
)
from workbench.proof.latex.sides import letters_of_text, sides_of
from workbench.proof.prove import prove
from workbench.proof.selection import targets

MOST_INPUTS = 10  # files, one in the other
_INPUT = re.compile(r"\\(?:input|include)\s*\{([^{}]*)\}")
REMEDY = "name another --out"
_CASES = re.compile(r"(?P<before>.*?)(?:\\left)?\s*(?:\\\{|\\lbrace)?\s*\\begin\s*\{cases\}"
                    r"(?P<lines>.*?)\\end\s*\{cases\}(?:\s*\\right\s*\.)?\s*", re.DOTALL)
_WORDS = re.compile(r"\\(?:text|mbox|textrm)\s*\{\s*(?:if|for|when|otherwise|,)*\s*\}|\\quad|\\qquad", re.IGNORECASE)
_MOVED = re.compile(rf"(?m)^{MOVE}\$([^$]+)\$")
PAPER = '''"""{name}: rows of the paper's source; symbols.toml says what its letters are, rows.toml what each row is.

Citation of the paper: author, title, journal, year.
"""

from workbench.proof.paper import Paper

paper = Paper("{name}", " ".join((__doc__ or "").split("\\n\\n")[1].split()))
'''
CLAIMS = '''"""Every row of rows.toml as a claim: decided where symbols.toml says what its letters are."""

from pathlib import Path

from workbench.proof.latex.rows import state_rows

from ..paper import paper

state_rows(paper, Path(__file__).parents[1])
'''


@dataclass(frozen=True)
class FromSource:
    """What was written: the folder, the verdict of each row, why rows are not decided."""

    folder: Path
    verdicts: Mapping[str, str]
    missing: Mapping[str, str]


def write_from_source(name: str, directory: Path, source: Path) -> FromSource:
    """Write the folder <name> with a row for every numbered piece of a LaTeX source, and decide what can be.

    Raises InputError for a source that cannot be read or has no rows, and as `write_new_paper` does.
    """
    folder = new_folder(name, directory)
    try:
        found = read_source(_with_inputs(read_text(source, "LaTeX"), source))
    except SourceError as trouble:
        raise InputError(source, "", str(trouble)) from None
    rows, letters, standing = rows_and_letters(found)
    if len(rows_text(rows).encode()) > MOST_SHOWN:
        raise InputError(source, "", TOO_MUCH)
    write_tree(folder, {
        PurePath("paper.py"): PAPER.format(name=name).encode(), PurePath("claims/rows.py"): CLAIMS.encode(),
        PurePath(ROWS): rows_text(rows).encode(), PurePath(SYMBOLS): letters_text(letters).encode()}, REMEDY)
    decided = prove(targets([str(folder)]), 1)
    verdicts = {decision.claim.equation: decision.verdict for decision in decided.decisions}
    missing = {one.claim.equation: one.method for one in decided.decisions if one.verdict == "undecided"}
    recorded = []
    otherwise = given_otherwise(rows, verdicts, standing)
    asked = frozenset[str]().union(*(asked_of(row, letters) for row in rows
                                     if row.role == "claim" and verdicts.get(row.id) == "refuted"))
    for row in rows:
        if row.role == "claim":
            left = left_to_the_author(row, verdicts.get(row.id, "undecided"), standing.get(row.id), rows, letters,
                                      otherwise, asked)
            if left:
                verdicts[row.id], missing[row.id] = "undecided", left_out(left)
                recorded.append(row.model_copy(update={"role": "words", "unread": left}))
            else:
                recorded.append(row.model_copy(update={"recorded": verdicts.get(row.id, "undecided"),
                                                       "unread": doubted(row, verdicts, standing)}))
        else:
            recorded.append(row)
    write_text(folder / ROWS, rows_text(recorded), REMEDY)
    return FromSource(folder, verdicts, missing)


def rows_and_letters(found: Source) -> tuple[list[RowEntry], dict[str, LetterEntry], dict[str, Standing]]:
    """The tables of a source before anything is decided, and what may be decided of each displayed formula."""
    made = [(row, entry) for row in found.rows for entry in entries(row, found)]
    facts = found.said.facts()
    standing = standings(made, found, facts)
    rows = with_roles(_with_text([entry for _, entry in made], facts, found.said.limits()), standing, {
        entry.id: row for row, entry in made if row.what == "Equation"}, functions_in(found.text))
    rows = [as_read(row, standing.get(row.id)) for row in rows]
    limits = found.said.limits()
    bounded = [RowEntry(id=f"bound{number}", title=f"Bound {number} in the text", role="assumption", printed=formula)
               for number, formula in enumerate(bounds_said(facts), len(limits) + 1)]
    bounded = _own(bounded, rows)
    said = letters_with_what_follows([*bounded, *rows], facts, found.text)
    unclear = unclear_bounds(facts, [row.printed for row in bounded],
                             [letter for letter, entry in said.items() if entry.role == "constant"])
    rows = [*(row for row in bounded if not {*bounded_in(row.printed)} & unclear), *rows]

    def table() -> dict[str, LetterEntry]:
        known = letters_with_what_follows(rows, facts, found.text)
        return known | {letter: LetterEntry() for letter in unclear & {*known}}

    letters = table()
    while unreadable := first_unreadable(tuple(rows), letters):
        left = {"role": "words", "unread": f"'{unreadable[1]}'"}
        rows = [row.model_copy(update=left) if row.id == unreadable[0] else row for row in rows]
        letters = table()
    return rows, letters, standing


def _with_inputs(text: str, source: Path, depth: int = 0) -> str:
    """A source with the files that it inputs put in, from its own folder; InputError for one that is not there."""
    if depth > MOST_INPUTS:
        raise InputError(source, "", f"inputs itself, or files more than {MOST_INPUTS} deep: put in what they hold")

    def put(found: re.Match[str]) -> str:
        named = found[1].strip()
        path = source.parent / (named if named.endswith(".tex") else f"{named}.tex")
        if PurePath(named).is_absolute() or ".." in PurePath(named).parts or not path.is_file():
            raise InputError(source, "", f"inputs {named!r}, which is no file of its folder: put it there")
        return _with_inputs(read_text(path, "LaTeX"), source, depth + 1)  # as in LaTeX, from the main file's folder

    return _INPUT.sub(put, without_comments(text))


def entries(row: Row, source: Source) -> list[RowEntry]:
    """A row as it stands in the table; a formula of cases is one row for each case, under its condition."""
    title = (f"Equation ({row.number})" if row.number else "Equation without a number") if row.what == "Equation" else (
        f"{row.what} {row.number}".strip() + (f": {row.title}" if row.title else ""))
    def kept(one: Row) -> bool:
        return source.said.kept(one.labels, one.number)

    assumed = {one.id: one for one in source.rows if is_assumption(one.what)}
    examples = {one.id for one in source.rows if "example" in one.what.lower()}
    whole = RowEntry(id=row.id, title=title, role="claim", printed=row.printed or row.what,
                     line=row.line or None, rests_on=row.rests_on,
                     severity="result" if row.what in ("Theorem", "Corollary", "Proposition") else "step")
    if row.what != "Equation":
        inside = tuple(one.id for one in source.rows if one.within == row.id)
        formulas = [whole.model_copy(update={"id": f"{row.id}.formula{number}", "title": f"{title}, formula {number}",
                                             "role": "assumption", "printed": formula, "rests_on": ()})
                    for number, formula in enumerate(assumed_formulas(row.printed), 1)
                    if is_assumption(row.what) and source.said.understood(*row.span) and kept(row)]
        rests = tuple(dict.fromkeys((*row.rests_on, *(one.id for one in formulas),
                                     *(one for one in inside if row.id not in _of(source, one)))))
        printed = with_numbers(row.printed, source.rows) or row.what
        return [whole.model_copy(update={"role": "words", "printed": printed, "rests_on": rests}), *formulas]
    if row.within in assumed:
        stands = not on_condition(assumed[row.within].printed) and kept(assumed[row.within])
        return [whole.model_copy(update={"role": "assumption" if stands else "words"})]
    if row.within in examples:  # of fewer values than the line by itself speaks of
        return [whole.model_copy(update={"role": "words"})]
    for what, parts in (("line", system_lines(row.printed)), ("case", _cases(row.printed))):
        if parts:
            return [whole.model_copy(update={"id": f"{row.id}.{what}{number}", "title": f"{title}, {what} {number}",
                                             "line": line}) for number, line in enumerate(parts, 1)]
    return [whole]


def _of(source: Source, id_: str) -> tuple[str, ...]:
    return next(row.rests_on for row in source.rows if row.id == id_)


def _cases(printed: str) -> list[str]:
    """Each case as a line with its condition; none where the formula has no column of conditions."""
    found = _CASES.fullmatch(printed)
    lines = [line for line in found["lines"].split(r"\\") if line.strip()] if found else []
    if not found or not ENDS_WITH_RELATION.search(found["before"]) or any(line.count("&") != 1 for line in lines):
        return []
    parts = [tuple(_WORDS.sub(" ", part).strip(" ,.;") for part in line.split("&")) for line in lines]
    if not all(value and condition for value, condition in parts):
        return []
    return [" ".join(rf"{found['before']} {value} \text{{if}} {condition}".split()) for value, condition in parts]


def _with_text(rows: list[RowEntry], text: str, limits: list[str]) -> list[RowEntry]:
    """The rows, behind what the running text alone says of their letters: values, rates, and bounds."""
    moves = [found[1] for found in _MOVED.finditer(text)]
    said = [*(RowEntry(id=f"motion{number}", title=f"Motion {number} in the text", role="claim", printed=one)
              for number, one in enumerate(moves, 1)),
            *(RowEntry(id=f"bound{number}", title=f"Bound {number} in the text", role="assumption", printed=one)
              for number, one in enumerate(limits, 1))]
    return _with_definitions([*_own(said, rows), *rows], text)


def _own(said: list[RowEntry], rows: list[RowEntry]) -> list[RowEntry]:
    """Rows of the running text with ids that no printed row has, whatever an author's tags are."""
    taken, found = {row.id for row in rows}, []
    for row in said:
        id_ = row.id
        while id_ in taken:
            id_ += "-text"
        found.append(row.model_copy(update={"id": id_}))
    return found


def _with_definitions(rows: list[RowEntry], text: str) -> list[RowEntry]:
    """The rows, behind those letters that they use and that the running text alone defines."""
    lines = [text_of(row) for row in rows if row.role != "words"]
    given = {letter for row in rows if row.role != "words" for letter, _ in sides_of(text_of(row))}
    known = {letter: formula for letter, formula in defined_in_text(text).items() if letter not in given}
    used: list[str] = []
    while more := [one for one in known if one not in used and any(one in letters_of_text(line) for line in lines)]:
        used += more
        lines += [known[one] for one in more]
    said = [RowEntry(id=f"text{number}", title=f"Definition {number} in the text", role="claim", printed=known[one])
            for number, one in enumerate(used, 1)]
    return [*_own(said, rows), *rows]


def rows_text(rows: list[RowEntry]) -> str:
    """The table of rows as TOML."""
    parts = ["# Every displayed formula and statement of the paper, in its order. role: claim is decided; definition,\n"
             "# dynamics and assumption are taken as they are; words wait for a goal of yours. `line` is what is read\n"
             "# instead of `printed`. `recorded` is the verdict on record.\n"]
    for row in rows:
        values = row.model_dump(exclude_none=True)
        parts.append("[[rows]]\n" + "".join(f"{key} = {_toml(value)}\n" for key, value in values.items()
                                            if value not in ((), "step") and not (
                                                key == "recorded" and row.role != "claim")))
    return "\n".join(parts)


def letters_text(letters: Mapping[str, LetterEntry]) -> str:
    """The table of letters as TOML."""
    width = max((len(_toml(letter)) for letter in letters), default=0)
    lines = [f"{_toml(letter):{width}} = {{ kind = {_toml(entry.kind)}, role = {_toml(entry.role)} }}"
             for letter, entry in letters.items()]
    return ("# What the paper's letters are. kind: real, positive, nonnegative or vector; role: constant, state or\n"
            "# input (may vary in time). Fill in what is empty; letters that a row defines are not listed.\n[letters]\n"
            + "".join(f"{line}\n" for line in lines))


def _toml(value: object) -> str:
    if isinstance(value, (tuple, list)):
        return f"[{', '.join(map(_toml, value))}]"
    text = str(value)
    return json.dumps(text) if "'" in text or any(ord(sign) < 32 for sign in text) else f"'{text}'"
