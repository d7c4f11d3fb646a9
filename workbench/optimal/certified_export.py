"""The run that a bound is proved for, for other programs: rows over position, as CSV and in the JSON document."""

from __future__ import annotations

import numpy as np

from workbench.optimal.course import Array
from workbench.optimal.document_format import CertifiedRun
from workbench.optimal.profile import Profile, largest_braking, largest_force
from workbench.optimal.reference import Reference
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance

# Force, power and limits are those just behind each position, in the direction of travel; of the last row, before it.
COLUMNS = ("s_m", "t_s", "v_mps", "a_mps2", "force_N", "power_W", "force_limit_N", "speed_limit_mps")


def certified_rows(vehicle: Vehicle, profile: Profile) -> Array:
    """Rows of COLUMNS, one a node of the run, shape (n + 1, 8): from row to row the acceleration is constant.

    force_N: at the rail, negative for braking; power_W: force times speed; force_limit_N: the largest traction where
    the force is positive, else the largest of both brakes. Waits at stops take no time here.
    """
    speed, cells = profile.speed_mps, len(profile.acceleration_mps2)
    cell = np.minimum(np.arange(cells + 1), cells - 1)
    end = (np.arange(cells + 1) > cell).astype(int)
    acceleration = profile.acceleration_mps2[cell]
    a, b_1, c = vehicle.davis_n
    force = (vehicle.inertia_kg * acceleration + profile.course.force_n[cell, end]
             + davis_resistance(speed, a, b_1, c + profile.course.drag[cell, end]))
    limit = np.where(force > 0, largest_force(vehicle.traction, speed), largest_braking(vehicle, speed))
    return np.column_stack((profile.position_m, profile.time_s, speed, acceleration, force, force * speed, limit,
                            profile.course.limit_mps[cell]))


def certified_document(found: Reference, rows: Array, csv: str | None) -> CertifiedRun:
    """The run as data: its energy and gap, the energy of its simulation, and its rows by column."""
    return {"what": "the run that the bound is proved for: constant acceleration from row to row over position",
            "energy_J": found.energy_j, "lower_bound_J": found.lower_bound_j, "gap": found.gap,
            "simulated_energy_J": found.check.energy_j, "position_drift_m": found.check.position_drift_m,
            "speed_drift_mps": found.check.speed_drift_mps, "correction_N": found.check.correction_n,
            "force_excess": found.check.force_excess, "csv": csv,
            "profile": {name: column.tolist() for name, column in zip(COLUMNS, rows.T, strict=True)}}
