"""Matrices that are positive semidefinite, stated by their minors: a pivot is positive, or it is zero with its row.

Of a >= 0 and a c >= b**2 no square is completed where a may be zero. There b is zero as well, and less is left.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation, equal, greater
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.squares import find_squares
from workbench.proof.text import relation_text, text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
MOST_PIVOTS = 2


def find_by_pivots(goal: Goal, shown: Relation, given: Given, done: frozenset[sp.Expr] = frozenset()) -> Proof | None:
    """A proof by the sign of a pivot that is known not to be negative; done: those whose sign is settled."""
    if shown.operator in ("==", "!=") or len(done) == MOST_PIVOTS:
        return None
    for place, pivot in enumerate(given):
        margin = pivot.margin
        entry = None if margin in done or pivot.operator not in (">=", "<=") else _entry_beside(margin, given)
        if entry is None:
            continue
        above, none = (*given, greater(margin, 0)), (*given, equal(margin, 0))
        positive = find_squares(goal, shown, above) or find_by_pivots(goal, shown, above, done | {margin})
        vanishing = equal(entry, 0)
        why = positive and find_combination(goal, greater(0, 0), (*none, vanishing.negation))
        zero = why and find_squares(goal, shown, (*none, vanishing))
        if positive and why and zero:
            last = [{"assume": place}, {"assume": len(given)}]
            return {"rule": "cases", "of": text(margin), "positive": positive,
                    "zero": {"rule": "cut", "lemma": relation_text(vanishing), "proof": why | {"rule": "contradiction"},
                             "then": zero},
                    "negative": {"rule": "contradiction", "terms": [
                        {"coefficient": "1", "factors": [factor]} for factor in last]}}
    return None


def _entry_beside(margin: sp.Expr, given: Given) -> sp.Symbol | None:
    """The symbol that an assumption leaves no value but zero where a pivot, linear in a symbol of its own, is zero."""
    symbols = margin.free_symbols
    if len(symbols) != 1 or not margin.is_polynomial(*symbols):
        return None
    symbol, = symbols
    slope = sp.diff(margin, symbol)
    if not slope.is_Rational or slope == 0:
        return None
    at_zero = {symbol: -margin.xreplace({symbol: sp.S.Zero}) / slope}
    for relation in given:
        if relation.operator in (">=", "<=", ">", "<") and symbol in relation.margin.free_symbols:
            number, rest = sp.expand(relation.margin.xreplace(at_zero)).as_coeff_Mul()
            base, power = rest.as_base_exp()
            if number.is_Rational and number < 0 and base.is_Symbol and power.is_Integer and power % 2 == 0:
                return base
    return None
