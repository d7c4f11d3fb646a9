"""The runs of a study, and the documents of studies and comparisons: what needs no page."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import InputError
from workbench.tasks.handing_out import places

if TYPE_CHECKING:
    from workbench.paper.loading import Loaded
    from workbench.paper.results import StudyResult
    from workbench.paper.study import Study
    from workbench.report.document_format import ComparisonDocument, FailureDocument, StudyDocument, TableDocument
    from workbench.simulate.compare import Comparison

# (what is being done, done, total); total 0 while it is not known
Progress = Callable[[str, int, int], None]


def check_resumable(loaded: Loaded, out: Path | None, resume: bool) -> None:
    """InputError unless runs can be kept in `out` and gone on with."""
    keeps = loaded.kind is not None and loaded.kind.run_kept is not None
    if not keeps and (out is not None or resume):
        raise InputError("", "--resume" if out is None else "--out", "is for contests, which alone keep their finished "
                         "runs: leave it out")
    if resume and out is None:
        raise InputError("", "--resume", "needs the folder of the runs to go on with: name it with --out")


def run_study(loaded: Loaded, workers: int | None = None, on_progress: Progress = lambda what, done, total: None,
              kept: Path | None = None, resume: bool = False) -> StudyResult:
    """All runs of a study, in `workers` processes or one a core.

    kept: a folder for what is finished, from which `resume` goes on; of no effect for a study whose runs are few.
    Raises InputError for a folder that another study has used, or that cannot be written.
    """
    kind, study = loaded.kind, loaded.study
    assert kind is not None

    def told(done: int, total: int, _: str) -> None:
        on_progress("runs", done, total)

    if kept is not None and kind.run_kept is not None:
        return kind.run_kept(study, places(workers), told, kept, resume)
    return kind.run(study, places(workers), told)


def study_document(study: Study, result: StudyResult) -> StudyDocument:
    """The document of `workbench compare --json` of a study."""
    tables: list[TableDocument] = [{"title": t.title, "source": t.source, "note": t.note, "header": list(t.headings),
               "rows": [list(row) for row in t.text], "units": [column.unit for column in t.columns],
               "values": [list(row) for row in t.values]} for t in result.tables]
    failures: list[FailureDocument] = [{"run": run, "why": why} for run, why in result.failures]
    return {"version": 1, "scenario": study.name, "rows": list(result.rows), "tables": tables,
            "findings": list(result.findings), "failures": failures}


def comparison_document(comparison: Comparison) -> ComparisonDocument:
    """The document of `workbench compare --json`."""
    return {"version": 1, "scenario": comparison.scenario.name, "rows": [m.row() for m in comparison.metrics],
            "variants": [{"title": variant.title, "set": variant.set, "rows": [m.row() for m in metrics]}
                         for variant, metrics in comparison.variants]}
