"""chen2019's law and multi-car MPC with one tuning budget: the whole trip, as stated and as tuned."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from workbench.files.numbers import NOTHING, number
from workbench.mpc.multi_car import MultiCarMpc
from workbench.paper.drivers import Drivers, entries, tuning_words
from workbench.paper.mpc_comparison import JOULE_PER_KWH, best_words
from workbench.paper.results import Curve, Plot, ResultTable
from workbench.simulate.closed_loop import NOMINAL, Factors

from .. import laws as paper
from ..simulation.cars_trials import CarsRun, run_cars
from .mpc_comparison import Beside, jerk_rms, overtaken, run_beside
from .outcomes import position_error, speed_error
from .record import ChenStudy
from .runs import plan

LAW, MPC = "law", "mpc_multi_car"
TITLES = {LAW: "the law", MPC: MultiCarMpc.title}
WEIGHTS = ("position_weight", "speed_weight", "command_weight")
PLACE = "trip"
WHERE = {PLACE: "the train"}
ERRORS = ("position_rms", "speed_rms")
UNITS = {"position_rms": "m", "speed_rms": "m/s"}
HEADER = {"position_rms": "position RMS (m)", "speed_rms": "speed RMS (m/s)",
          "largest_position_error": "largest |position error| (m)",
          "largest_speed_error": "largest |speed error| (m/s)",
          "stopping_error": "stopping error (m)", "energy_kwh": "energy (kWh)", "jerk_rms": "jerk RMS (m/s³)",
          "stretch_m": "coupler stretch (m)", "at_limit": "at a limit", "step_us": "µs a step"}

# (controller, whether it is tuned)
Task = tuple[str, bool]
Rows = Sequence[tuple[Task, Mapping[str, Any]]]


def places(study: ChenStudy) -> tuple[str, ...]:
    """There is one trip."""
    return (PLACE,)


def stated(study: ChenStudy, name: str) -> dict[str, float]:
    """The law's gains and learning gains, or the weights of MPC of several cars."""
    if name == LAW:
        return {str(key): float(getattr(study.gains, str(key))) for key in (*paper.gains, *paper.learning_gains)}
    return {key: float(getattr(study.mpc, key)) for key in WEIGHTS}


def given(study: ChenStudy, name: str, values: Mapping[str, float]) -> ChenStudy:
    """The study with other gains or weights."""
    if name == LAW:
        return study.model_copy(update={"gains": study.gains.model_copy(update=dict(values))})
    assert study.mpc is not None
    return study.model_copy(update={"mpc": study.mpc.model_copy(update=dict(values))})


def true_train(study: ChenStudy, factors: Factors) -> ChenStudy:
    """The study with another train: its cars' masses and the coefficients of resistance; bounds stay as they are."""
    train = study.train
    changes = {"car_mass_kg": train.car_mass_kg * factors.mass, "c_0_n_per_kg": train.c_0_n_per_kg * factors.davis_a,
               "c_v_n_s_per_m_kg": train.c_v_n_s_per_m_kg * factors.davis_b,
               "c_a_n_s2_per_m2_kg": train.c_a_n_s2_per_m2_kg * factors.davis_c}
    return study.model_copy(update={"train": train.model_copy(update=changes)})


