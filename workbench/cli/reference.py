"""`workbench reference`: the energy-optimal run of a train on a line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from workbench.cli.console import out_console
from workbench.cli.options import Dask, JsonFile, Workers, on_cluster
from workbench.errors import InputError


def command(track: Annotated[Path | None, typer.Argument(
                metavar="TRACK", help="The line: TOML of this project, or JSON of TTOBench.")] = None,
            train: Annotated[Path | None, typer.Argument(
                metavar="TRAIN", help="The train: TOML of this project, or JSON of TTOBench.")] = None,
            time: Annotated[float | None, typer.Option(metavar="S", help="Trip time in s, with its stops.")] = None,
            timetable: Annotated[Path | None, typer.Option(
                metavar="FILE", help="Windows on the way: TOML, or a journey of TTOBench; not with --time.")] = None,
            stops: Annotated[bool, typer.Option("--stops", help="Serve the line's stops on the way.")] = False,
            dwell: Annotated[float, typer.Option(metavar="S", help="Wait at each stop on the way, in s.")] = 30.0,
            from_m: Annotated[float, typer.Option(metavar="M", help="Where the run starts, in m.")] = 0.0,
            to_m: Annotated[float | None, typer.Option(
                metavar="M", help="Where it ends, in m; default: the end.")] = None,
            from_speed: Annotated[float, typer.Option(metavar="MPS", help="Speed at the start in m/s.")] = 0.0,
            to_speed: Annotated[float, typer.Option(metavar="MPS", help="Speed at the end in m/s.")] = 0.0,
            intervals: Annotated[int | None, typer.Option(
                metavar="N", min=10, max=20_000, help="Intervals of the plan's mesh; default: as many as the gap asks "
                "for.")] = None,
            solver: Annotated[Literal["auto", "socp", "nlp"], typer.Option(
                help="Nonlinear program, cone program (socp), or what the gap asks for (auto).")] = "auto",
            window: Annotated[float | None, typer.Option(
                metavar="S", help="Time over which acceleration is smoothed; default: 1, less where that is too much.")
            ] = None,
            max_jerk: Annotated[float | None, typer.Option(metavar="MPS3", help="Limit of the jerk in m/s^3.")] = None,
            json: JsonFile = None,
            csv: Annotated[Path | None, typer.Option(
                metavar="FILE", help="The smooth reference as CSV; default: beside the JSON.")] = None,
            every: Annotated[float, typer.Option(metavar="S", help="Step of the CSV in s.")] = 0.5,
            figure: Annotated[Path | None, typer.Option(metavar="FILE", help="Figure as SVG, PNG or PDF.")] = None,
            certificate: Annotated[Path | None, typer.Option(
                metavar="FILE", help="Write the bound's certificate, and re-check it exactly.")] = None,
            check: Annotated[Path | None, typer.Option(
                metavar="FILE", help="Only re-check a bound's certificate against this line, train and times.")] = None,
            etcs: Annotated[bool, typer.Option(
                "--etcs", help="Keep below the speeds that ETCS permits; the train must state its braking.")] = False,
            fleet: Annotated[Path | None, typer.Option(
                metavar="FILE", help="A day's trips (TOML) instead of TRACK and TRAIN; with --json, --csv.")] = None,
            workers: Workers = None, dask: Dask = None,
            resume: Annotated[bool, typer.Option(
                "--resume", help="With --fleet: go on with the finished trips in --json.")] = False) -> None:
    """The energy-optimal run of a train on a line, a smooth reference, and a proven bound on what could be saved."""
    if fleet:
        if track or train or time is not None or timetable:
            raise InputError("", "--fleet", "names lines, trains and times itself: leave TRACK, TRAIN and times out")
        from workbench.cli.terminal import progress
        from workbench.report.fleet_command import FleetRequest, fleet_run

        lines: list[str] = []
        try:
            with progress() as show, on_cluster(dask, workers):
                lines.extend(fleet_run(FleetRequest(fleet, json, csv, workers, resume),
                                       lambda done, total: show("trips", done, total)))
        finally:  # where no trip could be run, too: the table says why
            for line in lines:
                out_console.print(line, soft_wrap=True, highlight=False)
        return
    if dask is not None:
        raise InputError("", "--dask", "is for the trips of --fleet; one run is computed here: leave it out")
    if track is None or train is None:
        raise InputError("", "TRACK TRAIN", "are missing: name the files of a line and a train, or --fleet FILE")
    from workbench.report.reference_command import reference_run
    from workbench.report.reference_request import Request

    done = reference_run(Request(track, train, time, stops, dwell, from_m, to_m, from_speed, to_speed, intervals,
                               window, max_jerk, json, csv, every, figure, certificate, solver, timetable, check, etcs))
    for line in done:
        out_console.print(line, soft_wrap=True, highlight=False)
