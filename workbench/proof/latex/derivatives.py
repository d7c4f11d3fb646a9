"""Fractions that stand for derivatives: in time, and of a known expression by one of its letters."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import Accented, Dot, Group, Letter, Node, Number, Power, Product, Quotient, Transposed

D_LETTERS = (Letter("d"), Letter("\\partial"))
TIME = Letter("t")


@dataclass(frozen=True)
class Derivative:
    r"""How often, of what (nothing where it stands behind the fraction), and by what; partial: typed with \partial."""

    order: int
    of: tuple[Node, ...]
    by: tuple[Node, ...]
    partial: bool = False

    @property
    def in_time(self) -> bool:
        """Whether it is one along the motion."""
        return self.by == (TIME,)


def derivative(node: Node) -> Derivative | None:
    """A fraction as a derivative; None where it is none, that is, where no d stands first above and below."""
    if not isinstance(node, Quotient):
        return None
    top, bottom = _factors(node.top), _factors(node.bottom)
    order, letter = _power_of(top[0])
    if letter not in D_LETTERS or bottom[0] != letter or len(bottom) < 2:
        return None
    last, base = _power_of(bottom[-1])
    found = Derivative(order, top[1:], (*bottom[1:-1], base if last == order else bottom[-1]),
                       partial=letter != D_LETTERS[0])
    if last != order and len(bottom) == 2:
        raise LatexError("the orders above and below the line of a derivative differ: correct one", node.position)
    if found.in_time and found.partial:
        raise LatexError(r"a derivative by t alone, other letters held, is none along the motion: write \frac{d}{dt}",
                         node.position)
    return found


def require_operand(rest: tuple[Node, ...], position: int) -> None:
    """Raise LatexError where it is open what an operator such as d/dt, that stands before these factors, applies to."""
    first, *others = rest
    nested = isinstance(first, Quotient) and (inner := derivative(first)) is not None and not inner.of
    if (isinstance(first, Group) and others) or any(isinstance(node, Dot) for node in rest) or (
            not nested and any(map(_is_rate, others))):
        raise LatexError("what the derivative applies to is open: put all of it in brackets", position)


def _is_rate(node: Node) -> bool:
    """Whether a factor is a rate or an operator itself."""
    base = node.base if isinstance(node, (Power, Transposed)) else node
    return (isinstance(base, (Letter, Accented)) and _has_dot(base)) or (
        isinstance(base, Quotient) and derivative(base) is not None)


def _has_dot(node: Letter | Accented) -> bool:
    """Whether the outermost accent of a node is a dot."""
    accent = node.accent if isinstance(node, Accented) else node.accents[-1] if node.accents else ""
    return accent in ("dot", "ddot", "dddot")


def _factors(node: Node) -> tuple[Node, ...]:
    return node.factors if isinstance(node, Product) else (node,)


def _power_of(node: Node) -> tuple[int, Node]:
    """The exponent 2 or 3 of a node and its base, else 1 and the node."""
    if isinstance(node, Power) and node.exponent in (Number(Fraction(2)), Number(Fraction(3))):
        return int(node.exponent.value), node.base
    return 1, node


def rate(value: sp.Expr, order: int) -> sp.Expr:
    """The derivative of an expression along the motion."""
    for _ in range(order):
        value = D(value)
    return value
