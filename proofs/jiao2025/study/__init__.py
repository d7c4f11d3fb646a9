"""The study of jiao2025: laws that learn from trial to trial, in every reading of its units."""

from __future__ import annotations

from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import compared_pairs, pair_findings, pair_stage, pair_table
from workbench.paper.results import StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.paper.study import Progress, StudyKind

from ..simulation.mpc_trip import run_mpc
from .comparison import COMPARISON, DRIVERS, mpc_findings, mpc_table, mpc_tasks
from .findings import all_findings
from .plots import all_plots
from .record import JiaoStudy
from .runs import Results, cases, name_of, run_case, run_row, track
from .tables import all_tables


def run(study: JiaoStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    runs, of_mpc, tuned, drawn = run_stages((
        Stage(run_case, study, tuple(dict.fromkeys(cases(study))), lambda case, _: name_of(study, case)),
        Stage(run_mpc, study, mpc_tasks(study), lambda task, _: f"{task[1]}, {task[0]}"),
        COMPARISON.stage(study), pair_stage(DRIVERS, study)), workers, on_progress)
    results, trips, pairs = Results(study, runs), tuple(of_mpc.values()), compared_pairs(DRIVERS, study, drawn)
    return StudyResult(
        rows=tuple(run_row(study, case, one) for case, one in runs.items()),
        tables=(*all_tables(results), *mpc_table(results, trips), *COMPARISON.tables(study, tuned),
                *pair_table(study, DRIVERS, pairs)),
        plots=(*all_plots(results), *COMPARISON.plots(study, tuned)),
        findings=(*all_findings(results), *mpc_findings(results, trips), *COMPARISON.findings(study, tuned),
                  *pair_findings(study, DRIVERS, pairs)),
        failures=tuple((name_of(study, case), one.failed) for case, one in runs.items()
                       if one.failed is not None and case.unit_mps2 is None))


KIND = StudyKind(JiaoStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
