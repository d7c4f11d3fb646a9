"""chen2019's train driven by MPC: the same cars and limits, one trip that knows them beside those that learn."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from types import ModuleType

import numpy as np

from workbench.compile.kernel import cars_source, function_source, loop_module
from workbench.files.numbers import number
from workbench.mpc.car_model import CarTrain
from workbench.mpc.multi_car import CarWeights, MultiCarMpc
from workbench.paper.mpc_comparison import JOULE_PER_KWH, counters_words
from workbench.paper.results import ResultTable
from workbench.trains import multi_particle as of_train

from .. import laws as law
from ..simulation import held_cars_loop
from ..simulation.cars_trials import SLOPE_VALUES, VARIATION_VALUES, Array, CarsPlan
from ..simulation.held_cars_loop import HELD_COLUMNS
from .outcomes import Found, position_error, speed_error
from .record import ChenStudy
from .runs import car_data, plan


@dataclass(frozen=True)
class Beside:
    """A trip under multi-car MPC: HELD_COLUMNS by name, jerk (m/s^3), time of a step and its p99 (us), counters."""

    cars: int
    totals: dict[str, float]
    jerk: float
    step_us: float
    step_us_p99: float
    counters: dict[str, int]


@cache
def _kernel() -> ModuleType:
    pushed = (of_train.f_a,)
    return loop_module("chen2019 (1)-(3) under held forces", [
        function_source("coefficients_at", (of_train.time,), VARIATION_VALUES, of_train.varied),
        cars_source("additional_forces", (of_train.common_place,), SLOPE_VALUES, (law.CAR_STATE, law.CAR_DATA),
                    ((of_train.slope_force,),)),
        cars_source("rates", (), law.VALUES, (law.CAR_STATE, law.CAR_DATA, pushed, (of_train.u, law.Delta_u)),
                    (law.CAR_RATES,))], held_cars_loop)


def mpc_of(study: ChenStudy, desired: Array, horizon: int | None = None) -> MultiCarMpc:
    """MPC that knows the train of a study: masses, resistances, couplers and every car's limits."""
    data, rows = study.mpc, dict(zip(law.CAR_DATA, car_data(study), strict=True))
    assert data is not None
    train = study.train
    cars = CarTrain(rows[law.m], rows[law.u_low], rows[law.u_high], (
        train.c_0_n_per_kg, train.c_v_n_s_per_m_kg, train.c_a_n_s2_per_m2_kg, train.coupler_n_per_m,
        train.coupler_n_s_per_m))
    weights = CarWeights(data.position_weight, data.speed_weight, data.command_weight)
    return MultiCarMpc(cars, desired, horizon or data.horizon, data.period_s, weights, study.reference.cruise_mps)


