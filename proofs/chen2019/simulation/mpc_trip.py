"""chen2019's train driven by MPC of several cars: the same cars and limits, one trip in which MPC knows them."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from workbench.compile.kernel import cars_source, function_source, loop_module
from workbench.mpc.car_model import CarTrain
from workbench.mpc.multi_car import CarWeights, MultiCarMpc
from workbench.paper.learning_comparison import jerk_rms
from workbench.trains import multi_particle as of_train

from .. import laws as law
from . import held_cars_loop
from .cars_trials import SLOPE_VALUES, VARIATION_VALUES, Array, CarsPlan
from .held_cars_loop import HELD_COLUMNS
from .plans import car_data, plan

if TYPE_CHECKING:
    from ..study.record import ChenStudy


@dataclass(frozen=True)
class MpcTrip:
    """A trip under multi-car MPC: HELD_COLUMNS by name, jerk (m/s^3), time of a step and its p99 (s), counters."""

    cars: int
    totals: dict[str, float]
    jerk: float
    step_s: float
    step_s_p99: float
    counters: dict[str, int]


@cache
def held_kernel() -> ModuleType:
    """The compiled loop of the train under forces that are held."""
    pushed = (of_train.f_a,)
    return loop_module("chen2019 (1)-(3) under held forces", [
        function_source("coefficients_at", (of_train.time,), VARIATION_VALUES, of_train.varied),
        cars_source("additional_forces", (of_train.common_place,), SLOPE_VALUES, (law.CAR_STATE, law.CAR_DATA),
                    ((of_train.slope_force,),)),
        cars_source("rates", (), law.VALUES, (law.CAR_STATE, law.CAR_DATA, pushed, (of_train.u, law.Delta_u)),
                    (law.CAR_RATES,))], held_cars_loop)


def mpc_of(study: ChenStudy, desired: Array) -> MultiCarMpc:
    """MPC that knows the train of a study: masses, resistances, couplers and every car's limits."""
    data, rows = study.mpc, dict(zip(law.CAR_DATA, car_data(study), strict=True))
    assert data is not None
    train = study.train
    cars = CarTrain(rows[law.m], rows[law.u_low], rows[law.u_high], (
        train.c_0_n_per_kg, train.c_v_n_s_per_m_kg, train.c_a_n_s2_per_m2_kg, train.coupler_n_per_m,
        train.coupler_n_s_per_m))
    weights = CarWeights(data.position_weight, data.speed_weight, data.command_weight)
    return MultiCarMpc(cars, desired, data.horizon, data.period_s, weights, study.reference.cruise_mps)


def run_mpc(study: ChenStudy, end_s: float | None = None, known: ChenStudy | None = None) -> MpcTrip:
    """One trip, or its beginning until end_s, from rest at the reference's start.

    known: the study that MPC is made for, where its train is not the one that is driven.
    """
    data, of = study.mpc, plan(study)
    assert data is not None
    per_sample = round(data.period_s / of.period_s)
    steps = len(of.reference) if end_s is None else round(end_s / of.period_s)
    samples = -(-steps // per_sample)
    times = np.arange(samples + data.horizon + 2, dtype=float) * data.period_s
    mpc = mpc_of(known or study, np.stack(study.reference.curve().at(times), axis=1))
    kernel, n = held_kernel().held_forces, study.train.cars
    state = np.zeros((len(law.CAR_STATE), n))
    state[:2] = of.reference[0, :2, None]
    held, totals, taken = np.zeros((2, n)), np.zeros(len(HELD_COLUMNS)), np.zeros(samples)
    log = np.zeros((-(-steps // of.log_every), n))
    fixed = held_arguments(of)
    for sample in range(samples):
        before = time.thread_time()
        held[0] = mpc.command(sample, state[0], state[1])
        taken[sample] = time.thread_time() - before
        first = sample * per_sample
        kernel(first, min(per_sample, steps - first), of.period_s, of.reference, *fixed, state, np.zeros((1, n)), held,
               totals, log, of.log_every)
    return MpcTrip(n, dict(zip(HELD_COLUMNS, totals.tolist(), strict=True)),
                   jerk_rms(log, of.log_every * of.period_s), float(np.median(taken)),
                   float(np.percentile(taken, 99)), dict(mpc.counters))


def held_arguments(of: CarsPlan) -> tuple[Array, Array, bool, Array, Array]:
    """What of a plan the loop under held forces takes: values, cars, slopes and variation."""
    values = np.array([of.values[str(x)] for x in law.VALUES])
    slope = np.array([*(of.slope_values[str(x)] for x in SLOPE_VALUES[:-1]), float(of.slope == "train")])
    means = values[: len(of_train.coefficients)]
    return values, of.cars, of.slope != "nowhere", slope, np.array([*means, of.variation["swing"],
                                                                    of.variation["beat"]])
