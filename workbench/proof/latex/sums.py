"""Signs that take the rest of their product: sums are carried out, integrals and limits are pieces of a notation."""

from __future__ import annotations

import re
from dataclasses import fields, is_dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any, Protocol

import sympy as sp

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.limits import MOST_SUMMANDS
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.read import read_line
from workbench.proof.latex.tree import Big, Dot, Group, Letter, Node, Number, Product, Terms, letters_of_node, parts_of
from workbench.proof.latex.vectors import is_vector

_INDEX = re.compile(r"(?P<letter>(\\[A-Za-z]+|[A-Za-z])(_\w+)?)(=(?P<first>.+))?", re.DOTALL)


class Reading(Protocol):
    """What turns the nodes behind a sign into expressions."""

    @property
    def limits(self) -> sp.Tuple | None:
        """The limits of the goal's sums."""

    @property
    def notation(self) -> Notation:
        """What letters stand for."""

    @property
    def index(self) -> str | None:
        """The letter of the sum within which the nodes stand."""

    def number(self, node: Node) -> sp.Expr:
        """The expression of a node that is a number."""

    def product(self, factors: tuple[Node, ...]) -> sp.Expr:
        """The product of factors."""

    def within(self, index: str | None) -> Reading:
        """The same, within a sum."""


def big(converter: Reading, sign: Big, rest: tuple[Node, ...]) -> sp.Expr:
    """The value of a sign with what follows it; raises LatexError where the notation does not give it."""
    if not rest:
        raise LatexError(f"nothing stands behind '\\{sign.name}': complete the line", sign.position)
    if sign.name == "sum":
        return _sum(converter, sign, rest)
    if sign.name == "int":
        parts = _integrals(sign, rest)
        if parts:
            return sp.Add(*(factor * converter.product(part) for factor, part in parts))
    raise LatexError(f"this piece from '\\{sign.name}' on is not in the notation: give it there, with all it applies "
                     "to", sign.position)


def _sum(converter: Reading, sign: Big, rest: tuple[Node, ...]) -> sp.Expr:
    found = _INDEX.fullmatch(sign.below.replace(" ", ""))
    if found is None or converter.index is not None:
        raise LatexError("a sum over one index, not within another, is read: write \\sum_{j=1}^{n}", sign.position)
    letter = found["letter"]
    ends = _ends(converter, found["first"], sign)
    if ends is not None and all(end.is_Integer for end in ends):
        return _written_out(converter, letter, ends, rest, sign.position)
    printed = letter
    letter, rest = _with_known_index(converter, letter, rest, sign.position)
    body = converter.within(letter).product(rest)
    if not is_vector(body):
        raise LatexError(f"nothing behind the sum has the index '{printed}': write it with one, or give "
                         "the sum in the notation", sign.position)
    indices = {index for symbol in body.atoms(sp.Indexed) for index in symbol.indices}
    if len(indices) != 1:
        raise LatexError("the summand has several indices: give the sum in the notation", sign.position)
    index = indices.pop()
    limits = converter.limits
    if limits is not None and limits[0] == index:
        if ends is not None and ends != (limits[1], limits[2]):
            raise LatexError(f"the sum goes from {ends[0]} to {ends[1]}, that of the goal from {limits[1]} to "
                             f"{limits[2]}: correct the notation or the goal", sign.position)
        return sp.Sum(body, limits)
    if ends is None:
        raise LatexError("the sum has no ends here and none in the goal: write \\sum_{j=1}^{n}", sign.position)
    return sp.Sum(body, (index, *ends))


def _with_known_index(converter: Reading, letter: str, rest: tuple[Node, ...],
                      position: int) -> tuple[str, tuple[Node, ...]]:
    """The summand with the index that the notation's components bear, where it knows none by the sum's own letter.

    Which letter a sum counts by says nothing: sum e_i^2 over i is sum e_j^2 over j.
    """
    known = None if converter.limits is None else str(converter.limits[0])
    if known is None or known == letter or letter in converter.notation.indices:
        return letter, rest
    if any(_mentions(node, known) for node in rest):
        raise LatexError(f"within the sum over '{letter}' stands the index '{known}' too: count by a letter that is "
                         "not used", position)
    return known, tuple(_put(node, letter, Letter(known)) for node in rest)