def run_beside(study: ChenStudy, end_s: float | None = None, known: ChenStudy | None = None) -> Beside:
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
    kernel, n = _kernel().held_forces, study.train.cars
    state = np.zeros((len(law.CAR_STATE), n))
    state[:2] = of.reference[0, :2, None]
    held, totals, taken = np.zeros((2, n)), np.zeros(len(HELD_COLUMNS)), np.zeros(samples)
    log = np.zeros((-(-steps // of.log_every), n))
    fixed = _fixed(of)
    for sample in range(samples):
        before = time.thread_time()
        held[0] = mpc.command(sample, state[0], state[1])
        taken[sample] = 1e6 * (time.thread_time() - before)
        first = sample * per_sample
        kernel(first, min(per_sample, steps - first), of.period_s, of.reference, *fixed, state, np.zeros((1, n)), held,
               totals, log, of.log_every)
    return Beside(n, dict(zip(HELD_COLUMNS, totals.tolist(), strict=True)),
                  jerk_rms(log, of.log_every * of.period_s), float(np.median(taken)), float(np.percentile(taken, 99)),
                  dict(mpc.counters))


def _fixed(of: CarsPlan) -> tuple[Array, Array, bool, Array, Array]:
    values = np.array([of.values[str(x)] for x in law.VALUES])
    slope = np.array([*(of.slope_values[str(x)] for x in SLOPE_VALUES[:-1]), float(of.slope == "train")])
    means = values[: len(of_train.coefficients)]
    return values, of.cars, of.slope != "nowhere", slope, np.array([*means, of.variation["swing"],
                                                                    of.variation["beat"]])


def jerk_rms(speeds: Array, spacing_s: float) -> float:
    """RMS over all cars of the second difference of logged speeds, shape (rows, cars), m/s^3."""
    return float(np.sqrt(np.mean((np.diff(speeds, 2, axis=0) / spacing_s**2) ** 2)))


def growth(study: ChenStudy) -> tuple[Beside, ...]:
    """The beginning of the trip for trains of the lengths of which the cost of the law is measured."""
    return tuple(run_beside(study.model_copy(update={"train": study.train.model_copy(update={"cars": cars})}),
                            study.cost.end_s) for cars in study.cost.cars)


def overtaken(errors: Array, rival: float) -> int | None:
    """The trial, from 1, from which on all errors are below a rival's, None where there is none."""
    above = np.nonzero(errors >= rival)[0]
    first = int(above[-1]) + 2 if len(above) else 1
    return first if first <= len(errors) else None


def _rms(found: Found, name: str) -> Array:
    study = found.study
    whole = study.reference.trip_time_s * study.train.cars
    return np.asarray(np.sqrt(found.stated.total(f"{name}_error_square_s") / whole))


def beside_tables(found: Found, trip: Beside | None, longer: tuple[Beside, ...]) -> Iterator[ResultTable]:
    """The law's first and last trial beside MPC's trip, and what a step of both costs; nothing without MPC."""
    study = found.study
    if trip is None or study.mpc is None:
        return
    whole, run, total = study.reference.trip_time_s * study.train.cars, found.stated, trip.totals
    samples = study.samples * study.train.cars
    rows = []
    for trial in sorted({1, *study.trials.shown} & set(range(1, len(run.totals) + 1))):
        i = trial - 1
        jerk = number(jerk_rms(run.log(trial, "v_mps"), study.sampling.log_every_s)) if trial in run.logs else "—"
        rows.append((f"the law, trial {trial}", *map(number, (
            float(_rms(found, "position")[i]), float(_rms(found, "speed")[i]), float(position_error(run)[i]),
            float(speed_error(run)[i]), float(run.total("stopping_error_m")[i]),
            float(run.total("traction_work_j")[i]) / JOULE_PER_KWH)), jerk,
            number(float(run.total("coupler_stretch_m")[i])),
            number(float(run.of_cars("saturated_samples")[i].sum() / samples)), number(float(np.median(run.step_us)))))
    rows.append((MultiCarMpc.title, *map(number, (
        float(np.sqrt(total["position_error_square_s"] / whole)), float(np.sqrt(total["speed_error_square_s"] / whole)),
        total["largest_position_error_m"], total["largest_speed_error_mps"], total["stopping_error_m"],
        total["traction_work_j"] / JOULE_PER_KWH, trip.jerk, total["coupler_stretch_m"],
        total["car_steps_at_limit"] / samples, trip.step_us))))
    yield ResultTable(
        "Beside MPC", "comparison",
        ("controller", "position RMS (m)", "speed RMS (m/s)", "largest |position error| (m)",
         "largest |speed error| (m/s)", "stopping error (m)", "energy (kWh)", "jerk RMS (m/s³)", "coupler stretch (m)",
         "at a limit", "µs a step"), tuple(rows),
        f"All {study.train.cars} cars, with the same limits of every car. MPC every {study.mpc.period_s:g} s, "
        f"{study.mpc.horizon} samples ahead: {MultiCarMpc.information}; the law every {study.sampling.period_s:g} s: "
        f"full state of all cars, model unknown, earlier trials. MPC counted {counters_words([trip.counters])}.")
    yield ResultTable(
        "A step of MPC for trains of several lengths", "comparison", ("cars", "µs a step of MPC", "p99 (µs)",
                                                                     "µs a sample of the law"),
        tuple((str(one.cars), number(one.step_us), number(one.step_us_p99), number(point.step_us))
              for one, point in zip(longer, found.cost, strict=True)),
        f"The first {study.cost.end_s:g} s of the trip, {study.mpc.horizon} samples ahead.")


def beside_findings(found: Found, trip: Beside | None) -> Iterator[str]:
    """At which trial learning overtakes MPC, or that it does not."""
    if trip is None or found.stated.failed is not None:
        return
    whole = found.study.reference.trip_time_s * found.study.train.cars
    for name, unit in (("position", "m"), ("speed", "m/s")):
        ours, rival = _rms(found, name), float(np.sqrt(trip.totals[f"{name}_error_square_s"] / whole))
        trial = overtaken(ours, rival)
        words = f"overtakes MPC at trial {trial}" if trial is not None else (
            f"does not overtake MPC in {len(ours)} trials")
        yield (f"Beside multi-car MPC, which knows the train and drives it once: in {name} RMS the law {words}; its "
               f"first trial has {number(float(ours[0]))} {unit}, its last {number(float(ours[-1]))} {unit}, MPC "
               f"{number(rival)} {unit}.")
