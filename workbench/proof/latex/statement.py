"""What a printed line states: the relations it claims, and those under which it claims them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import sympy as sp

from workbench.proof.claim import Operator, Relation
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import Chain, Group, Letter, Line, Node, Number, Power, Product, Terms

OPERATORS: dict[str, Operator] = {"=": "==", "<=": "<=", ">=": ">=", "<": "<", ">": ">", "!=": "!="}
_AND = frozenset(("and", ",", "", "as well as"))
_ALL = ("for all", "for every", "for any", "for each")
_UNDER = ("for", "if", "when", "with", "where", "under", "at", "whenever", "provided that", "such that", *_ALL)
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
    claimed, conditions = parted(line)
    if converter.declared:
        _require_quantified(line)
    for (before, after), words in zip(pairwise(line.chains), line.separators[1:], strict=False):
        if words == (",",):
            _require_own_ends(before, after)
    if not claimed:
        raise LatexError("the line claims nothing: write a relation, behind a colon where 'for all' stands first")
    return Statement(_related(claimed, converter), _related(conditions, converter))


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
    flat = [word for words in line.separators for word in words]
    if "\\exists" in flat:
        raise ProseError("the line says that something exists: it is read by a person")
    if "<=>" in flat:
        raise ProseError("the line claims that two statements are equivalent: state each of them")
    if flat.count("=>") + sum(_said_of(word) in _IMPLIES for word in flat) > 1:
        raise LatexError("more than one arrow: write one line for each")
    claimed: list[Chain] = []
    conditions: list[Chain] = []
    into = claimed
    for words, chain in zip(line.separators, line.chains, strict=False):
        for word in words:
            if word in ("=>", ":") or _said_of(word) in _IMPLIES:
                conditions, claimed = [*(c for c in conditions if c.signs), *claimed], []
                into = claimed
            elif word == "\\forall":
                into = conditions
            elif word.startswith("text "):
                into = _after_words(word.removeprefix("text "), into, claimed, conditions)
        kept, bracketed = _unbracketed(chain)
        into.append(kept)
        conditions += bracketed
    if any(word == "\\forall" or _said_of(word) in _ALL for word in flat):
        while conditions and not conditions[-1].signs and isinstance(conditions[-1].sides[0], Letter):
            conditions.pop()  # `for all x`: everything is said of all values
    _require_end(line.separators[-1])
    return claimed, conditions


def _require_end(words: tuple[str, ...]) -> None:
    """Raise LatexError for what ends a line and says something."""
    for word in words:
        if word.startswith("text ") and word.removeprefix("text ").strip(" .,") not in _AND:
            raise _said(word.removeprefix("text "))
        if word in ("=>", ":"):
            raise LatexError("nothing stands behind the arrow or colon: complete the line")


def _after_words(text: str, into: list[Chain], claimed: list[Chain], conditions: list[Chain]) -> list[Chain]:
    said = _said_of(f"text {text}")
    if said in _AND:
        return into
    if said in _UNDER:
        return conditions
    if said in _THEN and into is conditions and not claimed:
        return claimed
    raise _said(text)


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


def _related(chains: list[Chain], converter: Converter) -> tuple[Related, ...]:
    """Chains as relations; sides that commas part before a relation share it, as in `a, b > 0`."""
    found: list[Related] = []
    waiting: list[Chain] = []
    for chain in chains:
        if not chain.signs:
            waiting.append(chain)
            continue
        for single in (*waiting, chain):
            found += _chain(replace(chain, sides=(single.sides[0], *chain.sides[1:])), converter)
        waiting = []
    if waiting:
        raise LatexError("no relation: write one with a relation sign", waiting[0].position)
    return tuple(found)


def _require_own_ends(before: Chain, after: Chain) -> None:
    """Raise LatexError for `0 < x, y < 1`: it may bound each of the two on both sides, or each on one."""
    if len(before.sides) == len(after.sides) == 2 and _is_constant(before.sides[0]) and _is_constant(after.sides[1]) \
            and before.signs[0][0] == after.signs[0][0] in "<>":
        raise LatexError(r"whether the ends bound all that stands between them is open: write \text{and} between two "
                         "relations, or each with both ends", after.position)


def _is_constant(node: Node) -> bool:
    """Whether a side is a number, or infinity, with its sign."""
    terms = node.terms if isinstance(node, Terms) else ((1, node),)
    return all(isinstance(term, Number) or term == Letter("\\infty") for _, term in terms)


def _chain(chain: Chain, converter: Converter) -> list[Related]:
    if converter.declared and chain in _AT_ALL_TIMES and converter.notation.meaning(chain.sides[0]) is None:
        return []  # what is said of an instant is said of all
    if "in" in chain.signs:
        return _interval(chain, converter)
    for sign in chain.signs:
        if sign not in OPERATORS:
            raise ProseError(f"the sign '{sign}' is none of a goal's relations: the line is read by a person")
    sides = tuple(converter.side(side) for side in chain.sides)
    return [Related(sides, tuple(OPERATORS[sign] for sign in chain.signs))]


def _interval(chain: Chain, converter: Converter) -> list[Related]:
    """`x \\in [a, b)` as a <= x, x < b, and the chain before it."""
    place, interval = chain.signs.index("in"), chain.sides[-1]
    if place == len(chain.signs) - 1 and _is_all_numbers(interval):
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
    low, high = (None if _infinite(end, sign) else converter.side(end) for end, sign in zip(ends, (-1, 1), strict=True))
    bounds = [] if low is None else [Related((low, value), ("<=" if interval.opening == "[" else "<",))]
    upper = [] if high is None else [Related((value, high), ("<=" if interval.closing == "]" else "<",))]
    return [*before, *bounds, *upper]


def _infinite(node: Node, sign: int) -> bool:
    """Whether an end is infinity with this sign."""
    terms = node.terms if isinstance(node, Terms) else ((1, node),)
    return terms == ((sign, Letter("\\infty")),)


def _is_all_numbers(node: Node) -> bool:
    """Whether a set is that of the real numbers or of columns of them: of a letter no more is said by that."""
    return (node.base if isinstance(node, Power) else node) in (Letter(r"\mathbb{R}"), Letter(r"\Re"))
