"""The study of mao2018: five cases under the laws as printed and with their signs corrected."""

from __future__ import annotations

from workbench.paper.reproduction import Reproduction
from workbench.paper.results import Shown
from workbench.paper.stages import Stage

from .comparison import COMPARISON
from .figures import all_plots
from .findings import all_findings
from .outcomes import Results
from .record import MaoStudy
from .runs import run_case, run_cases, steps_of, track
from .tables import all_tables


def stages(study: MaoStudy) -> tuple[Stage, ...]:
    """Every case under its laws in every tuning, and what is varied."""
    return (Stage(run_case, study, run_cases(study), lambda _, run: run.name, lambda case: steps_of(study, case)),)


KIND = Reproduction(
    MaoStudy, stages, Results, lambda results: (run.row for run in results.runs.values()),
    lambda results: Shown(all_tables(results), all_plots(results), all_findings(results)),
    lambda results: ((run.name, run.failed) for run in results.runs.values() if run.failed), COMPARISON, track).kind
