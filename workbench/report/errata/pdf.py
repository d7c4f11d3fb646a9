"""Errata as PDF, set by Typst, whose Python package brings its fonts and needs nothing of the system."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

from workbench.report.errata.blocks import Block, Code, Formula, Heading, Items, Paragraph
from workbench.report.errata.typst_formulas import quoted, typst_formula
from workbench.report.worded import show

HEAD = """#set document(date: none)
#set page(paper: "a4", margin: (x: 24mm, y: 22mm), numbering: "1 / 1")
#set text(font: "New Computer Modern", size: 10.5pt, lang: "en")
#set par(justify: true, leading: 0.6em)
#show heading: set block(above: 1.4em, below: 0.8em, breakable: false)
#show raw: set text(size: 7pt)
"""


def pdf_of(blocks: Sequence[Block]) -> bytes | None:
    """The document as PDF, the same bytes for the same blocks; None where Typst is not installed."""
    try:
        typst = import_module("typst")
    except ImportError:
        return None
    return bytes(typst.compile(typst_source(blocks).encode(), format="pdf"))


def typst_source(blocks: Sequence[Block]) -> str:
    """The document in the language of Typst."""
    return HEAD + "\n\n".join(_block(block) for block in blocks) + "\n"


def _block(block: Block) -> str:
    match block:
        case Heading(level, text):
            return f"#heading(level: {level})[{_text(text)}]"
        case Paragraph(text, label):
            return (f"#strong({quoted(label + '.')}) " if label else "") + _text(text)
        case Formula(latex, label):
            above = f"#block(below: 0.55em)[#text(8.5pt, gray.darken(40%), {quoted(label)})]\n" if label else ""
            return f"#block(inset: (left: 1em), above: 0.9em)[{above}{typst_formula(latex, display=True)}]"
        case Items(texts, depths):
            levels = depths or (0,) * len(texts)
            return "\n".join(f"{'  ' * depth}- {_text(text)}" for text, depth in zip(texts, levels, strict=True))
        case Code(text):
            return f"#raw({quoted(text)}, block: true)"


def _text(text: str) -> str:
    return show(text, typst_formula, lambda words: f"#{quoted(words)};" if words.strip() else "#\" \";")
