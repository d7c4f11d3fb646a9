"""The study of mao2018: five cases under the laws as printed and with their signs corrected."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction

from .comparison import COMPARISON, TRACK
from .figures import PLOTS
from .findings import FINDINGS
from .record import MaoStudy
from .runs import MaoResults, left_out, name_of, run_case, run_cases, steps_of
from .tables import TABLES

KIND = Reproduction(MaoStudy, run_cases, run_case, name_of, results=MaoResults, tables=TABLES, plots=PLOTS,
                    findings=FINDINGS, beside=COMPARISON, track=TRACK, work=steps_of, left_out=left_out).kind
