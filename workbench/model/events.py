"""What happens to a train at stated times: disturbances, changes of its resistance, failures of motors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, Strict, model_validator

from workbench.files.toml import NonNegative, Number, SourcedRecord

Array = NDArray[np.float64]
Share = Annotated[float, Strict(), Field(ge=0, le=1, allow_inf_nan=False)]
Frequency = Annotated[float, Strict(), Field(ge=0, le=1e3, allow_inf_nan=False)]
Push = Annotated[float, Strict(), Field(ge=-20, le=20, allow_inf_nan=False)]


class Term(SourcedRecord):
    """offset + amplitude sin(omega t + phase) from from_s on, before to_s (for ever when to_s is not given)."""

    from_s: NonNegative = 0.0
    to_s: NonNegative | None = None
    omega_rad_s: Frequency = 0.0
    phase_rad: Number = 0.0

    @model_validator(mode="after")
    def _ends_after_its_start(self) -> Self:
        if self.to_s is not None and self.to_s <= self.from_s:
            raise ValueError(f"to_s = {self.to_s:g} is not after from_s = {self.from_s:g}: correct one of them")
        return self

    def row(self, offset: float, amplitude: float) -> list[float]:
        """The row that the kernel reads: from, to, offset, amplitude, frequency, phase."""
        end = math.inf if self.to_s is None else self.to_s
        return [self.from_s, end, offset, amplitude, self.omega_rad_s, self.phase_rad]


class PushTerm(Term):
    """A part of the disturbance, against the train's motion, per unit of mass.

    With speed_power 1 or 2 it is multiplied by the speed or its square, its values then being in 1/s or 1/m: a
    resistance whose coefficients vary.
    """

    offset_mps2: Push = 0.0
    amplitude_mps2: Push = 0.0
    speed_power: Literal[0, 1, 2] = 0


class Disturbance(SourcedRecord):
    """The unknown disturbance, per unit of mass, positive against the train: a sine of time, and further terms."""

    amplitude_mps2: Annotated[float, Strict(), Field(ge=0, le=20, allow_inf_nan=False)]
    period_s: Annotated[float, Strict(), Field(ge=1e-2, allow_inf_nan=False)]
    terms: tuple[PushTerm, ...] = ()

    def rows(self) -> Array:
        """The terms as the kernel reads them."""
        rows = [[0.0, math.inf, 0.0, self.amplitude_mps2, 2 * math.pi / self.period_s, 0.0, 0.0]]
        return push_rows(self.terms, rows)


def push_rows(terms: Sequence[PushTerm], rows: Sequence[list[float]] = ()) -> Array:
    """Terms of a disturbance as the kernel reads them, after `rows`; those that are zero are left out."""
    every = [*rows, *([*term.row(term.offset_mps2, term.amplitude_mps2), term.speed_power] for term in terms)]
    return np.array([row for row in every if row[2] or row[3]], dtype=float).reshape(-1, 7)


class Mode(SourcedRecord):
    """The train's resistance from a time on: Davis coefficients per unit of mass, grade and curve in N per kg.

    The grade grows linearly from zero over grade_ramp_s, everything else jumps.
    """

    from_s: NonNegative
    davis_a_mps2: NonNegative
    davis_b_per_s: NonNegative
    davis_c_per_m: NonNegative
    grade_mps2: Push = 0.0
    curve_mps2: Push = 0.0
    grade_ramp_s: NonNegative = 0.0


class Failure(Term):
    """Motors that follow no command from from_s on: together they give offset_n + amplitude_n sin(...)."""

    failed_share: Share
    offset_n: Number = 0.0
    amplitude_n: Number = 0.0


def failure_rows(failures: Sequence[Failure]) -> Array:
    """Failures as the kernel reads them: a term in N, and the share of the motors that failed."""
    rows = [[*f.row(f.offset_n, f.amplitude_n), f.failed_share] for f in failures]
    return np.array(rows, dtype=float).reshape(-1, 7)


def mode_rows(modes: Sequence[Mode], mass_kg: float, factors: tuple[float, float, float]) -> Array:
    """Modes as the kernel reads them: time, Davis coefficients in N, N per kg; linear between the rows."""
    rows: list[list[float]] = []
    for mode in modes:
        davis = [mass_kg * value * factor for value, factor in zip(
            (mode.davis_a_mps2, mode.davis_b_per_s, mode.davis_c_per_m), factors, strict=True)]
        if rows:  # up to this instant what held before
            rows.append([mode.from_s, *rows[-1][1:]])
        ramped = mode.grade_ramp_s > 0
        rows.append([mode.from_s, *davis, mode.curve_mps2 + (0.0 if ramped else mode.grade_mps2)])
        if ramped:
            rows.append([mode.from_s + mode.grade_ramp_s, *davis, mode.curve_mps2 + mode.grade_mps2])
    return np.array(rows, dtype=float).reshape(-1, 5)
