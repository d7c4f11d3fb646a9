"""The study of chen2019: six cars that learn from trip to trip, by every rule of sampling, and what it depends on."""

from __future__ import annotations

from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import compared_pairs, pair_findings, pair_stage, pair_table
from workbench.paper.results import StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.paper.study import Progress, StudyKind

from .comparison import COMPARISON, DRIVERS, mpc_findings, mpc_tables, stated_tasks, with_stated
from .findings import all_findings
from .plots import all_plots
from .record import ChenStudy
from .runs import STATED, Results, changed, measure, run_number, run_row, title, track
from .tables import all_tables


def run(study: ChenStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that ends early is told and stops no other."""
    runs, measured, tuned, drawn = run_stages((
        Stage(run_number, study, range(STATED, len(study.changes)), lambda task, _: title(study, task),
              lambda task: changed(study, task).samples),
        Stage(measure, study, ("cost",), lambda task, _: "cost of a sample"),
        COMPARISON.stage(study, stated_tasks(study)), pair_stage(DRIVERS, study)), workers, on_progress)
    results, pairs = Results(study, runs, measured["cost"]), compared_pairs(DRIVERS, study, drawn)
    rows = with_stated(results, tuned)
    return StudyResult(
        rows=tuple(run_row(study, i, one) for i, one in runs.items()),
        tables=(*all_tables(results), *mpc_tables(results), *COMPARISON.tables(study, rows),
                *pair_table(study, DRIVERS, pairs)),
        plots=(*all_plots(results), *COMPARISON.plots(study, rows)),
        findings=(*all_findings(results), *mpc_findings(results), *COMPARISON.findings(study, rows),
                  *pair_findings(study, DRIVERS, pairs)),
        failures=tuple((title(study, i), one.failed) for i, one in runs.items() if one.failed is not None))


KIND = StudyKind(ChenStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
