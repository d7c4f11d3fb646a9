"""Polynomial Lyapunov functions and barriers of polynomial plants: searched as sums of squares, proved exactly.

Both have unknown coefficients, in which conditions for all states of a region are linear. A semidefinite program
proposes numbers, the smallest ones first, since many of them are zero then; they are rounded, coarsely first, and each
condition is handed to the deciders of the proofs. What counts is a certificate that `proof/checker.py` accepts.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement
from typing import Any

import cvxpy as cp
import numpy as np
import sympy as sp

from workbench.errors import InputError, SolverError
from workbench.gains.exact import rational
from workbench.gains.problem import Family, Problem, families_of, without_spare
from workbench.proof.claim import D, Goal, Relation, at_least, at_most
from workbench.proof.decide.engine import prove_goal

Flow = Mapping[sp.Symbol, sp.Expr]
DIGITS = (0, 1, 2, 3, 4)  # after the point, of coefficients
INSIDE = 1e-3  # an answer farther inside than this survives rounding
NOTHING = 1e-6  # below this part of the largest a coefficient is none


@dataclass(frozen=True)
class Certified:
    """A function of the states with exact coefficients, and a certificate for each of its conditions, by name."""

    function: sp.Expr
    certificates: dict[str, dict[str, Any]]


@dataclass(frozen=True)
class _Condition:
    """A relation wanted where bounds are not negative, and the polynomial that is then to be a sum of squares."""

    relation: Relation
    polynomial: sp.Expr
    bounds: tuple[sp.Expr, ...]


def lyapunov_function(name: str, flow: Flow, degree: int = 2, rate: Fraction = Fraction(0),
                      within: Sequence[sp.Expr] = ()) -> Certified:
    """V with V >= |x|^2 / 2, V(0) = 0 and V' <= -rate V, everywhere or where all of `within` are not negative.

    name: `<paper>:<name>`, as certificates are named; flow: a polynomial for each state, or a quotient with a
    denominator that is a sum of a positive number and even powers; degree: of V, even. Everywhere, V' <= 0 proves the
    origin stable and every motion bounded, rate > 0 that V decays exponentially. Raises InputError for what is no such
    problem, and SolverError where no V of that degree is found, or none that can be proved.
    """
    states = _states(name, flow)
    if degree < 2 or degree % 2:
        raise InputError(name, "degree", f"is {degree}: a Lyapunov function has an even degree of at least 2")
    V, unknowns = _polynomial("v", states, range(2, degree + 1))
    least = sp.Add(*(s**2 for s in states))
    decay = _cleared(name, flow, -_rate_of(V, flow) - rational(rate) * V)
    return _certified(name, V, unknowns, flow, {
        "positive": _Condition(at_least(V, least / 2), sp.expand(V - least), tuple(within)),
        "decay": _Condition(at_most(D(V), -rational(rate) * V), decay, tuple(within))})


def barrier_function(name: str, flow: Flow, initial: Sequence[sp.Expr], unsafe: Sequence[sp.Expr],
                     degree: int = 2, rate: Fraction = Fraction(0), within: Sequence[sp.Expr] = ()) -> Certified:
    """B <= 0 where all of `initial` are not negative, B >= 1 where all of `unsafe` are, and B' <= rate B.

    So no motion from the initial set meets the unsafe one as long as it stays where `within` are not negative: B is
    never positive along it. degree: of B. Otherwise as `lyapunov_function`.
    """
    states = _states(name, flow)
    B, unknowns = _polynomial("b", states, range(degree + 1))
    decay = _cleared(name, flow, rational(rate) * B - _rate_of(B, flow))
    return _certified(name, B, unknowns, flow, {
        "initial": _Condition(at_most(B, 0), -B, tuple(initial)),
        "unsafe": _Condition(at_least(B, 1), B - 1, tuple(unsafe)),
        "decay": _Condition(at_most(D(B), rational(rate) * B), decay, tuple(within))})


def _certified(name: str, function: sp.Expr, unknowns: list[sp.Symbol], flow: Flow,
               conditions: dict[str, _Condition]) -> Certified:
    tried: set[tuple[sp.Rational, ...]] = set()
    missing = ""
    families = [without_spare(family) for part, condition in conditions.items() for family in families_of(Problem(
        name, tuple(unknowns), {part: at_least(condition.polynomial, 0)},
        where=tuple(at_least(g, 0) for g in condition.bounds)))]
    bound = _bound(families, len(unknowns))
    for numbers in _proposals(len(unknowns), families):
        top = float(np.abs(numbers).max())
        kept = np.where(np.abs(numbers) < NOTHING * top, 0.0, numbers)
        for digits in DIGITS:
            values = _rounded(kept, digits, *bound)
            if values in tried or not any(values):
                continue
            tried.add(values)
            put = dict(zip(unknowns, values, strict=True))
            found: dict[str, dict[str, Any]] = {}
            for part, condition in conditions.items():
                goal = Goal((condition.relation.subs(put),), tuple(at_least(g, 0) for g in condition.bounds),
                            flow=dict(flow) if part == "decay" else {})
                proof = prove_goal(goal) if _seems_true(condition, put) else None
                if proof is None:
                    missing = part
                    break
                found[part] = {"claim": f"{name}.{part}", **proof}
            if len(found) == len(conditions):
                return Certified(sp.expand(function.xreplace(put)), found)
    if spare := {u for u, number in zip(unknowns, kept, strict=True) if not number} if tried else set():
        # Without them fewer monomials are needed, and more is seen to cancel.
        nothing = dict.fromkeys(spare, sp.S.Zero)
        return _certified(name, function.xreplace(nothing), [u for u in unknowns if u not in spare], flow, {
            part: _Condition(Relation(one.relation.left.xreplace(nothing), one.relation.operator,
                                      one.relation.right.xreplace(nothing)),
                             one.polynomial.xreplace(nothing), one.bounds) for part, one in conditions.items()})
    raise SolverError(f"{name}: no function of this degree is found" + (
        f" whose condition '{missing}' can be proved" if missing else "") + ": raise its degree or shrink its region")


def _seems_true(condition: _Condition, put: dict[sp.Symbol, sp.Rational]) -> bool:
    """Whether no random point of the region breaks the condition clearly: a search of a proof costs more."""
    polynomial = condition.polynomial.xreplace(put)
    symbols = sorted(polynomial.free_symbols | {s for g in condition.bounds for s in g.free_symbols}, key=str)
    if not symbols:
        return bool(polynomial >= 0)
    rng = np.random.default_rng(1)
    points = rng.normal(size=(len(symbols), 4_000)) * 10 ** rng.uniform(-2, 1, 4_000)
    inside = np.ones(4_000, dtype=bool)
    for bound in condition.bounds:
        inside &= sp.lambdify(symbols, bound, "numpy")(*points) >= 0
    values = sp.lambdify(symbols, polynomial, "numpy")(*points) + 0 * points[0]
    return not np.any(values[inside] < -1e-9 * (1 + np.abs(values[inside])))


def _bound(families: list[Family], count: int) -> tuple[sp.Matrix, tuple[int, ...]]:
    """Equations of the unknowns in reduced echelon form, the constant last, and their pivots.

    A term that no square makes must vanish: rounded one by one, unknowns that cancel each other would not.
    """
    rows = []
    for family in families:
        made = {tuple(map(sum, zip(one, two, e, strict=True)))
                for block in family.blocks for one in block.basis for two in block.basis for e in block.weight}
        rows += [[*slopes, -constant] for e, (constant, *slopes) in family.terms.items() if e not in made]
    exact = [[rational(entry) for entry in row] for row in rows]
    reduced, pivots = sp.Matrix(len(exact), count + 1, [entry for row in exact for entry in row]).rref()
    return reduced, tuple(int(pivot) for pivot in pivots)


def _rounded(numbers: np.ndarray, digits: int, reduced: sp.Matrix, pivots: tuple[int, ...]) -> tuple[sp.Rational, ...]:
    """The numbers to so many digits, those that equations bind from the others."""
    values = [sp.Rational(round(float(u) * 10**digits), 10**digits) for u in numbers]
    for row, pivot in enumerate(pivots):
        if pivot < len(values):
            values[pivot] = reduced[row, len(values)] - sum(
                (reduced[row, k] * values[k] for k in range(pivot + 1, len(values)) if k not in pivots), sp.S.Zero)
    return tuple(values)


def _proposals(count: int, families: list[Family]) -> Iterator[np.ndarray]:
    """Numbers for the unknowns: those farthest inside of all cones where that is far, and the least ones."""
    u, room = cp.Variable(count), cp.Variable()
    constraints = [row for family in families for row in _squares(family, u, room)]
    found: list[tuple[float, np.ndarray]] = []
    for objective, bounds in ((cp.Maximize(room - cp.norm1(u) / 1000), [room <= 1, room >= 0]),
                              (cp.Minimize(cp.norm1(u)), [room == 0])):
        problem = cp.Problem(objective, [*constraints, *bounds])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of an answer that is not accurate: rounding and the proof judge it
            try:
                problem.solve(solver=cp.CLARABEL)
            except cp.SolverError:
                continue
        if u.value is not None and np.isfinite(u.value).all():
            found.append((float(room.value), np.asarray(u.value)))
    yield from (numbers for _, numbers in sorted(found, key=lambda one: one[0] < INSIDE and one[0] > 0))


def _squares(family: Family, u: cp.Variable, room: cp.Variable) -> Iterator[Any]:
    """That a condition is a sum of squares, weighted by what bounds its region: equations and cones."""
    made: dict[tuple[int, ...], list[Any]] = {}
    for block in family.blocks:
        size = len(block.basis)
        if not size:
            continue
        gram = cp.Variable((size, size), symmetric=True)
        yield gram - room * np.eye(size) >> 0
        for i, one in enumerate(block.basis):
            for j, two in enumerate(block.basis):
                for e, weight in block.weight.items():
                    whole = tuple(map(sum, zip(one, two, e, strict=True)))
                    made.setdefault(whole, []).append(float(weight) * gram[i, j])
    for exponents in {*family.terms, *made}:
        constant, *slopes = family.terms.get(exponents, (Fraction(0),) * (u.size + 1))
        yield float(constant) + np.array([float(s) for s in slopes]) @ u == sum(made.get(exponents, [0.0]))


def _states(name: str, flow: Flow) -> tuple[sp.Symbol, ...]:
    states = tuple(flow)
    for state, rate in flow.items():
        if unknown := sp.sympify(rate, strict=True).free_symbols - set(states):
            raise InputError(name, str(state), f"its rate mentions {min(map(str, unknown))}, which is no state")
    return states


def _polynomial(letter: str, states: tuple[sp.Symbol, ...], degrees: range) -> tuple[sp.Expr, list[sp.Symbol]]:
    """A polynomial with an unknown for each monomial of these degrees, and the unknowns."""
    monomials = [sp.Mul(*some) for k in degrees for some in combinations_with_replacement(states, k)]
    unknowns = [sp.Symbol(f"{letter}_{place}", real=True) for place in range(len(monomials))]
    return sp.Add(*(u * m for u, m in zip(unknowns, monomials, strict=True))), unknowns


def _rate_of(function: sp.Expr, flow: Flow) -> sp.Expr:
    return sp.Add(*(sp.diff(function, state) * rate for state, rate in flow.items()))


def _cleared(name: str, flow: Flow, expr: sp.Expr) -> sp.Expr:
    """The expression times a denominator that is positive, so that it is a polynomial."""
    below = sp.Integer(1)
    for rate in flow.values():
        below = sp.lcm(below, sp.fraction(sp.together(sp.sympify(rate, strict=True)))[1])
    if below.free_symbols:
        terms = sp.Poly(below, *sorted(below.free_symbols, key=str)).terms()
        if not all(c > 0 and all(n % 2 == 0 for n in e) for e, c in terms) or all(any(e) for e, _ in terms):
            raise InputError(name, "flow", f"divides by {below}, which is not seen to be positive")
    return sp.expand(sp.cancel(sp.expand(expr * below))) if below.free_symbols else sp.expand(expr)
