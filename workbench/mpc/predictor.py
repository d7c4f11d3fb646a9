"""The state at which a late command takes effect: the measured one, through the commands that are under way.

Every step is the model's own (`model.py`), so that the prediction is exact for it. An actuator that a period can
resolve is told as a lag, which is a state of the model; a quicker one as a delay of the same length.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

import numpy as np

from workbench.mpc.kernels import kernels
from workbench.mpc.problem import Array, Problem
from workbench.trains.actuator import Actuator

# A lag that is shorter than a period over this is beyond the model's Runge-Kutta step.
PERIODS_OF_A_LAG = 2.5


def told(problem: Problem, actuator: Actuator) -> tuple[Problem, float]:
    """The problem with the actuator's lag in its model, and the delay (s) that is left to be predicted over."""
    if problem.period_s > PERIODS_OF_A_LAG * actuator.lag_s:
        return problem, actuator.delay_s + actuator.lag_s
    return replace(problem, actuator="lag", lag_s=actuator.lag_s), actuator.delay_s


class Predictor:
    """Commands under way over a delay; told_mps2: what the line does at each sample, m/s^2, as the controller knows it.

    A command of sample j acts from j + whole periods + rest on; before the first one nothing does. The train is the
    problem's until another is driven.
    """

    def __init__(self, problem: Problem, told_mps2: Array, delay_s: float) -> None:
        period = problem.period_s
        whole = math.floor(delay_s / period + 1e-9)
        rest = delay_s - whole * period
        self.rest_s = rest if rest > 1e-9 * period else 0.0
        self._follow, self._told = kernels(problem.actuator).follow, told_mps2
        self._period = problem.parameters
        self._rest = problem.parameters_over(self.rest_s)
        self._under_way = deque([0.0] * (whole + 1), maxlen=whole + 1)
        self._gain, self._wind = 1.0, 0.0

    def drive(self, davis: tuple[float, float, float], gain: float, push: float) -> None:
        """Predict another train from now on: its Davis coefficients, the nominal mass over its own, and what pushes it
        beside what is told (m/s^2)."""
        self._period[:3] = self._rest[:3] = davis
        self._gain, self._wind = gain, push

    def ahead(self, sample: int, state: Array, disturbance: float) -> Array:
        """The state (p, v, F) when the command of a sample takes effect, from that of the sample itself."""
        p, v, force = state.tolist()
        gain, beside = self._gain, disturbance + self._wind
        x = (p, v, gain * force)
        first, *others = self._under_way
        if self.rest_s:
            x = self._follow(*x, gain * first, self._push(sample) + beside, self._rest)
        for later, command in enumerate(others):
            x = self._follow(*x, gain * command, self._push(sample + later) + beside, self._period)
        return np.array((x[0], x[1], x[2] / gain))

    def acting(self, command: float) -> tuple[float, float]:
        """Take in the command of a sample; the commands that act in its first `rest_s` and in what is left of it."""
        first = self._under_way[0]
        self._under_way.append(command)
        return first, self._under_way[0]

    def _push(self, sample: int) -> float:
        return float(self._told[min(sample, len(self._told) - 1)])
