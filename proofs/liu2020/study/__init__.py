"""The study of liu2020: output feedback with neural observers, its ten columns of gains and three disturbances."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction

from .comparison import COMPARISON, TRACK
from .figures import PLOTS
from .findings import FINDINGS
from .record import LiuStudy
from .runs import LiuResults, left_out, run_case, run_cases, title_of
from .tables import TABLES

REPRODUCTION = Reproduction(LiuStudy, run_cases, run_case, title_of, results=LiuResults, tables=TABLES, plots=PLOTS,
                            findings=FINDINGS, beside=COMPARISON, track=TRACK, left_out=left_out)
KIND = REPRODUCTION.kind
