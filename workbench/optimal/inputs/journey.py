"""A timetable from a file: a journey of TTOBench (JSON), or a TOML file of this project with the same meaning.

A row says where, between which times and at which speeds. Speeds of zero at most are a stop; two rows of a stop are its
arrival and its departure. The first row is the departure of the run, the last one its arrival.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby
from pathlib import Path
from typing import Annotated, ClassVar

from pydantic import ConfigDict, Field, model_validator

from workbench.errors import InputError
from workbench.files.json_input import read_json
from workbench.files.toml import Number, Record, SourcedRecord, Text, load_record, validate_record
from workbench.files.units import LENGTH, SPEED, Units, require_units, to_si
from workbench.optimal.inputs.line_checks import NEAREST_STOPS_M
from workbench.optimal.inputs.ttobench import Metadata
from workbench.optimal.timetable import Timetable, TimingPoint, Window

TIME: Units = {"s": Fraction(1), "min": Fraction(60), "h": Fraction(3600)}
Cell = Number | None


class JourneyMetadata(Metadata):
    """Also names the track that the journey is on."""

    associated_track: Annotated[Text | None, Field(alias="associated track")] = None


class TimingPoints(Record):
    """Rows of position, times and speeds, null for no limit."""

    COLUMNS: ClassVar[dict[str, Units]] = {
        "position": LENGTH, "lower time constraint": TIME, "upper time constraint": TIME,
        "lower speed constraint": SPEED, "upper speed constraint": SPEED}

    units: dict[str, Text]
    values: Annotated[tuple[tuple[Number, Cell, Cell, Cell, Cell], ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _known_units(self) -> TimingPoints:
        require_units(self.units, self.COLUMNS)
        self.rows()
        return self

    def rows(self) -> list[tuple[float | None, ...]]:
        """The rows in SI."""
        known = [(self.units[name], table) for name, table in self.COLUMNS.items()]
        return [tuple(None if x is None else to_si(x, *unit) for x, unit in zip(row, known, strict=True))
                for row in self.values]


class Journey(Record):
    """A TTOBench journey."""

    model_config = ConfigDict(frozen=True, extra="ignore")

    metadata: JourneyMetadata
    points: Annotated[TimingPoints, Field(alias="timing points")]


class Point(Record):
    """A row of a timetable in TOML; what is not stated is no limit."""

    position_m: Number
    earliest_s: Number | None = None
    latest_s: Number | None = None
    slowest_mps: Number | None = None
    fastest_mps: Number | None = None


class TimetableFile(SourcedRecord):
    """A timetable in TOML; `track`: the name of the line that it is on."""

    name: Text
    track: Text | None = None
    point: Annotated[tuple[Point, ...], Field(min_length=1)]


@dataclass(frozen=True)
class Asked:
    """What a file asks: its timetable, the speeds at both ends in m/s (None where it leaves them open)."""

    name: str
    timetable: Timetable
    start_mps: float | None
    end_mps: float | None


@dataclass(frozen=True)
class _Row:
    key: str
    position_m: float
    time: Window
    slowest_mps: float
    fastest_mps: float

    @property
    def stands(self) -> bool:
        return self.fastest_mps == 0


def load_timetable(path: Path, line_name: str, length_m: float, dwell_s: float) -> Asked:
    """The timetable of a run on a line; dwell_s: the least dwell where a stop on the way has one row only.

    Raises InputError naming file, row and remedy, for a journey that belongs to another line too.
    """
    try:
        if path.suffix.lower() == ".json":
            data = read_json(path)
            if "timing points" not in data:
                raise InputError("", "timing points", "is missing: this is no journey, name a file that is one")
            read = validate_record(data, Journey, "")
            name, track, key = read.metadata.id, read.metadata.associated_track, "timing points.values"
            rows = [_row(f"{key}[{k}]", *row) for k, row in enumerate(read.points.rows())]
            where = "metadata.associated track"
        elif path.suffix.lower() == ".toml":
            file = load_record(path, TimetableFile)
            name, track, key, where = file.name, file.track, "point", "track"
            rows = [_row(f"point[{k}]", p.position_m, p.earliest_s, p.latest_s, p.slowest_mps, p.fastest_mps)
                    for k, p in enumerate(file.point)]
        else:
            raise InputError("", "", "is neither .toml (this project's format) nor .json (TTOBench): name such a file")
        if track is not None and track != line_name:
            raise InputError("", where, f"'{track[:60]}' is another line than '{line_name}': name that line's file, or "
                             "correct the name here")
        return _asked(name, key, rows, length_m, dwell_s)
    except InputError as trouble:
        raise trouble if trouble.where else trouble.within(path) from None


def _row(key: str, position_m: float | None, earliest_s: float | None, latest_s: float | None,
         slowest_mps: float | None, fastest_mps: float | None) -> _Row:
    assert position_m is not None
    low, high = slowest_mps or 0.0, math.inf if fastest_mps is None else fastest_mps
    time = Window(-math.inf if earliest_s is None else earliest_s, math.inf if latest_s is None else latest_s)
    if not 0 <= low <= high:
        raise InputError("", key, f"speeds from {low:g} to {high:g} m/s are no range: let the lower one be 0 or more "
                         "and not above the upper one")
    if 0 < high < SLOWEST_PASSING_MPS:
        raise InputError("", key, f"a passing at no more than {high:g} m/s is none: state 0 where the train stops, "
                         f"{SLOWEST_PASSING_MPS:g} m/s or more where it does not")
    if time.earliest_s > time.latest_s:
        raise InputError("", key, f"times from {time.earliest_s:g} to {time.latest_s:g} s contradict each other: let "
                         "the earliest not be after the latest")
    if max((abs(t) for t in (time.earliest_s, time.latest_s) if math.isfinite(t)), default=0.0) > LATEST_S:
        raise InputError("", key, f"a time beyond {LATEST_S:g} s is no timetable's: is it in seconds?")
    return _Row(key, position_m, time, low, high)


# Ten days; and a speed that plans tell from standing still.
LATEST_S, SLOWEST_PASSING_MPS = 864000.0, 0.1


def _asked(name: str, key: str, rows: list[_Row], length_m: float, dwell_s: float) -> Asked:
    groups: list[list[_Row]] = [list(group) for _, group in groupby(rows, key=lambda row: row.position_m)]
    if len(groups) < 2:
        raise InputError("", key, "names one place only: name where the run begins and where it ends, at least")
    for group, before in zip(groups, [None, *groups[:-1]], strict=True):
        row = group[0]
        if before is not None and not row.position_m >= before[0].position_m + NEAREST_STOPS_M:
            raise InputError("", row.key, f"{row.position_m:g} m does not come {NEAREST_STOPS_M:g} m or more after "
                             f"{before[0].position_m:g} m: sort the points by position")
        if not 0 <= row.position_m <= length_m:
            raise InputError("", row.key, f"{row.position_m:g} m lies beyond the line, which goes from 0 to "
                             f"{length_m:g} m: remove it or name another line")
        at_end = group is groups[0] or group is groups[-1]
        if len(group) > (1 if at_end else 2) or (len(group) == 2 and not (row.stands and group[1].stands)):
            raise InputError("", group[-1].key, f"is one row too many at {row.position_m:g} m: a stop on the way may "
                             "have two, both with speed 0, the ends of the run one each")
    first, last = groups[0][0], groups[-1][0]
    if not math.isfinite(first.time.earliest_s):
        raise InputError("", first.key, "has no earliest time: say from when on the run may begin")
    if not math.isfinite(last.time.latest_s):
        raise InputError("", last.key, "has no latest time: say by when the run must end")
    points = [TimingPoint(first.position_m, departure=first.time), *(_point(group, dwell_s) for group in groups[1:-1]),
              TimingPoint(last.position_m, arrival=last.time)]
    return Asked(name, Timetable(tuple(points)), *(_pinned(row) for row in (first, last)))


def _point(group: list[_Row], dwell_s: float) -> TimingPoint:
    row = group[0]
    if not row.stands:
        return TimingPoint(row.position_m, row.time, slowest_mps=row.slowest_mps, fastest_mps=row.fastest_mps)
    if len(group) == 1:
        return TimingPoint(row.position_m, row.time, stands=True, dwell_s=dwell_s)
    if group[1].time.latest_s < row.time.earliest_s:
        raise InputError("", group[1].key, f"departs by {group[1].time.latest_s:g} s, before the arrival from "
                         f"{row.time.earliest_s:g} s on: let it depart later")
    return TimingPoint(row.position_m, row.time, group[1].time, stands=True)


def _pinned(row: _Row) -> float | None:
    """The speed at an end of the run where the row says it; raises InputError where it leaves 0 out and says none."""
    if row.slowest_mps == row.fastest_mps:
        return row.fastest_mps
    if row.slowest_mps > 0:
        raise InputError("", row.key, "gives a range of speeds at an end of the run: give one speed, twice")
    return None
