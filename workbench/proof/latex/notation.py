"""A paper's letters: what each stands for, found by how it is read, not by how it is typed."""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from functools import lru_cache

import sympy as sp

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.tree import Group, Letter, Line, Node, Power, Product, Terms


class Notation:
    r"""What the letters of a paper stand for.

    A key is a letter with its marks (`\\hat\\theta_1`), or a longer piece of a formula that has one meaning: a value
    of a function (`V(0)`), a norm (`\\|e_2\\|`), an integral with its differential, a product such as `A s_i`. Within
    a product the longest piece that is known is taken first. A key never is a relation, nor a sum outside brackets.
    An argument that letters are printed with and that says nothing, as in `z_1(t)`, is a key of value 1: `(t)`.
    `definitions` gives the formulas by which some of the letters are defined, `moving` the symbols that vary in time,
    where these are known. Raises LatexError for a key that is none.
    """

    def __init__(self, letters: Mapping[str, sp.Expr], definitions: Mapping[str, str] | None = None,
                 moving: Collection[sp.Expr] = ()) -> None:
        self.bodies: dict[Node, Node] = {_key(typed): read_line(formula).chains[0].sides[0]
                                         for typed, formula in (definitions or {}).items()}
        self.moving = frozenset(moving)
        self.single: dict[Node, sp.Expr] = {}
        self.products: dict[Node, list[tuple[tuple[Node, ...], sp.Expr]]] = {}
        self.typed, self.given = tuple(letters), dict(letters)
        self.indices: set[str] = set()
        for typed, meaning in letters.items():
            self._add(typed, meaning)
        for pieces in self.products.values():
            pieces.sort(key=lambda piece: -len(piece[0]))
        # Letters that the paper applies to arguments: another argument is then no factor.
        self.applied = {first for first, pieces in self.products.items() for factors, _ in pieces
                        if len(factors) == 2 and isinstance(first, Letter) and isinstance(factors[1], Group)}

    def _add(self, typed: str, meaning: sp.Expr) -> None:
        if not isinstance(meaning, sp.Expr):
            raise LatexError(f"the notation's '{typed}' stands for no expression of sympy: give one")
        try:
            key = _key(typed)
        except LatexError as trouble:
            raise LatexError(f"the notation's '{typed}': {trouble}") from None
        if isinstance(key, Product):
            self.products.setdefault(key.factors[0], []).append((key.factors, meaning))
        else:
            self.indices.update(map(str.strip, key.index_parts()) if isinstance(key, Letter) else ())
            known = self.single.setdefault(key, meaning)
            if known != meaning:
                raise LatexError(f"the notation gives '{typed}' two meanings, {known} and {meaning}: keep one")

    def meaning(self, node: Node) -> sp.Expr | None:
        """What a node stands for as a whole, if that is known."""
        if isinstance(node, Product):
            found = self.piece(node.factors, 0)
            whole = found is not None and found[0] == len(node.factors) and found[2] is None
            return found[1] if found is not None and whole else None
        return self.single.get(node)

    def piece(self, factors: tuple[Node, ...], at: int) -> tuple[int, sp.Expr, Node | None] | None:
        """The longest known piece of a product from a factor on: its length, meaning, and exponent if it has one."""
        for key, meaning in self.products.get(factors[at], ()):
            length = len(key)
            if at + length > len(factors) or factors[at:at + length - 1] != key[:-1]:
                continue
            last = factors[at + length - 1]
            if last == key[-1]:
                return length, meaning, None
            if isinstance(last, Power) and last.base == key[-1]:
                return length, meaning, last.exponent
        return None

    def unknown(self, letter: Letter) -> LatexError:
        """The error for a letter that is not known, with the nearest that is."""
        typed = spelled(letter)
        near = difflib.get_close_matches(typed, [_flat(key) for key in self.typed], n=1, cutoff=0.3)
        hint = f"; the nearest known is '{near[0]}'" if near else ""
        return LatexError(f"the letter '{typed}' is not in the notation{hint}: correct it or add it", letter.position)


def with_letters(notation: Mapping[str, sp.Expr], more: Mapping[str, sp.Expr]) -> dict[str, sp.Expr]:
    """A notation in which some letters are added or stand for something else."""
    own = {_key(typed) for typed in more}
    return {typed: meaning for typed, meaning in notation.items() if _key(typed) not in own} | dict(more)


@lru_cache(maxsize=4096)
def _key(typed: str) -> Node:
    line: Line = read_line(typed)
    if len(line.chains) != 1 or line.chains[0].signs or line.separators != ((), ()):
        raise LatexError("a letter of a notation is one piece of a formula, without relations and commas: correct it")
    side = line.chains[0].sides[0]
    if isinstance(side, Terms):
        raise LatexError("a letter of a notation is no sum outside brackets: put it into brackets")
    return side


def spelled(letter: Letter) -> str:
    """A letter as LaTeX."""
    text = letter.name
    for accent in letter.accents:
        text = f"\\{accent}{text if text.startswith(chr(92)) and accent == letter.accents[0] else '{' + text + '}'}" \
            if len(text) > 1 else f"\\{accent} {text}"
    if letter.index:
        text += f"_{letter.index}" if len(letter.index) == 1 else f"_{{{letter.index}}}"
    if letter.mark:
        text += f"^{letter.mark}" if len(letter.mark) == 1 else f"^{{{letter.mark}}}"
    return text


def _flat(typed: str) -> str:
    return re.sub(r"\s+", " ", typed)


def without_dot(letter: Letter) -> tuple[Letter, int] | None:
    """The letter below its outermost dot, and how many derivatives the dot says; None when there is none."""
    count = {"dot": 1, "ddot": 2, "dddot": 3}.get(letter.accents[-1]) if letter.accents else None
    return None if count is None else (replace(letter, accents=letter.accents[:-1]), count)
