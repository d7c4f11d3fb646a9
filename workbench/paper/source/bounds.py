"""Formulas that say between which numbers and letters some letters lie."""

from __future__ import annotations

from functools import lru_cache

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.sides import letter_latex
from workbench.proof.latex.tree import Letter, Number


@lru_cache(maxsize=4096)
def bounded_in(formula: str) -> dict[str, str]:
    """The letters of a formula that says between which numbers and letters each lies, as `0 < a < 1` or `b > c > 0`,
    and positive or real of each by that; none of a formula that says anything else, or no more than signs."""
    try:
        chains = read_line(formula).chains
    except LatexError:
        return {}
    found: dict[str, str] = {}
    for chain in chains:
        rising = {*chain.signs} <= {"<", "<="}
        if not chain.signs or not (rising or {*chain.signs} <= {">", ">="}):
            return {}
        sides, signs = (chain.sides, chain.signs) if rising else (chain.sides[::-1], chain.signs[::-1])
        above, strictly = False, False  # whether what stands before is known to be at least zero, and above it
        for side, sign in zip(sides, ("", *signs), strict=True):
            if isinstance(side, Number):
                above, strictly = side.value >= 0, side.value > 0
                continue
            if not isinstance(side, Letter):
                return {}
            strictly = strictly or (above and sign in ("<", ">"))
            found.setdefault(letter_latex(side), "positive" if strictly else "real")
    return found
