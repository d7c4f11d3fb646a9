"""Errata as one page of HTML, with formulas that browsers draw and nothing from elsewhere."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from workbench.report.errata.blocks import Block, Item, Medium, written
from workbench.report.formulas import formula, in_html
from workbench.report.math_font import math_font

# What is out of sight is not laid out: a thousand formulas take a second, and more on a telephone.
STYLE = """:root{color-scheme:light dark}body{font:1.05rem/1.55 Georgia,serif;max-width:46rem;margin:2rem auto;
padding:0 1rem}h1,h2,h3{line-height:1.25;font-family:system-ui,sans-serif}h2{margin-top:2.5rem;border-bottom:1px solid
#8886}h3{margin-top:2rem;font-size:1.05rem}.formula{margin:.6rem 0;overflow-x:auto}.label{font:600 .85rem
system-ui,sans-serif;display:block;margin-bottom:.25rem;opacity:.75}
math{font-size:1.05em;font-family:"Page Math",math}pre{font-size:.78rem;white-space:pre-wrap;
overflow-wrap:anywhere;background:#8881;padding:.5rem}
ul{padding-left:1.2rem}li{margin:.25rem 0}.unbroken{white-space:nowrap}p,.item{overflow:auto hidden}
@media screen{p,.item,.formula{content-visibility:auto;contain-intrinsic-height:auto 2rem}}
@media print{p,.item,.formula{overflow:visible}body{max-width:none;margin:0;font-size:10pt}}"""
WIDE = 30  # letters of a formula's LaTeX, of which some are no more than commands
POLICY = "default-src 'none'; style-src 'unsafe-inline'; font-src data:; base-uri 'none'; form-action 'none'"


def html_document(blocks: Sequence[Block], title: str) -> str:
    """The document as one page of HTML."""
    style, body = Markup(math_font() + STYLE), Markup("\n").join(written(blocks, HTML))
    return str(Markup(
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta http-equiv="Content-Security-Policy" content="{}">\n<title>{}</title>\n<style>{}</style>\n</head>\n'
        "<body>\n<main>\n{}\n</main>\n</body>\n</html>\n").format(Markup(POLICY), title, style, body))


def _paragraph(text: str, label: str) -> Markup:
    bold = Markup("<strong>{}.</strong> ").format(label) if label else Markup("")
    return Markup("<p{}>{}{}</p>").format(_reached(text), bold, in_html(text))


def _reached(text: str) -> Markup:
    """What lets keys scroll a text with a formula that a telephone may be too narrow for."""
    wide = any(len(latex) > WIDE for latex in text.split("$")[1::2])
    return Markup(' tabindex="0" role="group" aria-label="Text with a wide formula"') if wide else Markup("")


def _formula(latex: str, label: str) -> Markup:
    above = Markup('<span class="label">{}</span>').format(label) if label else Markup("")
    return Markup('<div class="formula" tabindex="0" role="group" aria-label="{}">{}{}</div>').format(
        label or "Formula", above, formula(latex))


def _items(items: Sequence[Item]) -> Markup:
    """Nested lists, one `ul` a depth, each within the item above it."""
    found, at = Markup(""), -1
    for item in items:
        if item.depth <= at:
            found += Markup("</li></ul>") * (at - item.depth) + Markup("</li>")
        found += Markup("<ul><li>") * (item.depth - at) or Markup("<li>")
        found, at = found + Markup('<div class="item"{}>{}</div>').format(
            _reached(item.text), in_html(item.text)), item.depth
    return found + Markup("</li></ul>") * (at + 1)


HTML = Medium(
    heading=lambda level, text: Markup("<h{0}>{1}</h{0}>").format(level, in_html(text)), paragraph=_paragraph,
    formula=_formula, items=_items, code=lambda text: Markup("<pre>{}</pre>").format(text))
