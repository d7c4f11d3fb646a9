"""A line as sections of grade, curve and tunnel, and the additional resistance they cause."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, Strict, model_validator

from workbench.files.text import CHECK_PATH
from workbench.files.toml import NonNegative, Positive, Record, SourcedRecord, Text, load_record


class Section(Record):
    """A stretch of line from start_m to end_m."""

    start_m: NonNegative
    end_m: Positive

    @model_validator(mode="after")
    def _ends_after_its_start(self) -> Self:
        if self.end_m <= self.start_m:
            raise ValueError(f"end_m = {self.end_m:g} must be greater than start_m = {self.start_m:g}")
        return self


class GradeSection(Section):
    """Constant grade in per mille, rising positive; plausible to +-100."""

    grade_permille: Annotated[float, Strict(), Field(ge=-100, le=100, allow_inf_nan=False)]


class CurveSection(Section):
    """Constant curve radius in m; straight track is written radius_m = inf."""

    radius_m: Annotated[float, Strict(), Field(gt=0, allow_inf_nan=True)]

    @model_validator(mode="after")
    def _plausible_radius(self) -> Self:
        if not self.radius_m >= 50:
            raise ValueError(
                f"radius_m = {self.radius_m:g} is not a railway curve: give at least 50 (metres), or inf"
            )
        return self


class TunnelSection(Section):
    """Tunnel with its additional air resistance in N per kN of train weight."""

    resistance_n_per_kn: NonNegative


class SpeedSection(Section):
    """Speed limit in m/s, from start_m to end_m."""

    speed_mps: Annotated[float, Strict(), Field(ge=0.1, le=200, allow_inf_nan=False)]


class Track(SourcedRecord):
    """A line: grade and curve cover it without gap or overlap; tunnels may leave gaps (open air).

    speed_limit, where given, covers it too. stops_m: where trains may stop, ends included; without it, the ends alone.
    """

    name: Text
    length_m: Annotated[float, Strict(), Field(gt=0, le=2e7, allow_inf_nan=False)]
    grade: tuple[GradeSection, ...]
    curve: tuple[CurveSection, ...]
    tunnel: tuple[TunnelSection, ...] = ()
    speed_limit: tuple[SpeedSection, ...] = ()
    stops_m: tuple[NonNegative, ...] = ()

    @model_validator(mode="after")
    def _sections_cover_the_line(self) -> Self:
        _require_cover("grade", self.grade, self.length_m)
        _require_cover("curve", self.curve, self.length_m)
        _require_order("tunnel", self.tunnel, self.length_m)
        if "speed_limit" in self.model_fields_set:
            _require_cover("speed_limit", self.speed_limit, self.length_m)
        if "stops_m" in self.model_fields_set:
            ends = (self.stops_m[0], self.stops_m[-1]) if self.stops_m else ()
            if ends != (0.0, self.length_m) or any(b <= a for a, b in pairwise(self.stops_m)):
                raise ValueError(f"stops_m: must increase from 0 to length_m = {self.length_m:g}: sort them, "
                                 "and name both ends")
        return self


def _require_order(kind: str, sections: Sequence[Section], length_m: float) -> None:
    for number, (one, two) in enumerate(pairwise(sections), start=1):
        if two.start_m < one.start_m:
            raise ValueError(f"{kind}[{number}]: positions must increase, but {two.start_m:g} m comes after "
                             f"{one.start_m:g} m: sort the sections")
        if two.start_m < one.end_m:
            raise ValueError(f"{kind}[{number}]: overlap from {two.start_m:g} m to {one.end_m:g} m: "
                             f"let each section start where the one before ends")
    if sections and sections[-1].end_m > length_m:
        raise ValueError(f"{kind}[{len(sections) - 1}]: ends at {sections[-1].end_m:g} m, "
                         f"beyond length_m = {length_m:g}: shorten it or correct length_m")


def _require_cover(kind: str, sections: Sequence[Section], length_m: float) -> None:
    if not sections:
        raise ValueError(f"{kind}: no section given: cover the line from 0 to {length_m:g} m")
    _require_order(kind, sections, length_m)
    reached = 0.0
    for number, section in enumerate(sections):
        if section.start_m > reached:
            raise ValueError(f"{kind}[{number}]: gap from {reached:g} m to {section.start_m:g} m: "
                             f"let each section start where the one before ends")
        reached = section.end_m
    if reached < length_m:
        raise ValueError(f"{kind}: gap from {reached:g} m to the end of the line at {length_m:g} m: "
                         f"lengthen the last section or correct length_m")


@dataclass(frozen=True)
class ResistanceTable:
    """Additional resistance along a line: value k holds from position_m[k] to position_m[k+1].

    position_m: shape (n,), m, increasing from 0; specific_force: shape (n,), N per kg, opposing motion; linear: value k
    is that at position_m[k], from where it changes evenly to the next. The end values hold beyond the ends.
    """

    position_m: NDArray[np.float64]
    specific_force: NDArray[np.float64]
    linear: bool = False

    def at(self, position_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Resistance in N per kg at positions in m; the end values hold beyond the line's ends."""
        if self.linear:
            return np.interp(position_m, self.position_m, self.specific_force)
        index = np.clip(np.searchsorted(self.position_m, position_m, side="right") - 1, 0, None)
        return self.specific_force[index]

    def pieces(self) -> NDArray[np.float64]:
        """A row for each position, for compiled loops: the resistance there (N/kg), and its change a metre from it on.

        Before the first position the row of it holds, which therefore must not change: ValueError where it does.
        """
        slopes = np.zeros(len(self.position_m))
        if self.linear:
            slopes[:-1] = np.diff(self.specific_force) / np.diff(self.position_m)
            if slopes[0]:
                raise ValueError("a line's resistance must not change before its second position")
        return np.stack((self.specific_force, slopes), axis=1)


