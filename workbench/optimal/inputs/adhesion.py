"""Adhesion as a limit of forces over speed, in the form that runs, bounds and their checker take: a table.

The largest force that wheels pass on, falling and convex in the speed (`trains/actuator.py`, Curtius and Kniffler), is
replaced by its tangents, so that no point of the table is above it; it is the table that a certified run keeps and of
which a bound speaks. Between the tangents' points it is below the curve by less than a thousandth.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from workbench.errors import InputError
from workbench.optimal.inputs.line_checks import FASTEST_MPS
from workbench.optimal.vehicle import ForceLimit
from workbench.trains.actuator import Adhesion
from workbench.trains.resistance import STANDARD_GRAVITY_MPS2

TANGENTS = 32
Table = tuple[tuple[float, float], ...]


def adhesion_table(adhesion: Adhesion, mass_kg: float, top_mps: float) -> Table:
    """(speed, force) points of tangents from standstill to the top speed, in m/s and N."""
    weight = adhesion.factor * adhesion.adhesive_share * mass_kg * STANDARD_GRAVITY_MPS2
    # Closer to each other where the curve bends more.
    ends = np.geomspace(adhesion.offset_kmh, adhesion.offset_kmh + 3.6 * top_mps, TANGENTS)
    touch = (ends - adhesion.offset_kmh) / 3.6
    force = weight * (adhesion.decay_kmh / ends + adhesion.floor)
    slope = -weight * adhesion.decay_kmh * 3.6 / ends**2
    points = [(0.0, float(force[0]))]
    for (v, one, fall), (w, two, less) in pairwise(zip(touch, force, slope, strict=True)):
        if less > fall:
            meet = (two - one + fall * v - less * w) / (fall - less)
            points.append((float(meet), float(one + fall * (meet - v))))
    return (*points, (float(top_mps), float(force[-1])))


def least_of(one: Table, two: Table) -> Table:
    """The least of two tables, exactly: their points and where they cross; one without points is no limit."""
    if not one or not two:
        return one or two
    speeds = sorted({speed for speed, _ in (*one, *two)})
    first, second = (np.interp(speeds, *zip(*table, strict=True)) for table in (one, two))
    points = []
    for k, speed in enumerate(speeds):
        points.append((speed, float(min(first[k], second[k]))))
        if k + 1 < len(speeds) and (gap := first[k] - second[k]) * (then := first[k + 1] - second[k + 1]) < 0:
            share = gap / (gap - then)
            points.append((float(speed + share * (speeds[k + 1] - speed)),
                           float(first[k] + share * (first[k + 1] - first[k]))))
    return tuple(points)


def with_adhesion(adhesion: Adhesion, mass_kg: float, top_mps: float, traction: ForceLimit, regenerative: ForceLimit,
                  friction_brake_n: float) -> tuple[ForceLimit, ForceLimit]:
    """Traction and electric brake as adhesion allows them; the latter beside the other brake, which acts at any speed.

    top_mps: the highest speed, FASTEST_MPS where there is none. Raises InputError where the other brake alone asks for
    more adhesion than there is at the highest speed.
    """
    table = adhesion_table(adhesion, mass_kg, min(top_mps, FASTEST_MPS))
    left = table[-1][1] - friction_brake_n
    if left < 0:
        raise InputError("", "adhesion", f"leaves {table[-1][1]:.4g} N at the top speed, less than the "
                         f"{friction_brake_n:.4g} N of the brakes that are not electric: state that much less of "
                         "max_braking_n")
    beside = tuple((speed, force - friction_brake_n) for speed, force in table)
    return (ForceLimit(traction.force_n, traction.power_w, least_of(traction.table, table)),
            ForceLimit(regenerative.force_n, regenerative.power_w, least_of(regenerative.table, beside)))
