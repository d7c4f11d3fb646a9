"""The command line: parses, calls, prints."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from workbench.errors import InputError, WorkbenchError
from workbench.proof.checker import check_folder
from workbench.terminal import (
    claim_card,
    claims_table,
    err_console,
    metrics_table,
    out_console,
    print_failures,
    print_study,
    progress,
    summary_table,
    verdict_line,
)

if TYPE_CHECKING:
    from workbench.report.build import Report, StudyReport

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False,
                  help="A control paper as one executable object: proof, simulation, comparison.")

JsonFile = Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Also write the result as JSON.")]
Workers = Annotated[int | None, typer.Option(min=1, help="Processes; default: one a core.")]

INTERRUPTED = 130  # with which typer ends after Ctrl-C

# Each command imports what it alone needs, so that claims from the cache are shown before sympy would be imported.


@app.command()
def prove(paths: Annotated[list[str] | None, typer.Argument(
              help="Proof files or folders, and claims as in proofs/yang2021.py::24; default: proofs")] = None,
          json: JsonFile = None,
          certificates: Annotated[Path | None, typer.Option(
              help="Where certificates go; default: 'certificates' beside each proof file.")] = None,
          jobs: Annotated[int | None, typer.Option(min=1, help="Processes; default: one a core.")] = None,
          cache: Annotated[bool, typer.Option(help="Take what has not changed from the cache.")] = True) -> None:
    """Decide every claim; exit 0 when each verdict is the recorded one, 1 when one differs, 2 on bad input."""
    from workbench.json_output import write_json
    from workbench.proof.document import claims_document, write_certificates
    from workbench.proof.prove import prove as run_prove
    from workbench.proof.selection import targets

    found = targets(paths or ["proofs"])
    with progress() as show:
        proof = run_prove(found, jobs, cache, lambda done, total: show("claims", done, total))
    single = any(target.pattern is not None for target in found)
    folder = certificates or (found[0].path if found[0].path.is_dir() else found[0].path.parent) / "certificates"
    write_certificates(proof.decisions, folder, whole_papers=not single)
    document = claims_document(proof.decisions, folder)
    if json:
        write_json(json, document)
    for table in map(claim_card, document["claims"]) if single else [claims_table(document)]:
        out_console.print(table)
    out_console.print(verdict_line(document))
    if not single:
        out_console.print(f"{len(proof.now)} decided now, {len(proof.decisions) - len(proof.now)} from the cache")
    differing = [d for d in proof.decisions if d.verdict != d.claim.recorded]
    for d in differing:
        err_console.print(f"[red]{d.claim.id}: decided {d.verdict}, but recorded {d.claim.recorded}[/red]")
    if differing:
        raise typer.Exit(1)


@app.command("new-paper")
def new_paper(name: Annotated[str, typer.Argument(help="The paper's name, as in yang2021")],
              directory: Annotated[Path, typer.Option(help="Where the file goes.")] = Path()) -> None:
    """Write a proof file to start from: it runs, and shows an example of each kind of claim."""
    from workbench.proof.new_paper import write_new_paper

    path = write_new_paper(name, directory)
    out_console.print(f"written: {path}", soft_wrap=True, markup=False, highlight=False)
    out_console.print(f"decide it: workbench prove {path}", soft_wrap=True, markup=False, highlight=False)


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
def compare(scenario: Annotated[Path, typer.Argument(help="Scenario or study TOML")], json: JsonFile = None,
            variants: Annotated[bool, typer.Option(help="Also run the scenario's variants.")] = False,
            out: Annotated[Path | None, typer.Option(
                metavar="FOLDER", help="Where a contest keeps its finished runs.")] = None,
            resume: Annotated[bool, typer.Option("--resume", help="Go on with the runs kept in --out.")] = False,
            workers: Workers = None) -> None:
    """Run all controllers of a scenario on the same train and line, and compare them; or all runs of a study."""
    from workbench.json_output import write_json
    from workbench.report.build import comparison_document, run_study, study_document
    from workbench.simulate.compare import compare as run_comparison
    from workbench.studies.registry import check_kept, is_study, load_study

    if is_study(scenario):
        _refuse(variants, "--variants")
        study = load_study(scenario)
        check_kept(study, out, resume)
        with progress() as show:
            found = run_study(study, workers, show, out, resume)
        if json:
            write_json(json, study_document(study, found))
        print_study(found)
        return
    check_kept(None, out, resume)
    with progress() as show:
        result = run_comparison(scenario, variants, workers, lambda done, total, _: show("runs", done, total))
    document = comparison_document(result)
    if json:
        write_json(json, document)
    out_console.print(metrics_table(document["rows"], f"{result.scenario.name}: as stated"))
    for variant in document["variants"]:
        out_console.print(metrics_table(variant["rows"], variant["title"]))
    print_failures(document["rows"])


@app.command()
def sweep(scenario: Annotated[Path, typer.Argument(help="Scenario TOML")],
          out: Annotated[Path, typer.Option(help="Folder for sweep.csv and its journal")],
          runs: Annotated[int, typer.Option(min=1, help="Runs per controller")] = 100,
          seed: Annotated[int, typer.Option(min=0)] = 2021,
          controller: Annotated[list[str] | None, typer.Option(help="Only this one; may be repeated.")] = None,
          resume: Annotated[bool, typer.Option(help="Go on after an interruption.")] = False,
          workers: Workers = None) -> None:
    """Monte Carlo over the scenario's uncertainty: one row a run, the same bytes for the same seed."""
    from workbench.scenario import load_scenario
    from workbench.simulate.sweep import summarise
    from workbench.simulate.sweep import sweep as run_sweep

    with progress() as show:
        rows = run_sweep(scenario, runs, seed, controller, out=out, resume=resume, workers=workers,
                         on_progress=lambda done, total, _: show("Monte Carlo", done, total))
    out_console.print(summary_table(summarise(rows, load_scenario(scenario)), runs))
    out_console.print(f"rows: {out / 'sweep.csv'}")


