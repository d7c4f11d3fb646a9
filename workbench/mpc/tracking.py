"""Tracking MPC on the scenario's train: a quadratic program a sample, offset-free by a disturbance observer.

Prediction: the plant expressions of `train.py`, linearised along the desired curve, in the errors from it.
Knows the nominal train and the desired curve ahead, not the line's grades and not the true parameters.
"""

from __future__ import annotations

import math
from typing import Any

import casadi as ca
import numpy as np

from workbench.compile.kernel import casadi_function
from workbench.errors import InputError, SolverError
from workbench.mpc.buffered_program import BufferedProgram
from workbench.mpc.lqr import dlqr
from workbench.trains.scenario import ControllerSpec, Scenario
from workbench.trains.train import single_particle_per_mass

PARAMETERS = ("horizon", "position_weight", "speed_weight", "command_weight", "band_weight", "observer_gain")
OPTIONS = {"error_on_fail": False, "print_time": False}
# The QP solvers that are offered, each with the options that keep it silent. Not offered, as measured on
# closed loops of 1018 samples in which the limits and the band bind:
# osqp: 123 programs failed with its own tolerances; with the best of ten settings tried (1e-6, polished,
#   rho = 100) still 10 of them in one of twelve random loops, where a command was off by 0.16 m/s^2;
# qrqp: 1 to 5 failed in each of four loops, and the commands around them were off by up to 1.6 m/s^2;
# proxqp: 116 to 468 failed; highs: 32 failed; qpoases: right, but prints a banner that no option silences;
# hpipm: crashes the process when it is built without the structure of an optimal control problem.
SOLVERS: dict[str, dict[str, Any]] = {
    "daqp": {},
    "piqp": {"piqp": {"verbose": False}},
}
SOLVER = "daqp"

# A train is nowhere near these, so a measurement beyond them is no measurement.
FARTHEST_M, FASTEST_MPS = 1e9, 1e4
LONGEST_HORIZON = 1000
SMALLEST_WEIGHT, LARGEST_WEIGHT = 1e-9, 1e12


