"""`workbench tune`: one budget, optimiser and seed for all controllers of a scenario, study or contest."""

from __future__ import annotations

from typing import Annotated

import typer

from workbench.cli.options import PaperOrFile, Workers, load
from workbench.cli.terminal import out_console, progress

NAME = "tune"


def command(paper: PaperOrFile,
            controller: Annotated[list[str] | None, typer.Option(help="Only this one; may be repeated.")] = None,
            write: Annotated[bool, typer.Option("--write", help="Put what was found into the file.")] = False,
            runs: Annotated[int | None, typer.Option(
                min=1, help="Runs of each controller; default: as the file states.")] = None,
            workers: Workers = None) -> None:
    """Tune the controllers of a scenario, study or contest: the same budget, optimiser and seed for every one."""
    from workbench.paper.tune import tune_run

    loaded = load(paper)
    with progress() as show:
        lines = list(tune_run(loaded, controller or [], write, workers,
                              lambda done, total, _: show("tuning", done, total), runs))
    for line in lines:
        out_console.print(line, soft_wrap=True, highlight=False, markup=False)
