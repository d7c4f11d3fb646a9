"""What `workbench reference` is asked: its arguments, what is wrong with them, and the files it reads.

What solves and writes is imported when all of it is in order, so that a mistake is said at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from workbench.errors import InputError
from workbench.files.outputs import check_outputs, is_stream
from workbench.optimal.inputs.etcs_file import load_supervision
from workbench.optimal.inputs.files import load_cars, load_line, load_vehicle

Solver = Literal["auto", "socp", "nlp"]
FIGURES = (".svg", ".png", ".pdf")


@dataclass(frozen=True)
class Request:
    """The command's arguments, in SI units."""

    track: Path
    train: Path
    trip_time_s: float | None
    serve_stops: bool
    dwell_s: float
    from_m: float
    to_m: float | None
    start_mps: float
    end_mps: float
    intervals: int | None
    window_s: float
    max_jerk_mps3: float | None
    json: Path | None
    csv: Path | None
    every_s: float
    figure: Path | None
    certificate: Path | None
    solver: Solver = "auto"
    timetable: Path | None = None
    etcs: bool = False


def reference_run(asked: Request) -> Iterator[str]:
    """Lines for the reader as they come; raises InputError and InfeasibleRunError before anything is written."""
    _check_outputs(asked)
    if not 0 < asked.every_s < float("inf"):
        raise InputError("", "--every", f"{asked.every_s:g} s is no step of a table: give a positive number of seconds")
    line, notes = load_line(asked.track)
    vehicle, more = load_vehicle(asked.train)
    train = load_cars(asked.train)
    etcs = load_supervision(asked.train, asked.track) if asked.etcs else None
    if asked.figure and asked.figure.suffix.lower() not in FIGURES:
        raise InputError(asked.figure, "figure", f"end the name in one of {', '.join(FIGURES)}")
    for name, value in (("--dwell", asked.dwell_s), ("--from-speed", asked.start_mps), ("--to-speed", asked.end_mps)):
        if not 0 <= value < 1e5:
            raise InputError("", name, f"{value:g} is not usable: give 0 or more")
    from workbench.report.reference_answer import answered  # noqa: PLC0415 - as said above

    yield from answered(asked, line, vehicle, train, (*notes, *more), etcs)


def _check_outputs(asked: Request) -> None:
    """Raises InputError where an output would be written over an input or over another output."""
    check_outputs({"--json": asked.json, "--figure": asked.figure})  # of which other names are made
    if asked.json and is_stream(asked.json) and not asked.csv:
        raise InputError("", "--csv", f"is missing: {asked.json} has no folder for a table beside it, name a file")
    inputs = [path for path in (asked.track, asked.train, asked.timetable) if path]
    table, figure = table_file(asked), asked.figure
    check_outputs({"--json": asked.json, "--csv": table, "cars of --csv": table and of_cars_file(table),
                   "certified run of --csv": certified_file(table),
                   "--figure": figure, "couplers of --figure": figure and couplers_file(figure),
                   "--certificate": asked.certificate}, inputs)


def table_file(asked: Request) -> Path | None:
    """Where the smooth reference goes: by default beside the JSON."""
    return asked.csv or (asked.json.with_suffix(".csv") if asked.json else None)


def of_cars_file(table: Path) -> Path:
    """Where what the cars do goes: beside the smooth reference."""
    return table.with_name(f"{table.stem}_cars.csv")


def certified_file(table: Path | None) -> Path | None:
    """Where the run goes that the bound is proved for: beside the smooth reference where that is a file."""
    return None if table is None or is_stream(table) else table.with_name(f"{table.stem}_certified.csv")


def couplers_file(figure: Path) -> Path:
    """Where the couplers are drawn: beside the figure of the run."""
    return figure.with_name(f"{figure.stem}_couplers{figure.suffix}")
