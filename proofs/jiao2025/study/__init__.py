"""The study of jiao2025: laws that learn from trial to trial, in every reading of its units."""

from __future__ import annotations

from typing import Any

from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import drawn_rows, pair_findings, pair_table, pair_tasks, pairs_of
from workbench.paper.results import StudyResult
from workbench.paper.study import Progress, StudyKind
from workbench.simulate.process_pool import run_tasks

from ..simulation.trials import TrialRun, run_trials
from .cases import Case, JiaoStudy, cases, plan
from .drivers import DRIVERS, Task, run_tuned, tuned_findings, tuned_plots, tuned_table, tuned_tasks
from .findings import all_findings
from .mpc_comparison import Beside, beside_findings, beside_table, beside_tasks, run_one
from .outcomes import Found, mse, outcome, peak, rises
from .plots import all_plots
from .tables import all_tables
from .tracking import track


def run(study: JiaoStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    asked, more, again = list(dict.fromkeys(cases(study))), beside_tasks(study), tuned_tasks(study)
    before = len(asked) + len(more) + len(again)
    total = before + len(pair_tasks(DRIVERS, study))
    runs: dict[Case, TrialRun] = {}

    def record(result: tuple[Case, TrialRun]) -> None:
        runs[result[0]] = result[1]
        on_progress(len(runs), total, name_of(study, result[0]))

    run_tasks(_run_case, study, asked, workers, record)
    beside: dict[tuple[str, str], Beside] = {}

    def keep(one: Beside) -> None:
        beside[one.reading, one.kind] = one
        on_progress(len(asked) + len(beside), total, f"{one.kind}, {one.reading}")

    run_tasks(run_one, study, more, workers, keep)
    of_mpc, found = [beside[task] for task in more], Found(study, runs)
    tuned: dict[Task, dict[str, Any]] = {}

    def keep_tuned(result: tuple[Task, dict[str, Any]]) -> None:
        tuned[result[0]] = result[1]
        on_progress(len(asked) + len(more) + len(tuned), total, "stated and tuned")

    run_tasks(run_tuned, study, again, 1, keep_tuned)
    rows = [(task, tuned[task]) for task in again]
    pairs = pairs_of(study, drawn_rows(DRIVERS, study, workers, on_progress, before))
    where = {name: reading.title for name, reading in study.readings.items()}
    return StudyResult(
        rows=tuple(_row(study, case, runs[case]) for case in asked),
        tables=(*all_tables(found), *beside_table(found, of_mpc), *tuned_table(study, rows),
                *pair_table(study, DRIVERS, pairs, where)),
        plots=(*all_plots(found), *tuned_plots(study, rows)),
        findings=(*all_findings(found), *beside_findings(found, of_mpc), *tuned_findings(study, rows),
                  *pair_findings(study, DRIVERS, pairs, where)),
        failures=tuple((name_of(study, case), str(runs[case].failed)) for case in asked
                       if runs[case].failed is not None and case.unit_mps2 is None))


def _run_case(study: JiaoStudy, case: Case) -> tuple[Case, TrialRun]:
    return case, run_trials(plan(study, case))


def name_of(study: JiaoStudy, case: Case) -> str:
    """A run in words: law, reading, and what is not as stated."""
    words = [case.law, case.reading]
    if case.opposed:
        words.append("resistance against the motion")
    if case.variant >= 0:
        words.append(study.variants[case.variant].title)
    if case.unit_mps2 is not None:
        words.append(f"unit of u {case.unit_mps2:.3g} m/s^2")
    if case.seed != study.trials.seed:
        words.append(f"seed {case.seed}")
    return ", ".join(words)


def _row(study: JiaoStudy, case: Case, done: TrialRun) -> dict[str, Any]:
    """A run as data; speeds in m/s, squared errors in m^2/s^2."""
    trials = (*study.trials.compared, study.trials.count)
    shown = {f"mse_{trial}": float(mse(done)[trial]) if trial < len(done.rows) else None for trial in trials}
    last = done.rows[-1] if done.failed is None else None
    trial, ratio = peak(done) if len(done.rows) else (None, None)
    return {
        "controller": case.law, "reading": case.reading, "seed": case.seed,
        "variant": study.variants[case.variant].title if case.variant >= 0 else None, "unit_mps2": case.unit_mps2,
        "resistance_opposed": case.opposed, "mse_0": float(mse(done)[0]) if len(done.rows) else None, **shown,
        "peak_trial": trial, "peak_over_first": ratio, "trials_worse": rises(done),
        "largest_speed_error": None if last is None else float(done.column("largest_error")[-1]),
        "outcome": outcome(done), "step_us_median": done.step_us, "failed": done.failed,
    }


KIND = StudyKind(JiaoStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
