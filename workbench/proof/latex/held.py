"""Derivatives by a letter, refused where it is open whether a definition or a value of a function moves with it."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from workbench.proof.claim import D
from workbench.proof.latex.derivatives import Derivative, derivative
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import Notation, spelled
from workbench.proof.latex.tree import Group, Letter, Node, Power, Product, children, letters_of_node


def by_letter(notation: Notation, found: Derivative, value: sp.Expr, by: sp.Expr, position: int) -> sp.Expr:
    r"""The derivative of an expression by one of its letters; LatexError where it is none, or may be two things.

    \partial V/\partial x of V = x s with s = x + y is s where s is held, and s + x where it is not: which letters V is
    a function of is said by V(x, y) alone. A value f(x) moves with x, but its rate of change is no letter. dV/dx is
    neither where another letter of V moves, too.
    """
    if not isinstance(by, sp.Symbol) or not value.has(by) or value == by or value.has(
            D, sp.Abs, sp.sign, sp.Max, sp.Min):
        raise LatexError("a derivative other than one by t, or of a smooth function that is defined by its letter: "
                         "write it out", position)
    if name := _of_value(notation, by, value):
        raise LatexError(f"a derivative of a value of '{name}' by what stands in its brackets: write it as a letter of "
                         "its own", position)
    other = min(map(str, value.free_symbols & notation.moving - {by}), default=None)
    if not found.partial and other is not None:
        raise LatexError(rf"a derivative by a letter while another one, {other}, moves: write \partial where that is "
                         "held", position)
    of = found.of[0] if len(found.of) == 1 else Product(found.of)
    if found.partial and (name := _two_ways(notation, of, by, set())):
        raise LatexError(f"whether the derivative holds '{name}', which moves with the letter below, is open: write "
                         "out what is differentiated", position)
    return sp.diff(value, by, found.order)


def _of_value(notation: Notation, by: sp.Symbol, value: sp.Expr) -> str | None:
    """The value of a function, such as f(x), that is a letter of the expression and has the letter in its brackets."""
    for head, pieces in notation.products.items():
        for factors, meaning in pieces:
            inner = {one for factor in factors[1:] if isinstance(factor, Group) for one in letters_of_node(factor)}
            known = [notation.meaning(letter) for letter in inner]
            if isinstance(meaning, (sp.Symbol, sp.Indexed)) and meaning != by and value.has(meaning) and (
                    isinstance(head, Letter)) and any(one is not None and one.has(by) for one in known):
                return spelled(head)
    return None


def _two_ways(notation: Notation, node: Node, by: sp.Symbol, seen: set[Node]) -> str | None:
    """A definition through which an expression names a letter that it names directly, too, at any depth."""
    pieces = [*_pieces(notation, node)]
    if len(pieces) == 1 and pieces[0][0] == node and node in notation.bodies:
        return _two_ways_of_definition(notation, node, by, seen)
    through = [key for key, meaning in pieces if meaning != by and meaning.has(by)]
    if through and any(meaning == by for _, meaning in pieces):
        return _shown(through[0])
    found = (_two_ways_of_definition(notation, key, by, seen) for key in through)
    return next((name for name in found if name is not None), None)


def _two_ways_of_definition(notation: Notation, key: Node, by: sp.Symbol, seen: set[Node]) -> str | None:
    if key in seen or key not in notation.bodies or _is_of_letters(notation, key):
        return None
    seen.add(key)
    return _two_ways(notation, notation.bodies[key], by, seen)


def _is_of_letters(notation: Notation, key: Node) -> bool:
    """Whether a definition says what it is a function of, and that is symbols alone: `V(x, y)`."""
    return isinstance(key, Product) and isinstance(key.factors[-1], Group) and all(
        isinstance(notation.meaning(letter), sp.Symbol) for letter in letters_of_node(key.factors[-1]))


def _pieces(notation: Notation, node: Node) -> Iterator[tuple[Node, sp.Expr]]:
    """The known pieces of an expression, each as a whole, with their meanings."""
    meaning = notation.meaning(node)
    if meaning is not None:
        yield node, meaning
    elif isinstance(node, Product):
        at = 0
        while at < len(node.factors):
            piece = notation.piece(node.factors, at)
            if piece is None:
                yield from _pieces(notation, node.factors[at])
                at += 1
            else:
                last = node.factors[at + piece[0] - 1]
                bare = last.base if piece[2] is not None and isinstance(last, Power) else last
                yield Product((*node.factors[at:at + piece[0] - 1], bare)), piece[1]
                at += piece[0]
    elif (inner := derivative(node)) is not None:
        for part in inner.of:
            yield from _pieces(notation, part)
    else:
        for part in children(node):
            yield from _pieces(notation, part)


def _shown(key: Node) -> str:
    """A key for a message."""
    head = key.factors[0] if isinstance(key, Product) else key
    return spelled(head) if isinstance(head, Letter) else "a definition"