class TrackingMpc:
    """Linear time-varying tracking MPC with the position band as a softened constraint.

    Raises InputError for missing, unknown or unfit parameters and SolverError for a solver not in SOLVERS.
    `command` never raises and never answers NaN: a failed QP or a bad measurement is counted, and the last
    plan, shifted, answers instead; without a plan the LQR does, or after a bad measurement the feedforward.
    """

    title = "MPC"
    information = "full state, nominal model"

    def __init__(self, scenario: Scenario, spec: ControllerSpec, name: str, solver: str = SOLVER) -> None:
        where = f"controllers.{name}.parameters"
        values = _checked(spec.parameters, where)
        if spec.predictor:
            raise InputError("", f"controllers.{name}.predictor", f"'{spec.law}' knows no actuator: take mpc.linear or "
                             "leave it out")
        self.horizon = int(values["horizon"])
        self._T = spec.period_s
        self._observer_gain = values["observer_gain"]
        self._curve = scenario.desired_curve()
        self._train = scenario.train
        self._band = scenario.simulation.position_band_m
        self._limits = (scenario.train.max_braking_n / scenario.train.mass_kg,
                        scenario.train.max_traction_n / scenario.train.mass_kg)
        plant = single_particle_per_mass()
        rates = casadi_function("plant", (*plant.rates, plant.command, plant.disturbance, *plant.parameters),
                                list(plant.rates.values()))
        davis = (self._train.davis_a_mps2, self._train.davis_b_per_s, self._train.davis_c_per_m)
        speed = ca.SX.sym("v")
        acceleration = rates(0, speed, 0, 0, *davis)[1]
        self._drift = ca.Function("drift", [speed], [acceleration, ca.gradient(acceleration, speed)])
        duration = self._curve.trip_time_s + scenario.simulation.dwell_s
        steps = math.ceil(duration / self._T) + self.horizon + 2
        self._grid = self._curve.at(np.arange(steps, dtype=np.float64) * self._T)
        drift, slope = self._drift.map(steps)(self._grid[1].reshape(1, -1))
        self._feedforward = self._grid[2] - np.asarray(drift).ravel()
        self._slope = np.asarray(slope).ravel()
        brake, traction = self._limits
        highest = np.full(steps, traction)
        if self._train.max_power_w:
            at_speed = self._train.max_power_w / np.maximum(self._grid[1], 1e-3)
            highest = np.minimum(highest, at_speed / self._train.mass_kg)
        self._highest = highest
        # The limits of w, what the command adds to the feedforward.
        self._low, self._high = -brake - self._feedforward, highest - self._feedforward
        self._gain, self._terminal = _lqr(values, self._T, where)
        self._solver = self._build(values, self._terminal, solver)
        self.counters = {"qp": 0, "qp_failed": 0, "shifted_plan": 0, "lqr": 0, "band_slack_used": 0,
                         "bad_measurement": 0}
        self._plan = np.zeros(self.horizon + 1)
        self._sample, self._last_sample = -1, steps - self.horizon - 1
        self._disturbance = 0.0
        self._predicted_speed_error: float | None = None

    def _step(self, state: tuple[Any, Any], w: Any, d: Any, slope: Any) -> tuple[Any, Any]:
        """One period of the linearised error dynamics, by RK4 (exact to T^5); of numbers or casadi symbols."""
        T = self._T
        (e, v), push = state, w + d
        a1 = slope * v + push
        v2 = v + T / 2 * a1
        a2 = slope * v2 + push
        v3 = v + T / 2 * a2
        a3 = slope * v3 + push
        v4 = v + T * a3
        a4 = slope * v4 + push
        return e + T / 6 * (v + 2 * v2 + 2 * v3 + v4), v + T / 6 * (a1 + 2 * a2 + 2 * a3 + a4)

    def _build(self, values: dict[str, float], terminal: Any, solver: str) -> Any:
        N = self.horizon
        q = np.diag([values["position_weight"], values["speed_weight"]])
        w, slack = ca.SX.sym("w", N), ca.SX.sym("slack")
        start, d, slope = ca.SX.sym("x", 2), ca.SX.sym("d"), ca.SX.sym("slope", N)
        state, positions = (start[0], start[1]), []
        cost: Any = 0
        for k in range(N):
            # The command's cost is on its deviation from what the model needs to stay on the curve.
            x = ca.vertcat(*state)
            cost += values["command_weight"] * (w[k] + d) ** 2 + (ca.bilin(q, x, x) if k else 0)
            state = self._step(state, w[k], d, slope[k])
            positions.append(state[0])
        x = ca.vertcat(*state)
        cost += ca.bilin(terminal, x, x) + values["band_weight"] * (slack + slack**2)
        band = ca.vertcat(*positions)
        problem = {"x": ca.vertcat(w, slack), "p": ca.vertcat(start, d, slope), "f": cost,
                   "g": ca.vertcat(band + slack, band - slack)}
        self._lower_g = np.concatenate([np.full(N, -self._band), np.full(N, -np.inf)])
        self._upper_g = np.concatenate([np.full(N, np.inf), np.full(N, self._band)])
        if solver not in SOLVERS:
            raise SolverError(f"unknown QP solver '{solver}': choose one of {', '.join(SOLVERS)}")
        try:
            return BufferedProgram(ca.qpsol("mpc", solver, problem, OPTIONS | SOLVERS[solver]))
        except RuntimeError:
            raise SolverError(f"this casadi has no QP solver '{solver}': choose '{SOLVER}'") from None

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        """The command u = F/m in m/s^2 for the sample at time_s."""
        good = (math.isfinite(time_s) and abs(position_m) < FARTHEST_M and abs(speed_mps) < FASTEST_MPS)
        k = round(time_s / self._T) if math.isfinite(time_s) else self._sample + 1
        k = self._sample = min(max(k, 0), self._last_sample)
        feedforward, brake, highest = float(self._feedforward[k]), self._limits[0], float(self._highest[k])
        if not good:
            self.counters["bad_measurement"] += 1
            # Nothing was measured, so the observer has nothing to compare its last prediction with.
            self._predicted_speed_error = None
            return _clipped(feedforward + (self._shifted_plan() or 0.0), -brake, highest)
        error = (float(position_m - self._grid[0][k]), float(speed_mps - self._grid[1][k]))
        if self._predicted_speed_error is not None:
            self._disturbance += self._observer_gain * (error[1] - self._predicted_speed_error) / self._T
        w = _clipped(self._solve(k, error), float(self._low[k]), float(self._high[k]))
        self._predicted_speed_error = float(self._step(error, w, self._disturbance, float(self._slope[k]))[1])
        # Once more, because the sum of feedforward and its bound may pass the limit by a rounding error.
        return _clipped(feedforward + w, -brake, highest)

    def _guess(self) -> Any:
        """The last plan one sample later, its last command held, without slack."""
        return np.concatenate([self._plan[1:-1], self._plan[-2:-1], [0.0]])

    def _shifted_plan(self) -> float | None:
        """The last plan's command for this sample, or None without a plan; advances the plan."""
        if not np.any(self._plan[1:-1]):
            return None
        self.counters["shifted_plan"] += 1
        self._plan = self._guess()
        return float(self._plan[0])

    def _solve(self, k: int, error: tuple[float, float]) -> float:
        """What is added to the feedforward at sample k: the first of a plan, which is kept."""
        self.counters["qp"] += 1
        ahead = slice(k, k + self.horizon)
        try:
            answer = self._solver(
                x0=self._guess(), p=np.concatenate([error, [self._disturbance], self._slope[ahead]]),
                lbx=np.append(self._low[ahead], 0.0), ubx=np.append(self._high[ahead], np.inf), lbg=self._lower_g,
                ubg=self._upper_g,
            )
            plan = np.asarray(answer["x"]).ravel()
            solved = bool(self._solver.stats()["success"]) and bool(np.all(np.isfinite(plan)))
        except RuntimeError:  # what casadi raises where a solver gives up in its own way
            solved = False
        if solved:
            self._plan = plan
            self.counters["band_slack_used"] += int(plan[-1] > 1e-6)
            return float(plan[0])
        self.counters["qp_failed"] += 1
        shifted = self._shifted_plan()
        if shifted is not None:
            return shifted
        self.counters["lqr"] += 1
        return float(-self._gain @ error - self._disturbance)


