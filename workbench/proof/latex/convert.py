"""From the tree of a line to sympy: what its letters stand for is put in, and nothing else is known."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import singledispatchmethod

import sympy as sp

from workbench.proof.latex.brackets import (
    ends_behind_letter,
    inside,
    inside_all,
    is_argument,
    plain_exponent,
    require_end,
    require_factor,
    require_letter_before,
    require_own_power,
)
from workbench.proof.latex.conditions import Condition, conditions_of, require_kept
from workbench.proof.latex.derivatives import Derivative, derivative, rate, require_operand
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.functions import applied, divided, power, require_usual
from workbench.proof.latex.held import by_letter
from workbench.proof.latex.notation import Notation, without_dot
from workbench.proof.latex.sums import big, require_component
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
from workbench.proof.latex.vectors import NORMS, is_vector, multiplied, norm, trace

_EULER = (Letter("e"), Letter(r"\mathrm{e}"))


@dataclass(frozen=True)
class Converter:
    """Turns nodes into expressions: `limits` are those of the goal's sums, `index` the letter of the sum within which
    the nodes stand, if they do; `conditions` gathers what must hold for the pieces read to be numbers. `declared` says
    that each letter is known to be a number or a column, so that the norm of a number is its size."""

    notation: Notation
    limits: sp.Tuple | None = None
    index: str | None = None
    declared: bool = False
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
        require_letter_before(self.notation, node)
        known = self.notation.meaning(node)
        return self._value(node) if known is None else self._of_sum(node, known)

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
        return self.expression(inside(node))

    def product(self, factors: tuple[Node, ...]) -> sp.Expr:
        """The product of factors, functions and sum signs applied to what follows them."""
        values: list[tuple[sp.Expr, bool]] = []
        at = 0
        while at < len(factors):
            node = factors[at]
            if isinstance(node, Dot) or (at and is_argument(self.notation, node, factors[at - 1])):
                at += 1
                continue
            require_factor(self.notation, factors, at, self.declared)
            value, transposed, length = self._factor(factors, at)
            behind = factors[at + length] if at + length < len(factors) else None
            # x(t)^2 is (x(t))^2
            if isinstance(behind, (Power, Transposed)) and is_argument(self.notation, behind.base, node):
                if isinstance(behind, Power):
                    value = self._power(value, self.number(plain_exponent(behind.exponent)), behind.position)
                transposed, length = transposed or isinstance(behind, Transposed), length + 1
            values.append((value, transposed))
            at += length
        if self.index is not None and any(transposed for _, transposed in values):
            raise LatexError("a product of vectors within a sum: give it in the notation", factors[0].position)
        return multiplied(values, self.limits, factors[0].position, self.declared and self.index is None)

    def _factor(self, factors: tuple[Node, ...], at: int) -> tuple[sp.Expr, bool, int]:
        """The value of the factor at a place, whether it is transposed, and how many factors it takes."""
        node, rest = factors[at], factors[at + 1:]
        piece = self.notation.piece(factors, at)
        if piece is not None:
            length, meaning, exponent = piece
            meaning = self._of_sum(Product(factors[at:at + length], position=node.position), meaning)
            if exponent is not None:
                require_own_power(factors[at + length - 1], self.declared)
                meaning = self._power(meaning, self.number(plain_exponent(exponent)), node.position)
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
        operator = derivative(node)
        if operator is not None and not operator.of and rest and self.notation.meaning(node) is None:
            require_operand(rest, node.position)
            return self._derived(replace(operator, of=rest), node.position), False, 1 + len(rest)
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
        first, piece = rest[0], self.notation.piece(rest, 0)
        if isinstance(first, Power) and isinstance(first.base, Group):
            raise LatexError(f"the power may belong to '{name.name}' or to its argument: put brackets around it",
                             first.position)
        if isinstance(first, Group):
            arguments, taken = [self.expression(side) for side in inside_all(first)], 1
        elif isinstance(first, Named) and piece is None:  # \ln\cosh x
            value, more = self._function(first, rest[1:])
            arguments, taken = [value], 1 + more
            require_end(name, rest[taken:])
        else:
            is_double = isinstance(first, Number) and ends_behind_letter(rest)  # sin 2x
            taken = 2 if is_double else piece[0] if piece is not None else 1
            if isinstance(first, (Letter, Number, Power, Named)):
                require_end(name, rest[taken:])
            arguments = [self.product(rest[:taken])]
        if name.name == "tr" and len(arguments) == 1:
            return trace(arguments[0], self.limits, name.position, self.declared), taken
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
        return rate(value, count)

    def _of_sum(self, node: Node, meaning: sp.Expr) -> sp.Expr:
        """The meaning, where the letter has the index that it has here; a definition's is a number somewhere alone."""
        if self.declared:
            self.conditions.extend(conditions_of(meaning, node.position))
        require_component(node, is_vector(meaning), self.index, self.limits if self.declared else None)
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
        found = derivative(node)
        if found is not None and found.of:
            return self._derived(found, node.position)
        below = self.expression(bottom)
        if is_vector(below) and self.index is None:
            raise LatexError("a division by a vector: correct the line", bottom.position)
        if not below.is_Rational:
            self.conditions.append(Condition("denominator", below, bottom.position))
        return divided(self.expression(top), below, node.position)

    def _derived(self, found: Derivative, position: int) -> sp.Expr:
        """A derivative in time, or of an expression by one of its letters."""
        value = self.product(found.of)
        if found.in_time:
            return rate(value, found.order)
        return by_letter(self.notation, found, value, self.product(found.by), position)

    @_value.register
    def _(self, node: Power) -> sp.Expr:
        if node.base in _EULER and self.notation.meaning(node.base) is None:
            return sp.exp(self.number(node.exponent))
        if isinstance(node.base, Named):
            return self.product((node,))
        return self._power(self.expression(node.base), self.number(plain_exponent(node.exponent)), node.position)

    def _power(self, base: sp.Expr, exponent: sp.Expr, position: int) -> sp.Expr:
        if self.declared:
            require_usual(base if self.index is None else None, exponent, position)
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
        return rate(self.expression(node.body), count)

    @_value.register
    def _(self, node: Size) -> sp.Expr:
        bars, parts, position = node.bars, node.parts, node.position
        if len(parts) != 1:
            raise LatexError("several values between bars: give the piece in the notation", position)
        value = self.expression(parts[0])
        if bars == "|" and is_vector(value) and self.index is None:
            raise LatexError("the absolute value of a vector: write a norm", position)
        if bars == "|" or (self.declared and bars in NORMS and not is_vector(value)):
            return sp.Abs(value)
        return norm(bars, value, self.limits, position)

    def within(self, index: str | None) -> Converter:
        """The same, within a sum over an index."""
        return replace(self, index=index)
