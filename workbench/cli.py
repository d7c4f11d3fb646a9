"""The command line: parses, calls, prints."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from workbench.errors import WorkbenchError
from workbench.proof.checker import check_folder
from workbench.proof.claim import VERDICTS
from workbench.proof.decide.engine import decide_all
from workbench.proof.document import claims_document, write_certificates
from workbench.proof.paper import collect_papers
from workbench.report.build import Report, build_report, comparison_document, write_json
from workbench.scenario import load_scenario
from workbench.simulate.compare import compare as run_comparison
from workbench.simulate.sweep import summarise
from workbench.simulate.sweep import sweep as run_sweep

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False,
                  help="A control paper as one executable object: proof, simulation, comparison.")
out_console = Console()
err_console = Console(stderr=True)
COLOURS = {"proved": "green", "refuted": "red", "violated": "red", "gap": "yellow", "assumed": "cyan",
           "undecided": "magenta"}

JsonFile = Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Also write the result as JSON.")]
Workers = Annotated[int | None, typer.Option(min=1, help="Processes; default: one a core.")]


@app.command()
def prove(paths: Annotated[list[Path] | None, typer.Argument(help="Proof files or folders; default: proofs")] = None,
          json: JsonFile = None,
          certificates: Annotated[Path | None, typer.Option(
              help="Where certificates go; default: 'certificates' beside each proof file.")] = None) -> None:
    """Decide every claim; exit 0 when each verdict is the recorded one, 1 when one differs, 2 on bad input."""
    files = paths or [Path("proofs")]
    papers = collect_papers(files)
    claims = [claim for paper in papers for claim in paper.claims]
    with _progress() as show:
        decisions = decide_all(claims, lambda done: show("claims", done, len(claims)))
    folder = certificates or (files[0] if files[0].is_dir() else files[0].parent) / "certificates"
    write_certificates(decisions, folder)
    document = claims_document(decisions, folder)
    if json:
        write_json(json, document)
    out_console.print(_claims_table(document))
    out_console.print(_verdict_line(document))
    differing = [d for d in decisions if d.verdict != d.claim.recorded]
    for d in differing:
        err_console.print(f"[red]{d.claim.id}: decided {d.verdict}, but recorded {d.claim.recorded}[/red]")
    if differing:
        raise typer.Exit(1)


@app.command("check-certificates")
def check_certificates(folder: Annotated[Path, typer.Argument(help="Folder of certificates")]) -> None:
    """Re-check certificates with checker.py alone; exit 0 when all hold, 1 when one does not."""
    results = check_folder(folder)
    if not results:
        raise WorkbenchError(f"{folder}: holds no certificate (*.json): run 'workbench prove' first")
    for path, verdict, reason in results:
        if reason is not None:
            err_console.print(f"[red]{path}: {verdict}: INVALID: {reason}[/red]", soft_wrap=True)
    wrong = sum(reason is not None for _, _, reason in results)
    out_console.print(f"{len(results) - wrong} of {len(results)} certificates hold")
    if wrong:
        raise typer.Exit(1)


@app.command()
def compare(scenario: Annotated[Path, typer.Argument(help="Scenario TOML")], json: JsonFile = None,
            variants: Annotated[bool, typer.Option(help="Also run the scenario's variants.")] = False,
            workers: Workers = None) -> None:
    """Run all controllers of a scenario on the same train and line, and compare them."""
    with _progress() as show:
        result = run_comparison(scenario, variants, workers, lambda done, total, _: show("runs", done, total))
    document = comparison_document(result)
    if json:
        write_json(json, document)
    out_console.print(_metrics_table(document["rows"], f"{result.scenario.name}: as stated"))
    for variant in document["variants"]:
        out_console.print(_metrics_table(variant["rows"], variant["title"]))
    _print_failures(document["rows"])


@app.command()
def sweep(scenario: Annotated[Path, typer.Argument(help="Scenario TOML")],
          out: Annotated[Path, typer.Option(help="Folder for sweep.csv and its journal")],
          runs: Annotated[int, typer.Option(min=1, help="Runs per controller")] = 100,
          seed: Annotated[int, typer.Option(min=0)] = 2021,
          controller: Annotated[list[str] | None, typer.Option(help="Only this one; may be repeated.")] = None,
          resume: Annotated[bool, typer.Option(help="Go on after an interruption.")] = False,
          workers: Workers = None) -> None:
    """Monte Carlo over the scenario's uncertainty: one row a run, the same bytes for the same seed."""
    with _progress() as show:
        rows = run_sweep(scenario, runs, seed, controller, out=out, resume=resume, workers=workers,
                         on_progress=lambda done, total, _: show("Monte Carlo", done, total))
    out_console.print(_summary_table(summarise(rows, load_scenario(scenario)), runs))
    out_console.print(f"rows: {out / 'sweep.csv'}")


@app.command()
def report(scenario: Annotated[Path, typer.Argument(help="Scenario TOML")],
           proofs: Annotated[list[Path] | None, typer.Argument(help="Proof files of the paper")] = None,
           out: Annotated[Path, typer.Option(help="Folder of the report")] = Path("out"),
           runs: Annotated[int | None, typer.Option(
               min=1, help="Monte Carlo runs; default: as the scenario states")] = None,
           seed: Annotated[int | None, typer.Option(min=0)] = None, workers: Workers = None) -> None:
    """Check the proof, run and compare the controllers, and put the whole on one page."""
    with _progress() as show:
        made = build_report(scenario, proofs or [], out, runs, seed, workers, show)
    _print_report(made)


