"""Families of points on which chosen relations hold with equality: symbols expressed by others, exactly."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np
import sympy as sp

from workbench.proof.decide.landscape import Landscape, Numbers
from workbench.proof.decide.tape import Tape

MOST_TERMS = 60  # of an equation that is to be solved or factored
MOST_EQUALITIES = 4
EASY = 0.7  # share of equations solved for a symbol that may have any sign, where there is one

Solution = tuple[sp.Symbol, sp.Expr]


class Family:
    """Points by free symbols; the other symbols follow from them by rational expressions."""

    def __init__(self, symbols: Sequence[sp.Symbol]) -> None:
        self.symbols = list(symbols)
        self.bound: dict[sp.Symbol, sp.Expr] = {}
        self._compiled: tuple[list[sp.Symbol], Tape] | None = None

    @property
    def free(self) -> list[sp.Symbol]:
        """The symbols whose values may be chosen, with the parameters that equalities brought in."""
        extra = {s for e in self.bound.values() for s in e.free_symbols} - set(self.symbols)
        return [s for s in self.symbols if s not in self.bound] + sorted(extra, key=str)

    def hold(self, equation: sp.Expr, rng: random.Random) -> bool:
        """Add equation == 0, solved for a symbol; False when it cannot be solved or says nothing new."""
        solutions = solved(equation.xreplace(self.bound), self.symbols)
        if not solutions:
            return False
        easy = [(s, v) for s, v in solutions if not s.is_nonnegative]  # no sign that the value could miss
        symbol, value = rng.choice(easy if easy and rng.random() < EASY else solutions)
        return self.bind({symbol: value})

    def bind(self, put: dict[sp.Symbol, sp.Expr]) -> bool:
        """Let symbols follow from others; False, and nothing is done, where an expression has no value then."""
        bound = {s: e.xreplace(put) for s, e in self.bound.items()} | put
        if any(e.has(sp.nan, sp.zoo, sp.oo) for e in bound.values()):
            return False
        self.bound, self._compiled = bound, None
        return True

    def columns(self, chosen: dict[sp.Symbol, Numbers]) -> list[Numbers]:
        """Values of all symbols, in their order, from columns of the free ones."""
        count = len(next(iter(chosen.values()))) if chosen else 1
        free = list(chosen)
        if not self.bound:
            return [chosen[s] for s in self.symbols]
        if self._compiled is None or self._compiled[0] != free:
            self._compiled = free, Tape(free, list(self.bound.values()))
        with np.errstate(all="ignore"):
            values = self._compiled[1](*chosen.values())
        known = chosen | {s: np.broadcast_to(np.asarray(v, dtype=float), (count,))
                          for s, v in zip(self.bound, values, strict=True)}
        return [known[s] for s in self.symbols]

    def exact(self, chosen: dict[sp.Symbol, Fraction]) -> dict[str, Fraction] | None:
        """The point by name, or None when a bound symbol has no rational value there."""
        put = {s: sp.Rational(v.numerator, v.denominator) for s, v in chosen.items()}
        point = {str(s): v for s, v in chosen.items() if s in self.symbols}
        for symbol, expr in self.bound.items():
            value = expr.xreplace(put)
            if not value.is_Rational:
                return None
            point[str(symbol)] = Fraction(int(value.p), int(value.q))
        return point


def solved(equation: sp.Expr, symbols: Sequence[sp.Symbol]) -> list[Solution]:
    """(symbol, value) for every symbol in which a factor of the equation is linear."""
    numerator = sp.fraction(sp.together(equation))[0]
    if len(sp.Add.make_args(numerator)) > MOST_TERMS:
        return []
    factors = [numerator]
    if not numerator.is_Add or len(numerator.args) <= MOST_TERMS // 4:
        try:
            factors = [factor for factor, _ in sp.factor_list(numerator)[1]]
        except sp.PolynomialError:  # it is a number, though sympy did not see it
            return []
    found: list[Solution] = []
    for factor in factors:
        for symbol in symbols:
            if factor.has(symbol):
                slope = sp.expand(sp.diff(factor, symbol))
                if slope != 0 and not slope.has(symbol):
                    found.append((symbol, sp.together(-factor.xreplace({symbol: sp.Integer(0)}) / slope)))
    return found


def equations(landscape: Landscape) -> list[sp.Expr]:
    """What must vanish at every point: the goal's equality assumptions and initial values."""
    return ([symbol - value for symbol, value in landscape.start]
            + [margin for operator, margin in landscape.given if operator == "=="])


def borders(landscape: Landscape) -> list[sp.Expr]:
    """What may be made to vanish: margins, places where functions change or take rational values, coincidences."""
    weak = [margin for operator, margin in landscape.given if operator == ">=" and not margin.is_Symbol]
    shown = [margin for _, margin in landscape.shown if margin != 0]
    exprs = [margin for _, margin in (*landscape.given, *landscape.shown)]
    turning = []
    for expr in exprs:
        turning += [log.args[0] - 1 for log in expr.atoms(sp.log)]
        turning += [f.args[0] for f in expr.atoms(sp.exp, sp.Abs, sp.sign, sp.tanh)]
        turning += [f.args[0] - other for f in expr.atoms(sp.Max, sp.Min) for other in f.args[1:]]
    return [e for e in dict.fromkeys((*weak, *shown, *sorted(set(turning), key=sp.default_sort_key)))
            if not e.is_number]


def roots(landscape: Landscape) -> list[sp.Expr]:
    """Arguments of square roots made squares of a parameter, so that the roots are rational."""
    exprs = [margin for _, margin in (*landscape.given, *landscape.shown)]
    found = {p for e in exprs for p in e.atoms(sp.Pow) if p.exp.is_Rational and p.exp.q == 2}
    return [p.base - sp.Dummy(f"root_{i}", nonnegative=True) ** 2
            for i, p in enumerate(sorted(found, key=sp.default_sort_key)) if not p.base.is_number]


def families(landscape: Landscape, rng: random.Random, count: int) -> Iterator[Family]:
    """First the free family, then families on which one or several more relations are equalities."""
    needed, border, root = equations(landscape), borders(landscape), roots(landscape)
    seen: list[dict[sp.Symbol, sp.Expr]] = []
    for attempt in range(count):
        family = Family(landscape.symbols)
        for equation in needed if attempt == 0 else rng.sample(needed, len(needed)):
            family.hold(equation, rng)
        if root and (attempt % 2 or not border):
            for equation in root:
                family.hold(equation, rng)
        if attempt and border:
            for equation in rng.sample(border, min(len(border), rng.choice((1, 1, 2, 2, 3, MOST_EQUALITIES)))):
                family.hold(equation, rng)
        if family.bound not in seen:
            seen.append(family.bound)
            yield family
