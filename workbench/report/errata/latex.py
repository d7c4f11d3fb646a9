"""Errata as a LaTeX document that any installation of TeX sets."""

from __future__ import annotations

import re
from collections.abc import Sequence

from workbench.report.errata.blocks import Block, Item, Medium, written
from workbench.report.errata.tex_formula import is_mathematics
from workbench.report.worded import show

HEAD = r"""\documentclass[a4paper,11pt]{article}
\usepackage[T1]{fontenc}
\usepackage[utf8]{inputenc}
\usepackage{amsmath,amssymb,bm}
\usepackage[margin=25mm]{geometry}
\setlength{\parindent}{0pt}\setlength{\parskip}{6pt}
\allowdisplaybreaks
\begin{document}
"""
SPECIAL = {"\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
           "$": r"\$",
           "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "≤": r"$\le$", "≥": r"$\ge$", "≠": r"$\ne$",
           "→": r"$\to$", "±": r"$\pm$", "×": r"$\times$", "…": r"\ldots{}", "µ": r"$\mu$", "²": r"\textsuperscript{2}"}
LEVELS = {1: "section*", 2: "subsection*", 3: "subsubsection*"}


def latex_document(blocks: Sequence[Block]) -> str:
    """The document as LaTeX."""
    return HEAD + "\n\n".join(written(blocks, LATEX)) + "\n\n\\end{document}\n"


def _items(items: Sequence[Item]) -> str:
    """A list as paragraphs that stand in by their depth: LaTeX nests its own lists four deep only."""
    return "\n\n".join(rf"\hangindent={item.depth + 1}em\hspace*{{{item.depth}em}}\textbullet\ {_text(item.text)}"
                       for item in items)


def _code(text: str) -> str:
    return "{\\footnotesize\\begin{verbatim}\n" + text.replace(" --claim-digest", " \\\n  --claim-digest") + \
        "\n\\end{verbatim}}"


def _formula(latex: str, label: str) -> str:
    """Inline and in display style, so that long lines break between operators."""
    return (rf"\textbf{{{_words(label)}:}} " if label else "") + _between_dollars(latex, r"\displaystyle ")


def _between_dollars(latex: str, style: str = "") -> str:
    """A formula; one that holds more than mathematics as it is written, letter by letter."""
    return f"${style}{latex}$" if is_mathematics(latex) else rf"\texttt{{{_words(latex)}}}"


def _text(text: str) -> str:
    return show(text, _between_dollars, _words)


def _words(text: str) -> str:
    return re.sub("|".join(map(re.escape, SPECIAL)), lambda found: SPECIAL[found[0]], text)


LATEX = Medium(
    heading=lambda level, text: rf"\{LEVELS[level]}{{{_text(text)}}}",
    paragraph=lambda text, label: (rf"\textbf{{{_words(label)}.}} " if label else "") + _text(text),
    formula=_formula, items=_items, code=_code)
