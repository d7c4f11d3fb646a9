"""Search unknowns, round them to simple rationals, and prove the conditions with these by exact squares."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from workbench.errors import InputError, SolverError, WorkbenchError
from workbench.gains.certificate import Proof, infeasible_certificate, proved_certificate
from workbench.gains.exact import Matrix, rational, simplest, squares_of
from workbench.gains.lmi import Answer, Refusal, inner_duals, interior, least
from workbench.gains.problem import Block, Exponents, Family, Poly, Problem, affine, families_of, states_of
from workbench.gains.scaled import Array, Scaled, scaled, size_of

TOLERANCES = tuple(10.0 ** (-n / 2) for n in range(2, 24))
FACE = 1e-5  # entries of a dual below this part of the largest are zero
SAME = 1e-9  # part of its largest coefficient by which two families that are all but equal differ
BACKOFF = 1e-4  # by how much of itself an optimal value is given up for an interior answer


class Infeasible(WorkbenchError):  # noqa: N818 - an answer of the search, not a fault
    """No values of the unknowns meet the conditions: names the families that contradict each other.

    shares: what part each family has in the contradiction; certificate: its exact proof, None where only the solver's
    numbers show it. Of polynomials beyond quadratic ones, and under `where`, it says that no values make them sums of
    squares, as a proof would need them; that some meet the conditions all the same is left open.
    """

    def __init__(self, problem: Problem, shares: dict[str, float], certificate: dict[str, Any] | None,
                 margin: float) -> None:
        self.shares, self.certificate, self.margin = shares, certificate, margin
        blamed = ", ".join(f"'{name}' ({share:.0%})" for name, share in shares.items())
        how = "by an exact certificate" if certificate else f"by the solver's numbers alone, margin {margin:.1e}"
        points = all(family.of_points for family in families_of(problem))
        none = "meet the conditions" if points else "make the conditions sums of squares (others may still meet them)"
        super().__init__(f"{problem.id}: no values of {', '.join(map(str, problem.unknowns)) or 'nothing'} {none}, "
                         f"shown {how}: {blamed} contradict: loosen one of them")


@dataclass(frozen=True)
class Found:
    """What a search found: exact values, the certificate that they meet the conditions, and how far the search got.

    objective: the exact value; bound: the solver's least value, which the exact one may exceed by the backoff.
    """

    problem: Problem
    values: dict[sp.Symbol, sp.Rational]
    certificate: dict[str, Any]
    objective: sp.Rational | None
    bound: float | None
    margin: float
    residual: float
    seconds: float


def search(problem: Problem, backoff: float = BACKOFF) -> Found:
    """Values of the unknowns under which every condition holds, with its proof; the best ones for an objective.

    Raises Infeasible, with the families at fault, where there are none; InputError for what is no such problem, and
    SolverError where the solver is not sure or no rounding of its answer can be proved.
    """
    started = time.perf_counter()
    families = families_of(problem)
    states = states_of(problem)
    scales = [problem.scales.get(s, Fraction(1)) for s in states]
    units = [problem.scales.get(u, Fraction(1)) for u in problem.unknowns]
    data = scaled(families, scales, units)
    answer, bound, goal = _numbers(problem, scaled(_distinct(data), scales, units), units, backoff)
    if isinstance(answer, Refusal):
        answer, bound, goal = _numbers(problem, data, units, backoff)
    if isinstance(answer, Refusal):
        raise _refused(problem, data, answer, scales)
    for tolerance in TOLERANCES:
        values = tuple(simplest(float(u) * float(unit), tolerance) for u, unit in zip(
            answer.unknowns, units, strict=False))
        if goal is not None and _value(goal[0], values) > goal[1]:
            continue
        _require_signs(problem, values)
        proofs = _proofs(families, values, answer, tolerance, scales)
        if proofs is not None:
            exact = {u: rational(v) for u, v in zip(problem.unknowns, values, strict=True)}
            certificate = proved_certificate(problem, exact, states, proofs)
            value = rational(_value(goal[0], values)) if goal else None
            return Found(problem, exact, certificate, value, bound, answer.margin, answer.residual,
                         time.perf_counter() - started)
    raise SolverError(f"{problem.id}: no rounding of clarabel's answer (margin {answer.margin:.1e}) can be proved: "
                      "rescale the problem (scales) or loosen a condition")


def confirm(problem: Problem, values: Mapping[sp.Symbol, Fraction] | None = None) -> dict[str, Any]:
    """The certificate that given values of the unknowns meet the conditions, by exact squares alone, without a solver.

    Raises SolverError naming the family that does not hold, or whose Gram matrix is not determined by its terms.
    """
    exact = tuple((values or {})[u] for u in problem.unknowns)
    proofs = []
    for family in families_of(problem):
        poly = {e: c for e, c in family.at(exact).items() if c}
        gram = _projected(family.blocks[0].basis, poly, None) if family.determined else None
        squares = squares_of(gram) if gram is not None else None
        if squares is None:
            raise SolverError(f"{problem.id}: {family.name}: is no sum of squares at the given values: correct them")
        proofs.append([(-1, pivot, dict(zip(family.blocks[0].basis, row, strict=True))) for pivot, row in squares])
    put = {u: rational(v) for u, v in zip(problem.unknowns, exact, strict=True)}
    return proved_certificate(problem, put, states_of(problem), proofs)


def largest(make: Callable[[Fraction], Problem], low: Fraction, high: Fraction,
            relative: float = 1e-3) -> tuple[Fraction, Found]:
    """The largest number in [low, high] for which the problem made of it has an answer, by bisection, with that answer.

    Raises Infeasible when there is none at `low`. The numbers tried have at most three digits more than needed.
    """
    best, found = low, search(make(low))
    while high - best > relative * abs(high):
        middle = simplest(float(best + high) / 2, relative / 4)
        if not best < middle < high:
            break
        try:
            best, found = middle, search(make(middle))
        except (Infeasible, SolverError):
            high = middle
    return best, found


def _distinct(data: Scaled) -> list[Family]:
    """The families without those that are all but equal to one before, which cost the solver its digits.

    Such come of an irrational number between two rationals. The proof is of all families.
    """
    kept: list[int] = []
    for k, (constant, slopes) in enumerate(data.rows):
        if not any(data.families[k].blocks == data.families[j].blocks and constant.shape == data.rows[j][0].shape
                   and np.allclose(constant, data.rows[j][0], rtol=0, atol=SAME)
                   and np.allclose(slopes, data.rows[j][1], rtol=0, atol=SAME) for j in kept):
            kept.append(k)
    return [data.families[k] for k in kept]


def _numbers(problem: Problem, data: Scaled, units: list[Fraction],
             backoff: float) -> tuple[Answer | Refusal, float | None, tuple[tuple[Fraction, ...], Fraction] | None]:
    """The solver's answer, the least objective, and (objective, most) that an exact answer must keep."""
    if problem.minimise is None:
        return interior(data), None, None
    first = interior(data)
    if isinstance(first, Refusal):
        return first, None, None
    goal = affine(problem, "minimise", problem.minimise)
    slope = np.array([float(c * unit) for c, unit in zip(goal[1:], units, strict=True)])
    size = max(1e-300, float(np.abs(slope).max(initial=0.0)))
    best = least(data, slope / size) * size
    room = backoff * max(abs(best), 1e-12)
    answer = interior(data, slope / size, (best + room) / size)
    if isinstance(answer, Refusal):
        answer = interior(data, slope / size, (best + 10 * room) / size)
        room = 10 * room
    return answer, best + float(goal[0]), (goal, goal[0] + Fraction(best + 2 * room))


