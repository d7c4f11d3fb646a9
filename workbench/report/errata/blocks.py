"""A document as a list of blocks; each format renders them its own way. Formulas in texts stand between dollars."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Heading:
    """A heading of level 1 to 3."""

    level: int
    text: str


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; label: what stands in front of it in bold."""

    text: str
    label: str = ""


@dataclass(frozen=True)
class Formula:
    """A displayed formula as LaTeX; label: a word or two in front of it."""

    latex: str
    label: str = ""


@dataclass(frozen=True)
class Item:
    """A line of a list; depth: how many lines it lies inside of."""

    text: str
    depth: int = 0


@dataclass(frozen=True)
class Items:
    """A list, each line below the last one that is less deep."""

    items: tuple[Item, ...]


@dataclass(frozen=True)
class Code:
    """Lines as they are typed into a terminal."""

    text: str


Block = Heading | Paragraph | Formula | Items | Code


@dataclass(frozen=True)
class Medium:
    """How a format writes each kind of block: a function of the block's fields, in their order."""

    heading: Callable[[int, str], str]
    paragraph: Callable[[str, str], str]
    formula: Callable[[str, str], str]
    items: Callable[[Sequence[Item]], str]
    code: Callable[[str], str]


def written(blocks: Sequence[Block], medium: Medium) -> list[str]:
    """The blocks, each as the format writes it."""
    return [_written(block, medium) for block in blocks]


def _written(block: Block, medium: Medium) -> str:
    match block:
        case Heading(level, text):
            return medium.heading(level, text)
        case Paragraph(text, label):
            return medium.paragraph(text, label)
        case Formula(latex, label):
            return medium.formula(latex, label)
        case Items(items):
            return medium.items(items)
        case Code(text):
            return medium.code(text)
