"""The linear plants that the linearisation of a plant at a point of rest may be: a polytope over known intervals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import sympy as sp

from workbench.errors import InputError
from workbench.gains.enclosure import Interval, enclosed, stated_number
from workbench.gains.exact import fraction, rational
from workbench.gains.point import at_point
from workbench.systems.derivatives import smooth_at
from workbench.systems.plant import Plant

MOST_UNCERTAIN = 6  # entries, or terms, that differ among the plants; each doubles the number of extreme plants
AT_REST = Fraction(1, 10**6)  # what a rate is at most at a point of rest that is given by decimals


@dataclass(frozen=True)
class LinearPlants:
    """x' = A x + B u, every (A, B) between the extreme pairs: exact matrices; states and inputs as the plant's are."""

    states: tuple[str, ...]
    inputs: tuple[str, ...]
    extremes: tuple[tuple[sp.Matrix, sp.Matrix], ...]


def linearised(plant: Plant, at: Mapping[str, Any] | None = None) -> LinearPlants:
    """The hull of the linearisations at a point, parameters in their known intervals or at their values.

    at: the point, by `at_point`, zero where none is given; disturbances are zero. Each uncertain entry is bounded by
    itself, or, where these are fewer, each uncertain term that entries share, such as 1/J: the hull may hold more
    plants than there are. Raises InputError where the point is no equilibrium for some of the parameters, an entry has
    a kink there or no finite bounds, or too many of both differ.
    """
    if plant.updates:
        raise InputError(plant.id, "updates", "make it a plant in discrete time, for which no gains are searched: give "
                         "rates")
    point, box = _known(plant, at, plant.inputs)
    for state, rate in plant.flow.items():
        low, high = _bounds(plant, rate, point, box)
        if not -AT_REST <= low <= high <= AT_REST:
            raise InputError(plant.id, str(state), f"moves by {float(low):.3g} to {float(high):.3g} at that point: "
                             "give an equilibrium for all values of the parameters, its inputs too")
    rates = sp.Matrix(plant.rates)
    parts = [rates.jacobian(plant.states), rates.jacobian(plant.inputs)] if plant.inputs else []
    if not parts:
        raise InputError(plant.id, "inputs", "there is none: a feedback needs at least one")
    entries = [[_bounds(plant, entry, point, box) for entry in part] for part in parts]
    wide = [(k, i) for k, part in enumerate(entries) for i, (low, high) in enumerate(part) if low < high]
    shared = _shared_terms(plant, parts, point, box)
    if shared is not None and len(shared.terms) < len(wide) and len(shared.terms) <= MOST_UNCERTAIN:
        return LinearPlants(tuple(map(str, plant.states)), tuple(map(str, plant.inputs)), tuple(shared.extremes()))
    if len(wide) > MOST_UNCERTAIN:
        raise InputError(plant.id, "", f"{len(wide)} entries of its linearisation are uncertain, more than "
                         f"{MOST_UNCERTAIN}: say of fewer parameters that they are known in an interval only")
    extremes = []
    for sides in product((0, 1), repeat=len(wide)):
        side = dict(zip(wide, sides, strict=True))
        A, B = (sp.Matrix(part.rows, part.cols, [rational(pair[side.get((k, i), 0)])
                                                 for i, pair in enumerate(entries[k])]) for k, part in enumerate(parts))
        extremes.append((A, B))
    return LinearPlants(tuple(map(str, plant.states)), tuple(map(str, plant.inputs)), tuple(extremes))


@dataclass(frozen=True)
class _SharedTerms:
    """Matrices whose entries are sums of constants times terms, and the interval of each term."""

    parts: tuple[sp.Matrix, ...]
    terms: dict[sp.Symbol, Interval]

    def extremes(self) -> Iterator[tuple[sp.Matrix, sp.Matrix]]:
        """The pairs at the corners of the terms' intervals: every pair is between them, being affine in the terms."""
        for corner in product(*self.terms.values()):
            A, B = (part.xreplace(dict(zip(self.terms, map(rational, corner), strict=True))) for part in self.parts)
            yield A, B


