"""What a printed line says, as a tree of its own: nothing is evaluated, nothing is known of the letters yet.

Two lines that are typed differently and read the same (`x_1`, `x_{1}`, `{x}_1`) have equal trees. Positions are
counted in characters from the line's start; they are for messages and do not enter comparisons.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from fractions import Fraction
from typing import Any

END = ";"  # a semicolon or full stop: what stands behind it is no member of a list before it
PARTED = ((), (",",), (END,))  # what may stand between relations that are all claimed
_INDEX_PART = re.compile(r"\\[A-Za-z]+ ?|max|min|.", re.DOTALL)  # max and min are words, as their commands are


@dataclass(frozen=True)
class Node:
    """One part of a line; `position` is where it starts."""

    position: int = field(compare=False, kw_only=True, default=0)


@dataclass(frozen=True)
class Number(Node):
    """A number without sign, exactly; with a mark it names one side of it, as in `f(1^-)`."""

    value: Fraction
    mark: str = ""


@dataclass(frozen=True)
class Words(Node):
    """Words where a formula could stand."""

    text: str


@dataclass(frozen=True)
class Letter(Node):
    """A letter with its marks: accents from the inside to the outside, index, and superscripts that are no powers."""

    name: str
    accents: tuple[str, ...] = ()
    index: str = ""
    mark: str = ""

    def index_parts(self) -> tuple[str, ...]:
        """The letters, digits and commas of its index, in order; a command with the blank behind it."""
        return tuple(_INDEX_PART.findall(self.index))


@dataclass(frozen=True)
class Named(Node):
    """A function by its name, such as tanh, sat or max; its argument is what follows it in a product."""

    name: str
    index: str = ""


@dataclass(frozen=True)
class Big(Node):
    """A sum, product, integral or limit sign with what stands below and above it; it takes the rest of its product."""

    name: str
    below: str = ""
    above: Node | None = None


@dataclass(frozen=True)
class Ellipsis(Node):
    """Dots that stand for what is not printed."""


@dataclass(frozen=True)
class Dot(Node):
    """A multiplication sign."""


@dataclass(frozen=True)
class Product(Node):
    """Factors side by side, in the order in which they are printed."""

    factors: tuple[Node, ...]


@dataclass(frozen=True)
class Quotient(Node):
    r"""\frac, or a division by a slash."""

    top: Node
    bottom: Node


@dataclass(frozen=True)
class Terms(Node):
    """A sum of terms, each with its sign."""

    terms: tuple[tuple[int, Node], ...]


@dataclass(frozen=True)
class Power(Node):
    """A base with an exponent."""

    base: Node
    exponent: Node


@dataclass(frozen=True)
class Transposed(Node):
    """A vector or matrix transposed."""

    base: Node


@dataclass(frozen=True)
class Root(Node):
    """A square root."""

    body: Node


@dataclass(frozen=True)
class Accented(Node):
    """An accent over more than a letter."""

    accent: str
    body: Node


@dataclass(frozen=True)
class Size(Node):
    """What stands between bars: `|` or, for a norm, `||`."""

    bars: str
    parts: tuple[Node, ...]


@dataclass(frozen=True)
class At(Node):
    """A bar with an index: the value at some place."""

    index: str


@dataclass(frozen=True)
class Chain(Node):
    """Sides and the relation signs between them; a single side has no sign."""

    sides: tuple[Node, ...]
    signs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Line(Node):
    """Chains and what stands between, before and after them: commas, arrows, words.

    separators[i] stands before chains[i]; the last one ends the line, so there is one more of them than chains.
    """

    chains: tuple[Chain, ...]
    separators: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Group(Node):
    """A pair of brackets, by the sign that opens and the sign that closes it, with what stands between them."""

    opening: str
    closing: str
    line: Line


def parts_of(node: Any) -> Iterator[Node]:
    """All nodes within one, itself first; of a tuple those of its members."""
    if isinstance(node, Node):
        yield node
    for part in children(node):
        yield from parts_of(part)


def children(node: Any) -> Iterator[Node]:
    """The nodes directly within one, or within a tuple."""
    within = node if isinstance(node, tuple) else [getattr(node, one.name) for one in fields(node)] if isinstance(
        node, Node) else ()
    for part in within:
        if isinstance(part, Node):
            yield part
        elif isinstance(part, tuple):
            yield from children(part)


def letters_of_node(node: Any) -> set[Letter]:
    """The letters within a node, each with its marks."""
    return {part for part in parts_of(node) if isinstance(part, Letter)}
