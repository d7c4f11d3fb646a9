"""The tracking problem as a nonlinear program for casadi's solvers: what the compiled solver is held against.

Multiple shooting with one slack a soft row and stage; unknowns and constraints in the order of the stages, which
solvers that exploit the structure need. Other costs than tracking come in by `stage_cost`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from workbench.compile.kernel import casadi_function
from workbench.errors import SolverError
from workbench.mpc import model as of
from workbench.mpc.problem import Array, Problem
from workbench.mpc.solution import Solution
from workbench.mpc.terminal import Lqr, lqr

QUIET: dict[str, Any] = {"print_time": False, "error_on_fail": False, "calc_lam_p": False, "calc_multipliers": False}
_SQP: dict[str, Any] = {"print_header": False, "print_iteration": False, "print_status": False, "max_iter": 50}
_QRQP = {"print_iter": False, "print_header": False, "print_info": False, "error_on_fail": False}
# The solvers that are offered, each with its options: name -> (plugin, options). The tests hold each to the closed-loop
# cost of ipopt. Not offered, as measured on a loop in which power binds: sqpmethod with daqp or with fatrop for its
# programs costs 4.6 times as much; with osqp 35 of 120 programs fail.
SOLVERS: dict[str, tuple[str, dict[str, Any]]] = {
    "ipopt": ("ipopt", {"ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8, "max_iter": 200}}),
    "fatrop": ("fatrop", {"structure_detection": "auto", "fatrop": {"print_level": 0, "tol": 1e-8, "max_iter": 200}}),
    "sqp_qrqp": ("sqpmethod", _SQP | {"qpsol": "qrqp", "qpsol_options": _QRQP}),
    "sqp_piqp": ("sqpmethod", _SQP | {"qpsol": "piqp", "qpsol_options": {
        "piqp": {"verbose": False}, "error_on_fail": False}}),
}

# Beyond this, in m, m/s and m/s^2, nothing is a train's.
LARGEST_STATE = 1e9

StageCost = Callable[[Any, Any, Any], Any]
StageEnd = Callable[[Any, Any], Any]


class CasadiMpc:
    """A problem solved by one of SOLVERS, from sample to sample with the solution before, shifted, as its start.

    stage_cost: of (state, command, row of `preview`), casadi to casadi; the tracking cost unless given. terminal: of
    (state, row); the LQR's cost unless given. Raises SolverError for a solver that is not offered.
    """

    def __init__(self, problem: Problem, ahead: Array, solver: str = "ipopt", stage_cost: StageCost | None = None,
                 terminal: StageEnd | None = None, beyond: Lqr | None = None) -> None:
        if solver not in SOLVERS:
            raise SolverError(f"unknown solver '{solver}': choose one of {', '.join(SOLVERS)}")
        self.problem, self.ahead, self.horizon = problem, ahead, problem.horizon
        self.lqr = beyond or lqr(problem)
        self._rows = problem.rows(ahead)
        self.stage_cost, self.terminal = stage_cost or tracking_cost(problem), terminal or lqr_cost(self.lqr)
        program = _program(problem, tuple(self._rows.tolist()), solver, self.stage_cost, self.terminal)
        self._solver, self._read, self._bounds = program.solver, program.read, program.bounds
        self.cost = 0.0
        self.forget()

    def forget(self) -> None:
        """Drop the warm start; the next program starts from the desired states and commands."""
        self._last: tuple[Array, Array] | None = None
        self._sample = -1

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state at a sample; never raises: what the solver says is in `why`.

        Where the plan before is a start from which the solver does not arrive, it starts again from the desired run.
        """
        N = self.horizon
        window = self.ahead[sample : sample + N + 1].copy()
        if not (np.abs(state) < LARGEST_STATE).all() or not math.isfinite(disturbance):
            # Some of the solvers never return from such numbers.
            self.forget()
            return Solution(window[:N, 3], solved=False, why="the state is no train's")
        # The train does not care where it is, but solvers do: their smallest step is relative to the unknowns.
        origin = np.array([window[0, 0], 0.0, 0.0])
        window[:, 0] -= origin[0]
        state = state - origin
        window[:, 5] += disturbance
        window[:, 2:4] -= disturbance
        window[:, 4] = np.where(np.isfinite(window[:, 4]), window[:, 4], 0.0)
        starts = [(window[:N, 3], window[:, :3].copy())]
        if self._last is not None and sample == self._sample + 1:
            plan, states = self._last
            starts.insert(0, (np.append(plan[1:], plan[-1]), np.concatenate([states[1:] - origin, window[N:, :3]])))
        self._sample, self._last = sample, None
        for tried, (plan, states) in enumerate(starts, start=1):
            states[0] = state
            solution = self._solve_from(states, plan, np.concatenate([state, window.ravel()]), tried)
            if solution.solved:
                self._last = solution.plan, self._states + origin
                break
        return solution

    def _solve_from(self, states: Array, plan: Array, given: Array, tried: int) -> Solution:
        """One call of the solver, from a plan and its states."""
        try:
            answer = self._solver(x0=_stacked(states, plan, len(self._rows)), p=given, **self._bounds)
            stats = self._solver.stats()
        except RuntimeError as trouble:
            return Solution(plan, solved=False, programs=tried, why=str(trouble).splitlines()[-1])
        plan, states = (np.asarray(a) for a in self._read(answer["x"]))
        plan, self.cost = plan.ravel(), float(answer["f"])
        if not (stats["success"] and np.isfinite(plan).all()):
            return Solution(plan, solved=False, programs=tried, why=str(stats["return_status"]))
        self._states = states.T
        return Solution(plan, solved=True, programs=tried)


