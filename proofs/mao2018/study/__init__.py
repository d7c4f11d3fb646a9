"""The study of mao2018: five cases under the laws as printed and with their signs corrected."""

from __future__ import annotations

from workbench.paper.comparison import (
    compared_runs,
    comparison_findings,
    comparison_plot,
    comparison_stage,
    comparison_table,
)
from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import compared_pairs, pair_findings, pair_stage, pair_table
from workbench.paper.results import StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.paper.study import Progress, StudyKind

from .comparison import DRIVERS, note, with_own_runs
from .figures import all_plots
from .findings import all_findings
from .outcomes import Results
from .record import MaoStudy
from .runs import run_case, run_cases, steps_of, track
from .tables import all_tables


def run(study: MaoStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    runs, compared, drawn = run_stages((
        Stage(run_case, study, run_cases(study), lambda _, run: run.name, lambda case: steps_of(study, case)),
        comparison_stage(DRIVERS, study), pair_stage(DRIVERS, study)), workers, on_progress)
    results = Results(study, runs)
    comparison = with_own_runs(results, compared_runs(DRIVERS, compared))
    shown = study.tuning.places[0] if study.tuning else None
    pairs = compared_pairs(DRIVERS, study, drawn)
    return StudyResult(
        rows=tuple(run.row for run in runs.values()),
        tables=(*all_tables(results),
                *comparison_table(DRIVERS, study, comparison, "case", note(study, comparison)),
                *pair_table(study, DRIVERS, pairs)),
        plots=(*all_plots(results), *comparison_plot([run for run in comparison if run.task.place == shown],
                                                     f"case {shown}")),
        findings=(*all_findings(results), *comparison_findings(DRIVERS, study, comparison),
                  *pair_findings(study, DRIVERS, pairs)),
        failures=tuple((run.name, run.failed) for run in runs.values() if run.failed))


KIND = StudyKind(MaoStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
