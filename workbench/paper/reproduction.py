"""A paper run again beside MPC: what its study declares, and the run that is made of it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.comparison import ALONE
from workbench.paper.drivers import Drivers, checked, tune_with
from workbench.paper.findings import found
from workbench.paper.only_full import MadeRuns, each
from workbench.paper.pairs import compared_pairs, pair_findings, pair_stage, pair_table
from workbench.paper.reproduced import STATED, ReproducedStudy, Results, in_words
from workbench.paper.results import Plot, ResultTable, Shown, StudyResult
from workbench.paper.stages import Stage, Together, run_stages
from workbench.paper.study import Progress, StudyKind
from workbench.paper.tracked import Tracked
from workbench.paper.trip_run import TripRun
from workbench.paper.winners import winners_table


class Beside(Protocol):
    """How a paper's laws are held against MPC: runs of their own, and what these show beside the study's."""

    @property
    def drivers(self) -> Drivers:
        """Law and MPC alike."""
        ...

    def stage(self, study: Any) -> Stage:
        """The runs that the study's own do not give."""
        ...

    def shown(self, results: Any, found: Mapping[Any, Any]) -> Shown:
        """Tables, figures and findings from the study's results and from what `stage` gave."""
        ...


def _nothing_more(study: Any) -> Sequence[Stage]:
    return ()


def _every(case: Any) -> bool:
    return True


def _none(study: Any, case: Any) -> bool:
    return False


def _case_words(study: Any, case: Any) -> dict[str, Any]:
    """The fields of a case, its change by the title."""
    return {key: study.change_title(value) if key == "change" else value for key, value in vars(case).items()}


def case_title(study: Any, case: Any) -> str:
    """A run in words from its case: `column 3, twice the rate`, or `as stated` where no field says more."""
    fields = _case_words(study, case)
    words = (f"{key} {value}" for key, value in fields.items() if key != "change")
    return in_words(*words, fields.get("change")) or "as stated"


def plain_row(study: Any, case: Any, run: Any) -> dict[str, Any]:
    """The fields of a case, its change by the title, and those of the run's own that are a number, a word or None.

    Of a `TripRun` all of its row.
    """
    return _plain(_case_words(study, case)) | (dict(run.row) if isinstance(run, TripRun) else _plain(vars(run)))


def _plain(values: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is None or isinstance(value, int | float | str)}


@dataclass(frozen=True)
class Reproduction:
    """What a paper's study declares; the package runs it and puts it together. The first three are enough.

    record: of its file; cases(study): its own runs, hashable, each with the number of its `change`, or
    `reproduced.stated_and_changed`; run(study, case): what a run left, with `failed`, why it ended early, or None.
    title(study, case): a run in words; row(study, case, run): a run as data; results(study, runs, *of_stages): what the
    makers of tables, figures and findings are given, `reproduced.Results` or more. A maker gives one or several, in the
    order of the page; a finding that lacks its runs is left out.
    beside: law and MPC; track: see `StudyKind`; work: how long a run takes, together: how several are made at once, see
    `Stage`; stages(study): runs of other kinds; told(case): whether the report says that a run failed, which for a
    sweep's it need not; left_out(study, case): whether an `ExtraTable` that a short report leaves out asks for the run;
    those under changes that it leaves out need not be named.
    """

    record: type[ReproducedStudy]
    cases: Callable[[Any], Sequence[Hashable]]
    run: Callable[[Any, Any], Any]
    title: Callable[[Any, Any], str] = case_title
    row: Callable[[Any, Any, Any], dict[str, Any]] = plain_row
    results: Callable[..., Any] = Results
    tables: Sequence[Callable[[Any], ResultTable | Iterable[ResultTable]]] = ()
    plots: Sequence[Callable[[Any], Plot | Iterable[Plot]]] = ()
    findings: Sequence[Callable[[Any], str | Iterable[str]]] = ()
    beside: Beside = ALONE
    track: Callable[[Any, DesiredCurve | None], Tracked] | None = None
    work: Callable[[Any, Any], float] | None = None
    stages: Callable[[Any], Sequence[Stage]] = _nothing_more
    told: Callable[[Any], bool] = _every
    together: Together | None = None
    left_out: Callable[[Any, Any], bool] = _none

    @property
    def kind(self) -> StudyKind:
        """The contract that every verb reads."""
        drivers = self.beside.drivers
        return StudyKind(self.record, partial(_run, self), checked(drivers), tune_with(drivers), track=self.track,
                         run_one=partial(_run_one, self))

    def parted(self, study: Any) -> tuple[list[Any], list[Any]]:
        """The cases that are run, and those that a short report leaves out."""
        made, left_out = list[Any](), list[Any]()
        for case in self.cases(study):
            change = getattr(case, "change", STATED)
            out = (change != STATED and study.leaves_out(study.changes[change])) or self.left_out(study, case)
            (left_out if out else made).append(case)
        return made, left_out

    def own_stage(self, study: Any) -> Stage:
        """The runs of all cases but those that are left out."""
        return Stage(self.run, study, self.parted(study)[0], lambda case, _: self.title(study, case),
                     partial(self.work, study) if self.work else None, self.together)

    def shown(self, results: Any, strict: Any | None = None) -> Shown:
        """The paper's own tables, figures and findings; strict: what findings are given where runs are left out."""
        return Shown(each(self.tables, results), each(self.plots, results), found(self.findings, strict or results))


