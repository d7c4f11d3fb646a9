"""What a paper's text says of its constants besides their signs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection

from workbench.paper.source.bounds import bounded_in
from workbench.paper.source.letters import INLINE, NOT_EVERYWHERE, around, kinds_in, letters_said


def bounds_said(facts: str) -> list[str]:
    """The formulas of the facts that say more of letters than their signs, as `0 < a < 1`."""
    formulas = [(inline[1] or inline[2]).strip(" .,;") for inline in INLINE.finditer(facts)]
    return [*dict.fromkeys(one for one in formulas if len([*kinds_in(one)]) < len(bounded_in(one)))]


def unclear_bounds(facts: str, bounds: Collection[str], constants: Collection[str]) -> set[str]:
    """The letters of bounds that are not taken: of anything else than constants, on a condition, or of which another
    fact speaks too, since either may be meant for its own place alone; and those that stand with such a letter."""
    letters = {one: {*bounded_in(one)} for one in bounds}
    unclear = {letter for own in letters.values() if own - {*constants} for letter in own}
    for inline in INLINE.finditer(facts):
        own = letters.get((inline[1] or inline[2]).strip(" .,;"), set())
        unclear |= own if NOT_EVERYWHERE.search(around(facts, inline.start(), inline.end())) else set()
    spoken = Counter(letter for fact in {*facts.split("\n\n")} for letter in letters_said(fact))
    unclear |= {letter for own in letters.values() for letter in own if spoken[letter] > 1}
    unclear |= {letter for one, own in letters.items() for other, others in letters.items() if one != other
                for letter in own & others}
    while more := {letter for own in letters.values() if own & unclear for letter in own} - unclear:
        unclear |= more
    return unclear
