"""Every variant of MPC a second time, its programs written anew where they are our own and solved by ipopt."""

import casadi as ca
import numpy as np
import pytest

from workbench.mpc import tracking
from workbench.mpc.linear import LinearMpc
from workbench.mpc.nonlinear import NonlinearMpc
from workbench.mpc.solution import Solution
from workbench.mpc.tracking import TrackingMpc
from workbench.mpc.transcription import SOLVERS, CasadiMpc
from workbench.mpc.tube import TubeMpc

IPOPT = {"print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-10, "max_iter": 300}}

# Closer to the limits than the offered one: that leaves 1e-5 m/s^2, which in a loop that is held at its limit for 30 s
# are 1e-4 of its cost.
EXACT = ("ipopt", {"ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-11, "max_iter": 300, "mu_target": 0.0,
                             "compl_inf_tol": 1e-9, "dual_inf_tol": 1e-6, "bound_relax_factor": 0.0}})


def by_exact_ipopt(of, **costs):
    """A `CasadiMpc` of the same problem."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(SOLVERS, "ipopt_exact", EXACT)
        return CasadiMpc(of.problem, of.ahead, "ipopt_exact", **costs)


class LinearByIpopt:
    """The programs of a `LinearMpc` from its linearisation, stage by stage, by ipopt."""

    def __init__(self, of):
        self.of, self.horizon, self.lqr, self.ahead, self.problem = of, of.horizon, of.lqr, of.ahead, of.problem
        N, w, rows = of.horizon, of.problem.weights, of.problem.rows(of.ahead)
        start, wanted_u = ca.SX.sym("start", 3), ca.SX.sym("wu", N)
        jac, gap, wanted = ca.SX.sym("jac", 12, N), ca.SX.sym("gap", 3, N), ca.SX.sym("wx", 3, N + 1)
        h, g, base = ca.SX.sym("h", 4, N), ca.SX.sym("g", 12, N), ca.SX.sym("base", N)
        x, u, s = ca.SX.sym("x", 3, N + 1), ca.SX.sym("u", N), ca.SX.sym("s", len(rows), N)
        end = x[:, N] - wanted[:, N]
        cost, equal, soft = ca.bilin(ca.DM(of.lqr.cost), end, end), [x[:, 0] - start], []
        for k in range(N):
            A = ca.reshape(jac[:, k], 4, 3).T
            equal.append(x[:, k + 1] - A[:, :3] @ x[:, k] - A[:, 3] * u[k] - gap[:, k])
            e, change = x[:, k] - wanted[:, k], (base[k] + u[k]) - x[2, k]
            cost += (w.position * e[0] ** 2 + w.speed * e[1] ** 2 + w.force * e[2] ** 2
                     + w.command * (u[k] - wanted_u[k]) ** 2 + w.change * change**2)
            slope = ca.reshape(g[:, k], 3, 4).T
            for n, i in enumerate(rows if k else []):
                soft.append(h[i, k] + slope[int(i), :] @ x[:, k] - s[n, k])
                cost += of.problem.price[i][0] * s[n, k] + of.problem.price[i][1] * s[n, k] ** 2
        given = ca.vertcat(start, *(ca.vec(part) for part in (wanted_u, jac, gap, wanted, h, g, base)))
        unknown = ca.vertcat(ca.vec(x), u, ca.vec(s))
        # Only x_2 enters the change of the command absolutely: its base is added to both by `solve`.
        self._solver = ca.nlpsol("linear", "ipopt", {"x": unknown, "p": given, "f": cost,
                                                     "g": ca.vertcat(*equal, *soft)}, IPOPT)
        self._sizes = 3 * (N + 1), N, len(rows) * N
        self._ubg = np.zeros(3 * (N + 1) + len(soft))
        self._lbg = np.concatenate([np.zeros(3 * (N + 1)), np.full(len(soft), -np.inf)])

    def forget(self):
        """Nothing is kept."""

    def solve(self, sample, state, disturbance=0.0):
        N, along, low, high = self.horizon, self.of.along, *self.problem.limits()[:2]
        at, to = slice(sample, sample + N), slice(sample, sample + N + 1)
        base, base_u = along.x[to], along.u[at]
        desired = self.ahead[to].copy()
        desired[:, 2:4] -= disturbance
        gap = along.gap[at] + disturbance * along.answer[at]
        # In steps from the base; what the change of the command is of, its base less that of the force.
        given = np.concatenate([
            np.asarray(state) - base[0], desired[:-1, 3] - base_u, along.jac[at].ravel(), gap.ravel(),
            (desired[:, :3] - base).ravel(), along.h[at].ravel(), along.g[at].ravel(), base_u - base[:-1, 2]])
        nx, nu, ns = self._sizes
        found = self._solver(
            x0=0.0, p=given, lbg=self._lbg, ubg=self._ubg,
            lbx=np.concatenate([np.full(nx, -np.inf), low - base_u, np.zeros(ns)]),
            ubx=np.concatenate([np.full(nx, np.inf), high - base_u, np.full(ns, np.inf)]))
        plan = np.asarray(found["x"]).ravel()[nx : nx + nu] + base_u
        return Solution(np.clip(plan, low, high), solved=self._solver.stats()["success"])


def twin_of(controller):
    """Let ipopt solve what a new controller's own solver would; raises TypeError for a solver that has no twin."""
    if isinstance(controller, TrackingMpc):
        raise TypeError("a TrackingMpc is made with its solver")
    tracker = controller.tracker
    if isinstance(tracker, TubeMpc):
        tracker.nominal = LinearByIpopt(tracker.nominal)
        return controller
    if isinstance(tracker, LinearMpc):
        twin = LinearByIpopt(tracker)
    elif isinstance(tracker, NonlinearMpc):
        twin = by_exact_ipopt(tracker)
    elif isinstance(tracker, CasadiMpc):
        twin = by_exact_ipopt(tracker, stage_cost=tracker.stage_cost, terminal=tracker.terminal)
    else:
        raise TypeError(f"write a twin by ipopt for {type(tracker).__name__}")
    controller._fallback.tracker = controller.tracker = twin
    return controller


def tracking_by_ipopt(patch, scenario, spec, name):
    """TrackingMpc's own program, handed to ipopt as a QP."""
    options = {"nlpsol": "ipopt", "nlpsol_options": IPOPT}
    patch.setitem(tracking.SOLVERS, "nlpsol", options)
    return TrackingMpc(scenario, spec, name, "nlpsol")
