"""A bound's certificate as a file that `bound_checker.py` re-checks in exact arithmetic."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError, SolverError
from workbench.files.json_output import write_json
from workbench.optimal.bound_checker import (
    REFUSALS,
    VERSION,
    checked_bound,
    proven_bound,
    read_certificate,
    stated_digests,
)
from workbench.optimal.course import Course
from workbench.optimal.reference import Reference
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import ForceLimit, Vehicle


def bound_document(vehicle: Vehicle, course: Course, found: Reference, start_mps: float,
                   end_mps: float) -> dict[str, Any]:
    """The certificate as data; its `lower_bound_J` is what it proves."""
    certificate, timetable = found.certificate, found.timetable
    course = timetable.on(course)
    document: dict[str, Any] = {
        "version": VERSION, "digests": digests(vehicle, course, timetable, start_mps, end_mps),
        **_stated(vehicle, course, start_mps, end_mps),
        "p": {"position_m": certificate.position_m.tolist(), "left": certificate.left.tolist(),
              "right": certificate.right.tolist()},
        "origin_s": timetable.origin_s, "auxiliary_w": certificate.auxiliary_w,
        "events": _events(timetable, certificate.prices_w(timetable).tolist())}
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
    """The run and the train as they stand in certificates: the train of which bounds are proved."""
    vehicle = vehicle.proven
    return {
        "run": {"position_m": course.position_m.tolist(), "limit_mps": course.limit_mps.tolist(),
                "force_n": course.force_n.tolist(), "drag": course.drag.tolist(), "stops_m": list(course.stops_m),
                "points": [[p.position_m, p.slowest_mps, _finite(p.fastest_mps)] for p in course.points],
                "inertia_kg": float(vehicle.inertia_kg), "start_mps": float(start_mps), "end_mps": float(end_mps)},
        "train": {"davis_n": [float(value) for value in vehicle.davis_n], "traction": _limit(vehicle.traction),
                  "regenerative": _limit(vehicle.regenerative),
                  **{name: _finite(getattr(vehicle, name)) for name in (
                      "traction_efficiency", "regenerative_efficiency", "friction_brake_n", "max_acceleration_mps2",
                      "max_deceleration_mps2", "auxiliary_w")},
                  **({"braking_table": [[float(speed), float(force)] for speed, force in vehicle.braking_table]}
                     if vehicle.braking_table else {})}}


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
