"""Errata as a LaTeX document that any installation of TeX sets."""

from __future__ import annotations

import re
from collections.abc import Sequence

from workbench.report.errata.blocks import Block, Code, Formula, Heading, Items, Paragraph
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
           "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "≤": r"$\le$", "≥": r"$\ge$", "≠": r"$\ne$",
           "→": r"$\to$", "±": r"$\pm$", "×": r"$\times$", "…": r"\ldots{}", "µ": r"$\mu$", "²": r"\textsuperscript{2}"}
LEVELS = {1: "section*", 2: "subsection*", 3: "subsubsection*"}


def latex_document(blocks: Sequence[Block]) -> str:
    """The document as LaTeX."""
    return HEAD + "\n\n".join(_block(block) for block in blocks) + "\n\n\\end{document}\n"


def _block(block: Block) -> str:
    match block:
        case Heading(level, text):
            return rf"\{LEVELS[level]}{{{_text(text)}}}"
        case Paragraph(text, label):
            return (rf"\textbf{{{_words(label)}.}} " if label else "") + _text(text)
        case Formula(latex, label):
            return (rf"\textbf{{{_words(label)}:}} " if label else "") + _formula(latex)
        case Items(texts, depths):
            return _items(texts, depths or (0,) * len(texts))
        case Code(text):
            return "{\\footnotesize\\begin{verbatim}\n" + text.replace(" --claim-digest", " \\\n  --claim-digest") + \
                "\n\\end{verbatim}}"


def _items(texts: Sequence[str], depths: Sequence[int]) -> str:
    """A list as paragraphs that stand in by their depth: LaTeX nests its own lists four deep only."""
    return "\n\n".join(rf"\hangindent={depth + 1}em\hspace*{{{depth}em}}\textbullet\ {_text(text)}"
                       for text, depth in zip(texts, depths, strict=True))


def _formula(latex: str) -> str:
    """Inline and in display style, so that long lines break between operators."""
    return rf"$\displaystyle {latex}$"


def _text(text: str) -> str:
    return show(text, lambda latex: f"${latex}$", _words)


def _words(text: str) -> str:
    return re.sub("|".join(map(re.escape, SPECIAL)), lambda found: SPECIAL[found[0]], text)
