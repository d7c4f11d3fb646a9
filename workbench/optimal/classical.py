"""The classical optimal run by Pontryagin's principle: an independent method for level track without regeneration.

Full traction to V, hold V, coast to U, brake. With phi(v) = v r(v) and psi(v) = v^2 r'(v) for the resistance r, the
Hamiltonian is the same while holding and where braking starts, which gives U = psi(V) / phi'(V) (P. Howlett,
P. Pudney, Energy-Efficient Train Control, 1995; A. Albrecht et al., Transportation Research B 94, 2016). What is left
is one number, V, found by the trip time. Where there is no room to hold, or the limit forbids V, it is U alone.
On a hill too steep to hold V, or a descent that needs no traction, the costate says where the regime begins and ends.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from workbench.compile.kernel import numeric
from workbench.errors import WorkbenchError
from workbench.optimal.vehicle import Vehicle
from workbench.trains.resistance import davis_resistance
from workbench.trains.train import a_0, b_0, c_0, v

_ARGUMENTS = (v, a_0, b_0, c_0)
_RESISTANCE = davis_resistance(v, a_0, b_0, c_0)
_SLOPE = sp.diff(_RESISTANCE, v)
_PHI_SLOPE = sp.diff(v * _RESISTANCE, v)
_PSI = v**2 * _SLOPE
_r, _r_slope = numeric(_ARGUMENTS, _RESISTANCE), numeric(_ARGUMENTS, _SLOPE)
_phi_slope, _psi = numeric(_ARGUMENTS, _PHI_SLOPE), numeric(_ARGUMENTS, _PSI)
# From this speed on shooting begins, in m/s.
SLOWEST_MPS = 0.05


@dataclass(frozen=True)
class ClassicalRun:
    """top_mps: speed that is held or at which coasting starts; brake_mps: speed at which braking starts.

    hold_m: distance at top speed, zero where there is no room; limited: whether the speed limit, not V, is held.
    time_price_w: mu, None where the limit is held. energy_j: at the supply, without auxiliaries.
    """

    top_mps: float
    brake_mps: float
    hold_m: float
    limited: bool
    time_price_w: float | None
    energy_j: float


@dataclass(frozen=True)
class SteepSwitch:
    """Positions in m where full traction (or coasting) begins and ends around a steep stretch that starts at zero."""

    begins_m: float
    ends_m: float
    extreme_speed_mps: float


def brake_speed(vehicle: Vehicle, hold_mps: float) -> float:
    """U = psi(V) / phi'(V): where braking starts after coasting from the held speed V, both in m/s."""
    return float(_psi(hold_mps, *vehicle.davis_n) / _phi_slope(hold_mps, *vehicle.davis_n))


