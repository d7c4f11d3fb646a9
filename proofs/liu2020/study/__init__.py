"""The study of liu2020: output feedback with neural observers, its ten columns of gains and three disturbances."""

from __future__ import annotations

from workbench.paper.comparison import (
    compared_runs,
    comparison_findings,
    comparison_note,
    comparison_plot,
    comparison_stage,
    comparison_table,
)
from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import compared_pairs, pair_findings, pair_stage, pair_table
from workbench.paper.results import StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.paper.study import Progress, StudyKind

from .comparison import DRIVERS, TOLD, drawn_runs
from .figures import all_plots
from .findings import all_findings
from .outcomes import Results
from .record import LiuStudy
from .runs import run_case, run_cases, run_row, title_of, track
from .tables import all_tables


def run(study: LiuStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    runs, compared, drawn = run_stages((
        Stage(run_case, study, run_cases(study), lambda case, _: title_of(study, case)),
        comparison_stage(DRIVERS, study), pair_stage(DRIVERS, study)), workers, on_progress)
    results, comparison = Results(study, runs), compared_runs(DRIVERS, compared)
    pairs, where = compared_pairs(DRIVERS, study, drawn), study.disturbances[study.runs.table_3_disturbance].title
    note = comparison_note(study, comparison, study.sampling.period_s,
                           shorter="The tuning's line is shorter than this one, see the file.")
    return StudyResult(
        rows=tuple(run_row(study, run) for run in runs.values()),
        tables=(*all_tables(results), *comparison_table(DRIVERS, study, comparison, "disturbance", note, TOLD),
                *pair_table(study, DRIVERS, pairs)),
        plots=(*all_plots(results), *comparison_plot(drawn_runs(study, comparison), where)),
        findings=(*all_findings(results), *comparison_findings(DRIVERS, study, comparison),
                  *pair_findings(study, DRIVERS, pairs)),
        failures=tuple((title_of(study, case), run.failed) for case, run in runs.items() if run.failed))


KIND = StudyKind(LiuStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
