"""What a run does where: full or partial traction, cruising, coasting, braking; and what makes a fast run no faster."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.optimal.profile import WEIGHT, Profile, forces, largest_braking, largest_force
from workbench.optimal.vehicle import Vehicle

REGIMES = ("traction", "cruise", "coast", "brake")
# A force below this share of full traction is none; an acceleration below this, in m/s^2, is none.
NO_FORCE, NO_ACCELERATION = 2e-3, 2e-3
FULL = 0.98


def regimes(vehicle: Vehicle, profile: Profile) -> NDArray[np.str_]:
    """The regime of each cell, shape (n,), of REGIMES: constant speed under force is cruising."""
    found = forces(vehicle, profile)
    net = (found.traction_n - found.regenerative_n - found.friction_n) @ WEIGHT
    small = NO_FORCE * vehicle.traction.at(0.0)
    steady = np.abs(profile.acceleration_mps2) < NO_ACCELERATION
    named = np.where(np.abs(net) <= small, "coast", np.where(steady, "cruise", np.where(net > 0, "traction", "brake")))
    return np.asarray(named)


def time_shares(vehicle: Vehicle, profile: Profile) -> dict[str, float]:
    """Share of the run's time in each regime."""
    names, step = regimes(vehicle, profile), np.diff(profile.time_s)
    return {name: float(step[names == name].sum() / step.sum()) for name in REGIMES}


def binding(vehicle: Vehicle, profile: Profile) -> str:
    """In words: the shares of a run's time at the speed limit, full traction, full brakes and limits of acceleration.

    No moment counts twice, so that they come to no more than the whole.
    """
    found = forces(vehicle, profile)
    step = np.diff(profile.time_s)
    speed = profile.speed_mps
    at_limit = np.minimum(speed[1:], speed[:-1]) >= FULL * profile.course.limit_mps
    most = largest_force(vehicle.traction, found.speed_mps) @ WEIGHT
    brakes = largest_braking(vehicle, found.speed_mps) @ WEIGHT
    pull, brake = found.traction_n @ WEIGHT, (found.regenerative_n + found.friction_n) @ WEIGHT
    fast = profile.acceleration_mps2 >= FULL * vehicle.max_acceleration_mps2
    hard = -profile.acceleration_mps2 >= FULL * vehicle.max_deceleration_mps2
    parts = [("the speed limit", at_limit), ("full traction", (pull >= FULL * most) & ~at_limit & ~fast),
             ("the acceleration limit", fast & ~at_limit),
             ("full brakes", (brake >= FULL * brakes) & ~at_limit & ~hard),
             ("the deceleration limit", hard & ~at_limit)]
    shares = [(float(step[where].sum() / step.sum()), what) for what, where in parts]
    words = [f"{100 * share:.0f} % of it at {what}" for share, what in sorted(shares, reverse=True) if share >= 0.005]
    return ", ".join(words)
