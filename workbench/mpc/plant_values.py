"""What an MPC of any plant is made with: horizon, weights, limits and solver, by names."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args

from workbench.systems.setting import Setting
from workbench.systems.symbols import named_values

Solver = Literal["fatrop", "ipopt"]
MOST_STAGES = 1000


@dataclass(frozen=True)
class PlantMpcValues:
    """What an MPC of a plant is made with, by names; ValueError for what is none.

    horizon: samples it looks ahead; weights: of outputs that the setting lets track a reference, per unit squared;
    terminal_weight: how many times that at the end; input_weights: of u minus its target; change_weights: of u's change
    from sample to sample; objective: of the setting's metrics, what they add to what is minimised (economic MPC);
    rate_limits: of an input, per second; excess_price: of a limited state's excess, per unit and per unit squared;
    disturbance_gain: of the filter that makes constant errors vanish, at most 1, none where 0; substeps: Runge-Kutta
    steps a sample. solver: fatrop, or ipopt, which knows no structure; both to convergence. one_iteration: one
    quadratic program a sample, along the last plan, instead, and some at the first one.
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
        for key in ("weights", "input_weights", "change_weights", "input_targets", "rate_limits", "objective"):
            table = {str(name): value for name, value in named_values(getattr(self, key), key).items()}
            object.__setattr__(self, key, table)
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
        if not plant.inputs:
            raise ValueError(f"MPC has nothing to command: plant '{plant.id}' has no input")
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
