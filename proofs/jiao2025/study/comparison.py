"""jiao2025's laws beside MPC, which knows the train and drives it once: as stated, and both tuned with one budget."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from workbench.mpc.controller import KINDS
from workbench.paper.cells import Column, Phrase
from workbench.paper.comparison import STEP
from workbench.paper.drivers import MPC_NAMES, MPC_TITLES, Drivers, keys_in
from workbench.paper.learning_comparison import LearningComparison, jerk_rms
from workbench.paper.mpc_comparison import MPC_KINDS, counters_words
from workbench.paper.results import ResultTable
from workbench.paper.statistics import ahead_from
from workbench.simulate.closed_loop import NOMINAL, Factors

from ..laws import TRIAL_LAWS
from ..simulation.mpc_trip import MpcTrip, run_mpc
from ..simulation.plans import Case, plan_on
from ..simulation.trials import TrialRun, run_trials
from .record import JiaoStudy
from .runs import PRINTED_LAWS, JiaoResults, outcome

LAW_NAMES = {law.partition(".")[2]: law for law in PRINTED_LAWS}
TITLES = {name: TRIAL_LAWS[law].title for name, law in LAW_NAMES.items()} | MPC_TITLES
STARTS = ("first_input", "first_estimate")
COLUMNS = {"speed_rms": Column("speed RMS", "m/s"), "largest_mps": Column("largest |speed error|", "m/s"),
           "jerk_rms": Column("jerk RMS", "m/s³"), "step_s": STEP}


def keys(study: JiaoStudy, name: str) -> dict[str, str]:
    """Learning parameters of a law, and what it starts from, which the laws share."""
    return keys_in("learning", (*map(str, TRIAL_LAWS[LAW_NAMES[name]].parameters), *STARTS))


def drive(study: JiaoStudy, name: str, place: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """One run in a reading: MPC's only trip, or all trials of a law, of which the last is measured."""
    if name in MPC_NAMES:
        trip = run_mpc(study, (place, MPC_NAMES[name]), factors)
        return {"failed": None, "speed_rms": trip.mse**0.5, "jerk_rms": trip.jerk, "logged_jerk_rms": trip.jerk,
                "largest_mps": trip.largest_mps, "step_s": trip.step_s}
    last = study.trials.count
    made = replace(plan_on(study, Case(place, LAW_NAMES[name], study.trials.seed), factors), kept=(last,))
    run = run_trials(made)
    row = {"failed": run.failed, "step_s": run.step_us * 1e-6}
    if run.failed is not None:
        return row
    trials, jerk = np.sqrt(run.mse), jerk_rms(run.sample(last, "speed"), made.step_s)
    return row | {"speed_rms": float(trials[-1]), "trials": {"speed_rms": trials},
                  "jerk_rms": jerk, "logged_jerk_rms": jerk,  # every sample is logged
                  "largest_mps": float(run.column("largest_error")[-1])}


def places(study: JiaoStudy) -> dict[str, str]:
    """The readings in few words, as conditions of a comparison are called."""
    return {name: reading.condition for name, reading in study.readings.items()}


DRIVERS = Drivers(TITLES, places, keys, drive, first_trial=0)
COMPARISON = LearningComparison(DRIVERS, COLUMNS, ("speed_rms",), "reading")


def _of_trip(study: JiaoStudy, reading: str) -> tuple[float, float]:
    """What of a reading MPC's trip depends on; the unit of u is none of it."""
    return study.readings[reading].step_s, study.readings[reading].k_per_sample


def mpc_tasks(study: JiaoStudy) -> list[tuple[str, str]]:
    """Every kind on every trip that differs; none where the file states no MPC."""
    trips = {_of_trip(study, name): name for name in reversed(study.readings)}
    return [(name, kind) for name in study.readings if name in trips.values() for kind in MPC_KINDS
            ] if study.mpc else []


def _ahead_from(run: TrialRun, trip: MpcTrip) -> int | None:
    return ahead_from(run.mse, trip.mse, 0) if run.failed is None else None


def _overtaken(rival: float, trial: int | None, ended: bool) -> Phrase:
    if trial is None and ended:
        return Phrase("{}: no", (rival,))
    return Phrase("{}: {}" if trial is None else "{}: trial {}", (rival, trial))


def _rivals(results: JiaoResults, reading: str) -> list[MpcTrip]:
    trip = _of_trip(results.study, reading)
    return [one for one in results.of_mpc.values() if _of_trip(results.study, one.reading) == trip]


def mpc_table(results: JiaoResults) -> Iterator[ResultTable]:
    """A row per reading and law: what is learned, MPC's error, and the trial that is ahead of it."""
    if not results.of_mpc or results.study.mpc is None:
        return
    rows = []
    for name, reading in results.study.readings.items():
        rivals = _rivals(results, name)
        for law in PRINTED_LAWS:
            run = results.run(name, law)
            listed, ended = ", ".join("{}" for _ in rivals), run.failed is None
            rows.append((
                reading.title, TRIAL_LAWS[law].title, run.mse[-1] if ended else outcome(run),
                *(_overtaken(trip.mse, _ahead_from(run, trip), ended) for trip in rivals),
                Phrase(listed, tuple(trip.jerk for trip in rivals)),
                Phrase(listed, tuple(trip.step_s for trip in rivals)), run.step_us * 1e-6))
    titles = [KINDS[kind].title for kind in MPC_KINDS]
    yield ResultTable(
        "Beside MPC: at which trial learning overtakes it", "comparison",
        ("reading", "law", "MSE, last trial", *(f"{title}, MSE: overtaken" for title in titles),
         Column("jerk RMS of MPC", "m/s³"), Column("a step of MPC", "µs", 1e-6),
         Column("a sample of the law", "µs", 1e-6)), tuple(rows),
        f"In m²/s². No: not within {results.study.trials.count} trials. MPC drives the same train once, at T_s, "
        f"{results.study.mpc.horizon} samples ahead: {KINDS[MPC_KINDS[0]].information}; the laws: speeds of earlier "
        "trials, model unknown. Neither has limits. MPC counted "
        f"{counters_words([one.counters for one in results.of_mpc.values()])}.")


def mpc_findings(results: JiaoResults) -> Iterator[str]:
    """How often and when each law overtakes each kind of MPC."""
    for law in PRINTED_LAWS if results.of_mpc else ():
        finish = [name for name in results.study.readings if results.run(name, law).failed is None]
        words = []
        for kind in MPC_KINDS:
            when = [_ahead_from(results.run(name, law), trip) for name in finish
                    for trip in _rivals(results, name) if trip.kind == kind]
            ahead = sorted(trial for trial in when if trial is not None)
            words.append(f"{KINDS[kind].title} in {len(ahead)}" + (
                f" (at trials {', '.join(map(str, ahead))})" if ahead else ""))
        yield (f"Beside MPC, which knows the train and drives it once: {TRIAL_LAWS[law].title} finishes in "
               f"{len(finish)} of {len(results.study.readings)} readings and overtakes {' and '.join(words)} of them "
               f"within {results.study.trials.count} trials.")
