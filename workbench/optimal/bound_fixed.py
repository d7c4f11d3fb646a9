"""What of a bound needs no minimisation: the line's force, the ends, the jumps of p, and the windows of time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array, Course
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import Vehicle


@dataclass(frozen=True)
class FixedPart:
    """Parts in J: line_j of the line's force on each cell, shape (n,), ends_j of the speeds at start and end, shape
    (2,), jumps_j of the jumps of p at the worst speed each, shape (n - 1,), time_j of the windows of time.
    """

    line_j: Array
    ends_j: Array
    jumps_j: Array
    time_j: float

    @property
    def total_j(self) -> float:
        """The sum of all parts, J."""
        return float(self.line_j.sum() + self.jumps_j.sum() + self.ends_j.sum()) + self.time_j


def fixed_part(vehicle: Vehicle, course: Course, certificate: Certificate, timetable: Timetable, start_mps: float,
               end_mps: float) -> FixedPart:
    """Of a certificate for all runs in a timetable from one speed in m/s to another."""
    return fixed_parts(vehicle, course, [certificate], timetable, start_mps, end_mps)[0]


def fixed_parts(vehicle: Vehicle, course: Course, forms: Sequence[Certificate], timetable: Timetable, start_mps: float,
                end_mps: float) -> list[FixedPart]:
    """Of several certificates on the same cells, at the same prices."""
    inertia = vehicle.inertia_kg
    x, fine = forms[0].position_m, course.split(forms[0].position_m[1:-1])
    owner = owner_of(x, fine.position_m)
    width = np.diff(x)[owner]
    start, end = fine.position_m[:-1] - x[owner], fine.position_m[1:] - x[owner]
    g, step = fine.force_n, np.diff(fine.position_m)
    jump = np.searchsorted(fine.position_m, x[1:-1])
    least, most = course.speed_windows_mps(x[1:-1])
    most = np.minimum(most, np.minimum(fine.limit_mps[jump], fine.limit_mps[jump - 1]))
    time_j = forms[0].time_part_j(timetable)

    def of(form: Certificate) -> FixedPart:
        p_left, p_right = form.left, form.right
        p = [p_left[owner] + (p_right - p_left)[owner] * along / width for along in (start, end)]
        line = step * ((p[0] * g[:, 0] + p[1] * g[:, 1]) / 3 + (p[0] * g[:, 1] + p[1] * g[:, 0]) / 6)
        ends = inertia / 2 * np.array([-p_left[0] * start_mps**2, p_right[-1] * end_mps**2])
        fall = inertia / 2 * (p_right[:-1] - p_left[1:])
        jumps = np.minimum(fall, 0.0) * most**2 + np.maximum(fall, 0.0) * least**2
        return FixedPart(np.asarray(np.bincount(owner, line, len(p_left)), dtype=float), ends, jumps, time_j)

    return [of(form) for form in forms]


def owner_of(x: Array, fine: Array) -> NDArray[np.intp]:
    """The cell of x in which each cell of `fine` lies."""
    return np.searchsorted(x, (fine[1:] + fine[:-1]) / 2) - 1
