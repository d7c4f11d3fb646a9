"""A sum of parts that share no symbol: each is shown by itself, so tanh(x)**2 + tanh(y)**2 <= x**2 + y**2."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.cuts import after
from workbench.proof.decide.sample_points import NEAR_ZERO, sample_points, value_at

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Search = Callable[[Goal, Relation, Given], "Proof | None"]


def find_by_parts(goal: Goal, shown: Relation, given: Given, search: Search) -> Proof | None:
    """A proof from that of each part; None where there is one part alone, or one of them was not shown."""
    if shown.operator in ("==", "!=") or any(r.margin.has(sp.Sum, sp.Indexed, sp.Derivative) for r in (shown, *given)):
        return None
    parts = separate(sp.expand(shown.margin), given)
    if len(parts) < 2 or any(value < -NEAR_ZERO for point in sample_points(shown, given) for part in parts
                             if (value := value_at(part, point)) is not None):
        return None
    lemmas: list[tuple[Relation, Proof]] = []
    for place, part in enumerate(parts):
        lemma = Relation(part, ">", sp.S.Zero) if shown.strict and place == 0 else at_least(part, 0)
        proof = search(goal, lemma, (*given, *(known for known, _ in lemmas)))
        if proof is None:
            return None
        lemmas.append((lemma, proof))
    last = find_combination(goal, shown, (*given, *(known for known, _ in lemmas)), quick=True)
    return None if last is None else after(lemmas, last)


def separate(margin: sp.Expr, given: Given = ()) -> list[sp.Expr]:
    """The parts of an expanded sum that share no symbol, and that no assumption ties; a number goes to the first."""
    groups: list[set[sp.Symbol]] = [set(r.margin.free_symbols) for r in given if r.margin.free_symbols]
    terms = sp.Add.make_args(margin)
    for symbols in [term.free_symbols for term in terms if term.free_symbols] + groups:
        near = [group for group in groups if group & symbols]
        groups = [group for group in groups if not group & symbols] + [set(symbols).union(*near)]
    parts = [sp.Add(*(term for term in terms if term.free_symbols & group)) for group in groups]
    parts = sorted((part for part in parts if part != 0), key=sp.default_sort_key)
    number = sp.Add(*(term for term in terms if not term.free_symbols))
    return [parts[0] + number, *parts[1:]] if parts else []
