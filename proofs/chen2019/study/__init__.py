"""The study of chen2019: six cars that learn from trip to trip, by every rule of sampling, and what it depends on."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction
from workbench.paper.stages import Stage, Together

from .comparison import COMPARISON, mpc_findings, mpc_tables
from .findings import FINDINGS
from .plots import PLOTS
from .record import ChenStudy
from .runs import (
    MEASURING,
    ChenResults,
    groups,
    measure,
    run_case,
    run_cases,
    run_cases_together,
    run_row,
    title,
    track,
)
from .tables import TABLES


def measuring(study: ChenStudy) -> tuple[Stage, ...]:
    """The cost of a sample."""
    return (Stage(measure, study, (MEASURING,), lambda task, _: "cost of a sample"),)


KIND = Reproduction(
    ChenStudy, run_cases, run_case, title, run_row, ChenResults, (*TABLES, mpc_tables), PLOTS,
    (*FINDINGS, mpc_findings), COMPARISON, track, stages=measuring,
    together=Together(run_cases_together, groups)).kind
