"""A sampled loop behind a delay and a lag, linearised, as a polytope of exact matrices over a box of parameters.

Plant and lag are integrated exactly between samples (zero-order hold); a delay is whole samples plus a part of one, so
that the last commands are states. The map of a sample is a polynomial in the parameters but for the exponential's tail;
the coefficients of a polynomial in Bernstein's basis span a hull that holds all of its values on the box (the basis is
positive there and adds up to one). What is left out, the tail and roundings, is bounded entry by entry.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from math import comb
from typing import Any

import sympy as sp
from sympy.polys.domains import QQ
from sympy.polys.rings import PolyElement, ring

from workbench.errors import InputError
from workbench.gains.exact import Matrix, fraction, rational
from workbench.gains.sampling import Order, Rates

Range = tuple[Fraction, Fraction]
Rows = list[list[Any]]  # of polynomials in the box's coordinates, each from 0 to 1

TAIL = Fraction(1, 10**16)
LEFT_OUT = Fraction(1, 10**11)  # what terms of a polynomial are at most that are counted as remainder
DIGITS = 13
MOST_TERMS, MOST_DELAY = 80, 100


@dataclass(frozen=True)
class SampledLoop:
    """A plant, a law and what lies between, to be looked at near one motion.

    plant: rates of its states, driven by `command_symbol`; command, estimates: the law; disturbances: symbols in these
    rates, each held over a sample, with the most that its root mean square comes to; at: the point of linearisation, by
    symbols of `box` where it is not fixed; output: what is to stay small. box: from where to where each of its symbols
    goes. order: as in `sampling`.
    """

    plant: Rates
    command_symbol: sp.Symbol
    disturbances: Mapping[sp.Symbol, Fraction]
    command: sp.Expr
    estimates: Rates
    output: sp.Expr
    at: Mapping[sp.Expr, sp.Expr]
    period_s: Fraction
    delay_s: Fraction = Fraction(0)
    lag_s: Fraction = Fraction(0)
    box: Mapping[sp.Symbol, Range] = field(default_factory=dict)
    order: Order = "corrected"


@dataclass(frozen=True)
class Polytope:
    """x+ = (A + R) x + (B + S) w, y = c x, with [A B] in the hull of `vertices`, one after the other at will.

    vertices: matrices of shape (states, states + disturbances), whose disturbances are in units of their sizes; output:
    c; remainder: of each entry the most that R and S come to.
    """

    vertices: tuple[Matrix, ...]
    output: tuple[Fraction, ...]
    remainder: Matrix

    @property
    def states(self) -> int:
        """How many there are."""
        return len(self.output)

    @property
    def disturbances(self) -> int:
        """How many there are."""
        return len(self.remainder[0]) - len(self.output)


def polytope(loop: SampledLoop) -> Polytope:
    """The polytope that holds the map of every sample for every point of the box.

    Raises InputError for a loop that is no polynomial in the box's symbols with exact numbers, for times that cannot
    be, and for a delay of more than MOST_DELAY samples.
    """
    period, delay, lag = loop.period_s, loop.delay_s, loop.lag_s
    if period <= 0 or delay < 0 or lag < 0 or delay > MOST_DELAY * period:
        raise InputError("", "period_s, delay_s, lag_s", f"{float(period):g}, {float(delay):g}, {float(lag):g}: a "
                         f"period is positive, a delay and a lag are not negative, a delay is at most {MOST_DELAY} "
                         "periods: correct them")
    box = dict(loop.box) or {sp.Dummy(): (Fraction(0), Fraction(0))}
    of = ring([f"t_{i}" for i in range(len(box))], QQ)[0]
    moving, learned = list(loop.plant), list(loop.estimates)

    def slopes(exprs: Sequence[sp.Expr], by: Sequence[sp.Expr]) -> Rows:
        return [[_polynomial(sp.diff(e, s).xreplace(dict(loop.at)), box, of) for s in by] for e in exprs]

    rates, steps = list(loop.plant.values()), [sp.sympify(e, strict=True) for e in loop.estimates.values()]
    pushes = list(loop.disturbances)
    sizes = [of(_q(size)) for size in loop.disturbances.values()]
    A, B = slopes(rates, moving), slopes(rates, [loop.command_symbol])
    E, J_w = ([[p * size for p, size in zip(row, sizes, strict=True)] for row in slopes(exprs, pushes)]
              for exprs in (rates, steps))
    K_x, K_e = slopes([loop.command], moving)[0], slopes([loop.command], learned)[0]
    J_x, J_e = slopes(steps, moving), slopes(steps, learned)
    n = len(moving)
    if lag:
        A = [[*row, drives] for row, (drives,) in zip(A, B, strict=True)] + [[of(0)] * n + [-of(1) / _q(lag)]]
        B, E = [[of(0)]] * n + [[of(1) / _q(lag)]], [*E, [of(0)] * len(pushes)]
        K_x, J_x = [*K_x, of(0)], [[*row, of(0)] for row in J_x]
        n += 1
    m = len(learned)
    held, parts = divmod(delay, period)
    past = int(held) + (1 if parts else 0)
    undisturbed = n + m + past
    width = undisturbed + len(pushes)
    phi, whole, push, tail = _integrated(A, B, E, period, of)
    _, late, _, late_tail = _integrated(A, B, E, period - parts, of)

    def row(entries: Mapping[int, Any]) -> list[Any]:
        return [entries.get(i, of(0)) for i in range(width)]

    def unit(place: int) -> list[Any]:
        return row({place: of(1)})

    def added(*scaled: tuple[Any, list[Any]]) -> list[Any]:
        return [sum((c * r[i] for c, r in scaled), of(0)) for i in range(width)]

    h = of(_q(period))
    moved = [added((of(1), unit(n + i)), *((h * j, unit(k)) for k, j in enumerate(J_x[i])),
                   *((h * j, unit(n + k)) for k, j in enumerate(J_e[i])),
                   *((h * j, unit(undisturbed + k)) for k, j in enumerate(J_w[i]))) for i in range(m)]
    answers = moved if loop.order == "corrected" else [unit(n + i) for i in range(m)]
    now = added(*((k, unit(i)) for i, k in enumerate(K_x)), *((k, r) for k, r in zip(K_e, answers, strict=True)))
    commands = [now, *(unit(n + m + i) for i in range(past))]  # of this sample, the one before, ...
    last, first = commands[int(held)], commands[min(int(held) + 1, past)]
    plant = [added(*((p, unit(i)) for i, p in enumerate(phi[k])), (late[k][0], last), (whole[k][0] - late[k][0], first),
                   *((p, unit(undisturbed + i)) for i, p in enumerate(push[k]))) for k in range(n)]
    rows = [*plant, *moved, *commands[:past]]
    off = [[tail * (1 + _most(first[j])) + late_tail * (_most(last[j]) + _most(first[j])) if k < n else Fraction(0)
            for j in range(width)] for k in range(len(rows))]
    c = [fraction(rational(_number(p))) for p in slopes([loop.output], moving)[0]]
    output = (*c, *[Fraction(0)] * (undisturbed - len(c)))
    vertices, remainder = _hull(rows, off, len(box))
    return Polytope(vertices, output, remainder)


def _q(value: Fraction) -> Any:
    return QQ(value.numerator, value.denominator)


def _polynomial(expr: sp.Expr, box: Mapping[sp.Symbol, Range], of: Any) -> PolyElement:
    """An expression in the box's coordinates, each from 0 to 1."""
    try:
        found = sp.Poly(expr, *box, domain=sp.QQ)
    except (sp.PolynomialError, sp.CoercionFailed):
        raise InputError("", "loop", f"'{expr}' is no polynomial in {', '.join(map(str, box))} with exact numbers: "
                         "give every other symbol a value in `at`") from None
    places = [of(_q(low)) + of(_q(high - low)) * g for (low, high), g in zip(box.values(), of.gens, strict=True)]
    total = of(0)
    for exponents, value in found.terms():
        term = of(QQ(value.p, value.q))
        for place, power in zip(places, exponents, strict=True):
            term = term * place**power if power else term  # a place may be zero, of which sympy takes no power 0
        total += term
    return total


