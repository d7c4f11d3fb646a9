"""What an MPC that is told of the actuators knows of them: lags are states of its model, late commands underway."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.systems.metric import COMMANDED, Metric
from workbench.systems.setting import Setting, first_inputs

Array = NDArray[np.float64]
Piece = tuple[Array, float]  # an input as it acts, and for how many seconds
# (state, input, disturbances, seconds) -> the state so much later.
Motion = Callable[[Array, Array, Array, float], Array]


def with_lags(setting: Setting) -> Setting:
    """The setting of a plant whose lagging inputs are its last states, called `<input>_acting`."""
    plant = setting.plant
    lags = {u: setting.lag_s[str(u)] for u in plant.inputs if setting.lag_s.get(str(u), 0.0) > 0}
    acting = {u: sp.Symbol(f"{u}_acting", real=True) for u in lags}
    if plant.updates:
        moves = [u + math.exp(-setting.step_s / lag) * (acting[u] - u) for u, lag in lags.items()]
    else:
        moves = [(u - acting[u]) / lag for u, lag in lags.items()]
    every = (*(e.xreplace(acting) for e in plant.moves), *moves)
    told = replace(
        plant, states=(*plant.states, *acting.values()), rates=() if plant.updates else every,
        updates=every if plant.updates else (), domain=[e.xreplace(acting) for e in plant.domain], events=())
    # What metrics say of an input is of the input as it acts.
    metrics = [Metric(m.id, m.measure, m.expression.xreplace(acting), m.unit, m.title) for m in setting.every_metric
               if m.measure not in COMMANDED]
    return setting.varied(plant=told, metrics=tuple(metrics), lag_s={}, initial={
        **setting.initial, **{str(acting[u]): float(first_inputs(setting)[plant.inputs.index(u)]) for u in lags}})


class Underway:
    """The commands that were sent and have not arrived yet.

    A command sent at t acts from t + delay_s on for a period; so what acts changes within a period where the delay is
    no whole number of periods.
    """

    def __init__(self, first: Array, period_s: float, delay_s: float) -> None:
        self._period = period_s
        self._whole = int(delay_s / period_s + 1e-6)
        self._part = max(0.0, delay_s - self._whole * period_s)
        self._sent = [first.copy() for _ in range(self._whole + 2)]

    def send(self, command: Array) -> None:
        """A command sets out, and a period goes by."""
        self._sent = [*self._sent[1:], command.copy()]

    @property
    def arrived(self) -> Sequence[Piece]:
        """What acted in the period that ends now."""
        return self._lasting((self._sent[0], self._part), (self._sent[1], self._period - self._part))

    @property
    def ahead(self) -> Sequence[Piece]:
        """What will act until a command that is sent now arrives."""
        return self._lasting((self._sent[1], self._part), *((u, self._period) for u in self._sent[2:]))

    def _lasting(self, *pieces: Piece) -> Sequence[Piece]:
        return [(u, seconds) for u, seconds in pieces if seconds > 1e-9 * self._period]


def moved(motion: Motion, x: Array, pieces: Sequence[Piece], disturbances: Array, push_per_s: Array) -> Array:
    """The state after some pieces; push_per_s: what is added to it besides."""
    for u, seconds in pieces:
        x = motion(x, u, disturbances, seconds) + seconds * push_per_s
    return x
