"""The numerical search: a semidefinite program in cvxpy, solved by clarabel, its answer checked by our own residuals.

All families are asked for Gram matrices Q - t I >= 0 with the largest t <= 1. That program always has a solution: t > 0
is an interior answer, t < 0 a proof in floats that there is none, and the dual says which families contradict each
other.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import cvxpy as cp
import numpy as np

from workbench.errors import SolverError
from workbench.gains.problem import Family
from workbench.gains.scaled import Array, Scaled

RESIDUAL = 1e-6  # of equations and cones, in scaled units
BORDER = 1e-7  # an interior margin below this is none


@dataclass(frozen=True)
class Answer:
    """Unknowns in scaled units and Gram matrices, with what was checked of them.

    margin: t; residual: the largest violation of an equation or cone; objective: of the search, None without one.
    """

    unknowns: Array
    grams: list[Array]
    margin: float
    residual: float
    objective: float | None = None


@dataclass(frozen=True)
class Refusal:
    """Why there is no answer: t < 0, the dual's matrices for each block, and what was checked of them."""

    margin: float
    duals: list[Array]
    residual: float


def interior(data: Scaled, slope: Array | None = None, most: float | None = None) -> Answer | Refusal:
    """The answer farthest inside all cones; with slope u <= most besides. SolverError unless the solver is sure."""
    unknowns, grams, equations = _model(data)
    t = cp.Variable()
    cones = [gram - t * np.eye(n) >> 0 for gram, n in zip(grams, data.sizes, strict=True)]
    cap = [t <= 1] + ([slope @ unknowns <= most] if slope is not None and most is not None else [])
    status = _solve(cp.Problem(cp.Maximize(t), [*equations, *cones, *cap]))
    if status != "optimal":
        raise _unsure(status, data)
    if float(t.value) > BORDER:
        return _checked(data, unknowns, grams, float(t.value))
    duals = [_symmetric(np.asarray(cone.dual_value)) for cone in cones]
    residual = _dual_residual(data, duals)
    if residual > RESIDUAL * max(1.0, *(float(np.abs(z).max()) for z in duals)):
        raise SolverError(f"clarabel: says that there is no answer, but its dual leaves a residual of {residual:.1e}: "
                          "rescale the problem")
    return Refusal(float(t.value), duals, residual)


def least(data: Scaled, slope: Array) -> float:
    """The least value of slope u over all answers, borders included; SolverError unless the solver is sure of it."""
    unknowns, grams, equations = _model(data)
    objective = cp.Minimize(slope @ unknowns)
    status = _solve(cp.Problem(objective, [*equations, *(gram >> 0 for gram in grams)]))
    if status in ("unbounded", "unbounded_inaccurate"):
        raise SolverError("clarabel: the objective has no least value under these conditions: bound it by one more")
    if status != "optimal":
        raise _unsure(status, data)
    _checked(data, unknowns, grams, 0.0)
    return float(objective.value)


def inner_duals(data: Scaled, margin: float) -> list[Array] | None:
    """Matrices inside the cones that show that there is no answer, or None where there are only ones at the border."""
    duals = [cp.Variable((n, n), symmetric=True) for n in data.sizes]
    s = cp.Variable()
    moments, links = _moments(data, duals)
    constant = sum(c @ m for (c, _), m in zip(data.rows, moments, strict=True))
    slopes = sum(u.T @ m for (_, u), m in zip(data.rows, moments, strict=True))
    total = sum(cp.trace(z) for z in duals)
    where = [*links, total == 1, constant <= margin / 2, *(z - s * np.eye(n) >> 0 for z, n in zip(
        duals, data.sizes, strict=True))]
    if data.rows[0][1].shape[1]:
        where.append(slopes == 0)
    if _solve(cp.Problem(cp.Maximize(s), where)) != "optimal" or float(s.value) <= BORDER:
        return None
    return [_symmetric(np.asarray(z.value)) for z in duals]


def _moments(data: Scaled, duals: list[Any]) -> tuple[list[Any], list[Any]]:
    """Each family's multipliers of its coefficients, and the equations that tie them to the blocks' matrices."""
    moments = [cp.Variable(len(c)) for c, _ in data.rows]
    links = [m.T @ moments[k] == cp.vec(z, order="C") for m, k, z in zip(data.maps, data.owners, duals, strict=True)]
    return moments, links


