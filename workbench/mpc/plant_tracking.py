"""MPC of any plant, tracking or economic: what it is made with, and the controller that is called once a sample.

The problem itself is `plant_program.py`, what is taken for the state `plant_observer.py`. An MPC that is told of the
actuators plans from where the plant will be when its command arrives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.mpc.plant_actuators import Underway, moved, with_lags
from workbench.mpc.plant_motion import PlantMotion
from workbench.mpc.plant_observer import KalmanState, MeasuredState
from workbench.mpc.plant_program import LARGEST_RESIDUAL, program
from workbench.mpc.plant_values import PlantMpcValues
from workbench.systems.setting import Setting, first_inputs, limits_of
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

    fallbacks counts the samples at which the solver gave nothing usable; its last plan goes on there. state: what is
    taken for the plant's state, `MeasuredState` or `KalmanState`; ahead_s: how far ahead it is told the references;
    at_zero: the disturbances that its plan takes for zero, because it does not estimate them.
    """

    title = "tracking MPC"
    information = "nominal model"

    def __init__(self, how: PlantMpc, setting: Setting, period_s: float) -> None:
        how.check(setting, period_s)
        self._before = first_inputs(setting)
        self._delay = max(setting.delay_s.values(), default=0.0) if how.predictor else 0.0
        own = {*map(str, setting.plant.states)}
        setting = with_lags(setting) if how.predictor else setting
        self._how, self._setting, self._period = how, setting, period_s
        self._n, self._m = len(setting.plant.states), len(setting.plant.inputs)
        self._tracked = [name for name in setting.tracks if name in how.weights]
        self._motion = PlantMotion(how, setting)
        self._program = program(how, setting, period_s, self._tracked, self._motion)
        self._underway = Underway(self._before, period_s, self._delay)
        if how.observer:
            first = {str(x): setting.initial[str(x)] for x in setting.plant.states if str(x) not in own}
            self.state: MeasuredState | KalmanState = KalmanState(how, setting, self._motion, first)
        else:
            self.state = MeasuredState(how, setting, period_s, self._motion)
        self.ahead_s = how.horizon * period_s
        self.at_zero = tuple(str(d) for d in setting.plant.disturbances if str(d) not in how.observer)
        self._called = False
        self._excess = len(self._program.limited)
        self._stage = self._n + 2 * self._m + self._excess
        self._plan: Array | None = None
        self._multipliers: tuple[Any, Any] | None = None
        self.fallbacks = 0

    def command(self, t: float, measured: Array) -> Any:
        """The first input of the plan from what was measured at t."""
        n, m, state = self._n, self._m, self.state
        x = state.now(measured, self._underway.arrived if self._called else ())
        x = moved(self._motion, x, self._underway.ahead, state.disturbances, state.push / self._period)
        start = np.concatenate([x, self._before])
        cold, self._called = self._plan is None, True
        given = self._given(t + self._delay, start)
        self._plan, within = self._first_guess(start, given)
        usable = within and self._solved(self._plan, given)
        if not usable:
            self.fallbacks += 1
        elif cold and self._how.one_iteration:
            # A state at rest without inputs is no plan to go on from: a quadrotor without thrust cannot be steered.
            for _ in range(FIRST_ITERATIONS - 1):
                self._solved(np.asarray(self._plan), given)
        u = self._plan[n + m:n + 2 * m].copy()
        self._before = np.clip(u, *limits_of(self._setting))
        self._underway.send(self._before)
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

    def _first_guess(self, start: Array, given: Array) -> tuple[Array, bool]:
        """The last plan moved on, or what stays at rest where that is out of reach; whether this is within it."""
        guess = self._shifted(start)
        if self._begins_at(guess, given):
            return guess, True
        guess, self._multipliers = self._at_rest(start), None
        return guess, self._begins_at(guess, given)

    def _begins_at(self, guess: Array, given: Array) -> bool:
        """Whether the solver may begin with a guess; what it found itself has slopes."""
        return self._within_reach(guess, given) and (self._multipliers is not None or self._has_slopes(guess, given))

    def _within_reach(self, guess: Array, given: Array) -> bool:
        """Whether a guess misses the constraints by so little that the solver may begin with it."""
        return bool(np.abs(np.asarray(self._program.rows(guess, given))).max() < LARGEST_RESIDUAL)  # not where NaN

    def _has_slopes(self, guess: Array, given: Array) -> bool:
        """Whether the constraints have derivatives at a guess: without them a solver may look for a step endlessly."""
        return bool(np.isfinite(self._program.slopes(guess, given).nonzeros()).all())

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
        parts = [start, self.state.push if self._how.disturbance_gain else np.zeros(0), self.state.disturbances,
                 desired.T.ravel()]
        if self._how.objective:
            every = signals_at(references, times)
            parts.append(np.vstack([times, *(np.array(every[name]) for name in references)]).T.ravel())
        return np.concatenate(parts)

    def _shifted(self, start: Array) -> Array:
        """The last plan moved on by a sample; at first the state as it stands."""
        N, s = self._how.horizon, self._stage
        if self._plan is None:
            return self._at_rest(start)
        moved = np.concatenate([self._plan[s:], self._plan[-(self._n + self._m):]])
        last_input = self._plan[s * (N - 1) + self._n + self._m:s * N]
        return np.concatenate([moved[:s * (N - 1) + self._n + self._m], last_input, moved[-(self._n + self._m):]])

    def _at_rest(self, start: Array) -> Array:
        """The plan in which the state stays as it stands, without inputs."""
        stage = np.concatenate([start, np.zeros(self._m + self._excess)])
        return np.concatenate([np.tile(stage, self._how.horizon), start])
