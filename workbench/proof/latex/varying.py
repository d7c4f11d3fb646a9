"""What a text prints as a function of time or of what moves: `d(t)`, `f(x)`. Without a rate it is no constant."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

import sympy as sp

from workbench.proof.latex.derivatives import TIME
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.tree import Group, Letter, Node, Power, Product, Transposed, letters_of_node, parts_of


def printed_of_time(tree: Any, notation: Notation) -> set[sp.Expr]:
    """The symbols that a tree prints with the argument (t)."""
    found = set()
    for part in parts_of(tree):
        if isinstance(part, Product):
            for one, two in zip(part.factors[:-1], part.factors[1:], strict=True):
                if letters_of_node(_bare(two)) == {TIME} and isinstance(_bare(two), Group):
                    meaning = notation.meaning(_bare(one)) or notation.meaning(_without_index(_bare(one)))
                    found |= {meaning} if isinstance(meaning, (sp.Symbol, sp.Indexed)) else set()
    return found


def varies(key: Node, moving: Collection[sp.Expr], notation: Notation) -> bool:
    """Whether a letter of a notation is a value at time t, or at what moves."""
    return isinstance(key, Product) and any(
        letter == TIME or notation.meaning(letter) in moving
        for factor in key.factors if isinstance(factor, Group) for letter in letters_of_node(factor))


def _without_index(node: Node) -> Node:
    """A vector's letter where its component is printed."""
    return replace(node, index="") if isinstance(node, Letter) else node


def _bare(node: Node) -> Node:
    return node.base if isinstance(node, (Power, Transposed)) else node
