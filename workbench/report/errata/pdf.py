"""Errata as PDF, set by Typst, whose Python package brings its fonts and needs nothing of the system."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

from workbench.report.errata.blocks import Block, Medium, written
from workbench.report.errata.markdown import nested
from workbench.report.errata.typst_formulas import quoted, typst_formula
from workbench.report.worded import show

HEAD = """#set document(date: none)
#set page(paper: "a4", margin: (x: 24mm, y: 22mm), numbering: "1 / 1")
#set text(font: "New Computer Modern", size: 10.5pt, lang: "en")
#set par(leading: 0.6em)
#show heading: set block(above: 1.4em, below: 0.8em, breakable: false)
#show raw: set text(size: 7pt)
#let tall(body) = {
  show math.equation: set text(top-edge: "bounds", bottom-edge: "bounds")
  body
}
#show list: tall
"""
BREAK = r' + "\n" + '  # between lines of code


def pdf_of(blocks: Sequence[Block]) -> bytes | None:
    """The document as PDF, the same bytes for the same blocks; None where Typst is not installed."""
    try:
        typst = import_module("typst")
    except ImportError:
        return None
    return bytes(typst.compile(typst_source(blocks).encode(), format="pdf"))


def typst_source(blocks: Sequence[Block]) -> str:
    """The document in the language of Typst."""
    return HEAD + "\n\n".join(written(blocks, TYPST)) + "\n"


def _formula(latex: str, label: str) -> str:
    """A label keeps to the formula below it, over the end of a page too."""
    words = f"#text(8.5pt, gray.darken(40%), {quoted(label)})"
    above = f"#block(inset: (left: 1em), above: 0.9em, below: 0.55em, sticky: true)[{words}]\n" if label else ""
    space = ", above: 0.55em" if label else ", above: 0.9em"
    return f"{above}#block(inset: (left: 1em){space})[#tall[{typst_formula(latex, display=True)}]]"


def _text(text: str) -> str:
    return show(text, typst_formula, lambda words: f"#{quoted(words)};" if words.strip() else "#\" \";")


TYPST = Medium(
    heading=lambda level, text: f"#heading(level: {level})[{_text(text)}]",
    paragraph=lambda text, label: (f"#strong({quoted(label + '.')}) " if label else "") + _text(text),
    formula=_formula,
    items=lambda items: nested(items, _text),
    code=lambda text: f"#raw({BREAK.join(map(quoted, text.splitlines()))}, block: true)")
