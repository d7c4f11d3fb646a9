"""What stands side by side in a product and could be read in two ways: numbers, and a slash behind an argument."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import Big, Group, Letter, Named, Node, Number, Power, Quotient, letters_of_node


def require_no_mixed_number(parts: list[Any]) -> None:
    """Raise LatexError for numbers side by side: `2\\frac12` is printed as two and a half is."""
    for one, two in pairwise(parts):
        if _is_number(one) and _is_number(two):
            raise LatexError("two numbers stand side by side: write \\cdot between them, or one number", two.position)


def require_own_slash(factors: list[Node], divisor: Node) -> None:
    """Raise LatexError for a slash behind an argument without brackets, or behind what an operator applies to:
    `sin x/2` may be the sine of x/2."""
    *before, last = factors
    named = before[-1].base if before and isinstance(before[-1], Power) else before[-1] if before else None
    if (isinstance(named, Named) and not isinstance(last, Group)) or any(map(_is_operator, factors)):
        raise LatexError("whether a slash divides what a function or a derivative is of is open: write brackets, or "
                         "\\frac", divisor.position)
    counted = {one.below.partition("=")[0].strip() for one in factors if isinstance(one, Big)}
    if counted & {letter.name for letter in letters_of_node(divisor)}:
        raise LatexError("whether a slash divides each term of the sum is open: put brackets around the term",
                         divisor.position)


def _is_operator(node: Node) -> bool:
    """Whether a fraction is a derivative of what stands behind it, as `d/dt`."""
    top = node.top if isinstance(node, Quotient) else None
    return (top.base if isinstance(top, Power) else top) in (Letter("d"), Letter("\\partial"))


def _is_number(node: Any) -> bool:
    parts = (node.top, node.bottom) if isinstance(node, Quotient) else (node,)
    return all(isinstance(part, Number) for part in parts)
