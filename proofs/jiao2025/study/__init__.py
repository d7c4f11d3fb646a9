"""The study of jiao2025: laws that learn from trial to trial, in every reading of its units."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction

from .comparison import COMPARISON
from .findings import FINDINGS
from .plots import PLOTS
from .record import JiaoStudy
from .runs import JiaoResults, cases, name_of, run_case, run_row, track
from .tables import TABLES

KIND = Reproduction(JiaoStudy, cases, run_case, name_of, run_row, JiaoResults, TABLES, PLOTS, FINDINGS, COMPARISON,
                    track, told=lambda case: case.unit_mps2 is None).kind
