"""Wide spaces: where one stands between two relations, it parts them as a comma does, and is no product."""

from __future__ import annotations

from collections.abc import Iterable

from lark import Token

from workbench.proof.latex.error import LatexError

ENDING = frozenset(["COMMA", "COLON", "WORDS", "IMPLIES", "IFF", "QUANTIFIER"])
OPENING = frozenset(["OPEN", "LB", "BARS_OPEN"])
CLOSING = frozenset(["CLOSE", "RB", "BARS_CLOSE"])
# After these a value is complete.
COMPLETE = frozenset(["LETTER", "NUMBER", "CLOSE", "RB", "SUB", "MARK", "TRANSPOSE", "BARS_CLOSE", "ELLIPSIS", "AT"])
BEGINNING = frozenset(["LETTER", "NUMBER", "NAMED", "BIG", "FRAC", "SQRT", "ACCENT", "OPEN", "LB", "BARS_OPEN", "PLUS",
                       "MINUS", "PLUS_MINUS"])


def require_no_formula(words: list[Token], spaces: Iterable[tuple[int, bool]]) -> None:
    """Raise LatexError for a wide space, before one of the words, as in `x = 0 \\quad y = 0`: no product is meant.

    The second of each pair says that a column or the end of an environment stands there: between what has no relation,
    too, no product is meant.
    """
    for place, is_apart in spaces:
        if not (0 < place < len(words) and words[place - 1].type in COMPLETE and words[place].type in BEGINNING):
            continue
        related = _related(reversed(words[:place]), CLOSING, OPENING) and _related(words[place:], OPENING, CLOSING)
        if is_apart and (related or words[place].type != "OPEN"):
            raise LatexError("columns or environments stand side by side: write a comma between two relations, or "
                             "each in a line of its own", words[place].start_pos)
        if related:
            raise LatexError("a wide space stands between two relations: write a comma between them, or \\cdot for a "
                             "product", words[place].start_pos)


def _related(words: Iterable[Token], deeper: frozenset[str], higher: frozenset[str]) -> bool:
    """Whether a relation sign stands in the same formula, outside of its brackets."""
    depth = 0
    for word in words:
        depth += (word.type in deeper) - (word.type in higher)
        if depth < 0 or (depth == 0 and word.type in ENDING):
            return False
        if depth == 0 and word.type == "RELATION":
            return True
    return False
