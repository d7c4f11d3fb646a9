"""Semidefinite programs of Gram matrices in floating point: a centre, a lean solution, a refined singular one.

They are given to clarabel directly: importing it costs a millisecond where cvxpy costs 0.4 s, and programs of this
size are solved in less time than cvxpy needs to state them. One thread keeps answers the same from run to run.
Whatever comes from here is a guess that `rounding.py` makes exact.
"""

from __future__ import annotations

from typing import Any

import clarabel
import numpy as np
from scipy.linalg.lapack import dpstrf
from scipy.sparse import csc_array, csr_array, hstack, vstack

from workbench.proof.decide.gram import Program

RESIDUAL, REFINED = 1e-5, 1e-9
ROUGH, FINE, NEARLY = 1e-8, 1e-11, 1e-6
MOST_STEPS = 20

Vector = np.ndarray


def _matrix(program: Program) -> csr_array:
    """The linear equations, of shape (monomials, unknowns)."""
    entries = [(program.rows[e], column, float(c)) for column, value in enumerate(program.columns)
               for e, c in value.terms()]
    rows, columns, values = zip(*entries, strict=True) if entries else ((), (), ())
    return csr_array((values, (rows, columns)), shape=(len(program.rows), len(program.columns)))


def _right(program: Program) -> Vector:
    right = np.zeros(len(program.rows))
    for e, c in program.target.terms():
        right[program.rows[e]] = float(c)
    return right


def centre(program: Program) -> tuple[Vector | None, float]:
    """Unknowns with the smallest eigenvalue as large as it can be, at most 1, and that eigenvalue; None if none.

    Only where that is nearly zero are they as accurate as can be: the last digits differ from machine to machine.
    """
    cost = np.append(np.zeros(len(program.columns)), -1.0)
    for tolerance in (ROUGH, FINE):
        values, scale = _optimum(program, cost, clarabel.NonnegativeConeT(1), 1.0, tolerance)
        if values is None:
            return None, 0.0
        margin = min((float(np.linalg.eigvalsh(q)[0]) for q in grams(program, values)), default=1.0)
        if abs(margin) > NEARLY or tolerance == FINE:
            return values * scale, margin
    return None, 0.0


def lean(program: Program) -> Vector | None:
    """Unknowns with Gram matrices of small trace, so that what can be done without is nearly zero; None if none."""
    cost = [1.0 + len(program.blocks[k].weight.items) if k >= 0 and i == j else 0.0 for k, i, j in program.places]
    values, scale = _optimum(program, np.array([*cost, 0.0]), clarabel.ZeroConeT(1), 0.0, ROUGH)
    return None if values is None else values * scale


def _optimum(program: Program, cost: Vector, cone: Any, bound: float,
             tolerance: float) -> tuple[Vector | None, float]:
    """The unknowns of least cost, and a factor they lack.

    The last cost is that of a number t: the Gram matrices are at least t times the identity, bound - t is in the cone.
    The solver's status is not believed: an inaccurate answer may do, an accurate one may not. So the equations are
    checked here, and everything else by whoever rounds the answer.
    """
    if not program.columns:
        return None, 1.0
    count, matrix, right = len(program.columns), _matrix(program), _right(program)
    scale = max(1e-300, float(np.abs(right).max(initial=0.0)))
    right = right / scale
    at = {place: column for column, place in enumerate(program.places)}
    entries: list[tuple[int, int, float]] = []
    height = 0
    for k, block in enumerate(program.blocks):
        for j in range(len(block.basis)):
            for i in range(j + 1):
                entries.append((height, at[k, i, j], -1.0 if i == j else -(2.0**0.5)))
                entries += [(height, count, 1.0)] if i == j else []
                height += 1
    entries.append((height, count, 1.0))
    rows, columns, numbers = zip(*entries, strict=True)
    below = csr_array((numbers, (rows, columns)), shape=(height + 1, count + 1))
    above = hstack([matrix, csr_array((len(right), 1))], format="csr")
    cones = [*(clarabel.PSDTriangleConeT(len(block.basis)) for block in program.blocks), cone]
    # Equations that follow from others stop the solver; in monomials they are rare.
    plain = all(len(b) == 1 for block in program.blocks for b in block.basis)
    for independent in (False, True) if plain else (True,):
        kept = _independent(matrix) if independent else np.arange(len(right))
        bounds = np.concatenate([right[kept], np.zeros(height), [bound]])
        values = _answer(vstack([above[kept], below]), bounds, cost, [clarabel.ZeroConeT(len(kept)), *cones],
                         tolerance)
        if values is not None and np.abs(matrix @ values - right).max(initial=0.0) <= RESIDUAL:
            return values, scale
    return None, scale


