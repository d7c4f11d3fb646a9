"""Adaptive MPC: mass and resistance by recursive least squares from what is measured, fed into the nonlinear tracker.

It knows the nominal train when it starts, and after that measured speeds and its own commands, nothing else. Over a
second, with u its command per unit of the nominal mass,

    speed gained / time = gain u - (a + b v + c v^2) + d

where gain is the nominal mass over the true one, a, b, c are the Davis coefficients of the true train, and d is all
that is none of this: grades and wind, which wander. The four are estimated with forgetting and d as a random walk
(Ljung, System Identification, 1999, chapter 11).
"""

from __future__ import annotations

import math

import numpy as np

from workbench.errors import InputError
from workbench.mpc.adaptive_kernel import noticed, take_in
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

    estimate: shape (5,). The covariance never grows beyond that of the start, so that a long cruise, which tells
    nothing of the mass, does not make the estimate jump at the next brake. span: how many samples an equation takes,
    of period_s each; power_w_per_kg: what the train has; lag_s: of forces, 0 where they are there at once. The other
    arrays are laid out in `adaptive_kernel.py`. Raises InputError for a forgetting outside 0.9 to 1.
    """

    def __init__(self, davis: tuple[float, float, float], forgetting: float, span: int = 1, period_s: float = SPAN_S,
                 power_w_per_kg: float = math.inf, lag_s: float = 0.0) -> None:
        if not 0.9 <= forgetting <= 1:
            raise InputError("", "forgetting", f"{forgetting:g} is outside 0.9 to 1: choose what an equation still "
                             "weighs a second later, 1 for no forgetting")
        seconds = span * period_s
        self.estimate = np.array([1.0, *davis, 0.0])
        spread = np.array([*(np.array(UNSURE) * self.estimate[:4]), UNSURE_PUSH_MPS2])
        self.covariance, self.widest = np.diag(spread**2), spread**2
        self.known = np.array([forgetting**seconds, seconds, WANDERS_MPS2**2 * seconds, MISSED_MPS2**2, *GAINS,
                               power_w_per_kg, math.exp(-period_s / lag_s) if lag_s else 0.0])
        self.learner, self.past = np.array([0, -1, span, lag_s == 0]), np.zeros((span + 1, 2))
        self.learning = np.zeros((3, 5))

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

    def learn(self, acceleration: float, command: float, speed: float, speed_square: float) -> None:
        """Take in one equation: means over the span of acceleration, command, speed and its square."""
        take_in(self.estimate, self.covariance, self.widest, self.learning, self.known, acceleration, command, speed,
                speed_square)

    def notice(self, sample: int, speed: float, force: float) -> bool:
        """Take in a sample; whether it made an equation that moved the estimate."""
        return bool(noticed(sample, speed, force, self.learner, self.known, self.past, self.estimate, self.covariance,
                            self.widest, self.learning))


class AdaptiveMpc:
    """`NonlinearMpc` of the train as it is estimated; ahead: rows of `preview` for the nominal one.

    Inside, forces are per unit of the estimated mass: a command is gain times the one that is given, limits likewise.
    acceleration: what the curve asks of any train, one a row of what lies ahead. `learn` comes before `solve`: what is
    measured is of the sample, and what is solved from may be the state at which a late command takes effect.
    """

    def __init__(self, problem: Problem, ahead: Array, forgetting: float) -> None:
        self.inner = NonlinearMpc(problem, ahead.copy())
        self.lqr, self.horizon = self.inner.lqr, problem.horizon
        span = max(1, round(SPAN_S / problem.period_s))
        self.estimator = TrainEstimator(problem.davis, forgetting, span, problem.period_s, problem.power_w_per_kg,
                                        0.0 if problem.actuator == "direct" else problem.lag_s)
        needed = ahead[:, 3] if self.estimator.learner[3] else ahead[:, 2]
        self.acceleration = needed - resistance(ahead[:, 1], *problem.davis)

    def learn(self, sample: int, speed: float, force: float) -> bool:
        """Take in what is measured at a sample, and the force, per unit of the nominal mass; whether the estimate
        moved."""
        if moved := self.estimator.notice(sample, speed, force):
            self._take_over()
        return moved

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state (p, v, F) at a sample, all per unit of the nominal mass."""
        gain = self.estimator.gain
        scaled = np.array([state[0], state[1], gain * state[2]])
        found = self.inner.solve(sample, scaled, disturbance + self.estimator.push)
        return Solution(found.plan / gain, found.solved, found.programs, found.interior, found.passes, found.why)

    def forget(self) -> None:
        """Drop the warm start; what is known of the train stays."""
        self.inner.forget()

    def _take_over(self) -> None:
        """Give the tracker the train as it is estimated: its resistance, its limits and what the curve needs of it."""
        estimator, ahead = self.estimator, self.inner.ahead
        self.inner.drive(estimator.davis, estimator.gain)
        needed = self.acceleration + resistance(ahead[:, 1], *estimator.davis)
        if estimator.learner[3]:
            ahead[:, 3] = needed
            ahead[1:, 2] = needed[:-1]
            ahead[0, 2] = needed[0]
        else:
            left = estimator.known[7]
            ahead[:, 2] = needed
            ahead[:, 3] = (np.append(needed[1:], needed[-1]) - left * needed) / (1 - left)
