"""mao2018 on a reference: how its main controller follows one that is given, or the study's own."""

from __future__ import annotations

from dataclasses import replace

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.tracked import Tracked, of_run
from workbench.simulate.closed_loop import run_law

from ..laws import train
from .numbers import setting_of, values_of
from .record import MaoStudy
from .runs import law_of


def track(study: MaoStudy, curve: DesiredCurve | None) -> Tracked:
    """The healthy train of case 1 under the first tuning."""
    case, tuning = study.cases[0], next(iter(study.tunings.values()))
    setting = setting_of(study, case, tuning)
    setting = replace(setting, curve=curve or setting.curve)
    law = law_of(case, ())
    run = run_law(law, values_of(law, study, case, tuning), setting, tuning.period_s,
                  study.law.estimates, title=law.title, plant=train)
    return of_run("mao2018", replace(run, controller=law.id), setting.curve)
