"""What `workbench reference` is asked, and under which names its outputs are written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from workbench.files.outputs import is_stream

Solver = Literal["auto", "socp", "nlp"]


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
    window_s: float | None
    max_jerk_mps3: float | None
    json: Path | None
    csv: Path | None
    every_s: float
    figure: Path | None
    certificate: Path | None
    solver: Solver = "auto"
    timetable: Path | None = None
    check: Path | None = None
    etcs: bool = False


def table_file(asked: Request) -> Path | None:
    """Where the smooth reference goes: by default beside the JSON."""
    return asked.csv or (_beside(asked.json, ".csv") if asked.json else None)


def of_cars_file(table: Path) -> Path:
    """Where what the cars do goes: beside the smooth reference."""
    return _beside(table, "_cars.csv")


def certified_file(table: Path | None) -> Path | None:
    """Where the run goes that the bound is proved for: beside the smooth reference where that is a file."""
    return None if table is None or is_stream(table) else _beside(table, "_certified.csv")


def couplers_file(figure: Path) -> Path:
    """Where the couplers are drawn: beside the figure of the run."""
    return _beside(figure, f"_couplers{figure.suffix}")


def _beside(path: Path, end: str) -> Path:
    """Another end of a file's name; of what is no file, such as `.`, a name that is refused with it."""
    return path.parent / f"{path.stem}{end}"
