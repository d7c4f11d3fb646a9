"""A law that is sampled: the linear map from one sample to the next, its stability, and a proof of it.

The estimates take one Euler step a sample, before the command answers (`corrected`) or after it (`explicit`), the
command is held, and the plant moves on between the samples, as the simulation has it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.linalg import expm, matrix_balance, solve_discrete_lyapunov

from workbench.errors import SolverError
from workbench.gains.exact import rational, simplest
from workbench.gains.problem import Problem
from workbench.gains.search import confirm
from workbench.proof.claim import at_least

Array = NDArray[np.float64]
Order = Literal["corrected", "explicit"]
Rates = Mapping[sp.Expr, sp.Expr]
ENTRY = 1e-12  # relative distance within which the map's entries are rounded to rationals


def sampled_map(plant: Rates, command_symbol: sp.Symbol, command: sp.Expr, estimates: Rates,
                at: Mapping[sp.Expr, sp.Expr], order: Order) -> Callable[[float], Array]:
    """The map of a period (s) onto the matrix from one sample's deviations (plant, estimates) to the next one's.

    plant: rates of its states driven by `command_symbol`; estimates: their rates; at: the point of linearisation.
    """
    moving, learned = list(plant), list(estimates)

    def slopes(exprs: list[sp.Expr], by: list[sp.Expr]) -> Array:
        rows = [[float(sp.diff(e, s).xreplace(dict(at))) for s in by] for e in exprs]
        return np.array(rows).reshape(len(exprs), len(by))

    rates, steps = list(plant.values()), list(estimates.values())
    A, B = slopes(rates, moving), slopes(rates, [command_symbol])
    K_x, K_e = slopes([command], moving), slopes([command], learned)
    J_x, J_e = slopes(steps, moving), slopes(steps, learned)

    def matrix(period_s: float) -> Array:
        n = len(moving)
        whole = expm(np.block([[A, B], [np.zeros((1, n + 1))]]) * period_s)
        phi, held = whole[:n, :n], whole[:n, n:]
        to_x, to_e = period_s * J_x, np.eye(len(learned)) + period_s * J_e
        if order == "corrected":
            return np.block([[phi + held @ (K_x + K_e @ to_x), held @ K_e @ to_e], [to_x, to_e]])
        return np.block([[phi + held @ K_x, held @ K_e], [to_x, to_e]])

    return matrix


def largest_period_s(matrix: Callable[[float], Array], shortest_s: float = 1e-5, longest_s: float = 10.0) -> float:
    """The period up to which every shorter one is stable, to one part in a thousand; 0 when the shortest is not."""
    def stable(period_s: float) -> bool:
        return bool(np.abs(np.linalg.eigvals(matrix(period_s))).max() < 1)

    low = 0.0
    for period in np.geomspace(shortest_s, longest_s, 600):
        if not stable(period):
            break
        low = float(period)
    if low in (0.0, longest_s):
        return low
    high = low * (longest_s / shortest_s) ** (1 / 599)
    while high - low > 1e-3 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


def stability_certificate(claim: str, matrix: Array) -> dict[str, Any]:
    """The exact certificate that a quadratic function decreases along the map; SolverError where none is found.

    The map's entries are rounded to rationals within ENTRY of them.
    """
    size = len(matrix)
    exact = [[simplest(float(x), ENTRY) if x else sp.Integer(0) for x in row] for row in matrix]
    states = sp.symbols(f"x_1:{size + 1}", real=True)
    after = {s: sum((rational_of(c) * x for c, x in zip(row, states, strict=True)), sp.Integer(0))
             for s, row in zip(states, exact, strict=True)}
    # Solved in units in which the map's rows and columns are of one size, and turned back.
    balanced, (sizes, _) = matrix_balance(matrix, permute=False, separate=True)
    P = solve_discrete_lyapunov(balanced.T, np.eye(size)) / np.outer(sizes, sizes)
    weights = sizes**-2.0
    for tolerance in (1e-6, 1e-9, 1e-12):
        rounded = [[simplest(float(x), tolerance) if x else sp.Integer(0) for x in row] for row in (P + P.T) / 2]
        V = sum((rational_of(rounded[i][j]) * states[i] * states[j] for i in range(size) for j in range(size)),
                sp.Integer(0))
        size_now = sum((rational_of(simplest(float(w), 0.1)) * s**2 for w, s in zip(weights, states, strict=True)),
                       sp.Integer(0))
        problem = Problem(claim, (), {
            "positive": at_least(V, size_now / 2), "decrease": at_least(V - V.xreplace(after), size_now / 2)})
        try:
            return confirm(problem)
        except SolverError:
            continue
    raise SolverError(f"{claim}: the map is too near to the border of stability: shorten the period")


def rational_of(value: Any) -> sp.Expr:
    """A fraction or sympy number as sympy's."""
    return value if isinstance(value, sp.Expr) else rational(value)
