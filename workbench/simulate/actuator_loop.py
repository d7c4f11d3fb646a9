"""What lies between a command and the force at the rail, a plant step at a time; laid out as in `trains/actuator.py`.

Every function is compiled with the closed loop and called by it.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors

import math

# --- shared ---


def driven(wanted, v, drive):
    """The force in N that a drive can give of what is wanted of it at a speed; drive: as in `trains/actuator.py`."""
    return min(max(wanted, -drive[1]), drive[0], drive[2] / max(abs(v), 1e-3))


def force_after_lag(force, wanted, dt, lag, rise, fall):
    """A force that follows `wanted` for a time dt: its mean, its last value, and whether its rate was at a limit.

    F' = (wanted - F) / lag, from -fall to rise: a ramp until the gap is what the lag closes at the limit's rate, then
    an exponential. Both are integrated exactly.
    """
    gap = wanted - force
    rate = rise if gap > 0.0 else fall
    distance = abs(gap)
    ramp = min(max(distance / rate - lag, 0.0), dt)
    area = 0.0
    if ramp > 0.0:
        closed = ramp * rate
        area = ramp * (distance - 0.5 * closed)
        distance = max(distance - closed, 0.0)
    if ramp < dt:
        if lag > 0.0:
            part = -math.expm1((ramp - dt) / lag)
            area += lag * part * distance
            distance -= part * distance
        else:
            distance = 0.0
    sign = 1.0 if gap > 0.0 else -1.0
    return wanted - sign * area / dt, wanted - sign * distance, ramp > 0.0


def acting(n, dt, wanted, v, drive):
    """The mean force in N at the rail over plant step n under a wanted one; what it leaves and counts is in `drive`."""
    late = int(drive[4])
    if late > 0:
        place = 19 + n % late
        before = drive[place]
        drive[place] = wanted
        wanted = before
    wanted = driven(wanted, v, drive)
    if drive[13] > 0.0:
        _, drive[14], _ = force_after_lag(drive[14], wanted, dt, drive[3], drive[5], drive[6])
    mean, last, limited = force_after_lag(drive[10], wanted, dt, drive[3], drive[5], drive[6])
    adhesion = drive[7] / (3.6 * abs(v) + drive[8]) + drive[9]
    highest = min(adhesion, drive[2] / max(abs(v), 1e-3))
    if limited:
        drive[11] += 1.0
    if abs(mean) >= adhesion * (1.0 - 1e-9):
        drive[12] += 1.0
    drive[10] = min(max(last, -adhesion), highest)
    return min(max(mean, -adhesion), highest)


def predicted(n, dt, p, v, drive):
    """Position and speed at which the command of plant step n takes effect, by the train as its controller knows it.

    What acts until then are the commands under way; the force now is followed by the model, since it is not measured.
    """
    late = int(drive[4])
    force = drive[14]
    for i in range(late):
        wanted = driven(drive[19 + (n + i) % late], v, drive)
        mean, force, _ = force_after_lag(force, wanted, dt, drive[3], drive[5], drive[6])
        a = (mean - drive[16] - v * (drive[17] + v * drive[18])) / drive[15]
        middle = v + 0.5 * dt * a
        a = (mean - drive[16] - middle * (drive[17] + middle * drive[18])) / drive[15]
        p += dt * (v + 0.5 * dt * a)
        v += dt * a
    return p, v
