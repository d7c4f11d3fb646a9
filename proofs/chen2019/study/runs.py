"""The runs of chen2019's study by the number of their change, and what counts as learning in them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.findings import LackingError
from workbench.paper.learning_comparison import jerk_rms, rises
from workbench.paper.reproduced import STATED, Results, RunCase
from workbench.paper.reproduction import case_title
from workbench.paper.stages import Stage
from workbench.paper.tracked import Tracked

from ..simulation.cars_loop import TRIAL_COLUMNS
from ..simulation.cars_runs import LANES, run_cars, run_together
from ..simulation.cars_trials import Array, CarsPlan, CarsRun
from ..simulation.mpc_trip import MpcTrip, run_mpc
from ..simulation.plans import plan
from .record import ChenChange, ChenStudy

MEASURING = "cost"
# By what factor the largest error has to come back to be said to grow again.
AGAIN = 1.02


@dataclass(frozen=True)
class Measured:
    """What is measured with nothing beside it: MPC's trip where the study has one, and what a sample costs.

    sample_s: cars of a train -> time of a sample, s; longer: MPC on the beginning of the trip with such trains.
    """

    sample_s: Mapping[int, float]
    trip: MpcTrip | None
    longer: tuple[MpcTrip, ...]

    @property
    def by_length(self) -> Mapping[int, float]:
        """`sample_s` of trains of several lengths; LackingError where a short report measures the study's own alone."""
        if len(self.sample_s) < 2:
            raise LackingError
        return self.sample_s

    @property
    def exponent(self) -> float:
        """The power of the number of cars with which the time of a sample grows, by least squares of logarithms."""
        times = self.by_length
        return float(np.polyfit(np.log(list(times)), np.log(list(times.values())), 1)[0])


@dataclass(frozen=True)
class ChenResults(Results[ChenStudy, RunCase, CarsRun]):
    """The runs, and what is measured beside them, by the one task of that stage."""

    of_measuring: Mapping[str, Measured]

    @property
    def measured(self) -> Measured:
        """What is measured with nothing beside it."""
        return self.of_measuring[MEASURING]

    @property
    def stated(self) -> CarsRun:
        """The run as stated."""
        return self.runs[RunCase()]

    def group(self, name: str) -> list[tuple[ChenChange, CarsRun]]:
        """The runs of a group of changes."""
        return self.under(lambda change: change.group == name)

    def with_more_trials(self) -> list[tuple[int, CarsRun]]:
        """Runs that differ by the number of their trials alone, with it."""
        return [(change.set["trials.count"], run) for change, run in self.changed_runs("trials.count")]

    @property
    def lacks_more_trials(self) -> bool:
        """Whether a short report has left such runs out."""
        return any(self.study.leaves_out(change) for change in self.study.changes if [*change.set] == ["trials.count"])

    @property
    def motors_and_trailers(self) -> tuple[list[int], list[int]]:
        """Motor cars and trailers, counted from 0."""
        motors = [car for car in range(self.study.train.cars) if self.study.train.has_motor(car)]
        return motors, [car for car in range(self.study.train.cars) if car not in motors]


def plan_of(study: ChenStudy, case: RunCase) -> CarsPlan:
    """The stated study or one of its changes; those about what else is assumed leave no log."""
    made = plan(study.changed(case.change))
    logged = case.change == STATED or study.changes[case.change].group == "rules"
    return made if logged else replace(made, kept=())


def run_case(study: ChenStudy, case: RunCase) -> CarsRun:
    """Run the stated study or one of its changes."""
    return run_cars(plan_of(study, case))


def run_cases_together(study: ChenStudy, cases: Sequence[RunCase]) -> list[CarsRun]:
    """The same for several."""
    return run_together([plan_of(study, case) for case in cases])


def groups(study: ChenStudy, cases: Sequence[RunCase]) -> list[list[RunCase]]:
    """Cases whose loops are alike, twice as many as run side by side; what is one run but for its length together."""
    alike: dict[tuple[object, ...], list[RunCase]] = {}
    for case in sorted(cases, key=lambda case: (-study.changed(case.change).trials.count, case.change)):
        of = study.changed(case.change)
        loop = of.sampling.acceleration, of.sampling.memory, of.line.seen_by == "nowhere", of.samples
        alike.setdefault(loop, []).append(case)
    return [among[first : first + 2 * LANES] for among in alike.values() for first in range(0, len(among), 2 * LANES)]


def measure(study: ChenStudy, _: object) -> Measured:
    """Time per sample of trains of several lengths, MPC's trip, and its beginning with such trains, one by one.

    Where a short report leaves the table of cost out, of the study's own train alone.
    """
    lengths = (study.train.cars,) if study.leaves_out(study.cost) else study.cost.cars
    trains = {cars: study.model_copy(update={"train": study.train.model_copy(update={"cars": cars})})
              for cars in lengths}
    sample_s = {}
    for cars, longer in trains.items():
        whole = plan(longer)
        short = replace(whole, reference=whole.reference[: round(study.cost.end_s / study.sampling.period_s)],
                        trials=study.cost.trials, kept=())
        sample_s[cars] = float(run_cars(short).step_us.min()) * 1e-6
    if study.mpc is None:
        return Measured(sample_s, None, ())
    trip, others = run_mpc(study), () if study.leaves_out(study.cost) else trains.values()
    return Measured(sample_s, trip, tuple(run_mpc(one, study.cost.end_s) for one in others))


