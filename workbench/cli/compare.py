"""`workbench compare`: all controllers on the same train and line, or all runs of a study or contest."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import Dask, JsonFile, PaperOrFile, Workers, load, on_cluster
from workbench.errors import InputError


def command(paper: PaperOrFile, json: JsonFile = None,
            variants: Annotated[bool, typer.Option(
                "--variants", help="Also run the scenario's variants.")] = False,
            out: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Where a contest keeps its finished runs.")] = None,
            resume: Annotated[bool, typer.Option("--resume", help="Go on with the runs kept in --out.")] = False,
            workers: Workers = None, dask: Dask = None) -> None:
    """Run all controllers of a scenario on the same train and line, and compare them; or all runs of a study.

    Exit code 0, also where some runs failed, 1 where all did, 2 on bad input.
    """
    loaded = load(paper)  # before what runs is imported: a mistake in the file is said at once

    from workbench.cli.all_failed import end_where_all_failed
    from workbench.cli.study_tables import print_study
    from workbench.cli.terminal import metrics_table, print_failures, progress
    from workbench.files.json_output import write_json
    from workbench.files.outputs import check_outputs
    from workbench.report.runs import check_resumable, comparison_document, run_study, study_document

    check_outputs({"--json": json}, folders={"--out": (out, _kept())} if out else None)
    check_resumable(loaded, out, resume)
    if loaded.kind is not None:
        if variants:
            raise InputError("", "--variants", "is for scenarios; a study's file states its own runs: leave it out")
        with progress() as show, on_cluster(dask, workers):
            found = run_study(loaded, workers, show, out, resume)
        if json:
            write_json(json, study_document(loaded.study, found))
        print_study(found)
        end_where_all_failed(found.rows)
        return
    from workbench.simulate.compare import compare as run_comparison

    with progress() as show, on_cluster(dask, workers):
        result = run_comparison(loaded.path, loaded.data, loaded.scenario, variants, workers,
                                lambda done, total, _: show("runs", done, total))
    document = comparison_document(result)
    if json:
        write_json(json, document)
    out_console.print(metrics_table(document["rows"], f"{result.scenario.name}: as stated"))
    for variant in document["variants"]:
        out_console.print(metrics_table(variant["rows"], variant["title"]))
    print_failures(document["rows"])
    end_where_all_failed([*document["rows"], *(row for variant in document["variants"] for row in variant["rows"])])


def _kept() -> tuple[str, ...]:
    """The names of the files in which a contest keeps its runs."""
    from workbench.contest.journal import JOURNAL_NAME
    from workbench.contest.pareto import JOURNAL_NAME as FRONTS_NAME

    return JOURNAL_NAME, FRONTS_NAME
