"""A bound's certificate as a file that `bound_checker.py` re-checks in exact arithmetic."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError, SolverError
from workbench.files.json_output import write_json
from workbench.optimal.bound import bound_terms, cell_limits, minima
from workbench.optimal.bound_checker import (
    REFUSALS,
    checked_bound,
    proven_bound,
    read_certificate,
    stated_digests,
)
from workbench.optimal.bound_fixed import fixed_part
from workbench.optimal.course import Course
from workbench.optimal.reference import Reference
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import ForceLimit, Vehicle

# Each value is claimed a little lower than it was found, so that rounding cannot spoil it.
SLACK = 1e-10
ROUNDING = 1e-13


def bound_document(vehicle: Vehicle, course: Course, found: Reference, start_mps: float,
                   end_mps: float) -> dict[str, Any]:
    """The certificate as data; its `lower_bound_J` is what it proves."""
    certificate, timetable = found.certificate, found.timetable
    course = timetable.on(course)
    terms = bound_terms(vehicle, course, certificate, timetable)
    fixed = fixed_part(vehicle, course, certificate, timetable, start_mps, end_mps)
    prices = certificate.prices_w(timetable)
    parts = (fixed.line_j, fixed.jumps_j, fixed.ends_j, fixed.time_j)
    size = (np.abs(terms.constant) + np.abs(terms.inverse) / np.maximum(terms.high, 1e-3)
            + np.abs(terms.slope) * terms.high + np.abs(terms.square) * terms.high**2)
    values = minima(terms) - SLACK * size
    document: dict[str, Any] = {
        "version": 3, "digests": digests(vehicle, course, timetable, start_mps, end_mps),
        **_stated(vehicle, course, start_mps, end_mps),
        "p": {"position_m": certificate.position_m.tolist(), "left": certificate.left.tolist(),
              "right": certificate.right.tolist()},
        "cell_m": np.diff(certificate.position_m).tolist(),
        "limit_mps": cell_limits(course, certificate).tolist(),
        "fixed_j": fixed.total_j - ROUNDING * sum(map(abs, parts)),
        "line_j": fixed.line_j, "ends_j": fixed.ends_j,
        "jumps": {"inertia_times_fall": fixed.jump.tolist(), "slowest_mps": fixed.slowest_mps.tolist(),
                  "fastest_mps": fixed.fastest_mps.tolist()},
        "start_m": float(certificate.position_m[0]), "origin_s": timetable.origin_s,
        "auxiliary_w": certificate.auxiliary_w,
        "events": _events(timetable, prices.tolist()),
        "cell_price_w": certificate.cell_prices_w(timetable).tolist(),
        "terms": {"cell": terms.cell.astype(int).tolist(), "end": terms.end.astype(int).tolist(),
                  "low": terms.low.tolist(), "high": terms.high.tolist(), "value": values.tolist(),
                  **{name: [int(k) for k in getattr(terms, name)] for name in ("pull", "brake", "electric")}}}
    try:
        proven = float(checked_bound(document))
    except ValueError as trouble:
        raise SolverError(f"the bound's certificate does not hold in exact arithmetic ({trouble}): solve with other "
                          "intervals") from None
    return document | {"lower_bound_J": np.nextafter(proven, -np.inf).item()}


def digests(vehicle: Vehicle, course: Course, timetable: Timetable, start_mps: float, end_mps: float) -> dict[str, str]:
    """What says of which line, train and times a certificate is: sha256 of each, as they were read.

    The course is the one on which the timetable's points and stops lie.
    """
    events = _events(timetable, [0.0] * len(timetable.events))
    return stated_digests(_stated(vehicle, course, start_mps, end_mps)
                          | {"events": events, "origin_s": float(timetable.origin_s)})


def _stated(vehicle: Vehicle, course: Course, start_mps: float, end_mps: float) -> dict[str, Any]:
    """The run and the train as they stand in certificates."""
    return {
        "run": {"position_m": course.position_m.tolist(), "limit_mps": course.limit_mps.tolist(),
                "force_n": course.force_n.tolist(), "drag": course.drag.tolist(), "stops_m": list(course.stops_m),
                "points": [[p.position_m, p.slowest_mps, _finite(p.fastest_mps)] for p in course.points],
                "inertia_kg": float(vehicle.inertia_kg), "start_mps": float(start_mps), "end_mps": float(end_mps)},
        "train": {"davis_n": [float(value) for value in vehicle.davis_n], "traction": _limit(vehicle.traction),
                  "regenerative": _limit(vehicle.regenerative),
                  **{name: _finite(getattr(vehicle, name)) for name in (
                      "traction_efficiency", "regenerative_efficiency", "friction_brake_n", "max_acceleration_mps2",
                      "max_deceleration_mps2", "auxiliary_w")}}}


def _limit(limit: ForceLimit) -> dict[str, Any]:
    return {"force_n": float(limit.force_n), "power_w": _finite(limit.power_w),
            "table": [[float(speed), float(force)] for speed, force in limit.table]}


def _finite(value: float) -> float | None:
    """The number; None for one that is infinite."""
    return float(value) if np.isfinite(value) else None


def _events(timetable: Timetable, prices_w: list[float]) -> list[dict[str, Any]]:
    """Windows and prices of the timetable in order; infinite limits are null."""
    return [{"position_m": timetable.points[event.point].position_m, "kind": event.kind, "waits": event.waits,
             "dwell_s": event.dwell_s, "price_w": price,
             "earliest_s": event.window.earliest_s if np.isfinite(event.window.earliest_s) else None,
             "latest_s": event.window.latest_s if np.isfinite(event.window.latest_s) else None}
            for event, price in zip(timetable.events, prices_w, strict=True)]


@dataclass(frozen=True)
class Proven:
    """What a certificate's file proves: a bound in J, of the line, train and times with these digests."""

    bound_j: float
    digests: dict[str, str]


def read_bound(path: Path) -> Proven:
    """A certificate's file, re-checked; raises InputError where it does not prove the bound that it states."""
    try:
        certificate = read_certificate(path)
        return Proven(float(proven_bound(certificate)), certificate["digests"])
    except REFUSALS as trouble:
        raise InputError(path, "", f"is no certificate of a bound: {trouble}") from None


def write_certificate(path: Path, vehicle: Vehicle, course: Course, found: Reference, start_mps: float,
                      end_mps: float) -> float:
    """Write the re-checked certificate; returns the bound in J that it proves."""
    document = bound_document(vehicle, course, found, start_mps, end_mps)
    write_json(path, document)
    return float(document["lower_bound_J"])
