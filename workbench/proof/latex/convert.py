"""From the tree of a line to sympy: what its letters stand for is put in, and nothing else is known."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import singledispatchmethod

import sympy as sp

from workbench.proof.claim import D
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.functions import Condition, applied, divided, power, require_kept
from workbench.proof.latex.notation import Notation, without_dot
from workbench.proof.latex.sums import big
from workbench.proof.latex.tree import (
    Accented,
    Big,
    Dot,
    Ellipsis,
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
    Words,
)
from workbench.proof.latex.vectors import is_vector, multiplied, norm, trace

PAIRS = {"(": ")", "[": "]", "{": "}"}
_DERIVED = (Letter("d"), Product((Letter("d"), Letter("t"))))


@dataclass(frozen=True)
class Converter:
    """Turns nodes into expressions: `limits` are those of the goal's sums, `index` the letter of the sum within which
    the nodes stand, if they do; `conditions` gathers what must hold for the pieces read to be numbers."""

    notation: Notation
    limits: sp.Tuple | None = None
    index: str | None = None
    conditions: list[Condition] = field(default_factory=list, compare=False)

    def side(self, node: Node) -> sp.Expr:
        """The expression of a relation's side, in which nothing that is defined only somewhere has cancelled."""
        own = replace(self, conditions=[])
        value = own.number(node)
        require_kept(own.conditions, value)
        return value

    def number(self, node: Node) -> sp.Expr:
        """The expression of a node that is a number, no vector."""
        value = self.expression(node)
        if is_vector(value):
            raise LatexError("a vector stands where a number is expected: write a product, a norm or a sum of it",
                             node.position)
        return value

    def expression(self, node: Node) -> sp.Expr:
        """The expression of a node; raises LatexError naming the place."""
        known = self.notation.meaning(node)
        if known is not None:
            return self._of_sum(node, known)
        return self._value(node)

    @singledispatchmethod
    def _value(self, node: Node) -> sp.Expr:
        what = {Ellipsis: "dots stand for what is not printed: the line has to be read by a person",
                Words: "words stand where a formula is expected: the line has to be read by a person"}
        raise LatexError(what.get(type(node), "this piece has no meaning by itself: give it in the notation"),
                         node.position)

    @_value.register
    def _(self, node: Number) -> sp.Expr:
        if node.mark:
            raise LatexError(f"the number {node.value} with the mark '{node.mark}': give the piece in the notation",
                             node.position)
        return sp.Rational(node.value.numerator, node.value.denominator)

    @_value.register
    def _(self, node: Product) -> sp.Expr:
        return self.product(node.factors)

    @_value.register(Transposed)
    @_value.register(Named)
    @_value.register(Big)
    def _(self, node: Node) -> sp.Expr:
        return self.product((node,))

    @_value.register
    def _(self, node: Root) -> sp.Expr:
        return self._power(self.number(node.body), sp.S.Half, node.position)

    @_value.register
    def _(self, node: Group) -> sp.Expr:
        return self.expression(self.inside(node))

    def product(self, factors: tuple[Node, ...]) -> sp.Expr:
        """The product of factors, functions and sum signs applied to what follows them."""
        values: list[tuple[sp.Expr, bool]] = []
        at = 0
        while at < len(factors):
            node = factors[at]
            if isinstance(node, Dot):
                at += 1
                continue
            value, transposed, length = self._factor(factors, at)
            values.append((value, transposed))
            at += length
        position = factors[0].position
        if self.index is not None and any(transposed for _, transposed in values):
            raise LatexError("a product of vectors within a sum: give the product in the notation", position)
        return multiplied(values, self.limits, position)

    def _factor(self, factors: tuple[Node, ...], at: int) -> tuple[sp.Expr, bool, int]:
        """The value of the factor at a place, whether it is transposed, and how many factors it takes."""
        node, rest = factors[at], factors[at + 1:]
        piece = self.notation.piece(factors, at)
        if piece is not None:
            length, meaning, exponent = piece
            meaning = self._of_sum(node, meaning)
            if exponent is not None:
                meaning = self._power(meaning, self.number(exponent), node.position)
            return meaning, False, length
        exponent_of = node.exponent if isinstance(node, Power) and isinstance(node.base, Named) else None
        name = node.base if isinstance(node, Power) and exponent_of is not None else node
        if isinstance(name, Named) and self.notation.meaning(node) is None:
            value, taken = self._function(name, rest)
            if exponent_of is not None:
                value = power(value, self._positive(exponent_of), node.position)
            return value, False, 1 + taken
        if isinstance(node, Big) and self.notation.meaning(node) is None:
            return big(self, node, rest), False, 1 + len(rest)
        if isinstance(node, Quotient) and (node.top, node.bottom) == _DERIVED and rest:
            if isinstance(rest[0], Group) and len(rest) > 1:
                raise LatexError("what the derivative applies to is open: put all of it in brackets", node.position)
            return D(self.product(rest)), False, 1 + len(rest)
        applies = rest and isinstance(rest[0], Group) and self.notation.meaning(rest[0]) is None
        if isinstance(node, Letter) and applies and node in self.notation.applied:
            raise LatexError(f"this value of '{node.name}' is not in the notation, other values are: add it, or write "
                             r"\cdot for a product", node.position)
        if isinstance(node, Transposed) and self.notation.meaning(node) is None:
            return self.expression(node.base), True, 1
        return self.expression(node), False, 1

    def _function(self, name: Named, rest: tuple[Node, ...]) -> tuple[sp.Expr, int]:
        """A function of what follows it, and how many factors that takes."""
        if not rest or isinstance(rest[0], Dot):
            raise LatexError(f"'{name.name}' has no argument: write it in brackets", name.position)
        if name.index:
            raise LatexError(f"'{name.name}' with the index '{name.index}': give the piece in the notation",
                             name.position)
        first, taken = rest[0], 1
        if isinstance(first, Power) and isinstance(first.base, Group):
            raise LatexError(f"the power may belong to '{name.name}' or to its argument: put brackets around it",
                             first.position)
        if isinstance(first, Group):
            arguments = [self.expression(side) for side in self.inside_all(first)]
        else:
            piece = self.notation.piece(rest, 0)
            taken = piece[0] if piece is not None else 1
            bare = isinstance(first, (Letter, Number, Power, Named))
            if bare and len(rest) > taken and not isinstance(rest[taken], Dot):
                raise LatexError(f"the argument of '{name.name}' is open: write it in brackets", name.position)
            arguments = [self.product(rest[:taken])]
        if name.name == "tr" and len(arguments) == 1:
            return trace(arguments[0], self.limits, name.position), taken
        for argument in arguments:
            if is_vector(argument) and self.index is None and name.name not in ("sat", "max", "min"):
                raise LatexError(f"'{name.name}' of a vector: give the piece in the notation", name.position)
        if name.name == "ln" and not arguments[0].is_Rational:
            self.conditions.append(Condition("logarithm", arguments[0], name.position))
        if name.name == "tan":
            self.conditions.append(Condition("denominator", sp.cos(arguments[0]), name.position))
        return applied(name.name, arguments, name.position), taken

    def _positive(self, exponent: Node) -> sp.Expr:
        value = self.number(exponent)
        if not (value.is_Integer and value > 0):
            raise LatexError("a power of a function other than a whole positive one: write brackets", exponent.position)
        return value

    @_value.register
    def _letter(self, letter: Letter) -> sp.Expr:
        found = without_dot(letter)
        if found is None:
            raise self.notation.unknown(letter)
        inner, count = found
        meaning = self.notation.meaning(inner)
        if meaning is None and without_dot(inner) is None:
            raise self.notation.unknown(letter)
        value = self._of_sum(inner, meaning) if meaning is not None else self._letter(inner)
        for _ in range(count):
            value = D(value)
        return value

    def _of_sum(self, node: Node, meaning: sp.Expr) -> sp.Expr:
        """The meaning, which within a sum has an index only where it is printed with the sum's own."""
        if self.index is not None and is_vector(meaning) and isinstance(node, Letter) and self.index not in node.index:
            raise LatexError(f"'{node.name}' has one value for each index, but is printed without the sum's index "
                             f"'{self.index}': correct the notation", node.position)
        return meaning

    @_value.register
    def _(self, node: Terms) -> sp.Expr:
        if any(sign == 0 for sign, _ in node.terms):
            raise LatexError(r"\pm says two things at once: write one line for each", node.position)
        values = [sign * self.expression(term) for sign, term in node.terms]
        kinds = {is_vector(value) for value in values if value != 0}
        if len(kinds) > 1 and self.index is None:
            raise LatexError("a number is added to a vector: correct the notation", node.position)
        return sp.Add(*values)

    @_value.register
    def _(self, node: Quotient) -> sp.Expr:
        top, bottom = node.top, node.bottom
        if (isinstance(top, Product) and top.factors[0] == _DERIVED[0] and bottom == _DERIVED[1]):
            return D(self.product(top.factors[1:]))
        below = self.expression(bottom)
        if is_vector(below) and self.index is None:
            raise LatexError("a division by a vector: correct the line", bottom.position)
        if not below.is_Rational:
            self.conditions.append(Condition("denominator", below, bottom.position))
        return divided(self.expression(top), below, node.position)

    @_value.register
    def _(self, node: Power) -> sp.Expr:
        if node.base == Letter("e") and self.notation.meaning(node.base) is None:
            return sp.exp(self.number(node.exponent))
        if isinstance(node.base, Named):
            return self.product((node,))
        return self._power(self.expression(node.base), self.number(node.exponent), node.position)

    def _power(self, base: sp.Expr, exponent: sp.Expr, position: int) -> sp.Expr:
        if exponent.is_Rational and not base.is_Rational:
            if exponent < 0:
                self.conditions.append(Condition("denominator", base, position))
            if not exponent.is_Integer:
                self.conditions.append(Condition("root", base, position))
        return power(base, exponent, position)

    @_value.register
    def _(self, node: Accented) -> sp.Expr:
        count = {"dot": 1, "ddot": 2, "dddot": 3}.get(node.accent)
        if count is None:
            raise LatexError(f"\\{node.accent} over more than a letter: give the piece in the notation", node.position)
        value = self.expression(node.body)
        for _ in range(count):
            value = D(value)
        return value

    @_value.register
    def _(self, node: Size) -> sp.Expr:
        bars, parts, position = node.bars, node.parts, node.position
        if len(parts) != 1:
            raise LatexError("several values between bars: give the piece in the notation", position)
        value = self.expression(parts[0])
        if bars in ("||", "||_2"):
            return norm(value, self.limits, position)
        if bars != "|":
            raise LatexError(f"the norm '{bars}' has no meaning in goals: give the piece in the notation", position)
        if is_vector(value) and self.index is None:
            raise LatexError("the absolute value of a vector: write a norm", position)
        return sp.Abs(value)

    def inside(self, group: Group) -> Node:
        """The one expression between brackets."""
        sides = self.inside_all(group)
        if len(sides) != 1:
            raise LatexError("several values between brackets: give the piece in the notation", group.position)
        return sides[0]

    def inside_all(self, group: Group) -> list[Node]:
        """The expressions between brackets, which commas part."""
        if PAIRS[group.opening] != group.closing:
            raise LatexError(f"'{group.opening}' is closed by '{group.closing}': write the same brackets",
                             group.position)
        line = group.line
        if any(s != (",",) for s in line.separators[1:-1]) or line.separators[0] or line.separators[-1]:
            raise LatexError("words or arrows between brackets: give the piece in the notation", group.position)
        if any(chain.signs for chain in line.chains):
            raise LatexError("a relation between brackets: write it after a comma", group.position)
        return [chain.sides[0] for chain in line.chains]

    def within(self, index: str | None) -> Converter:
        """The same, within a sum over an index."""
        return replace(self, index=index)

