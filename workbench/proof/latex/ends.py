"""What stands at the ends of chains and intervals: numbers, infinity, the set of all numbers."""

from __future__ import annotations

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import Chain, Letter, Node, Number, Power, Terms


def require_own_ends(before: Chain, after: Chain) -> None:
    """Raise LatexError for `0 < x, y < 1`: it may bound each of the two on both sides, or each on one."""
    if len(before.sides) == len(after.sides) == 2 and is_constant(before.sides[0]) and is_constant(after.sides[1]) \
            and before.signs[0][0] == after.signs[0][0] in "<>":
        raise LatexError(r"whether the ends bound all that stands between them is open: write \text{and} between two "
                         "relations, or each with both ends", after.position)


def is_constant(node: Node) -> bool:
    """Whether a side is a number, or infinity, with its sign."""
    terms = node.terms if isinstance(node, Terms) else ((1, node),)
    return all(isinstance(term, Number) or term == Letter("\\infty") for _, term in terms)


def is_infinite(node: Node, sign: int) -> bool:
    """Whether an end is infinity with this sign."""
    terms = node.terms if isinstance(node, Terms) else ((1, node),)
    return terms == ((sign, Letter("\\infty")),)


def is_all_numbers(node: Node) -> bool:
    """Whether a set is that of the real numbers or of columns of them: of a letter no more is said by that."""
    return (node.base if isinstance(node, Power) else node) in (Letter(r"\mathbb{R}"), Letter(r"\Re"))