def measuring(study: ChenStudy) -> tuple[Stage, ...]:
    """The cost of a sample."""
    return (Stage(measure, study, (MEASURING,), lambda task, _: "cost of a sample"),)


def grows_from(errors: Array) -> int | None:
    """The trial with the least error, when it came back by more than AGAIN until the last one; else None."""
    if len(errors) == 0 or not errors[-1] > AGAIN * errors.min():
        return None
    return int(np.argmin(errors)) + 1


def outcome(run: CarsRun) -> str:
    """What became of a run, in a few words."""
    if run.failed is not None:
        why = "no unique acceleration" if "unique" in run.failed else "diverges"
        return f"trial {len(run.totals) + 1}: {why}"
    turns = [turn for turn in map(grows_from, (run.position_error, run.speed_error, run.difference)) if turn]
    if turns:
        return f"grows again from trial {min(turns)} on"
    return "falls" if rises(run.position_error) + rises(run.speed_error) == 0 else "falls, not in every trial"


def trip_row(study: ChenStudy, total: Mapping[str, float], at_limit: float, jerk: float | None, step_s: float
             ) -> dict[str, Any]:
    """A trip by the sums over all cars that both loops keep; at_limit: in how many samples a car was at a limit."""
    whole = study.reference.trip_time_s * study.train.cars
    return {"failed": None, "position_rms": math.sqrt(total["position_error_square_s"] / whole),
            "speed_rms": math.sqrt(total["speed_error_square_s"] / whole),
            "largest_position_error": total["largest_position_error_m"],
            "largest_speed_error": total["largest_speed_error_mps"], "stopping_error": total["stopping_error_m"],
            "energy_J": total["traction_work_j"], "logged_jerk_rms": jerk, "stretch_m": total["coupler_stretch_m"],
            "at_limit": at_limit / (study.samples * study.train.cars), "step_s": step_s}


def trial_row(study: ChenStudy, run: CarsRun, trial: int) -> dict[str, Any]:
    """A finished trial of a run, from 1; its jerk where it was logged."""
    i = trial - 1
    total = {name: float(run.total(name)[i]) for name in TRIAL_COLUMNS} | {
        "largest_position_error_m": float(run.position_error[i]), "largest_speed_error_mps": float(run.speed_error[i])}
    jerk = jerk_rms(run.log(trial, "v_mps"), study.sampling.log_every_s) if trial in run.logs else None
    return trip_row(study, total, float(run.of_cars("saturated_samples")[i].sum()), jerk,
                    1e-6 * float(np.median(run.step_us)))


def run_row(study: ChenStudy, case: RunCase, run: CarsRun) -> dict[str, Any]:
    """A run as data, of its last trial; SI units, over all cars; None for what one that failed does not have."""
    of, ended = study.changed(case.change), run.failed is None
    last = trial_row(of, run, len(run.totals)) if ended else {}
    ends = {f"{name}_error_{end}": float(getattr(run.of_cars(f"{name}_error_{end}")[-1], end)()) if ended else None
            for name in ("position", "speed") for end in ("min", "max")}
    return {"controller": f"chen2019.{of.sampling.acceleration}", "run": case_title(study, case),
            "memory": of.sampling.memory, "period_s": of.sampling.period_s, "trials": len(run.totals), **ends,
            **{key: last.get(key) for key in ("position_rms", "speed_rms", "stopping_error", "energy_J")},
            "saturated_fraction": last.get("at_limit"),
            "difference_max_N": float(run.difference[-1]) if ended else None,
            "position_error_first": float(run.position_error[0]) if ended else None,
            "position_error_last": float(run.position_error[-1]) if ended else None,
            "speed_error_first": float(run.speed_error[0]) if ended else None, "outcome": outcome(run),
            "step_us_median": float(np.median(run.step_us)), "failed": run.failed}


def track(study: ChenStudy, curve: DesiredCurve | None) -> Tracked:
    """The stated run on a reference, its own where curve is None; the last of its trials."""
    curve = curve or study.reference.curve()
    times = np.arange(study.samples, dtype=float) * study.sampling.period_s
    run = run_cars(replace(plan(study), reference=np.stack(curve.at(times), axis=1), kept=()))
    last = trial_row(study, run, study.trials.count) if run.failed is None else {}
    position, position_rms, speed, speed_rms, work = (float(last.get(key, math.nan)) for key in (
        "largest_position_error", "position_rms", "largest_speed_error", "speed_rms", "energy_J"))
    return Tracked(study.paper, "AILC" if run.failed else f"AILC, trial {study.trials.count}", curve.trip_time_s,
                   curve.length_m, position, position_rms, speed, speed_rms, work, run.failed)
