"""Linear time-varying tracking MPC: the model linearised along the desired run, once; then one program a sample."""

from __future__ import annotations

import numpy as np

from workbench.mpc.kernels import kernels, memory, workspace
from workbench.mpc.model import SOFT
from workbench.mpc.nonlinear import MOST_INTERIOR, MOST_PASSES
from workbench.mpc.problem import Array, Problem
from workbench.mpc.solution import Solution
from workbench.mpc.terminal import Lqr, lqr


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
        self._x, self._u = np.ascontiguousarray(ahead[:, :3]), np.ascontiguousarray(ahead[:, 3])
        steps = len(ahead)
        self._jac, self._gap = np.zeros((steps, 12)), np.zeros((steps, 3))
        self._h, self._g = np.zeros((steps, len(SOFT))), np.zeros((steps, len(SOFT), 3))
        limits = problem.limits()
        for k in range(steps):
            following = self._x[min(k + 1, steps - 1)]
            module.linearise_at(self._x[k], self._u[k], ahead[k, 5], problem.parameters, self._jac[k], self._gap[k],
                                following)
            near = self._at_the_limit(self._x[k])
            module.soften_at(near, ahead[k, 0], limits[2], ahead[k, 4], limits[3], self._h[k], self._g[k])
            self._h[k] += self._g[k] @ (self._x[k] - near)
        # How one period answers a disturbance is how it answers a push of the command's size on the speed.
        self._answer = self._to_disturbance()
        self._fixed = (problem.weights.array(), self.lqr.upper(), limits, problem.rows(ahead), np.array(problem.price))
        self._memory, self._work, self._plan = memory(N), workspace(N), np.zeros(N)
        self.forget()
        # Loads the compiled functions, so that the first sample is no slower than the others.
        self._shift(*self._memory)
        self.solve(0, ahead[0, :3].copy())
        self.forget()

    def _at_the_limit(self, x: Array) -> Array:
        """A state with no more force than its power allows: where the power limit is linearised, if it binds at all."""
        allowed = self.problem.power_w_per_kg / max(float(x[1]), 1e-3)
        return np.array([x[0], x[1], min(float(x[2]), allowed)])

    def _to_disturbance(self) -> Array:
        """Shape (steps, 3): change of the following state per m/s^2 of disturbance."""
        module, problem = kernels(self.problem.actuator), self.problem
        rows = np.zeros((len(self.ahead), 3))
        for k, row in enumerate(self.ahead):
            high, low = (np.array(module.follow(*self._x[k], self._u[k], row[5] + d, problem.parameters))
                         for d in (0.5, -0.5))
            rows[k] = high - low
        return rows

    def forget(self) -> None:
        """Drop the active set."""
        for array in self._memory:
            array[:] = 0
        self._sample = -1

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state (p, v, F) at a sample, under a constant disturbance beside what is told."""
        N = self.horizon
        last = sample + N
        if self._sample < sample <= self._sample + N and self._sample >= 0:
            for _ in range(sample - self._sample):
                self._shift(*self._memory)
        self._sample = sample
        gap = self._gap[sample:last]
        ahead = self.ahead[sample : last + 1]
        if disturbance:
            gap = gap + disturbance * self._answer[sample:last]
            # The command that the curve needs is that much less, and the force with it.
            ahead = ahead.copy()
            ahead[:, 2:4] -= disturbance
        how, passes = self._kernel(
            state, self._x[sample : last + 1], self._u[sample:last], self._jac[sample:last], gap,
            self._h[sample : last + 1], self._g[sample : last + 1], ahead, *self._fixed, self._memory, self._work,
            self._plan, MOST_PASSES, MOST_INTERIOR)
        good = how != 2 and bool(np.isfinite(self._plan).all())
        if not good:
            self.forget()
        return Solution(self._plan.copy(), good, 1, int(how == 1), passes, "" if good else "the program was not solved")
