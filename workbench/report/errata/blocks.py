"""A document as a list of blocks; each format renders them its own way. Formulas in texts stand between dollars."""

from __future__ import annotations

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
class Items:
    """A list; depths: how deep each item lies, from 0; numbered: whether they count."""

    texts: tuple[str, ...]
    depths: tuple[int, ...] = ()
    numbered: bool = False


@dataclass(frozen=True)
class Code:
    """Lines as they are typed into a terminal."""

    text: str


Block = Heading | Paragraph | Formula | Items | Code
