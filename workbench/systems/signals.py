"""Signals of time with their rates: constants, steps, ramps, sines and twice differentiable splines.

A signal of any kind becomes a row of numbers, so that compiled code serves all of them and no value is compiled in.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationError, model_validator
from scipy.interpolate import CubicSpline

from workbench.errors import InputError
from workbench.files.text import read_text
from workbench.files.toml import Number, Positive, Record, Text, mistake
from workbench.systems.symbols import is_finite, plain, written

Array = NDArray[np.float64]
# Kinds in a row of numbers: kind, offset, slope or height or amplitude, start or angular rate, phase, first piece, how
# many pieces.
POLYNOMIAL, STEP, SINE, SPLINE = 0.0, 1.0, 2.0, 3.0
WIDTH = 7
AT_ONCE = 1e-9  # s: a step so close ahead has come, as in compiled code: rounding alone keeps 3 * 0.3 below 0.9
MOST_ROWS = 100_000
JUMPS_BEFORE = 1e-9  # s: what rounding may take from a sample's time; the compiled loop allows the same


class _Signal(Record):
    """A signal made in Python: what is wrong with it is a ValueError of one line, as of all that a run is made with."""

    def __init__(self, *given: Any, **values: Any) -> None:
        kind = type(self).__name__
        if given:
            names = ", ".join(f"{name}=..." for name in type(self).model_fields if name != "kind")
            raise ValueError(f"{kind} takes its values by name: write {kind}({names})")
        try:
            super().__init__(**values)
        except ValidationError as trouble:
            key, what = mistake(trouble, values)
            raise ValueError(f"{kind}: {key}{': ' * bool(key)}{what}") from None

    # So pydantic reads a file's tables without it, and a mistake there keeps its file and key.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]


class Constant(_Signal):
    """The same value at all times."""

    kind: Literal["constant"] = "constant"
    value: Number


class Step(_Signal):
    """`before` until at_s, `after` from then on; its rates are zero."""

    kind: Literal["step"] = "step"
    before: Number = 0.0
    after: Number
    at_s: Number = 0.0


class Ramp(_Signal):
    """offset + slope_per_s * t."""

    kind: Literal["ramp"] = "ramp"
    offset: Number = 0.0
    slope_per_s: Number


class Sine(_Signal):
    """offset + amplitude * sin(2 pi t / period_s + phase_rad)."""

    kind: Literal["sine"] = "sine"
    offset: Number = 0.0
    amplitude: Number
    period_s: Positive
    phase_rad: Number = 0.0


class Spline(_Signal):
    """The natural cubic spline through points, constant rates beyond its ends; from a CSV file's columns or as given.

    file: CSV whose first line names its columns, relative to the file that names it; `t_s` and `column` are used.
    """

    kind: Literal["spline"] = "spline"
    file: Text | None = None
    column: Text | None = None
    times_s: tuple[Number, ...] = ()
    values: tuple[Number, ...] = ()

    @model_validator(mode="after")
    def _fits(self) -> Spline:
        if (self.file is None) == (not self.times_s):
            raise ValueError("a spline has either a file with its column, or times_s and values: give one of them")
        if self.file is not None and self.column is None:
            raise ValueError("column is missing: name the column of the file")
        if len(self.times_s) != len(self.values):
            raise ValueError(f"times_s has {len(self.times_s)} numbers and values {len(self.values)}: give one value a "
                             "time")
        if self.times_s and (len(self.times_s) < 2 or any(b <= a for a, b in zip(self.times_s, self.times_s[1:],
                                                                                   strict=False))):
            raise ValueError("times_s do not increase: sort them, at least two, each once")
        return self


Signal = Annotated[Constant | Step | Ramp | Sine | Spline, Field(discriminator="kind")]
AnySignal = Constant | Step | Ramp | Sine | Spline


def signal_of(value: Any, where: str) -> AnySignal:
    """A signal, a number as one that is constant; ValueError naming `where` for anything else."""
    if isinstance(value, AnySignal):
        return read_signal(value, Path())  # a study has read its files already, relative to its own
    value = plain(value)
    if is_finite(value):
        return Constant(value=float(value))
    raise ValueError(f"{where} = {written(value)} is no signal: give a number, Constant, Step, Ramp, Sine, or a Spline "
                     "through points")


def read_signal(signal: AnySignal, folder: Path) -> AnySignal:
    """The signal with what its file holds; InputError naming the file, row and remedy."""
    if not isinstance(signal, Spline) or signal.file is None:
        return signal
    path = folder / signal.file
    try:
        found = _points(path, str(signal.column))
    except csv.Error as trouble:
        raise InputError(path, "", f"is not CSV ({trouble}): write it anew") from None
    try:
        return Spline(times_s=tuple(t for t, _ in found), values=tuple(v for _, v in found))
    except ValueError:
        raise InputError(path, "t_s", "has fewer than two rows, or times that do not increase: sort them") from None


def _points(path: Path, column: str) -> list[tuple[float, float]]:
    rows = csv.DictReader(io.StringIO(read_text(path, "CSV")))
    for name in ("t_s", column):
        if name not in (rows.fieldnames or ()):
            raise InputError(path, name, "is no column: the first line must name it")
    found: list[tuple[float, float]] = []
    for number, row in enumerate(rows, 2):
        try:
            pair = float(row["t_s"]), float(row[column])
        except (TypeError, ValueError):
            pair = math.nan, math.nan
        if not all(map(math.isfinite, pair)) or len(found) == MOST_ROWS:
            raise InputError(path, f"line {number}", f"has no finite number in t_s or {column}, or is more than "
                             f"{MOST_ROWS} rows: correct it")
        found.append(pair)
    return found


def table_of(signals: Sequence[AnySignal]) -> tuple[Array, Array]:
    """A row of WIDTH numbers a signal, and the pieces of all splines: begin and four coefficients a row."""
    rows = np.zeros((len(signals), WIDTH))
    pieces: list[Array] = []
    for row, signal in zip(rows, signals, strict=True):
        match signal:
            case Constant(value=value):
                row[:2] = POLYNOMIAL, value
            case Ramp(offset=offset, slope_per_s=slope):
                row[:3] = POLYNOMIAL, offset, slope
            case Step(before=before, after=after, at_s=at):
                row[:4] = STEP, before, after - before, at
            case Sine(offset=offset, amplitude=amplitude, period_s=period, phase_rad=phase):
                row[:5] = SINE, offset, amplitude, 2 * math.pi / period, phase
            case _:
                found = _pieces(signal)
                row[0], row[5], row[6] = SPLINE, sum(map(len, pieces)), len(found)
                pieces.append(found)
    return rows, np.concatenate(pieces) if pieces else np.zeros((0, 5))


def _pieces(signal: Spline) -> Array:
    """Straight before, the spline's pieces, straight after: [begin, c0, c1, c2, c3] each, about its begin."""
    spline = CubicSpline(signal.times_s, signal.values, bc_type="natural")
    first, last = signal.times_s[0], signal.times_s[-1]
    inner = np.column_stack([spline.x[:-1], *spline.c[::-1]])
    # The first row has no begin of its own: what is before the second row's begin belongs to it.
    return np.vstack([[first, spline(first), spline(first, 1), 0.0, 0.0], inner,
                      [last, spline(last), spline(last, 1), 0.0, 0.0]])


