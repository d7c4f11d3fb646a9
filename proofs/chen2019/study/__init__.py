"""The study of chen2019: six cars that learn from trip to trip, by every rule of sampling, and what it depends on."""

from __future__ import annotations

from workbench.paper.reproduced import stated_and_changed
from workbench.paper.reproduction import Reproduction
from workbench.paper.stages import Together

from .comparison import COMPARISON
from .findings import FINDINGS
from .plots import PLOTS
from .record import ChenStudy
from .runs import ChenResults, groups, measuring, run_case, run_cases_together, run_row, track
from .tables import TABLES

KIND = Reproduction(
    ChenStudy, stated_and_changed, run_case, row=run_row, results=ChenResults, tables=TABLES,
    plots=PLOTS, findings=FINDINGS, beside=COMPARISON, track=track, stages=measuring,
    together=Together(run_cases_together, groups)).kind
