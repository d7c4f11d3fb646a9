"""What a line's text says: its letters, and which of them it gives a value or a rate."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from itertools import pairwise
from typing import Any

from workbench.proof.latex.derivatives import derivative
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import spelled
from workbench.proof.latex.parts import parted
from workbench.proof.latex.read import read_line
from workbench.proof.latex.tree import PARTED, Chain, Group, Letter, Node, Product, Quotient, Terms, parts_of

RATES = ("dot", "ddot", "dddot")
_EQUALS = ("=", r"\triangleq", r"\coloneqq")
_ORDERS = {"dot": 1, "ddot": 2}  # of the rates that a line may give
_LAYOUT = re.compile(r"\\(?:begin|end)\s*\{(?:aligned|split|gathered)\}|(?<!\\)&")
_END = re.compile(r"(?<!\\right)(?:[\s,;.]|\\q?quad(?![A-Za-z])|\\[,;: ]?)+\Z")
_RELATION = re.compile(r"[=<>]|\\(?:leq?|geq?|leqslant|geqslant|ll|gg|lt|gt)(?![A-Za-z])")
_OF_TIME = read_line("(t)").chains[0].sides[0]  # says nothing of the letter that it stands behind


def left_of(text: str) -> str:
    """What stands before the first relation of a line, as it is typed; all of a line without one, or not read."""
    try:
        sides = read_line(text).chains[0].sides
    except LatexError:
        return text
    return _RELATION.split(text[:sides[1].position], maxsplit=1)[0] if len(sides) > 1 else text


def is_of_time(node: Node) -> bool:
    """Whether a node is the argument `(t)`, which says nothing of the letter before it."""
    return node == _OF_TIME


def letters_of_text(text: str) -> set[str]:
    """The letters of a line, in LaTeX, each with its marks; none of a line that cannot be read."""
    return {letter_latex(one) for one in letters_in(text)}


def letters_in(text: str) -> list[Letter]:
    """Every letter of a line with its rates and marks, as often as it stands there; none of one that cannot be read."""
    try:
        return [*_letters(read_line(text))]
    except LatexError:
        return []


def letters_of_time(text: str) -> set[str]:
    """The letters of a line that are printed with the argument (t)."""
    try:
        parts = [*parts_of(read_line(text))]
    except LatexError:
        return set()
    return {letter_latex(one) for part in parts if isinstance(part, Product) for one, two in pairwise(part.factors)
            if isinstance(one, Letter) and two == _OF_TIME}


def letter_latex(letter: Letter) -> str:
    """A letter with its marks in LaTeX."""
    text = letter.name
    for accent in letter.accents:
        if accent not in RATES:
            text = rf"\{accent}{{{text}}}"
    return text + (f"_{{{letter.index}}}" if letter.index else "") + (f"^{{{letter.mark}}}" if letter.mark else "")


def _letters(node: Any) -> Iterator[Letter]:
    if isinstance(node, Letter):
        yield node
    elif node == _OF_TIME:
        return
    elif isinstance(node, Quotient) and (found := derivative(node)) is not None:  # its d and t are no letters
        yield from _letters(found.of if found.in_time else (*found.of, *found.by))
    elif isinstance(node, tuple):
        for part in node:
            yield from _letters(part)
    elif is_dataclass(node):
        for one in fields(node):
            yield from _letters(getattr(node, one.name))


def sides_of(text: str) -> Iterator[tuple[str, str]]:
    """Of every `letter = expression` in a line the letter, and the expression as it is typed."""
    for left, right in _equations(text):
        if isinstance(left, Letter) and not set(left.accents) & set(RATES):
            yield letter_latex(left), right


def valued_in(text: str) -> set[str]:
    """The letters that a line gives a value, also one whose right side cannot be read, as a product of matrices."""
    left, sign, _ = _plain(text).partition("=")
    try:
        sides = [chain.sides[0] for chain in read_line(left.removesuffix(":")).chains[:1]] if sign else []
    except LatexError:
        sides = []
    heads = [side.factors[0] if isinstance(side, Product) and len(side.factors) == 2 and isinstance(
        side.factors[1], Group) else side for side in sides]
    return {letter for letter, _ in sides_of(text)} | {
        letter_latex(one) for one in heads if isinstance(one, Letter) and not set(one.accents) & set(RATES)}


def moving_sides(text: str) -> Iterator[tuple[str, str]]:
    r"""Of every `rate of a letter = expression` the letter, and the expression as it is typed; of `M \dot v = u` the
    expression over M. A second rate, as of `m \ddot x + d \dot x = u`, is solved for."""
    for one in motions_in(text):
        yield letter_latex(one.letter), one.rate


@dataclass(frozen=True)
class Motion:
    """A letter as it is typed, with the dots of its rate, how many they are, and the expression that this rate is."""

    letter: Letter
    order: int
    rate: str

    @property
    def below(self) -> str:
        """The letter's first rate in LaTeX, where a line gives its second."""
        return spelled(replace(self.letter, accents=(*self.letter.accents[:-1], "dot")))


