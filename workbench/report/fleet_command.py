"""What `workbench reference --fleet` does: solves a day's trips in processes, and writes one table of all."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench import __version__
from workbench.errors import InputError
from workbench.files.json_input import read_json
from workbench.files.json_output import write_json
from workbench.files.outputs import check_outputs
from workbench.files.regular import LARGEST_DATA, contents
from workbench.files.spreadsheet import text_cell
from workbench.files.toml import load_record
from workbench.files.units import KWH_J
from workbench.files.writing import write_text
from workbench.optimal.inputs.fleet_file import FleetFile


@dataclass(frozen=True)
class FleetRequest:
    """The command's arguments; resume: take what `json` already holds of the same trips."""

    fleet: Path
    json: Path | None
    csv: Path | None
    workers: int | None
    resume: bool


def fleet_run(asked: FleetRequest, on_progress: Callable[[int, int], None] = lambda done, total: None) -> Iterator[str]:
    """Lines for the reader: one a trip in the order of the file, and sums; raises InputError for the file itself, and
    at the end where no trip could be run.

    on_progress: is called with the trips done and all of them, when they begin and after each.
    """
    check_outputs({"--json": asked.json, "--csv": asked.csv}, [asked.fleet])
    if asked.resume and asked.json is None:
        raise InputError("", "--resume", "needs --json, the file that keeps what is finished: name it")
    fleet = load_record(asked.fleet, FleetFile)
    from workbench.optimal.fleet import COLUMNS, FleetTrip, TripRow, fleet_trips, solved_trip  # noqa: PLC0415 - solvers
    from workbench.tasks.handing_out import places, results_of  # noqa: PLC0415 - as above

    trips = fleet_trips(fleet, asked.fleet.parent)
    digests = {trip.trip.id: _digest(trip) for trip in trips}
    kept = _kept(asked.json) if asked.resume else {}
    rows = {trip.trip.id: row for trip in trips if (row := TripRow.read(kept.get(digests[trip.trip.id]))) is not None
            and row.id == trip.trip.id}
    if rows:
        yield f"note: {len(rows)} of {len(trips)} trips are taken from {asked.json}"

    def document() -> dict[str, Any]:
        done = [rows[trip.trip.id] for trip in trips if trip.trip.id in rows]
        return {"version": 1, "fleet": fleet.name, "trips": [row.document() for row in done],
                "digests": {row.id: digests[row.id] for row in done}}

    def record(_: int, trip: FleetTrip, row: TripRow) -> None:
        rows[trip.trip.id] = row
        if asked.json:
            write_json(asked.json, document())  # an interruption loses nothing
        on_progress(len(rows), len(trips))

    on_progress(len(rows), len(trips))
    waiting = [trip for trip in trips if trip.trip.id not in rows]
    results_of(solved_trip, None, waiting, places(asked.workers), record)
    found = [rows[trip.trip.id] for trip in trips]
    yield f"{'trip':<12} {'km':>8} {'time s':>9} {'least s':>9} {'kWh':>10} {'at least':>10} {'gap %':>7}"
    for row in found:
        yield _line(row.document())
    solved = [row for row in found if row.energy_J is not None]
    energy, bound = (sum(getattr(row, name) for row in solved) for name in ("energy_J", "lower_bound_J"))
    yield (f"{fleet.name}: {len(solved)} of {len(found)} trips solved, {energy / KWH_J:.3f} kWh, any runs take at "
           f"least {bound / KWH_J:.3f} kWh")
    if asked.json:
        write_json(asked.json, document())
        yield f"result: {asked.json}"
    if asked.csv:
        _write_csv(asked.csv, COLUMNS, [row.document() for row in found])
        yield f"table: {asked.csv}"
    if not solved:
        raise InputError(asked.fleet, "trips", f"none of {len(found)} could be run, trip '{found[0].id}' because of "
                         f"{found[0].trouble}")


def _line(row: dict[str, Any]) -> str:
    if row["trouble"]:
        return f"{row['id']:<12} refused: {row['trouble']}"
    return (f"{row['id']:<12} {row['length_m'] / 1e3:>8.3f} {row['time_s']:>9.1f} {row['least_time_s']:>9.1f} "
            f"{row['energy_J'] / KWH_J:>10.3f} {row['lower_bound_J'] / KWH_J:>10.3f} {100 * row['gap']:>7.3f}")


def _digest(trip: Any) -> str:
    """Of everything that a trip's answer depends on but the libraries."""
    text = hashlib.sha256(f"{__version__} {trip.trip!r}".encode())
    for path in (trip.track, trip.train):
        try:
            text.update(contents(path, LARGEST_DATA))
        except (OSError, ValueError):  # no file, or what no file can be called
            text.update(b"unreadable")
    return text.hexdigest()


def _kept(path: Path | None) -> dict[str, dict[str, Any]]:
    """Finished rows by digest, of an earlier run's file; none where there is no file."""
    if path is None or not path.exists():
        return {}
    data = read_json(path)
    try:
        return {data["digests"][row["id"]]: row for row in data["trips"] if row["status"] != "refused"}
    except (KeyError, TypeError, AttributeError):
        raise InputError(path, "trips", "is missing: this is no result of --fleet, name one or leave --resume out"
                         ) from None


def _write_csv(path: Path, columns: tuple[str, ...], rows: list[dict[str, Any]]) -> None:
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, columns)
    writer.writeheader()
    writer.writerows({name: _cell(value) for name, value in row.items()} for row in rows)
    write_text(path, text.getvalue())


def _cell(value: Any) -> Any:
    """A number as it is, a text as no formula, None as nothing."""
    if isinstance(value, float):
        return f"{value:.12g}"
    return text_cell(value) if isinstance(value, str) else value
