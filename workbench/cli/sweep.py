"""`workbench sweep`: the Monte Carlo of a scenario."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.options import PaperOrFile, Workers, load
from workbench.cli.terminal import out_console, progress, summary_table

NAME = "sweep"


def command(paper: PaperOrFile,
            out: Annotated[Path, typer.Option(help="Folder for sweep.csv and its journal")],
            runs: Annotated[int, typer.Option(min=1, help="Runs per controller")] = 100,
            seed: Annotated[int | None, typer.Option(min=0, help="Default: as the scenario states.")] = None,
            controller: Annotated[list[str] | None, typer.Option(help="Only this one; may be repeated.")] = None,
            resume: Annotated[bool, typer.Option(help="Go on after an interruption.")] = False,
            workers: Workers = None) -> None:
    """Monte Carlo over the scenario's uncertainty: one row a run, the same bytes for the same seed."""
    from workbench.files.outputs import check_outputs
    from workbench.simulate.sweep import CSV_NAME, JOURNAL_NAME, summarise
    from workbench.simulate.sweep import sweep as run_sweep

    loaded = load(paper)
    scenario = loaded.scenario
    check_outputs({}, folders={"--out": (out, (CSV_NAME, JOURNAL_NAME))})
    seed = scenario.uncertainty.seed if seed is None else seed
    with progress() as show:
        rows = run_sweep(scenario, loaded.path, runs, seed, controller, out=out, resume=resume, workers=workers,
                         on_progress=lambda done, total, _: show("Monte Carlo", done, total))
    out_console.print(summary_table(summarise(rows, scenario), runs))
    out_console.print(f"rows: {out / 'sweep.csv'}")
