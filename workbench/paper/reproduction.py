"""A paper run again beside MPC: what its study declares, and the run that is made of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

from workbench.model.desired_curve import DesiredCurve
from workbench.paper.drivers import Drivers, checked, tune_with
from workbench.paper.pairs import compared_pairs, pair_findings, pair_stage, pair_table
from workbench.paper.results import Shown, StudyResult
from workbench.paper.stages import Stage, run_stages
from workbench.paper.study import Progress, Study, StudyKind
from workbench.paper.tracked import Tracked


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


@dataclass(frozen=True)
class Reproduction:
    """What a paper's study declares; the package runs it and puts it together.

    record: of its file; stages(study): its own runs; results(study, *found): what they gave, a mapping a stage, as the
    others take it, with the study as `study`; rows: a run each; shown: tables, figures and findings in the order of the
    page; failures: (run, why); beside: law and MPC; track: see `StudyKind`.
    """

    record: type[Study]
    stages: Callable[[Any], Sequence[Stage]]
    results: Callable[..., Any]
    rows: Callable[[Any], Iterable[dict[str, Any]]]
    shown: Callable[[Any], Shown]
    failures: Callable[[Any], Iterable[tuple[str, str]]]
    beside: Beside
    track: Callable[[Any, DesiredCurve | None], Tracked]

    @property
    def kind(self) -> StudyKind:
        """The contract that every verb reads."""
        drivers = self.beside.drivers
        return StudyKind(self.record, partial(_run, self), checked(drivers), tune_with(drivers), track=self.track)


def _run(of: Reproduction, study: Any, workers: int, on_progress: Progress) -> StudyResult:
    """All runs of the study in `workers` processes; a run that diverges is told and stops no other."""
    drivers = of.beside.drivers
    *own, compared, drawn = run_stages((*of.stages(study), of.beside.stage(study), pair_stage(drivers, study)), workers,
                                       on_progress)
    results, pairs = of.results(study, *own), compared_pairs(drivers, study, drawn)
    parts = (of.shown(results), of.beside.shown(results, compared),
             Shown(pair_table(study, drivers, pairs), (), pair_findings(study, drivers, pairs)))
    return StudyResult(
        rows=tuple(of.rows(results)), tables=tuple(table for part in parts for table in part.tables),
        plots=tuple(plot for part in parts for plot in part.plots),
        findings=tuple(finding for part in parts for finding in part.findings), failures=tuple(of.failures(results)))