def _answer(matrix: csr_array, bounds: Vector, cost: Vector, cones: list[Any], tolerance: float) -> Vector | None:
    """What clarabel answers, whatever it thinks of it, without the last unknown; None when it is no number."""
    settings = clarabel.DefaultSettings()
    settings.verbose, settings.max_threads, settings.direct_solve_method, settings.max_iter = False, 1, "qdldl", 100
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
    nothing = csc_array((len(cost), len(cost)))
    answer = clarabel.DefaultSolver(nothing, cost, matrix.tocsc(), bounds, cones, settings).solve()
    values = np.array(answer.x[:-1])
    return values if np.all(np.isfinite(values)) else None


def _independent(matrix: csr_array) -> Vector:
    """Rows that span all rows, ascending."""
    _, order, rank, _ = dpstrf((matrix @ matrix.T).toarray(), tol=1e-11 * float(np.abs(matrix.data).max()) ** 2)
    return np.sort(order[:rank] - 1)


def grams(program: Program, values: Vector) -> list[Vector]:
    """The Gram matrices of the unknowns, one of shape (n, n) for each block."""
    found = [np.zeros((len(b.basis), len(b.basis))) for b in program.blocks]
    for (k, i, j), value in zip(program.places, values, strict=True):
        if k >= 0:
            found[k][i, j] = found[k][j, i] = value
    return found


def refined(program: Program, multiples: Vector, factors: list[Vector]) -> list[Vector] | None:
    """Factors L of shape (n, rank) with Gram matrices L L^T that solve the equations to rounding, by Gauss-Newton."""
    matrix, right = _matrix(program), _right(program)
    free = len(multiples)
    scale = max(1e-300, float(np.abs(right).max(initial=0.0)))
    multiples, factors = multiples / scale, [f / scale**0.5 for f in factors]
    offsets = np.cumsum([free, *(f.size for f in factors)])
    before = np.inf
    for _ in range(MOST_STEPS):
        unknowns, slope = _products(program, multiples, factors, offsets)
        error = right / scale - matrix @ unknowns
        size = float(np.abs(error).max(initial=0.0))
        if size < 1e-15 or not size < before * 0.9:
            break
        before = size
        # The shortest step, by the equations among the rows: few, while the factors' entries are many.
        jacobian = matrix @ slope
        eigenvalues, vectors = np.linalg.eigh(jacobian @ jacobian.T)
        kept = eigenvalues > 1e-12 * eigenvalues[-1]
        step = jacobian.T @ (vectors[:, kept] @ ((vectors[:, kept].T @ error) / eigenvalues[kept]))
        multiples = multiples + step[:free]
        factors = [f + step[offsets[k]:offsets[k + 1]].reshape(f.shape) for k, f in enumerate(factors)]
    return factors if size < REFINED else None


def _products(program: Program, multiples: Vector, factors: list[Vector], offsets: Vector) -> tuple[Vector, Vector]:
    """The unknowns that multiples and factors make, and their derivatives, of shape (unknowns, numbers)."""
    free = len(multiples)
    unknowns = np.concatenate([multiples, np.zeros(len(program.places) - free)])
    slope = np.zeros((len(program.places), int(offsets[-1])))
    slope[:free, :free] = np.eye(free)
    for column, (k, i, j) in enumerate(program.places):
        if k < 0:
            continue
        rank, start = factors[k].shape[1], int(offsets[k])
        unknowns[column] = factors[k][i] @ factors[k][j]
        slope[column, start + i * rank:start + (i + 1) * rank] += factors[k][j]
        slope[column, start + j * rank:start + (j + 1) * rank] += factors[k][i]
    return unknowns, slope
