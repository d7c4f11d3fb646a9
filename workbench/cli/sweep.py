"""`workbench sweep`: the Monte Carlo of a scenario."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from workbench.cli.all_failed import end_where_all_failed
from workbench.cli.console import out_console
from workbench.cli.options import Dask, PaperOrFile, Workers, load, on_cluster
from workbench.cli.study_tables import result_table
from workbench.cli.terminal import progress, summary_table
from workbench.errors import InputError
from workbench.files.numbers import counted

if TYPE_CHECKING:
    from workbench.paper.loading import Loaded


def command(paper: PaperOrFile,
            out: Annotated[Path, typer.Option(metavar="FOLDER", help="Where sweep.csv and the rows as Parquet go.")],
            runs: Annotated[int | None, typer.Option(
                metavar="N", min=1, max=10**9, help="Runs a controller; default: 100, or as a plant's study states."
                )] = None,
            seed: Annotated[int | None, typer.Option(
                metavar="N", min=0, help="Seed of the draws; default: as the scenario states.")] = None,
            controller: Annotated[list[str] | None, typer.Option(
                metavar="NAME", help="Only this one; may be repeated.")] = None,
            sensitivity: Annotated[bool, typer.Option(
                "--sensitivity", help="Instead: all values of the joint_sensitivity table at once, and which decides.")
            ] = False,
            resume: Annotated[bool, typer.Option("--resume", help="Go on with the rows kept in --out.")] = False,
            draws: Annotated[Literal["random", "sobol"], typer.Option(
                help="How trains are drawn: by chance, or spread evenly by a scrambled Sobol' sequence (best with a "
                     "power of two of runs).")] = "random",
            until_width: Annotated[str | None, typer.Option(
                metavar="METRIC=WIDTH", help="End before --runs once the 95 % interval of every controller's mean of "
                "this column is so narrow.")] = None,
            rare: Annotated[str | None, typer.Option(
                metavar="METRIC>VALUE", help="Instead: how probable that is of a drawn run, however rare."
                )] = None,
            workers: Workers = None, dask: Dask = None) -> None:
    """Monte Carlo over the scenario's uncertainty: one row a run, the same bytes for the same seed.

    Exit code 0, also where some runs failed, 1 where all did, 2 on bad input.
    """
    from workbench.files.outputs import check_outputs
    from workbench.paper.loading import PLANT
    from workbench.simulate.row_store import CHUNKS, MANIFEST_NAME
    from workbench.simulate.stopping import UntilWidth
    from workbench.simulate.sweep import CSV_NAME, Options, monte_carlo

    loaded = load(paper)
    is_plant = loaded.kind is not None and loaded.data.get("kind") == PLANT
    if is_plant:  # before their texts are read: the metrics of these are a train's
        _left_out(loaded.path, "is a plant's study, which is drawn by chance and as often as asked",
                  {"--draws": draws != "random", "--until-width": until_width is not None, "--rare": rare is not None})
    until = UntilWidth.parse(until_width) if until_width is not None else None
    event = _event(rare, {"--runs": runs, "--resume": resume, "--until-width": until, "--sensitivity": sensitivity,
                          "--draws": draws != "random"})
    if sensitivity:
        _left_out("--sensitivity", "draws as [joint_sensitivity] states", {
            "--runs": runs, "--seed": seed is not None, "--controller": controller, "--draws": draws != "random",
            "--until-width": until})
    if event is not None:
        with on_cluster(dask, workers):
            _rare(loaded, event, out, seed, controller, workers)
        return
    if sensitivity:
        with on_cluster(dask, workers):
            _joint(loaded, out, resume, workers)
        return
    if is_plant:
        with on_cluster(dask, workers):
            _sweep_plant(loaded, out, runs, seed, controller, resume, workers)
        return
    scenario = loaded.scenario
    check_outputs({}, folders={"--out": (out, (CSV_NAME, MANIFEST_NAME, CHUNKS))})
    asked = Options(runs or 100, seed, controller, out, resume, workers, draws, until)
    with progress() as show, on_cluster(dask, workers):
        found = monte_carlo(scenario, loaded.path, asked, lambda done, total: show("Monte Carlo", done, total))
    summaries = found.write_csv(out / CSV_NAME)
    out_console.print(summary_table(summaries, found.runs))
    for name, mean in found.means.items():
        out_console.print(f"{name}: mean of {until_width} after {counted(found.runs, 'run')}: {mean.mean:g}, "
                          f"an interval of {mean.width:g}", markup=False, highlight=False)
    out_console.print(f"rows: {out / CSV_NAME}", markup=False, highlight=False)
    end_where_all_failed(map(vars, found.rows()))


def _event(rare: str | None, others: dict[str, Any]) -> Any:
    """What --rare asks for; InputError where it is not understood, or another option asks for something else."""
    from workbench.simulate.rare import Event

    if rare is None:
        return None
    _left_out("--rare", "takes as many runs as it needs, by chance", others)
    return Event.parse(rare)


def _left_out(where: str | Path, why: str, others: dict[str, Any]) -> None:
    """InputError where an option is given that has no meaning here, rather than to do without it in silence."""
    for option, given in others.items():
        if given:
            raise InputError(where, "", f"{why}: leave {option} out")


def _rare(loaded: Loaded, event: Any, out: Path, seed: int | None, controllers: list[str] | None,
          workers: int | None) -> None:
    from workbench.files.outputs import check_outputs
    from workbench.simulate.rare import CSV_NAME, probabilities

    if loaded.kind is not None:
        raise InputError("", "--rare", "is for scenarios of trains: name one")
    check_outputs({}, folders={"--out": (out, (CSV_NAME,))})
    with progress() as show:
        found = probabilities(loaded.scenario, loaded.path, event, seed, controllers, workers, out / CSV_NAME,
                              lambda done, total: show("estimates", done, total))
    for one in found:
        out_console.print(one.line(event), markup=False, highlight=False, soft_wrap=True)
    out_console.print(f"estimates: {out / CSV_NAME}", markup=False, highlight=False)


def _sweep_plant(loaded: Loaded, out: Path, runs: int | None, seed: int | None, controllers: list[str] | None,
                 resume: bool, workers: int | None) -> None:
    from workbench.files.outputs import check_outputs
    from workbench.paper.plants.sweep import CSV_NAME, sweep
    from workbench.simulate.row_store import CHUNKS, MANIFEST_NAME

    check_outputs({}, folders={"--out": (out, (CSV_NAME, MANIFEST_NAME, CHUNKS))})
    study: Any = loaded.study
    with progress() as show:
        found = sweep(study, runs, seed, controllers, out, workers,
                      lambda done, total, _: show("Monte Carlo", done, total), resume)
    out_console.print(result_table(found.write_csv(out / CSV_NAME)))
    out_console.print(f"rows: {out / CSV_NAME}", markup=False, highlight=False)
    end_where_all_failed(found.rows())


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
    if found.failed == len(found.values):
        end_where_all_failed([{"controller": found.stated.metric, "failed": "it is counted as failed at every point",
                               "runs": found.failed}])