def _number(polynomial: PolyElement) -> Fraction:
    """A polynomial that is a number; InputError for another."""
    if any(any(e) for e in polynomial):
        raise InputError("", "output", "changes over the box: take one with slopes that are numbers")
    return _of(polynomial.coeff(1))


def _of(value: Any) -> Fraction:
    return Fraction(int(value.numerator), int(value.denominator))


def _most(polynomial: PolyElement) -> Fraction:
    """What its size is at most for coordinates from 0 to 1."""
    return sum((abs(_of(c)) for c in polynomial.values()), Fraction(0))


def _integrated(A: Rows, B: Rows, E: Rows, time_s: Fraction, of: Any) -> tuple[Rows, Rows, Rows, Fraction]:
    """exp(A t), its integral times B and times E by Taylor's series, and what any entry of them is off at most."""
    n = len(A)
    full = n + 1 + len(E[0])
    step = [[entry * _q(time_s) for entry in (*A[i], B[i][0], *E[i])] for i in range(n)] + [[of(0)] * full] * (full - n)
    size = max(sum((_most(x) for x in row), Fraction(0)) for row in step)
    term = [[of(int(i == j)) for j in range(full)] for i in range(full)]
    total, rest = [row[:] for row in term], Fraction(1)
    for number in range(1, MOST_TERMS):
        term = [[sum((term[i][k] * step[k][j] for k in range(n) if term[i][k] and step[k][j]), of(0)) / number
                 for j in range(full)] for i in range(full)]
        total = [[a + b for a, b in zip(one, two, strict=True)] for one, two in zip(total, term, strict=True)]
        rest *= size / number
        following = size / (number + 1)
        if following < Fraction(1, 2) and 2 * rest * following <= TAIL:
            return ([row[:n] for row in total[:n]], [[row[n]] for row in total[:n]], [row[n + 1:] for row in total[:n]],
                    2 * rest * following)
    raise InputError("", "period_s", f"{float(time_s):g} is long for the rates of this plant, whose product with it is "
                     f"{float(size):.3g}: shorten the period, or lengthen the lag")