def _shared_terms(plant: Plant, parts: Sequence[sp.Matrix], point: Mapping[sp.Basic, sp.Expr],
                  box: Mapping[sp.Symbol, Interval]) -> _SharedTerms | None:
    """The entries at a point by the terms of uncertain parameters; None where a constant before one is irrational."""
    names: dict[sp.Expr, sp.Symbol] = {}
    intervals: dict[sp.Symbol, Interval] = {}
    found = []
    for part in parts:
        entries = []
        for entry in part:
            total: sp.Expr = sp.Integer(0)
            for term in sp.Add.make_args(sp.expand(smooth_at(entry, point))):
                constant, varying = term.as_independent(*box, as_Add=False)
                if not (constant.is_Rational or constant.is_Float):
                    return None
                if constant == 0:
                    continue
                if varying != 1 and varying not in names:
                    names[varying] = sp.Dummy()
                    intervals[names[varying]] = _bounds(plant, varying, {}, box)
                total += rational(stated_number(constant) if constant.is_Float else fraction(constant)) * names.get(
                    varying, sp.Integer(1))
            entries.append(total)
        found.append(sp.Matrix(part.rows, part.cols, entries))
    return _SharedTerms(tuple(found), intervals)


def _known(plant: Plant, at: Mapping[str, Any] | None,
           inputs: Sequence[sp.Symbol]) -> tuple[dict[sp.Basic, sp.Expr], dict[sp.Symbol, Interval]]:
    """The point with the parameters that have one value, and the intervals of the others; disturbances are zero."""
    stated = at_point(plant, at)
    point: dict[sp.Basic, sp.Expr] = {s: stated.get(str(s), sp.Integer(0)) for s in (*plant.states, *inputs)}
    point |= {symbol: sp.Integer(0) for symbol in plant.disturbances}
    box: dict[sp.Symbol, Interval] = {}
    for one in plant.parameters:
        if one.known is None:
            point[one.symbol] = rational(stated_number(one.value))
        else:
            box[one.symbol] = (stated_number(one.known[0]), stated_number(one.known[1]))
    return point, box


def output_matrix(plant: Plant, at: Mapping[str, Any] | None = None) -> sp.Matrix:
    """C of y = C x about a point, exact; InputError where an entry depends on a parameter that is not known exactly."""
    point, box = _known(plant, at, ())
    return _exact(plant, plant.outputs, plant.states, point, box)


def disturbance_matrix(plant: Plant, at: Mapping[str, Any] | None = None) -> sp.Matrix:
    """E of x' = A x + B u + E w about a point, as `output_matrix`."""
    point, box = _known(plant, at, plant.inputs)
    return _exact(plant, plant.flow, plant.disturbances, point, box)


def _exact(plant: Plant, rows: Mapping[Any, sp.Expr], by: Sequence[sp.Symbol], point: Mapping[sp.Basic, sp.Expr],
           box: Mapping[sp.Symbol, Interval]) -> sp.Matrix:
    """The derivatives of rows by symbols; InputError for one that is not the same for all parameters in the box."""
    found = sp.Matrix([*rows.values()]).jacobian(by)
    for (i, symbol), j in product(enumerate(rows), range(found.cols)):
        low, high = _bounds(plant, found[i, j], point, box)
        if low < high:
            raise InputError(plant.id, str(symbol), f"depends on {by[j]} by a factor that is not known exactly: give "
                             "its parameters without an interval, or another symbol")
        found[i, j] = rational(low)
    return found


def _bounds(plant: Plant, entry: sp.Expr, point: Mapping[sp.Basic, sp.Expr],
            box: Mapping[sp.Symbol, Interval]) -> Interval:
    """Bounds of an expression at the point, none where it has no derivative there."""
    try:
        here = smooth_at(entry, point)
    except ValueError as trouble:
        raise InputError(plant.id, "", str(trouble)) from None
    try:
        return enclosed(here, box)
    except ValueError as trouble:
        raise InputError(plant.id, "", f"{entry} has no bounds at that point for the parameters' known intervals "
                         f"({trouble}): narrow these") from None