def _model(data: Scaled) -> tuple[Any, list[Any], list[Any]]:
    """Unknowns, Gram matrices and the equations between them."""
    unknowns = cp.Variable(max(1, data.rows[0][1].shape[1]))
    grams = [cp.Variable((n, n), symmetric=True) for n in data.sizes]
    equations = []
    for place, (constant, slopes) in enumerate(data.rows):
        left = constant + (slopes @ unknowns if slopes.shape[1] else 0)
        right: Any = np.zeros(len(constant))
        for matrix, owner, gram in zip(data.maps, data.owners, grams, strict=True):
            if owner == place:
                right = right + matrix @ cp.vec(gram, order="C")
        equations.append(left == right)
    return unknowns, grams, equations


def _solve(problem: Any) -> str:
    """The status of clarabel, which counts only when it is 'optimal'; its warnings say the same."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            problem.solve(solver=cp.CLARABEL)
        except cp.SolverError as trouble:
            return f"failed ({' '.join(str(trouble).split())[:80]})"
    return str(problem.status)


def _checked(data: Scaled, unknowns: Any, grams: list[Any], margin: float) -> Answer:
    """The answer with its residuals computed from the numbers alone; SolverError where they are too large."""
    u = np.zeros(unknowns.size) if unknowns.value is None else np.asarray(unknowns.value)  # none enters any condition
    found = [_symmetric(np.asarray(g.value)) for g in grams]
    worst = 0.0
    for place, (constant, slopes) in enumerate(data.rows):
        gap = constant + (slopes @ u if slopes.shape[1] else 0)
        for matrix, owner, gram in zip(data.maps, data.owners, found, strict=True):
            if owner == place:
                gap = gap - matrix @ gram.ravel()
        worst = max(worst, float(np.abs(gap).max(initial=0.0)))
    scale = max(1.0, float(np.abs(u).max(initial=0.0)), *(float(np.abs(g).max()) for g in found))
    worst = max(worst, *(margin - float(np.linalg.eigvalsh(g)[0]) for g in found))
    if worst > RESIDUAL * scale:
        raise SolverError(f"clarabel: says 'optimal', but leaves a residual of {worst:.1e}: rescale the problem")
    return Answer(u, found, margin, worst)


def _dual_residual(data: Scaled, duals: list[Array]) -> float:
    """How far the dual's matrices are from the cones, and their families' multipliers from cancelling the unknowns."""
    worst = max(0.0, *(-float(np.linalg.eigvalsh(z)[0]) for z in duals))
    moments = moments_of(data, duals)
    if data.rows[0][1].shape[1]:
        left = sum(u.T @ m for (_, u), m in zip(data.rows, moments, strict=True))
        worst = max(worst, float(np.abs(left).max(initial=0.0)))
    return worst


def moments_of(data: Scaled, duals: list[Array]) -> list[Array]:
    """The multipliers of each family's coefficients that belong to the blocks' matrices, by least squares."""
    found = []
    for place, (constant, _) in enumerate(data.rows):
        own = [(m, z) for m, k, z in zip(data.maps, data.owners, duals, strict=True) if k == place]
        if not own:
            found.append(np.zeros(len(constant)))
            continue
        left = np.concatenate([m.T for m, _ in own])
        found.append(np.linalg.lstsq(left, np.concatenate([z.ravel() for _, z in own]), rcond=None)[0])
    return found


def _symmetric(matrix: Array) -> Array:
    return np.asarray((matrix + matrix.T) / 2)


def _unsure(status: str, data: Scaled) -> SolverError:
    if status == "infeasible":
        stuck = [f.name for f, (c, u) in zip(data.families, data.rows, strict=True)
                 if any(not np.abs(row).any() for row in _reach(data, f)) and (np.abs(c).any() or np.abs(u).any())]
        names = ", ".join(stuck or [f.name for f in data.families])
        return SolverError(f"clarabel: infeasible: {names}: has terms that no square can make, such as odd ones: "
                           "correct the inequality")
    return SolverError(f"clarabel: status '{status}', which is no answer: rescale the problem (scales) or loosen it")


def _reach(data: Scaled, family: Family) -> Array:
    """Which monomials of a family its blocks reach."""
    place = data.families.index(family)
    own = [m for m, k in zip(data.maps, data.owners, strict=True) if k == place]
    return np.concatenate(own, axis=1) if own else np.zeros((len(data.rows[place][0]), 1))
