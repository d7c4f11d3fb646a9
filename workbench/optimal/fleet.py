"""A day's trips solved one by one: what each takes, what it must take at least, or why it cannot be run."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from workbench.errors import WorkbenchError
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.fleet_file import FleetFile, Trip
from workbench.optimal.inputs.line import Line, course
from workbench.optimal.reference import find_reference
from workbench.optimal.vehicle import Vehicle

COLUMNS = ("id", "track", "train", "length_m", "time_s", "least_time_s", "energy_J", "lower_bound_J", "gap", "status",
           "trouble")


@dataclass(frozen=True)
class TripRow:
    """A trip's answer in SI units; without numbers where it is refused, for the reason in `trouble`.

    time_s: of the run with its stops, of which least_time_s is the least feasible one.
    """

    id: str
    track: str
    train: str
    length_m: float | None = None
    time_s: float | None = None
    least_time_s: float | None = None
    energy_J: float | None = None
    lower_bound_J: float | None = None
    gap: float | None = None
    status: str = "refused"
    trouble: str | None = None

    def document(self) -> dict[str, Any]:
        """As data, by COLUMNS."""
        return asdict(self)

    @classmethod
    def read(cls, data: Any) -> TripRow | None:
        """The row of a trip that was solved, as `document` has written it; None where it is anything else."""
        if not isinstance(data, dict) or data.keys() != set(COLUMNS):
            return None
        texts, numbers = ("id", "track", "train", "status"), COLUMNS[3:9]
        whole = (all(isinstance(data[name], str) for name in texts) and data["trouble"] is None
                 and all(isinstance(data[name], float) and math.isfinite(data[name]) for name in numbers))
        return cls(**data) if whole else None


@dataclass(frozen=True)
class FleetTrip:
    """A trip with the files that it takes; a key for worker processes."""

    trip: Trip
    track: Path
    train: Path

    def __hash__(self) -> int:
        return hash(self.trip.id)


def fleet_trips(fleet: FleetFile, folder: Path) -> tuple[FleetTrip, ...]:
    """The trips in the order of the file, whose folder the other files are relative to."""
    return tuple(FleetTrip(trip, folder / str(trip.track or fleet.track), folder / str(trip.train or fleet.train))
                 for trip in fleet.trips)


@cache
def _line(path: Path) -> Line:
    return load_line(path)[0]


@cache
def _vehicle(path: Path) -> Vehicle:
    return load_vehicle(path)[0]


def solved_trip(_: None, asked: FleetTrip) -> TripRow:
    """The answer to one trip; what is wrong with it is told in its row. The first argument is what workers share."""
    trip, names = asked.trip, (asked.trip.id, asked.track.name, asked.train.name)
    try:
        line, vehicle = _line(asked.track), _vehicle(asked.train)
        to_m = line.length_m if trip.to_m is None else trip.to_m
        stops = line.stops_between(trip.from_m, to_m) if trip.stops else ()
        run, waits = course(line, vehicle, trip.from_m, to_m, stops), trip.dwell_s * len(stops)
        found = find_reference(vehicle, run, trip.time_s, trip.from_speed_mps, trip.to_speed_mps, waited_s=waits)
    except WorkbenchError as trouble:
        return TripRow(*names, trouble=" ".join(str(trouble).split()))
    return TripRow(*names, run.length_m, found.profile.trip_time_s + waits, found.least_time_s + waits,
                   found.energy_j, found.lower_bound_j, found.gap, found.status)
