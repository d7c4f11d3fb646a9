"""Points that are not rational: one symbol lies where a polynomial, assumed to vanish, changes its sign."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice, product

import sympy as sp

from workbench.proof.claim import Goal, name_of
from workbench.proof.text import assumptions, relation_text

Point = dict[str, Fraction]
Root = dict[str, str]
NARROW = 40  # halvings of the interval in which the sign changes
MOST_CHOICES = 6
STEPS = (Fraction(1, 10**9), Fraction(1, 10**6), Fraction(1, 10**3), Fraction(1, 10))


def roots_near(goal: Goal, point: Point) -> Iterator[tuple[Point, list[Root]]]:
    """Points and their roots: by a symbol each the equalities that fail at a point are made to hold; for every such
    choice of symbols, as far as there are not too many.

    Nothing where a symbol that would be moved stands in another equality, too.
    """
    values = {s: sp.Rational(*point[name_of(s)].as_integer_ratio()) for s in goal.symbols() if name_of(s) in point}
    equalities = [(r, r.margin) for r in assumptions(goal) if r.operator == "=="]
    choices: list[list[tuple[str, Fraction, Root]]] = []
    for relation, margin in equalities:
        if margin.xreplace(values) == 0:
            continue
        others = {s for _, other in equalities if other is not margin for s in other.free_symbols}
        choices.append([])
        for symbol in sorted(margin.free_symbols - others, key=str):
            name, curve = name_of(symbol), _coefficients(margin, values, symbol)
            ends = next((found for step in STEPS if (found := _change_of_sign(curve, point[name], step))), None)
            if ends is not None:
                root = {"of": name, "from": str(ends[0]), "to": str(ends[1]), "equality": relation_text(relation)}
                choices[-1].append((name, (ends[0] + ends[1]) / 2, root))
    for chosen in islice(product(*choices), MOST_CHOICES) if choices else ():
        yield point | {name: value for name, value, _ in chosen}, [root for *_, root in chosen]


def _coefficients(margin: sp.Expr, values: dict[sp.Expr, sp.Expr], symbol: sp.Expr) -> list[Fraction]:
    """A polynomial of one symbol, the others having values, highest power first; nothing where it is none."""
    curve = sp.expand(margin.xreplace({s: v for s, v in values.items() if s != symbol}))
    if not curve.is_polynomial(symbol) or curve.free_symbols != {symbol}:
        return []
    numbers = sp.Poly(curve, symbol).all_coeffs()
    return [Fraction(int(c.p), int(c.q)) for c in numbers] if all(c.is_Rational for c in numbers) else []


def _change_of_sign(curve: list[Fraction], near: Fraction, step: Fraction) -> tuple[Fraction, Fraction] | None:
    """Two numbers close together, no farther than a step from a given one, between which a polynomial changes sign."""
    reach = step * max(Fraction(1), abs(near))
    low, high = near - reach, near + reach
    at_low = _value(curve, low)
    if at_low * _value(curve, high) >= 0:
        return None
    for _ in range(NARROW):
        middle = (low + high) / 2
        value = _value(curve, middle)
        if value == 0:  # it stays inside
            break
        low, high = (middle, high) if value * at_low > 0 else (low, middle)
    return low, high


def _value(coefficients: list[Fraction], at: Fraction) -> Fraction:
    total = Fraction(0)
    for c in coefficients:
        total = total * at + c
    return total
