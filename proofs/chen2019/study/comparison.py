"""chen2019's law beside MPC of several cars, which knows the train and drives it once: as stated, and both tuned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from workbench.files.units import KWH_J
from workbench.mpc.multi_car import MultiCarMpc
from workbench.paper.cells import Column
from workbench.paper.comparison import STEP
from workbench.paper.drivers import Drivers, keys_in
from workbench.paper.learning_comparison import LearningComparison, Task
from workbench.simulate.closed_loop import NOMINAL, Factors

from .. import laws
from ..simulation.cars_runs import run_together
from ..simulation.cars_trials import CarsRun
from ..simulation.mpc_trip import MpcTrip, run_mpc
from ..simulation.plans import plan
from .record import ChenStudy
from .runs import ChenResults, trial_row, trip_row

LAW, MPC, PLACE = "law", "mpc_multi_car", "trip"
WEIGHTS = ("position_weight", "speed_weight", "command_weight")
COLUMNS = {
    "position_rms": Column("position RMS", "m"), "speed_rms": Column("speed RMS", "m/s"),
    "largest_position_error": Column("largest |position error|", "m"),
    "largest_speed_error": Column("largest |speed error|", "m/s"), "stopping_error": Column("stopping error", "m"),
    "energy_J": Column("energy", "kWh", KWH_J), "logged_jerk_rms": Column("jerk RMS of the log", "m/s³"),
    "stretch_m": Column("coupler stretch", "m"), "at_limit": Column("share of samples at a limit"), "step_s": STEP}


def places(study: ChenStudy) -> dict[str, str]:
    """There is one trip."""
    return {PLACE: "the train"}


def keys(study: ChenStudy, name: str) -> dict[str, str]:
    """The law's gains and learning gains, or the weights of MPC of several cars."""
    gains = map(str, (*laws.gains, *laws.learning_gains))
    return keys_in("gains", gains) if name == LAW else keys_in("mpc", WEIGHTS)


def driven(study: ChenStudy, factors: Factors) -> ChenStudy:
    """The study whose train's masses and coefficients of resistance differ by factors; bounds stay as they are."""
    train = study.train
    return study.model_copy(update={"train": train.model_copy(update={
        "car_mass_kg": train.car_mass_kg * factors.mass, "c_0_n_per_kg": train.c_0_n_per_kg * factors.davis_a,
        "c_v_n_s_per_m_kg": train.c_v_n_s_per_m_kg * factors.davis_b,
        "c_a_n_s2_per_m2_kg": train.c_a_n_s2_per_m2_kg * factors.davis_c})})


def drive(study: ChenStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """MPC's only trip, or all trials of the law, of which the last is measured, on the train of `driven`."""
    return drive_together(study, name, place, (factors,))[0]


def drive_together(study: ChenStudy, name: str, place: str, factors: Sequence[Factors]) -> list[dict[str, Any]]:
    """The same on several trains."""
    trains = [driven(study, of) for of in factors]
    if name == MPC:
        return [mpc_row(study, run_mpc(train, known=study)) for train in trains]
    runs = run_together([replace(plan(train), kept=(train.trials.count,)) for train in trains])
    return [law_row(train, run) for train, run in zip(trains, runs, strict=True)]


def mpc_row(study: ChenStudy, trip: MpcTrip) -> dict[str, Any]:
    """A trip under MPC."""
    return trip_row(study, trip.totals, trip.totals["car_steps_at_limit"], trip.jerk, trip.step_s) | {
        "counters": trip.counters}


def law_row(study: ChenStudy, run: CarsRun) -> dict[str, Any]:
    """The last trial of a run and its first, and its errors trial by trial; of one that failed only why."""
    if run.failed is not None:
        return {"failed": run.failed, "step_s": 1e-6 * float(np.median(run.step_us))}
    whole = study.reference.trip_time_s * study.train.cars
    return trial_row(study, run, len(run.totals)) | {
        "first": trial_row(study, run, 1) | {"step_s": None},  # it is that of all trials
        "trials": {f"{name}_rms": run.rms(name, whole) for name in ("position", "speed")}}


def _step(results: ChenResults) -> dict[str, float | None]:
    """The time of a sample with nothing beside it; None for a train whose is not measured."""
    return {"step_s": results.measured.sample_s.get(results.study.train.cars)}


def stated_tasks(study: ChenStudy) -> list[Task]:
    """What the comparison need not run again: the law as stated where its last trial is logged, and MPC's trip."""
    logged = study.trials.count in study.trials.shown
    return [*([(PLACE, LAW, False)] if logged else []), *([(PLACE, MPC, False)] if study.mpc else [])]


def stated_rows(results: ChenResults) -> dict[Task, Mapping[str, Any]]:
    """The rows of `stated_tasks`."""
    study, trip = results.study, results.measured.trip
    law: dict[Task, Mapping[str, Any]] = {(PLACE, LAW, False): law_row(study, results.stated) | _step(results)}
    return law | ({(PLACE, MPC, False): mpc_row(study, trip)} if trip else {})


def note(study: ChenStudy) -> str:
    """Who samples how often and knows what."""
    return (f"All {study.train.cars} cars, with the same limits of every car. MPC every {study.mpc.period_s:g} s, "
            f"{study.mpc.horizon} samples ahead: {MultiCarMpc.information}; the law every {study.sampling.period_s:g} s: "
            "full state of all cars, model unknown, earlier trials.") if study.mpc else ""


DRIVERS = Drivers({LAW: "the law", MPC: MultiCarMpc.title}, places, keys, drive, drive_together=drive_together)
COMPARISON = LearningComparison(DRIVERS, COLUMNS, ("position_rms", "speed_rms"), own_tasks=stated_tasks,
                                own_rows=stated_rows, note=note)
