"""`workbench sweep`: the Monte Carlo of a scenario."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from workbench.cli.options import PaperOrFile, Workers, load
from workbench.cli.terminal import out_console, progress, result_table, summary_table
from workbench.errors import InputError

if TYPE_CHECKING:
    from workbench.paper.loading import Loaded

NAME = "sweep"


def command(paper: PaperOrFile,
            out: Annotated[Path, typer.Option(help="Folder for sweep.csv and its journal")],
            runs: Annotated[int | None, typer.Option(
                min=1, help="Runs per controller; default: 100, of a plant's study as it states.")] = None,
            seed: Annotated[int | None, typer.Option(min=0, help="Default: as the scenario states.")] = None,
            controller: Annotated[list[str] | None, typer.Option(help="Only this one; may be repeated.")] = None,
            sensitivity: Annotated[bool, typer.Option(
                "--sensitivity", help="Instead: all values of [joint_sensitivity] drawn at once, and which decides.")
            ] = False,
            resume: Annotated[bool, typer.Option(help="Go on after an interruption.")] = False,
            workers: Workers = None) -> None:
    """Monte Carlo over the scenario's uncertainty: one row a run, the same bytes for the same seed."""
    from workbench.files.outputs import check_outputs
    from workbench.paper.loading import PLANT
    from workbench.simulate.sweep import CSV_NAME, JOURNAL_NAME, summarise
    from workbench.simulate.sweep import sweep as run_sweep

    loaded = load(paper)
    if sensitivity:
        _joint(loaded, out, resume, workers)
        return
    if loaded.kind is not None and loaded.data.get("kind") == PLANT:
        _sweep_plant(loaded, out, runs, seed, controller, resume, workers)
        return
    scenario = loaded.scenario
    check_outputs({}, folders={"--out": (out, (CSV_NAME, JOURNAL_NAME))})
    seed = scenario.uncertainty.seed if seed is None else seed
    runs = runs or 100
    with progress() as show:
        rows = run_sweep(scenario, loaded.path, runs, seed, controller, out=out, resume=resume, workers=workers,
                         on_progress=lambda done, total, _: show("Monte Carlo", done, total))
    out_console.print(summary_table(summarise(rows, scenario), runs))
    out_console.print(f"rows: {out / 'sweep.csv'}")


def _sweep_plant(loaded: Loaded, out: Path, runs: int | None, seed: int | None, controllers: list[str] | None,
                 resume: bool, workers: int | None) -> None:
    from workbench.files.outputs import check_outputs
    from workbench.paper.plants.sweep import CSV_NAME, sweep

    if resume:
        raise InputError("", "--resume", "is for scenarios of trains: the sweep of a plant's study keeps no journal")
    check_outputs({}, folders={"--out": (out, (CSV_NAME,))})
    study: Any = loaded.study
    with progress() as show:
        found = sweep(study, runs, seed, controllers, out, workers,
                      lambda done, total, _: show("Monte Carlo", done, total))
    out_console.print(result_table(found.table()))
    out_console.print(f"rows: {out / CSV_NAME}")


def _joint(loaded: Loaded, out: Path, resume: bool, workers: int | None) -> None:
    from workbench.files.outputs import check_outputs
    from workbench.paper.sensitivity import CSV_NAME, JOURNAL_NAME, sensitivity, sensitivity_lines, sensitivity_table

    check_outputs({}, folders={"--out": (out, (CSV_NAME, JOURNAL_NAME))})
    with progress() as show:
        found = sensitivity(loaded, out, resume, workers, lambda done, total: show("joint sweep", done, total))
    out_console.print(result_table(sensitivity_table(found)))
    for line in sensitivity_lines(found):
        out_console.print(line, highlight=False)
    out_console.print(f"points: {out / CSV_NAME}")
