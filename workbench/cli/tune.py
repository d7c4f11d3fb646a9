"""`workbench tune`: one budget, optimiser and seed for all controllers of a scenario, study or contest."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import Dask, PaperOrFile, Workers, load, on_cluster
from workbench.cli.terminal import progress


def command(paper: PaperOrFile,
            controller: Annotated[list[str] | None, typer.Option(
                metavar="NAME", help="Only this one; may be repeated.")] = None,
            write: Annotated[bool, typer.Option("--write", help="Put what was found into the file.")] = False,
            runs: Annotated[int | None, typer.Option(
                metavar="N", min=1, max=10**7, help="Runs of each search; default: as the file states.")] = None,
            out: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Where finished restarts of the search are kept.")] = None,
            resume: Annotated[bool, typer.Option("--resume", help="Go on with the restarts kept in --out.")] = False,
            workers: Workers = None, dask: Dask = None) -> None:
    """Tune the controllers of a scenario, study or contest: the same budget, optimiser and seeds for every one."""
    from workbench.files.outputs import check_outputs
    from workbench.paper.tune import tune_run
    from workbench.paper.tuning_journal import JOURNAL_NAME

    loaded = load(paper)
    check_outputs({}, folders={"--out": (out, (JOURNAL_NAME,)) if out else None})
    with progress() as show, on_cluster(dask, workers):
        lines = list(tune_run(loaded, controller or [], write, workers,
                              lambda done, total, _: show("tuning", done, total), runs, out, resume))
    for line in lines:
        out_console.print(line, soft_wrap=True, highlight=False)
