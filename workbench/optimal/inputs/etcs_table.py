"""The [etcs] table of a train's TOML file."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, Strict

from workbench.files.toml import NonNegative, Positive, Record, SourcedRecord

_Share = Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)]


class EtcsStep(Record):
    """A deceleration that holds from a speed on."""

    speed_mps: NonNegative
    deceleration_mps2: Positive


class EtcsTable(SourcedRecord):
    """What ETCS knows of a train's brakes; times in s, by the names of `etcs.Supervision`."""

    emergency: Annotated[tuple[EtcsStep, ...], Field(min_length=1)]
    service: Annotated[tuple[EtcsStep, ...], Field(min_length=1)]
    dry: _Share = 1.0
    wet: _Share = 1.0
    traction_s: NonNegative = 0.0
    emergency_s: NonNegative = 0.0
    service_s: NonNegative = 0.0
    speed_uncertainty: Annotated[float, Strict(), Field(ge=0, lt=0.3, allow_inf_nan=False)] = 0.0
    release_mps: Positive = 40 / 3.6