def _run_one(of: Reproduction, study: Any, fields: Mapping[str, Any]) -> dict[str, Any]:
    """The row of the case with these fields; where several have them, of that which is else as stated."""
    cases: list[Any] = list(of.cases(study))
    for key, value in fields.items():
        if not hasattr(cases[0], key):
            raise ValueError(f"a run has no {key!r}: choose among {', '.join(vars(cases[0]))}")
        wanted = tuple(value) if isinstance(value, list) else value
        known = dict.fromkeys(getattr(case, key) for case in cases)
        cases = [case for case in cases if getattr(case, key) == wanted]
        if not cases:
            raise ValueError(f"no run has {key} = {value!r}: choose among {', '.join(map(repr, known))}")
    for field in dataclasses.fields(cases[0]):
        cases = [case for case in cases if getattr(case, field.name) == field.default] or cases
    if len(cases) > 1:
        differing = [key for key in vars(cases[0]) if len({getattr(case, key) for case in cases}) > 1]
        raise ValueError(f"{len(cases)} runs have these fields: give {' and '.join(differing)}, too")
    return of.row(study, cases[0], of.run(study, cases[0]))


def _run(of: Reproduction, study: Any, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    drivers = of.beside.drivers
    stages = (of.own_stage(study), *of.stages(study), of.beside.stage(study), pair_stage(drivers, study))
    runs, *others, compared, drawn = run_stages(stages, workers, on_progress)
    pairs, left_out = compared_pairs(drivers, study, drawn), of.parted(study)[1]
    results, strict = (of.results(study, MadeRuns(runs, left_out, strict) if left_out else runs, *others)
                       for strict in (False, True))
    parts = (of.shown(results, strict), of.beside.shown(results, compared),
             Shown(pair_table(study, drivers, pairs), (), pair_findings(study, drivers, pairs)))
    plots = [tuple(part.plots) for part in parts]
    return StudyResult(
        rows=tuple(of.row(study, case, run) for case, run in runs.items()),
        tables=tuple(table for part in parts for table in part.tables),
        plots=tuple(plot for of_part in plots for plot in of_part),
        findings=tuple(finding for part in parts for finding in part.findings),
        failures=tuple((of.title(study, case), run.failed) for case, run in runs.items()
                       if run.failed is not None and of.told(case)),
        winners=winners_table(study, drivers, pairs, drawn),
        # The first that shows law and MPC together, else the paper's own first one.
        first_plot=len(plots[0]) if plots[1] else 0 if plots[0] else None, runs=runs, left_out=len(left_out))
