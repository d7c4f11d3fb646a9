"""Formulas as Typst sets them: made from the same tree as the page's."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from xml.etree import ElementTree

from workbench.report.formulas import LIMITS, formula_tree

ACCENTS = {"˙": "dot", "¨": "dot.double", "^": "hat", "~": "tilde", "¯": "macron", "‾": "macron", "―": "macron",
           "→": "arrow", "ˇ": "caron", "˘": "breve", "´": "acute", "`": "grave"}
WIDE = 70  # signs of a fraction's part from which on it is written in a line, which can break
WORDS = 3  # letters from which on words in a formula stand outside of it
OPENING, CLOSING = frozenset("(["), frozenset(")]")
ESCAPED = frozenset("(){}[]/,;_^&#$\"'\\*`~@<>=+-:!.")


def typst_formula(latex: str, display: bool = False) -> str:
    """A LaTeX formula as Typst between dollar signs, in a line; its words stand outside, where lines may break; what
    cannot be converted as raw text. display: fractions in full size."""
    return _converted(latex.strip(), display)


@cache
def _converted(latex: str, display: bool) -> str:
    tree = formula_tree(latex)
    if tree is None:
        return f"#raw({quoted(latex)});"
    pieces: list[str] = []
    row: list[ElementTree.Element] = []
    for part in [*_flat(tree), None]:
        words = part is not None and part.tag == "mtext" and len(part.text or "") >= WORDS
        if part is not None and not words:
            row.append(part)
            continue
        if row:
            pieces.append(f"${_row(row, display)}$")
        if part is not None:
            text = (part.text or "").replace(chr(160), " ")
            pieces.append(f"#{quoted(f' {text}' if pieces and text[:1].isalnum() else text)};")
        row = []
    return "".join(pieces)


def _flat(node: ElementTree.Element) -> list[ElementTree.Element]:
    """The pieces of a formula, rows in it that only group undone."""
    return [piece for part in node for piece in (_flat(part) if part.tag in ("mrow", "mstyle") else [part])]


def quoted(text: str) -> str:
    """A string of Typst."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ") + '"'


def _row(parts: list[ElementTree.Element], display: bool) -> str:
    """Pieces one after the other; brackets that do not close in the row are signs of their own."""
    signs = [part.text or "" for part in parts if part.tag == "mo"]
    balanced = sum(s in OPENING for s in signs) == sum(s in CLOSING for s in signs)
    told = [_sign(part.text or "", balanced) if part.tag == "mo" else _piece(part, display) for part in parts]
    for i, part in enumerate(parts[1:], 1):
        if part.tag == "mtable" and (parts[i - 1].text or "") == "{":  # one brace that is as high as its cases
            cases = f"cases({', '.join(' & '.join(map(_inner, row)) for row in part)})"
            told[i - 1:i + 1] = ["", f"display({cases})" if display else cases]
    return " ".join(filter(None, told))


def _sign(text: str, balanced: bool) -> str:
    if text in ("|", "‖"):
        return f'class("normal", {text})'
    if balanced and text in OPENING | CLOSING:
        return text
    if len(text) == 1 and text not in ESCAPED:
        return text
    return f"\\{text}" if len(text) == 1 else f"op({quoted(text)})" if text.strip() else ""


def _piece(node: ElementTree.Element, display: bool) -> str:
    parts, text = list(node), node.text or ""
    if node.tag in _SIMPLE:
        return _SIMPLE[node.tag](node, text)
    if node.tag == "mfrac":
        return _fraction(parts, display)
    if node.tag in _SCRIPTS:
        return _scripts(parts, _SCRIPTS[node.tag], node.tag.startswith("mu") or (parts[0].text or "") in LIMITS)
    if node.tag == "mover":
        return _over(parts)
    if node.tag == "mroot":
        return f"root({_inner(parts[1])}, {_inner(parts[0])})"
    return f"sqrt({_row(parts, False)})" if node.tag == "msqrt" else _row(parts, display)


def _fraction(parts: list[ElementTree.Element], display: bool) -> str:
    if max(map(_signs, parts)) >= WIDE:
        return " \\/ ".join(f"({_inner(part)})" if _signs(part) > 1 else _inner(part) for part in parts)
    fraction = f"frac({_inner(parts[0])}, {_inner(parts[1])})"
    return f"display({fraction})" if display else fraction


def _signs(node: ElementTree.Element) -> int:
    return sum(len(part.text or "") for part in node.iter())


def _inner(node: ElementTree.Element) -> str:
    return _piece(node, False) or '""'


def _letters(node: ElementTree.Element, text: str) -> str:
    if len(text) > 1:
        return f"op({quoted(text)})" if text.isalpha() else quoted(text)
    letter = text if text not in ESCAPED else f"\\{text}"
    bold = "bold" in node.get("mathvariant", "")
    upright = node.get("mathvariant") == "normal" and text.isalpha() and text.isascii()
    return f"bold({letter})" if bold else f"upright({letter})" if upright else letter


def _number(node: ElementTree.Element, text: str) -> str:
    return text if text.replace(".", "", 1).isdigit() else quoted(text)


def _table(node: ElementTree.Element) -> str:
    """The lines of cases or of a matrix; what bounds them stands beside it."""
    rows = "; ".join(", ".join(_inner(cell) for cell in row) for row in node)
    return f"mat(delim: #none, align: #left, {rows})"


_SIMPLE: dict[str, Callable[[ElementTree.Element, str], str]] = {
    "mtable": lambda node, text: _table(node), "mi": _letters,
    "mn": _number, "mtext": lambda node, text: quoted(text.replace("\u00a0", " ")),
           "mspace": lambda node, text: "med", "mo": lambda node, text: _sign(text, False)}
_SCRIPTS = {"msub": "b", "msup": "t", "msubsup": "bt", "munder": "b", "munderover": "bt"}


def _scripts(parts: list[ElementTree.Element], places: str, limits: bool) -> str:
    base = _inner(parts[0])
    scripts = ", ".join(f"{place}: {_inner(part)}" for place, part in zip(places, parts[1:], strict=True))
    return f"attach({f'limits({base})' if limits else base}, {scripts})"


def _over(parts: list[ElementTree.Element]) -> str:
    accent = ACCENTS.get((parts[1].text or "").strip())
    if accent is None:
        return f"attach(limits({_inner(parts[0])}), t: {_inner(parts[1])})"
    return f"accent({_inner(parts[0])}, {accent})"
