"""Nonlinear tracking MPC: sequential quadratic programming along the stages, compiled, warm-started, fixed in size."""

from __future__ import annotations

import math

import numpy as np

from workbench.mpc.kernels import base, kernels, memory, workspace
from workbench.mpc.problem import Array, Problem
from workbench.mpc.solution import Solution
from workbench.mpc.terminal import Lqr, lqr

MOST_PASSES, MOST_INTERIOR = 12, 100


class NonlinearMpc:
    """Solves a problem from sample to sample; ahead: rows of `preview` for the whole run.

    most_programs: quadratic programs a sample; 1 is a real-time iteration, whose steps are taken without converging.
    close_mps2: a step of the commands smaller than this ends the iteration.
    """

    def __init__(self, problem: Problem, ahead: Array, most_programs: int = 20, close_mps2: float = 1e-6,
                 beyond: Lqr | None = None) -> None:
        self.problem, self.ahead, self.horizon = problem, ahead, problem.horizon
        self.lqr = beyond or lqr(problem)
        self.most_programs, self._close = most_programs, close_mps2
        self._kernel = kernels(problem.actuator).solve_nonlinear
        self._shift = kernels(problem.actuator).shift
        N = problem.horizon
        self._fixed = (problem.parameters, problem.weights.array(), self.lqr.upper(), problem.limits(),
                       problem.rows(ahead), np.array(problem.price))
        self._memory, self._work, self._base = memory(N), workspace(N), base(N)
        self._window, self._plan = ahead[: N + 1].copy(), np.zeros(N)
        self.cost = 0.0
        self.forget()
        self._load()

    def _load(self) -> None:
        """Load the compiled functions, so that the first sample is no slower than the others."""
        self._shift(*self._memory)
        self.solve(0, self.ahead[0, :3].copy())
        self.forget()

    def forget(self) -> None:
        """Drop the plan and the active set; the next program starts from the commands that the curve needs."""
        for array in self._memory:
            array[:] = 0
        self._sample = -1

    def drive(self, davis: tuple[float, float, float], gain: float) -> None:
        """Predict another train from now on: its Davis coefficients, and its limits as so many times the problem's."""
        parameters, limits = self._fixed[0], self._fixed[3]
        parameters[:3] = davis
        # Commands and power are per unit of mass; the band, between them, is not.
        limits[[0, 1, 3]] = gain * self.problem.limits()[[0, 1, 3]]

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state at a sample; the one before is shifted to start from, where it is one sample old."""
        N = self.horizon
        self._window[:] = self.ahead[sample : sample + N + 1]
        if disturbance:
            self._window[:, 5] += disturbance
            self._window[:, 2:4] -= disturbance  # what the curve needs is that much less
        if 0 <= self._sample < sample <= self._sample + N:
            for _ in range(sample - self._sample):
                self._plan[:-1] = self._plan[1:]
                self._shift(*self._memory)
        elif sample != self._sample:
            self._plan[:] = self._window[:-1, 3]
        self._sample = sample
        status, programs, interior, passes, cost = self._kernel(
            state, self._window, *self._fixed, self._memory, self._work, self._base, self._plan, self.most_programs,
            MOST_PASSES, MOST_INTERIOR, self._close)
        self.cost = cost
        good = math.isfinite(cost) and status != 2
        # A plan that is not converged obeys the model and the limits all the same, and costs less than its start.
        why = "" if good and (status == 0 or self.most_programs == 1) else (
            f"no convergence in {programs} programs" if good else "a program was not solved")
        if not good:
            self.forget()
        return Solution(self._plan.copy(), good, programs, interior, passes, why)
