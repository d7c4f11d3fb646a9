"""The study of mao2018: five cases under the laws as printed and with their signs corrected."""

from __future__ import annotations

from workbench.paper.drivers import checked, tune_with
from workbench.paper.pairs import drawn_rows, pair_findings, pair_table, pair_tasks, pairs_of
from workbench.paper.results import StudyResult
from workbench.paper.study import Progress, StudyKind
from workbench.simulate.process_pool import results_of

from ..laws import KINDS
from .drivers import DRIVERS, where
from .findings import findings
from .mpc_comparison import beside_findings, beside_plots, beside_table, beside_tasks, run_one
from .outcomes import Found
from .plots import all_plots
from .record import CaseData, MaoStudy
from .runs import Asked, Signs, obtain
from .tables import all_tables
from .tracking import track


def variants(case: CaseData) -> tuple[Signs, ...]:
    """The signs that a case's runs have mended: none, each but one, all."""
    if case.law == "healthy":
        return ((),)
    wrong = KINDS[case.law][-1]
    return tuple(dict.fromkeys(((), *(tuple(sign for sign in wrong if sign != left) for left in wrong), wrong)))


def plan(study: MaoStudy) -> list[Asked]:
    """All runs: every case in every tuning, the sampling periods, the changes of assumed values."""
    runs = [Asked(number, tuning, mended) for tuning in study.tunings
            for number, case in enumerate(study.cases, start=1) for mended in variants(case)]
    of = study.sampling
    runs += [Asked(of.case, of.tuning, variants(study.cases[of.case - 1])[-1], 0, period, r_2, of.end_s)
             for r_2 in of.r_2_per_s for period in of.periods_s]
    for number, change in enumerate(study.sensitivity, start=1):
        for case in change.cases:
            every = variants(study.cases[case - 1])
            chosen = {"corrected": every[-1:], "printed": every[:1], "both": (every[0], every[-1])}[change.laws]
            runs += [Asked(case, change.tuning, mended, number) for mended in dict.fromkeys(chosen)]
    return runs


def run(study: MaoStudy, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    asked, more = plan(study), beside_tasks(study)
    before = len(asked) + len(more)
    total = before + len(pair_tasks(DRIVERS, study))
    # The longest first, so that no process is left alone with one.
    found = results_of(obtain, study, sorted(asked, key=lambda one: _steps(study, one), reverse=True), workers,
                       lambda done, _, result: on_progress(done, total, result.name))
    beside = results_of(run_one, study, more, workers, lambda done, _, one: on_progress(
        len(asked) + done, total, f"case {one.case}, {one.title}"))
    others = [beside[task] for task in more]
    pairs = pairs_of(study, drawn_rows(DRIVERS, study, workers, on_progress, before))
    everything = Found(study, {one: found[one] for one in asked})
    return StudyResult(
        rows=tuple(found[one].row for one in asked),
        tables=(*all_tables(everything), *beside_table(everything, others),
                *pair_table(study, DRIVERS, pairs, where(study))),
        plots=(*all_plots(everything), *beside_plots(everything, others)),
        findings=(*findings(everything), *beside_findings(everything, others),
                  *pair_findings(study, DRIVERS, pairs, where(study))),
        failures=tuple((found[one].name, found[one].failed or "") for one in asked if found[one].failed))


def _steps(study: MaoStudy, asked: Asked) -> float:
    period = asked.period_s or study.tunings[asked.tuning].period_s
    return (asked.end_s or study.horizon.end_s) / period


KIND = StudyKind(MaoStudy, run, checked(DRIVERS), tune_with(DRIVERS), track=track)
