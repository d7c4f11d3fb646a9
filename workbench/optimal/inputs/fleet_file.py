"""A day's trips on lines as a TOML file: what each trip runs with, on and within which time."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, Strict, model_validator

from workbench.files.toml import NonNegative, Positive, SourcedRecord, Text


class Trip(SourcedRecord):
    """One trip. track and train: files relative to the fleet's, the fleet's own where none is named.

    time_s: with its stops, each of dwell_s. The speeds are those at both ends.
    """

    id: Text
    time_s: Positive
    track: Text | None = None
    train: Text | None = None
    stops: Annotated[bool, Strict()] = False
    dwell_s: NonNegative = 30.0
    from_m: NonNegative = 0.0
    to_m: Positive | None = None
    from_speed_mps: NonNegative = 0.0
    to_speed_mps: NonNegative = 0.0


class FleetFile(SourcedRecord):
    """Trips by name, with the line and the train of those that name none."""

    name: Text
    track: Text | None = None
    train: Text | None = None
    trips: Annotated[tuple[Trip, ...], Field(min_length=1, max_length=100_000)]

    @model_validator(mode="after")
    def _trips_are_told_apart(self) -> Self:
        seen: set[str] = set()
        for number, trip in enumerate(self.trips):
            if trip.id in seen:
                raise ValueError(f"trips[{number}].id = '{trip.id}' stands twice: give each trip a name of its own")
            seen.add(trip.id)
            for what in ("track", "train"):
                if getattr(trip, what) is None and getattr(self, what) is None:
                    raise ValueError(f"trips[{number}].{what} is missing, and the file names none for all: add one")
        return self
