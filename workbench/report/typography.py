"""Words as they are set on a page: true minus signs, dashes between the ends of a range, options in one piece."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

_MINUS = re.compile(r"(?<![\w.)\]–−-])-(?=\d)")
# From a number to a greater one: 2631-1 is the name of a standard.
_RANGE = re.compile(r"(?<![\w.–−-])(\d+)-(\d+)(?![\w.–−-]*[\w–−-])")
_LINES = re.compile(r"(\(\d+\))-(?=\(\d+\))")  # equations (35)-(37)
_OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


def set_words(text: str) -> Markup:
    """A text as HTML."""
    text = _RANGE.sub(lambda ends: f"{ends[1]}–{ends[2]}" if int(ends[1]) < int(ends[2]) else ends[0], text)
    text = _LINES.sub(r"\1–", text)
    return Markup(_OPTION.sub(lambda option: f'<span class="unbroken">{option[0]}</span>',
                              str(escape(_MINUS.sub("−", text)))))
