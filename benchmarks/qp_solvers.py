"""The program of linear MPC put to the QP solvers of the package index, at equal accuracy.

Unknowns are steps from the desired run, in the order of the stages; each solver takes the program in the form it is
made for (sparse; condensed for daqp, stage by stage for hpipm, which is not counted), keeps its matrices from sample to
sample where it can, and is timed over what a sample takes of it: new vectors, new dynamics, solution. One that is not
installed is told, and why; one whose commands are not those of the others has no equal accuracy, which is told too.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu
from stage_program import UNBOUNDED, Program, Stages

from workbench.mpc.linear import LinearMpc
from workbench.mpc.model import model
from workbench.mpc.problem import Array, Problem

# Residuals that every solver is asked for: a command is then right to better than EQUAL_MPS2.
TOLERANCE = 1e-8
EQUAL_MPS2 = 1e-4
HPIPM_TOLERANCE = 1e-7  # of the program as it stands; 1e-8 is beyond what it reaches in the hard run
MODULES = {"piqp": "piqp", "daqp": "daqp", "proxqp": "proxsuite", "osqp": "osqp", "qpalm": "qpalm",
           "clarabel": "clarabel", "hpipm": "casadi"}


# (program) -> its solution.
Solve = Callable[[Program], Array]


def _piqp(first: Program) -> Solve:
    import piqp  # noqa: PLC0415

    solver = piqp.SparseSolver()
    solver.settings.eps_abs = solver.settings.eps_rel = TOLERANCE
    solver.setup(*first.parts())

    def solve(program: Program) -> Array:
        solver.update(*program.parts())
        solver.solve()
        return np.asarray(solver.result.x)

    return solve


def _proxqp(first: Program) -> Solve:
    from proxsuite import proxqp  # noqa: PLC0415

    n = first.equations

    def solve(program: Program) -> Array:
        solver = proxqp.sparse.QP(len(first.q), n, len(first.low) - n)
        solver.settings.eps_abs, solver.settings.eps_rel, solver.settings.max_iter = TOLERANCE, 0.0, 100_000
        solver.init(*program.parts())
        solver.solve()
        return np.asarray(solver.results.x)

    return solve


def _osqp(first: Program) -> Solve:
    import osqp  # noqa: PLC0415

    solver = osqp.OSQP()
    # It scales what it is given in place, which the other solvers are to see as it is.
    solver.setup(sparse.triu(first.P, format="csc"), first.q.copy(), first.A.copy(), first.low.copy(),
                 first.high.copy(), eps_abs=TOLERANCE, eps_rel=TOLERANCE, max_iter=100_000, polishing=True,
                 verbose=False)

    def solve(program: Program) -> Array:
        solver.update(q=program.q, l=program.low, u=program.high, Ax=program.A.data)
        return np.asarray(solver.solve().x)

    return solve


def _qpalm(first: Program) -> Solve:
    import qpalm  # noqa: PLC0415

    del first
    settings = qpalm.Settings()
    settings.eps_abs = settings.eps_rel = TOLERANCE
    settings.verbose, settings.max_iter = 0, 100_000
    before: list[Array] = []

    def solve(program: Program) -> Array:
        data = qpalm.Data(len(program.q), len(program.low))
        data.Q, data.q, data.A, data.bmin, data.bmax = program.P, program.q, program.A, program.low, program.high
        solver = qpalm.Solver(data, settings)
        if before:
            solver.warm_start(*before)
        solver.solve()
        before[:] = [np.array(solver.solution.x), np.array(solver.solution.y)]
        return before[0]

    return solve


def _clarabel(first: Program) -> Solve:
    import clarabel  # noqa: PLC0415

    n, settings = first.equations, clarabel.DefaultSettings()
    settings.verbose, settings.tol_gap_abs, settings.tol_gap_rel, settings.tol_feas = False, *(TOLERANCE,) * 3
    cones_of = clarabel.ZeroConeT, clarabel.NonnegativeConeT

    def solve(program: Program) -> Array:
        above, below = program.high[n:] < UNBOUNDED, program.low[n:] > -UNBOUNDED
        rest = program.A[n:]
        A = sparse.vstack([program.A[:n], rest[above], -rest[below]], format="csc")
        b = np.concatenate([program.low[:n], program.high[n:][above], -program.low[n:][below]])
        cones = [cones_of[0](n), cones_of[1](len(b) - n)]
        solver = clarabel.DefaultSolver(sparse.triu(program.P, format="csc"), program.q, A, b, cones, settings)
        return np.array(solver.solve().x)

    return solve


# What a solver alone took of each sample, s, where its program is put into another form for it.
alone_s: list[float] = []


def _daqp(first: Program) -> Solve:
    """The states eliminated, so that commands and slacks are left, and a dense Hessian that daqp factors."""
    import daqp  # noqa: PLC0415

    n = first.equations

    def solve(program: Program) -> Array:
        A = program.A.tocsc()
        states = np.flatnonzero(_is_state(program))
        others = np.setdiff1d(np.arange(len(program.q)), states)
        # E_s x + E_o y = b, so that x = S y + c.
        of_states = splu(A[:n][:, states].tocsc())
        S, c = -of_states.solve(A[:n][:, others].toarray()), of_states.solve(program.low[:n])
        P = program.P
        mixed = P[others][:, states]
        H = S.T @ (P[states][:, states] @ S) + mixed @ S + (mixed @ S).T + P[others][:, others].toarray()
        # Slacks with a price alone make it singular: daqp takes a Hessian that is definite.
        H += 1e-9 * np.eye(len(H))
        f = (S.T @ (P[states][:, states] @ c + program.q[states]) + mixed @ c + program.q[others])
        rest = A[n:]
        G = rest[:, states] @ S + rest[:, others].toarray()
        moved = rest[:, states] @ c
        bound_low = np.where(program.low[n:] > -UNBOUNDED, program.low[n:] - moved, -1e30)
        bound_high = np.where(program.high[n:] < UNBOUNDED, program.high[n:] - moved, 1e30)
        before = time.thread_time()
        y, *_ = daqp.solve(np.ascontiguousarray(H), f, np.ascontiguousarray(G), bound_high, bound_low,
                           np.zeros(len(bound_low), dtype=np.int32))
        alone_s.append(time.thread_time() - before)
        z = np.zeros(len(program.q))
        z[others], z[states] = y, S @ np.asarray(y) + c
        return z

    return solve


def _hpipm(first: Program) -> Solve:
    """Stage by stage, as casadi ships it; its own processor time counts, not what casadi or the form takes."""
    import casadi as ca  # noqa: PLC0415

    N, width = (first.equations - 3) // 3, _width(first)
    rows = width - 4
    # The first three equations say the state, which becomes bounds; of a row's pair the second is the soft limit.
    limits = first.equations + np.arange(N)[:, None] * (1 + 2 * rows)
    soft = limits + 2 + 2 * np.arange(rows)
    order = np.hstack((3 + np.arange(3 * N).reshape(N, 3), soft)).ravel()
    turned = np.tile([-1.0] * 3 + [1.0] * rows, N)
    commands = np.arange(N)[:, None] * width + 3
    slacks = (commands + 1 + np.arange(rows)).ravel()

    def matrix(part: Any) -> Any:
        kept = sparse.csc_matrix(part)
        kept.sort_indices()
        pattern = ca.Sparsity(*kept.shape, kept.indptr.tolist(), kept.indices.tolist())
        return ca.DM(pattern, kept.data)

    def constraints(program: Program) -> Any:
        return matrix(sparse.diags(turned) @ program.A.tocsr()[order])

    of_each = {"nx": [3] * (N + 1), "nu": [width - 3] * N + [0], "ng": [rows] * N + [0]}
    residuals = dict.fromkeys(("res_g_max", "res_b_max", "res_d_max", "res_m_max"), HPIPM_TOLERANCE)
    solver = ca.conic("hpipm", "hpipm", {"h": matrix(first.P).sparsity(), "a": constraints(first).sparsity()},
                      {"N": N, **of_each, "hpipm": {"mode": "speed", "iter_max": 100, **residuals}})

    def solve(program: Program) -> Array:
        ends = np.where(turned < 0, -program.high[order], -np.inf), np.where(turned < 0, -program.low[order],
                                                                             program.high[order])
        low, high = np.full(len(program.q), -np.inf), np.full(len(program.q), np.inf)
        low[:3] = high[:3] = program.low[:3]
        low[commands], high[commands], low[slacks] = program.low[limits], program.high[limits], 0.0
        found = solver(h=matrix(program.P), g=program.q, a=constraints(program), lba=ends[0], uba=ends[1], lbx=low,
                       ubx=high)
        alone_s.append(solver.stats()["t_proc_solver"])
        return np.asarray(found["x"]).ravel()

    return solve


def _width(program: Program) -> int:
    """Unknowns of a stage."""
    return (len(program.q) - 3) // ((program.equations - 3) // 3)


def _is_state(program: Program) -> Array:
    """Of each unknown whether it is one of a state: these the equations lead to."""
    return np.arange(len(program.q)) % _width(program) < 3


MADE: dict[str, Callable[[Program], Solve]] = {
    "piqp": _piqp, "daqp": _daqp, "proxqp": _proxqp, "osqp": _osqp, "qpalm": _qpalm, "clarabel": _clarabel,
    "hpipm": _hpipm}


def missing() -> dict[str, str]:
    """Solver -> why it is left out, of those that are."""
    return {name: f"the package {module} is not installed" for name, module in MODULES.items()
            if importlib.util.find_spec(module) is None}


def rows(problem: Problem, ahead: Array, start: Array, samples: int) -> list[dict[str, Any]]:
    """One row a solver: median and p99 of a sample (us) along the linear tracker's own loop, and how far commands lie
    apart from the tracker's (m/s^2); of one that is left out, why.
    """
    stages, tracker = Stages(problem, ahead), LinearMpc(problem, ahead)
    step, x, states, commands = model(problem.actuator).casadi_step(), start, [], []
    taken = np.zeros(samples)
    for k in range(samples):
        before = time.thread_time()
        command = float(tracker.solve(k, x).plan[0])
        taken[k] = time.thread_time() - before
        states.append(x)
        commands.append(command)
        x = np.asarray(step(*x, command, 0.0, *problem.parameters)).ravel()
    programs = [stages.at(k, x) for k, x in enumerate(states)]
    found: list[dict[str, Any]] = [_row("this package's linear", taken, 0.0)]
    lacking = missing()
    for name, make in MADE.items():
        if name in lacking:
            found.append({"solver": name, "why": lacking[name]})
            continue
        solve, off = make(programs[0]), 0.0
        alone_s.clear()
        for k, program in enumerate(programs):
            before = time.thread_time()
            z = solve(program)
            taken[k] = time.thread_time() - before
            off = max(off, abs(float(z[program.first]) + float(stages.along.u[k]) - commands[k]))
        found.append(_row(name, np.array(alone_s) if alone_s else taken, off))
    return found


def _row(name: str, seconds: Array, off: float) -> dict[str, Any]:
    return {"solver": name, "median_us": float(np.median(seconds)) * 1e6,
            "p99_us": float(np.percentile(seconds, 99)) * 1e6, "command_off": off}


def line(row: dict[str, Any]) -> str:
    """As it is printed."""
    if "why" in row:
        return f"{row['solver']:26s} left out: {row['why']}"
    words = "" if row["command_off"] < EQUAL_MPS2 else f"  not of equal accuracy: off by up to {row['command_off']:.1e}"
    return f"{row['solver']:26s} {row['median_us']:9.1f} {row['p99_us']:9.1f}{words}"
