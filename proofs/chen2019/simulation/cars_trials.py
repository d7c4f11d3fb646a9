"""Runs of a train of several cars that learns from trial to trial: what a run needs, and what it leaves."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import cars_source, function_source, loop_module
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
# A command beyond it is no longer one: the limits of a car are some 10^4 N.
MOST_COMMAND_N = 1e9
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
    law together, in every trial that began, compiling left out; memory_bytes: what the learned estimates take.
    """

    totals: Array
    by_car: Array
    logs: dict[int, Array]
    failed: str | None
    step_us: Array
    memory_bytes: int

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
def _kernel(acceleration: str) -> ModuleType:
    """The compiled loop of the train under the law with a rule for the acceleration."""
    sample = law.control_sample(acceleration)
    pushed = (of_train.f_a,)
    return loop_module("chen2019 (1)-(3), (8)-(22)", [
        function_source("coefficients_at", (of_train.time,), VARIATION_VALUES, of_train.varied),
        cars_source("additional_forces", (of_train.common_place,), SLOPE_VALUES, (law.CAR_STATE, law.CAR_DATA),
                    ((of_train.slope_force,),)),
        cars_source("control", law.CONTROL_SCALARS, law.VALUES,
                    (law.CAR_STATE, law.CAR_DATA, pushed, (law.v_dot_used,), law.memory_prev, law.memory_old),
                    (tuple(sample.computed[name] for name in COMPUTED), sample.kept), sample.shared),
        cars_source("rates", (), law.VALUES, (law.CAR_STATE, law.CAR_DATA, pushed, (of_train.u, law.Delta_u)),
                    (law.CAR_RATES,)),
    ], cars_loop)


def run_cars(plan: CarsPlan) -> CarsRun:
    """Run all trials of a plan; one that diverges, or whose loop has no solution, ends the run, which then says where.

    Raises KeyError for an unknown rule of the acceleration or a missing value, ValueError for another unknown rule.
    """
    for rule, known in ((plan.memory, MEMORY_RULES), (plan.slope, SLOPE_SEEN)):
        if rule not in known:
            raise ValueError(f"there is no rule '{rule}': choose one of {', '.join(known)}")
    samples, count = len(plan.reference), plan.cars.shape[1]
    memory, shared = np.zeros((samples, 3, count)), np.zeros((samples, 3))
    memory[:, 2] = plan.cars[law.CAR_DATA.index(law.m_low)]  # (22): M_hat_0
    start = np.zeros((len(law.CAR_STATE), count))
    start[:2] = plan.reference[0, :2, None]  # Assumption 3
    start[2:] = np.array(plan.start)[:, None]
    values = np.array([plan.values[str(x)] for x in law.VALUES])
    slope = np.array([*(plan.slope_values[str(x)] for x in SLOPE_VALUES[:-1]), float(plan.slope == "train")])
    variation = np.array([*values[: len(of_train.coefficients)], plan.variation["swing"], plan.variation["beat"]])
    held = np.zeros((len(COMPUTED), count))
    kernel = _kernel(plan.acceleration).trial

    def one(reference: Array, totals: Array, by_car: Array, log: Array) -> tuple[int, int, int]:
        found: tuple[int, int, int] = kernel(
            reference, plan.period_s, plan.memory == "next_sample", start, values, plan.cars, plan.slope != "nowhere",
            slope, variation, memory, shared, held, totals, by_car, log, plan.log_every, MOST_COMMAND_N)
        return found

    # No sample at all, so that compiling and loading are not timed.
    one(plan.reference[:0], np.zeros(len(TRIAL_COLUMNS)), np.zeros((len(CAR_COLUMNS), count)), np.zeros((0, 0, 0)))
    totals, by_car, logs, failed, step_us = [], [], {}, None, []
    for trial in range(1, plan.trials + 1):
        total, of_cars = np.zeros(len(TRIAL_COLUMNS)), np.zeros((len(CAR_COLUMNS), count))
        rows = -(-samples // plan.log_every) if trial in plan.kept else 0
        log = np.zeros((rows, len(LOG_COLUMNS), count))
        started = time.perf_counter()
        status, sample, car = one(plan.reference, total, of_cars, log)
        step_us.append((time.perf_counter() - started) * 1e6 / max(sample, 1))
        if status != cars_loop.RUNNING:
            failed = _why(plan, trial, status, sample, car, held)
            break
        totals.append(total)
        by_car.append(of_cars)
        if rows:
            logs[trial] = log
    return CarsRun(
        np.array(totals).reshape(-1, len(TRIAL_COLUMNS)),
        np.array(by_car).reshape(-1, len(CAR_COLUMNS), count), logs, failed, np.array(step_us),
        memory.nbytes + shared.nbytes)


def _why(plan: CarsPlan, trial: int, status: int, sample: int, car: int, held: Array) -> str:
    """Where and how a run ended early."""
    where = f"chen2019 (16), trial {trial}, t = {sample * plan.period_s:.3f} s, car {car + 1}"
    room, command = held[COMPUTED.index("room"), car], held[COMPUTED.index("mu"), car]
    if status == cars_loop.NO_SOLUTION:
        return (f"{where}: the acceleration is not unique: the estimate of the mass exceeds the mass by "
                f"{1 / plan.values['c_3'] - room:.3g} kg, 1/c_3 is {1 / plan.values['c_3']:.3g} kg")
    return f"{where}: the command diverged: mu = {command:.3g} N, z_2 = {held[COMPUTED.index('z_2'), car]:.3g} m/s"
