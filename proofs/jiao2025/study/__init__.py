"""The study of jiao2025: laws that learn from trial to trial, in every reading of its units."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction
from workbench.paper.results import Shown
from workbench.paper.stages import Stage

from ..simulation.mpc_trip import run_mpc
from .comparison import COMPARISON, mpc_findings, mpc_table, mpc_tasks
from .findings import all_findings
from .plots import all_plots
from .record import JiaoStudy
from .runs import Results, cases, name_of, run_case, run_row, track
from .tables import all_tables


def stages(study: JiaoStudy) -> tuple[Stage, ...]:
    """The laws in all readings, and MPC on all trips."""
    return (Stage(run_case, study, tuple(dict.fromkeys(cases(study))), lambda case, _: name_of(study, case)),
            Stage(run_mpc, study, mpc_tasks(study), lambda task, _: f"{task[1]}, {task[0]}"))


def shown(results: Results) -> Shown:
    """The paper's own, and MPC's trips beside it."""
    return Shown((*all_tables(results), *mpc_table(results)), all_plots(results),
                 (*all_findings(results), *mpc_findings(results)))


KIND = Reproduction(
    JiaoStudy, stages, Results, lambda results: (run_row(results.study, *run) for run in results.runs.items()), shown,
    lambda results: ((name_of(results.study, case), one.failed) for case, one in results.runs.items()
                     if one.failed is not None and case.unit_mps2 is None), COMPARISON, track).kind
