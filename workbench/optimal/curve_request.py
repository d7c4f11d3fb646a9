"""A rule for a reference in a TOML file: the energy-optimal run of a train on a line in a time, as rows of a CSV file.

The rows are what `workbench reference LINE TRAIN --time S --window W --every E --csv FILE` writes, and what scenarios
read as a reference of `kind = "table"`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from pydantic import Field, Strict

from workbench.errors import InputError
from workbench.files.toml import Positive, SourcedRecord, Text, load_record
from workbench.optimal.course import Array
from workbench.optimal.export import samples
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.smooth import SmoothReference, smooth_reference
from workbench.optimal.vehicle import ForceLimit, Vehicle


class CurveRequest(SourcedRecord):
    """Which train runs which line (paths relative to the file) in which time, and over what acceleration is smoothed.

    every_s: between two rows; intervals: of the plan's mesh, as many as the gap asks for where none is given.
    force_share: of the train's traction and brakes that the plan uses, so that a controller keeps the others.
    """

    track: Text
    train: Text
    trip_time_s: Positive
    window_s: Positive
    every_s: Positive
    force_share: Annotated[float, Strict(), Field(gt=0.05, le=1, allow_inf_nan=False)] = 1.0
    intervals: Annotated[int, Strict(), Field(ge=10, le=20_000)] | None = None


@dataclass(frozen=True)
class RequestedCurve:
    """The reference that a rule asks for, and its rows, shape (n, 5), by the columns of `export`."""

    reference: SmoothReference
    rows: Array


def requested_curve(path: Path) -> RequestedCurve:
    """Read a rule and solve it; raises InputError naming file, key and remedy, and InfeasibleRunError."""
    asked = load_record(path, CurveRequest)
    line, _ = load_line(path.parent / asked.track)
    vehicle = _held_back(load_vehicle(path.parent / asked.train)[0], asked.force_share)
    run = course(line, vehicle)
    try:
        found = smooth_reference(vehicle, run, asked.trip_time_s, asked.window_s, intervals=asked.intervals)
        return RequestedCurve(found, samples(vehicle, run, found.run, asked.every_s))
    except InputError as trouble:
        raise trouble.within(path) from None


def _held_back(vehicle: Vehicle, share: float) -> Vehicle:
    """The vehicle with a share of its forces and powers."""
    def less(limit: ForceLimit) -> ForceLimit:
        return ForceLimit(share * limit.force_n, share * limit.power_w, tuple((v, share * f) for v, f in limit.table))

    return replace(vehicle, traction=less(vehicle.traction), regenerative=less(vehicle.regenerative),
                   friction_brake_n=share * vehicle.friction_brake_n,
                   braking_table=tuple((v, share * f) for v, f in vehicle.braking_table),
                   bounded=_held_back(vehicle.bounded, share) if vehicle.bounded else None)
