"""Desired curves: twice continuously differentiable position references as piecewise polynomials in time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Annotated, Literal, Self

import numpy as np
from numpy.polynomial import polynomial as poly
from numpy.typing import NDArray
from pydantic import Field, Strict, model_validator

from workbench.errors import WorkbenchError
from workbench.files.toml import SourcedRecord

DEGREE = 5


@dataclass(frozen=True)
class DesiredCurve:
    """Position x_d(t): on [breaks_s[k], breaks_s[k+1]] it is sum_i coefficients[k, i] (t - breaks_s[k])^i.

    breaks_s: shape (n+1,), s; coefficients: shape (n, 6), m/s^i. After the last break the train stands still.
    Raises WorkbenchError when position, speed or acceleration jump at a break, the standstill after the last
    one included (the adaptive laws need C2), or when a value is not finite.
    """

    breaks_s: NDArray[np.float64]
    coefficients: NDArray[np.float64]

    def __post_init__(self) -> None:
        ends = np.diff(self.breaks_s)
        if not (np.all(ends > 0) and np.all(np.isfinite(self.coefficients))):
            raise WorkbenchError("desired curve: its breaks do not increase or a coefficient is not finite: "
                                 "give times in increasing order and finite values")
        for order, unit in enumerate(("m", "m/s", "m/s^2")):
            left = self._derivative(order, ends)
            # The train stands where the curve ends, so that only its position may differ from zero there.
            right = np.append(self._derivative(order, np.zeros(len(ends)))[1:], left[-1] if order == 0 else 0.0)
            jump = np.abs(left - right).max(initial=0.0)
            if not jump <= 1e-9 * max(1.0, float(np.abs(self.coefficients[:, order]).max())):
                raise WorkbenchError(f"desired curve: derivative {order} jumps by {jump:g} {unit} at a break"
                                     f": give a curve with continuous acceleration")

    def _derivative(self, order: int, local_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """The derivative of each piece at its own local time."""
        value = np.zeros(len(self.coefficients))
        for i in range(DEGREE, order - 1, -1):
            value = value * local_s + self.coefficients[:, i] * math.perm(i, order)
        return value

    @property
    def trip_time_s(self) -> float:
        """Time at which the curve reaches its end."""
        return float(self.breaks_s[-1])

    @property
    def length_m(self) -> float:
        """Distance covered."""
        last = self.coefficients[-1]
        return float(poly.polyval(self.breaks_s[-1] - self.breaks_s[-2], last))

    def at(self, time_s: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
        """Position (m), speed (m/s) and acceleration (m/s^2) at times in s."""
        time_s = np.asarray(time_s, dtype=float)
        index = np.searchsorted(self.breaks_s, time_s, side="right") - 1
        index = np.clip(index, 0, len(self.coefficients) - 1)
        local = np.minimum(time_s, self.breaks_s[-1]) - self.breaks_s[index]
        result = []
        for order in range(3):
            value = np.zeros_like(time_s)
            for i in range(DEGREE, order - 1, -1):
                value = value * local + self.coefficients[index, i] * np.prod(np.arange(i - order + 1, i + 1))
            result.append(np.where(time_s >= self.breaks_s[-1], value if order == 0 else 0.0, value))
        return tuple(result)


def from_acceleration(pieces: list[tuple[float, list[float]]]) -> DesiredCurve:
    """Integrate acceleration pieces (duration in s, polynomial of local time in m/s^2) from standstill."""
    breaks, rows, speed, position = [0.0], [], 0.0, 0.0
    for duration, acceleration in pieces:
        velocity = poly.polyint(acceleration, k=speed)
        path = poly.polyint(velocity, k=position)
        rows.append(np.pad(path, (0, DEGREE + 1 - len(path))))
        breaks.append(breaks[-1] + duration)
        speed, position = float(poly.polyval(duration, velocity)), float(poly.polyval(duration, path))
    return DesiredCurve(np.array(breaks), np.array(rows))


def _speed_change(change_mps: float, rate_mps2: float, ramp_s: float) -> list[tuple[float, list[float]]]:
    """Acceleration pieces for a change of speed: a smooth ramp to the rate, hold, a smooth ramp back."""
    magnitude = abs(change_mps)
    hold = magnitude / rate_mps2 - ramp_s
    if hold < 0:  # the rate is never reached: two shorter ramps to a lower peak with the same slope
        ramp_s = float(np.sqrt(magnitude * ramp_s / rate_mps2))
        rate_mps2, hold = magnitude / ramp_s, 0.0
    a = float(np.copysign(rate_mps2, change_mps))
    up = [0.0, 0.0, 3 * a / ramp_s**2, -2 * a / ramp_s**3]
    down = [a, 0.0, -3 * a / ramp_s**2, 2 * a / ramp_s**3]
    middle = [(hold, [a])] if hold > 0 else []
    return [(ramp_s, up), *middle, (ramp_s, down)]


@lru_cache(maxsize=64)
def start_cruise_stop(length_m: float, cruise_mps: float, acceleration_mps2: float, braking_mps2: float,
                      ramp_s: float) -> DesiredCurve:
    """Accelerate, cruise, brake to a stop after length_m; acceleration itself is continuously differentiable.

    Kept for the next run along it: its arrays are not to be written to. Raises WorkbenchError when the line is too
    short to reach the cruise speed.
    """
    start = _speed_change(cruise_mps, acceleration_mps2, ramp_s)
    stop = _speed_change(-cruise_mps, braking_mps2, ramp_s)
    # A speed change that is symmetric in time covers mean speed x duration.
    covered = cruise_mps / 2 * (sum(d for d, _ in start) + sum(d for d, _ in stop))
    cruise_s = (length_m - covered) / cruise_mps
    if not cruise_s > 0:
        raise WorkbenchError(f"desired curve: {cruise_mps:.2f} m/s cannot be reached and left again within "
                             f"{length_m:g} m ({covered:g} m needed): lower the cruise speed or raise rates")
    return from_acceleration([*start, (cruise_s, [0.0]), *stop])


def speed_levels(starts_s: Sequence[float], speeds_mps: Sequence[float], rate_mps2: float, ramp_s: float,
                 end_s: float) -> DesiredCurve:
    """From standstill to each speed in turn, beginning at its start; the last one, reached before end_s, is held.

    Raises WorkbenchError when a change of speed is not over before the next one begins, or the train would not
    stand at the end.
    """
    pieces: list[tuple[float, list[float]]] = []
    reached_s, speed = 0.0, 0.0
    for start, wanted, following in zip(starts_s, speeds_mps, (*starts_s[1:], end_s), strict=True):
        if start > reached_s:
            pieces.append((start - reached_s, [0.0]))
        pieces += _speed_change(wanted - speed, rate_mps2, ramp_s)
        reached_s, speed = sum(duration for duration, _ in pieces), wanted
        if reached_s > following:
            raise WorkbenchError(f"desired curve: the change to {wanted:g} m/s that begins at {start:g} s takes until "
                                 f"{reached_s:g} s, beyond {following:g} s: raise the rate or start it earlier")
    if speed != 0:
        raise WorkbenchError(f"desired curve: it ends at {speed:g} m/s: let the last speed be 0")
    return from_acceleration([*pieces, (end_s - reached_s, [0.0])] if end_s > reached_s else pieces)


# Beyond these bounds a value is a slip of the pen or of its unit, and the curve would not be computable.
SLOWEST_MPS, FASTEST_MPS = 0.1, 150.0
Rate = Annotated[float, Strict(), Field(ge=1e-3, le=20, allow_inf_nan=False)]
RampTime = Annotated[float, Strict(), Field(ge=1e-2, le=600, allow_inf_nan=False)]


class DavisCruise(SourcedRecord):
    """A start-cruise-stop curve whose rates follow from specific forces on straight level track.

    The cruise speed solves davis_resistance(v) = cruise_mps2; the starting acceleration is start_mps2
    minus the resistance at standstill.
    """

    kind: Literal["davis_cruise"]
    cruise_mps2: Rate
    start_mps2: Rate
    braking_mps2: Rate
    ramp_s: RampTime


class CruiseSpeed(SourcedRecord):
    """A start-cruise-stop curve with its cruise speed given."""

    kind: Literal["cruise_speed"]
    cruise_mps: Annotated[float, Strict(), Field(ge=SLOWEST_MPS, le=FASTEST_MPS, allow_inf_nan=False)]
    acceleration_mps2: Rate
    braking_mps2: Rate
    ramp_s: RampTime


class TimedCruise(SourcedRecord):
    """A start-cruise-stop curve with its cruise speed and the time of the trip given, from which the length follows."""

    cruise_mps: Annotated[float, Strict(), Field(ge=SLOWEST_MPS, le=FASTEST_MPS, allow_inf_nan=False)]
    acceleration_mps2: Rate
    braking_mps2: Rate
    ramp_s: RampTime
    trip_time_s: Annotated[float, Strict(), Field(ge=1, le=1e5, allow_inf_nan=False)]

    @model_validator(mode="after")
    def _a_curve_follows(self) -> Self:
        try:
            self.curve()
        except WorkbenchError as trouble:
            raise ValueError(f"{trouble}, or allow more trip_time_s") from None
        return self

    def curve(self) -> DesiredCurve:
        """The curve of this trip time."""
        start_s, stop_s = (self.cruise_mps / rate + self.ramp_s for rate in (self.acceleration_mps2, self.braking_mps2))
        # A change of speed that is symmetric in time covers mean speed times duration.
        length_m = self.cruise_mps * (self.trip_time_s - (start_s + stop_s) / 2)
        return start_cruise_stop(length_m, self.cruise_mps, self.acceleration_mps2, self.braking_mps2, self.ramp_s)


class SpeedLevels(SourcedRecord):
    """A curve that goes to one speed after another, each from its own time on, and stands at its end."""

    starts_s: tuple[Annotated[float, Strict(), Field(ge=0, le=1e5, allow_inf_nan=False)], ...]
    speeds_mps: tuple[Annotated[float, Strict(), Field(ge=0, le=FASTEST_MPS, allow_inf_nan=False)], ...]
    rate_mps2: Rate
    ramp_s: RampTime
    end_s: Annotated[float, Strict(), Field(gt=0, le=1e5, allow_inf_nan=False)]

    @model_validator(mode="after")
    def _a_curve_follows(self) -> Self:
        if len(self.starts_s) != len(self.speeds_mps) or not self.starts_s:
            raise ValueError(f"starts_s has {len(self.starts_s)} values and speeds_mps {len(self.speeds_mps)}: give "
                             f"one start for each speed")
        if any(after <= before for before, after in pairwise((*self.starts_s, self.end_s))):
            raise ValueError("starts_s does not increase up to end_s: order the speeds by time")
        if any(one == other for one, other in pairwise((0.0, *self.speeds_mps))):
            raise ValueError("speeds_mps has the same speed twice in a row, or begins with 0: leave it out")
        try:
            self.curve()
        except WorkbenchError as trouble:
            raise ValueError(str(trouble)) from None
        return self

    def curve(self) -> DesiredCurve:
        """The curve itself."""
        return speed_levels(self.starts_s, self.speeds_mps, self.rate_mps2, self.ramp_s, self.end_s)


def davis_cruise_speed(cruise_mps2: float, a: float, b: float, c: float) -> float:
    """Speed in m/s at which a + b v + c v^2 equals cruise_mps2; raises WorkbenchError if there is none."""
    if cruise_mps2 <= a:
        raise WorkbenchError(f"reference.cruise_mps2 = {cruise_mps2:g} does not exceed the resistance at "
                             f"standstill ({a:g} m/s^2): raise it")
    # The root of the quadratic in the form that also holds for c = 0.
    divisor = b + math.sqrt(b * b + 4 * c * (cruise_mps2 - a))
    if divisor == 0:
        raise WorkbenchError("reference: the resistance does not depend on speed, so no cruise speed follows "
                             "from it: use kind = 'cruise_speed'")
    speed = (cruise_mps2 - a) * 2 / divisor
    if not SLOWEST_MPS <= speed <= FASTEST_MPS:
        raise WorkbenchError(f"reference.cruise_mps2 = {cruise_mps2:g} gives a cruise speed of {speed:g} m/s"
                             f", outside {SLOWEST_MPS:g} to {FASTEST_MPS:g}: correct it or the resistance")
    return speed


def build_curve(spec: DavisCruise | CruiseSpeed, length_m: float,
                davis: tuple[float, float, float]) -> DesiredCurve:
    """The desired curve of a scenario; `davis` per unit of mass; raises WorkbenchError if there is none."""
    if isinstance(spec, CruiseSpeed):
        return start_cruise_stop(length_m, spec.cruise_mps, spec.acceleration_mps2, spec.braking_mps2,
                                 spec.ramp_s)
    cruise = davis_cruise_speed(spec.cruise_mps2, *davis)
    acceleration = spec.start_mps2 - davis[0]
    if acceleration <= 0:
        raise WorkbenchError(f"reference.start_mps2 = {spec.start_mps2:g} does not exceed the resistance at "
                             f"standstill ({davis[0]:g} m/s^2): raise it")
    return start_cruise_stop(length_m, cruise, acceleration, spec.braking_mps2, spec.ramp_s)
