"""A line of LaTeX cut into what TeX takes for one piece each: commands, letters, digits and signs."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from workbench.proof.latex.commands import (
    ACCENTS,
    DROPPED,
    ENVIRONMENTS,
    EQUIVALENT,
    FONTS,
    FRACTIONS,
    FUNCTIONS,
    IMPLIES,
    KNOWN,
    QUANTIFIERS,
    SILENT,
    TEXTS,
    UPRIGHT,
    WIDE,
)
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.limits import DEEPEST_NESTING, LONGEST_LINE

_NAME = re.compile(r"\s*\{(?P<name>[a-z]+\*?)\}")
_INDENT = r"(?:[\s&]|\\(?:q?quad|enspace)(?![A-Za-z])|\\[,;:!> ])*"
_GOES_ON = re.compile(_INDENT + r"([=<>+\-/]|\.(?!\d)|"
                      r"\\(end|le|leq|ge|geq|lt|gt|ne|neq|cdot|times|to|in|pm|Rightarrow)(?![A-Za-z]))")
_SIGNED = re.compile(_INDENT + r"[+-]")
_RELATED = re.compile(r"[=<>]|\\(le|leq|leqslant|ge|geq|geqslant|lt|gt|ne|neq|in)(?![A-Za-z])")
_SAYS = frozenset((":", "colon", *IMPLIES, *EQUIVALENT, *QUANTIFIERS))
_PIECE = re.compile(r"\\tag\*|\\[A-Za-z]+|\\.|\s+|.", re.DOTALL)
_NUMBERED = re.compile(r"\\q?quad[\s\\,;~]*\((\d+[a-z]?|[A-Z]\.?\d+)\)[\s.,]*$")  # an equation's number, at its end


@dataclass(frozen=True)
class Piece:
    """A command (without its backslash), a single character, or a text; one without text sets apart what follows."""

    kind: str  # command, letter, digit, sign, open, close, text, apart
    text: str
    position: int


def scan(line: str) -> list[Piece]:
    """The pieces of a line, spaces left out; raises LatexError for one too long, too deep or without its braces."""
    if len(line) > LONGEST_LINE:
        raise LatexError(f"the line has {len(line)} characters: write at most {LONGEST_LINE}")
    line = _NUMBERED.sub("", line)
    pieces: list[Piece] = []
    environments: list[tuple[str, int]] = []  # each with the piece at which it begins
    rows = [(0, 0)]  # of each environment's row: how many '&' stood in it so far, the piece with which it begins
    depth, at = 0, 0
    while at < len(line):
        found = _PIECE.match(line, at)
        assert found is not None  # every character is a piece
        text, start, at = found.group(), at, found.end()
        if text.isspace() or text == "$":
            if text == "$" and line[:start].strip(" $") and line[at:].strip(" $.,;"):
                raise LatexError(r"a dollar sign within the line: write one formula, and words in \text{...}", start)
            continue
        if text == "~":
            text = "\\ "
        if text.startswith("\\") and text[1:] in TEXTS | SILENT:
            content, at = _text(line, at)
            pieces += _said(text, content, start, bool(pieces))
            continue
        if text in ("\\begin", "\\end", "&", "\\\\"):
            at = _layout(line, text, start, at, environments, pieces)
            pieces += [Piece("apart", "", start)] * _apart(text, rows, pieces)
            continue
        if 0 < len(pieces) == rows[-1][1] and text[1:] in WIDE:  # a row that goes on is set in
            continue
        kind = _kind(text, start)
        depth += {"open": 1, "close": -1}.get(kind, 0)
        if depth > DEEPEST_NESTING:
            raise LatexError(f"braces are nested more than {DEEPEST_NESTING} deep: write a flatter line", start)
        if depth < 0:
            raise LatexError("a brace '}' closes nothing: remove it or open it", start)
        pieces.append(Piece(kind, text.removeprefix("\\"), start))
    if environments:
        raise LatexError(f"\\begin{{{environments[-1][0]}}} has no end: add it")
    if depth:
        raise LatexError(f"{depth} brace{'s' if depth > 1 else ''} '{{' not closed: add '}}'")
    return pieces


def _layout(line: str, text: str, start: int, at: int, environments: list[tuple[str, int]], pieces: list[Piece]) -> int:
    """Read on after what only arranges lines; a new line parts relations by a comma, unless a formula goes on in it."""
    if text in ("\\begin", "\\end"):
        found = _NAME.match(line, at)
        if found is None or found["name"] not in ENVIRONMENTS:
            matrix = found is not None and found["name"].rstrip("*").endswith(("matrix", "array"))
            raise LatexError("a matrix is not read: write its rows as formulas of their own" if matrix else
                             f"this {text} is not read: write the lines of a formula or of cases", start)
        if text == "\\begin":
            if found["name"] == "cases" and not _begins(pieces):
                raise LatexError("a value by cases: write one line for each case, with its condition", start)
            environments.append((found["name"], len(pieces)))
        elif not environments or environments[-1][0] != found["name"]:
            raise LatexError(f"{text} ends what has not begun: correct the environments", start)
        else:
            _close(*environments.pop(), pieces)
        return found.end()
    if text == "&":
        if not environments or environments[-1][0] == "cases":
            raise LatexError("'&' tells cases apart, or columns: write one line for each case", start)
        return at
    while pieces and _is_space(pieces[-1]):
        pieces.pop()  # at the end of a row it parts nothing
    parted = bool(pieces) and pieces[-1].text in (",", ";")
    if pieces and not _goes_on(line, at, start, environments, parted):
        pieces[len(pieces) - parted:] = [Piece("sign", ";", start)]
    return at


def _close(name: str, begins: int, pieces: list[Piece]) -> None:
    """Part the rows of a system by commas, where each is a formula without words: its brace holds them together."""
    own = pieces[begins:]
    if name == "cases" and not any(piece.kind == "text" or piece.text in _SAYS for piece in own):
        pieces[begins:] = [replace(piece, text=",") if (piece.kind, piece.text) == ("sign", ";") else piece
                           for piece in own]


def _said(command: str, content: str, start: int, follows: bool) -> list[Piece]:
    r"""The piece of a \text; of the number of an equation, or its label, that it stands at the end of a formula."""
    if command[1:] in TEXTS:  # \text{sgn} is \operatorname{sgn}
        return [Piece("command" if content in FUNCTIONS else "text", content, start)]
    if not follows:
        return []
    return [Piece("command", "quad", start) if command == "\\label" else Piece("apart", "", start)]


def _is_space(piece: Piece) -> bool:
    return piece.kind == "apart" or (piece.kind == "command" and piece.text in WIDE)


def _apart(text: str, rows: list[tuple[int, int]], pieces: list[Piece]) -> bool:
    """Whether what stands next is set apart: the next pair of columns in a row, or what follows an environment."""
    count, begins = rows[-1]
    if text == "\\begin":
        rows.append((0, len(pieces)))
    elif text == "\\end":
        rows.pop()
        return True
    elif text == "&":
        rows[-1] = count + 1, begins
        return count % 2 == 1 and len(pieces) > begins
    else:
        rows[-1] = 0, len(pieces)
    return False


def _begins(pieces: list[Piece]) -> bool:
    """Whether a formula begins behind these pieces, so that cases are a system and not the values of something."""
    for piece in reversed(pieces):
        if piece.kind == "open" or (piece.kind == "command" and piece.text in DROPPED | {"{", "lbrace"}):
            continue
        return piece.kind == "text" or piece.text in {",", ";", ":", *IMPLIES, *EQUIVALENT}
    return True


def _goes_on(line: str, at: int, start: int, environments: list[tuple[str, int]], parted: bool) -> bool:
    """Whether a new line goes on with the formula before it; in cases no formula does so with a sign."""
    if not _SIGNED.match(line, at):
        return _GOES_ON.match(line, at) is not None
    if parted or not line[at:].strip():
        return False
    if environments and environments[-1][0] == "cases":
        return False
    if _RELATED.search(line[at:].partition("\\\\")[0]):
        raise LatexError("whether the new line goes on with the formula before it is open: write one line for each",
                         start)
    return True


def _kind(text: str, position: int) -> str:
    if text.startswith("\\"):
        if len(text) == 1 or (text[1:].isspace() and text[1:] != " "):
            raise LatexError("a backslash without a command: write the command's name", position)
        return "command"
    if text.isascii() and text.isalpha():
        return "letter"
    if text.isascii() and text.isdigit():
        return "digit"
    if text in "{}":
        return "open" if text == "{" else "close"
    if text in "+-=<>()[]|,;:./*'^_!":
        return "sign"
    raise LatexError(f"'{text}' is no sign of a formula: write it as a LaTeX command", position)


def _text(line: str, at: int) -> tuple[str, int]:
    """What stands between the braces after \text, and where it ends; formulas within are words too."""
    opened = re.compile(r"\s*\{").match(line, at)
    if opened is None:
        raise LatexError(r"\text, \label or \tag without braces: write \text{...}", at)
    depth, end = 1, opened.end()
    while end < len(line) and depth:
        depth += {"{": 1, "}": -1}.get(line[end], 0)
        end += 1
    if depth:
        raise LatexError(r"the braces of \text are not closed: add '}'", at)
    return line[opened.end():end - 1].strip(), end


def argument(pieces: list[Piece], at: int, end: int, depth: int = 0) -> tuple[int, int, int]:
    """The argument that starts at a piece: first piece and end of what it holds, and where reading goes on.

    TeX takes a group in braces, or one piece; a command that has arguments takes them along.
    """
    if at >= end or depth > DEEPEST_NESTING:
        position = pieces[min(at, end) - 1].position
        raise LatexError("an argument is missing: write it in braces" if at >= end else
                         f"arguments are nested more than {DEEPEST_NESTING} deep: write a flatter line", position)
    piece = pieces[at]
    if piece.kind == "open":
        close = closing(pieces, at)
        return at + 1, close, close + 1
    if piece.kind == "close" or piece.text in "^_":
        raise LatexError(f"an argument is missing before '{piece.text}': write it in braces", piece.position)
    after = at + 1
    for _ in range(arguments(piece)):
        after = argument(pieces, after, end, depth + 1)[2]
    return at, after, after


def arguments(piece: Piece) -> int:
    """How many arguments a command takes."""
    if piece.kind != "command":
        return 0
    if piece.text in FRACTIONS:
        return 2
    return int(piece.text in ACCENTS | FONTS | UPRIGHT or piece.text == "sqrt")


def closing(pieces: list[Piece], at: int) -> int:
    """Where the brace that opens at a piece is closed."""
    depth = 0
    for place in range(at, len(pieces)):
        depth += {"open": 1, "close": -1}.get(pieces[place].kind, 0)
        if depth == 0:
            return place
    raise LatexError("a brace '{' is not closed: add '}'", pieces[at].position)


def plain(pieces: list[Piece]) -> str:
    r"""Pieces as the text of an index, the same however it is typed: `{1}`, `1`, `\mathrm{max}` and `\max`."""
    parts: list[str] = []
    for piece in pieces:
        upright = piece.kind == "command" and piece.text in ("max", "min", "mathrm", "operatorname", "mathit")
        if piece.kind in ("open", "close") or (upright and piece.text not in ("max", "min")):
            continue
        if piece.kind != "command" or upright:
            parts.append(piece.text)
        elif piece.text not in KNOWN:
            raise LatexError(f"the command \\{piece.text} in an index is not known here: correct it", piece.position)
        elif piece.text not in DROPPED:
            parts.append(f"\\{piece.text} ")
    return "".join(parts).strip()
