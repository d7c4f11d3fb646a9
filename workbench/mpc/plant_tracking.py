"""MPC of any plant, tracking or economic: what it is made with, and the controller that is called once a sample.

The problem itself is `plant_program.py`. With a disturbance gain a filter estimates, for each measured state, the
constant push a sample that the model does not foresee: d <- d + gain (measured - predicted), the disturbance model of
offset-free MPC (Pannocchia and Rawlings, AIChE Journal 49, 2003) where every state is measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.mpc.plant_program import program
from workbench.mpc.plant_values import PlantMpcValues
from workbench.systems.setting import Setting, limits_of
from workbench.systems.signals import signals_at

Array = NDArray[np.float64]
FIRST_ITERATIONS = 10  # of the first sample of an MPC of one iteration, which has no plan to go on from


@dataclass(frozen=True)
class PlantMpc(PlantMpcValues):
    """An MPC of a plant with its values, ready to enter a run."""

    def build(self, setting: Setting, period_s: float) -> TrackingMpc:
        """The controller for a setting, whose parameters are what it believes."""
        return TrackingMpc(self, setting, period_s)


class TrackingMpc:
    """A sampled controller: one optimal control problem a sample, warm-started from the one before.

    fallbacks counts the samples at which the solver gave nothing usable; its last plan goes on there. disturbance: the
    estimate, per state and sample.
    """

    title = "tracking MPC"
    information = "full state, nominal model"

    def __init__(self, how: PlantMpc, setting: Setting, period_s: float) -> None:
        how.check(setting)
        self._how, self._setting, self._period = how, setting, period_s
        self._n, self._m = len(setting.plant.states), len(setting.plant.inputs)
        self._tracked = [name for name in setting.tracks if name in how.weights]
        self._program = program(how, setting, period_s, self._tracked)
        self._excess = len(self._program.limited)
        self._stage = self._n + 2 * self._m + self._excess
        self._plan: Array | None = None
        self._multipliers: tuple[Any, Any] | None = None
        self._before = np.zeros(self._m)
        self._predicted: Array | None = None
        self.disturbance = np.zeros(self._n)
        self.fallbacks = 0

    def command(self, t: float, measured: Array) -> Any:
        """The first input of the plan from the state as measured at t."""
        n, m = self._n, self._m
        names = [*map(str, self._setting.plant.outputs)]
        x = np.array([measured[names.index(str(symbol))] for symbol in self._setting.plant.states])
        if self._predicted is not None:
            self.disturbance += self._how.disturbance_gain * (x - self._predicted)
        start = np.concatenate([x, self._before])
        cold, guess = self._plan is None, self._shifted(start)
        given = self._given(t, start)
        usable = self._solved(guess, given)
        if not usable:
            self.fallbacks += 1
        elif cold and self._how.one_iteration:
            # A state at rest without inputs is no plan to go on from: a quadrotor without thrust cannot be steered.
            for _ in range(FIRST_ITERATIONS - 1):
                self._solved(np.asarray(self._plan), given)
        assert self._plan is not None
        u = self._plan[n + m:n + 2 * m].copy()
        self._before = np.clip(u, *limits_of(self._setting))
        if self._how.disturbance_gain:
            self._predicted = np.asarray(self._program.step(x, self._before)).ravel() + self.disturbance
        return u

    def _solved(self, guess: Array, given: Array) -> bool:
        """Whether the solver gave a plan from a guess; the guess stays the plan where it did not."""
        more = {} if self._multipliers is None else dict(zip(("lam_x0", "lam_g0"), self._multipliers, strict=True))
        solve = self._program.solve
        found = solve(x0=guess, p=given, **self._program.bounds, **more)
        plan = np.asarray(found["x"]).ravel()
        usable = bool(np.isfinite(plan).all()) and self._answered(solve.stats())
        self._plan = plan if usable else guess
        self._multipliers = (found["lam_x"], found["lam_g"]) if usable else None
        return usable

    def _answered(self, told: Mapping[str, Any]) -> bool:
        """Whether the solver is at its end; after one iteration it says that it has had no more."""
        return bool(told["success"]) or (self._how.one_iteration
                                         and told["return_status"] == "Maximum_Iterations_Exceeded")

    def _given(self, t: float, start: Array) -> Array:
        """The problem's parameters, as `Program` lists them."""
        times: Array = t + self._period * np.arange(self._how.horizon + 1, dtype=float)
        tracks, references = self._setting.tracks, self._setting.references
        ahead = signals_at({name: references[tracks[name]] for name in self._tracked}, times)
        desired = np.array([ahead[name][0] for name in self._tracked]).reshape(len(self._tracked), len(times))
        parts = [start, self.disturbance if self._how.disturbance_gain else np.zeros(0), desired.T.ravel()]
        if self._how.objective:
            every = signals_at(references, times)
            parts.append(np.vstack([times, *(np.array(every[name]) for name in references)]).T.ravel())
        return np.concatenate(parts)

    def _shifted(self, start: Array) -> Array:
        """The last plan moved on by a sample; at first the state as it stands."""
        N, s = self._how.horizon, self._stage
        if self._plan is None:
            stage = np.concatenate([start, np.zeros(self._m + self._excess)])
            return np.concatenate([np.tile(stage, N), start])
        moved = np.concatenate([self._plan[s:], self._plan[-(self._n + self._m):]])
        last_input = self._plan[s * (N - 1) + self._n + self._m:s * N]
        return np.concatenate([moved[:s * (N - 1) + self._n + self._m], last_input, moved[-(self._n + self._m):]])
