"""For what a corrected statement is proved, as blocks directly below it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from workbench.proof.places import place_of
from workbench.proof.wording import listed
from workbench.report.errata.blocks import Block, Formula, Paragraph
from workbench.report.errata.conditions import ALONG, UNDER, listed_conditions
from workbench.report.hypotheses import Need
from workbench.report.worded import worded

_SIGN = re.compile(r"[^=<>]* (?:>|\\ge|\\ne) 0")
MOST = 4000  # characters of LaTeX beyond which a reader is sent to the proofs of the lines that a proof uses


def needed(needs: Sequence[Need]) -> list[Block]:
    """The conditions of a statement and the motion along which it holds; then the same of each line of ours that its
    proof uses, which says what letters are in it, or where all of that stands."""
    blocks = [block for need in needs[:1] for block in _conditions(need)]
    plain = [need for need in needs[1:] if not need.rates and all(map(_SIGN.fullmatch, need.conditions))]
    used = [need for need in needs[1:] if need not in plain]
    if sum(len(text) for need in used for text in (need.statement, *need.conditions, *need.rates)) > MOST:
        names = worded(listed([f"“{need.title}”" for need in used]))
        return [*blocks, Paragraph(f"{names}, which are part of the statement: what each says, under which conditions "
                                   "and along which motion, is written out with the proofs below.", "Its proof uses")]
    if used:
        blocks.append(Paragraph("The lines below; a condition that one of them shows is met.", "Its proof uses"))
    for need in used:
        blocks += [Paragraph(f"{worded(place_of(need.equation, need.title))}, which is:", "It uses"),
                   Formula(need.statement), *_conditions(need)]
    names = worded(listed([place_of(need.equation, need.title) for need in plain]))
    last = Paragraph(f"{names}, under no conditions but the signs of letters.", "It uses")
    return [*blocks, *([last] if plain else [])]


def _conditions(need: Need) -> list[Block]:
    uses = worded(listed(need.uses))
    told = (("Letters", need.letters), ("Also used", f"{uses}." if uses else ""))
    return [*listed_conditions({UNDER: need.conditions, ALONG: need.rates}),
            *(Paragraph(text, label) for label, text in told if text)]
