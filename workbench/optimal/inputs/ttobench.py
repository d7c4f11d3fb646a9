"""The public TTOBench format, library versions 1.1 to 1.5: JSON files of tracks and trains, with their units."""

from __future__ import annotations

import difflib
import math
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self

from pydantic import BeforeValidator, ConfigDict, Field, Strict, model_validator

from workbench.errors import InputError
from workbench.files.json_input import read_json
from workbench.files.toml import Number, Record, Text, validate_record
from workbench.files.units import (
    AREA,
    FORCE_PER_SQUARED_SPEED,
    GRADE_PERMILLE,
    LENGTH,
    SPEED,
    Acceleration,
    Columns,
    Force,
    Length,
    LinearResistance,
    Mass,
    Power,
    Share,
    Speed,
    SquareResistance,
    Units,
    to_si,
)
from workbench.optimal.inputs.line import Line, Tunnel
from workbench.optimal.inputs.line_checks import SHARPEST_RADIUS_M, require_starts, require_stops, require_tunnels
from workbench.optimal.inputs.plausible import plausible
from workbench.optimal.vehicle import ForceLimit, Vehicle

VERSIONS = ("1.1", "1.2", "1.3", "1.4", "1.5")
TRACK_BLOCKS = ("metadata", "altitude", "stops", "speed limits", "gradients", "curvatures", "tunnels",
                "ETCS braking data")
# An optional block that is written nearly like this is a mistake, not an extension.
NEARLY = 0.85


def _radius(value: Any) -> Any:
    if isinstance(value, str) and value.removeprefix("-") == "infinity":
        return math.inf
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError('is no radius: write a number, or "infinity" for straight track')
    if isinstance(value, str):
        raise ValueError(f"'{value[:40]}' is no radius: write a number, or \"infinity\" for straight track")
    return value


Radius = Annotated[float, Strict(), Field(allow_inf_nan=True), BeforeValidator(_radius)]


class Metadata(Record):
    """What a file is called and of which version it is; further keys may stand beside."""

    model_config = ConfigDict(frozen=True, extra="allow")

    id: Text
    library_version: Annotated[str, Strict(), Field(alias="library version")]

    @model_validator(mode="after")
    def _known_version(self) -> Self:
        version = self.library_version.removeprefix("TTOBench").strip().removeprefix("v")
        if version not in VERSIONS:
            raise ValueError(f"library version = '{self.library_version[:40]}' is not known: this workbench reads "
                             f"TTOBench v{VERSIONS[0]} to v{VERSIONS[-1]}")
        return self


