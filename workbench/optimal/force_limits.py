"""What resists a train and what drives and brakes it at a speed, for compiled code."""

from __future__ import annotations

import numpy as np

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance

# Force and power of traction and of the electric brake.
Limits = tuple[tuple[float, float], tuple[float, float]]
# The tables of traction, of the electric brake and of both brakes together, shape (k, 2); empty for none.
Tables = tuple[Array, Array, Array]
NO_TABLE = np.zeros((0, 2))
compiled_resistance = compiled()(davis_resistance)


@compiled(error_model="numpy", _nrt=False)
def force_in(table: Array, v: float) -> float:
    """A table's force at a speed, with the bits of np.interp, which makes arrays for it and takes long to compile."""
    low, high = 0, len(table) - 1
    if v >= table[high, 0]:
        return float(table[high, 1])
    if v <= table[0, 0]:
        return float(table[0, 1])
    while high - low > 1:
        middle = (low + high) // 2
        if v >= table[middle, 0]:
            low = middle
        else:
            high = middle
    if v == table[low, 0]:
        return float(table[low, 1])
    slope = (table[high, 1] - table[low, 1]) / (table[high, 0] - table[low, 0])
    return float(slope * (v - table[low, 0]) + table[low, 1])


@compiled(error_model="numpy", _nrt=False)
def force_within(limit: tuple[float, float], table: Array, v: float) -> float:
    """The least of force limit[0], power limit[1] and the table, at speed v."""
    force = limit[0] if v * limit[0] <= limit[1] else limit[1] / v
    if len(table):
        force = min(force, force_in(table, v))
    return float(force)


@compiled(error_model="numpy", _nrt=False)
def braking_within(limits: Limits, tables: Tables, friction: float, v: float) -> float:
    """What both brakes together give at speed v."""
    force = force_within(limits[1], tables[1], v) + friction
    if len(tables[2]):
        force = min(force, force_in(tables[2], v))
    return float(force)


def resistance_numbers(vehicle: Vehicle) -> tuple[float, ...]:
    """Inertia, Davis' numbers and the friction brake for compiled code, to which arrays are dearer than floats."""
    return tuple(map(float, (vehicle.inertia_kg, *vehicle.davis_n, vehicle.friction_brake_n)))


def device_limits(vehicle: Vehicle) -> tuple[Limits, Tables]:
    """Traction and brakes for compiled code: (force, power) of traction and electric brake, and the tables."""
    both = (vehicle.traction, vehicle.regenerative)
    pairs = [(float(limit.force_n), float(limit.power_w)) for limit in both]
    tables = [np.array(table, dtype=float) if table else NO_TABLE
              for table in (both[0].table, both[1].table, vehicle.braking_table)]
    return (pairs[0], pairs[1]), (tables[0], tables[1], tables[2])