def classical_run(vehicle: Vehicle, length_m: float, trip_time_s: float, limit_mps: float) -> ClassicalRun:
    """The optimal run from standstill to standstill on level track, where braking returns nothing.

    Raises WorkbenchError for a train that regenerates, or a trip time that no such run meets.
    """
    if vehicle.regenerative_efficiency > 0 and vehicle.regenerative.force_n > 0:
        raise WorkbenchError(f"{vehicle.name} regenerates: the classical regimes are those of a train that does not")

    def hold_length(top: float, brake: float) -> float:
        return length_m - _phases(vehicle, top, brake)[0]

    def late(top: float, brake: float) -> float:
        return _phases(vehicle, top, brake)[1] + max(hold_length(top, brake), 0.0) / top - trip_time_s

    def brake_without_hold(top: float) -> float:
        """The speed at which braking starts where nothing is held; the top itself where coasting is too long."""
        if hold_length(top, SLOWEST_MPS) > 0:
            return SLOWEST_MPS
        if hold_length(top, top) <= 0:
            return top
        return _root(lambda u: hold_length(top, u), SLOWEST_MPS, top, "length")

    limit_mps = min(limit_mps, _balance(vehicle, limit_mps))
    held_top, room = limit_mps, True
    if hold_length(limit_mps, brake_speed(vehicle, limit_mps)) < 0:
        held_top = _root(lambda top: hold_length(top, brake_speed(vehicle, top)), SLOWEST_MPS, limit_mps, "length")
    if late(held_top, brake_speed(vehicle, held_top)) <= 0:
        top = _root(lambda w: late(w, brake_speed(vehicle, w)), SLOWEST_MPS, held_top, "trip time")
        brake, limited = brake_speed(vehicle, top), False
    elif held_top < limit_mps:
        most = limit_mps
        if hold_length(limit_mps, limit_mps) < 0:
            most = _root(lambda w: hold_length(w, w), SLOWEST_MPS, limit_mps, "length")
        if late(most, brake_without_hold(most)) <= 0:
            top = _root(lambda w: late(w, brake_without_hold(w)), held_top, most, "trip time")
            brake, limited, room = brake_without_hold(top), False, False
        else:
            top, limited = limit_mps, True
            brake = _root(lambda u: late(limit_mps, u), brake_without_hold(limit_mps), limit_mps, "trip time")
    else:
        top, limited = limit_mps, True
        brake = _root(lambda u: late(limit_mps, u), brake_speed(vehicle, limit_mps), limit_mps, "trip time")
    hold = max(hold_length(top, brake), 0.0) if room else 0.0
    work = _drive_work(vehicle, top) + hold * _r(top, *vehicle.davis_n)
    price = None
    if not limited:
        efficiency, least = vehicle.traction_efficiency, _r(top, *vehicle.davis_n)
        # With a hold mu = psi(V); without one K is the same at both ends of coasting: r(W) + mu / W = mu / U.
        price = float(_psi(top, *vehicle.davis_n) if hold > 0 else least / (1 / brake - 1 / top)) / efficiency
    return ClassicalRun(top, brake, hold, limited, price, float(work) / vehicle.traction_efficiency)


def _balance(vehicle: Vehicle, limit_mps: float) -> float:
    """A speed in m/s just below that at which full traction only carries the resistance, at most the limit."""

    def pull(w: float) -> float:
        return float(vehicle.traction.at(w) - _r(w, *vehicle.davis_n))

    return limit_mps if pull(limit_mps) > 0 else 0.999 * _root(pull, SLOWEST_MPS, limit_mps, "traction")


def _root(excess: Callable[[float], float], low: float, high: float, what: str) -> float:
    if excess(low) * excess(high) > 0:
        raise WorkbenchError(f"no classical run has this {what}: choose another between the least and a crawl")
    return float(brentq(excess, low, high, xtol=1e-12, rtol=1e-14))


def _phases(vehicle: Vehicle, top: float, brake: float) -> tuple[float, float]:
    """Length in m and time in s of full traction to `top`, coasting to `brake` and braking to standstill."""
    def pull(w: float) -> float:
        return float(vehicle.traction.at(w) - _r(w, *vehicle.davis_n))

    def drag(w: float) -> float:
        return float(_r(w, *vehicle.davis_n))

    def brakes(w: float) -> float:
        return vehicle.regenerative.at(w) + vehicle.friction_brake_n + drag(w)

    length, time = 0.0, 0.0
    for force, low, high in ((pull, 0.0, top), (drag, brake, top), (brakes, 0.0, brake)):
        length += _integral(lambda w, f=force: vehicle.inertia_kg * w / f(w), low, high, vehicle)  # type: ignore[misc]
        time += _integral(lambda w, f=force: vehicle.inertia_kg / f(w), low, high, vehicle)  # type: ignore[misc]
    return length, time


def _drive_work(vehicle: Vehicle, top: float) -> float:
    """Work at the wheel of full traction from standstill to `top`, J."""
    return _integral(lambda w: vehicle.inertia_kg * w * vehicle.traction.at(w)
                     / (vehicle.traction.at(w) - _r(w, *vehicle.davis_n)), 0.0, top, vehicle)


def _integral(function: Callable[[float], float], low: float, high: float, vehicle: Vehicle) -> float:
    corners = [w for limit in (vehicle.traction, vehicle.regenerative)
               for w in (limit.power_w / limit.force_n if limit.force_n else 0.0, *(w for w, _ in limit.table))]
    inside = [w for w in corners if low < w < high]
    return float(quad(function, low, high, points=inside or None, epsabs=0.0, epsrel=1e-11, limit=200)[0])


