"""What a train's file says of its braking to ETCS: the block of TTOBench, or the [etcs] table of a train in TOML."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Annotated, ClassVar

from pydantic import Field

from workbench.errors import InputError
from workbench.files.json_input import read_json
from workbench.files.toml import Number, Record, load_record, validate_record
from workbench.files.units import ACCELERATION, SPEED, Columns, Quantity, Share, Units
from workbench.optimal.inputs.etcs import Supervision
from workbench.optimal.inputs.train_file import TrainFile

BLOCK = "ETCS braking data"
# The least share of a brake that is relied on, the longest delay of one, and the largest error of a measured speed.
LEAST_FACTOR, LONGEST_S, MOST_UNCERTAIN = 0.05, 60.0, 0.3
# What files call them, by their kind: factors on dry and wet rail, delays, uncertainty.
NAMES = {".json": tuple(f"{BLOCK}.{name}" for name in (
             "K_dry_rst", "K_wet_rst", "T_traction", "T_be", "T_bs", "v_uncertainty")),
         ".toml": tuple(f"etcs.{name}" for name in (
             "dry", "wet", "traction_s", "emergency_s", "service_s", "speed_uncertainty"))}


class Factor(Quantity):
    """A number without unit."""

    KNOWN: ClassVar[Units] = {"-": Fraction(1)}


class Seconds(Quantity):
    """A time, s."""

    KNOWN: ClassVar[Units] = {"s": Fraction(1)}


class Decelerations(Columns):
    """Speeds from which decelerations hold."""

    COLUMNS: ClassVar[dict[str, Units]] = {"velocity": SPEED, "deceleration": ACCELERATION}

    values: Annotated[tuple[tuple[Number, Number], ...], Field(min_length=1)]


class EtcsTrain(Record):
    """TTOBench's block of a train."""

    emergency: Annotated[Decelerations, Field(alias="A_brake_emergency")]
    service: Annotated[Decelerations, Field(alias="A_brake_service")]
    dry: Annotated[Factor, Field(alias="K_dry_rst")]
    wet: Annotated[Factor, Field(alias="K_wet_rst")]
    traction: Annotated[Seconds, Field(alias="T_traction")]
    emergency_time: Annotated[Seconds, Field(alias="T_be")]
    service_time: Annotated[Seconds, Field(alias="T_bs")]
    uncertainty: Annotated[Share, Field(alias="v_uncertainty")]


class EtcsLine(Record):
    """TTOBench's block of a track; Kt_int belongs to trains that state a brake percentage."""

    wet_share: Annotated[Factor | None, Field(alias="M_NVAVADH")] = None
    build_up: Annotated[Factor | None, Field(alias="Kt_int")] = None


class _TrackBlock(Record):
    block: Annotated[EtcsLine, Field(alias=BLOCK)]


class _TrainBlock(Record):
    block: Annotated[EtcsTrain, Field(alias=BLOCK)]


def load_supervision(train: Path, track: Path) -> Supervision:
    """How ETCS supervises a train on a line; raises InputError naming file, key and remedy where data are missing."""
    return _of_train(train, _wet_share(track))


def _of_train(path: Path, wet_share: float) -> Supervision:
    if path.suffix.lower() == ".json":
        data = read_json(path)
        if BLOCK not in data:
            raise InputError(path, BLOCK, "is missing: --etcs needs a train that states it")
        try:
            block = validate_record({BLOCK: data[BLOCK]}, _TrainBlock, "").block
        except InputError as trouble:
            raise trouble.within(path) from None
        pairs = [tuple((speed, rate) for speed, rate in table.rows()) for table in (block.emergency, block.service)]
        made = Supervision(pairs[0], pairs[1], block.dry.si, block.wet.si, block.traction.si, block.emergency_time.si,
                           block.service_time.si, block.uncertainty.si, wet_share)
    else:
        table = load_record(path, TrainFile).etcs
        if table is None:
            raise InputError(path, "etcs", "is missing: --etcs needs a train that states how it brakes")
        pairs = [tuple((step.speed_mps, step.deceleration_mps2) for step in steps)
                 for steps in (table.emergency, table.service)]
        made = Supervision(pairs[0], pairs[1], table.dry, table.wet, table.traction_s, table.emergency_s,
                           table.service_s, table.speed_uncertainty, wet_share, table.release_mps)
    _require_plausible(path, made, NAMES[path.suffix.lower()])
    for name, steps in (("emergency", made.emergency), ("service", made.service)):
        speeds = [speed for speed, _ in steps]
        if speeds[0] != 0 or speeds != sorted(set(speeds)) or not all(0.05 <= rate <= 5 for _, rate in steps):
            raise InputError(path, name, "its speeds must increase from 0 and its decelerations lie between 0.05 and 5 "
                             "m/s^2: correct them")
    return made


def _require_plausible(path: Path, made: Supervision, names: tuple[str, ...]) -> None:
    """What is no share and no delay would permit more than the brakes hold; raises InputError for it.

    names: what the file calls the factors, times and uncertainty.
    """
    share, delay = (LEAST_FACTOR, 1.0, "share of a brake"), (0.0, LONGEST_S, "delay in s")
    held = ((made.dry, *share), (made.wet, *share), (made.traction_s, *delay), (made.emergency_s, *delay),
            (made.service_s, *delay), (made.speed_uncertainty, 0.0, MOST_UNCERTAIN, "uncertainty of a speed"))
    for name, (value, low, high, what) in zip(names, held, strict=True):
        if not low <= value <= high:
            raise InputError(path, name, f"{value:g} is no {what}, {low:g} to {high:g}: correct it or its unit")


def _wet_share(track: Path) -> float:
    if track.suffix.lower() != ".json":
        return 0.0
    data = read_json(track)
    if BLOCK not in data:
        return 0.0
    try:
        found = validate_record({BLOCK: data[BLOCK]}, _TrackBlock, "").block.wet_share
    except InputError as trouble:
        raise trouble.within(track) from None
    if found is not None and not 0 <= found.si <= 1:
        raise InputError(track, f"{BLOCK}.M_NVAVADH", f"{found.si:g} is no share from 0 to 1: correct it")
    return found.si if found else 0.0


