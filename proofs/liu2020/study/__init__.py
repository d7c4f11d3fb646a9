"""The study of liu2020: output feedback with neural observers, its ten columns of gains and three disturbances."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction
from workbench.paper.results import Shown
from workbench.paper.stages import Stage

from .comparison import COMPARISON
from .figures import all_plots
from .findings import all_findings
from .outcomes import Results
from .record import LiuStudy
from .runs import run_case, run_cases, run_row, title_of, track
from .tables import all_tables


def stages(study: LiuStudy) -> tuple[Stage, ...]:
    """The laws in all columns, and under the changes."""
    return (Stage(run_case, study, run_cases(study), lambda case, _: title_of(study, case)),)


KIND = Reproduction(
    LiuStudy, stages, Results, lambda results: (run_row(results.study, run) for run in results.runs.values()),
    lambda results: Shown(all_tables(results), all_plots(results), all_findings(results)),
    lambda results: ((title_of(results.study, case), run.failed) for case, run in results.runs.items() if run.failed),
    COMPARISON, track).kind