def _require_signs(problem: Problem, values: tuple[Fraction, ...]) -> None:
    for unknown, value in zip(problem.unknowns, values, strict=True):
        if (unknown.is_positive and value <= 0) or (unknown.is_nonnegative and value < 0):
            sign = "positive" if unknown.is_positive else "nonnegative"
            raise InputError(problem.id, str(unknown), f"is declared {sign} and is {value} in what is found: state its "
                                                       "sign as a condition")


def _value(goal: tuple[Fraction, ...], values: tuple[Fraction, ...]) -> Fraction:
    return goal[0] + sum((c * v for c, v in zip(goal[1:], values, strict=True)), Fraction(0))


def _proofs(families: tuple[Family, ...], values: tuple[Fraction, ...], answer: Answer, tolerance: float,
            scales: list[Fraction]) -> list[Proof] | None:
    """Exact squares for each family, or None where one has none at this rounding."""
    proofs: list[Proof] = []
    for family in families:
        poly = {e: c for e, c in family.at(values).items() if c}
        grams = _exact_grams(family, poly, tolerance, scales)
        if grams is None:
            return None
        proof: Proof = []
        for block, gram in grams:
            squares = squares_of(gram)
            if squares is None:
                return None
            proof += [(block.number, pivot, dict(zip(block.basis, row, strict=True))) for pivot, row in squares]
        proofs.append(proof)
    return proofs