@app.command()
def tune(contest: Annotated[Path, typer.Argument(help="Contest or study TOML: budget, ranges, objective are in it")],
         controller: Annotated[list[str] | None, typer.Option(help="Only this one; may be repeated.")] = None,
         write: Annotated[bool, typer.Option("--write", help="Put what was found into the file.")] = False,
         workers: Workers = None) -> None:
    """Tune the controllers of a contest or study: the same budget, optimiser and seed for every one."""
    from workbench.contest.command import tune_run

    with progress() as show:
        lines = list(tune_run(contest, controller or [], write, workers, lambda done, total, _: show("tuning", done,
                                                                                                      total)))
    for line in lines:
        out_console.print(line, soft_wrap=True, highlight=False, markup=False)


@app.command()
def report(scenario: Annotated[Path, typer.Argument(help="Scenario or study TOML")],
           proofs: Annotated[list[Path] | None, typer.Argument(help="Proof files of the paper")] = None,
           out: Annotated[Path, typer.Option(help="Folder of the report")] = Path("out"),
           runs: Annotated[int | None, typer.Option(
               min=1, help="Monte Carlo runs; default: as the scenario states")] = None,
           seed: Annotated[int | None, typer.Option(min=0)] = None, gains: Annotated[bool, typer.Option(
               help="Also what is proved of the paper's gains, and better ones.")] = True,
           resume: Annotated[bool, typer.Option(
               "--resume", help="Go on with the runs of the Monte Carlo, or of a contest, kept in --out.")] = False,
           workers: Workers = None) -> None:
    """Check the proof, run and compare the controllers, and put the whole on one page."""
    from workbench.report.build import build_report, build_study_report
    from workbench.studies.registry import is_study

    if is_study(scenario):
        _refuse(runs is not None, "--runs")
        _refuse(seed is not None, "--seed")
        with progress() as show:
            study = build_study_report(scenario, proofs or [], out, workers, show, gains, resume)
        _print_study_report(study)
        return
    with progress() as show:
        made = build_report(scenario, proofs or [], out, runs, seed, workers, show, gains, resume)
    _print_report(made)


