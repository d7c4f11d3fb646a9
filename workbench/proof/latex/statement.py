"""What a printed line states: the relations it claims, and those under which it claims them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import sympy as sp

from workbench.proof.claim import Operator, Relation
from workbench.proof.latex.brackets import says_nothing
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.ends import is_all_numbers, is_constant, is_infinite, require_own_ends
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.parts import UNDER, Parts, ProseError, parts_of_line, said_of
from workbench.proof.latex.tree import END, Chain, Dot, Group, Letter, Line, Node, Number, Power, Product, Size
from workbench.proof.latex.vectors import is_vector

OPERATORS: dict[str, Operator] = {"=": "==", "<=": "<=", ">=": ">=", "<": "<", ">": ">", "!=": "!="}
_AT_ALL_TIMES = tuple(Chain((Letter("t"), Number(Fraction(0))), (sign,)) for sign in (">=", ">"))


@dataclass(frozen=True)
class Related:
    """Sides with the operators between them: `a <= b < c` has three sides and two operators."""

    sides: tuple[sp.Expr, ...]
    operators: tuple[Operator, ...]


@dataclass(frozen=True)
class Statement:
    """Relations claimed, and the conditions that stand with them in the line."""

    claimed: tuple[Related, ...]
    conditions: tuple[Related, ...]


def statement(line: Line, converter: Converter) -> Statement:
    """The statement of a line; raises ProseError where words carry part of it, LatexError for what cannot be read."""
    if not converter.declared and any("\\forall" in words for words in line.separators):
        raise ProseError("the line quantifies over what stands behind 'for all': it is read by a person")
    parts = parts_of_line(line)
    claimed, conditions = parts.claimed, parts.conditions
    if converter.declared:
        _require_quantified(line)
        _require_conditions(parts.late, converter)
        _require_one_sentence(line, parts, converter)
    for (before, after), words in zip(pairwise(line.chains), line.separators[1:], strict=False):
        if words == (",",):
            require_own_ends(before, after)
    if not claimed:
        raise LatexError("the line claims nothing: write a relation, behind a colon where 'for all' stands first")
    return Statement(_related(claimed, converter), _related(conditions, converter, converter.declared))


def _require_quantified(line: Line) -> None:
    """Raise LatexError for a colon that nothing introduces: `A: B` may say B for all A, or A where B holds."""
    first = any(word == "\\forall" or said_of(word) in UNDER for word in line.separators[0])
    if not first and any(":" in words for words in line.separators):
        raise LatexError(r"what the colon says is open: write \Rightarrow, or \text{for} or \forall first")


def relations(related: tuple[Related, ...]) -> tuple[Relation, ...]:
    """The relations between neighbouring sides."""
    return tuple(Relation(*step) for chain in related
                 for step in zip(chain.sides[:-1], chain.operators, chain.sides[1:], strict=True))


def _require_conditions(late: list[tuple[Chain, bool]], converter: Converter) -> None:
    """Raise LatexError for what stands behind a condition and a comma, as in `x^2 > 0 if x > 0, y >= 1`: it may be
    claimed. A list of the letters that `for all` is said of, with bounds that are no equations, has one reading."""
    for chain, of_all in late:
        side = chain.sides[0]
        bounded = side.parts[0] if isinstance(side, Size) and len(side.parts) == 1 else side
        letter = isinstance(bounded, Letter) and isinstance(
            converter.notation.meaning(bounded), (sp.Symbol, sp.Indexed))
        if chain not in _AT_ALL_TIMES and not (of_all and letter and "=" not in chain.signs):
            raise LatexError(r"what stands behind the comma may be claimed or one more condition: write \text{and} "
                             "before a condition, another line for a claim", chain.position)


def _require_one_sentence(line: Line, parts: Parts, converter: Converter) -> None:
    """Raise LatexError where it is open which claims a condition holds for, or whether it is one.

    `y >= 1. x > 0 => x^3 > 0` says two things, of which the first is no condition; in `x >= 0, x^3 > 0 (x > 0)` the
    first may hold without one; `V >= 0 with V' <= 0` may claim both, and `c > 0 such that x <= c` that there is one.
    """
    if parts.conditions and any(END in words for words in line.separators[1:-1]):
        raise LatexError("whether a condition holds beyond the full stop, semicolon or new line is open: write one "
                         "line for each claim", parts.conditions[0].position)
    if parts.bracketed and sum(bool(chain.signs) for chain in parts.claimed) > 1:
        raise LatexError("whether the condition in brackets holds for every claim is open: write one line for each "
                         "claim", parts.bracketed[0].position)
    if parts.exists:
        raise ProseError("the words 'such that' may say that there is such a value: write \\text{if} for a condition")
    for chain in parts.said:
        side = chain.sides[1] if is_constant(chain.sides[0]) and chain.signs else chain.sides[0]
        if not _is_bounded(side, converter):
            raise LatexError(r"what is said behind these words may be claimed or a condition: write \text{if} or "
                             r"\text{and}", chain.position)


def _is_bounded(side: Node, converter: Converter) -> bool:
    """Whether a side is a letter, or its size, of which a condition gives a value or a bound."""
    if isinstance(side, Product) and len(side.factors) == 2 and says_nothing(converter.notation, side.factors[1]):
        side = side.factors[0]
    letter = side.parts[0] if isinstance(side, Size) and len(side.parts) == 1 else side
    return isinstance(letter, Letter) and (not {"dot", "ddot", "dddot"} & set(letter.accents) or isinstance(
        converter.notation.meaning(letter), sp.Symbol))


def _related(chains: list[Chain], converter: Converter, of_letters: bool = False) -> tuple[Related, ...]:
    """Chains as relations; sides that commas part before a relation share it, as in `a, b > 0`; of_letters: only where
    they are of one sort."""
    found: list[Related] = []
    waiting: list[Chain] = []
    for chain in chains:
        if not chain.signs:
            waiting.append(chain)
            continue
        if waiting and is_constant(waiting[-1].sides[0]):
            raise LatexError("a number and a comma before a relation: write a point for a decimal comma",
                             waiting[-1].position)
        if of_letters and any(type(one.sides[0]) is not type(chain.sides[0]) for one in waiting):
            raise LatexError("what stands before the comma may have the bound behind it or none: write each with its "
                             "own", waiting[0].position)
        for single in (*waiting, chain):
            found += _chain(replace(chain, sides=(single.sides[0], *chain.sides[1:])), converter)
        waiting = []
    if waiting:
        raise LatexError("no relation: write one with a relation sign", waiting[0].position)
    return tuple(found)


def _chain(chain: Chain, converter: Converter) -> list[Related]:
    if converter.declared and chain in _AT_ALL_TIMES and converter.notation.meaning(chain.sides[0]) is None:
        return []  # what is said of an instant is said of all
    if "in" in chain.signs:
        return _interval(chain, converter)
    for sign in chain.signs:
        if sign not in OPERATORS:
            raise ProseError(f"the sign '{sign}' is none of a goal's relations: the line is read by a person")
    for side in chain.sides[1:] if converter.declared else ():
        first, *rest = side.factors if isinstance(side, Product) else (side,)
        if first == Number(Fraction(0)) and rest and (isinstance(rest[0], Group) or (
                side is not chain.sides[-1] and not isinstance(rest[0], Dot))):
            raise LatexError("a zero stands before a factor: write a comma between two relations, or \\cdot for a "
                             "product", rest[0].position)
    sides = tuple(converter.side(side) for side in chain.sides)
    return [Related(sides, tuple(OPERATORS[sign] for sign in chain.signs))]


def _interval(chain: Chain, converter: Converter) -> list[Related]:
    """`x \\in [a, b)` as a <= x, x < b, and the chain before it."""
    place, interval = chain.signs.index("in"), chain.sides[-1]
    if place == len(chain.signs) - 1 and is_all_numbers(interval):
        _require_letter(chain.sides[-2], interval, converter)
        return _chain(Chain(chain.sides[:-1], chain.signs[:-1]), converter) if place else []
    if place != len(chain.signs) - 1 or not isinstance(interval, Group):
        raise ProseError("a set other than an interval: the line is read by a person")
    line = interval.line
    if interval.opening not in "([" or interval.closing not in ")]" or len(line.chains) != 2 or \
            any(part.signs for part in line.chains) or line.separators != ((), (",",), ()):
        raise ProseError("a set other than an interval: the line is read by a person")
    member, ends = chain.sides[-2], [part.sides[0] for part in line.chains]
    before = _chain(Chain(chain.sides[:-1], chain.signs[:-1]), converter) if place else []
    value = converter.side(member)
    low, high = (None if is_infinite(end, sign) else converter.side(end)
                 for end, sign in zip(ends, (-1, 1), strict=True))
    bounds = [] if low is None else [Related((low, value), ("<=" if interval.opening == "[" else "<",))]
    upper = [] if high is None else [Related((value, high), ("<=" if interval.closing == "]" else "<",))]
    return [*before, *bounds, *upper]


def _require_letter(member: Node, numbers: Node, converter: Converter) -> None:
    """Raise LatexError unless a letter is said to be real, which says no more of it: of a formula it says that it is
    defined."""
    of_time = isinstance(member, Product) and len(member.factors) == 2 and says_nothing(
        converter.notation, member.factors[1])
    letter = member.factors[0] if isinstance(member, Product) and of_time else member
    meaning = converter.notation.meaning(member)
    if meaning is None and not isinstance(letter, Letter):
        raise LatexError("that a formula is a real number says that it is defined, which is no relation: write what "
                         "its denominators, roots and logarithms need", member.position)
    if converter.declared and meaning is not None and isinstance(numbers, Power) and (
            not is_vector(meaning) or numbers.exponent != Letter("n")):
        raise LatexError(r"the set of columns fits no declared kind: a vector is one of \mathbb{R}^n, a number of "
                         r"\mathbb{R}", member.position)
