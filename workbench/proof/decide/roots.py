"""Points that are not rational: one symbol lies where a polynomial, assumed to vanish, changes its sign."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice, product

import sympy as sp

from workbench.proof.claim import Goal, name_of
from workbench.proof.decide.once import once_per_goal
from workbench.proof.text import assumptions, relation_text
from workbench.proof.typed import evaluated

Point = dict[str, Fraction]
Root = dict[str, str]
NARROW = 40  # halvings of the interval in which the sign changes
MOST_CHOICES = 6
STEPS = (Fraction(1, 10**9), Fraction(1, 10**6), Fraction(1, 10**3), Fraction(1, 10))


@dataclass(frozen=True)
class _Equality:
    """An assumed equality: its margin, and the margin's terms where it is a polynomial with rational coefficients, each
    with the powers of symbols by name."""

    text: str
    margin: sp.Expr
    terms: list[tuple[Fraction, dict[str, int]]] | None

    def vanishes(self, point: Point, values: dict[sp.Expr, sp.Expr]) -> bool:
        """Whether it holds at a point."""
        if self.terms is None or any(name not in point for _, powers in self.terms for name in powers):
            return bool(self.margin.xreplace(values) == 0)
        return sum(_term(c, powers, point) for c, powers in self.terms) == 0

    def curve(self, symbol: sp.Expr, point: Point, values: dict[sp.Expr, sp.Expr]) -> list[Fraction]:
        """The margin as a polynomial of one symbol, the others having values, highest power first; nothing where it
        is none."""
        name = name_of(symbol)
        if self.terms is None or any(other not in point for _, powers in self.terms for other in powers):
            return _coefficients(self.margin, values, symbol)
        found: dict[int, Fraction] = {}
        for c, powers in self.terms:
            power = powers.get(name, 0)
            others = {other: n for other, n in powers.items() if other != name}
            found[power] = found.get(power, Fraction(0)) + _term(c, others, point)
        degree = max((power for power, c in found.items() if c), default=0)
        return [found.get(power, Fraction(0)) for power in range(degree, -1, -1)] if degree else []


@once_per_goal
def _equalities(goal: Goal) -> list[_Equality]:
    """What a goal assumes equal, read once for all points."""
    return [_Equality(relation_text(r), margin, _terms(margin))
            for r, margin in ((r, r.margin) for r in assumptions(goal) if r.operator == "==")]


def _terms(margin: sp.Expr) -> list[tuple[Fraction, dict[str, int]]] | None:
    symbols = sorted(margin.free_symbols, key=str)
    if not symbols or not margin.is_polynomial(*symbols):
        return None
    try:
        polynomial = sp.Poly(sp.expand(evaluated(margin)), *symbols, domain="QQ")
    except (sp.CoercionFailed, sp.PolynomialError):  # a root of a number stands in it
        return None
    names = [name_of(s) for s in symbols]
    return [(Fraction(int(c.p), int(c.q)), {name: n for name, n in zip(names, powers, strict=True) if n})
            for powers, c in polynomial.terms()]


def _term(coefficient: Fraction, powers: dict[str, int], point: Point) -> Fraction:
    for name, power in powers.items():
        coefficient *= point[name] ** power
    return coefficient


def roots_near(goal: Goal, point: Point) -> Iterator[tuple[Point, list[Root]]]:
    """Points and their roots: by a symbol each the equalities that fail at a point are made to hold; for every such
    choice of symbols, as far as there are not too many.

    Nothing where a symbol that would be moved stands in another equality, too.
    """
    values = {s: sp.Rational(*point[name_of(s)].as_integer_ratio()) for s in goal.symbols() if name_of(s) in point}
    equalities = _equalities(goal)
    choices: list[list[tuple[str, Fraction, Root]]] = []
    for equality in equalities:
        if equality.vanishes(point, values):
            continue
        others = {s for other in equalities if other is not equality for s in other.margin.free_symbols}
        choices.append([])
        for symbol in sorted(equality.margin.free_symbols - others, key=str):
            name, curve = name_of(symbol), equality.curve(symbol, point, values)
            ends = next((found for step in STEPS if (found := _change_of_sign(curve, point[name], step))), None)
            if ends is not None:
                root = {"of": name, "from": str(ends[0]), "to": str(ends[1]), "equality": equality.text}
                choices[-1].append((name, (ends[0] + ends[1]) / 2, root))
    for chosen in islice(product(*choices), MOST_CHOICES) if choices else ():
        yield point | {name: value for name, value, _ in chosen}, [root for *_, root in chosen]


def _coefficients(margin: sp.Expr, values: dict[sp.Expr, sp.Expr], symbol: sp.Expr) -> list[Fraction]:
    """The same of what is no polynomial until the others have values."""
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
