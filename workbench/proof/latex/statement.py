"""What a printed line states: the relations it claims, and those under which it claims them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise

import sympy as sp

from workbench.proof.claim import Operator, Relation
from workbench.proof.latex.brackets import says_nothing
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.ends import is_all_numbers, is_constant, is_infinite, require_own_ends
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import END, Chain, Dot, Group, Letter, Line, Node, Number, Power, Product, Size
from workbench.proof.latex.vectors import is_vector

OPERATORS: dict[str, Operator] = {"=": "==", "<=": "<=", ">=": ">=", "<": "<", ">": ">", "!=": "!="}
_AND = frozenset(("and", ",", "", "as well as"))
_ALL = ("for all", "for every", "for any", "for each")
_UNDER = ("for", "if", "when", "with", "where", "under", "at", "whenever", "provided that", "such that", *_ALL)
_SPOKEN = ("with", "where", "such that", "under", "at")
_THEN = ("then", "we have", "then we have", "it holds that", "it follows that", "one has")
_IMPLIES = ("implies", "imply", "implies that", "imply that")
_AT_ALL_TIMES = tuple(Chain((Letter("t"), Number(Fraction(0))), (sign,)) for sign in (">=", ">"))


class ProseError(LatexError):
    """A line whose words carry part of what it states."""


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
    parts = _parts(line)
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
    first = any(word == "\\forall" or _said_of(word) in _UNDER for word in line.separators[0])
    if not first and any(":" in words for words in line.separators):
        raise LatexError(r"what the colon says is open: write \Rightarrow, or \text{for} or \forall first")


def relations(related: tuple[Related, ...]) -> tuple[Relation, ...]:
    """The relations between neighbouring sides."""
    return tuple(Relation(*step) for chain in related
                 for step in zip(chain.sides[:-1], chain.operators, chain.sides[1:], strict=True))


def parted(line: Line) -> tuple[list[Chain], list[Chain]]:
    """The chains that a line claims, and those that are its conditions: before an arrow or a colon, after `for`, `if`
    or a quantifier, in brackets after a relation."""
    parts = _parts(line)
    return parts.claimed, parts.conditions


@dataclass
class _Parts:
    """Chains claimed, and their conditions; `late` are those conditions behind a claim that a comma alone makes one.

    behind: whether the conditions stand behind a claim; listed: how many of them the last word introduced; of_all:
    whether that was `for all`; said: those behind `with` and its like, which may be claimed too; bracketed: those in
    brackets behind a relation; exists: whether `such that` stands behind a claim, as if there were one.
    """

    claimed: list[Chain] = field(default_factory=list)
    conditions: list[Chain] = field(default_factory=list)
    late: list[tuple[Chain, bool]] = field(default_factory=list)
    behind: bool = False
    listed: int = 0
    of_all: bool = False
    said: list[Chain] = field(default_factory=list)
    bracketed: list[Chain] = field(default_factory=list)
    exists: bool = False

    def under(self, of_all: bool) -> None:
        """Conditions follow; raise LatexError where a list of them stands before, which may hold claims."""
        if self.behind and self.listed > 1:
            raise LatexError("several claims with a condition each, or one claim with all of them: write one line for "
                             "each claim")
        self.behind, self.listed, self.of_all = bool(self.claimed), 0, of_all

    def turn(self) -> None:
        """What stood so far is the condition of what follows."""
        if self.behind:
            raise LatexError("a claim and its condition stand before an arrow or a colon: write the conditions first")
        while self.conditions and not self.conditions[-1].signs:
            self.conditions.pop()  # `for all x`; in `x, y > 0` it shares the bound of the next one
        self.conditions += self.claimed
        self.claimed = []

    def condition(self, chain: Chain, words: tuple[str, ...]) -> None:
        """One more condition, behind these words."""
        if self.behind and END in words:
            raise LatexError("whether the condition goes on behind the full stop, semicolon or new line is open: write "
                             "one line for each claim", chain.position)
        listed = words[:1] == (",",) and (words[1:] == () or _said_of(words[1]) in _AND) and len(words) < 3
        if self.behind and listed and self.conditions[-1].signs:  # `x, y > 0` is one
            self.late.append((chain, self.of_all))
        self.listed += bool(chain.signs)
        self.conditions.append(chain)


def _require_one(flat: list[str]) -> None:
    """Raise LatexError where a line makes more than one statement, or one that is none of a goal."""
    if "\\exists" in flat:
        raise ProseError("the line says that something exists: it is read by a person")
    if "<=>" in flat:
        raise ProseError("the line claims that two statements are equivalent: state each of them")
    if flat.count("=>") + sum(_said_of(word) in _IMPLIES for word in flat) > 1:
        raise LatexError("more than one arrow: write one line for each")
    if flat.count(":") > 1:
        raise LatexError("more than one colon: write one line for each")


def _parts(line: Line) -> _Parts:
    flat = [word for words in line.separators for word in words]
    _require_one(flat)
    parts, conditional, spoken = _Parts(), False, False
    for words, chain in zip(line.separators, line.chains, strict=False):
        for word in words:
            if word in ("=>", ":") or _said_of(word) in _IMPLIES:
                parts.turn()
                conditional = False
            elif word == "\\forall" or _said_of(word) in _UNDER:
                parts.under(word == "\\forall" or _said_of(word) in _ALL)
                spoken = _said_of(word) in _SPOKEN and not conditional
                parts.exists |= _said_of(word) == "such that" and not conditional
                conditional = True
            elif _said_of(word) in _THEN and conditional and not parts.claimed:
                conditional = False
            elif word.startswith("text ") and _said_of(word) not in _AND:
                raise _said(word.removeprefix("text "))
        kept, bracketed = _unbracketed(chain)
        if conditional:
            parts.condition(kept, words)
            parts.said += [kept] * spoken
        else:
            parts.claimed.append(kept)
        parts.conditions += bracketed
        parts.bracketed += bracketed
    if any(word == "\\forall" or _said_of(word) in _ALL for word in flat):
        while parts.conditions and not parts.conditions[-1].signs and isinstance(parts.conditions[-1].sides[0], Letter):
            parts.conditions.pop()  # `for all x`: everything is said of all values
    _require_end(line.separators[-1])
    return parts


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


def _require_one_sentence(line: Line, parts: _Parts, converter: Converter) -> None:
    """Raise LatexError where it is open which claims a condition holds for, or whether it is one.

    `y >= 1. x > 0 => x^3 > 0` says two things, of which the first is no condition; in `x >= 0, x^3 > 0 (x > 0)` the
    first may hold without one; `V >= 0 with V' <= 0` may claim both, and `c > 0 such that x <= c` that there is one.
    """
    if parts.conditions and any(END in words for words in line.separators[1:-1]):
        raise LatexError("whether a condition holds beyond the full stop, semicolon or new line is open: write one line "
                         "for each claim", parts.conditions[0].position)
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


def _require_end(words: tuple[str, ...]) -> None:
    """Raise LatexError for what ends a line and says something."""
    for word in words:
        if word.startswith("text ") and word.removeprefix("text ").strip(" .,") not in _AND:
            raise _said(word.removeprefix("text "))
        if word in ("=>", ":"):
            raise LatexError("nothing stands behind the arrow or colon: complete the line")


def _said_of(word: str) -> str:
    """What a separator says in words; nothing where it is none."""
    return word.removeprefix("text ").strip(" .,").lower() if word.startswith("text ") else "-"


def _said(text: str) -> ProseError:
    return ProseError(f"the words '{text}' belong to the statement: it is read by a person")


def _unbracketed(chain: Chain) -> tuple[Chain, list[Chain]]:
    """A relation without the condition that stands in brackets at its end, as in `V > 0 (e != 0)`."""
    last = chain.sides[-1]
    if not chain.signs or not isinstance(last, Product) or not isinstance(last.factors[-1], Group):
        return chain, []
    factors, inner = last.factors, last.factors[-1].line
    related = bool(inner.chains) and all(part.signs for part in inner.chains)
    if not related or any(s not in ((), (",",)) for s in inner.separators):
        return chain, []
    kept = factors[0] if len(factors) == 2 else replace(last, factors=factors[:-1])
    return replace(chain, sides=(*chain.sides[:-1], kept)), list(inner.chains)


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
