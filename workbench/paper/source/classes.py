"""What the grammar of sentences reads of each word and formula."""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

from workbench.paper.source import forms, vocabulary
from workbench.paper.source.bounds import bounded_in
from workbench.paper.source.letters import kinds_in, values_and_rates
from workbench.paper.source.passages import Word
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.sides import letters_of_text
from workbench.proof.latex.tree import Group, Letter, Line, Node, Number, Product

_TIME = re.compile(r"(?:\\forall\s*)?t\s*(?:(?:\\geq?|\\geqslant|>)\s*(?:0|t_0|t_\{0\})|\\in\s*\[0,\s*\\infty\)|"
                   r"\\(?:to|rightarrow)\s*\+?\s*\\infty)?")
_TENDS = re.compile(r"[^=<>,]+?\\(?:to|rightarrow)\s*0")
_REAL = re.compile(r"(?P<letters>.*?)\\in\s*\\mathbb\s*(?:\{R\}|R)\s*(?:\^\s*(?:[a-z0-9]|\{[^{}<>=]*\}))?\s*",
                   re.DOTALL)
_RELATED = re.compile(r"[=<>]|\\(?:leq?|geq?|leqslant|geqslant|in|notin|neq?|ll|gg|approx|sim|to|rightarrow|Rightarrow|"
                      r"implies|iff|forall|exists|equiv|subset\w*|mapsto|prec\w*|succ\w*|lesssim|gtrsim|triangleq|coloneqq|doteq|lt|gt|not)"
                      r"(?![A-Za-z])")


def classes_of(words: Sequence[Word]) -> list[str]:
    """What the grammar reads of each word."""
    found: list[str] = []
    for place, word in enumerate(words):
        if word.kind == "math":
            found.append(formula_class(word.text))
        elif word.kind == "display":
            found.append(forms.DISPLAY)
        elif word.kind == "reference":
            found.append(forms.REFERENCE)
        elif word.kind == "word":
            found.append(_word_class(word.text, words[place - 1].text if place else "",
                                     words[place + 1] if place + 1 < len(words) else None))
        else:
            found.append(word.text if word.kind == "mark" else "?")
    return found


def _word_class(text: str, before: str, behind: Word | None) -> str:
    if text in ("error", "errors"):
        signal = before in vocabulary.BEFORE_ERROR or (behind is not None and (
            behind.kind in ("math", "display") or behind.text in (
                "dynamics", "system", "variable", "variables", "signal")))
        return forms.ERROR if signal else text
    parts = text.split("-")
    if len(parts) > 1 and text not in forms.KNOWN and all(
            part in forms.MODIFIERS or part in forms.NOUNS for part in parts):
        return parts[-1]
    return text


@lru_cache(maxsize=4096)
def formula_class(formula: str) -> str:
    """What a formula within the text is to the grammar; `?` for one that cannot be read and may be a relation."""
    if _TIME.fullmatch(formula):
        return forms.TIME
    if _TENDS.fullmatch(formula):
        return forms.TENDS
    real = _REAL.fullmatch(formula)
    try:
        return _class_of(read_line(real["letters"] if real else formula), formula, real is not None)
    except LatexError:
        return "?" if _RELATED.search(formula) else forms.VALUE


def _class_of(line: Line, formula: str, real: bool) -> str:
    sides = [side for chain in line.chains for side in chain.sides]
    if all(not chain.signs for chain in line.chains):
        plain = all(map(_is_letter, sides)) and all(one in ((), (",",)) for one in line.separators)
        return forms.REAL if real and plain else "?" if real else forms.LETTERS if plain else forms.VALUE
    if real or any(one not in ((), (",",)) for one in line.separators):
        return "?"
    heads = [chain.sides[0] for chain in line.chains]
    if len(heads) == 1 and _is_letter(heads[0]) and line.chains[0].signs == ("!=",) and (
            line.chains[0].sides[1] == Number(Fraction(0))):
        return forms.NONZERO
    if all(map(_is_letter, heads)) and len([*kinds_in(formula)]) == len(heads):
        return forms.SIGN
    return forms.BOUND if bounded_in(formula) else _relation_class(formula, len(line.chains))


def _relation_class(formula: str, chains: int) -> str:
    values, rates = values_and_rates(formula)
    if len(rates) == chains == 1 and not values:
        return forms.MOVES
    if len(values) == 1 and all(letters_of_text(right) - {letter} for letter, right in values.items()):
        return forms.DEFINES
    return forms.RELATION


def _is_letter(side: Node) -> bool:
    return isinstance(side, Letter) or (isinstance(side, Product) and len(side.factors) == 2
                                        and isinstance(side.factors[0], Letter) and isinstance(side.factors[1], Group))