def _print_report(made: Report) -> None:
    if made.claims:
        out_console.print(_claims_table(made.claims, only_failed=True))
        out_console.print(_verdict_line(made.claims))
    rows = [m.row() for m in made.comparison.metrics]
    out_console.print(_metrics_table(rows, f"{made.comparison.scenario.name}: as stated"))
    _print_failures(rows)
    out_console.print(_summary_table(made.summaries, max(s.runs for s in made.summaries)))
    out_console.print("times: " + ", ".join(f"{what} {seconds:.1f} s" for what, seconds in made.timings.items()))
    out_console.print(f"report: {made.page}", style="bold", soft_wrap=True)


@contextmanager
def _progress() -> Iterator[Any]:
    """A progress bar per stage on standard error; a plain line per stage where that is no terminal."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=err_console, disable=not err_console.is_terminal) as bar:
        tasks: dict[str, Any] = {}

        def show(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what, total=total)
            bar.update(tasks[what], completed=done, total=total)
            if not err_console.is_terminal and done == total:
                err_console.print(f"{what}: {done} done")

        yield show


def _claims_table(document: dict[str, Any], only_failed: bool = False) -> Table:
    rows = [c for c in document["claims"] if not only_failed or c["verdict"] not in ("proved", "assumed")]
    table = Table(title="claims that do not hold as printed" if only_failed else "claims", title_justify="left",
                  box=SIMPLE_HEAD, pad_edge=False, expand=True)
    for heading, share in (("id", 0), ("claim", 5), ("verdict", 0), ("shown by", 3), ("rests on failed", 3)):
        table.add_column(heading, no_wrap=not share, ratio=share or None)
    papers = len({c["paper"] for c in rows})
    for c in rows:
        colour = COLOURS[c["verdict"]]
        shown = c["computed"] or c["method"]
        if c["counterexample"] and not c["computed"]:
            shown = ", ".join(f"{k} = {v}" for k, v in c["counterexample"].items())
        name = c["equation"] if papers == 1 else c["id"]
        table.add_row(name, c["title"], f"[{colour}]{c['verdict']}[/{colour}]", shown,
                      ", ".join(i.partition(":")[2] for i in c["tainted_by"]))
    return table


def _verdict_line(document: dict[str, Any]) -> str:
    counts = document["summary"]
    return f"{sum(counts.values())} claims: " + ", ".join(
        f"[{COLOURS[v]}]{counts[v]} {v}[/{COLOURS[v]}]" for v in VERDICTS if counts[v])


def _metrics_table(rows: list[dict[str, Any]], title: str) -> Table:
    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False)
    _columns(table, "position\nerror (mm)", "speed error\n(mm/s)", "stop\n(mm)", "energy\n(MJ)", "step\n(µs)")
    for r in rows:
        table.add_row(
            r["controller"] + (" [red]failed[/red]" if r["failed"] else ""),
            _range(r["position_error_min"], r["position_error_max"]),
            _range(r["speed_error_min"], r["speed_error_max"]), _number(r["stopping_error"], 1e3),
            _number(r["energy_J"], 1e-6, 5), _number(r["step_us_median"]))
    return table


def _columns(table: Table, *headings: str) -> None:
    table.add_column("controller", no_wrap=True)
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)


def _summary_table(summaries: list[Any], runs: int) -> Table:
    table = Table(title=f"Monte Carlo, {runs} runs", title_justify="left", box=SIMPLE_HEAD, pad_edge=False)
    _columns(table, "position\nerror (mm)", "speed error\n(mm/s)", "mean |stop|\n(mm)", "failed\nruns")
    for s in summaries:
        table.add_row(s.controller, _range(s.position_error_min, s.position_error_max),
                      _range(s.speed_error_min, s.speed_error_max), _number(s.mean_abs_stopping_error, 1e3),
                      f"{s.failed} of {s.runs}")
    return table


def _print_failures(rows: list[dict[str, Any]]) -> None:
    for row in rows:
        if row["failed"]:
            err_console.print(f"{row['controller']}: {row['failed']}", style="red", soft_wrap=True)


def _number(value: float | None, scale: float = 1.0, digits: int = 3) -> str:
    return "–" if value is None else f"{value * scale:.{digits}g}"


def _range(low: float | None, high: float | None, scale: float = 1e3) -> str:
    """A range in thousandths of the SI unit, as the tables show errors."""
    return "–" if low is None or high is None else rf"\[{_number(low, scale)}, {_number(high, scale)}]"


def main() -> None:
    """Run the command line; an error that is the caller's to mend is one line and exit code 2."""
    try:
        app()
    except WorkbenchError as trouble:
        err_console.print(f"workbench: {trouble}", style="red", soft_wrap=True, markup=False, highlight=False)
        sys.exit(2)
    except KeyboardInterrupt:
        err_console.print("workbench: interrupted; finished runs are kept", style="yellow")
        sys.exit(130)
