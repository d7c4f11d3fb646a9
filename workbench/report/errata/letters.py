"""Blocks with the letters of a paper, and what the others in them stand for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from workbench.report.dots import dotted, dotted_text
from workbench.report.errata.blocks import Block, Formula, Items, Paragraph
from workbench.report.hypotheses import Need
from workbench.report.letters import Letters
from workbench.report.worded import show


def in_blocks(blocks: Iterable[Block], letters: Letters) -> list[Block]:
    """Formulas and texts with the paper's symbols."""
    return [_in_block(block, letters) for block in blocks]


def legend(blocks: Sequence[Block], letters: Letters, needs: Sequence[Need] = ()) -> str:
    """What the letters stand for that are in these blocks and not the paper's; empty where none is, or where all of it
    stands with what a corrected statement needs."""
    told = letters.legend(formula for block in blocks for formula in _formulas(block))
    before = {part for need in needs for part in need.letters.removesuffix(".").split("; ")}
    return "" if {*told.removesuffix(".").split("; ")} <= before else told


def with_dots(blocks: Iterable[Block]) -> list[Block]:
    """Formulas and texts with rates as dots over letters."""
    return [_with_dots(block) for block in blocks]


def _with_dots(block: Block) -> Block:
    match block:
        case Formula(latex, label):
            return Formula(dotted(latex), label)
        case Paragraph(text, label):
            return Paragraph(dotted_text(text), label)
        case Items(items):
            return Items(tuple(replace(item, text=dotted_text(item.text)) for item in items))
    return block


def _in_block(block: Block, letters: Letters) -> Block:
    match block:
        case Formula(latex, label):
            return Formula(letters.in_formula(latex), label)
        case Paragraph(text, label):
            return Paragraph(_in_text(text, letters), label)
        case Items(items):
            return Items(tuple(replace(item, text=_in_text(item.text, letters)) for item in items))
    return block


def _in_text(text: str, letters: Letters) -> str:
    return show(text, lambda latex: f"${letters.in_formula(latex)}$")


def _formulas(block: Block) -> list[str]:
    match block:
        case Formula(latex, _):
            return [latex]
        case Paragraph(text, _):
            return text.split("$")[1::2]
        case Items(items):
            return [formula for item in items for formula in item.text.split("$")[1::2]]
    return []
