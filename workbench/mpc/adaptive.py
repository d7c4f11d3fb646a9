"""Adaptive MPC: mass and resistance by recursive least squares from what is measured, fed into the nonlinear tracker.

It knows the nominal train when it starts, and after that measured speeds and its own commands, nothing else. Over a
second, with u its command per unit of the nominal mass,

    speed gained / time = gain u - (a + b v + c v^2) + d

where gain is the nominal mass over the true one, a, b, c are the Davis coefficients of the true train, and d is all
that is none of this: grades and wind, which wander. The four are estimated with forgetting and d as a random walk
(Ljung, System Identification, 1999, chapter 11).
"""

from __future__ import annotations

import numpy as np

from workbench.errors import InputError
from workbench.mpc.nonlinear import NonlinearMpc
from workbench.mpc.preview import resistance
from workbench.mpc.problem import Array, Problem
from workbench.mpc.solution import Solution

SPAN_S = 1.0  # one equation a second: a speed measured to centimetres a second says little about a shorter time
# What is not sure at the start, as standard deviations: shares of gain, a, b, c, and d (m/s^2).
UNSURE, UNSURE_PUSH_MPS2 = (0.2, 0.3, 0.3, 0.3), 0.05
# How far d wanders in a second, and what an equation misses (m/s^2).
WANDERS_MPS2, MISSED_MPS2 = 0.03, 0.02
# Estimates outside are no train's.
GAINS = (0.5, 2.0)


class TrainEstimator:
    """Recursive least squares of (gain, a, b, c, d); forgetting: weight of a second's equation a second later.

    The covariance never grows beyond that of the start, so that a long cruise, which tells nothing of the mass, does
    not make the estimate jump at the next brake. Raises InputError for a forgetting outside 0.9 to 1.
    """

    def __init__(self, davis: tuple[float, float, float], forgetting: float) -> None:
        if not 0.9 <= forgetting <= 1:
            raise InputError("", "forgetting", f"{forgetting:g} is outside 0.9 to 1: choose what an equation still "
                             "weighs a second later, 1 for no forgetting")
        self.estimate = np.array([1.0, *davis, 0.0])
        spread = np.array([*(np.array(UNSURE) * self.estimate[:4]), UNSURE_PUSH_MPS2])
        self._covariance = np.diag(spread**2)
        self._widest, self._forgetting = spread**2, forgetting

    @property
    def gain(self) -> float:
        """Nominal mass over the estimated one."""
        return float(self.estimate[0])

    @property
    def davis(self) -> tuple[float, float, float]:
        """Davis coefficients per unit of the estimated mass."""
        return float(self.estimate[1]), float(self.estimate[2]), float(self.estimate[3])

    @property
    def push(self) -> float:
        """What grades and wind push, m/s^2."""
        return float(self.estimate[4])

    def learn(self, acceleration: float, command: float, speed: float, speed_square: float, seconds: float) -> None:
        """Take in one equation: means over so many seconds of acceleration, command, speed and its square."""
        row = np.array([command, -1.0, -speed, -speed_square, 1.0])
        P = self._covariance / self._forgetting**seconds
        P[4, 4] += WANDERS_MPS2**2 * seconds
        shrink = np.minimum(1.0, np.sqrt(self._widest / np.maximum(np.diag(P), 1e-300)))
        P = P * np.outer(shrink, shrink)
        pulled = P @ row
        weight = pulled / (row @ pulled + MISSED_MPS2**2)
        self.estimate = self.estimate + weight * (acceleration - row @ self.estimate)
        self._covariance = P - np.outer(weight, pulled)
        self.estimate[0] = min(max(self.estimate[0], GAINS[0]), GAINS[1])
        self.estimate[1:4] = np.maximum(self.estimate[1:4], 0.0)


class AdaptiveMpc:
    """`NonlinearMpc` of the train as it is estimated; ahead: rows of `preview` for the nominal one.

    Inside, forces are per unit of the estimated mass: a command is gain times the one that is given, limits likewise.
    """

    def __init__(self, problem: Problem, ahead: Array, forgetting: float) -> None:
        self.inner = NonlinearMpc(problem, ahead.copy())
        self.lqr, self.horizon = self.inner.lqr, problem.horizon
        self.estimator = TrainEstimator(problem.davis, forgetting)
        self._problem, self._ahead = problem, ahead
        self._acceleration = ahead[:, 3] - resistance(ahead[:, 1], *problem.davis)
        self._span = max(1, round(SPAN_S / problem.period_s))
        self._past: list[tuple[float, float]] = []  # speed and acting command of consecutive samples
        self._last = -1

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state (p, v, F) at a sample, all per unit of the nominal mass; learns from the state."""
        self._learn(sample, float(state[1]), float(state[2]))
        gain = self.estimator.gain
        scaled = np.array([state[0], state[1], gain * state[2]])
        found = self.inner.solve(sample, scaled, disturbance + self.estimator.push)
        return Solution(found.plan / gain, found.solved, found.programs, found.interior, found.passes, found.why)

    def forget(self) -> None:
        """Drop the warm start; what is known of the train stays."""
        self.inner.forget()

    def _learn(self, sample: int, speed: float, force: float) -> None:
        if sample != self._last + 1:
            self._past = []
        if sample != self._last:
            most = self._problem.power_w_per_kg / max(speed, 1e-3)
            self._past.append((speed, min(force, most)))
        self._last = sample
        if len(self._past) <= self._span:
            return
        speeds, forces = np.array(self._past).T
        seconds = self._span * self._problem.period_s
        # The force of a sample acted until its speed was measured; where it lags, between two of them.
        acting = forces[1:] if self._problem.actuator == "direct" else (forces[1:] + forces[:-1]) / 2
        middle = (speeds[1:] + speeds[:-1]) / 2
        if middle.min() > 0:  # at a standstill the brakes hold whatever they are asked
            self.estimator.learn(float(speeds[-1] - speeds[0]) / seconds, float(acting.mean()), float(middle.mean()),
                                 float((middle**2).mean()), seconds)
            self._take_over()
        self._past = self._past[-1:]

    def _take_over(self) -> None:
        """Give the tracker the train as it is estimated: its resistance, its limits and what the curve needs of it."""
        estimator, problem = self.estimator, self._problem
        self.inner.drive(estimator.davis, estimator.gain)
        needed = self._acceleration + resistance(self._ahead[:, 1], *estimator.davis)
        self.inner.ahead[:, 3] = needed
        if problem.actuator == "direct":
            self.inner.ahead[1:, 2] = needed[:-1]
            self.inner.ahead[0, 2] = needed[0]
        else:
            self.inner.ahead[:, 2] = needed
