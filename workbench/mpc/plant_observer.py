"""What an MPC takes for the plant's state: the measured outputs as they are, or an extended Kalman filter's estimate.

The filter (e.g. Simon, Optimal State Estimation, 2006, chapter 13) is made of the plant's own expressions. Disturbances
that it shall estimate are states of rate zero, which MPC holds over its horizon: what is measured then comes to rest
where it is desired, as with the disturbance models of Pannocchia and Rawlings (AIChE Journal 49, 2003).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from workbench.mpc.plant_actuators import Motion, Piece, moved
from workbench.mpc.plant_motion import PlantMotion
from workbench.mpc.plant_values import PlantMpcValues
from workbench.systems.setting import Setting

Array = NDArray[np.float64]


class MeasuredState:
    """Every state of the plant is measured; lagging inputs are known from what was sent; no disturbance is estimated.

    push: with a disturbance gain, what moves each state a period beyond the model: push <- push + gain (measured -
    predicted).
    """

    def __init__(self, how: PlantMpcValues, setting: Setting, period_s: float, motion: Motion) -> None:
        names, self._states = [*map(str, setting.plant.outputs)], [*map(str, setting.plant.states)]
        self._where = [names.index(state) for state in self._states if state in names]
        self._gain, self._period, self._motion = how.disturbance_gain, period_s, motion
        self._x = np.array([setting.initial.get(state, 0.0) for state in self._states])
        self.push = np.zeros(len(self._states))
        self.disturbances = np.zeros(0)

    def now(self, measured: Array, arrived: Sequence[Piece]) -> Array:
        """The state now; arrived: what acted since the last call, nothing at the first one."""
        known = len(self._where)
        if arrived and (self._gain or known < len(self._states)):
            self._x = moved(self._motion, self._x, arrived, self.disturbances, self.push / self._period)
            self.push[:known] += self._gain * (measured[self._where] - self._x[:known])
        self._x = np.concatenate([measured[self._where], self._x[known:]])
        return self._x


class KalmanState:
    """States and disturbances estimated by an extended Kalman filter from the outputs and the noise that they have."""

    def __init__(self, how: PlantMpcValues, setting: Setting, motion: PlantMotion, known: Mapping[str, float]) -> None:
        self._n, self._motion = len(setting.plant.states), motion
        names = [*map(str, (*setting.plant.states, *motion.estimated))]
        first = {**known, **how.first_estimate}  # known: states of which there is no doubt, as what lags are
        self._z = np.array([first.get(name, 0.0) for name in names])
        # (state, output): of a measured state of which nothing is stated, the first measurement is the first estimate.
        self._begins: list[tuple[int, int]] = [  # whatever the output is called
            (names.index(str(value)), place) for place, value in enumerate(setting.plant.outputs.values())
            if value in setting.plant.states and str(value) not in first]
        self._moves = np.diag([how.observer.get(name, 0.0) ** 2 for name in names])
        self._P = np.diag([how.first_spread.get(name, how.observer.get(name, 0.0)) ** 2 for name in names])
        self._R = np.diag([setting.noise.get(str(y), 0.0) ** 2 for y in setting.plant.outputs])
        self._first = self._z.copy(), self._P, tuple(self._begins)
        self.push = np.zeros(self._n)

    @property
    def disturbances(self) -> Array:
        """The estimated disturbances, those named for the filter in the plant's order."""
        return self._z[self._n:]

    def now(self, measured: Array, arrived: Sequence[Piece]) -> Array:
        """The estimate of the state now; arrived: what acted since the last call, nothing at the first one.

        It begins anew where its numbers overflow: an estimate that is none would stay none for the rest of the run.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            self._move(arrived)
            if not (np.isfinite(self._z).all() and np.isfinite(self._P).all()):
                self._z, self._P, self._begins = self._first[0].copy(), self._first[1], [*self._first[2]]
            self._correct(measured)
        return self._z[:self._n]

    def _move(self, arrived: Sequence[Piece]) -> None:
        n = self._n
        for u, seconds in arrived:
            A = np.eye(len(self._z))
            A[:n] = self._motion.slopes(self._z[:n], u, self._z[n:], seconds)
            self._z = np.concatenate([self._motion(self._z[:n], u, self._z[n:], seconds), self._z[n:]])
            self._P = A @ self._P @ A.T + seconds * self._moves

    def _correct(self, measured: Array) -> None:
        while self._begins:
            state, output = self._begins.pop()
            self._z[state] = measured[output]
        expected, C = self._motion.measured(self._z)
        # What is measured without noise and known without doubt has no weight: the pseudo-inverse leaves it out.
        K = self._P @ C.T @ np.linalg.pinv(C @ self._P @ C.T + self._R, hermitian=True)
        self._z = self._z + K @ (measured - expected)
        left = np.eye(len(self._z)) - K @ C
        self._P = left @ self._P @ left.T + K @ self._R @ K.T
