"""A reference for other programs: JSON document, CSV, and python-control's time series."""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from workbench.errors import InputError
from workbench.files.writing import write_text
from workbench.optimal.course import Array, Course
from workbench.optimal.document_format import ReferenceDocument, TimingRow
from workbench.optimal.force_reserve import needed_force
from workbench.optimal.reference import Reference
from workbench.optimal.smooth import SmoothReference
from workbench.optimal.smooth_run import SmoothRun
from workbench.optimal.vehicle import Vehicle
from workbench.optimal.verify_smooth import SmoothCheck

if TYPE_CHECKING:
    import control

COLUMNS = ("t_s", "s_m", "v_mps", "a_mps2", "u_N")
# Of numbers in tables; the latter give back every bit.
DIGITS, EXACT_DIGITS = 12, 17
MOST_ROWS = 2_000_000
# A lower price of a second is rounding of the solver's.
LEAST_PRICE_W = 50.0


def reference_document(found: Reference, smooth: SmoothReference | None,
                       driven: SmoothCheck | None = None) -> ReferenceDocument:
    """The result as data, SI units: of the optimal run, and of the smooth one that tracks it with its simulation."""
    check = found.check
    document: ReferenceDocument = {
        "version": 1, "energy_J": found.energy_j, "lower_bound_J": found.lower_bound_j, "gap": found.gap,
        "trip_time_s": found.profile.trip_time_s, "solver": found.solver, "solve_s": found.solve_s,
        "status": found.status, "least_trip_time_s": found.least_time_s,
        "check": {"energy_J": check.energy_j, "position_drift_m": check.position_drift_m,
                  "speed_drift_mps": check.speed_drift_mps, "correction_N": check.correction_n,
                  "force_excess": check.force_excess,
                  "speed_excess_mps": check.speed_excess_mps},
        "timing_points": timing_rows(found, smooth)}
    if smooth is not None:
        document["smooth"] = {"energy_J": smooth.energy_j, "trip_time_s": smooth.run.trip_time_s,
                              "window_s": smooth.window_s, "max_jerk_mps3": smooth.max_jerk_mps3,
                              "force_excess": smooth.force_excess, "speed_excess_mps": smooth.speed_excess_mps,
                              "departure_s": float(smooth.clock_s[0]), "window_miss_s": smooth.miss_s,
                              "lower_bound_J": found.lower_bound_j, "gap": smooth_gap(found, smooth),
                              "usable_traction": smooth.usable[0], "usable_brakes": smooth.usable[1],
                              "energy_without_reserve_J": smooth.unreserved_energy_j}
    if smooth is not None and driven is not None:
        document["smooth"] |= {"simulated_energy_J": driven.energy_j, "position_drift_m": driven.position_drift_m,
                               "speed_drift_mps": driven.speed_drift_mps, "correction_N": driven.correction_n}
    return document


def smooth_gap(found: Reference, smooth: SmoothReference) -> float:
    """How far a smooth run's energy lies above the bound of all runs, as a share of it; absolute for no energy."""
    above = smooth.energy_j - found.lower_bound_j
    return above / abs(smooth.energy_j) if smooth.energy_j else above


def timing_rows(found: Reference, smooth: SmoothReference | None) -> list[TimingRow]:
    """Each event of the timetable with its window, when and how fast the run meets it, and what binds.

    `time_s`: of the optimal run; `simulated_time_s`: of its simulation; `smooth_time_s`: of the smooth one. `binds`:
    'latest' or 'earliest' where the proof gives that limit a price, `price_W`: joules that a second of room would save.
    Limits that are not there are null.
    """
    timetable, profile = found.timetable, found.profile
    prices = found.certificate.prices_w(timetable).tolist()
    at = np.searchsorted(profile.position_m, timetable.position_m)
    late = (found.check.clock_s(profile) - profile.time_s)[at]
    rows: list[TimingRow] = []
    for k, (event, price) in enumerate(zip(timetable.events, prices, strict=True)):
        point, time, simulated = timetable.points[event.point], float(found.clock_s[k]), float(late[event.point])
        rows.append({
            "position_m": point.position_m, "kind": event.kind, "earliest_s": _limit(event.window.earliest_s),
            "latest_s": _limit(event.window.latest_s), "slowest_mps": point.slowest_mps,
            "fastest_mps": 0.0 if point.stands else _limit(point.fastest_mps), "dwell_s": event.dwell_s,
            "time_s": time, "simulated_time_s": time + simulated,
            "speed_mps": float(profile.speed_mps[at[event.point]]),
            "smooth_time_s": None if smooth is None else float(smooth.clock_s[k]),
            "binds": ("latest" if price > 0 else "earliest") if abs(price) >= LEAST_PRICE_W else None,
            "price_W": abs(price) if abs(price) >= LEAST_PRICE_W else 0.0})
    return rows


def _limit(value: float) -> float | None:
    return value if math.isfinite(value) else None


def samples(vehicle: Vehicle, course: Course, run: SmoothRun, every_s: float) -> Array:
    """Rows of COLUMNS, shape (n, 5), every `every_s` seconds and at the end; u is the force at the wheel.

    Raises InputError for a step that is none or asks for more than MOST_ROWS rows.
    """
    if not every_s > 0 or run.trip_time_s / every_s > MOST_ROWS:
        raise InputError("", "every", f"{every_s:g} s does not give between one and {MOST_ROWS} rows: choose another "
                         "step")
    time = np.append(np.arange(0.0, run.trip_time_s - 1e-9 * every_s, every_s), run.trip_time_s)
    s, v, a = run.at(time)
    # A train that stands is held by its brakes.
    force = np.where((v > 1e-9) | (np.abs(a) > 1e-9), needed_force(vehicle, course, s, v, a), 0.0)
    return np.column_stack((time, s, v, a, force))


def write_csv(path: Path, rows: Array, columns: tuple[str, ...] = COLUMNS, digits: int = DIGITS) -> None:
    """The rows under their header, with so many digits; raises InputError where the file cannot be written."""
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(columns)
    writer.writerows([f"{value:.{digits}g}" for value in row] for row in rows.tolist())
    write_text(path, text.getvalue())


def time_response(rows: Array) -> control.TimeResponseData:
    """The rows as python-control's time series: position, speed and acceleration as outputs, the force as input."""
    import control  # noqa: PLC0415 - importing it takes seconds, and most commands need none of it

    return control.TimeResponseData(rows[:, 0], rows[:, 1:4].T, None, rows[:, 4:5].T, issiso=False,
                                    output_labels=list(COLUMNS[1:4]), input_labels=[COLUMNS[4]])
