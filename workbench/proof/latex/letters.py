"""The LaTeX of a symbol's name; nothing here needs sympy."""

from __future__ import annotations

import re

from workbench.proof.latex.commands import GREEK

ACCENTS = ("hat", "tilde", "bar", "dot", "ddot", "dddot", "star")
LOGARITHM = "log_"  # a positive letter with an index is stated by its logarithm: e^log_m is m
_STEM = re.compile(r"(?P<letter>[A-Za-z]+?)(?P<accent>dddot|ddot|dot|hat|tilde|bar)?(?P<digits>\d*)")


def latex_name(name: str) -> str:
    """LaTeX of a symbol's name: parts after underscores are accents where known, else indices; x1 is x_1."""
    if "\\" in name:
        return name
    stem, *parts = name.split("_")
    found = _STEM.fullmatch(stem)
    letter, accents, indices = stem, [], [part for part in parts if part not in ACCENTS and part]
    if found is not None and (found["accent"] is None or _is_letter(found["letter"])):
        letter = found["letter"]
        accents = [found["accent"]] if found["accent"] else []
        indices = ([found["digits"]] if found["digits"] else []) + indices
    result = _letter(letter, rf"\mathrm{{{letter}}}")
    accents += [part for part in parts if part in ACCENTS]
    for accent in accents:
        result = result if accent == "star" else rf"\{accent}{{{result}}}"
    if indices:
        result += f"_{{{','.join(_letter(part, _letters(part)) for part in indices)}}}"
    return result + "^{*}" * ("star" in accents)


def _letters(index: str) -> str:
    """An index of a letter and a Greek one, such as knu; any other stays a word."""
    return rf"{index[0]}\{index[1:]}" if index[1:] in GREEK else index


def _is_letter(name: str) -> bool:
    return len(name) == 1 or _greek(name) in GREEK


def _greek(name: str) -> str:
    return "lambda" if name == "lamda" else name


def _letter(name: str, else_: str) -> str:
    return rf"\{_greek(name)}" if _greek(name) in GREEK and name.isalpha() else name if len(name) == 1 else else_
