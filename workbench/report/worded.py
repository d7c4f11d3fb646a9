"""Sentences with formulas in them: text in which LaTeX stands between dollar signs, made from names and shown by any
medium."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from workbench.proof.latex.commands import GREEK
from workbench.report.certificate_latex import name_latex

INNER = "\ue000"  # a dollar sign inside a formula
_FORMULA = re.compile(r"\$([^$]*)\$")
_LETTER = re.compile(r"(?<![\w.$\\{])([A-Za-z]+(?:_[A-Za-z0-9]+)+)(\^\d)?(?![\w]|\.py)")
_STEM = re.compile(r"([A-Za-z]+?)(?:d?dot|hat|tilde|bar)?\d*")
_SIGNS = (("==", "="), ("<=", "≤"), (">=", "≥"), ("!=", "≠"), ("->", "→"))
_POWER = re.compile(r"(?<![\w$\\{])([A-Za-z])\^(\d)(?!\w)")


def worded(text: str) -> str:
    """A note or title with its letters, such as z_1 or rho_hat, as formulas between dollar signs."""
    for typed, sign in _SIGNS:
        text = text.replace(typed, sign)
    text = _LETTER.sub(_as_formula, text)
    return _POWER.sub(r"$\1^\2$", text)


def _as_formula(found: re.Match[str]) -> str:
    stem = _STEM.fullmatch(found[1].partition("_")[0])
    letter = stem[1] if stem else ""
    if len(letter) != 1 and letter not in GREEK:
        return found[0]
    return f"${name_latex(found[1])}{found[2] or ''}$"


def math(latex: str) -> str:
    """A formula as it stands in a sentence; dollar signs of its own, as in `\\text{for $k$}`, do not end it."""
    return f"${latex.replace('$', INNER)}$"


def show(text: str, formula: Callable[[str], str], words: Callable[[str], str] = str) -> str:
    """The text with each of its formulas, and what stands between them, shown by a function."""
    pieces = _FORMULA.split(text)
    return "".join(formula(piece.replace(INNER, "$")) if i % 2 else words(piece)
                   for i, piece in enumerate(pieces) if piece)


def listed(words: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    return " and ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else "".join(words)
