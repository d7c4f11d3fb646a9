"""The best of several forms of p(s), piece by piece between places where all of them agree.

A bound is a sum over cells, borders and ends. Where all forms are continuous and have the same value, what is chosen on
one side has no part in what the other side adds; so the best of each piece makes the best of all their mixtures.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from workbench.optimal.bound import cell_bounds_of
from workbench.optimal.bound_fixed import fixed_part, fixed_parts
from workbench.optimal.certificate import Certificate
from workbench.optimal.course import Array, Course
from workbench.optimal.timetable import Timetable
from workbench.optimal.vehicle import Vehicle


def best_forms(vehicle: Vehicle, course: Course, forms: Sequence[Certificate], agreed_m: Array, timetable: Timetable,
               start_mps: float, end_mps: float) -> tuple[float, Certificate]:
    """The certificate that is on each piece that of the forms with the highest bound there, and its own bound, J.

    forms: on the same cells, at the same prices. agreed_m: where all have the same value, each a border of theirs.
    """
    x = forms[0].position_m
    cells = np.searchsorted(agreed_m, (x[1:] + x[:-1]) / 2)
    inner = np.searchsorted(agreed_m, x[1:-1], side="right")
    count = len(agreed_m) + 1
    added = np.empty((len(forms), count))
    bounds = cell_bounds_of(vehicle, course, forms, timetable)
    for k, fixed in enumerate(fixed_parts(vehicle, course, forms, timetable, start_mps, end_mps)):
        added[k] = np.bincount(cells, bounds[k] + fixed.line_j, count)
        added[k] += np.bincount(inner, fixed.jumps_j, count)
        added[k, [0, -1]] += fixed.ends_j
    best, every = np.argmax(added, axis=0)[cells], np.arange(len(cells))
    joined = replace(forms[0], left=np.stack([form.left for form in forms])[best, every],
                     right=np.stack([form.right for form in forms])[best, every])
    # A cell's part hangs on nothing but the cell.
    rest_j = fixed_part(vehicle, course, joined, timetable, start_mps, end_mps).total_j
    return float(bounds[best, every].sum()) + rest_j, joined
