"""Errata as Markdown, with formulas as browsers of repositories show them."""

from __future__ import annotations

from collections.abc import Sequence

from workbench.report.errata.blocks import Block, Code, Formula, Heading, Items, Paragraph
from workbench.report.worded import show


def markdown(blocks: Sequence[Block]) -> str:
    """The document as Markdown."""
    return "\n\n".join(_block(block) for block in blocks) + "\n"


def _block(block: Block) -> str:
    match block:
        case Heading(level, text):
            return f"{'#' * level} {_text(text)}"
        case Paragraph(text, label):
            return (f"**{label}.** " if label else "") + _text(text)
        case Formula(latex, label):
            return (f"**{label}:**\n\n" if label else "") + f"$$\n{latex}\n$$"
        case Items(texts, depths):
            levels = depths or (0,) * len(texts)
            return "\n".join(f"{'  ' * depth}- {_text(text)}" for text, depth in zip(texts, levels, strict=True))
        case Code(text):
            return f"```\n{text}\n```"


def _text(text: str) -> str:
    return show(text, lambda latex: f"${latex}$", lambda words: words.replace("*", r"\*").replace("_", r"\_"))