def _ends(converter: Reading, first: str | None, sign: Big) -> tuple[sp.Expr, sp.Expr] | None:
    if (first is None) != (sign.above is None):
        raise LatexError("the sum has one end only: write both, or none", sign.position)
    if first is None or sign.above is None:
        return None
    start, *others = read_line(first).chains or (None,)
    if start is None or start.signs or others:
        raise LatexError("a sum starts at a number: correct its lower end", sign.position)
    return converter.number(start.sides[0]), converter.number(sign.above)


def require_component(node: Node, is_indexed: bool, index: str | None, limits: sp.Tuple | None) -> None:
    """Raise LatexError for a vector printed without the index of the sum that it stands in, or, where the limits of
    the goal's sums are given, for a component that stands in none; and for one number printed with a sum's index."""
    if index is not None and not is_indexed and _mentions(node, index):
        raise LatexError(f"a piece with the sum's index '{index}' is one number in the notation: make it a vector, or "
                         "give it another index", node.position)
    if not is_indexed or not isinstance(node, Letter):
        return
    if index is not None and index not in node.index:
        raise LatexError(f"'{node.name}' has one value for each index, but is printed without the sum's index "
                         f"'{index}': correct the notation", node.position)
    if index is None and limits is not None and str(limits[0]) in map(str.strip, node.index_parts()):
        raise LatexError(f"a component of '{node.name}' stands in no sum: write a sum, or the vector without its "
                         "index", node.position)


def _written_out(converter: Reading, letter: str, ends: tuple[sp.Expr, sp.Expr], rest: tuple[Node, ...],
                 position: int) -> sp.Expr:
    first, last = map(int, ends)
    if not 0 <= last - first < MOST_SUMMANDS:
        raise LatexError(f"a sum from {first} to {last}: write one of 1 to {MOST_SUMMANDS} terms", position)
    if any(isinstance(part, Big) and _mentions(Letter("", index=part.below), letter) for part in parts_of(rest)):
        raise LatexError(f"a sum within the sum over '{letter}' has that letter below too: count by another letter, "
                         "and from a number on", position)
    if last > 9 and any(isinstance(part, Letter) and _runs_on(part, letter) for part in parts_of(rest)):
        raise LatexError(f"with {last} in the place of '{letter}' an index of several letters is open: write commas "
                         "within it", position)
    return sp.Add(*(converter.product(tuple(_put(node, letter, Number(Fraction(number))) for node in rest))
                    for number in range(first, last + 1)))


def _runs_on(printed: Letter, letter: str) -> bool:
    """Whether an index has the letter beside another without a comma between."""
    parts = [part.strip() for part in printed.index_parts()]
    return letter in parts and any(one != "," != two and letter in (one, two) for one, two in pairwise(parts))


def _put(node: Any, letter: str, by: Number | Letter) -> Any:
    """The node with a number or another letter in place of an index's letter."""
    if isinstance(node, Letter) and node == Letter(letter):
        return replace(by, position=node.position)
    if isinstance(node, Letter):
        typed = by.name if isinstance(by, Letter) else str(by.value)
        return replace(node, index="".join(typed if part.strip() == letter else part for part in node.index_parts()))
    if isinstance(node, tuple):
        return tuple(_put(part, letter, by) for part in node)
    if isinstance(node, Node) and is_dataclass(node):
        return replace(node, **{f.name: _put(getattr(node, f.name), letter, by) for f in fields(node)
                                if f.name != "position"})
    return node


def _mentions(node: Any, letter: str) -> bool:
    """Whether a letter stands in a node, by itself or as an index."""
    return any(found.name == letter or letter in map(str.strip, found.index_parts()) for found in letters_of_node(node))


def _integrals(sign: Big, rest: tuple[Node, ...]) -> list[tuple[sp.Expr, tuple[Node, ...]]]:
    """An integral of a sum in brackets as integrals of its terms, each with a number before it; empty if it is none."""
    factors = tuple(factor for factor in rest if not isinstance(factor, Dot))
    if len(factors) != 3 or factors[1] != Letter("d") or not isinstance(factors[0], Group):
        return []
    line = factors[0].line
    if len(line.chains) != 1 or line.chains[0].signs:
        return []
    inner = line.chains[0].sides[0]
    if not isinstance(inner, Terms):
        return []
    parts = []
    for plus, term in inner.terms:
        if plus == 0:
            return []
        integrand = term.factors if isinstance(term, Product) else (term,)
        parts.append((sp.Integer(plus), (sign, *integrand, *factors[1:])))
    return parts
