"""A bound's certificate as a file that `bound_checker.py` re-checks in exact arithmetic."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import SolverError
from workbench.json_output import write_json
from workbench.optimal.bound import auxiliary_part, bound_terms, cell_limits, fixed_part, minima
from workbench.optimal.bound_checker import checked_bound
from workbench.optimal.course import Course
from workbench.optimal.reference import Reference
from workbench.optimal.vehicle import Vehicle

# Each value is claimed a little lower than it was found, so that rounding cannot spoil it.
SLACK = 1e-10


def bound_document(vehicle: Vehicle, course: Course, found: Reference, start_mps: float,
                   end_mps: float) -> dict[str, Any]:
    """The certificate as data; its `lower_bound_J` is what it proves."""
    certificate = found.certificate
    terms = bound_terms(vehicle, course, certificate)
    size = (np.abs(terms.constant) + np.abs(terms.inverse) / np.maximum(terms.high, 1e-3)
            + np.abs(terms.slope) * terms.high + np.abs(terms.square) * terms.high**2)
    values = minima(terms) - SLACK * size
    document: dict[str, Any] = {
        "version": 1, "cell_m": np.diff(certificate.position_m).tolist(),
        "limit_mps": cell_limits(course, certificate).tolist(),
        "fixed_j": (fixed_part(vehicle, course, certificate, found.asked_time_s, start_mps, end_mps)
                    + auxiliary_part(vehicle, course, certificate, found.asked_time_s)),
        "terms": {"cell": terms.cell.astype(int).tolist(), "end": terms.end.astype(int).tolist(),
                  "low": terms.low.tolist(), "high": terms.high.tolist(), "inverse": terms.inverse.tolist(),
                  "constant": terms.constant.tolist(), "slope": terms.slope.tolist(),
                  "square": terms.square.tolist(), "value": values.tolist()}}
    try:
        proven = float(checked_bound(document))
    except ValueError as trouble:
        raise SolverError(f"the bound's certificate does not hold in exact arithmetic ({trouble}): solve with other "
                          "intervals") from None
    return document | {"lower_bound_J": np.nextafter(proven, -np.inf).item()}


def write_certificate(path: Path, vehicle: Vehicle, course: Course, found: Reference, start_mps: float,
                      end_mps: float) -> float:
    """Write the re-checked certificate; returns the bound in J that it proves."""
    document = bound_document(vehicle, course, found, start_mps, end_mps)
    write_json(path, document)
    return float(document["lower_bound_J"])