def signals_at(signals: Mapping[str, AnySignal], t: float | Array) -> dict[str, Array]:
    """Value, rate, second and third rate of each signal at times: arrays of four rows."""
    return {name: _at(signal, np.atleast_1d(np.asarray(t, dtype=float))) for name, signal in signals.items()}


def _at(signal: AnySignal, t: Array) -> Array:
    zero = np.zeros_like(t)
    match signal:
        case Constant(value=value):
            return np.array([zero + value, zero, zero, zero])
        case Ramp(offset=offset, slope_per_s=slope):
            return np.array([offset + slope * t, zero + slope, zero, zero])
        case Step(before=before, after=after, at_s=at):
            return np.array([np.where(t + AT_ONCE < at, before, after), zero, zero, zero])
        case Sine(offset=offset, amplitude=a, period_s=period, phase_rad=phase):
            w = 2 * math.pi / period
            angle = w * t + phase
            return np.array([offset + a * np.sin(angle), a * w * np.cos(angle), -a * w**2 * np.sin(angle),
                             -a * w**3 * np.cos(angle)])
    pieces = _pieces(signal)
    row = np.searchsorted(pieces[1:, 0], t, side="right")
    dt, (_, c0, c1, c2, c3) = t - pieces[row, 0], pieces[row].T
    return np.array([c0 + dt * (c1 + dt * (c2 + dt * c3)), c1 + dt * (2 * c2 + 3 * dt * c3), 2 * c2 + 6 * dt * c3,
                     6 * c3])
