"""Other coordinates for a goal: symbols counted from a number, or from an expression of other symbols.

Where a statement speaks of (y - 20)**20, numbers stay small only if y is counted from 20. Where it speaks of distances
alone, all places may be counted from one of them, so that there are fewer symbols. Where two asymptotes of a curve are
steep and flat, the square is completed: x is counted from the middle between them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from workbench.proof.claim import Goal, Relation, name_of
from workbench.proof.text import text
from workbench.proof.typed import evaluated

Term = dict[str, Any]
Centre = dict[sp.Symbol, sp.Expr]  # by symbol what is taken off it
TEXTS = ("square", "any", "positive", "sum_of_squares", "of")
MOST_TERMS = 200  # of the polynomials of a goal that is looked at for directions along which nothing changes


def centre_of(goal: Goal) -> Centre:
    """The numbers that are taken off symbols below even powers: where what is stated has its middle."""
    found: Centre = {}
    for base in _bases(goal):
        symbols = base.free_symbols
        if len(symbols) == 1 and base.is_polynomial(*symbols):
            symbol, = symbols
            polynomial = sp.Poly(base, symbol)
            if polynomial.degree() == 1:
                root = -polynomial.coeff_monomial(1) / polynomial.LC()
                if root != 0:
                    found.setdefault(symbol, root)
    return found


def _bases(goal: Goal) -> Iterator[sp.Expr]:
    for relation in goal.relations():
        for side in (relation.left, relation.right):
            for power in sorted(side.atoms(sp.Pow), key=sp.default_sort_key):
                exponent = evaluated(power.exp)
                if exponent.is_Integer and exponent > 0 and exponent % 2 == 0 and power.base.is_Add:
                    yield evaluated(power.base)


def squares_completed(goal: Goal) -> Centre:
    """What completes the square of a symbol in an equality of second degree that mixes it with another one."""
    for relation in goal.relations():
        if relation.operator != "==":
            continue
        margin = sp.expand(evaluated(relation.margin))
        symbols = sorted(margin.free_symbols, key=str)
        if len(symbols) < 2 or not margin.is_polynomial(*symbols) or sp.Poly(margin, *symbols).total_degree() != 2:
            continue
        for symbol in symbols:
            square, mixed = margin.coeff(symbol, 2), margin.coeff(symbol, 1)
            if square != 0 and mixed.free_symbols:
                return {symbol: sp.expand(-mixed / (2 * square))}
    return {}


def carried_along(goal: Goal) -> Centre:
    """Symbols counted from others, so that these vanish: nothing stated changes when all are moved together."""
    margins = [sp.expand(evaluated(r.margin)) for r in goal.relations()]
    symbols = sorted(set().union(*(margin.free_symbols for margin in margins)), key=str)
    if len(symbols) < 2 or not all(margin.is_polynomial(*symbols) for margin in margins) or sum(
            len(sp.Add.make_args(margin)) for margin in margins) > MOST_TERMS:
        return {}
    rows: dict[tuple[int, tuple[int, ...]], list[sp.Rational]] = {}
    for number, margin in enumerate(margins):
        polynomial = sp.Poly(margin, *symbols)
        for place, symbol in enumerate(symbols):
            for monomial, coefficient in polynomial.diff(symbol).terms():
                if not coefficient.is_Rational:
                    return {}
                if coefficient:
                    rows.setdefault((number, monomial), [sp.S.Zero] * len(symbols))[place] = coefficient
    if not rows:
        return {}
    directions = DomainMatrix.from_list_sympy(len(rows), len(symbols), list(rows.values())).to_field().nullspace()
    found: Centre = {}
    for direction in directions.rref()[0].to_Matrix().tolist():
        pivot = next((place for place, share in enumerate(direction) if share), None)
        if pivot is not None:
            for place, share in enumerate(direction):
                if share and place != pivot:
                    found[symbols[place]] = found.get(symbols[place], sp.S.Zero) + share * symbols[pivot]
    return found


def shifted(goal: Goal, centre: Centre) -> Goal:
    """The goal for symbols counted from their centre."""
    moved = {symbol: symbol + value for symbol, value in centre.items()}

    def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
        return tuple(Relation(sp.expand(evaluated(r.left).xreplace(moved)), r.operator,
                              sp.expand(evaluated(r.right).xreplace(moved))) for r in relations)

    return Goal(put(goal.show), put(goal.assume)) if centre else goal


def shifted_back(terms: list[Term], centre: Centre) -> list[Term]:
    """The terms in the symbols as they are stated."""
    names = {name_of(symbol): _from(symbol, value) for symbol, value in centre.items()}
    if not names:
        return terms
    pattern = re.compile(rf"\b({'|'.join(names)})\b")
    return [{"coefficient": term["coefficient"], "factors": [
        {key: pattern.sub(lambda found: names[found[1]], value) if key in TEXTS else value
         for key, value in item.items()} for item in term["factors"]]} for term in terms]


def _from(symbol: sp.Symbol, value: sp.Expr) -> str:
    if value.is_Rational:
        number = Fraction(int(value.p), int(value.q))
        return f"({name_of(symbol)} {'-' if number > 0 else '+'} {abs(number)})"
    return f"({name_of(symbol)} - ({text(value)}))"
