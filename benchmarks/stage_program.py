"""The program of linear MPC as matrices, a sample at a time, as solvers take it that know nothing of its stages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse

from workbench.mpc.linear import LinearMpc
from workbench.mpc.problem import Array, Problem

UNBOUNDED = 1e30


@dataclass(frozen=True)
class Program:
    """min z'Pz/2 + q'z subject to low <= A z <= high; the first rows are equations.

    first: place of the first command.
    """

    P: Any
    q: Array
    A: Any
    low: Array
    high: Array
    equations: int
    first: int

    def parts(self) -> tuple[Any, ...]:
        """P, q, equations and their right side, the other rows and their limits."""
        n = self.equations
        return self.P, self.q, self.A[:n], self.low[:n], self.A[n:], self.low[n:], self.high[n:]


class Stages:
    """The programs of a run: the fixed part once, by sample what changes; unknowns (x, u, slack) by stage, x_N last."""

    def __init__(self, problem: Problem, ahead: Array) -> None:
        tracker = LinearMpc(problem, ahead)
        self.problem, self.ahead, self.along, self.N = problem, ahead, tracker.along, problem.horizon
        self.rows = problem.rows(ahead)
        self.price = np.array(problem.price)
        self.width = 4 + len(self.rows)
        self.size = self.N * self.width + 3
        w, T = problem.weights, tracker.lqr.cost
        self.terminal = 2.0 * np.asarray(T)
        P = sparse.lil_matrix((self.size, self.size))
        for k in range(self.N):
            at = k * self.width
            P[at, at], P[at + 1, at + 1] = 2 * w.position, 2 * w.speed
            P[at + 2, at + 2], P[at + 3, at + 3] = 2 * (w.force + w.change), 2 * (w.command + w.change)
            P[at + 2, at + 3] = P[at + 3, at + 2] = -2 * w.change
            for n, i in enumerate(self.rows):
                P[at + 4 + n, at + 4 + n] = 2 * self.price[i, 1]
        P[-3:, -3:] = self.terminal
        self.P = sparse.csc_matrix(P)
        # Places that are filled in some sample are filled in all, so that solvers keep their factors' structure.
        self._filled = np.any(self.along.jac != 0, axis=0).reshape(3, 4)
        self._bent = np.any(self.along.g != 0, axis=0)

    def at(self, sample: int, state: Array) -> Program:
        """The program of a sample from a state."""
        N, along, w, m = self.N, self.along, self.problem.weights, len(self.rows)
        last = sample + N
        x, u, ahead = along.x[sample : last + 1], along.u[sample:last], self.ahead[sample : last + 1]
        low_u, high_u = self.problem.limits()[:2]
        q = np.zeros(self.size)
        entries: list[tuple[int, int, float]] = []
        low, high = [*(state - x[0])], [*(state - x[0])]
        entries += [(i, i, 1.0) for i in range(3)]
        row = 3
        for k in range(N):
            at, after = k * self.width, (k + 1) * self.width
            J = along.jac[sample + k].reshape(3, 4)
            for i in range(3):
                entries.append((row + i, after + i, 1.0))
                entries += [(row + i, at + j, -J[i, j]) for j in range(4) if self._filled[i, j]]
            low += along.gap[sample + k].tolist()
            high += along.gap[sample + k].tolist()
            row += 3
            change = 2 * w.change * (u[k] - x[k, 2])
            error = x[k] - ahead[k, :3]
            q[at : at + 4] = (2 * w.position * error[0], 2 * w.speed * error[1], 2 * w.force * error[2] - change,
                              2 * w.command * (u[k] - ahead[k, 3]) + change)
            q[at + 4 : at + 4 + m] = self.price[self.rows, 0]
        q[-3:] = self.terminal @ (x[N] - ahead[N, :3])
        equations = row
        for k in range(N):
            at = k * self.width
            entries.append((row, at + 3, 1.0))
            low.append(low_u - u[k])
            high.append(high_u - u[k])
            row += 1
            for n, i in enumerate(self.rows):
                entries.append((row, at + 4 + n, 1.0))
                low.append(0.0)
                high.append(UNBOUNDED)
                # The first state is measured: nothing that is done changes it, so that its rows cost what they cost.
                entries += [(row + 1, at + j, along.g[sample + k, i, j]) for j in range(3) if self._bent[i, j]]
                entries.append((row + 1, at + 4 + n, -1.0))
                low.append(-UNBOUNDED)
                high.append(-along.h[sample + k, i])
                row += 2
        i, j, values = zip(*entries, strict=True)
        A = sparse.csc_matrix((values, (i, j)), shape=(row, self.size))
        return Program(self.P, q, A, np.array(low), np.array(high), equations, 3)