def _clipped(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


def _lqr(values: dict[str, float], period_s: float, where: str) -> tuple[Any, Any]:
    """Gain and cost matrix of the LQR for the errors as a double integrator, the cost beyond the horizon."""
    T = period_s
    A, B = np.array([[1, T], [0, 1]]), np.array([[T**2 / 2], [T]])
    q = np.diag([values["position_weight"], values["speed_weight"]])
    try:
        gain, terminal = dlqr(A, B, q, np.array([[values["command_weight"]]]))
    except ValueError:
        raise InputError("", where, "no LQR follows from these weights: choose weights nearer to each other"
                         ) from None
    return np.asarray(gain).ravel(), np.asarray(terminal)


def _checked(values: dict[str, float], where: str) -> dict[str, float]:
    for key in PARAMETERS:
        if key not in values:
            raise InputError("", where, f"'{key}' is missing: add it")
    for key in values:
        if key not in PARAMETERS:
            raise InputError("", where, f"unknown '{key}': choose among {', '.join(PARAMETERS)}")
    horizon, gain = values["horizon"], values["observer_gain"]
    if not (2 <= horizon <= LONGEST_HORIZON and horizon == int(horizon)):
        raise InputError("", where, f"horizon = {horizon:g} is no whole number from 2 to {LONGEST_HORIZON}: "
                         f"give the number of samples predicted")
    if not 0 < gain <= 1:
        raise InputError("", where, f"observer_gain = {gain:g} is outside (0, 1]: choose the share of the "
                         f"surprise that is believed")
    for key in ("position_weight", "speed_weight", "command_weight", "band_weight"):
        if not SMALLEST_WEIGHT <= values[key] <= LARGEST_WEIGHT:
            raise InputError("", where, f"{key} = {values[key]:g} is outside {SMALLEST_WEIGHT:g} to "
                             f"{LARGEST_WEIGHT:g}: choose a weight within")
    return values
