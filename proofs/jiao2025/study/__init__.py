"""The study of jiao2025: laws that learn from trial to trial, in every reading of its units."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction
from workbench.paper.stages import Stage

from ..simulation.mpc_trip import run_mpc
from .comparison import COMPARISON, mpc_findings, mpc_table, mpc_tasks
from .findings import FINDINGS
from .plots import PLOTS
from .record import JiaoStudy
from .runs import JiaoResults, cases, name_of, run_case, run_row, track
from .tables import TABLES


def mpc_trips(study: JiaoStudy) -> tuple[Stage, ...]:
    """MPC on all trips."""
    return (Stage(run_mpc, study, mpc_tasks(study), lambda task, _: f"{task[1]}, {task[0]}"),)


KIND = Reproduction(
    JiaoStudy, cases, run_case, name_of, run_row, JiaoResults, (*TABLES, mpc_table), PLOTS, (*FINDINGS, mpc_findings),
    COMPARISON, track, stages=mpc_trips, told=lambda case: case.unit_mps2 is None).kind
