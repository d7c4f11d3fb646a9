"""The study of liu2020: output feedback with neural observers, its ten columns of gains and three disturbances."""

from __future__ import annotations

from typing import Any

from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import drawn_rows, pair_findings, pair_table, pair_tasks, pairs_of
from workbench.paper.results import StudyResult
from workbench.paper.study import Progress, StudyKind
from workbench.simulate.process_pool import results_of

from .cases import Found, cases, title_of
from .drivers import DRIVERS
from .findings import all_findings
from .mpc_comparison import beside_findings, beside_plots, beside_table, beside_tasks, run_one
from .plots import all_plots
from .record import LiuStudy
from .runs import Outcome, run_case
from .tables import all_tables
from .tracking import track

ROW = ("position_m_min", "position_m_max", "speed_mps_min", "speed_mps_max", "position_m", "speed_mps", "s_tilde_m",
       "v_tilde_mps", "energy_J", "energy_both_J", "input_n_min", "input_n_max", "reversals")
# The names of `workbench compare`, where it has one.
NAMES = {"position_m_min": "position_error_min", "position_m_max": "position_error_max",
         "speed_mps_min": "speed_error_min", "speed_mps_max": "speed_error_max", "position_m": "position_rms",
         "speed_mps": "speed_rms", "s_tilde_m": "s_tilde_rms", "v_tilde_mps": "v_tilde_rms"}


def run(study: LiuStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    asked, more = cases(study), beside_tasks(study)
    before = len(asked) + len(more)
    total = before + len(pair_tasks(DRIVERS, study))
    outcomes = results_of(run_case, study, asked, workers,
                          lambda done, case, _: on_progress(done, total, title_of(study, case)))
    beside = results_of(run_one, study, more, workers, lambda done, task, _: on_progress(
        len(asked) + done, total, f"{task.title}, {task.disturbance}"))
    of_mpc = [beside[task] for task in more]
    pairs = pairs_of(study, drawn_rows(DRIVERS, study, workers, on_progress, before))
    where = {name: push.title for name, push in study.disturbances.items()}
    found = Found(study, outcomes)
    return StudyResult(
        rows=tuple(_row(study, outcomes[case]) for case in asked),
        tables=(*all_tables(found), *beside_table(study, of_mpc), *pair_table(study, DRIVERS, pairs, where)),
        plots=(*all_plots(found), *beside_plots(study, of_mpc)),
        findings=(*all_findings(found), *beside_findings(study, of_mpc),
                  *pair_findings(study, DRIVERS, pairs, where)),
        failures=tuple((title_of(study, case), str(outcomes[case].failed)) for case in asked if outcomes[case].failed))


def _row(study: LiuStudy, outcome: Outcome) -> dict[str, Any]:
    """A run as data, SI units; inputs in N."""
    case = outcome.case
    return {
        "controller": case.law, "column": case.column, "disturbance": case.disturbance,
        "change": study.changes[case.change].title if case.change >= 0 else None,
        "leak_rate_per_s": case.leak_rate_per_s,
        **{NAMES.get(name, name): outcome.numbers.get(name) for name in ROW},
        "largest_position_error": outcome.largest_position_error_m, "end_s": outcome.end_s,
        "step_us_median": outcome.step_us, "failed": outcome.failed,
    }


KIND = StudyKind(LiuStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
