r"""Which letters are numbers because sums that are numbers say so: in `\dot x = a x + u`, where x is one, a and u are.

Terms of a sum and sides of a relation are all numbers or none is, and a product of numbers and one other factor is a
number where that factor is one. Letters that only stand beside each other, as `W \phi`, may be a row and a column:
nothing follows of them. A small letter that is printed squared is a number, where none is printed as a column.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from fractions import Fraction
from itertools import pairwise

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.sides import is_of_time, letter_latex
from workbench.proof.latex.tree import (
    Chain,
    Group,
    Letter,
    Named,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Root,
    Size,
    Terms,
    Transposed,
    parts_of,
)

_ORDER = {"<", ">", "<=", ">="}


def scalar_letters(lines: Iterable[str], known: Collection[str]) -> set[str]:
    """The letters of lines that are numbers, with those that are known to be."""
    chains: list[Chain] = []
    for line in lines:
        try:
            chains += [part for part in parts_of(read_line(line)) if isinstance(part, Chain) and part.signs]
        except LatexError:
            continue
    others = {letter_latex(one) for chain in chains for part in parts_of(chain) for one in _no_numbers(part)}
    numbers = {*known} - others
    shown = [part for chain in chains for part in parts_of(chain)]
    if not any(isinstance(part, Transposed) or (isinstance(part, Size) and part.bars != "|") for part in shown):
        numbers |= {letter_latex(letter) for part in shown for letter in _squared(part)} - others
    while more := {letter for chain in chains for letter in _of_chain(chain, numbers)} - numbers - others:
        numbers |= more
    return numbers


def _squared(part: Node) -> Iterator[Letter]:
    """The small letter that a part is the square of, as no column is where none is transposed."""
    if isinstance(part, Power) and isinstance(part.base, Letter) and part.exponent == Number(Fraction(2)) and (
            part.base.name.lstrip("\\")[:1].islower()):
        yield part.base


def _no_numbers(part: Node) -> Iterator[Letter]:
    """The letters that a part shows as columns, or as functions of what stands in brackets behind them."""
    if isinstance(part, Transposed):
        yield from (one for one in parts_of(part) if isinstance(one, Letter))
    elif isinstance(part, Product):
        yield from (one for one, two in pairwise(part.factors) if isinstance(one, Letter) and isinstance(
            two, Group) and two.opening == "(" and not is_of_time(two))


def _of_chain(chain: Chain, numbers: Collection[str]) -> Iterator[str]:
    """The letters that a relation shows to be numbers."""
    terms = [term for side in chain.sides for term in _terms(side)]
    if {*chain.signs} & _ORDER or any(_is_number(term, numbers) for term in terms):
        for term in terms:
            yield from _of_number(term, numbers)


def _terms(side: Node) -> list[Node]:
    return [term for _, term in side.terms] if isinstance(side, Terms) else [side]


def _of_number(node: Node, numbers: Collection[str]) -> Iterator[str]:
    """The letters that are numbers because a node is one."""
    if isinstance(node, Letter):
        yield letter_latex(node)
    elif isinstance(node, Terms):
        for term in _terms(node):
            yield from _of_number(term, numbers)
    elif isinstance(node, Group) and len(node.line.chains) == 1 and not node.line.chains[0].signs:
        yield from _of_number(node.line.chains[0].sides[0], numbers)
    elif isinstance(node, (Product, Quotient)):
        open_ = [factor for factor in _factors(node) if not _is_number(factor, numbers)]
        if len(open_) == 1:
            yield from _of_number(open_[0], numbers)
    elif isinstance(node, Power) and isinstance(node.exponent, Number):
        yield from _of_number(node.base, numbers)
    elif isinstance(node, Root):
        yield from _of_number(node.body, numbers)


def _factors(node: Node) -> list[Node]:
    """The factors of a product or quotient: letters without their time, functions with their argument."""
    if isinstance(node, Quotient):
        return [*_factors(node.top), *_factors(node.bottom)]
    if not isinstance(node, Product):
        return [node]
    found: list[Node] = []
    parts = [*node.factors]
    while parts:
        part = parts.pop(0)
        behind = parts[0] if parts else None
        if isinstance(part, Letter) and isinstance(behind, Group) and is_of_time(behind):
            parts.pop(0)
        if isinstance(part, Named) and behind is not None:
            part = parts.pop(0)  # of a number it is one
            found += [Size(bars="|", parts=(part,))]
            continue
        found.append(part)
    return found


def _is_number(node: Node, numbers: Collection[str]) -> bool:
    if isinstance(node, Letter):
        return letter_latex(node) in numbers
    if isinstance(node, Terms):
        return any(_is_number(term, numbers) for term in _terms(node))
    return isinstance(node, Number) or (_whole(node) and all(_is_number(part, numbers) for part in _within(node)))


def _whole(node: Node) -> bool:
    """Whether a node is a number where what is within it are numbers."""
    return isinstance(node, (Product, Quotient, Power, Root, Size)) or (
        isinstance(node, Group) and len(node.line.chains) == 1 and not node.line.chains[0].signs)


def _within(node: Node) -> list[Node]:
    if isinstance(node, Power):
        return [node.base]
    if isinstance(node, Root):
        return [node.body]
    if isinstance(node, Size):
        return [*node.parts]
    return [node.line.chains[0].sides[0]] if isinstance(node, Group) else _factors(node)