def resistance_table(track: Track, length_m: float | None = None) -> ResistanceTable:
    """The additional resistance of `track` by section, from `additional_specific_resistance`.

    length_m: of a train with its front at a position, over which it is averaged.
    """
    return _resistance_table(track.grade, track.curve, track.tunnel, track.length_m, length_m)


# The same for every run on a line; nobody writes into its arrays.
@lru_cache(maxsize=32)
def _resistance_table(grade: tuple[GradeSection, ...], curve: tuple[CurveSection, ...],
                      tunnel: tuple[TunnelSection, ...], end_m: float, length_m: float | None) -> ResistanceTable:
    layers: tuple[Sequence[Section], ...] = (grade, curve, tunnel)
    borders = {edge for layer in layers for s in layer for edge in (s.start_m, s.end_m)}
    starts = np.array(sorted(edge for edge in borders if edge < end_m))
    resistance = _resistance()
    values = [
        resistance(
            next(s.grade_permille for s in grade if s.start_m <= x < s.end_m),
            1 / next(s.radius_m for s in curve if s.start_m <= x < s.end_m),
            next((s.resistance_n_per_kn for s in tunnel if s.start_m <= x < s.end_m), 0.0),
        )
        for x in starts
    ]
    return over_length(ResistanceTable(starts, np.array(values, dtype=float)), length_m)


@cache
def _resistance() -> Callable[[float, float, float], float]:
    """Of a grade (per mille), a curvature (1/m) and a tunnel's resistance (N/kN); made once, which takes longer than
    a line."""
    import sympy as sp  # noqa: PLC0415 - lines are read by commands that need no expressions

    from workbench.trains.line_resistance import (  # noqa: PLC0415 - as above
        additional_specific_resistance,
        curvature_per_m,
        grade_permille,
        tunnel_n_per_kn,
    )

    # Of plain numbers: by default all of scipy's special functions would be imported first.
    found: Callable[[float, float, float], float] = sp.lambdify(
        (grade_permille, curvature_per_m, tunnel_n_per_kn), additional_specific_resistance(), modules="math")
    return found


def over_length(table: ResistanceTable, length_m: float | None) -> ResistanceTable:
    """The mean of a table of steps over the length behind a position; behind the line's start its first value holds.

    It changes evenly while an edge lies under the train, and is kept as that: held in pieces, it would push the train
    by small steps, which are felt as jerk. length_m: None for a point, which meets the table as it is.
    """
    if not length_m:
        return table
    edges, values = table.position_m, table.specific_force
    places = np.unique(np.concatenate([edges, edges[1:] + length_m]))
    # What every edge adds, by the share of the train that is beyond it.
    shares = np.clip((places[:, None] - edges[1:]) / length_m, 0.0, 1.0)
    return ResistanceTable(places, values[0] + shares @ np.diff(values), linear=True)


def speed_limits(track: Track) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where the line's speed limits begin (m) and what they are (m/s); inf where there is none, so beyond its end."""
    found = track.speed_limit
    if not found:
        return np.zeros(1), np.full(1, np.inf)
    return (np.array([*(section.start_m for section in found), found[-1].end_m]),
            np.array([*(section.speed_mps for section in found), np.inf]))


def load_track(path: Path, reproduction: bool = False, where: str = CHECK_PATH) -> Track:
    """Load a line from TOML; raises InputError naming file and key. reproduction: every value needs its source; where:
    what to do when there is no such file."""
    return load_record(path, Track, reproduction, where)
