"""Sentences with formulas in them: text in which LaTeX stands between dollar signs, made from names and shown by any
medium."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

from workbench.proof.latex.commands import GREEK
from workbench.report.certificate_latex import name_latex

INNER = "\ue000"  # a dollar sign inside a formula
_FORMULA = re.compile(r"\$([^$]*)\$")
# A letter with indices, `rho_hat`, `4c_k` or `W_v*`, and what it is raised to; below, `E_{i-1}` or `e_(i-1)`.
_LETTER = re.compile(r"(?<![A-Za-z_.$\\{])([A-Za-z]+(?:_[A-Za-z0-9]+)+)(\*?)(\^\d|\^T\b)?(?![\w]|\.py)")
_EXPONENTIAL = re.compile(r"(?<![\w$\\{])(exp|e)\^\(([^()$]*)\)")
_STEM = re.compile(r"([A-Za-z]+?)(?:d?dot|hat|tilde|bar)?\d*")
_SIGNS = (("==", "="), ("<=", "≤"), (">=", "≥"), ("!=", "≠"), ("->", "→"))
_POWER = re.compile(r"(?<![\w$\\{])([A-Za-z])\^(\d|[a-z])(?!\w)")
# A Greek letter that has an index or is one: its name is what letters are made of.
_GREEK_SIGN = re.compile(r"(?<![A-Za-z])[α-ω](?=_[A-Za-z0-9])|(?<=[A-Za-z0-9]_)[α-ω](?!\w)")
_SHORT = {"eps": "varepsilon"}
_WORDS = ("Re", "Im", "ell", "wp", "partial", "pi")  # words, or as pi a controller, before they are letters
_NAMES = "|".join(sorted((name for name in GREEK if name not in _WORDS), key=len, reverse=True))
_INDEXED = re.compile(rf"(?<![\w.$\\{{])({_NAMES}|eps|sum|[A-Za-z])_(?:\{{([^{{}}$]+)\}}|\(([^()$]+)\))")
# A Greek letter or a single one with its accent in words, such as W-tilde, where no claim's number goes on with it.
_ACCENTED = re.compile(rf"(?<![\w.$\\{{-])({_NAMES}|eps|[A-Za-z])-(hat|tilde|bar|dot)(?!\w|\.\w)")
_GREEK = re.compile(rf"(?<![\w.$\\{{])({_NAMES}|eps)(\*|\^\d)?(?!\w|\.\w)")
_STARRED = re.compile(r"(?<![\w$\\{*])([A-Za-z])\*(?![\w*])")
_DERIVED = re.compile(r"(?<![\w$\\{'])([A-Za-z])'(?!\w)")
_UNIT = re.compile(r"(?<![\w$/])(k?N|m)/(s|m)\^2(?!\w)")
# A letter or number above the bar of a quotient at the end of words, and one below it at their beginning.
_ABOVE = re.compile(r"(?<![\w.,'^/)\]])([A-Za-z]|\d+)/$")
_BELOW = re.compile(r"/([A-Za-z]|\d+)(?![\w.'^/(]|-\w)")
# What a formula is raised to, or its prime, behind it.
_BEHIND = re.compile(r"\$([^$]*[^$^{}]|[^$]*\})\$(?:\$\{\}(\^\{[^$]*\})\$|('+)(?!\w))")
_RAISED = re.compile(r"\^(?:\{(-?\w+)\}|\((-?\w+(?:[-+/]\w+)?)\)|(-?\d+|T\b|i\b|[-+](?!\w)))")


def worded(text: str) -> str:
    """A note or title with its letters, such as z_1 or rho_hat, as formulas between dollar signs."""
    text = _GREEK_SIGN.sub(lambda found: _name_of_greek(found[0]), text)
    for typed, sign in _SIGNS:
        text = text.replace(typed, sign)
    text = _outside(text, _UNIT, lambda found: rf"$\mathrm{{{found[1]}/{found[2]}^2}}$")
    text = _outside(text, _EXPONENTIAL, lambda found: rf"$\mathrm{{{found[1]}}}^{{{_spelled(found[2])}}}$")
    text = _outside(text, _INDEXED, lambda found: f"${_greek(found[1])}_{{{_spelled(found[2] or found[3])}}}$")
    text = _outside(text, _LETTER, _as_formula)
    text = _outside(text, _POWER, lambda found: rf"${found[1]}^{found[2]}$")
    text = _outside(text, _ACCENTED, lambda found: rf"$\{found[2]}{{{_greek(found[1])}}}$")
    text = _outside(text, _GREEK, lambda found: f"${_greek(found[1])}{(found[2] or '').replace('*', '^*')}$")
    text = _outside(text, _STARRED, lambda found: f"${found[1]}^*$")
    text = _outside(text, _DERIVED, lambda found: f"${found[1]}'$")
    text = _outside(text, _RAISED, lambda found: f"${{}}^{{{found[1] or found[2] or found[3]}}}$")
    return _quotients(_BEHIND.sub(
        lambda found: found[0] if "^" in found[1] else f"${found[1]}{found[2] or found[3]}$", text))


def _quotients(text: str) -> str:
    """The text with a quotient of a formula and a letter or number, l/$\\mu$, as one formula: its bar is no slash
    between words."""
    pieces = re.split(r"(\$[^$]*\$)", text)
    for i in range(1, len(pieces), 2):
        above, below = _ABOVE.search(pieces[i - 1]), _BELOW.match(pieces[i + 1])
        if above:
            pieces[i - 1] = pieces[i - 1][:above.start()]
            pieces[i] = f"${above[1]}/{pieces[i][1:]}"
        if below:
            pieces[i + 1] = pieces[i + 1][below.end():]
            pieces[i] = f"{pieces[i][:-1]}/{below[1]}$"
    joined = "".join(pieces)
    return re.sub(r"(?<=[^$])\$/\$(?=[^$])", "/", joined) if "$/$" in joined else joined


def _outside(text: str, pattern: re.Pattern[str], formula: Callable[[re.Match[str]], str]) -> str:
    """The text with what the pattern finds in its words as formulas; those that are there stay."""
    pieces = re.split(r"(\$[^$]*\$)", text)
    return "".join(piece if i % 2 else pattern.sub(formula, piece) for i, piece in enumerate(pieces))


def _name_of_greek(sign: str) -> str:
    """lambda of λ, which Unicode spells otherwise."""
    return unicodedata.name(sign).rpartition(" ")[2].lower().replace("lamda", "lambda")


def _greek(name: str) -> str:
    return name if len(name) == 1 else rf"\{_SHORT.get(name, name)}"


def _spelled(text: str) -> str:
    """An exponent or an index, its Greek letters as such."""
    return re.sub(r"[A-Za-z]+", lambda found: rf"\{found[0]} " if found[0] in GREEK else found[0], text).strip()


def _as_formula(found: re.Match[str]) -> str:
    stem = _STEM.fullmatch(found[1].partition("_")[0])
    short = stem[1] if stem else ""
    letter = _SHORT.get(short, short)
    raised = f"{found[2]}{(found[3] or '').removeprefix('^')}"
    if short == "sum":
        return rf"$\sum_{{{found[1].partition('_')[2]}}}$"
    if len(letter) != 1 and letter not in GREEK:
        return found[0]
    return f"${name_latex(letter + found[1][len(short):])}{f'^{{{raised}}}' if raised else ''}$"


def math(latex: str) -> str:
    """A formula as it stands in a sentence; dollar signs of its own, as in `\\text{for $k$}`, do not end it."""
    return f"${latex.replace('$', INNER)}$"


def show(text: str, formula: Callable[[str], str], words: Callable[[str], str] = str) -> str:
    """The text with each of its formulas, and what stands between them, shown by a function."""
    pieces = _FORMULA.split(text)
    return "".join(formula(piece.replace(INNER, "$")) if i % 2 else words(piece)
                   for i, piece in enumerate(pieces) if piece)
