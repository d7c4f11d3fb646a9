"""The disturbance observer that takes the offset out of MPC: what the model did not foresee, believed by a share.

The actuator's force is not measured, so it is followed by the model from the commands that were given.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from workbench.errors import InputError
from workbench.mpc.kernels import kernels
from workbench.mpc.problem import Array, Problem


class Observer:
    """Estimates a constant disturbance (m/s^2) beside what the preview tells, from measured speeds.

    gain: the share of each surprise that is believed, from 0 (no observer) to 1 (deadbeat); the estimate's error then
    decays by 1 - gain a sample, so that it is stable for every gain above 0. largest_mps2 bounds the estimate.
    surprise: mean push of the last period (m/s^2) that was not expected, 0 where nothing was.
    Raises InputError for a gain outside 0 to 1.
    """

    def __init__(self, problem: Problem, ahead: Array, gain: float, largest_mps2: float = 2.0) -> None:
        if not 0 <= gain <= 1:
            raise InputError("", "observer_gain", f"{gain:g} is outside 0 to 1: choose the share of the surprise that "
                             "is believed, 0 for no observer")
        self._follow: Callable[..., tuple[float, float, float]] = kernels(problem.actuator).follow
        self._parameters, self._period_s = problem.parameters, problem.period_s
        self._problem = problem
        self._ahead, self._gain, self._largest = ahead, gain, largest_mps2
        self.disturbance, self.force = 0.0, float(ahead[0, 2])
        self._expected_speed: float | None = None
        self.surprise = 0.0

    def correct(self, speed_mps: float) -> float:
        """Take in a measured speed; the estimate."""
        self.surprise = 0.0
        if self._expected_speed is not None:
            self.surprise = (speed_mps - self._expected_speed) / self._period_s
            moved = self.disturbance + self._gain * self.surprise
            self.disturbance = min(max(moved, -self._largest), self._largest)
        return self.disturbance

    def predict(self, sample: int, speed_mps: float | None, command: float,
                before: tuple[float, float] | None = None) -> None:
        """Follow the command to the next sample; without a speed there is nothing to be surprised by.

        before: the command that acts for the first seconds, and how many, where the sample's own comes late.
        """
        push = float(self._ahead[sample, 5]) + self.disturbance
        speed, force, left = (0.0 if speed_mps is None else speed_mps), self.force, self._parameters
        if before is not None and before[1] > 0:
            first, left = map(self._problem.parameters_over, (before[1], self._period_s - before[1]))
            _, speed, force = self._follow(0.0, speed, force, before[0], push, first)
        _, expected, force = self._follow(0.0, speed, force, command, push, left)
        self.force = force if math.isfinite(force) else command
        self._expected_speed = expected if speed_mps is not None else None
