"""Formulas as one line of Unicode text, for a terminal: made from the same tree as the page's."""

from __future__ import annotations

import re
import unicodedata
from functools import cache
from xml.etree import ElementTree

from workbench.report.formulas import formula_tree
from workbench.report.worded import show, worded

_UP = "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁱⁿᵀ"
_RAISED = dict(zip("0123456789+−=()inT", _UP, strict=True)) | {"′": "′"}
_LOWERED = dict(zip("0123456789+−=()aeijklmnoprstuvxβγρφχ",
                    "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓᵦᵧᵨᵩᵪ", strict=True))
# What stands over a letter, as a combining character behind it.
_OVER = {"˙": "\u0307", "¨": "\u0308", "^": "\u0302", "~": "\u0303", "¯": "\u0304", "ˇ": "\u030c", "→": "\u20d7",
         "‾": "\u0304", "―": "\u0304", "⃛": "\u20db", "⋯": "\u20db", "...": "\u20db"}
_SPACED = frozenset("=≤≥<>≠+−→⟹⇒⇔⟺∈∧∨≈×:≡")
_WORD = re.compile(r"\\mathrm\{([A-Za-z ]{2,})\}")  # letters of a word stay together


def plain_formula(latex: str) -> str:
    """A LaTeX formula as one line of Unicode text; what cannot be converted stays LaTeX."""
    return _plain(latex.strip())


def plain_words(text: str) -> str:
    """A text with its letters, such as x_1 or rho_hat, as Unicode."""
    return plain_told(worded(text))


def plain_told(text: str) -> str:
    """A text whose formulas stand between dollar signs as Unicode."""
    return show(text, plain_formula)


@cache
def _plain(latex: str) -> str:
    tree = formula_tree(_WORD.sub(r"\\text{\1}", latex))
    if tree is None:
        return latex
    text = re.sub(r"\s+", " ", _line(tree)).strip()
    return unicodedata.normalize("NFC", re.sub(r"\s+([,;.)\]])", r"\1", text))


def _line(node: ElementTree.Element) -> str:
    parts = list(node)
    if node.tag in ("mi", "mn", "mtext", "mo", "mspace"):
        return " " if node.tag == "mspace" else (node.text or "").replace("\u00a0", " ")
    if node.tag == "mfrac":
        return f"{_operand(parts[0])}/{_operand(parts[1], below=True)}"
    if node.tag == "msqrt":
        inside = _row(parts)
        return f"√{inside}" if len(inside) == 1 else f"√({inside})"
    if node.tag == "mover":
        return _over(parts)
    if node.tag in _SCRIPTS:
        return _scripts(parts, _SCRIPTS[node.tag])
    return _row(parts)


_SCRIPTS = {"msub": "_", "munder": "_", "msup": "^", "msubsup": "_^", "munderover": "_^"}


def _scripts(parts: list[ElementTree.Element], marks: str) -> str:
    """A base with what stands below and above it."""
    text = _line(parts[0]) if marks.startswith("_") else _base(parts[0])
    for mark, part in zip(marks, parts[1:], strict=True):
        text += _moved(_line(part), _LOWERED if mark == "_" else _RAISED, mark)
    return text


def _over(parts: list[ElementTree.Element]) -> str:
    inside, mark = _line(parts[0]), _OVER.get(_line(parts[1]).strip())
    if mark is None:
        return inside + _moved(_line(parts[1]), _RAISED, "^")
    return inside + mark if _is_letter(inside) else f"({inside}){mark}"


def _is_letter(text: str) -> bool:
    """Whether a text is one letter, whatever stands over it."""
    return sum(not unicodedata.combining(sign) for sign in unicodedata.normalize("NFD", text)) == 1


def _row(parts: list[ElementTree.Element]) -> str:
    """Pieces one after the other, with spaces around relations and between letters that would run together."""
    found, bars = "", 0
    for part in parts:
        piece = _line(part)
        if not piece:
            continue
        if piece == "|":
            bars += 1
            found += f" {piece}" if bars % 2 and found and found[-1] not in " ([/√" else piece
        elif part.tag == "mo" and piece in _SPACED:
            end = found.rstrip()
            sign = piece in "+−" and (not end or end[-1] in "([{=≤≥<>≈,/" or (end[-1] == "|" and bars % 2 == 1))
            found += piece if sign else f" {piece} "
        elif part.tag == "mo" and piece in (",", ";"):
            found += f"{piece} "
        elif _runs_together(found, piece) or (found.endswith("|") and bars % 2 == 0 and piece[0] not in ")]^"):
            found += f" {piece}"
        else:
            found += piece
    return found


def _runs_together(before: str, piece: str) -> bool:
    last = before[-1:]
    if not last or last in " ([{|/√−+":
        return False
    return (last.isalnum() or last in ")]}" or unicodedata.combining(last) != 0) and (
        piece[0].isalpha() or piece[0] in "∑√∫∏") and not (last.isdigit() and len(before) == 1)


def _operand(node: ElementTree.Element, below: bool = False) -> str:
    text = _line(node).strip()
    if text == "d t":
        return "dt"
    if below and len(list(node)) > 1 and node.tag in ("mrow", "mstyle"):
        return f"({text})"
    simple = not any(sign in text for sign in (" + ", " − ", " = ")) and not text.startswith("−")
    return text if simple and not (below and (" " in text or "/" in text)) else f"({text})"


def _base(node: ElementTree.Element) -> str:
    text = _line(node)
    return f"({text})" if node.tag != "mtext" and " " in text.strip() and not text.strip().startswith("(") else text


def _moved(text: str, table: dict[str, str], mark: str) -> str:
    """Text raised or lowered: by characters where all are there, else behind a mark."""
    text = text.strip() if "→" in text else text.replace(" ", "")
    if mark == "^" and text[:1] in ("*", "∗"):
        return "*" + (_moved(text[1:], table, mark) if text[1:] else "")
    if text and all(letter in table for letter in text):
        return "".join(table[letter] for letter in text)
    word = len(text) > 2 and text.isascii() and text.isalpha()
    return f"{mark}{text}" if word or _is_letter(text) else f"{mark}{{{text}}}"
