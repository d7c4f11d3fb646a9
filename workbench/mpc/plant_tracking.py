"""Tracking MPC of any plant, from the plant's own expressions: multiple shooting, limits on states, inputs and rates.

minimise   sum_k |y_k - r_k|^2_Q + |u_k - u_target|^2_R + |u_k - u_(k-1)|^2_S  + terminal weight + price of excess
subject to x_(k+1) = one or more Runge-Kutta steps of the plant with its nominal parameters, disturbances at zero
           input limits, |u_k - u_(k-1)| <= rate limit * period, state limits that may be exceeded at a price
The problem has a stage a sample, [x, u_before], [u, excess], which fatrop's Riccati recursion makes use of.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from workbench.compile.casadi_tree import casadi_of
from workbench.systems.setting import Setting, limits_of
from workbench.systems.signals import signals_at

Array = NDArray[np.float64]
Solver = Literal["fatrop", "ipopt"]
MOST_STAGES = 1000


@dataclass(frozen=True)
class PlantMpc:
    """What an MPC of a plant is made with, by names; ValueError for what is none.

    horizon: samples it looks ahead; weights: of outputs that the setting lets track a reference, per unit squared;
    terminal_weight: how many times that at the end; input_weights: of u minus its target; change_weights: of u's change
    from sample to sample; rate_limits: of an input, per second; excess_price: of a limited state's excess, per unit and
    per unit squared; substeps: Runge-Kutta steps a sample. solver: fatrop, or ipopt, which knows no structure; both to
    convergence.
    """

    horizon: int
    weights: Mapping[str, float]
    input_weights: Mapping[str, float] = field(default_factory=dict)
    change_weights: Mapping[str, float] = field(default_factory=dict)
    input_targets: Mapping[str, float] = field(default_factory=dict)
    rate_limits: Mapping[str, float] = field(default_factory=dict)
    terminal_weight: float = 1.0
    excess_price: float = 1e3
    substeps: int = 1
    solver: Solver = "fatrop"

    def __post_init__(self) -> None:
        if not 1 <= self.horizon <= MOST_STAGES or self.substeps < 1:
            raise ValueError(f"horizon = {self.horizon}, substeps = {self.substeps}: give 1 to {MOST_STAGES} samples "
                             "and at least one step")
        if self.solver not in get_args(Solver):
            raise ValueError(f"solver '{self.solver}' is not known: it is one of {', '.join(get_args(Solver))}")
        for key in ("weights", "input_weights", "change_weights", "rate_limits"):
            for name, value in getattr(self, key).items():
                if not (math.isfinite(value) and value >= 0):
                    raise ValueError(f"{key}.{name} = {value}: give a number that is not negative")

    def check(self, setting: Setting) -> None:
        """ValueError unless the plant measures all its states and has what is named."""
        plant = setting.plant
        for state in plant.states:
            if plant.outputs.get(state) != state:
                raise ValueError(f"MPC needs every state of plant '{plant.id}', and '{state}' is not measured: make it "
                                 "an output")
        for name in self.weights:
            if name not in setting.tracks:
                raise ValueError(f"weights.{name}: no reference is tracked by that output: state tracks.{name}")
        inputs = [*map(str, plant.inputs)]
        for key in ("input_weights", "change_weights", "rate_limits", "input_targets"):
            for name in getattr(self, key):
                if name not in inputs:
                    raise ValueError(f"{key}.{name}: plant '{plant.id}' has no such input: name one of "
                                     f"{', '.join(inputs) or 'none'}")

    def build(self, setting: Setting, period_s: float) -> TrackingMpc:
        """The controller for a setting, whose parameters are what it believes."""
        return TrackingMpc(self, setting, period_s)


class TrackingMpc:
    """A sampled controller: one optimal control problem a sample, warm-started from the one before.

    fallbacks counts the samples at which the solver gave nothing usable; its last plan goes on there.
    """

    title = "tracking MPC"
    information = "full state, nominal model"

    def __init__(self, how: PlantMpc, setting: Setting, period_s: float) -> None:
        how.check(setting)
        self._how, self._setting, self._period = how, setting, period_s
        self._n, self._m = len(setting.plant.states), len(setting.plant.inputs)
        self._tracked = [name for name in setting.tracks if name in how.weights]
        self._limited = [i for i, symbol in enumerate(setting.plant.states) if symbol in setting.plant.state_limits]
        self._problem()
        self._plan: Array | None = None
        self._multipliers: tuple[Any, Any] | None = None
        self._before = np.zeros(self._m)
        self.fallbacks = 0

    def _step(self) -> Any:
        """(x, u) -> x one sample later."""
        plant, setting = self._setting.plant, self._setting
        f = plant.to_casadi(setting.parameters)
        x, u = ca.SX.sym("x", self._n), ca.SX.sym("u", self._m)
        d, h, at = ca.DM.zeros(len(plant.disturbances)), self._period / self._how.substeps, x
        for _ in range(self._how.substeps):
            a = f(0, at, u, d)
            b = f(0, at + h / 2 * a, u, d)
            c = f(0, at + h / 2 * b, u, d)
            e = f(0, at + h * c, u, d)
            at = at + h / 6 * (a + 2 * b + 2 * c + e)
        return ca.Function("step", [x, u], [at])

    def _outputs(self) -> Any:
        plant = self._setting.plant
        x = ca.SX.sym("x", self._n)
        known = {**dict(zip(plant.states, ca.vertsplit(x), strict=True)),
                 **{symbol: self._setting.parameters[str(symbol)] for symbol in plant.parameter_symbols}}
        stated = {str(symbol): value for symbol, value in plant.outputs.items()}
        return ca.Function("outputs", [x], [ca.vertcat(*casadi_of([stated[name] for name in self._tracked], known))])

    def _weights(self, table: Mapping[str, float], names: list[str]) -> Any:
        return ca.DM([table.get(name, 0.0) for name in names])

    def _problem(self) -> None:
        how, n, m, N, e = self._how, self._n, self._m, self._how.horizon, len(self._limited)
        inputs = [*map(str, self._setting.plant.inputs)]
        step, outputs = self._step(), self._outputs()
        Q, R, S = (self._weights(how.weights, self._tracked), self._weights(how.input_weights, inputs),
                   self._weights(how.change_weights, inputs))
        target = self._weights(how.input_targets, inputs)
        start, desired = ca.SX.sym("start", n + m), ca.SX.sym("desired", len(self._tracked), N + 1)
        low, high = (np.array(side) for side in zip(*(
            self._setting.plant.state_limits[self._setting.plant.states[i]] for i in self._limited),
            strict=True)) if e else (np.zeros(0), np.zeros(0))
        u_low, u_high = limits_of(self._setting)
        change = np.array([how.rate_limits.get(name, math.inf) * self._period for name in inputs])
        rated = [i for i in range(m) if math.isfinite(change[i])]
        z = [ca.SX.sym(f"z_{k}", n + m) for k in range(N + 1)]
        v = [ca.SX.sym(f"v_{k}", m + e) for k in range(N)]
        cost, rows = ca.SX(0), []
        lower: list[Array] = []
        upper: list[Array] = []
        equal: list[bool] = []

        def row(value: Any, least: Any, most: Any) -> None:
            rows.append(value)
            lower.append(np.atleast_1d(least).astype(float))
            upper.append(np.atleast_1d(most).astype(float))
            equal.extend(bool(a == b) for a, b in zip(lower[-1], upper[-1], strict=True))

        for k in range(N):
            x, before, u, excess = z[k][:n], z[k][n:], v[k][:m], v[k][m:]
            row(z[k + 1] - ca.vertcat(step(x, u), u), np.zeros(n + m), np.zeros(n + m))
            if k == 0:
                row(z[0] - start, np.zeros(n + m), np.zeros(n + m))
            if rated:
                row((u - before)[rated], -change[rated], change[rated])
            for j, i in enumerate(self._limited if k else ()):
                row(ca.vertcat(x[i] - excess[j], x[i] + excess[j]), [-math.inf, low[j]], [high[j], math.inf])
            if k:  # what is measured cannot be changed any more
                cost += ca.dot(Q, (outputs(x) - desired[:, k]) ** 2)
            cost += ca.dot(R, (u - target) ** 2) + ca.dot(S, (u - before) ** 2)
            if e:  # the sum of nothing is an empty matrix
                cost += how.excess_price * ca.sum1(excess + excess**2)
        last = z[N][:n]
        cost += how.terminal_weight * ca.dot(Q, (outputs(last) - desired[:, N]) ** 2)
        for j, i in enumerate(self._limited):
            over = ca.fmax(0, ca.fmax(last[i] - high[j], low[j] - last[i]))
            cost += how.excess_price * over**2
        variables = [part for k in range(N) for part in (z[k], v[k])] + [z[N]]
        free = [(-np.full(n + m, math.inf), np.full(n + m, math.inf)),
                (np.concatenate([u_low, np.zeros(e)]), np.concatenate([u_high, np.full(e, math.inf)]))]
        self._bounds = {"lbx": np.concatenate([free[0][0], free[1][0]] * N + [free[0][0]]),
                        "ubx": np.concatenate([free[0][1], free[1][1]] * N + [free[0][1]]),
                        "lbg": np.concatenate(lower), "ubg": np.concatenate(upper)}
        nlp = {"x": ca.vertcat(*variables), "f": cost, "g": ca.vertcat(*rows),
               "p": ca.vertcat(start, ca.vec(desired))}
        self._solve = _solver(how.solver, nlp, equal)
        self._stage, self._excess = n + 2 * m + e, e

    def command(self, t: float, measured: Array) -> Any:
        """The first input of the plan from the state as measured at t."""
        N, n, m = self._how.horizon, self._n, self._m
        names = [*map(str, self._setting.plant.outputs)]
        x = np.array([measured[names.index(str(symbol))] for symbol in self._setting.plant.states])
        times: Array = t + self._period * np.arange(N + 1, dtype=float)
        tracks, references = self._setting.tracks, self._setting.references
        ahead = signals_at({name: references[tracks[name]] for name in self._tracked}, times)
        start = np.concatenate([x, self._before])
        desired = np.array([ahead[name][0] for name in self._tracked])
        guess = self._shifted(start)
        more = {} if self._multipliers is None else dict(zip(("lam_x0", "lam_g0"), self._multipliers, strict=True))
        found = self._solve(x0=guess, p=np.concatenate([start, desired.T.ravel()]), **self._bounds, **more)
        plan = np.asarray(found["x"]).ravel()
        usable = np.isfinite(plan).all() and bool(self._solve.stats()["success"])
        if not usable:
            self.fallbacks += 1
        self._plan = plan if usable else guess
        self._multipliers = (found["lam_x"], found["lam_g"]) if usable else None
        u = self._plan[n + m:n + 2 * m].copy()
        self._before = np.clip(u, *limits_of(self._setting))
        return u

    def _shifted(self, start: Array) -> Array:
        """The last plan moved on by a sample; at first the state as it stands."""
        N, s = self._how.horizon, self._stage
        if self._plan is None:
            stage = np.concatenate([start, np.zeros(self._m + self._excess)])
            return np.concatenate([np.tile(stage, N), start])
        moved = np.concatenate([self._plan[s:], self._plan[-(self._n + self._m):]])
        last_input = self._plan[s * (N - 1) + self._n + self._m:s * N]
        return np.concatenate([moved[:s * (N - 1) + self._n + self._m], last_input, moved[-(self._n + self._m):]])


def _solver(name: Solver, nlp: dict[str, Any], equal: list[bool]) -> Any:
    common: dict[str, Any] = {"expand": True, "print_time": False, "error_on_fail": False}
    if name == "fatrop":
        return ca.nlpsol("mpc", "fatrop", nlp, {**common, "structure_detection": "auto", "equality": equal,
                                                "fatrop": {"print_level": 0, "tol": 1e-6, "max_iter": 200}})
    return ca.nlpsol("mpc", "ipopt", nlp, {**common, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8}})
