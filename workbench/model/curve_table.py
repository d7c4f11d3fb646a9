"""A desired curve from the rows of a CSV file, such as `workbench reference` writes: t_s, s_m, v_mps, a_mps2.

Between two rows stands the polynomial of degree five that has their positions, speeds and accelerations, so that the
curve is twice continuously differentiable and meets every row, however far apart the rows are.
"""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field

from workbench.errors import InputError, WorkbenchError
from workbench.files.text import read_text
from workbench.files.toml import SourcedRecord, Text
from workbench.model.desired_curve import FASTEST_MPS, DesiredCurve

WRITES_ONE = "`workbench reference LINE TRAIN --time S --csv FILE` writes one"
COLUMNS = ("t_s", "s_m", "v_mps", "a_mps2")
MOST_ROWS = 100_000
# Speeds and accelerations below it at an end are a standstill that was rounded.
STANDSTILL = 1e-5
# By how much a position may differ from what speeds and accelerations say: shares of the way and of what the
# accelerations add to it, and m.
OFF_WAY, OFF_ACCELERATION, OFF_M = 0.05, 0.25, 0.05


class Row(NamedTuple):
    """Time (s), position (m), speed (m/s) and acceleration (m/s^2) of one row."""

    t_s: float
    s_m: float
    v_mps: float
    a_mps2: float


class TableCurve(SourcedRecord):
    """A curve from a CSV file, its path relative to the file that names it; `rows` are filled in when it is read."""

    kind: Literal["table"]
    file: Text
    rows: Annotated[tuple[Row, ...], Field(max_length=0)] = ()

    def read(self, named_in: Path) -> TableCurve:
        """The same with the file's rows; raises InputError naming the file, the row and the remedy."""
        rows = read_rows(named_in.parent / self.file, f"{WRITES_ONE}, or check 'reference.file' in {named_in}")
        return self.model_copy(update={"rows": rows})

    def curve(self, length_m: float) -> DesiredCurve:
        """The curve; raises WorkbenchError where it is none, or does not end after length_m."""
        found = curve_through(self.rows)
        if abs(found.length_m - length_m) > 1.0:
            raise WorkbenchError(f"reference.file = '{self.file}' runs {found.length_m:.1f} m and the line is "
                                 f"{length_m:.1f} m long: make the curve for this line")
        return found


def read_rows(path: Path, where: str = WRITES_ONE) -> tuple[Row, ...]:
    """The rows of a CSV file with a header; columns beside COLUMNS are passed over. where: what to do without the file.

    Raises InputError naming the file, the row and the remedy.
    """
    text = read_text(path, "CSV", where)
    try:
        lines = csv.DictReader(io.StringIO(text))
        missing = [name for name in COLUMNS if name not in (lines.fieldnames or ())]
        if missing:
            raise InputError(path, missing[0], f"is no column: the first line must name {', '.join(COLUMNS)}")
        rows: list[Row] = []
        for line in lines:
            rows.append(_row(path, len(rows) + 1, line))
            if len(rows) > MOST_ROWS:
                raise InputError(path, "", f"has more than {MOST_ROWS} rows: write them further apart")
    except csv.Error as trouble:
        raise InputError(path, "", f"is not CSV ({trouble}): write it anew") from None
    try:
        curve_through(tuple(rows))
    except WorkbenchError as trouble:
        raise InputError(path, "", str(trouble)) from None
    return tuple(rows)


def _row(path: Path, number: int, line: dict[str, str | None]) -> Row:
    values = []
    for name in COLUMNS:
        try:
            values.append(float(line[name] or ""))
        except ValueError:
            values.append(math.nan)
        if not math.isfinite(values[-1]):
            raise InputError(path, name, f"row {number} has '{str(line[name])[:40]}', which is no finite number: "
                             "correct it")
    return Row(*values)


def curve_through(rows: tuple[Row, ...]) -> DesiredCurve:
    """The curve of degree five between rows, from time and position 0; raises WorkbenchError where it is none."""
    if len(rows) < 2:
        raise WorkbenchError("desired curve: fewer than two rows: give the whole curve")
    t, s, v, a = np.array(rows, dtype=float).T
    h = np.diff(t)
    if not np.all(h > 0):
        raise WorkbenchError(f"desired curve: row {int(np.argmin(h > 0)) + 2} is no later than the one before: sort "
                             "the rows by time")
    for k, end in ((0, "start"), (-1, "end")):
        if max(abs(v[k]), abs(a[k])) > STANDSTILL:
            raise WorkbenchError(f"desired curve: it {end}s at {v[k]:g} m/s and {a[k]:g} m/s^2: let it {end} at a "
                                 "standstill")
        v[k] = a[k] = 0.0
    if np.abs(v).max() > FASTEST_MPS:
        raise WorkbenchError(f"desired curve: {np.abs(v).max():g} m/s is above {FASTEST_MPS:g}: is it in km/h?")
    way = np.diff(s)
    off = np.abs(way - h * (v[1:] + v[:-1]) / 2 - h**2 * (a[:-1] - a[1:]) / 12)
    added = h**2 * (np.abs(a[:-1]) + np.abs(a[1:])) / 12
    wrong = off > OFF_WAY * np.abs(way) + OFF_ACCELERATION * added + OFF_M
    if np.any(wrong):
        k = int(np.argmax(wrong))
        raise WorkbenchError(f"desired curve: from row {k + 1} to {k + 2} the position grows by {way[k]:g} m, which "
                             f"speeds and accelerations miss by {off[k]:.3g} m: correct the units, or add rows")
    # In the share of the interval: position, speed and acceleration at both ends.
    first, last = np.stack((0 * way, h * v[:-1], h**2 * a[:-1])), np.stack((way, h * v[1:], h**2 * a[1:]))
    rest = last - np.stack((first.sum(axis=0) - first[2] / 2, first[1] + first[2], first[2]))
    c3 = 10 * rest[0] - 4 * rest[1] + rest[2] / 2
    c4 = -15 * rest[0] + 7 * rest[1] - rest[2]
    c5 = 6 * rest[0] - 3 * rest[1] + rest[2] / 2
    rows_of = np.stack((s[:-1] - s[0], v[:-1], a[:-1] / 2, c3 / h**3, c4 / h**4, c5 / h**5), axis=1)
    return DesiredCurve(t - t[0], rows_of)
