"""MPC that repeats a trip: what pushed the train on earlier trips is foreseen on the next.

Learning MPC in the sense of Rosolia and Borrelli (IEEE Trans. Automatic Control 63, 2018) takes terminal set and cost
from the states of earlier trips. That does not fit a trip along a given curve: the curve itself, with the LQR's cost,
is an invariant terminal set of the model already, while the states of earlier trips lie off the curve by the very
error that is to vanish, so that a plan which must end among them is held back by it. What keeps MPC off the curve is
what its model does not say. So that is what is learned here, as in iterative learning control: the mean push of every
sample that the model did not have, smoothed without a shift in time, is believed by a share and foreseen by the next
trip's plans. Within a trip the disturbance observer answers what does not repeat.
"""

from __future__ import annotations

import numpy as np

from workbench.errors import InputError
from workbench.mpc.controller import MpcController
from workbench.mpc.problem import Array
from workbench.trains.scenario import ControllerSpec, Scenario

# Slower than this the brakes may hold the train whatever pushes it, so that a speed says nothing of pushes.
STANDING_MPS = 0.2
# No train is pushed by more (m/s^2).
LARGEST_MPS2 = 2.0


class RecordingMpc(MpcController):
    """One of the MPC family that foresees `learned` pushes (m/s^2, one a sample) and keeps what pushed in truth.

    pushed: by sample, the mean push over it beside the model; not a number where nothing can be told of it.
    """

    def __init__(self, scenario: Scenario, spec: ControllerSpec, name: str, learned: Array) -> None:
        super().__init__(scenario, spec, name, learned)
        self.pushed = np.full(len(learned), np.nan)
        self._foreseen = learned
        self._last = -1, 0.0, 0.0  # sample, believed push, speed

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        """As the family's; takes down what pushed the train since the sample before."""
        answer = super().command(time_s, position_m, speed_mps)
        before, believed, speed = self._last
        if before == self._sample - 1 >= 0 and before < len(self.pushed) and min(speed, speed_mps) > STANDING_MPS:
            self.pushed[before] = self._foreseen[before] + believed + self._observer.surprise
        if before != self._sample:
            self._last = (self._sample, self._observer.disturbance, speed_mps)
        return answer


def learned_from(foreseen: Array, pushed: Array, share: float, smoothing_samples: float) -> Array:
    """What is foreseen on the next trip: of each sample the share of what pushed it, smoothed, and the rest of before.

    Samples of which nothing is known take what the nearest ones before and after them say, in proportion.
    Raises InputError for a share outside 0 to 1 and smoothing below 0.
    """
    if not 0 < share <= 1:
        raise InputError("", "learning_gain", f"{share:g} is outside 0 to 1: choose what share of a trip is believed")
    if not smoothing_samples >= 0:
        raise InputError("", "smoothing_s", f"{smoothing_samples:g} is below 0: choose how long pushes are averaged")
    from scipy.ndimage import gaussian_filter1d  # noqa: PLC0415 - which no run needs that learns nothing

    known = np.flatnonzero(np.isfinite(pushed))
    if not known.size:
        return foreseen.copy()
    whole = np.interp(np.arange(len(pushed)), known, pushed[known])
    smooth = gaussian_filter1d(whole, smoothing_samples, mode="nearest") if smoothing_samples else whole
    return np.clip(foreseen + share * (smooth - foreseen), -LARGEST_MPS2, LARGEST_MPS2)
