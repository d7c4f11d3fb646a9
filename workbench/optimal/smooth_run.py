"""A run whose acceleration is continuous in time, piece by piece."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from workbench.model.desired_curve import DEGREE, DesiredCurve
from workbench.optimal.course import Array


@dataclass(frozen=True)
class SmoothRun:
    """A run with continuous acceleration over time: on piece k it is acceleration[k] + jerk[k] (t - breaks_s[k]).

    breaks_s: shape (n + 1,), from 0; position_m, speed_mps, acceleration_mps2, jerk: shape (n,), at the start of each
    piece. Beyond its ends the speed stays.
    """

    breaks_s: Array
    position_m: Array
    speed_mps: Array
    acceleration_mps2: Array
    jerk_mps3: Array

    @property
    def trip_time_s(self) -> float:
        """Time at which it ends."""
        return float(self.breaks_s[-1])

    def at(self, time_s: Array) -> tuple[Array, Array, Array]:
        """Position (m), speed (m/s) and acceleration (m/s^2) at times in s from 0 to the trip time."""
        time_s = np.clip(np.asarray(time_s, dtype=float), 0.0, self.trip_time_s)
        k = np.clip(np.searchsorted(self.breaks_s, time_s, side="right") - 1, 0, len(self.jerk_mps3) - 1)
        t = time_s - self.breaks_s[k]
        s, v, a, j = self.position_m[k], self.speed_mps[k], self.acceleration_mps2[k], self.jerk_mps3[k]
        return s + t * (v + t * (a / 2 + t * j / 6)), v + t * (a + t * j / 2), a + t * j

    def time_at(self, position_m: float) -> float:
        """When it passes a position, s."""
        early, late = 0.0, self.trip_time_s
        for _ in range(80):
            middle = (early + late) / 2
            if float(self.at(np.array([middle]))[0][0]) < position_m:
                early = middle
            else:
                late = middle
        return late

    def desired_curve(self) -> DesiredCurve:
        """As the reference of the adaptive laws; raises WorkbenchError unless it starts and ends at a standstill."""
        rows = np.zeros((len(self.jerk_mps3), DEGREE + 1))
        rows[:, 0], rows[:, 1] = self.position_m - self.position_m[0], self.speed_mps
        rows[:, 2], rows[:, 3] = self.acceleration_mps2 / 2, self.jerk_mps3 / 6
        return DesiredCurve(self.breaks_s, rows)
