"""Headings of Markdown as those of LaTeX; its formulas between dollar signs are the same."""

from __future__ import annotations

import re

_HEADING = re.compile(r"(?m)^(#{1,4})[ \t]+(.*?)[ \t]*#*[ \t]*$")
_LEVELS = ("section", "section", "subsection", "subsubsection")


def with_latex_headings(text: str) -> str:
    """A text with its Markdown headings as sections, without the title in its first line; LaTeX as it is.

    What is struck out, `~~so~~`, stands behind a command that nothing knows, so that it is not understood.
    """
    if r"\documentclass" in text or r"\begin{document}" in text:
        return text
    title = _HEADING.match(text.lstrip())
    body = text.lstrip()[title.end():] if title and len(title[1]) == 1 else text
    return _HEADING.sub(lambda found: rf"\{_LEVELS[len(found[1]) - 1]}{{{found[2]}}}", body.replace("~~", r" \struck "))
