"""A small grammar of phrases, and how a row of words is matched with it: all of it, or not at all."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

# A found phrase: its rule, and the words from where to where.
Found = tuple[str, int, int]
_Ends = dict[int, tuple[Found, ...]]
_SIGN = re.compile(r"[A-Za-z_'-]+|[,:;.()]|[?*+|]|\S")


@dataclass(frozen=True)
class Grammar:
    r"""Rules by name, each as text: words as they are, `<rule>`s, CLASSES of words; `?`, `*` and `+` behind any of
    them, `|` between alternatives and square brackets around what belongs together.

    classes: the words, or kinds of formulas, that a CLASS holds. kept: the rules whose places are told.
    """

    rules: Mapping[str, str]
    classes: Mapping[str, Collection[str]]
    kept: Collection[str]

    @cached_property
    def parsed(self) -> Mapping[str, Any]:
        """Each rule as nested alternatives; raises KeyError for a rule or class that there is not."""
        parsed = {name: _alternatives(_SIGN.findall(text), 0)[0] for name, text in self.rules.items()}
        for one in parsed.values():
            self._require_known(one)
        return parsed

    def _require_known(self, part: Any) -> None:
        kind, *rest = part
        if kind == "rule":
            self.rules[rest[0]]
        elif kind == "word" and rest[0].isupper() and len(rest[0]) > 1:
            self.classes[rest[0]]
        elif kind in ("any", "row"):
            for one in rest[0]:
                self._require_known(one)
        elif kind == "many":
            self._require_known(rest[0])

    def match(self, rule: str, words: Sequence[str]) -> tuple[Found, ...] | None:
        """The phrases within words that are a rule as a whole, in order; None where they are not."""
        return _Match(self, words).ends(("rule", rule), 0).get(len(words))


@dataclass
class _Match:
    """Matches from every place once, so that the time grows as a power of the length and no faster."""

    grammar: Grammar
    words: Sequence[str]
    seen: dict[tuple[int, int], _Ends] = field(default_factory=dict)

    def ends(self, part: Any, at: int) -> _Ends:
        """Where a part that begins at a place may end, with what is found within it."""
        key = (id(part) if part[0] != "rule" else hash(part), at)
        if key not in self.seen:
            self.seen[key] = {}  # a rule that begins with itself finds nothing so
            self.seen[key] = getattr(self, f"_{part[0]}")(part, at)
        return self.seen[key]

    def _word(self, part: Any, at: int) -> _Ends:
        if at >= len(self.words):
            return {}
        held = self.grammar.classes.get(part[1])
        fits = self.words[at] in held if held is not None else self.words[at] == part[1]
        return {at + 1: ()} if fits else {}

    def _rule(self, part: Any, at: int) -> _Ends:
        found = self.ends(self.grammar.parsed[part[1]], at)
        if part[1] not in self.grammar.kept:
            return found
        return {end: ((part[1], at, end), *inner) for end, inner in found.items()}

    def _any(self, part: Any, at: int) -> _Ends:
        found: _Ends = {}
        for one in part[1]:
            for end, inner in self.ends(one, at).items():
                found.setdefault(end, inner)  # the first alternative that ends somewhere counts
        return found

    def _row(self, part: Any, at: int) -> _Ends:
        reached: _Ends = {at: ()}
        for one in part[1]:
            after: _Ends = {}
            for place in sorted(reached, reverse=True):  # as many words as can be belong together
                for end, inner in self.ends(one, place).items():
                    after.setdefault(end, reached[place] + inner)
            reached = after
        return reached

    def _many(self, part: Any, at: int) -> _Ends:
        _, one, least, most = part
        reached: _Ends = {at: ()}
        found: _Ends = dict(reached) if least == 0 else {}
        while reached:
            after: _Ends = {}
            for place in sorted(reached, reverse=True):
                for end, inner in self.ends(one, place).items():
                    if end > place and end not in found:
                        after.setdefault(end, reached[place] + inner)
            found |= after
            reached = after if most else {}
        return found


def _alternatives(signs: list[str], at: int) -> tuple[Any, int]:
    alternatives: list[Any] = []
    row: list[Any] = []
    while at < len(signs) and signs[at] != "]":
        sign = signs[at]
        at += 1
        if sign == "|":
            alternatives.append(("row", tuple(row)))
            row = []
        elif sign in "?*+":
            row[-1] = ("many", row[-1], sign == "+", sign != "?")
        elif sign == "[":
            inner, at = _alternatives(signs, at)
            row.append(inner)
            at += 1
        elif sign == "<":
            row.append(("rule", signs[at]))
            at += 2
        else:
            row.append(("word", sign))
    alternatives.append(("row", tuple(row)))
    return (alternatives[0] if len(alternatives) == 1 else ("any", tuple(alternatives))), at

