"""liu2020 on a reference: how its main controller follows one that is given, or the study's own."""

from __future__ import annotations

from dataclasses import replace

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.tracked import Tracked, of_run
from workbench.simulate.closed_loop import run_law

from .. import plant
from ..laws import LAWS
from .record import LiuStudy
from .runs import law_values, setting_of


def track(study: LiuStudy, curve: DesiredCurve | None) -> Tracked:
    """The last column of Table 2 with the signs corrected; the networks stay where the study puts them."""
    law = LAWS["liu2020.corrected"]
    setting = setting_of(study, study.runs.table_3_disturbance)
    if curve:
        setting = replace(setting, curve=curve, end_s=curve.trip_time_s)
    run = run_law(law, law_values(study, law, study.table_4_column), setting, study.sampling.period_s,
                  "explicit", plant=plant.model())
    return of_run("liu2020", replace(run, controller=f"{law.id}, Value {study.table_4_column}"), setting.curve)