def drive(study: ChenStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """MPC's only trip, or all trials of the law, of which the last is measured."""
    true = true_train(study, factors)
    if name == LAW:
        return _of_law(true)
    return mpc_row(study, run_beside(true, known=study))


def mpc_row(study: ChenStudy, trip: Beside) -> dict[str, Any]:
    """A trip under MPC."""
    total, whole = trip.totals, study.reference.trip_time_s * study.train.cars
    return {"failed": None, "position_rms": (total["position_error_square_s"] / whole) ** 0.5,
            "speed_rms": (total["speed_error_square_s"] / whole) ** 0.5,
            "largest_position_error": total["largest_position_error_m"],
            "largest_speed_error": total["largest_speed_error_mps"], "stopping_error": total["stopping_error_m"],
            "energy_kwh": total["traction_work_j"] / JOULE_PER_KWH, "jerk_rms": trip.jerk,
            "stretch_m": total["coupler_stretch_m"],
            "at_limit": total["car_steps_at_limit"] / (study.samples * study.train.cars), "step_us": trip.step_us}


def _of_law(study: ChenStudy) -> dict[str, Any]:
    return law_row(study, run_cars(replace(plan(study), kept=(study.trials.count,))))


def law_row(study: ChenStudy, run: CarsRun) -> dict[str, Any]:
    """The last trial of a run, which is logged, and its errors trial by trial; of one that failed only why."""
    row: dict[str, Any] = {"failed": run.failed, "step_us": float(np.median(run.step_us))}
    if run.failed is not None:
        return row
    last, whole = study.trials.count, study.reference.trip_time_s * study.train.cars
    trials = {f"{name}_rms": np.sqrt(run.total(f"{name}_error_square_s") / whole) for name in ("position", "speed")}
    return row | {name: float(values[-1]) for name, values in trials.items()} | {
        "trials": trials, "largest_position_error": float(position_error(run)[-1]),
        "largest_speed_error": float(speed_error(run)[-1]),
        "stopping_error": float(run.total("stopping_error_m")[-1]),
        "energy_kwh": float(run.total("traction_work_j")[-1]) / JOULE_PER_KWH,
        "jerk_rms": jerk_rms(run.log(last, "v_mps"), study.sampling.log_every_s),
        "stretch_m": float(run.total("coupler_stretch_m")[-1]),
        "at_limit": float(run.of_cars("saturated_samples")[-1].sum() / (study.samples * study.train.cars))}


DRIVERS = Drivers(TITLES, places, stated, given, drive)


def stated_rows(study: ChenStudy, run: CarsRun, trip: Beside | None) -> dict[Task, dict[str, Any]]:
    """Rows of what has run already, as stated."""
    of_law = {(LAW, False): law_row(study, run)} if run.failed is not None or study.trials.count in run.logs else {}
    return of_law | ({(MPC, False): mpc_row(study, trip)} if trip else {})


def tuned_tasks(study: ChenStudy) -> tuple[Task, ...]:
    """Every controller, as stated and as tuned, on the whole trip."""
    return entries(study, DRIVERS)


def run_tuned(study: ChenStudy, task: Task) -> tuple[Task, dict[str, Any]]:
    """The run of a task."""
    name, tuned = task
    return task, drive(DRIVERS.tuned(study, name) if tuned else study, name, PLACE)


def title_of(name: str, tuned: bool) -> str:
    """A controller as tables have it."""
    return TITLES[name] + (", tuned" if tuned else "")


def tuned_table(study: ChenStudy, runs: Rows) -> Iterator[ResultTable]:
    """A row per controller, stated and tuned; nothing without tuning."""
    if not runs or study.tuning is None:
        return
    rows = []
    for (name, tuned), row in runs:
        words = [number(row.get(key)) if row["failed"] is None or key == "step_us" else NOTHING for key in HEADER]
        if row["failed"] is not None:
            words[0] = "fails"
        ahead = [_ahead(row, dict(runs).get((MPC, tuned)), metric) for metric in ERRORS]
        rows.append((title_of(name, tuned), *words, *ahead))
    yield ResultTable(
        "Beside MPC, stated and tuned", "comparison",
        ("controller", *HEADER.values(), "ahead of MPC in position RMS from", "in speed RMS from"), tuple(rows),
        f"Of the law the last of {study.trials.count} trials. {tuning_words(study.tuning)} The tuning's runs are "
        "shorter than this one, see the file. The law is held against MPC in the same state, stated or tuned.")


def _ahead(row: Mapping[str, Any], rival: Mapping[str, Any] | None, metric: str) -> str:
    if rival is None or "trials" not in row:
        return NOTHING
    trial = overtaken(row["trials"][metric], rival[metric])
    return "no trial" if trial is None else f"trial {trial}"


def tuned_findings(study: ChenStudy, runs: Rows) -> Iterator[str]:
    """Who is best, stated and tuned, and when the learner gets ahead."""
    for tuned in (False, True):
        rows = [(TITLES[name], row) for (name, state), row in runs if state == tuned]
        if not rows:
            continue
        best = "; ".join(f"{best_words(rows, metric, what)} {unit}" for metric, what, unit in (
            ("position_rms", "position RMS", "m"), ("speed_rms", "speed RMS", "m/s"),
            ("jerk_rms", "jerk RMS", "m/s³")))
        learned, of = [], {name: row for (name, state), row in runs if state == tuned}
        for metric in ERRORS if LAW in of and MPC in of and "trials" in of[LAW] else ():
            trial = overtaken(of[LAW]["trials"][metric], of[MPC][metric])
            learned.append(f"in {metric.removesuffix('_rms')} RMS the law is ahead of MPC " + (
                f"from trial {trial} on" if trial is not None else f"in none of its {study.trials.count} trials"))
        yield f"{'Tuned' if tuned else 'As stated'}: {best}" + (f"; {', '.join(learned)}" if learned else "") + "."


def tuned_plots(study: ChenStudy, runs: Rows) -> Iterator[Plot]:
    """RMS errors along the trials, stated and tuned, and MPC's as level lines."""
    for metric in ERRORS if runs else ():
        curves = []
        for (name, tuned), row in runs:
            if row["failed"] is None:
                errors = row["trials"][metric] if "trials" in row else np.full(2, row[metric])
                curves.append(Curve(title_of(name, tuned), np.linspace(1.0, study.trials.count, len(errors)), errors))
        if curves:
            what = metric.removesuffix("_rms")
            yield Plot(f"Learning beside MPC, {what}, stated and tuned", "not in the paper", "trial",
                       f"{what} RMS ({UNITS[metric]})", tuple(curves), "MPC drives once: level lines.", log_y=True)
