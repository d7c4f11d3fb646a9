"""The optimal control problem of a plant's MPC, made from the plant's own expressions, and the solvers that take it.

minimise   sum_k |y_k - r_k|^2_Q + |u_k - u_target|^2_R + |u_k - u_(k-1)|^2_S + weighted metrics
           + terminal weight + price of excess
subject to x_(k+1) = d + one or more Runge-Kutta steps of the plant with its nominal parameters, disturbances at zero or
           as estimated
           input limits, |u_k - u_(k-1)| <= rate limit * period, state limits that may be exceeded at a price
The problem has a stage a sample, [x, u_before], [u, excess], which fatrop's Riccati recursion makes use of; d is the
same over the horizon.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from workbench.compile.casadi_tree import casadi_of
from workbench.mpc.plant_motion import PlantMotion
from workbench.mpc.plant_values import PlantMpcValues
from workbench.systems.setting import Setting, limits_of

Array = NDArray[np.float64]
MOST_STEEP = 200  # steps of ipopt for a sample, where slopes have no bound and it may come to no end
# A run ends where a state goes beyond it. Of residuals far beyond, fatrop looks for a first step without end.
LARGEST_RESIDUAL = 1e12


@dataclass(frozen=True)
class Program:
    """A problem as a solver takes it: its arguments are x0, p and bounds.

    p is [state, input before, d, estimated disturbances, desired outputs by stage, times and all references' values by
    stage], the last two only where metrics are minimised; rows: the constraints, a function of x0 and p, and slopes
    their derivatives by x0; limited: the states with limits.
    """

    solve: Any
    rows: Any
    slopes: Any
    bounds: Mapping[str, Array]
    limited: tuple[int, ...]


def program(how: PlantMpcValues, setting: Setting, period_s: float, tracked: list[str],
            motion: PlantMotion) -> Program:
    """The problem of an MPC in a setting, whose parameters are what it believes."""
    plant = setting.plant
    n, m, N = len(plant.states), len(plant.inputs), how.horizon
    inputs = [*map(str, plant.inputs)]
    limited = tuple(i for i, symbol in enumerate(plant.states) if symbol in plant.state_limits)
    e = len(limited)
    step, outputs = motion.function(period_s), _outputs(setting, tracked, motion)
    Q, R, S = (_vector(how.weights, tracked), _vector(how.input_weights, inputs), _vector(how.change_weights, inputs))
    target = _vector(how.input_targets, inputs)
    start, push = ca.SX.sym("start", n + m), ca.SX.sym("push", n if how.disturbance_gain else 0)
    estimated = ca.SX.sym("estimated", len(motion.estimated))
    desired = ca.SX.sym("desired", len(tracked), N + 1)
    running, terminal, rows_ahead = _metrics(how, setting, period_s, motion)
    ahead = ca.SX.sym("ahead", rows_ahead, N + 1)
    low, high = (np.array(side) for side in zip(*(plant.state_limits[plant.states[i]] for i in limited), strict=True)) \
        if e else (np.zeros(0), np.zeros(0))
    change = np.array([how.rate_limits.get(name, math.inf) * period_s for name in inputs])
    rated = [i for i in range(m) if math.isfinite(change[i])]
    z = [ca.SX.sym(f"z_{k}", n + m) for k in range(N + 1)]
    v = [ca.SX.sym(f"v_{k}", m + e) for k in range(N)]
    cost, rows = ca.SX(0), _Rows()
    for k in range(N):
        x, before, u, excess = z[k][:n], z[k][n:], v[k][:m], v[k][m:]
        moved = step(x, u, estimated) + push if how.disturbance_gain else step(x, u, estimated)
        rows.add(z[k + 1] - ca.vertcat(moved, u), np.zeros(n + m), np.zeros(n + m))
        if k == 0:
            rows.add(z[0] - start, np.zeros(n + m), np.zeros(n + m))
        if rated:
            rows.add((u - before)[rated], -change[rated], change[rated])
        for j, i in enumerate(limited if k else ()):
            rows.add(ca.vertcat(x[i] - excess[j], x[i] + excess[j]), [-math.inf, low[j]], [high[j], math.inf])
        if k and tracked:  # what is measured cannot be changed any more
            cost += ca.dot(Q, (outputs(x) - desired[:, k]) ** 2)
        cost += ca.dot(R, (u - target) ** 2) + ca.dot(S, (u - before) ** 2)
        if how.objective:
            cost += running(x, u, ahead[:, k])
        if e:
            cost += how.excess_price * ca.sum1(excess + excess**2)
    last = z[N][:n]
    if tracked:  # the sum of nothing is an empty matrix
        cost += how.terminal_weight * ca.dot(Q, (outputs(last) - desired[:, N]) ** 2)
    if how.objective:
        cost += terminal(last, z[N][n:], ahead[:, N])
    for j, i in enumerate(limited):
        over = ca.fmax(0, ca.fmax(last[i] - high[j], low[j] - last[i]))
        cost += how.excess_price * over**2
    variables = ca.vertcat(*[part for k in range(N) for part in (z[k], v[k])], z[N])
    u_low, u_high = limits_of(setting)
    free = np.full(n + m, math.inf)
    bounds = {"lbx": np.concatenate([*[np.concatenate([-free, u_low, np.zeros(e)])] * N, -free]),
              "ubx": np.concatenate([*[np.concatenate([free, u_high, np.full(e, math.inf)])] * N, free]),
              "lbg": np.concatenate(rows.lower), "ubg": np.concatenate(rows.upper)}
    nlp = {"x": variables, "f": cost, "g": ca.vertcat(*rows.values),
           "p": ca.vertcat(start, push, estimated, ca.vec(desired), ca.vec(ahead))}
    of_rows = ca.Function("rows", [nlp["x"], nlp["p"]], [nlp["g"]])
    slopes = ca.Function("slopes", [nlp["x"], nlp["p"]], [ca.jacobian(nlp["g"], nlp["x"])])
    return Program(_solver(how, nlp, rows.equal, motion.is_steep), of_rows, slopes, bounds, limited)


class _Rows:
    """Constraints in the order of their stages."""

    def __init__(self) -> None:
        self.values: list[Any] = []
        self.lower: list[Array] = []
        self.upper: list[Array] = []
        self.equal: list[bool] = []

    def add(self, value: Any, least: Any, most: Any) -> None:
        self.values.append(value)
        self.lower.append(np.atleast_1d(least).astype(float))
        self.upper.append(np.atleast_1d(most).astype(float))
        self.equal.extend(bool(a == b) for a, b in zip(self.lower[-1], self.upper[-1], strict=True))


def _vector(table: Mapping[str, float], names: list[str]) -> Any:
    return ca.DM([table.get(name, 0.0) for name in names])


def _outputs(setting: Setting, tracked: list[str], motion: PlantMotion) -> Any:
    x = ca.SX.sym("x", len(setting.plant.states))
    stated = {str(symbol): value for symbol, value in setting.plant.outputs.items()}
    return ca.Function("outputs", [x], [ca.vertcat(*casadi_of([stated[name] for name in tracked], motion.known(x)))])


def _metrics(how: PlantMpcValues, setting: Setting, period_s: float,
             motion: PlantMotion) -> tuple[Any, Any, int]:
    """The stage's and the end's weighted metrics as functions of x, u and [t, all references' values]; rows of that."""
    if not how.objective:
        return None, None, 0
    plant = setting.plant
    symbols = [symbol for channel in setting.channels for symbol in channel.symbols]
    x, u, ahead = (ca.SX.sym(name, size) for name, size in (
        ("x", len(plant.states)), ("u", len(plant.inputs)), ("ahead", 1 + len(symbols))))
    known = {**motion.known(x), **dict(zip(plant.inputs, ca.vertsplit(u), strict=True)),
             **dict.fromkeys(plant.disturbances, 0.0),
             **(dict(zip(symbols, ca.vertsplit(ahead[1:]), strict=True)) if symbols else {})}
    stage, end = ca.SX(0), ca.SX(0)
    for metric in setting.every_metric:
        weight = how.objective.get(metric.id, 0.0)
        if weight and metric.integrand is not None:
            stage += weight * period_s * casadi_of([metric.integrand], known, ahead[0])[0]
        elif weight:
            end += weight * casadi_of([metric.expression], known, ahead[0])[0]
    return (ca.Function("stage", [x, u, ahead], [stage]), ca.Function("end", [x, u, ahead], [end]), 1 + len(symbols))


def _solver(how: PlantMpcValues, nlp: dict[str, Any], equal: list[bool], is_steep: bool) -> Any:
    # An iterate beyond a function's domain is the solver's to step back from, and no warning to the user.
    common: dict[str, Any] = {"expand": True, "print_time": False, "error_on_fail": False,
                              "show_eval_warnings": False}
    structured: dict[str, Any] = {"structure_detection": "auto", "equality": equal}
    if how.one_iteration:
        gamma, rows = ca.SX.sym("gamma"), ca.SX.sym("rows", nlp["g"].shape)
        # The cost's own Hessian, without the curvature of the plant, is positive semidefinite where outputs are linear.
        hessian = ca.Function("hessian", [nlp["x"], nlp["p"], gamma, rows], [gamma * ca.hessian(nlp["f"], nlp["x"])[0]],
                              ["x", "p", "lam_f", "lam_g"], ["hess_gamma_x_x"])
        quiet = {"print_header": False, "print_iteration": False, "print_status": False}
        return ca.nlpsol("mpc", "sqpmethod", nlp, {
            **common, **quiet, "max_iter": 1, "max_iter_ls": 0, "hess_lag": hessian, "qpsol": "piqp",
            "qpsol_options": {"print_time": False, "error_on_fail": False}})
    if how.solver == "fatrop" and not is_steep:  # where slopes have no bound, fatrop may look for a step without end
        return ca.nlpsol("mpc", "fatrop", nlp, {**common, **structured,
                                                "fatrop": {"print_level": 0, "tol": 1e-6, "max_iter": 200}})
    return ca.nlpsol("mpc", "ipopt", nlp, {**common, "ipopt": {
        "print_level": 0, "sb": "yes", "tol": 1e-8, **({"max_iter": MOST_STEEP} if is_steep else {})}})
