"""Adhesion as a limit of forces over speed, in the form that runs, bounds and their checker take: tables.

The largest force that wheels pass on, falling and convex in the speed (`trains/actuator.py`, Curtius and Kniffler),
lies above its tangents and below its chords. Runs keep to the tangents, so that they can be driven; bounds are proved
of a train with the chords, which can do whatever the curve allows. For the usual numbers both are within a thousandth
of the curve up to 90 m/s.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.inputs.line_checks import FASTEST_MPS
from workbench.optimal.vehicle import ForceLimit, Vehicle
from workbench.trains.actuator import Adhesion
from workbench.trains.resistance import STANDARD_GRAVITY_MPS2

TANGENTS = 25
# Chords are lifted by so much of their force, more than rounding takes from it.
LIFTED = 1e-12
Table = tuple[tuple[float, float], ...]


def _touched(adhesion: Adhesion, mass_kg: float, top_mps: float) -> tuple[Array, Array, Array]:
    """Speeds in m/s from standstill to the top speed, the curve there in N, and its slope."""
    weight = adhesion.factor * adhesion.adhesive_share * mass_kg * STANDARD_GRAVITY_MPS2
    # Closer to each other where the curve bends more.
    ends = np.geomspace(adhesion.offset_kmh, adhesion.offset_kmh + 3.6 * top_mps, TANGENTS)
    touch = (ends - adhesion.offset_kmh) / 3.6
    touch[0], touch[-1] = 0.0, top_mps
    force = weight * (adhesion.decay_kmh / ends + adhesion.floor)
    return touch, force, -weight * adhesion.decay_kmh * 3.6 / ends**2


def adhesion_table(adhesion: Adhesion, mass_kg: float, top_mps: float) -> Table:
    """(speed, force) points of tangents from standstill to the top speed, in m/s and N: nowhere above the curve."""
    touch, force, slope = _touched(adhesion, mass_kg, top_mps)
    points = [(0.0, float(force[0]))]
    for (v, one, fall), (w, two, less) in pairwise(zip(touch, force, slope, strict=True)):
        if less > fall:
            meet = (two - one + fall * v - less * w) / (fall - less)
            points.append((float(meet), float(one + fall * (meet - v))))
    return (*points, (float(top_mps), float(force[-1])))


def chord_table(adhesion: Adhesion, mass_kg: float, top_mps: float) -> Table:
    """(speed, force) points of chords from standstill to the top speed, in m/s and N: nowhere below the curve."""
    touch, force, _ = _touched(adhesion, mass_kg, top_mps)
    return tuple((float(v), float(most * (1 + LIFTED))) for v, most in zip(touch, force, strict=True))


def least_of(one: Table, two: Table) -> Table:
    """The least of two tables, exactly: their points and where they cross; one without points is no limit."""
    if not one or not two:
        return one or two
    speeds = sorted({speed for speed, _ in (*one, *two)})
    first, second = (np.interp(speeds, [v for v, _ in table], [n for _, n in table]) for table in (one, two))
    points = []
    for k, speed in enumerate(speeds):
        points.append((speed, float(min(first[k], second[k]))))
        if k + 1 < len(speeds) and (gap := first[k] - second[k]) * (then := first[k + 1] - second[k + 1]) < 0:
            share = gap / (gap - then)
            points.append((float(speed + share * (speeds[k + 1] - speed)),
                           float(first[k] + share * (first[k + 1] - first[k]))))
    return tuple(points)


def with_adhesion(adhesion: Adhesion, vehicle: Vehicle) -> Vehicle:
    """The train as adhesion limits its traction, and both of its brakes together, with the one that bounds are of."""
    top = min(vehicle.max_speed_mps, FASTEST_MPS)
    pull = vehicle.traction

    def within(table: Table) -> Vehicle:
        return replace(vehicle, traction=ForceLimit(pull.force_n, pull.power_w, least_of(pull.table, table)),
                       braking_table=table)

    low, high = (within(table(adhesion, vehicle.mass_kg, top)) for table in (adhesion_table, chord_table))
    return replace(low, bounded=high)
