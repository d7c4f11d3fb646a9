"""Rates as a reader writes them: a dot over the letter in place of d/dt in front of it."""

from __future__ import annotations

import re

_BRACED = r"\{(?:[^{}]|\{[^{}]*\})*\}"
_ACCENTED = rf"\\(?:hat|tilde|bar)(?:{_BRACED}| ?(?:\\[A-Za-z]+|[A-Za-z]))"
_NO_LETTER = "frac|left|sum|ln|sqrt|hat|tilde|bar|mathrm|text|dot|operatorname"
_LETTER = rf"(?:{_ACCENTED}|\\(?!(?:{_NO_LETTER})\b)[A-Za-z]+|[A-Za-z])"
_SYMBOL = rf"{_LETTER}(?:_(?:{_BRACED}|\w))?(?:\^\{{\*\}}|\^\*)?"
_RATE = re.compile(rf"\\frac\{{d\}}\{{dt\}} ({_LETTER})((?:_(?:{_BRACED}|\w))?(?:\^\{{\*\}}|\^\*)?)(?![\w(^{{])")
_SUM = re.compile(rf"\\frac\{{d\}}\{{dt\}} \\left\[({_SYMBOL}(?: [+-] {_SYMBOL})+)\\right\]")
_ONE = re.compile(_SYMBOL)


def dotted(latex: str) -> str:
    """A formula with the rates of letters, and of sums of letters, as dots; other rates stay."""
    if r"\frac{d}{dt}" not in latex:
        return latex
    return _RATE.sub(r"\\dot{\1}\2", _SUM.sub(lambda found: _ONE.sub(
        lambda one: rf"\frac{{d}}{{dt}} {one[0]}", found[1]), latex))


def only_names(rate: str) -> bool:
    """Whether `d/dt x = r` says no more than that the rate of x is called so."""
    left, _, right = rate.partition(" = ")
    return re.sub(r"[{}\s]", "", dotted(left)) == re.sub(r"[{}\s]", "", right)


def dotted_text(text: str) -> str:
    """A text with the same in its formulas, which stand between dollar signs."""
    return "$".join(dotted(piece) if i % 2 else piece for i, piece in enumerate(text.split("$")))
