"""MPC of any plant, tracking or economic: what it is made with, and the controller that is called once a sample.

The problem itself is `plant_program.py`. With a disturbance gain a filter estimates, for each measured state, the
constant push a sample that the model does not foresee: d <- d + gain (measured - predicted), the disturbance model of
offset-free MPC (Pannocchia and Rawlings, AIChE Journal 49, 2003) where every state is measured.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from workbench.mpc.plant_program import program
from workbench.systems.setting import Setting, limits_of
from workbench.systems.signals import signals_at

Array = NDArray[np.float64]
Solver = Literal["fatrop", "ipopt"]
MOST_STAGES = 1000


@dataclass(frozen=True)
class PlantMpc:
    """What an MPC of a plant is made with, by names; ValueError for what is none.

    horizon: samples it looks ahead; weights: of outputs that the setting lets track a reference, per unit squared;
    terminal_weight: how many times that at the end; input_weights: of u minus its target; change_weights: of u's change
    from sample to sample; objective: of the setting's metrics, what they add to what is minimised (economic MPC);
    rate_limits: of an input, per second; excess_price: of a limited state's excess, per unit and per unit squared;
    disturbance_gain: of the filter that makes constant errors vanish, at most 1, none where 0; substeps: Runge-Kutta
    steps a sample. solver: fatrop, or ipopt, which knows no structure; both to convergence. one_iteration: one
    quadratic program a sample, along the last plan, instead.
    """

    horizon: int
    weights: Mapping[str, float] = field(default_factory=dict)
    input_weights: Mapping[str, float] = field(default_factory=dict)
    change_weights: Mapping[str, float] = field(default_factory=dict)
    input_targets: Mapping[str, float] = field(default_factory=dict)
    rate_limits: Mapping[str, float] = field(default_factory=dict)
    terminal_weight: float = 1.0
    excess_price: float = 1e3
    substeps: int = 1
    solver: Solver = "fatrop"
    objective: Mapping[str, float] = field(default_factory=dict)
    disturbance_gain: float = 0.0
    one_iteration: bool = False

    def __post_init__(self) -> None:
        if not 1 <= self.horizon <= MOST_STAGES or self.substeps < 1:
            raise ValueError(f"horizon = {self.horizon}, substeps = {self.substeps}: give 1 to {MOST_STAGES} samples "
                             "and at least one step")
        if self.solver not in get_args(Solver):
            raise ValueError(f"solver '{self.solver}' is not known: it is one of {', '.join(get_args(Solver))}")
        for key in ("weights", "input_weights", "change_weights", "rate_limits"):
            for name, value in getattr(self, key).items():
                if not (math.isfinite(value) and value >= 0):
                    raise ValueError(f"{key}.{name} = {value}: give a number that is not negative")
        if not self.weights and not self.objective:
            raise ValueError("weights and objective are empty: state weights of tracked outputs, or of metrics")
        if not 0 <= self.disturbance_gain <= 1:
            raise ValueError(f"disturbance_gain = {self.disturbance_gain}: give a number from 0 to 1")
        for name in self.input_weights if self.disturbance_gain else ():
            raise ValueError(f"input_weights.{name}: pulls away from the desired output, which disturbance_gain is to "
                             "reach exactly: take change_weights")
        if self.one_iteration and (self.objective or self.solver != "fatrop"):
            raise ValueError("one_iteration needs a sum of squares and fatrop: leave out objective and solver")

    def check(self, setting: Setting) -> None:
        """ValueError unless the plant measures all its states and has what is named."""
        plant = setting.plant
        for state in plant.states:
            if plant.outputs.get(state) != state:
                raise ValueError(f"MPC needs every state of plant '{plant.id}', and '{state}' is not measured: make it "
                                 "an output")
        for name in self.weights:
            if name not in setting.tracks:
                raise ValueError(f"weights.{name}: no reference is tracked by that output: state tracks.{name}")
        inputs = [*map(str, plant.inputs)]
        for key in ("input_weights", "change_weights", "rate_limits", "input_targets"):
            for name in getattr(self, key):
                if name not in inputs:
                    raise ValueError(f"{key}.{name}: plant '{plant.id}' has no such input: name one of "
                                     f"{', '.join(inputs) or 'none'}")
        metrics = {metric.id: metric.measure for metric in setting.every_metric}
        for name, weight in self.objective.items():
            if metrics.get(name) in (None, "largest", "smallest") or not math.isfinite(weight):
                known = [one for one, measure in metrics.items() if measure not in ("largest", "smallest")]
                raise ValueError(f"objective.{name} = {weight}: give a number for a metric that is integrated or taken "
                                 f"at the end: {', '.join(known) or 'none is stated'}")

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
        guess = self._shifted(start)
        more = {} if self._multipliers is None else dict(zip(("lam_x0", "lam_g0"), self._multipliers, strict=True))
        solve = self._program.solve
        found = solve(x0=guess, p=self._given(t, start), **self._program.bounds, **more)
        plan = np.asarray(found["x"]).ravel()
        usable = np.isfinite(plan).all() and self._answered(solve.stats())
        if not usable:
            self.fallbacks += 1
        self._plan = plan if usable else guess
        self._multipliers = (found["lam_x"], found["lam_g"]) if usable else None
        u = self._plan[n + m:n + 2 * m].copy()
        self._before = np.clip(u, *limits_of(self._setting))
        if self._how.disturbance_gain:
            self._predicted = np.asarray(self._program.step(x, self._before)).ravel() + self.disturbance
        return u

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