def motions_in(text: str) -> Iterator[Motion]:
    """The motions that a line gives, of first and second order; none of lines that second rates couple."""
    for left, right in _equations(text):
        terms = [(sign, _without_time(one)) for sign, one in left.terms] if isinstance(left, Terms) else [(1, left)]
        second = [one for one in (*_letters(left), *letters_in(right)) if {*one.accents} & {*RATES[1:]}]
        for at, (sign, term) in enumerate(terms):
            *factors, last = term.factors if isinstance(term, Product) else (term,)
            order = _ORDERS.get(last.accents[-1], 0) if isinstance(last, Letter) and last.accents else 0
            others = [one for _, one in terms[:at] + terms[at + 1:]]
            alone = len(second) == 1 if order == 2 else not others
            if not isinstance(last, Letter) or not order or not alone or {*last.accents[:-1]} & {*RATES} or any(
                    {*one.accents} & {*RATES} for one in _letters(tuple(factors))):
                continue
            pieces = _pieces(text, terms) if others else []
            rest = " ".join(pieces[:at] + pieces[at + 1:])
            solved = f"{right} - ({rest.removeprefix('+ ')})" if others else right
            factor = _plain(text[term.position:last.position]) if factors else ""
            solved = rf"\frac{{{solved}}}{{{factor}}}" if factor else solved
            yield Motion(last, order, f"-({solved})" if sign < 0 else solved)


def _pieces(text: str, terms: Sequence[tuple[int, Node]]) -> list[str]:
    """The terms of a side as they are typed, each with its sign."""
    starts = [one.position for _, one in terms]
    ends = [max(text.rfind("+", 0, place), text.rfind("-", 0, place)) for place in starts[1:]]
    ends.append(min(place for sign in _EQUALS if (place := text.find(sign, starts[-1])) >= 0))
    return [f"{'-' if sign < 0 else '+'} {_plain(text[start:end])}"
            for (sign, _), start, end in zip(terms, starts, ends, strict=True)]


def rated_in(text: str) -> set[str]:
    r"""The letters of which a line says a rate of any order by itself, as of `\ddot x = u` and `M \dot v(t) = f`."""
    left, sign, _ = _plain(text).partition("=")
    return {letter_latex(one) for one in letters_in(left) if set(one.accents) & set(RATES)} if sign else set()


def _plain(text: str) -> str:
    """A piece of a line without what lays it out."""
    return " ".join(_LAYOUT.sub(" ", text).split())


def _equations(text: str) -> Iterator[tuple[Node, str]]:
    try:
        line = read_line(text)
        claimed, conditions = parted(line)
    except LatexError:
        return
    if conditions or any(words not in PARTED for words in line.separators):
        return
    ends = [*(chain.position for chain in claimed[1:]), len(text)]
    for chain, end in zip(claimed, ends, strict=True):
        left = _without_time(chain.sides[0])
        if chain.signs == ("=",) and isinstance(left, (Letter, Product, Terms)):
            start = chain.sides[1].position
            yield left, _END.sub("", _plain(text[_start(text, chain, start):end]))


def _without_time(side: Node) -> Node:
    """A side without the `(t)` behind its last letter."""
    if not isinstance(side, Product) or side.factors[-1] != _OF_TIME:
        return side
    return side.factors[0] if len(side.factors) == 2 else replace(side, factors=side.factors[:-1])


def _start(text: str, chain: Chain, near: int) -> int:
    """Where the right side begins: behind the equality sign."""
    return max(place + len(sign) for sign in _EQUALS
               if (place := text.rfind(sign, chain.position, near + 1)) >= 0)


def in_order(definitions: dict[str, str], filled: set[str]) -> dict[str, str]:
    """The definitions whose letters are known, each behind those that it uses."""
    found: dict[str, str] = {}
    left = {letter: right for letter, right in definitions.items() if letter not in filled}
    while ready := [letter for letter, right in left.items() if letters_of_text(right) <= filled | found.keys()]:
        for letter in ready:
            found[letter] = left.pop(letter)
    return found
