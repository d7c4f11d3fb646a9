"""Functions that grow: a margin that is not negative where a symbol starts, and does not fall as the symbol leaves."""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, greater
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.sign_cases import by_sign
from workbench.proof.derive import Side, Size
from workbench.proof.text import relation_text, text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Found = Proof | None

MOST_STEPS = 3  # derivatives taken one after the other
EMPTY = at_least(0, 0)
GROWING = (sp.log, sp.exp, sp.sin, sp.cos, sp.atan)  # functions that have a rate


def find_by_growth(goal: Goal, shown: Relation, given: Given, steps: int = MOST_STEPS) -> Found:
    """A margin with a function in it that is not negative where a symbol starts, and grows as it leaves."""
    margin = shown.margin
    if shown.operator in ("==", "!=") or not margin.has(*GROWING) or margin.has(
            sp.Sum, sp.Indexed, Size, Side) or steps == 0:
        return None
    for symbol, start, way in _starts(margin, given):
        elsewhere = tuple(EMPTY if r.margin.has(symbol) else r for r in given)
        place, begins = Goal((EMPTY,), facts=goal.facts), margin.xreplace({symbol: start})
        if begins.has(sp.nan, sp.zoo, sp.oo, -sp.oo):  # it has no value where it would begin
            continue
        at_start = _grown(place, Relation(begins, ">" if shown.strict else ">=", sp.S.Zero),
                          elsewhere, steps)
        if at_start is None:
            continue
        bounded = tuple(r for r in given if r.operator not in ("==", "!=")
                        and not sp.expand(r.margin + way * symbol).has(symbol))  # it lies below them on the way as well
        between = (*elsewhere, at_least(way * (symbol - start), 0), *bounded)
        below = _positive_below(place, margin, between)
        rising = _grown(place, at_least(way * sp.diff(margin, symbol), 0),
                        (*between, *(lemma for lemma, _ in below)), steps)
        if rising is not None:
            found = {"rule": "monotone", "variable": text(symbol), "from" if way > 0 else "to": text(start),
                     "derivative": rising, "at_start": at_start}
            stated = [{"lemma": relation_text(lemma), "proof": proof} for lemma, proof in below]
            return found | ({"between": stated} if stated else {})
    return None


def find_by_growth_both_ways(goal: Goal, shown: Relation, given: Given) -> Found:
    """A margin with a function in it that is zero where a symbol is, and grows as it leaves, upwards and downwards: so
    x tanh x is at least the logarithm of cosh x."""
    margin = shown.margin
    if shown.operator not in ("<=", ">=") or not margin.has(*GROWING) or margin.has(sp.Sum, sp.Indexed, Size, Side):
        return None
    for symbol in sorted(margin.free_symbols, key=str):
        if symbol.is_nonnegative or any(r.margin.has(symbol) for r in given) or margin.xreplace({symbol: 0}) != 0:
            continue
        proof = by_sign(symbol, lambda case: find_by_growth(goal, shown, (*given, case)))
        if proof is not None:
            return proof
    return None


def _positive_below(goal: Goal, margin: sp.Expr, given: Given) -> list[tuple[Relation, Proof]]:
    """Of the functions that a margin divides by, those that are positive, each with its proof."""
    found: list[tuple[Relation, Proof]] = []
    bases = {p.base for p in margin.atoms(sp.Pow) if p.exp.is_Rational and p.exp < 0 and isinstance(p.base, GROWING)}
    for base in sorted(bases, key=sp.default_sort_key):
        proof = find_combination(goal, greater(base, 0), (*given, *(lemma for lemma, _ in found)))
        found += [] if proof is None else [(greater(base, 0), proof)]
    return found


def _starts(margin: sp.Expr, given: Given) -> list[tuple[sp.Symbol, sp.Expr, int]]:
    """(symbol, start, way) of the symbols in a margin that are known not to lie below (way 1) or above (-1) an
    expression of others."""
    found = []
    for relation in given:
        for symbol in sorted(margin.free_symbols, key=str) if relation.operator not in ("==", "!=") else ():
            for way in (1, -1):
                start = sp.expand(symbol - way * relation.margin, log=False)  # as the assumption has it
                if not start.has(symbol) and not start.has(sp.Sum, sp.Indexed):
                    found.append((symbol, start, way))
    return found


def _grown(goal: Goal, shown: Relation, given: Given, steps: int) -> Found:
    """A proof of what is left of a margin that grows."""
    if shown.operator == ">=" and find_identity(goal, shown):
        return {"rule": "identity"}
    return find_combination(goal, shown, given) or find_by_growth(goal, shown, given, steps - 1)