def steep_climb(vehicle: Vehicle, hold_mps: float, grade_force_n: float, length_m: float) -> SteepSwitch:
    """Where full traction begins and ends around a climb of the given force and length on which V cannot be held.

    Raises WorkbenchError where the train can hold V, or stalls.
    """
    if vehicle.traction.at(hold_mps) >= _r(hold_mps, *vehicle.davis_n) + grade_force_n:
        raise WorkbenchError(f"the climb is not steep: the train holds {hold_mps:g} m/s on it: take more grade")
    return _steep(vehicle, hold_mps, grade_force_n, length_m, 1.0)


def steep_descent(vehicle: Vehicle, hold_mps: float, grade_force_n: float, length_m: float) -> SteepSwitch:
    """Where coasting begins and ends around a descent (a negative force) on which the train gains speed by itself.

    Raises WorkbenchError where it does not gain speed.
    """
    if _r(hold_mps, *vehicle.davis_n) + grade_force_n >= 0:
        raise WorkbenchError(f"the descent is not steep: the train does not gain speed at {hold_mps:g} m/s: take more "
                             "grade")
    return _steep(vehicle, hold_mps, grade_force_n, length_m, 0.0)


def _steep(vehicle: Vehicle, hold: float, grade: float, length: float, share: float) -> SteepSwitch:
    """Shoot on where the regime begins: costate and speed must come back to their held values at the same place.

    The state is (b, q): half the squared speed and eta times the costate, one while holding.
    """
    davis, price = vehicle.davis_n, float(_psi(hold, *vehicle.davis_n))
    held = hold**2 / 2

    def rates(s: float, state: Any) -> list[float]:
        speed = np.sqrt(2 * max(state[0], 1e-9))
        gradient = grade if 0 <= s < length else 0.0
        force = share * vehicle.traction.at(speed)
        force_slope = share * (vehicle.traction.at(speed + 1e-4) - vehicle.traction.at(speed - 1e-4)) / 2e-4
        q_slope = (-price / speed**2 + state[1] * _r_slope(speed, *davis) + (1 - state[1]) * force_slope) / speed
        return [(force - _r(speed, *davis) - gradient) / vehicle.inertia_kg, q_slope / vehicle.inertia_kg]

    def legs(begins: float) -> tuple[Any, Any]:
        """The state where the steep stretch ends, and where the speed is the held one again, with its position."""
        state = np.array([held, 1.0])
        extreme = hold
        for low, high in ((begins, 0.0), (0.0, length * (1 - 1e-12))):
            if high > low:
                found = solve_ivp(rates, (low, high), state, rtol=1e-10, atol=1e-10)
                state = found.y[:, -1]
        extreme = float(np.sqrt(2 * max(state[0], 0.0)))
        return state, extreme

    def back(_: float, state: Any) -> float:
        return float(state[0] - held)

    back.terminal = True  # type: ignore[attr-defined]

    def miss(begins: float) -> float:
        state, _ = legs(begins)
        if (state[0] - held) * (1 if share else -1) >= 0:  # it is back before the stretch ends: it began too early
            return -1.0 if share else 1.0
        after = solve_ivp(rates, (length, length + 200 * abs(length) + 1e5), state, events=back, rtol=1e-10, atol=1e-10)
        return float(after.y_events[0][0][1] - 1.0) if len(after.t_events[0]) else (1.0 if share else -1.0)

    early = -1.0
    while miss(early) * miss(0.0) > 0:
        early *= 1.5
        if early < -1e5:
            raise WorkbenchError("no place before the steep stretch meets the costate's condition: is it too long?")
    begins = float(brentq(miss, early, 0.0, xtol=1e-6))
    state, extreme = legs(begins)
    after = solve_ivp(rates, (length, length + 200 * abs(length) + 1e5), state, events=back, rtol=1e-10, atol=1e-10)
    return SteepSwitch(begins, float(after.t_events[0][0]), extreme)
