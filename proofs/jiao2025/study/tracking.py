"""jiao2025 on a reference: how its main controller follows one that is given, or the study's own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.tracked import Tracked

from ..simulation.trials import TrialPlan, TrialRun, run_trials
from .cases import Case, JiaoStudy, plan


def track(study: JiaoStudy, curve: DesiredCurve | None) -> Tracked:
    """iCFDL in steps of 1 s, in which (16) asks for what trains can do; the last trial.

    The paper states no unit of u, and none of the study's readings follows (16) there: it is the one of the study's
    sweep in which the study's own reference is followed best.
    """
    every = [_jiao_plan(study, float(unit)) for unit in study.unit_sweep.units_mps2]
    made = min(every, key=lambda plan: _last_error(run_trials(plan)))
    if curve:
        _, desired, _ = curve.at(np.arange(len(made.desired), dtype=float) * made.step_s)
        places = np.concatenate(([0.0], np.cumsum(desired[:-1]))) * made.step_s
        made = replace(made, desired=desired, desired_positions=places,
                       edges=made.edges / made.edges[-1] * places[-1])
    run = run_trials(made)
    length, time_s = float(made.desired_positions[-1]), (len(made.desired) - 1) * made.step_s
    name = f"iCFDL, trial {study.trials.count}"
    if run.failed:
        return Tracked("jiao2025", name, time_s, length, None, None, math.nan, math.nan, math.nan, run.failed)
    speed, command = (run.sample(study.trials.count, column) for column in ("speed", "input"))
    error = speed - made.desired[: len(speed)]
    work = np.maximum(command * made.unit_n, 0.0) * speed * made.step_s
    return Tracked("jiao2025", name, time_s, length, None, None, float(np.abs(error).max()),
                   math.sqrt(np.mean(error**2)), float(np.nansum(work)), None)


def _jiao_plan(study: JiaoStudy, unit_mps2: float) -> TrialPlan:
    case = Case("N_1s", "jiao2025.icfdl", study.trials.seed, unit_mps2=unit_mps2)
    return replace(plan(study, case), kept=(study.trials.count,))


def _last_error(run: TrialRun) -> float:
    return math.inf if run.failed else float(run.column("mse")[-1])
