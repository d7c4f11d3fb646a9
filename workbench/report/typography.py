"""Words as they are set on a page: true minus signs, dashes between the ends of a range, options in one piece,
and a number with its unit."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

_MINUS = re.compile(r"(?<![\w.)\]–−-])-(?=\d)")
# From a number to a greater one: 2631-1 is the name of a standard.
_RANGE = re.compile(r"(?<![\w.–−-])(\d+)-(\d+)(?![\w.–−-]*[\w–−-])")
_LINES = re.compile(r"(\(\d+\))-(?=\(\d+\))")  # equations (35)-(37)
# A number and its unit: a space that does not break would not be found by who searches for a plain one.
_QUANTITY = re.compile(
    r"(?<![\w.])(\d[\d.,\u202f]*|\d+(?:\.\d+)?\u202f×\u202f10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+) "
    r"(%|‰|°|(?:[kM]?(?:Wh?|J|N)|k?g|t|h|min|k?Hz|rad|[mkµ]?m|[mµ]?s)(?:/(?:h|kg|m|s))?[²³]?)(?!\w|/)")
_OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


def set_words(text: str) -> Markup:
    """A text as HTML."""
    text = _RANGE.sub(lambda ends: f"{ends[1]}–{ends[2]}" if int(ends[1]) < int(ends[2]) else ends[0], text)
    text = _LINES.sub(r"\1–", text)
    text = str(escape(_MINUS.sub("−", text)))
    return Markup(_OPTION.sub(_in_one_piece, quantities_in_one_piece(text)))


def set_command(text: str) -> Markup:
    """A line for a terminal as HTML, letter by letter, in which no option is broken behind its dashes."""
    return Markup(_OPTION.sub(_in_one_piece, str(escape(text))))


def quantities_in_one_piece(text: str) -> str:
    """Words of HTML, without its tags, in which numbers stay with their units."""
    return _QUANTITY.sub(_in_one_piece, text)


def _in_one_piece(found: re.Match[str]) -> str:
    return f'<span class="unbroken">{found[0]}</span>'
