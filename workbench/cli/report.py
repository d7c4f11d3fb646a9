"""`workbench report`: proof, runs, comparison and gains of a paper on one page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import Dask, PaperOrFile, Workers, load, on_cluster
from workbench.cli.study_tables import print_study
from workbench.cli.terminal import fate_lines, metrics_table, print_failures, progress, summary_table
from workbench.cli.verdict_counts import verdict_lines
from workbench.errors import InputError

if TYPE_CHECKING:
    from workbench.report.build import Report, StudyReport


def command(paper: PaperOrFile,
            proofs: Annotated[list[str] | None, typer.Argument(
                metavar="PROOFS", help="Papers whose claims are on the page; default: the paper's own.")] = None,
            out: Annotated[Path, typer.Option(
                metavar="FOLDER", help="Where the page and what belongs to it go.")] = Path("out"),
            runs: Annotated[int | None, typer.Option(
                metavar="N", min=1, help="Monte Carlo runs of a scenario; default: as it states, few without --full."
            )] = None,
            full: Annotated[bool, typer.Option(
                "--full", help="All of it, which takes minutes: also what the file marks only_full, and all drawn "
                "trains that it states.")] = False,
            seed: Annotated[int | None, typer.Option(
                metavar="N", min=0, help="Seed of the Monte Carlo; default: as the scenario states.")] = None,
            gains: Annotated[bool, typer.Option(
                help="Also what is proved of the paper's gains, and better ones.")] = True,
            resume: Annotated[bool, typer.Option(
                "--resume", help="Go on with the runs of the Monte Carlo, or of a contest, kept in --out.")] = False,
            workers: Workers = None, dask: Dask = None) -> None:
    """Check the proof, run and compare the controllers, and put the whole on one page.

    Without --full what a file marks only_full is left out, and few trains are drawn; a table that is shorter says so.
    """
    from workbench.files.outputs import check_outputs

    loaded = load(paper)
    check_outputs({}, folders={"--out": (out, ())})
    for option, given in (("--runs", runs), ("--seed", seed)) if loaded.kind is not None else ():
        if given is not None:
            raise InputError("", option, "is for scenarios; a study's file states its own runs: leave it out")
    # After what was asked has been read: a mistake need not wait for it.
    from workbench.report.build import Asked, build_report, build_study_report

    asked = Asked.of(loaded, proofs or [], out, gains, resume, workers, full)
    if loaded.kind is not None:
        with progress() as show, on_cluster(dask, workers):
            study = build_study_report(asked, show)
        _print_study_report(study)
        return
    with progress() as show, on_cluster(dask, workers):
        made = build_report(asked, runs, seed, show)
    _print_report(made)


def _print_study_report(made: StudyReport) -> None:
    if made.claims:
        out_console.print(*verdict_lines(made.claims), *fate_lines(made.claims), sep="\n")
    print_study(made.result)
    _print_end(made.timings, made.page)


def _print_report(made: Report) -> None:
    if made.claims:
        out_console.print(*verdict_lines(made.claims), *fate_lines(made.claims), sep="\n")
    rows = [m.row() for m in made.comparison.metrics]
    out_console.print(metrics_table(rows, f"{made.comparison.scenario.name}: as stated"))
    print_failures(rows)
    out_console.print(summary_table(made.summaries, max(s.runs for s in made.summaries)))
    _print_end(made.timings, made.page)


def _print_end(timings: dict[str, float], page: Path) -> None:
    out_console.print("times: " + ", ".join(f"{what} {seconds:.1f} s" for what, seconds in timings.items()))
    out_console.print(f"report: {page}", style="bold", soft_wrap=True)
