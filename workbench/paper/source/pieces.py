"""The pieces of running text: words, formulas, references, marks, and commands that say nothing."""

from __future__ import annotations

import re

from workbench.paper.source.macros import SourceError

LEVELS = {"part": 0, "chapter": 1, "section": 2, "subsection": 3, "subsubsection": 4, "paragraph": 5,
          "subparagraph": 6}
SKIPPED = ("verbatim", "lstlisting", "comment", "thebibliography", "tikzpicture", "tabular", "algorithm")
TABLES = ("tabular", "algorithm")  # their words are skipped; their formulas may say what values letters have
PIECE = re.compile(r"""
    (?P<begin>\\begin\s*\{(?P<begun>[^{}]*)\}) | (?P<end>\\end\s*\{(?P<ended>[^{}]*)\})
  | (?P<item>\\item(?![A-Za-z])(?:\s*\[(?P<labelled>[^\]]*)\])?)
  | \\(?P<heading>part|chapter|(?:sub)*section|(?:sub)?paragraph)(?![A-Za-z])\*?
  | (?P<math>(?<![\\$])\$(?!\$)(?P<formula>.+?)(?<!\\)\$)
  | \(\s*\\ref\*?\s*\{(?P<bracketed>[^{}]*)\}\s*\)
  | \\(?P<ref>eqref|[cC]ref|autoref|ref|pageref)\*?\s*\{(?P<labels>[^{}]*)\}
  | (?P<cite>\\cite[a-z]*\*?(?:\s*\[[^\]]*\])*\s*\{[^{}]*\})
  | (?P<aside>\\(?:footnote|footnotetext|marginpar|caption|thanks)(?![A-Za-z])(?:\s*\[[^\]]*\])?)
  | (?P<gone>\\(?:label|vspace|hspace|setcounter|bibliographystyle|bibliography|documentclass|usepackage|newtheorem
      |title|author|date|numberwithin|includegraphics|theoremstyle|pagestyle|thispagestyle|addtocounter|graphicspath
      |setlength)(?![A-Za-z])\*?)
  | (?P<layout>\\(?:noindent|indent|medskip|smallskip|bigskip|newpage|clearpage|centering|small|qed|hfill|maketitle
      |appendix|tableofcontents|allowdisplaybreaks|emph|textbf|textit|textrm|textsl|textsc|underline|bf|it|em|quad|qquad|linebreak
      |newline|pagebreak|par|displaystyle|frontmatter|mainmatter|backmatter|bfseries|itshape|rm|par|proofname|qedhere
      |IEEEPARstart|mbox|text|nobreak|hskip|protect|footnotesize|normalsize|large|Large|left|right)(?![A-Za-z])\s*
      |\\[ ,;:!/\\\n-]|[{}~]|\$\$)
  | (?P<blank>\n[ \t]*\n\s*)
  | (?P<number>\(\s*[A-Z]?\d+(?:\.\d+)*[a-z]?'?\s*\)|\d+(?:\.\d+)*)
  | (?P<listed>\((?:[ivx]{1,4}|[a-h])\))
  | (?P<short>\b(?:i\.\s?e\.|e\.\s?g\.|w\.\s?r\.\s?t\.|cf\.|[Ee]qs?\.|[Tt]hm\.|[Ff]igs?\.|[Ss]ec\.|resp\.|a\.\s?e\.))
  | (?P<word>[^\W\d_]+(?:(?:['’]|--?)[^\W\d_]+)*(?:['’](?![a-z'’]))?)
  | (?P<open>\() | (?P<close>\))
  | (?P<mark>[.,;:!?])
  | (?P<command>\\(?:[A-Za-z@]+\*?|.)) | (?P<odd>\S)
""", re.VERBOSE | re.DOTALL)
# The name of the whole piece, by that of its last part.
WHOLE = {"begun": "begin", "ended": "end", "formula": "math", "labels": "ref", "bracketed": "ref"}
WRITTEN_OUT = {"i.e.": ("that", "is", ","), "w.r.t.": ("with", "respect", "to"), "eq.": ("equation",),
                "eqs.": ("equations",), "thm.": ("theorem",), "fig.": ("figure",), "figs.": ("figure",),
                "sec.": ("section",), "cf.": ("by",)}
_RUNNING = re.compile(
    r"\\(?:csname|expandafter|catcode|if(?!f(?![A-Za-z]))[A-Za-z]*|else|or|fi|loop|futurelet|edef|gdef|xdef|aftergroup|"
    r"afterassignment|write|immediate|scantokens|lowercase|uppercase)(?![A-Za-z])")
ENDS = (".", "!", "?")


def require_plain(body: str) -> None:
    r"""Raise SourceError for what TeX decides only as it runs, as `\\csname` and `\\ifx`: its text cannot be known."""
    found = _RUNNING.search(body)
    if found is not None:
        line = body.count("\n", 0, found.start()) + 1
        raise SourceError(f"{found.group()} in line {line} of the document's body is decided as TeX runs: put in what "
                          "it stands for")
