"""What a run keeps back of its forces, place by place, so that its average over a window keeps their limits.

Where the line's force jumps under a train at full traction the averaged run asks for half of the jump beyond it, and
where a limit falls with the speed the average of a run at the limit lies a little above. So the run is planned with a
share of traction or brakes less there; how much is found by trying.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from workbench.optimal.course import Array, Course
from workbench.optimal.profile import largest_braking, largest_force
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance

# Each round keeps back so much more than what the last one was beyond, as a factor and as a share, wherever forces are
# beyond or nearer to their limits than INSIDE.
MORE, LEAST_MORE, INSIDE = 1.4, 2e-5, 1e-7
# So many windows' way around each place where a limit is passed; places closer than that are one.
REACH_WINDOWS = 1.0
# Less of a force than this is not kept back.
LEAST_SHARE = 0.3
# Steps between samples, s.
STEP_S = 0.05


class MotionOverTime(Protocol):
    """Pieces between breaks in time, on each of which the acceleration is smooth."""

    @property
    def breaks_s(self) -> Array:
        """Where pieces begin and end, s, shape (n + 1,)."""

    def at(self, time_s: Array) -> tuple[Array, Array, Array]:
        """Position (m), speed (m/s) and acceleration (m/s^2)."""


@dataclass(frozen=True)
class Reserve:
    """Of side 0, traction, or 1, the brakes, only `share` may be used from from_m to to_m."""

    side: int
    from_m: float
    to_m: float
    share: float


@dataclass(frozen=True)
class ForceSamples:
    """Samples of a motion, each shape (n,): force at the wheel in N, its largest value there, positive for traction.

    weight_s: the time that each stands for; none for the ends of pieces.
    """

    position_m: Array
    speed_mps: Array
    force_n: Array
    limit_n: Array
    electric_n: Array
    weight_s: Array

    @property
    def excess(self) -> Array:
        """By which share of its limit each force passes it; negative within."""
        return np.asarray(np.abs(self.force_n) / self.limit_n - 1)


def needed_force(vehicle: Vehicle, course: Course, s: Array, v: Array, a: Array) -> Array:
    """Force at the wheel in N for positions (m), speeds (m/s) and accelerations (m/s^2)."""
    k = np.clip(np.searchsorted(course.position_m, s) - 1, 0, len(course.limit_mps) - 1)
    share = np.clip((s - course.position_m[k]) / np.diff(course.position_m)[k], 0.0, 1.0)
    line = course.force_n[k, 0] + share * (course.force_n[k, 1] - course.force_n[k, 0])
    drag = course.drag[k, 0] + share * (course.drag[k, 1] - course.drag[k, 0])
    a_0, b_1, c = vehicle.davis_n
    return np.asarray(vehicle.inertia_kg * a + davis_resistance(v, a_0, b_1, c + drag) + line)


def force_samples(vehicle: Vehicle, course: Course, run: MotionOverTime) -> ForceSamples:
    """Inside every piece, some STEP_S apart, and next to both of its ends."""
    width = np.diff(run.breaks_s)
    count = np.maximum(1, np.ceil(width / STEP_S)).astype(int)
    k = np.repeat(np.arange(len(width)), count)
    step = width[k] / count[k]
    first = np.insert(np.cumsum(count), 0, 0)[:-1]
    inner = run.breaks_s[k] + (np.arange(len(k)) - first[k] + 0.5) * step
    near = np.minimum(1e-9 * run.breaks_s[-1], width / 4)
    time = np.concatenate((inner, run.breaks_s[:-1] + near, run.breaks_s[1:] - near))
    s, v, a = run.at(time)
    v = np.maximum(v, 0.0)
    force = needed_force(vehicle, course, s, v, a)
    electric = largest_force(vehicle.regenerative, v)
    limit = np.where(force > 0, largest_force(vehicle.traction, v), largest_braking(vehicle, v))
    # A train that stands is held by its brakes.
    force = np.where((v > 1e-9) | (np.abs(a) > 1e-9), force, 0.0)
    return ForceSamples(s, v, force, limit, electric, np.concatenate((step, np.zeros(2 * len(width)))))


def more_reserves(found: ForceSamples, reserves: tuple[Reserve, ...], window_s: float) -> tuple[Reserve, ...]:
    """The reserves that the samples ask for beside those that there are; the same where all limits are kept."""
    more: list[Reserve] = []
    for side in (0, 1):
        beyond = (found.force_n > 0) == (side == 0)
        beyond &= found.excess > -INSIDE
        order = np.argsort(found.position_m[beyond])
        s, reach = found.position_m[beyond][order], REACH_WINDOWS * window_s * found.speed_mps[beyond][order] + 1.0
        excess = np.maximum(found.excess[beyond][order], 0.0)
        first = 0
        for k in range(len(s)):
            if k + 1 == len(s) or s[k + 1] - reach[k + 1] > s[k] + reach[k]:
                low = float((s[first:k + 1] - reach[first:k + 1]).min())
                high = float((s[first:k + 1] + reach[first:k + 1]).max())
                before = min([r.share for r in reserves if r.side == side and r.from_m < high and r.to_m > low],
                             default=1.0)
                share = before / (1 + MORE * float(excess[first:k + 1].max()) + LEAST_MORE)
                more.append(Reserve(side, low, high, max(share, LEAST_SHARE)))
                first = k + 1
    return reserves + tuple(more)


def with_reserves(course: Course, reserves: tuple[Reserve, ...]) -> Course:
    """The course on which a driven run uses no more than the least share of all reserves at each place."""
    if not reserves:
        return course
    s = course.position_m
    borders = np.unique([end for r in reserves for end in (r.from_m, r.to_m)])
    inside = borders[(borders > s[0]) & (borders < s[-1])]
    after = np.searchsorted(s, inside)
    apart = np.minimum(inside - s[after - 1], s[after] - inside) > 0.01
    fine = course.split(inside[apart])
    usable = fine.usable_shares.copy()
    for reserve in reserves:
        meets = (fine.position_m[1:] > reserve.from_m) & (fine.position_m[:-1] < reserve.to_m)
        usable[meets, reserve.side] = np.minimum(usable[meets, reserve.side], reserve.share)
    return replace(fine, usable=usable)