@dataclass(frozen=True)
class Program:
    """A program as casadi solves it: its solver, commands and states of its unknowns, and their bounds."""

    solver: Any
    read: Any
    bounds: Mapping[str, Any]


@lru_cache(maxsize=8)
def _program(problem: Problem, rows: tuple[int, ...], solver: str, stage_cost: StageCost,
             terminal: StageEnd) -> Program:
    """Unknowns in the order x_0, u_0, x_1, u_1, s_1, ... x_N; the state at the start is a parameter.

    Kept, since it takes longer than a run; it remembers nothing of the programs that it solved.
    """
    N, soft = problem.horizon, len(rows)
    step = of.model(problem.actuator).casadi_step()
    given = ca.SX.sym("given", 3 + 6 * (N + 1))
    window = ca.reshape(given[3:], 6, N + 1)
    states = [ca.SX.sym(f"x_{k}", 3) for k in range(N + 1)]
    commands = [ca.SX.sym(f"u_{k}") for k in range(N)]
    slacks = [ca.SX.sym(f"s_{k}", soft if k else 0) for k in range(N)]
    cost, constraints, equal = terminal(states[N], window[:, N]), [], []
    for k in range(N):
        x, u, row = states[k], commands[k], window[:, k]
        constraints.append(states[k + 1] - step(x[0], x[1], x[2], u, row[5], *problem.parameters))
        cost += stage_cost(x, u, row)
        if k == 0:
            constraints.append(x - given[:3])
        elif soft:
            exceeded, price = _softened(problem, rows, x, row, slacks[k])
            constraints.append(exceeded)
            cost += price
        equal += [True] * (6 if k == 0 else 3) + [False] * (soft if k else 0)
    every = ca.vertcat(*(part for k in range(N) for part in (states[k], commands[k], slacks[k])), states[N])

    def each(state: float, command: float, slack: float) -> Array:
        return _stacked(np.full((N + 1, 3), state), np.full(N, command), soft, slack)

    bounds = {"lbx": each(-np.inf, problem.lowest_command_mps2, 0.0),
              "ubx": each(np.inf, problem.highest_command_mps2, np.inf),
              "ubg": 0.0, "lbg": np.where(equal, 0.0, -np.inf)}
    plugin, options = SOLVERS[solver]
    options = QUIET | options | ({"equality": equal} if plugin == "fatrop" else {})
    try:
        nlp = {"x": every, "p": given, "f": cost, "g": ca.vertcat(*constraints)}
        made = ca.nlpsol("mpc", plugin, nlp, options)
    except RuntimeError as trouble:
        raise SolverError(f"casadi's '{plugin}' cannot take this problem: choose another of {', '.join(SOLVERS)} "
                          f"({str(trouble).splitlines()[-1][:80]})") from None
    return Program(made, ca.Function("read", [every], [ca.vertcat(*commands), ca.horzcat(*states)]), bounds)


def _softened(problem: Problem, rows: tuple[int, ...], x: Any, row: Any, s: Any) -> tuple[Any, Any]:
    """The soft rows of a stage less their slack, and what the slack costs."""
    soft = casadi_function("soft", (*of.STATE, of.p_r, of.p_band, of.v_limit, of.P_limit), of.soft_rows)
    limits = np.where(np.isfinite(problem.limits()), problem.limits(), 0.0)
    h = soft(x[0], x[1], x[2], row[0], limits[2], row[4], limits[3])
    price = [problem.price[i][0] * s[n] + problem.price[i][1] * s[n] ** 2 for n, i in enumerate(rows)]
    return h[list(rows)] - s, sum(price)


def _stacked(states: Array, plan: Array, soft: int, slack: float = 0.0) -> Array:
    """The unknowns of a plan; soft: slacks a stage."""
    parts = [np.concatenate([states[k], plan[k : k + 1], np.full(soft if k else 0, slack)]) for k in range(len(plan))]
    return np.concatenate([*parts, states[-1]])


def lqr_cost(beyond: Lqr) -> StageEnd:
    """The cost beyond the horizon, as a terminal cost."""
    def cost(x: Any, row: Any) -> Any:
        error = x - row[:3]
        return ca.bilin(beyond.cost, error, error)

    return cost


def tracking_cost(problem: Problem) -> StageCost:
    """The weighted squares of a problem, as a stage cost."""
    w = problem.weights

    def cost(x: Any, u: Any, row: Any) -> Any:
        return (w.position * (x[0] - row[0]) ** 2 + w.speed * (x[1] - row[1]) ** 2 + w.force * (x[2] - row[2]) ** 2
                + w.command * (u - row[3]) ** 2 + w.change * (u - x[2]) ** 2)

    return cost
