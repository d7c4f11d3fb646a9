"""Errata as Markdown, with formulas as browsers of repositories show them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from workbench.report.errata.blocks import Block, Item, Medium, written
from workbench.report.worded import show


def markdown(blocks: Sequence[Block]) -> str:
    """The document as Markdown."""
    return "\n\n".join(written(blocks, MARKDOWN)) + "\n"


def nested(items: Sequence[Item], text: Callable[[str], str]) -> str:
    """A list with two blanks a depth, as Markdown and Typst have it."""
    return "\n".join(f"{'  ' * item.depth}- {text(item.text)}" for item in items)


def _text(text: str) -> str:
    return show(text, lambda latex: f"${latex}$", lambda words: words.replace("*", r"\*").replace("_", r"\_"))


MARKDOWN = Medium(
    heading=lambda level, text: f"{'#' * level} {_text(text)}",
    paragraph=lambda text, label: (f"**{label}.** " if label else "") + _text(text),
    formula=lambda latex, label: (f"**{label}:**\n\n" if label else "") + f"$$\n{latex}\n$$",
    items=lambda items: nested(items, _text),
    code=lambda text: f"```\n{text}\n```")
