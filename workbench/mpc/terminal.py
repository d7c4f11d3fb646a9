"""The cost beyond the horizon and the feedback behind it: the LQR of the linearised model."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np

from workbench.errors import InputError
from workbench.mpc.lqr import dlqr
from workbench.mpc.model import model
from workbench.mpc.problem import Array, Problem


@dataclass(frozen=True)
class Lqr:
    """u = u_r - gain (x - x_r), and the cost of all that follows, (x - x_r)' cost (x - x_r).

    gain: shape (3,); cost: shape (3, 3); A, B: the model at the speed it was linearised at.
    """

    gain: Array
    cost: Array
    A: Array
    B: Array

    def upper(self) -> Array:
        """The cost's upper triangle, as the kernels read it."""
        return np.asarray(self.cost[np.triu_indices(3)])


def linearised(problem: Problem, speed_mps: float) -> tuple[Array, Array]:
    """A, shape (3, 3), and B, shape (3, 1), of one period at a speed, by casadi from the model's expressions."""
    step = model(problem.actuator).casadi_step()
    x, u = ca.SX.sym("x", 3), ca.SX.sym("u")
    after = step(x[0], x[1], x[2], u, 0, *problem.parameters)
    at = ca.Function("at", [x, u], [ca.jacobian(after, x), ca.jacobian(after, u)])(
        [0.0, speed_mps, 0.0], 0.0)
    return np.asarray(at[0]), np.asarray(at[1])


@lru_cache(maxsize=64)
def lqr(problem: Problem) -> Lqr:
    """The LQR of a problem, kept for the next controller of the same one; its arrays are not to be written to.

    Raises InputError where the weights are too far apart for one.
    """
    A, B = linearised(problem, problem.terminal_speed_mps)
    w = problem.weights
    q, r = np.diag([w.position, w.speed, w.force + w.change]), np.array([[w.command + w.change]])
    try:
        gain, cost = dlqr(A, B, q, r, np.array([[0.0], [0.0], [-w.change]]))
    except (ValueError, np.linalg.LinAlgError):
        raise InputError("", "weights", "no LQR follows from these: choose weights nearer to each other") from None
    cost = np.asarray(cost)
    return Lqr(np.asarray(gain).ravel(), (cost + cost.T) / 2, A, B)
