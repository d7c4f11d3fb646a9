"""For what a corrected statement is proved, as blocks directly below it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from workbench.proof.places import place_of
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Formula, Paragraph
from workbench.report.errata.conditions import ALONG, UNDER, listed_conditions
from workbench.report.errata.names import listed_lines
from workbench.report.hypotheses import Need
from workbench.report.worded import worded

_SIGN = re.compile(r"[^=<>]* (?:>|\\ge|\\ne) 0")
# What stands in front of the conditions of a corrected line, and of its motion where there are none: not of the finding
# behind it, which is of the line as printed.
HOLDS_UNDER, HOLDS_FOR = "It holds under the conditions", "It holds for the motion with"
MOST = 4000  # characters of LaTeX beyond which a reader is sent to the proofs of the lines that a proof uses


def needed(needs: Sequence[Need]) -> list[Block]:
    """The conditions of a statement and the motion along which it holds; then the same of each line of ours that its
    proof uses, which says what letters are in it, or where all of that stands."""
    blocks = [block for need in needs[:1] for block in _conditions(need)]
    plain = [need for need in needs[1:] if not need.rates and all(map(_SIGN.fullmatch, need.conditions))]
    used = [need for need in needs[1:] if need not in plain]
    if sum(len(text) for need in used for text in (need.statement, *need.conditions, *need.rates)) > MOST:
        names = _names(used)
        return [*blocks, Paragraph(f"{names}, which are part of the statement: what each says, under which conditions "
                                   "and along which motion, is written out with the proofs below.", "Its proof uses")]
    if used:
        blocks.append(Paragraph("The lines below; a condition that one of them shows is met.", "Its proof uses"))
    for need in used:
        blocks += [Paragraph(f"{worded(place_of(need.equation, need.title))}, which is:", "It uses"),
                   Formula(need.statement), *_conditions(need)]
    last = Paragraph(f"{_names(plain)}, under no conditions but the signs of letters.", "It uses")
    return [*blocks, *([last] if plain else [])]


def _names(needs: Sequence[Need]) -> str:
    return worded(listed_lines([place_of(need.equation, need.title) for need in needs]))


def _conditions(need: Need) -> list[Block]:
    uses = worded(listed(need.uses))
    told = (("Letters", need.letters), ("Also used", f"{uses}." if uses else ""))
    under, along = (HOLDS_UNDER, ALONG) if need.conditions else (UNDER, HOLDS_FOR)
    return [*listed_conditions({under: need.conditions, along: need.rates}),
            *(Paragraph(text, label) for label, text in told if text)]
