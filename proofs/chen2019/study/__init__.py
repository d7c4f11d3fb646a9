"""The study of chen2019: six cars that learn from trip to trip, by every rule of sampling, and what it depends on."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction
from workbench.paper.results import Shown
from workbench.paper.stages import Stage

from .comparison import COMPARISON, mpc_findings, mpc_tables
from .findings import all_findings
from .plots import all_plots
from .record import ChenStudy
from .runs import STATED, Results, changed, measure, run_number, run_row, title, track
from .tables import all_tables


def stages(study: ChenStudy) -> tuple[Stage, ...]:
    """The stated run and its changes, and the cost of a sample."""
    return (Stage(run_number, study, range(STATED, len(study.changes)), lambda task, _: title(study, task),
                  lambda task: changed(study, task).samples),
            Stage(measure, study, ("cost",), lambda task, _: "cost of a sample"))


def shown(results: Results) -> Shown:
    """The paper's own, and MPC's trip beside it."""
    return Shown((*all_tables(results), *mpc_tables(results)), all_plots(results),
                 (*all_findings(results), *mpc_findings(results)))


KIND = Reproduction(
    ChenStudy, stages, lambda study, runs, measured: Results(study, runs, measured["cost"]),
    lambda results: (run_row(results.study, *run) for run in results.runs.items()), shown,
    lambda results: ((title(results.study, i), one.failed) for i, one in results.runs.items() if one.failed is not None),
    COMPARISON, track).kind
