"""Errata as Markdown, with formulas as browsers of repositories show them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from workbench.report.errata.blocks import Block, Item, Medium, written
from workbench.report.errata.tex_formula import is_mathematics
from workbench.report.worded import show

# Where a tag, or an address, would begin.
_TAG = re.compile(r"<(?=[A-Za-z/!?])")


def markdown(blocks: Sequence[Block]) -> str:
    """The document as Markdown."""
    return "\n\n".join(written(blocks, MARKDOWN)) + "\n"


def nested(items: Sequence[Item], text: Callable[[str], str]) -> str:
    """A list with two blanks a depth, as Markdown and Typst have it."""
    return "\n".join(f"{'  ' * item.depth}- {text(item.text)}" for item in items)


def _text(text: str) -> str:
    return show(text, lambda latex: f"${_spaced(latex)}$" if is_mathematics(latex) else _words(latex), _words)


def _words(text: str) -> str:
    """Words as they are: no emphasis, no tag of HTML, no link."""
    return _TAG.sub("&lt;", text.replace("*", r"\*").replace("_", r"\_")).replace("](", r"]\(")


def _spaced(latex: str) -> str:
    """A formula in which nothing is a tag or a link to a reader who knows no formulas: a blank means nothing in it."""
    return _TAG.sub("< ", latex).replace("](", "] (")


def _formula(latex: str, label: str) -> str:
    shown = f"$$\n{_spaced(latex)}\n$$" if is_mathematics(latex) else _words(latex)
    return (f"**{label}:**\n\n" if label else "") + shown


MARKDOWN = Medium(
    heading=lambda level, text: f"{'#' * level} {_text(text)}",
    paragraph=lambda text, label: (f"**{label}.** " if label else "") + _text(text),
    formula=_formula, items=lambda items: nested(items, _text),
    code=lambda text: f"```\n{text}\n```")
