r"""What a text says of several letters at once, spelled out: of `(x, y) \in \mathbb{R}^2`, of `x_i` with `i = 1, 2`."""

from __future__ import annotations

import re

MOST = 6  # values of an index that are spelled out
_TRANSPOSED = r"\s*\^\s*\{?(?:T|\\top|\\mathrm\{T\})\}?\s*"
_SPACE = r"\\in\s*\\mathbb\s*\{?R\}?\s*\^\s*\{?(\d)\}?\s*"
_TUPLE = re.compile(rf"\$\s*(?:\\left)?\(([^()$=]+)(?:\\right)?\)(?:{_TRANSPOSED})?\s*{_SPACE}\$")
_COLUMN = re.compile(rf"\$\s*[A-Za-z]\s*=\s*[\[(]([^$=\[\]()]+,[^$=\[\]()]+)[\])]{_TRANSPOSED}(?:{_SPACE})?\$")
# A letter of an energy with its arguments, given a value.
_FUNCTION = re.compile(r"(?<![A-Za-z\\_])([VWUEHL](?:_\{?\d\}?)?)\s*\([^()]*\)\s*(?::?=)")
_NAME = r"(\\?[a-z]+(?:_\{?\w\}?)?)\s*(?:\([^()$]*\))?\s*\$"
# And another one that the text calls a function: what it is at one state is a number, of whose rate nothing is known.
_CALLED = re.compile(rf"\$\s*{_NAME}\s*(?:is|denotes|represents)\s+(?:an?|the)\s[^$.;]{{0,50}}?\bfunction\b|"
                     rf"\bfunction\s*\$\s*{_NAME}")
_LETTER = r"(?:\\(?:tilde|hat|bar)\s*\{?)?\\?[A-Za-z]+\}?(?:_\{?\w\}?)?"
_LETTERS = re.compile(rf"{_LETTER}(?:,{_LETTER})*")
_VALUES = r"1\s*,\s*([0-9,\s]*[0-9])\s*(?:\\\})?"
_OVER = re.compile(rf"\$([^$]+)\$\s*,?\s*(?:for\s+)?\$\s*([ijk])\s*(?:=|\\in\s*\\\{{)\s*{_VALUES}\s*\$\s*,?")


def spread(text: str) -> str:
    """A source whose tuples of letters are lists, and whose formulas of an index are one for each of its values."""
    text = _of_state(text)
    text = _COLUMN.sub(r"$\1 \\in \\mathbb{R}$", _TUPLE.sub(_listed, text))
    return _OVER.sub(_spelled, text)


def _of_state(text: str) -> str:
    """Functions that are always printed with the same letters in brackets, `V(x)`, without these."""
    heads = {found[1] for found in _FUNCTION.finditer(text)} | {
        name for found in _CALLED.finditer(text) for name in found.groups() if name}
    for head in heads:
        used = [*re.finditer(rf"(?<![A-Za-z\\\\_]){re.escape(head)}\s*\(([^()]*)\)", text)]
        arguments = {re.sub(r"\s+", "", one[1]) for one in used}
        if len(arguments) == 1 and not arguments & {"t", "0"} and _LETTERS.fullmatch(arguments.pop()):
            text = re.sub(rf"(?<![A-Za-z\\\\_]){re.escape(head)}\s*\([^()]*\)", head, text)
    return text


def _listed(found: re.Match[str]) -> str:
    letters = found[1].split(",")
    return rf"${found[1]} \in \mathbb{{R}}$" if len(letters) == int(found[2]) else found[0]


def _spelled(found: re.Match[str]) -> str:
    r"""The formula for each value; as it stands where the index is no index throughout, as in `$x^i$, $i = 1, 2$`."""
    values = ["1", *(one.strip() for one in found[3].split(","))]
    index = re.compile(rf"_\s*(?:\{{{found[2]}\}}|{found[2]}(?![A-Za-z]))")
    if values != [str(k) for k in range(1, len(values) + 1)] or len(values) > MOST or not index.search(found[1]) or (
            re.search(rf"(?<![A-Za-z\\]){found[2]}(?![A-Za-z])", index.sub("", found[1]))):
        return found[0]
    formulas = [f"${index.sub(f'_{{{value}}}', found[1])}$" for value in values]
    return f"{', '.join(formulas[:-1])} and {formulas[-1]} "
