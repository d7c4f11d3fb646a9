"""What traction and the electric brake give at a speed, for compiled code: force, power and a table of both."""

from __future__ import annotations

from workbench.compile.package_kernels import compiled
from workbench.optimal.course import Array

# Force and power of traction and of the electric brake.
Limits = tuple[tuple[float, float], tuple[float, float]]


@compiled(error_model="numpy")
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


@compiled(error_model="numpy")
def force_within(limit: tuple[float, float], table: Array, v: float) -> float:
    """The least of force limit[0], power limit[1] and the table, at speed v."""
    force = limit[0] if v * limit[0] <= limit[1] else limit[1] / v
    if len(table):
        force = min(force, force_in(table, v))
    return float(force)