class Stops(Record):
    """Positions of the stops."""

    KNOWN: ClassVar[Units] = LENGTH

    unit: Text
    values: Annotated[tuple[Number, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _known_unit(self) -> Self:
        self.positions_m()
        return self

    def positions_m(self) -> tuple[float, ...]:
        """The positions in m."""
        return tuple(to_si(value, self.unit, self.KNOWN) for value in self.values)


class SpeedLimits(Columns):
    """Positions from which speed limits hold."""

    COLUMNS: ClassVar[dict[str, Units]] = {"position": LENGTH, "velocity": SPEED}

    values: Annotated[tuple[tuple[Number, Number], ...], Field(min_length=1)]


class Gradients(Columns):
    """Positions from which grades hold."""

    COLUMNS: ClassVar[dict[str, Units]] = {"position": LENGTH, "slope": GRADE_PERMILLE}

    values: Annotated[tuple[tuple[Number, Number], ...], Field(min_length=1)]


class Curvatures(Columns):
    """Positions of circles and clothoids, with the signed radius at either end."""

    COLUMNS: ClassVar[dict[str, Units]] = {"position": LENGTH, "radius at start": LENGTH, "radius at end": LENGTH}

    values: Annotated[tuple[tuple[Number, Radius, Radius], ...], Field(min_length=1)]


class Tunnels(Columns):
    """Positions, lengths and cross sections of tunnels."""

    COLUMNS: ClassVar[dict[str, Units]] = {"position": LENGTH, "length": LENGTH, "cross section": AREA}

    values: Annotated[tuple[tuple[Number, Number, Number], ...], Field(min_length=1)]


class TunnelResistance(Columns):
    """What tunnels of listed cross sections add to the square term of a train's resistance."""

    COLUMNS: ClassVar[dict[str, Units]] = {"cross section": AREA, "coefficient": FORCE_PER_SQUARED_SPEED}

    values: Annotated[tuple[tuple[Number, Number], ...], Field(min_length=1)]


class TrackFile(Record):
    """A track; blocks that are not named here were taken out before."""

    metadata: Metadata
    stops: Stops
    limits: Annotated[SpeedLimits, Field(alias="speed limits")]
    gradients: Gradients | None = None
    curvatures: Curvatures | None = None
    tunnels: Tunnels | None = None


class TrainFile(Record):
    """A train; blocks that are not named here were taken out before."""

    metadata: Metadata
    mass: Mass
    rho: Share | None = None
    length: Length | None = None
    traction_force: Annotated[Force, Field(alias="max traction force")]
    traction_power: Annotated[Power | None, Field(alias="max traction power")] = None
    regenerative_force: Annotated[Force | None, Field(alias="max reg braking force")] = None
    regenerative_power: Annotated[Power | None, Field(alias="max reg braking power")] = None
    pneumatic_force: Annotated[Force | None, Field(alias="max pn braking force")] = None
    acceleration: Annotated[Acceleration | None, Field(alias="max acceleration")] = None
    deceleration: Annotated[Acceleration | None, Field(alias="max deceleration")] = None
    speed: Annotated[Speed | None, Field(alias="max speed")] = None
    r0: Annotated[Force, Field(alias="rolling resistance r0")]
    r1: Annotated[LinearResistance, Field(alias="rolling resistance r1")]
    r2: Annotated[SquareResistance, Field(alias="rolling resistance r2")]
    traction_efficiency: Annotated[Share | None, Field(alias="efficiency traction")] = None
    regenerative_efficiency: Annotated[Share | None, Field(alias="efficiency reg brake")] = None
    tunnel: Annotated[TunnelResistance | None, Field(alias="tunnel resistance")] = None


def _used(data: dict[str, Any], model: type[Record], known: tuple[str, ...]) -> tuple[dict[str, Any], list[str]]:
    """The blocks that are read, and notes on those that are not; InputError for one that is misspelt."""
    read = [field.alias or name for name, field in model.model_fields.items()]
    notes = []
    for key in data:
        if key in read or key in known:
            continue
        close = difflib.get_close_matches(key, [name for name in read if name not in data], n=1, cutoff=NEARLY)
        if close:
            raise InputError("", key, f"unknown block; did you mean '{close[0]}'?")
        notes.append(f"the block '{key[:60]}' is not known and was not used")
    return {key: value for key, value in data.items() if key in read and value is not None}, notes


def load_track(path: Path) -> tuple[Line, tuple[str, ...]]:
    """A line, and notes on what was assumed; raises InputError naming file, key and remedy."""
    data = read_json(path)
    if "mass" in data and "stops" not in data:
        raise InputError(path, "stops", "is missing: this is a train's file, name a track's")
    try:
        used, notes = _used(data, TrackFile, TRACK_BLOCKS)
        return _line(validate_record(used, TrackFile, "")), tuple(notes)
    except InputError as trouble:
        raise trouble.within(path) from None


def _line(track: TrackFile) -> Line:
    stops = track.stops.positions_m()
    require_stops("stops.values", stops)
    length = stops[-1]
    blocks: dict[str, Columns | None] = {
        "speed limits": track.limits, "gradients": track.gradients, "curvatures": track.curvatures,
    }
    for name, block in blocks.items():
        if block:
            require_starts(f"{name}.values", [row[0] for row in block.rows()], length)
    tunnels = [(start, extent, area, 0.0) for start, extent, area in track.tunnels.rows()] if track.tunnels else []
    require_tunnels("tunnels.values", tunnels, length)
    return Line(
        name=track.metadata.id, length_m=length, stops_m=stops,
        limits=tuple((x, limit) for x, limit in track.limits.rows()),
        grades=tuple((x, grade) for x, grade in track.gradients.rows()) if track.gradients else ((0.0, 0.0),),
        curves=tuple((x, *_curvatures(number, one, two))
                     for number, (x, one, two) in enumerate(track.curvatures.rows())) if track.curvatures else (),
        tunnels=tuple(Tunnel(*tunnel) for tunnel in tunnels), curve_rule="roeckl",
    )


def _curvatures(number: int, *radii_m: float) -> tuple[float, float]:
    for place, radius in enumerate(radii_m, start=1):
        if not abs(radius) >= SHARPEST_RADIUS_M:
            raise InputError("", f"curvatures.values[{number}][{place}]", f"a radius of {radius:g} m is no railway "
                             f"curve, at least {SHARPEST_RADIUS_M:g}: correct it or its unit")
    return 1 / radii_m[0], 1 / radii_m[1]


def load_train(path: Path) -> tuple[Vehicle, tuple[str, ...]]:
    """A vehicle, and notes on what was assumed; raises InputError naming file, key and remedy.

    Without these blocks: rotating mass 0, a train without length, no limits of power, acceleration and speed, no
    regenerative or pneumatic brake, traction at an efficiency of 100 %, nothing returned.
    """
    data = read_json(path)
    if "stops" in data and "mass" not in data:
        raise InputError(path, "mass", "is missing: this is a track's file, name a train's")
    try:
        used, notes = _used(data, TrainFile, ("num seats", "num coaches", "ETCS braking data"))
        train = validate_record(used, TrainFile, "")
        notes += _assumed(train)
        return plausible(_vehicle(train)), tuple(notes)
    except InputError as trouble:
        raise trouble.within(path) from None


def _assumed(train: TrainFile) -> list[str]:
    return [note for block, note in (
        (train.traction_efficiency, "no 'efficiency traction': 100 % assumed"),
        (train.regenerative_efficiency, "no 'efficiency reg brake': nothing is returned when braking"),
        (train.length, "no 'length': the train is taken as a point"),
        (train.rho, "no 'rho': no rotating mass assumed"),
    ) if block is None]


def _vehicle(train: TrainFile) -> Vehicle:
    force, power = train.regenerative_force, train.regenerative_power
    if power is not None and force is None:
        raise InputError("", "max reg braking force", "is missing where a power is given: add it")
    electric = force is not None and force.si != 0 and not (power is not None and power.si == 0)
    brake = ForceLimit(force.si, power.si if power else math.inf) if force and electric else ForceLimit(0.0)
    table = sorted(train.tunnel.rows()) if train.tunnel else []
    return Vehicle(
        name=train.metadata.id, mass_kg=train.mass.si, davis_n=(train.r0.si, train.r1.si, train.r2.si),
        traction=ForceLimit(train.traction_force.si, train.traction_power.si if train.traction_power else math.inf),
        regenerative=brake,
        friction_brake_n=train.pneumatic_force.si if train.pneumatic_force else 0.0,
        rotating_fraction=train.rho.si if train.rho else 0.0,
        max_acceleration_mps2=train.acceleration.si if train.acceleration else math.inf,
        max_deceleration_mps2=train.deceleration.si if train.deceleration else math.inf,
        max_speed_mps=train.speed.si if train.speed else math.inf,
        traction_efficiency=train.traction_efficiency.si if train.traction_efficiency else 1.0,
        regenerative_efficiency=train.regenerative_efficiency.si if train.regenerative_efficiency else 0.0,
        length_m=train.length.si if train.length else 0.0,
        tunnel_drag=tuple((area, added) for area, added in table),
    )