def _hull(rows: Rows, off: Matrix, coordinates: int) -> tuple[tuple[Matrix, ...], Matrix]:
    """The coefficients in Bernstein's basis, rounded, and what each entry is off at most with all that is left out."""
    kept: list[list[dict[Any, Fraction]]] = []
    remainder = [row[:] for row in off]
    for i, row in enumerate(rows):
        kept.append([])
        for j, entry in enumerate(row):
            terms = {e: _of(c) for e, c in entry.terms() if c}
            small = {e for e, c in terms.items() if any(e) and abs(c) < LEFT_OUT}
            remainder[i][j] += sum((abs(terms[e]) for e in small), Fraction(0))
            kept[-1].append({e: c for e, c in terms.items() if e not in small})
    degrees = [max((e[k] for row in kept for p in row for e in p), default=0) for k in range(coordinates)]
    vertices = []
    rounding = [[Fraction(0)] * len(rows[0]) for _ in rows]
    for place in product(*(range(d + 1) for d in degrees)):
        vertex: Matrix = []
        for i, polynomials in enumerate(kept):
            vertex.append([])
            for j, terms in enumerate(polynomials):
                exact = sum((c * _share(e, place, degrees) for e, c in terms.items()), Fraction(0))
                written = Fraction(f"{float(exact):.{DIGITS}g}")
                rounding[i][j] = max(rounding[i][j], abs(exact - written))
                vertex[-1].append(written)
        vertices.append(vertex)
    return tuple(vertices), [[a + b for a, b in zip(one, two, strict=True)]
                             for one, two in zip(remainder, rounding, strict=True)]


def _share(exponents: Sequence[int], place: Sequence[int], degrees: Sequence[int]) -> Fraction:
    """The coefficient of a monomial at a place of Bernstein's basis."""
    found = Fraction(1)
    for e, i, n in zip(exponents, place, degrees, strict=True):
        found *= Fraction(comb(i, e), comb(n, e)) if e <= i else 0
    return found