@app.command()
def reference(track: Annotated[Path, typer.Argument(help="Line: TOML of this project, or TTOBench JSON")],
              train: Annotated[Path, typer.Argument(help="Train: TOML of this project, or TTOBench JSON")],
              time: Annotated[float | None, typer.Option(metavar="S", help="Trip time in s, with its stops.")] = None,
              timetable: Annotated[Path | None, typer.Option(
                  metavar="FILE", help="Windows on the way: TOML, or a journey of TTOBench; not with --time.")] = None,
              stops: Annotated[bool, typer.Option("--stops", help="Serve the line's stops on the way.")] = False,
              dwell: Annotated[float, typer.Option(metavar="S", help="Wait at each stop on the way.")] = 30.0,
              from_m: Annotated[float, typer.Option(metavar="M", help="Where the run starts.")] = 0.0,
              to_m: Annotated[float | None, typer.Option(metavar="M", help="Where it ends; default: the end.")] = None,
              from_speed: Annotated[float, typer.Option(metavar="MPS", help="Speed at the start in m/s.")] = 0.0,
              to_speed: Annotated[float, typer.Option(metavar="MPS", help="Speed at the end in m/s.")] = 0.0,
              intervals: Annotated[int | None, typer.Option(
                  min=10, max=100_000, help="Of the plan's mesh; default: as many as the gap asks for.")] = None,
              solver: Annotated[Literal["auto", "socp", "nlp"], typer.Option(
                  help="Cone program, nonlinear program, or what the gap asks for.")] = "auto",
              window: Annotated[float, typer.Option(metavar="S", help="Over which acceleration is smoothed.")] = 1.0,
              max_jerk: Annotated[float | None, typer.Option(metavar="MPS3", help="Limit of the jerk.")] = None,
              json: JsonFile = None,
              csv: Annotated[Path | None, typer.Option(
                  metavar="FILE", help="The smooth reference as CSV; default: beside the JSON.")] = None,
              every: Annotated[float, typer.Option(metavar="S", help="Step of the CSV.")] = 0.5,
              figure: Annotated[Path | None, typer.Option(metavar="FILE", help="Figure as SVG, PNG or PDF.")] = None,
              certificate: Annotated[Path | None, typer.Option(
                  metavar="FILE", help="Write the bound's certificate, and re-check it exactly.")] = None) -> None:
    """The energy-optimal run of a train on a line, a smooth reference, and a proven bound on what could be saved."""
    from workbench.report.reference_command import Request, reference_run

    done = reference_run(Request(track, train, time, stops, dwell, from_m, to_m, from_speed, to_speed, intervals,
                                 window, max_jerk, json, csv, every, figure, certificate, solver, timetable))
    for line in done:
        out_console.print(line, soft_wrap=True, highlight=False, markup=False)


@app.command()
def gains(paper: Annotated[str, typer.Argument(help="A paper's name, or its TOML file")], json: JsonFile = None,
          proofs: Annotated[Path | None, typer.Option(
              help="Folder of the proof files; default: proofs, beside the file's folder.")] = None,
          certificates: Annotated[Path | None, typer.Option(
              help="Also write the certificates below this folder.")] = None,
          runs: Annotated[bool, typer.Option(help="Simulate the found gains beside the stated ones.")] = True,
          workers: Workers = None) -> None:
    """Which conditions the stated gains meet, what can be proved of them, and gains that are proved to do better."""
    from workbench.gains.certificate import write_certificates
    from workbench.gains.registry import file_of
    from workbench.json_output import write_json
    from workbench.report.gains import gains_document, gains_result
    from workbench.studies.gain_effects import checked_gains, effects

    path = file_of(paper)
    found = checked_gains(path, proofs)
    if certificates:
        write_certificates(found.certificates, certificates)
    with progress() as show:
        done = effects(path, found, workers, lambda at, total, _: show("runs", at, total)) if runs else ()
    if json:
        write_json(json, gains_document(found, done))
    print_study(gains_result(found, done))


def _refuse(given: bool, option: str) -> None:
    if given:
        raise InputError("", option, "is for scenarios; a study's file states its own runs: leave it out")


def _print_study_report(made: StudyReport) -> None:
    if made.claims:
        out_console.print(verdict_line(made.claims))
    print_study(made.result)
    _print_end(made.timings, made.page)


def _print_report(made: Report) -> None:
    if made.claims:
        out_console.print(claims_table(made.claims, only_failed=True))
        out_console.print(verdict_line(made.claims))
    rows = [m.row() for m in made.comparison.metrics]
    out_console.print(metrics_table(rows, f"{made.comparison.scenario.name}: as stated"))
    print_failures(rows)
    out_console.print(summary_table(made.summaries, max(s.runs for s in made.summaries)))
    _print_end(made.timings, made.page)


def _print_end(timings: dict[str, float], page: Path) -> None:
    out_console.print("times: " + ", ".join(f"{what} {seconds:.1f} s" for what, seconds in timings.items()))
    out_console.print(f"report: {page}", style="bold", soft_wrap=True)


def main() -> None:
    """Run the command line; an error that is the caller's to mend is one line and exit code 2."""
    try:
        app()
    except WorkbenchError as trouble:
        err_console.print(f"workbench: {trouble}", style="red", soft_wrap=True, markup=False, highlight=False)
        sys.exit(2)
    except SystemExit as end:
        if end.code == INTERRUPTED:
            err_console.print("workbench: interrupted; what was finished is kept", style="yellow")
        raise
