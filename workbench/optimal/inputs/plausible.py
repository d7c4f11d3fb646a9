"""Whether a vehicle's values are those of a train; mostly it is the unit that is wrong where they are not."""

from __future__ import annotations

import math
from itertools import pairwise

from workbench.errors import InputError
from workbench.optimal.inputs.line_checks import FASTEST_MPS, LONGEST_TRAIN_M, SHORTEST_TRAIN_M
from workbench.optimal.vehicle import Vehicle


def plausible(vehicle: Vehicle) -> Vehicle:
    """The vehicle itself; raises InputError naming the first quantity outside its range, with the range."""
    mass, traction, electric = vehicle.mass_kg, vehicle.traction, vehicle.regenerative
    _require("mass", mass, 1e3, 1e8, "kg")
    _require("rotating mass", vehicle.rotating_fraction, 0, 0.5, "of the mass")
    if vehicle.length_m != 0:
        _require("length", vehicle.length_m, SHORTEST_TRAIN_M, LONGEST_TRAIN_M, "m")
    _require("traction efficiency", vehicle.traction_efficiency, 0.2, 1, "of what is drawn")
    _require_limit("max speed", vehicle.max_speed_mps, 1, FASTEST_MPS, "m/s")
    _require_limit("max acceleration", vehicle.max_acceleration_mps2, 0.01, 20, "m/s^2")
    _require_limit("max deceleration", vehicle.max_deceleration_mps2, 0.01, 20, "m/s^2")
    _require("traction force", traction.force_n / mass, 0.01, 20, "m/s^2 for this mass")
    _require("regenerative braking force", electric.force_n / mass, 0, 20, "m/s^2 for this mass")
    _require("friction braking force", vehicle.friction_brake_n / mass, 0, 20, "m/s^2 for this mass")
    for name, limit in (("traction", traction), ("regenerative braking", electric)):
        _require_limit(f"{name} power", limit.power_w / mass, 0.1, 1e3, "W/kg")
        for speed, force in limit.table:
            _require(f"{name} curve", speed, 0, FASTEST_MPS, "m/s")
            _require(f"{name} curve", force / mass, 0, 20, "m/s^2 for this mass")
        if any(two <= one for (one, _), (two, _) in pairwise(limit.table)):
            raise InputError("", f"{name} curve", "speeds do not increase: sort the points by speed, name each once")
    for number, (value, unit) in enumerate(zip(vehicle.davis_n, ("N/kg", "N s/(m kg)", "N s^2/(m^2 kg)"), strict=True)):
        _require(f"resistance r{number}", value / mass, 0, 10, unit)
    areas = [area for area, _ in vehicle.tunnel_drag]
    if len(set(areas)) < len(areas):
        raise InputError("", "tunnel resistance", "lists a cross section twice: remove one")
    for area, added in vehicle.tunnel_drag:
        _require("tunnel resistance", area, 5, 1000, "m^2")
        _require("tunnel resistance", added / mass, 0, 1, "N s^2/(m^2 kg)")
    _require("auxiliary power", vehicle.auxiliary_w / mass, 0, 1e3, "W/kg")
    return vehicle


def _require(key: str, value: float, low: float, high: float, unit: str) -> None:
    if not low <= value <= high:
        raise InputError("", key, f"{value:g} {unit} is no train's, {low:g} to {high:g}: correct it or its unit")


def _require_limit(key: str, value: float, low: float, high: float, unit: str) -> None:
    """As _require, of a limit that may be infinite for none."""
    if value != math.inf:
        _require(key, value, low, high, unit)
