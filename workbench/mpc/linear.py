"""Linear time-varying tracking MPC: the model linearised along the desired run, once; then one program a sample."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from workbench.mpc.kernels import kernels, memory, workspace
from workbench.mpc.model import SOFT
from workbench.mpc.nonlinear import MOST_INTERIOR, MOST_PASSES
from workbench.mpc.problem import Array, Problem
from workbench.mpc.solution import Solution
from workbench.mpc.terminal import Lqr, lqr


@dataclass(frozen=True)
class Linearised:
    """The model along a desired run, a row a sample: what a period and the soft rows are near it.

    x, u: the run; jac (12), gap (3): of one period; h, g: the soft rows and their gradients; answer: change of the
    following state per m/s^2 of disturbance. Kept for other controllers of the same run: not to be written to.
    """

    x: Array
    u: Array
    jac: Array
    gap: Array
    h: Array
    g: Array
    answer: Array


def linearised_along(problem: Problem, ahead: Array) -> Linearised:
    """The model of a problem along `ahead`; computed once a process."""
    return _linearised(problem, ahead.tobytes(), ahead.shape)


@lru_cache(maxsize=16)
def _linearised(problem: Problem, rows: bytes, shape: tuple[int, int]) -> Linearised:
    ahead = np.frombuffer(rows).reshape(shape).copy()
    module, steps, limits = kernels(problem.actuator), len(ahead), problem.limits()
    x, u = np.ascontiguousarray(ahead[:, :3]), np.ascontiguousarray(ahead[:, 3])
    jac, gap = np.zeros((steps, 12)), np.zeros((steps, 3))
    h, g, answer = np.zeros((steps, len(SOFT))), np.zeros((steps, len(SOFT), 3)), np.zeros((steps, 3))
    for k in range(steps):
        module.linearise_at(x[k], u[k], ahead[k, 5], problem.parameters, jac[k], gap[k], x[min(k + 1, steps - 1)])
        near = _at_the_limit(problem, x[k])
        module.soften_at(near, ahead[k, 0], limits[2], ahead[k, 4], limits[3], h[k], g[k])
        h[k] += g[k] @ (x[k] - near)
        # How one period answers a disturbance is how it answers a push of the command's size on the speed.
        high, low = (np.array(module.follow(*x[k], u[k], ahead[k, 5] + d, problem.parameters)) for d in (0.5, -0.5))
        answer[k] = high - low
    return Linearised(x, u, jac, gap, h, g, answer)


def _at_the_limit(problem: Problem, x: Array) -> Array:
    """A state with no more force than its power allows: where the power limit is linearised, if it binds at all."""
    allowed = problem.power_w_per_kg / max(float(x[1]), 1e-3)
    return np.array([x[0], x[1], min(float(x[2]), allowed)])


class LinearMpc:
    """Solves a problem, linearised along `ahead` (rows of `preview` for the whole run), from sample to sample.

    The active set of a sample, shifted, is the first guess of the next; it mostly is the answer, by one pass.
    """

    def __init__(self, problem: Problem, ahead: Array, beyond: Lqr | None = None) -> None:
        self.problem, self.ahead, self.horizon = problem, ahead, problem.horizon
        self.lqr = beyond or lqr(problem)
        module = kernels(problem.actuator)
        self._kernel, self._shift = module.solve_linear, module.shift
        N = problem.horizon
        self.along = linearised_along(problem, ahead)
        self._fixed = (problem.weights.array(), self.lqr.upper(), problem.limits(), problem.rows(ahead),
                       np.array(problem.price))
        self._memory, self._work, self._plan = memory(N), workspace(N), np.zeros(N)
        self.forget()
        # Loads the compiled functions, so that the first sample is no slower than the others.
        self._shift(*self._memory)
        self.solve(0, ahead[0, :3].copy())
        self.forget()

    def forget(self) -> None:
        """Drop the active set."""
        for array in self._memory:
            array[:] = 0
        self._sample = -1

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state (p, v, F) at a sample, under a constant disturbance beside what is told."""
        N, along = self.horizon, self.along
        last = sample + N
        if self._sample < sample <= self._sample + N and self._sample >= 0:
            for _ in range(sample - self._sample):
                self._shift(*self._memory)
        self._sample = sample
        gap = along.gap[sample:last]
        ahead = self.ahead[sample : last + 1]
        if disturbance:
            gap = gap + disturbance * along.answer[sample:last]
            # The command that the curve needs is that much less, and the force with it.
            ahead = ahead.copy()
            ahead[:, 2:4] -= disturbance
        how, passes = self._kernel(
            state, along.x[sample : last + 1], along.u[sample:last], along.jac[sample:last], gap,
            along.h[sample : last + 1], along.g[sample : last + 1], ahead, *self._fixed, self._memory, self._work,
            self._plan, MOST_PASSES, MOST_INTERIOR)
        good = how != 2 and bool(np.isfinite(self._plan).all())
        if not good:
            self.forget()
        return Solution(self._plan.copy(), good, 1, int(how == 1), passes, "" if good else "the program was not solved")
