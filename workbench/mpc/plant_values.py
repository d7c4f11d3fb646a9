"""What an MPC of any plant is made with: horizon, weights, limits and solver, by names."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np

from workbench.model.law import time
from workbench.systems.metric import UNPLANNED
from workbench.systems.setting import Setting, first_inputs
from workbench.systems.symbols import is_finite, named_values, plain, written

Solver = Literal["fatrop", "ipopt"]
MOST_STAGES = 1000
LONGEST = 2.0  # a Runge-Kutta step in time constants: from 2.8 on what decays would grow
NOT_NEGATIVE = ("weights", "input_weights", "change_weights", "rate_limits", "observer", "first_spread")


@dataclass(frozen=True)
class PlantMpcValues:
    """What an MPC of a plant is made with, by names; ValueError for what is none.

    horizon: samples it looks ahead; weights: of outputs that the setting lets track a reference, per unit squared;
    terminal_weight: how many times that at the end; input_weights: of u minus its target; change_weights: of u's change
    from sample to sample; objective: of the setting's metrics, what they add to what is minimised (economic MPC);
    rate_limits: of an input, per second; excess_price: of a limited state's excess, per unit and per unit squared;
    disturbance_gain: of the filter that makes constant errors vanish, at most 1, none where 0; substeps: Runge-Kutta
    steps a sample. solver: fatrop, or ipopt, which knows no structure; both to convergence. Where a root,
    logarithm or divisor of the plant may come to the edge of its domain, or an exponential overflow, ipopt takes the
    place of fatrop, with bounded steps. one_iteration: one
    quadratic program a sample, along the last plan, instead, and some at the first one. observer: of states and
    disturbances, the standard deviation of what moves them beyond the model in a second; an extended Kalman filter then
    estimates the state, and the named disturbances, from the outputs. It begins at first_estimate (where none is given
    at the first measurement of a state that is an output, else at zero) with the standard deviation first_spread (that
    of a second where none is given). predictor: it is told of the inputs' lags and delays.
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
    observer: Mapping[str, float] = field(default_factory=dict)
    first_estimate: Mapping[str, float] = field(default_factory=dict)
    first_spread: Mapping[str, float] = field(default_factory=dict)
    predictor: bool = False

    def __post_init__(self) -> None:
        for key in (*NOT_NEGATIVE, "input_targets", "objective", "first_estimate"):
            table = {str(name): plain(value) for name, value in named_values(getattr(self, key), key).items()}
            object.__setattr__(self, key, table)
        whole = all(isinstance(n, int | np.integer) and not isinstance(n, bool) for n in (self.horizon, self.substeps))
        if not whole or not 1 <= self.horizon <= MOST_STAGES or self.substeps < 1:
            raise ValueError(f"horizon = {self.horizon}, substeps = {self.substeps}: give whole numbers, "
                             f"1 to {MOST_STAGES} samples and at least one step")
        if self.solver not in get_args(Solver):
            raise ValueError(f"solver '{self.solver}' is not known: it is one of {', '.join(get_args(Solver))}")
        for key in ("terminal_weight", "excess_price", "disturbance_gain"):
            object.__setattr__(self, key, plain(getattr(self, key)))
        sizes = {f"{key}.{name}": value for key in NOT_NEGATIVE for name, value in getattr(self, key).items()}
        for where, value in {**sizes, "terminal_weight": self.terminal_weight,
                             "excess_price": self.excess_price}.items():
            if not (is_finite(value) and value >= 0):
                raise ValueError(f"{where} = {written(value)}: give a finite number that is not negative")
        for name, value in self.input_targets.items():
            if not is_finite(value):
                raise ValueError(f"input_targets.{name} = {written(value)}: give a finite number")
        if not self.weights and not self.objective:
            raise ValueError("weights and objective are empty: state weights of tracked outputs, or of metrics")
        if not (is_finite(self.disturbance_gain) and 0 <= self.disturbance_gain <= 1):
            raise ValueError(f"disturbance_gain = {written(self.disturbance_gain)}: give a number from 0 to 1")
        self._check_observer()
        for name in self.input_weights if self.disturbance_gain else ():
            raise ValueError(f"input_weights.{name}: pulls away from the desired output, which disturbance_gain is to "
                             "reach exactly: take change_weights")
        if self.one_iteration and (self.objective or self.solver != "fatrop"):
            raise ValueError("one_iteration needs a sum of squares and fatrop: leave out objective and solver")

    def _check_observer(self) -> None:
        if self.disturbance_gain and self.observer:
            raise ValueError("disturbance_gain is for plants all of whose states are measured: name disturbances in "
                             "observer instead")
        for key in ("first_estimate", "first_spread") if not self.observer else ():
            if getattr(self, key):
                raise ValueError(f"{key} is for an observer: state observer, or leave it out")

    def check(self, setting: Setting, period_s: float) -> None:
        """ValueError unless the plant has what is named and, without an observer, measures all its states."""
        plant = setting.plant
        if not plant.inputs:
            raise ValueError(f"MPC has nothing to command: plant '{plant.id}' has no input")
        for state, move in zip(plant.states, plant.moves, strict=True):
            if move.has(time):
                raise ValueError(f"MPC plans with a plant that does not change with time, and '{state}' of plant "
                                 f"'{plant.id}' moves by the clock: make what depends on it a disturbance")
        for state in () if self.observer else plant.states:
            if plant.outputs.get(state) != state:
                raise ValueError(f"MPC needs every state of plant '{plant.id}', and '{state}' is not measured: make it "
                                 f"an output, or state observer, as {{ {state} = 1.0 }}, to estimate it")
        self._check_estimates(setting)
        self._check_substeps(setting, period_s)
        self._check_actuators(setting, period_s)
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
            if metrics.get(name) in (None, *UNPLANNED) or not is_finite(weight):
                known = [one for one, measure in metrics.items() if measure not in UNPLANNED]
                raise ValueError(f"objective.{name} = {written(weight)}: give a number for a metric that is integrated "
                                 f"or taken at the end: {', '.join(known) or 'none is stated'}")

    def _check_estimates(self, setting: Setting) -> None:
        """ValueError for what is no state and no disturbance of the plant."""
        plant = setting.plant
        states, disturbances = [*map(str, plant.states)], [*map(str, plant.disturbances)]
        for key in ("observer", "first_estimate", "first_spread"):
            for name, value in getattr(self, key).items():
                if name not in (*states, *disturbances):
                    raise ValueError(f"{key}.{name}: plant '{plant.id}' has no such state and no such disturbance: "
                                     f"name one of {', '.join((*states, *disturbances))}")
                if not is_finite(value):
                    raise ValueError(f"{key}.{name} = {value}: give a finite number")
                if name in disturbances and name not in self.observer:
                    raise ValueError(f"{key}.{name}: the disturbance is not estimated: state observer.{name}")

    def _check_substeps(self, setting: Setting, period_s: float) -> None:
        """ValueError where the plant, as it starts, has a pole that Runge-Kutta steps as long as these make grow."""
        if setting.plant.updates:
            return
        try:
            A = setting.plant.jacobians({**setting.initial, **_inputs(setting)}, setting.parameters)[0]
        except ValueError:  # no linear plant there, so nothing is known of it
            return
        pole = float(abs(np.linalg.eigvals(A)).max())
        least = math.ceil(pole * period_s / LONGEST)
        if self.substeps < least:
            raise ValueError(f"plant '{setting.plant.id}' starts with a time constant of {1 / pole:.3g} s, too short "
                             f"for {self.substeps} Runge-Kutta step{'s' * (self.substeps > 1)} in the period of "
                             f"{period_s:g} s: give substeps = {least} or more")

    def _check_actuators(self, setting: Setting, period_s: float) -> None:
        """ValueError for actuators that the predictor cannot be told of."""
        if not self.predictor:
            return
        delays = {str(u): setting.delay_s.get(str(u), 0.0) for u in setting.plant.inputs}
        if len(set(delays.values())) > 1:
            told = ", ".join(f"{u} {delay:g} s" for u, delay in delays.items())
            raise ValueError(f"predictor: the inputs' delays differ, {told}: make them equal, or leave predictor out")
        for name, lag in setting.lag_s.items() if not setting.plant.updates else ():
            least = math.ceil(period_s / (LONGEST * lag)) if lag else 1
            if self.substeps < least:
                raise ValueError(f"predictor: the lag of {name}, {lag:g} s, is too short for {self.substeps} Runge-"
                                 f"Kutta steps in {period_s:g} s: give {least} substeps or more")


def _inputs(setting: Setting) -> dict[str, float]:
    """The inputs before the first command by their names."""
    return {str(u): float(value) for u, value in zip(setting.plant.inputs, first_inputs(setting), strict=True)}
