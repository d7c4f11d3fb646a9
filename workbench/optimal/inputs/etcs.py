"""Speed limits by ETCS's supervision of braking: towards lower limits and stops a train must keep below a curve.

By ERA, SUBSET-026-3 (baseline 3), 3.13, as its introduction (ERA_ERTMS_040026) draws it, for a train that states its
decelerations (gamma), with service brake command and without its feedback:

    A_safe = K_dry (K_wet + M_NVAVADH (1 - K_wet)) A_emergency + grade      emergency brake deceleration curve, EBD
    A_expected = A_service + grade                                          service brake deceleration curve, SBD
    EBI = EBD at V (1 + uncertainty) - V (1 + uncertainty) max(T_be, T_traction), with no acceleration at that moment
    permitted = the nearer of EBI - V T_bs and, towards a stop, SBD - V T_bs, each T_driver earlier

The EBD of a lower limit ends at that limit plus the margin dV_ebi, that of a stop at a standstill. Near a stop the
release speed is permitted. Kt_int belongs to trains that state a brake percentage, and is not used.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from workbench.optimal.course import Array, Course
from workbench.optimal.vehicle import Vehicle

KMH = 1 / 3.6
# Fixed values of SUBSET-026-3, A.3.1: the driver's time, and the margin of the emergency brake with its speeds.
DRIVER_S = 4.0
LEAST_MARGIN_MPS, MOST_MARGIN_MPS, MARGIN_FROM_MPS, MARGIN_TO_MPS = 7.5 * KMH, 15 * KMH, 110 * KMH, 210 * KMH
# The national value V_NVREL where none is stated.
RELEASE_MPS = 40 * KMH
# A curve is followed by stairs below it: of this height, along a curve integrated in such steps.
STAIR_MPS, STEP_M = 0.5, 2.0


@dataclass(frozen=True)
class Supervision:
    """A train's braking as ETCS knows it: (speed in m/s from which it holds, deceleration in m/s^2) pairs; times in s.

    speed_uncertainty: as a share of the speed; wet_share: M_NVAVADH of the line.
    """

    emergency: tuple[tuple[float, float], ...]
    service: tuple[tuple[float, float], ...]
    dry: float = 1.0
    wet: float = 1.0
    traction_s: float = 0.0
    emergency_s: float = 0.0
    service_s: float = 0.0
    speed_uncertainty: float = 0.0
    wet_share: float = 0.0
    release_mps: float = RELEASE_MPS

    def safe_mps2(self, speed_mps: float) -> float:
        """The emergency brake's deceleration that is relied on, on the level."""
        return self.dry * (self.wet + self.wet_share * (1 - self.wet)) * _held(self.emergency, speed_mps)

    def expected_mps2(self, speed_mps: float) -> float:
        """The service brake's deceleration, on the level."""
        return _held(self.service, speed_mps)


def _held(steps: tuple[tuple[float, float], ...], speed_mps: float) -> float:
    return next((value for start, value in reversed(steps) if speed_mps >= start), steps[0][1])


def margin_mps(speed_mps: float) -> float:
    """dV_ebi: by what the emergency brake's curve of a limit ends above it."""
    share = (speed_mps - MARGIN_FROM_MPS) / (MARGIN_TO_MPS - MARGIN_FROM_MPS)
    return LEAST_MARGIN_MPS + (MOST_MARGIN_MPS - LEAST_MARGIN_MPS) * min(max(share, 0.0), 1.0)


def permitted(of: Supervision, vehicle: Vehicle, course: Course, target_m: float, target_mps: float,
              speeds_mps: Array) -> Array:
    """Up to where each speed, m/s and above the target's, is permitted towards a target; shape as speeds_mps.

    target_mps: 0 for a stop. The grade is that of the line's force, curves included; before the course's start that
    of its start holds.
    """
    is_stop = target_mps == 0
    most = float(speeds_mps.max()) * (1 + of.speed_uncertainty)
    foot = 0.0 if is_stop else target_mps + margin_mps(target_mps)
    emergency = _curve(of.safe_mps2, vehicle, course, target_m, foot, most)
    seen = speeds_mps * (1 + of.speed_uncertainty)
    at = np.interp(seen, emergency[1], emergency[0])
    at -= seen * max(of.emergency_s, of.traction_s) + speeds_mps * of.service_s
    if is_stop:
        service = _curve(of.expected_mps2, vehicle, course, target_m, 0.0, most)
        at = np.minimum(at, np.interp(speeds_mps, service[1], service[0]) - speeds_mps * of.service_s)
    return np.minimum(np.asarray(at) - speeds_mps * DRIVER_S, target_m)


def _curve(deceleration: object, vehicle: Vehicle, course: Course, foot_m: float, foot_mps: float,
           most_mps: float) -> tuple[Array, Array]:
    """Positions and speeds of a braking curve, from its foot backwards until most_mps; both in that order."""
    assert callable(deceleration)
    positions, half = [foot_m], [foot_mps**2 / 2]
    while half[-1] < most_mps**2 / 2:
        section = int(np.clip(np.searchsorted(course.position_m, positions[-1]) - 1, 0, len(course.limit_mps) - 1))
        rate = deceleration((2 * half[-1]) ** 0.5) + float(course.force_n[section].min()) / vehicle.inertia_kg
        # A brake that does not hold on the slope has no curve: the lowest speed is permitted all along.
        half.append(half[-1] + STEP_M * max(rate, 1e-3))
        positions.append(positions[-1] - STEP_M)
    return np.array(positions), np.sqrt(2 * np.array(half))


def supervised(course: Course, vehicle: Vehicle, of: Supervision, end_mps: float = 0.0) -> Course:
    """The course with the limits that ETCS permits, in stairs of STAIR_MPS at and below the permitted speeds.

    Runs and bounds of the course are those under the stairs. end_mps: the speed at the end, 0 for a stop there.
    """
    limit, s = course.limit_mps, course.position_m
    drops = [(float(s[k + 1]), float(limit[k + 1])) for k in range(len(limit) - 1) if limit[k + 1] < limit[k]]
    stops = [(stop, 0.0) for stop in course.stops_m] + ([(float(s[-1]), 0.0)] if end_mps == 0 else [])
    stairs: list[tuple[float, float, float]] = []
    for target_m, target_mps in drops + stops:
        lowest = target_mps or of.release_mps
        levels = np.append(np.arange(lowest, float(limit.max()), STAIR_MPS), float(limit.max()))
        if len(levels) < 2:
            continue
        until = np.minimum.accumulate(permitted(of, vehicle, course, target_m, target_mps, levels))
        for speed, one, two in zip(levels[:-1], until[1:], until[:-1], strict=True):
            stairs.append((float(one), float(two), float(speed)))
        stairs.append((float(until[0]), target_m, lowest))
    borders = np.unique([x for one, two, _ in stairs for x in (one, two)]) if stairs else np.zeros(0)
    inside = borders[(borders > s[0] + 0.1) & (borders < s[-1] - 0.1)]
    after = np.searchsorted(s, inside)
    inside = inside[np.minimum(inside - s[after - 1], s[after] - inside) > 0.1]
    fine = course.split(inside[np.insert(np.diff(inside) > 0.1, 0, True)] if len(inside) else inside)
    lowered = fine.limit_mps.copy()
    for one, two, speed in stairs:
        meets = (fine.position_m[1:] > one) & (fine.position_m[:-1] < two)
        lowered[meets] = np.minimum(lowered[meets], speed)
    return replace(fine, limit_mps=lowered)
