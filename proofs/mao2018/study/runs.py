"""One run of mao2018's study, and what is kept of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.model.law import ControlLaw
from workbench.paper.results import Curve
from workbench.simulate.closed_loop import Run, run_law
from workbench.simulate.metrics import measure_run

from .. import laws
from .numbers import KILONEWTON, TONNE, setting_of, values_of
from .record import CaseData, MaoStudy, Tuning

Array = NDArray[np.float64]
Signs = tuple[laws.Sign, ...]
# Points of a curve: the largest and the smallest of each of so many stretches.
STRETCHES = 1000
# What is kept in full, s.
START_S = 5.0


@dataclass(frozen=True)
class Asked:
    """A run: case (from 1), tuning, wrong signs that are mended, and which change of the study it belongs to.

    change: 0 for the study as stated, i for its i-th sensitivity; period_s, r_2_per_s and end_s replace the tuning's
    and the horizon's where they are given.
    """

    case: int
    tuning: str
    mended: Signs = ()
    change: int = 0
    period_s: float | None = None
    r_2_per_s: float | None = None
    end_s: float | None = None


@dataclass(frozen=True)
class Stretch:
    """From one event to the next: the largest |position error|, and the largest in the last seconds before the next."""

    start_s: float
    largest_m: float
    settled_m: float


@dataclass(frozen=True)
class Obtained:
    """What is kept of a run: a row of numbers, its stretches between events (those it finished), curves over time.

    name: the run in words; law: `as printed`, `corrected` or which signs are.
    """

    asked: Asked
    name: str
    law: str
    row: dict[str, Any]
    stretches: tuple[Stretch, ...]
    curves: dict[str, Curve]
    failed: str | None


def event_times(study: MaoStudy) -> tuple[float, ...]:
    """When a mode, a part of the failure or the run begins, and when it ends; s."""
    times = {mode.start_s for mode in study.modes} | {part.from_s for part in study.failure} | {study.horizon.end_s}
    return tuple(sorted(time for time in times if time <= study.horizon.end_s))


def law_of(case: CaseData, mended: Signs) -> ControlLaw:
    """The law of a case, with some of its wrong signs mended."""
    return laws.healthy if case.law == "healthy" else laws.failure_law(case.law, mended)


def tuning_of(study: MaoStudy, asked: Asked) -> Tuning:
    """The tuning of a run, with its own period and damping."""
    own = {"period_s": asked.period_s, "r_2_per_s": asked.r_2_per_s}
    return study.tunings[asked.tuning].model_copy(update={key: value for key, value in own.items() if value})


def simulate(study: MaoStudy, asked: Asked) -> Run:
    """The run itself, with its whole log."""
    changed = study.changed(study.sensitivity[asked.change - 1].set) if asked.change else study
    case, tuning = changed.cases[asked.case - 1], tuning_of(changed, asked)
    law = law_of(case, asked.mended)
    return run_law(law, values_of(law, changed, case, tuning), setting_of(changed, case, tuning, asked.end_s),
                   tuning.period_s, changed.law.estimates, title=law.title, plant=laws.train)


def obtain(study: MaoStudy, asked: Asked) -> Obtained:
    """Run and keep what tables and figures need; a run that failed has its numbers up to its end."""
    run = simulate(study, asked)
    case = study.cases[asked.case - 1]
    time, error = run.column("t_s"), run.column("s_m") - run.column("s_desired_m")
    stretches, edges = [], event_times(study)
    for start, end in pairwise(edges):
        if end > run.end_s + 1e-9 or (run.failed and end >= run.end_s):
            break
        within = np.abs(error[(time >= start) & (time < end)])
        last = np.abs(error[(time >= end - study.horizon.settled_window_s) & (time < end)])
        stretches.append(Stretch(start, float(within.max()), float(last.max())))
    curves = {"error": _curve("position error", time, error)}
    if asked.change == 0 and asked.end_s is None:
        curves |= _more_curves(study, case, run)
    which = "as printed" if case.law == "healthy" else laws.corrections(case.law, asked.mended)
    row = measure_run(run, float(study.reference.curve().length_m)).row()
    totals = run.totals
    row |= {"controller": run.controller, "case": asked.case, "tuning": asked.tuning, "law": which,
            "change": study.sensitivity[asked.change - 1].title if asked.change else None, "period_s": run.period_s,
            "end_s": run.end_s, "command_reversals_per_s": totals["command_reversals"] / max(run.end_s, run.period_s),
            "command_change_mps2": totals["command_variation_mps2"] / max(1.0, totals["commands"]),
            "loop_gain": _loop_gain(study, case, run), "failure_learned_n": _failure_learned(study, case, run)}
    row = {key: None if isinstance(value, float) and not math.isfinite(value) else value for key, value in row.items()}
    return Obtained(asked, _name(study, asked, which), which, row, tuple(stretches), curves, run.failed)


def _loop_gain(study: MaoStudy, case: CaseData, run: Run) -> float:
    """m_i k_nu rho_hat_i of the mode at the end: 1 if the estimate is right; it multiplies what they all do."""
    mode = sum(mode.start_s < run.end_s for mode in study.modes)
    failed = "failure" in case.events and run.end_s > min(part.from_s for part in study.failure)
    motors = 1 if case.law == "healthy" else study.train.motors - failed
    m = study.law.force_unit_n / (TONNE * study.train.mass_t)
    return float(m * motors * run.column(f"rho_hat_{mode}")[-1])


def _failure_learned(study: MaoStudy, case: CaseData, run: Run) -> float | None:
    """By how much the estimate of a constant failure grows while the first part of the failure lasts, N."""
    part = study.failure[0]
    if case.law == "healthy" or part.to_s is None or run.end_s < part.to_s:
        return None
    before, after = (int(np.searchsorted(run.column("t_s"), time)) - 1 for time in (part.from_s, part.to_s))
    grown = run.column("xi_hat_0")[after] - run.column("xi_hat_0")[before]
    return float(study.train.motors * study.law.force_unit_n * grown)


def _name(study: MaoStudy, asked: Asked, which: str) -> str:
    words = [f"case {asked.case}", which, study.tunings[asked.tuning].title]
    if asked.change:
        words.append(study.sensitivity[asked.change - 1].title)
    if asked.end_s is not None:
        tuning = tuning_of(study, asked)
        words.append(f"period {1e3 * tuning.period_s:g} ms, r_2 = {tuning.r_2_per_s:g}/s, until {asked.end_s:g} s")
    return ", ".join(words)


def _curve(label: str, x: Array, y: Array) -> Curve:
    """A curve whose extremes are kept where its points are thinned; it ends before what is not finite."""
    whole = int(np.argmin(np.isfinite(y))) if not np.isfinite(y).all() else len(y)
    x, y = x[:max(1, whole)], y[:max(1, whole)]
    if len(x) <= 2 * STRETCHES:
        return Curve(label, x, y)
    parts = np.array_split(np.arange(len(x)), STRETCHES)
    kept = sorted({int(part[pick(y[part])]) for part in parts for pick in (np.argmin, np.argmax)} | {0, len(x) - 1})
    return Curve(label, x[kept], y[kept])


def _more_curves(study: MaoStudy, case: CaseData, run: Run) -> dict[str, Curve]:
    """Start, distance, command and, of laws that estimate failures, the force they take the failed motor to give."""
    time = run.column("t_s")
    first = time <= START_S
    curves = {"start": _curve("start", time[first], (run.column("s_m") - run.column("s_desired_m"))[first]),
              "distance": _curve("distance", time, run.column("s_m")),
              "desired": _curve("desired distance", time, run.column("s_desired_m")),
              "command": _curve("command", time, run.column("u_mps2"))}
    if case.law != "healthy":
        varpi = np.sin(study.law.omega_rad_s * time + study.law.phase_rad)
        estimate = study.train.motors * (run.column("xi_hat_0") + run.column("xi_hat_1") * varpi)
        curves["failure"] = _curve("estimate", time, study.law.force_unit_n / KILONEWTON * estimate)
    return curves
