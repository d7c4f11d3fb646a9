"""Tracking MPC on the scenario's train: a quadratic program a sample, offset-free by a disturbance observer.

Prediction: the plant expressions of `train.py`, linearised along the desired curve, in the errors from it.
Knows the nominal train and the desired curve ahead, not the line's grades and not the true parameters.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import control
import numpy as np

from workbench.compile import casadi_function
from workbench.errors import SolverError, WorkbenchError
from workbench.scenario import ControllerSpec, Scenario
from workbench.train import single_particle_per_mass

PARAMETERS = ("horizon", "position_weight", "speed_weight", "command_weight", "band_weight", "observer_gain")
SOLVER, OPTIONS = "daqp", {"error_on_fail": False, "print_time": False}


class TrackingMpc:
    """Linear time-varying tracking MPC with the position band as a softened constraint.

    Raises WorkbenchError for missing or unknown parameters and a horizon that is no whole number >= 2.
    `command` never raises: a failed QP is counted and the shifted last plan, else the LQR, answers instead.
    """

    title = "MPC"
    information = "full state, nominal model"

    def __init__(self, scenario: Scenario, spec: ControllerSpec, name: str, solver: str = SOLVER) -> None:
        values = spec.parameters
        for key in PARAMETERS:
            if key not in values:
                raise WorkbenchError(f"controllers.{name}.parameters: '{key}' is missing: add it")
        for key in values:
            if key not in PARAMETERS:
                raise WorkbenchError(f"controllers.{name}.parameters: unknown '{key}': choose among "
                                     f"{', '.join(PARAMETERS)}")
        self.horizon = int(values["horizon"])
        if self.horizon != values["horizon"] or self.horizon < 2:
            raise WorkbenchError(f"controllers.{name}.parameters: horizon = {values['horizon']:g} is no whole "
                                 f"number of at least 2: give the number of samples predicted")
        if not 0 < values["observer_gain"] <= 1:
            raise WorkbenchError(f"controllers.{name}.parameters: observer_gain = {values['observer_gain']:g} "
                                 f"is outside (0, 1]: choose the share of the surprise that is believed")
        for key in ("position_weight", "speed_weight", "command_weight", "band_weight"):
            if values[key] <= 0:
                raise WorkbenchError(f"controllers.{name}.parameters: {key} = {values[key]:g} is not positive: "
                                     f"give a positive weight")
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
        steps = int(np.ceil((self._curve.trip_time_s + scenario.simulation.dwell_s) / self._T)) + self.horizon + 2
        self._grid = self._curve.at(np.arange(steps) * self._T)
        drift, slope = self._drift.map(steps)(self._grid[1].reshape(1, -1))
        self._feedforward = self._grid[2] - np.asarray(drift).ravel()
        self._slope = np.asarray(slope).ravel()
        self._solver = self._build(values, solver)
        self.counters = {"qp": 0, "qp_failed": 0, "shifted_plan": 0, "lqr": 0, "band_slack_used": 0}
        self._plan = np.zeros(self.horizon + 1)
        self._disturbance, self._predicted_speed_error = 0.0, None

    def _step(self, state: Any, w: Any, d: Any, slope: Any) -> Any:
        """One period of the linearised error dynamics, by RK4 (exact to T^5)."""
        T = self._T

        def rate(x: Any) -> Any:
            return ca.vertcat(x[1], slope * x[1] + w + d)

        k1 = rate(state)
        k2 = rate(state + T / 2 * k1)
        k3 = rate(state + T / 2 * k2)
        k4 = rate(state + T * k3)
        return state + T / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def _build(self, values: dict[str, float], solver: str) -> Any:
        N, T = self.horizon, self._T
        q = np.diag([values["position_weight"], values["speed_weight"]])
        A, B = np.array([[1, T], [0, 1]]), np.array([[T**2 / 2], [T]])
        gain, terminal, _ = control.dlqr(A, B, q, np.array([[values["command_weight"]]]))
        self._gain = np.asarray(gain).ravel()
        w, slack = ca.SX.sym("w", N), ca.SX.sym("slack")
        start, d, slope = ca.SX.sym("x", 2), ca.SX.sym("d"), ca.SX.sym("slope", N)
        x, cost, positions = start, 0, []
        for k in range(N):
            # The command's cost is on its deviation from what the model needs to stay on the curve.
            cost += values["command_weight"] * (w[k] + d) ** 2 + (ca.bilin(q, x, x) if k else 0)
            x = self._step(x, w[k], d, slope[k])
            positions.append(x[0])
        cost += ca.bilin(np.asarray(terminal), x, x) + values["band_weight"] * (slack + slack**2)
        band = ca.vertcat(*positions)
        problem = {"x": ca.vertcat(w, slack), "p": ca.vertcat(start, d, slope), "f": cost,
                   "g": ca.vertcat(band + slack, band - slack)}
        self._lower_g = np.concatenate([np.full(N, -self._band), np.full(N, -np.inf)])
        self._upper_g = np.concatenate([np.full(N, np.inf), np.full(N, self._band)])
        options = OPTIONS | ({"printLevel": "none"} if solver == "qpoases" else {})
        try:
            return ca.qpsol("mpc", solver, problem, options)
        except RuntimeError as trouble:
            raise SolverError(f"casadi has no QP solver '{solver}' here: {str(trouble).splitlines()[0]}") from None

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        """The command u = F/m in m/s^2 for the sample at time_s."""
        k = round(time_s / self._T)
        N = self.horizon
        error = np.array([position_m - self._grid[0][k], speed_mps - self._grid[1][k]])
        if self._predicted_speed_error is not None:
            self._disturbance += self._observer_gain * (error[1] - self._predicted_speed_error) / self._T
        feedforward, slope = self._feedforward[k : k + N], self._slope[k : k + N]
        brake, traction = self._limits
        highest = np.full(N, traction)
        if self._train.max_power_w:
            at_speed = self._train.max_power_w / self._train.mass_kg / np.maximum(self._grid[1][k : k + N], 1e-3)
            highest = np.minimum(highest, at_speed)
        low, high = -brake - feedforward, highest - feedforward
        w = float(np.clip(self._solve(error, slope, low, high), low[0], high[0]))
        predicted = self._step(error, w, self._disturbance, slope[0])
        self._predicted_speed_error = float(predicted[1])
        return float(feedforward[0]) + w

    def _solve(self, error: Any, slope: Any, low: Any, high: Any) -> float:
        self.counters["qp"] += 1
        guess = np.append(self._plan[1:], self._plan[-1])
        guess[-1], guess[-2] = 0.0, self._plan[-2]
        answer = self._solver(
            x0=guess, p=np.concatenate([error, [self._disturbance], slope]),
            lbx=np.append(low, 0.0), ubx=np.append(high, np.inf), lbg=self._lower_g, ubg=self._upper_g,
        )
        plan = np.asarray(answer["x"]).ravel()
        if self._solver.stats()["success"] and np.all(np.isfinite(plan)):
            self._plan = plan
            self.counters["band_slack_used"] += int(plan[-1] > 1e-6)
            return float(plan[0])
        self.counters["qp_failed"] += 1
        if np.any(self._plan[1:-1]):
            self.counters["shifted_plan"] += 1
            self._plan = guess
            return float(guess[0])
        self.counters["lqr"] += 1
        return float(-self._gain @ error - self._disturbance)
