"""What a printed line states: the relations it claims, and those under which it claims them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from workbench.proof.claim import Operator
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import Chain, Group, Letter, Line, Node, Product, Terms

OPERATORS: dict[str, Operator] = {"=": "==", "<=": "<=", ">=": ">=", "<": "<", ">": ">", "!=": "!="}
_AND = frozenset(("and", ",", "", "as well as"))
_UNDER = ("for", "if", "when", "with", "where", "under", "at", "whenever", "provided that", "such that", "for all")


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
    claimed, conditions = parted(line)
    if not claimed:
        raise LatexError("the line claims nothing: write a relation")
    return Statement(_related(claimed, converter), _related(conditions, converter))


def parted(line: Line) -> tuple[list[Chain], list[Chain]]:
    """The chains that a line claims, and those that are its conditions: before an arrow or a colon, after `for` or
    `if`, in brackets after a relation."""
    flat = [word for words in line.separators for word in words]
    if any(word in ("\\forall", "\\exists") for word in flat):
        raise ProseError("the line quantifies over what stands behind 'for all' or 'exists': it is read by a person")
    if "<=>" in flat:
        raise ProseError("the line claims that two statements are equivalent: state each of them")
    if flat.count("=>") > 1:
        raise LatexError("more than one arrow: write one line for each")
    claimed: list[Chain] = []
    conditions: list[Chain] = []
    into = claimed
    for words, chain in zip(line.separators, line.chains, strict=False):
        for word in words:
            if word in ("=>", ":"):
                conditions, claimed = conditions + claimed, []
                into = claimed
            elif word.startswith("text "):
                into = _after_words(word.removeprefix("text "), into, claimed, conditions)
        kept, bracketed = _unbracketed(chain)
        into.append(kept)
        conditions += bracketed
    for word in line.separators[-1]:
        if word.startswith("text ") and word.removeprefix("text ").strip(" .,") not in _AND:
            raise _said(word.removeprefix("text "))
        if word in ("=>", ":"):
            raise LatexError("nothing stands behind the arrow or colon: complete the line")
    return claimed, conditions


def _after_words(text: str, into: list[Chain], claimed: list[Chain], conditions: list[Chain]) -> list[Chain]:
    said = text.strip(" .,").lower()
    if said in _AND:
        return into
    if said in _UNDER and claimed:
        return conditions
    raise _said(text)


def _said(text: str) -> ProseError:
    return ProseError(f"the words '{text}' belong to the statement: it is read by a person")


def _unbracketed(chain: Chain) -> tuple[Chain, list[Chain]]:
    """A relation without the condition that stands in brackets at its end, as in `V > 0 (e != 0)`."""
    last = chain.sides[-1]
    if not chain.signs or not isinstance(last, Product) or not isinstance(last.factors[-1], Group):
        return chain, []
    factors, inner = last.factors, last.factors[-1].line
    if not all(part.signs for part in inner.chains) or any(s not in ((), (",",)) for s in inner.separators):
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


def _chain(chain: Chain, converter: Converter) -> list[Related]:
    if "in" in chain.signs:
        return _interval(chain, converter)
    for sign in chain.signs:
        if sign not in OPERATORS:
            raise ProseError(f"the sign '{sign}' is none of a goal's relations: the line is read by a person")
    sides = tuple(converter.number(side) for side in chain.sides)
    return [Related(sides, tuple(OPERATORS[sign] for sign in chain.signs))]


def _interval(chain: Chain, converter: Converter) -> list[Related]:
    """`x \\in [a, b)` as a <= x, x < b, and the chain before it."""
    place, interval = chain.signs.index("in"), chain.sides[-1]
    if place != len(chain.signs) - 1 or not isinstance(interval, Group):
        raise ProseError("a set other than an interval: the line is read by a person")
    line = interval.line
    if interval.opening not in "([" or interval.closing not in ")]" or len(line.chains) != 2 or \
            any(part.signs for part in line.chains) or line.separators != ((), (",",), ()):
        raise ProseError("a set other than an interval: the line is read by a person")
    member, ends = chain.sides[-2], [part.sides[0] for part in line.chains]
    before = _chain(Chain(chain.sides[:-1], chain.signs[:-1]), converter) if place else []
    value = converter.number(member)
    low, high = (None if _infinite(end) else converter.number(end) for end in ends)
    bounds = [] if low is None else [Related((low, value), ("<=" if interval.opening == "[" else "<",))]
    upper = [] if high is None else [Related((value, high), ("<=" if interval.closing == "]" else "<",))]
    return [*before, *bounds, *upper]


def _infinite(node: Node) -> bool:
    inner = node.terms[0][1] if isinstance(node, Terms) and len(node.terms) == 1 else node
    return inner == Letter("\\infty")
