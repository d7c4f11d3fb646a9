"""What readers without a mouse or a screen need of the pages: names of what scrolls, levels of headings, lists that
are lists, numbers with their units."""

from __future__ import annotations

import html
import re

from workbench.report.typography import quantities_in_one_piece

# Sphinx marks captions of lists of pages as headings without a level.
_CAPTION = re.compile(r'(<p class="caption" role="heading")>')
_SCROLLS = re.compile(r'<div class="(?:table-wrapper|math-wrapper|math)(?: [^"]*)?"(?=>)')
_OUTPUT = re.compile(r"<(?:pre|table)(?=>)")  # tables of outputs have no class
_HEADING = re.compile(r"<h[1-6][^>]*>(.*?)<a class=\"headerlink\"|<h[1-6][^>]*>(.*?)</h[1-6]>", re.DOTALL)
_TAG = re.compile(r"<[^>]*>")
# Tags, and what is no text to be set.
_MARKUP = re.compile(r"(<(?:pre|code|script|math|svg)\b.*?</(?:pre|code|script|math|svg)>|<[^>]*>)", re.DOTALL)
# Sphinx breaks a long signature into a list of definitions without a term.
_PARAMETERS = re.compile(r"<dl>\s*((?:<dd>(?:(?!</?d[ld]>).)*</dd>\s*)+)</dl>", re.DOTALL)
_RESULTS = '<div id="search-results">'
# The theme's two asides, which need names to be told apart.
ASIDES = {'<aside class="sidebar-drawer"': "All pages", '<aside class="toc-drawer': "On this page"}
KINDS = {"table-wrapper": "Table", "math-wrapper": "Formula", "math": "Formula"}


def accessible_tree(tree: str) -> str:
    """A list of pages whose captions are headings of a level."""
    return _CAPTION.sub(r'\1 aria-level="2">', tree)


def accessible_page(page: str) -> str:
    """A whole page whose asides are named; that of the search, for which the theme has no heading, with one."""
    page = page.replace(_RESULTS, f"<h1>Search</h1>\n{_RESULTS}")
    for aside, name in ASIDES.items():
        page = page.replace(aside, aside.replace("<aside", f'<aside aria-label="{name}"'))
    return page


def with_units(body: str) -> str:
    """A page's body in which no line breaks between a number and its unit; code is as it is."""
    return "".join(piece if i % 2 else quantities_in_one_piece(piece) for i, piece in enumerate(_MARKUP.split(body)))


def accessible(body: str) -> str:
    """A page's body in which what scrolls sideways is reached by the tabulator key; tables and formulas are regions,
    named by what they are, their number on the page and the heading above them."""
    headings = [(found.start(), html.unescape(_TAG.sub("", found[1] or found[2])).strip())
                for found in _HEADING.finditer(body)]
    counted: dict[str, int] = {}

    def named(found: re.Match[str]) -> str:
        kind = KINDS[found[0].split('"')[1].split()[0]]
        counted[kind] = counted.get(kind, 0) + 1
        above = next((text for start, text in reversed(headings) if start < found.start()), "")
        label = f"{kind} {counted[kind]}{f': {above}' if above else ''}"
        return f'{found[0]} tabindex="0" role="region" aria-label="{html.escape(label)}"'

    body = _PARAMETERS.sub(_as_lines, with_units(body))
    return accessible_tree(_OUTPUT.sub(r'\g<0> tabindex="0"', _SCROLLS.sub(named, body)))


def _as_lines(signature: re.Match[str]) -> str:
    """A parameter a line, as the theme sets them."""
    lines = signature[1].replace("<dd>", '<div class="parameter">').replace("</dd>", "</div>")
    return f"<div>{lines}</div>"
