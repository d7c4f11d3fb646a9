"""The chains of a line apart: what it claims, and under which conditions, by its arrows, colons and words."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.tree import END, Chain, Group, Letter, Line, Product

_AND = frozenset(("and", ",", "", "as well as"))
_ALL = ("for all", "for every", "for any", "for each")
UNDER = ("for", "if", "when", "with", "where", "under", "at", "whenever", "provided that", "such that", *_ALL)
_SPOKEN = ("with", "where", "such that", "under", "at")
_THEN = ("then", "we have", "then we have", "it holds that", "it follows that", "one has")
_IMPLIES = ("implies", "imply", "implies that", "imply that")


class ProseError(LatexError):
    """A line whose words carry part of what it states."""


def parted(line: Line) -> tuple[list[Chain], list[Chain]]:
    """The chains that a line claims, and those that are its conditions: before an arrow or a colon, after `for`, `if`
    or a quantifier, in brackets after a relation."""
    parts = parts_of_line(line)
    return parts.claimed, parts.conditions


@dataclass
class Parts:
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
        listed = words[:1] == (",",) and (words[1:] == () or said_of(words[1]) in _AND) and len(words) < 3
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
    if flat.count("=>") + sum(said_of(word) in _IMPLIES for word in flat) > 1:
        raise LatexError("more than one arrow: write one line for each")
    if flat.count(":") > 1:
        raise LatexError("more than one colon: write one line for each")


def parts_of_line(line: Line) -> Parts:
    """The chains of a line apart; raises ProseError where words carry part of it, LatexError for what is open."""
    flat = [word for words in line.separators for word in words]
    _require_one(flat)
    parts, conditional, spoken = Parts(), False, False
    for words, chain in zip(line.separators, line.chains, strict=False):
        for word in words:
            if word in ("=>", ":") or said_of(word) in _IMPLIES:
                parts.turn()
                conditional = False
            elif word == "\\forall" or said_of(word) in UNDER:
                parts.under(word == "\\forall" or said_of(word) in _ALL)
                spoken = said_of(word) in _SPOKEN and not conditional
                parts.exists |= said_of(word) == "such that" and not conditional
                conditional = True
            elif said_of(word) in _THEN and conditional and not parts.claimed:
                conditional = False
            elif word.startswith("text ") and said_of(word) not in _AND:
                raise _said(word.removeprefix("text "))
        kept, bracketed = _unbracketed(chain)
        if conditional:
            parts.condition(kept, words)
            parts.said += [kept] * spoken
        else:
            parts.claimed.append(kept)
        parts.conditions += bracketed
        parts.bracketed += bracketed
    if any(word == "\\forall" or said_of(word) in _ALL for word in flat):
        while parts.conditions and not parts.conditions[-1].signs and isinstance(parts.conditions[-1].sides[0], Letter):
            parts.conditions.pop()  # `for all x`: everything is said of all values
    _require_end(line.separators[-1])
    return parts


def _require_end(words: tuple[str, ...]) -> None:
    """Raise LatexError for what ends a line and says something."""
    for word in words:
        if word.startswith("text ") and word.removeprefix("text ").strip(" .,") not in _AND:
            raise _said(word.removeprefix("text "))
        if word in ("=>", ":"):
            raise LatexError("nothing stands behind the arrow or colon: complete the line")


def said_of(word: str) -> str:
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