def _exact_grams(family: Family, poly: Poly, tolerance: float,
                 scales: list[Fraction]) -> list[tuple[Block, Matrix]] | None:
    """Rational Gram matrices that make the polynomial exactly; the solver chooses where there is a choice."""
    main, *others = family.blocks
    rest, found = dict(poly), []
    start: Matrix | None = None
    if not family.determined:
        fixed = Family(family.name, {e: (c,) for e, c in poly.items()}, family.blocks)
        data = scaled([fixed], scales, [])
        answer = interior(data)
        if isinstance(answer, Refusal):
            return None
        # Back from the solver's units: each basis monomial, each block and the family were divided by their sizes.
        top = max(abs(float(c)) * size_of(scales, e) for e, c in poly.items())
        back = [_unscaled(g, b, scales, top) for g, b in zip(answer.grams, family.blocks, strict=True)]
        start = _simple(back[0], tolerance)
        for block, numbers in zip(others, back[1:], strict=True):
            exact = _simple(numbers, tolerance)
            found.append((block, exact))
            for i, one in enumerate(block.basis):
                for j, two in enumerate(block.basis):
                    for e, weight in block.weight.items():
                        whole = tuple(map(sum, zip(one, two, e, strict=True)))
                        rest[whole] = rest.get(whole, Fraction(0)) - weight * exact[i][j]
    gram = _projected(main.basis, rest, start)
    return None if gram is None else [(main, gram), *found]


def _simple(rows: list[list[float]], tolerance: float) -> Matrix:
    return [[simplest(x, tolerance) if x else Fraction(0) for x in row] for row in rows]


def _unscaled(gram: Array, block: Block, scales: list[Fraction], top: float) -> list[list[float]]:
    """A Gram matrix in the problem's units, when the family was divided by `top` and the block by its largest entry."""
    sizes = [size_of(scales, e) for e in block.basis]
    largest_entry = max(abs(float(w)) * size_of(scales, e) for e, w in block.weight.items())
    return [[float(gram[i, j]) * top / largest_entry / a / b for j, b in enumerate(sizes)] for i, a in enumerate(sizes)]


def _projected(basis: tuple[Exponents, ...], poly: Poly, start: Matrix | None) -> Matrix | None:
    """The Gram matrix nearest to a start that makes the polynomial exactly; None where no product makes a term."""
    places: dict[Exponents, list[tuple[int, int]]] = {}
    for i, one in enumerate(basis):
        for j, two in enumerate(basis):
            places.setdefault(tuple(a + b for a, b in zip(one, two, strict=True)), []).append((i, j))
    if any(c and e not in places for e, c in poly.items()):
        return None
    gram = [row[:] for row in start] if start else [[Fraction(0)] * len(basis) for _ in basis]
    for e, entries in places.items():
        missing = poly.get(e, Fraction(0)) - sum((gram[i][j] for i, j in entries), Fraction(0))
        for i, j in entries:
            gram[i][j] += missing / len(entries)
    return gram


def _refused(problem: Problem, data: Scaled, refusal: Refusal, scales: list[Fraction]) -> WorkbenchError:
    """Infeasible with the families at fault; SolverError where the answer lies on the border of what holds."""
    if refusal.margin > -1e-6:
        return SolverError(f"{problem.id}: the conditions can be met on the border at best (margin "
                           f"{refusal.margin:.1e}): loosen one of them by a little")
    weights = {f.name: 0.0 for f in data.families}
    for dual, owner in zip(refusal.duals, data.owners, strict=True):
        weights[data.families[owner].name] += float(np.trace(dual))
    total = sum(weights.values()) or 1.0
    shares = {name: w / total for name, w in sorted(weights.items(), key=lambda x: -x[1]) if w > 1e-3 * total}
    certificate = None
    if all(f.determined and f.of_points for f in data.families):
        inner = inner_duals(data, refusal.margin)
        for duals in ([inner] if inner is not None else []) + [_on_a_face(refusal.duals)]:
            certificate = certificate or infeasible_certificate(problem, data, duals, scales)
    return Infeasible(problem, shares, certificate, refusal.margin)


def _on_a_face(duals: list[Array]) -> list[Array]:
    """The matrices without what is zero to the solver's precision, for a proof at the border of the cones."""
    top = max(float(np.abs(z).max(initial=0.0)) for z in duals)
    return [np.where(np.abs(z) < FACE * top, 0.0, z) for z in duals]
