"""Dynamic programming over position and half the squared speed: needs no convexity and no solver, knows no certificate.

The cost of time is a price; what is left out is the mesh: an interval has one force, and values between levels are
interpolated. As the mesh grows finer the result falls towards the optimum.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from workbench.optimal.course import Array, Course
from workbench.optimal.grid import graded_grid
from workbench.optimal.profile import largest_force
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance


@njit(cache=True)
def _before(after: Array, b: Array, top: float, h: float, against: Array, inertia: float, most: Array, electric: Array,
            friction: float, efficiency: float, regain: float, price_w: float) -> Array:
    """Values at the start of an interval, for each level, from those at its end; infinite where no force leads on."""
    found = np.full(len(b), np.inf)
    width = b[1] - b[0]
    for i in range(len(b)):
        if b[i] > top:
            continue
        low = b[i] - h * (electric[i] + friction + against[i]) / inertia
        high = b[i] + h * (most[i] - against[i]) / inertia
        first = int(np.ceil(max(low, 0.0) / width))
        # Every level that can be reached, and the kinks of the cost: both limits, coasting, all the electric brake.
        for q in range(-4, int(np.floor(high / width)) - first + 1):
            if q == -4:
                to = low
            elif q == -3:
                to = high
            elif q == -2:
                to = b[i] - h * against[i] / inertia
            elif q == -1:
                to = b[i] - h * (electric[i] + against[i]) / inertia
            else:
                to = b[first + q]
            j = int(to / width)
            if to < 0 or to < low - 1e-9 or to > high + 1e-9 or j >= len(b) - 1 or b[i] + to <= 0:
                continue
            share = to / width - j
            then = after[j] if share < 1e-9 else (1 - share) * after[j] + share * after[j + 1]
            u = inertia * (to - b[i]) / h + against[i]
            work = h * (u / efficiency if u > 0 else regain * max(u, -electric[i]))
            found[i] = min(found[i], then + work + price_w * 2 * h / (np.sqrt(2 * b[i]) + np.sqrt(2 * to)))
    return found


def least_cost(vehicle: Vehicle, course: Course, price_w: float, intervals: int, levels: int) -> float:
    """The least energy plus price times time, J, from standstill to standstill without stops on the way."""
    grid = graded_grid(course, intervals)
    b = np.linspace(0.0, float(grid.limit_mps.max()) ** 2 / 2 * 1.0005, levels)
    speed = np.sqrt(2 * b)
    a, b_1, c = vehicle.davis_n
    most, electric = largest_force(vehicle.traction, speed), largest_force(vehicle.regenerative, speed)
    value = np.where(b == 0, 0.0, np.inf)
    for k in range(len(grid.limit_mps) - 1, -1, -1):
        against = davis_resistance(speed, a, b_1, c + grid.drag[k]) + grid.force_n[k]
        value = _before(value, b, float(grid.node_limit_mps[k]) ** 2 / 2 + 1e-9, float(grid.step_m[k]), against,
                        vehicle.inertia_kg, most, electric, vehicle.friction_brake_n, vehicle.traction_efficiency,
                        vehicle.regenerative_efficiency, price_w)
    return float(value[0])
