"""A run of a train of several cars that learns from trial to trial: what it needs, what it leaves, its compiled loop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import cars_source, function_source, loop_module
from workbench.compile.lanes import kernel_head
from workbench.trains import multi_particle as of_train

from .. import laws as law
from . import cars_loop
from .cars_loop import CAR_COLUMNS, COMPUTED, LOG_COLUMNS, TRIAL_COLUMNS

Array = NDArray[np.float64]

# Where slopes are met: nowhere, where the reference is (so that they are a function of time alone), or where each car
# is itself.
SLOPE_SEEN = ("nowhere", "reference", "train")
# The estimates of a sample are corrected by the errors of that sample, or by those of the next.
MEMORY_RULES = ("same_sample", "next_sample")
SLOPE_VALUES = (of_train.grade, of_train.wave, of_train.gravity, of_train.own)
VARIATION_VALUES = (*of_train.coefficients, of_train.swing, of_train.beat)


@dataclass(frozen=True)
class CarsPlan:
    """All that a run needs, in SI units.

    acceleration: one of ACCELERATION_RULES; memory: one of MEMORY_RULES; slope: one of SLOPE_SEEN. reference: position,
    speed and acceleration of every sample, shape (samples, 3); cars: rows by CAR_DATA, shape (6, cars); values: by the
    names of the symbols of `laws.VALUES`; slope_values, variation: grade, wave and g, and swing and
    beat, by name. start: first value of (lambda_1, lambda_2) of every car in every trial. kept: numbers of the trials
    (from 1) that are logged, one row in log_every samples.
    """

    acceleration: str
    memory: str
    slope: str
    reference: Array
    period_s: float
    cars: Array
    values: Mapping[str, float]
    slope_values: Mapping[str, float]
    variation: Mapping[str, float]
    start: tuple[float, float]
    trials: int
    kept: tuple[int, ...]
    log_every: int


@dataclass(frozen=True)
class CarsRun:
    """What a run left.

    totals: (finished trials, TRIAL_COLUMNS); by_car: (finished trials, CAR_COLUMNS, cars); logs: by trial, shape
    (rows, LOG_COLUMNS, cars). failed: why it ended early, else None. step_us: time of a sample of all cars, train and
    law together, in every trial that began, compiling left out, of runs side by side that of all; memory_bytes: what
    the learned estimates take.
    """

    totals: Array
    by_car: Array
    logs: dict[int, Array]
    failed: str | None
    step_us: Array
    memory_bytes: int

    def first(self, plan: CarsPlan) -> CarsRun:
        """What the run of a plan leaves that ends after fewer trials, or keeps fewer."""
        whole = len(self.totals) >= plan.trials
        return CarsRun(self.totals[: plan.trials], self.by_car[: plan.trials],
                       {trial: log for trial, log in self.logs.items() if trial in plan.kept},
                       None if whole else self.failed, self.step_us[: plan.trials], self.memory_bytes)

    @property
    def position_error(self) -> Array:
        """Largest position error of all cars, trial by trial, m."""
        return np.maximum(-self.of_cars("position_error_min"), self.of_cars("position_error_max")).max(axis=1)

    @property
    def speed_error(self) -> Array:
        """Largest speed error of all cars, trial by trial, m/s."""
        return np.maximum(-self.of_cars("speed_error_min"), self.of_cars("speed_error_max")).max(axis=1)

    @property
    def difference(self) -> Array:
        """Largest |Delta u| of all cars, trial by trial, N."""
        return self.of_cars("difference_max").max(axis=1)

    def rms(self, name: str, seconds: float) -> Array:
        """RMS of the `position` or `speed` errors over so many seconds of all cars together, trial by trial."""
        return np.asarray(np.sqrt(self.total(f"{name}_error_square_s") / seconds))

    def total(self, name: str) -> Array:
        """One of TRIAL_COLUMNS, trial by trial."""
        return self.totals[:, TRIAL_COLUMNS.index(name)]

    def of_cars(self, name: str) -> Array:
        """One of CAR_COLUMNS, shape (finished trials, cars)."""
        return self.by_car[:, CAR_COLUMNS.index(name)]

    def log(self, trial: int, name: str) -> Array:
        """One of LOG_COLUMNS of a kept trial, shape (rows, cars)."""
        return self.logs[trial][:, LOG_COLUMNS.index(name)]


@cache
def kernel(acceleration: str, lanes: int) -> ModuleType:
    """The compiled loop of so many trains under the law with a rule for the acceleration."""
    sample = law.control_sample(acceleration)
    pushed = (of_train.f_a,)
    return loop_module("chen2019 (1)-(3), (8)-(22)", [
        kernel_head(lanes),
        function_source("coefficients_at", (of_train.time,), VARIATION_VALUES, of_train.varied),
        cars_source("additional_forces", (of_train.common_place,), SLOPE_VALUES, (law.CAR_STATE, law.CAR_DATA),
                    ((of_train.slope_force,),)),
        cars_source("control", law.CONTROL_SCALARS, law.VALUES,
                    (law.CAR_STATE, law.CAR_DATA, pushed, (law.v_dot_used,), law.memory_prev, law.memory_old),
                    (tuple(sample.computed[name] for name in COMPUTED), sample.kept), sample.shared),
        cars_source("rates", (), law.VALUES, (law.CAR_STATE, law.CAR_DATA, pushed, (of_train.u, law.Delta_u)),
                    (law.CAR_RATES,)),
    ], cars_loop)
