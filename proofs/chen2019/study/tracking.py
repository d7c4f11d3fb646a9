"""chen2019 on a reference: how its main controller follows one that is given, or the study's own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.tracked import Tracked

from ..simulation.cars_trials import run_cars
from . import runs
from .record import ChenStudy


def track(study: ChenStudy, curve: DesiredCurve | None) -> Tracked:
    """The stated run; the last of its trials."""
    curve = curve or study.reference.curve()
    times = np.arange(study.samples, dtype=float) * study.sampling.period_s
    plan = replace(runs.plan(study), reference=np.stack(curve.at(times), axis=1), kept=())
    run = run_cars(plan)
    if run.failed:
        nan = math.nan
        return Tracked("chen2019", "AILC", curve.trip_time_s, curve.length_m, nan, nan, nan, nan, nan, run.failed)
    whole = study.reference.trip_time_s * study.train.cars

    def largest(name: str) -> float:
        return float(max(np.abs(run.of_cars(f"{name}_error_{end}")[-1]).max() for end in ("min", "max")))

    def rms(name: str) -> float:
        return math.sqrt(run.total(f"{name}_error_square_s")[-1] / whole)

    return Tracked("chen2019", f"AILC, trial {plan.trials}", curve.trip_time_s, curve.length_m, largest("position"),
                   rms("position"), largest("speed"), rms("speed"), float(run.total("traction_work_j")[-1]), None)
