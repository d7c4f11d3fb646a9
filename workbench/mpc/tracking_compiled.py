"""The tracking MPC of `tracking.py` in a fraction of its time: compiled where no limit binds, casadi where one does."""

from __future__ import annotations

import functools
from types import ModuleType

import numpy as np

from workbench.compile.kernel import loop_module
from workbench.mpc import tracking_kernel
from workbench.mpc.tracking import TrackingMpc
from workbench.trains.scenario import ControllerSpec, Scenario


@functools.cache
def _kernel() -> ModuleType:
    return loop_module("tracking.py", (), tracking_kernel)


class CompiledTrackingMpc(TrackingMpc):
    """`TrackingMpc` with the same program: its answer without limits is the answer where it keeps them all.

    The program is convex and slack beyond the band costs more than nothing, so that no other plan is better. Where a
    limit is broken the quadratic program answers. Both agree within the tolerance of its solver.
    """

    title = "MPC, compiled"

    def __init__(self, scenario: Scenario, spec: ControllerSpec, name: str) -> None:
        super().__init__(scenario, spec, name)
        alpha, phi = self._step((0.0, 1.0), 0.0, 0.0, self._slope)
        beta, psi = self._step((0.0, 0.0), 1.0, 0.0, self._slope)
        weights = np.array([spec.parameters[f"{name}_weight"] for name in ("position", "speed", "command")])
        self._fixed = (np.array([alpha, beta, phi, psi]), weights, self._terminal, self._low, self._high,
                       float(self._band), np.zeros((self.horizon, 2)))
        self._free_plan, self._free = _kernel().free_plan, np.zeros(self.horizon)

    def _solve(self, k: int, error: tuple[float, float]) -> float:
        if not self._free_plan(k, *error, self._disturbance, *self._fixed, self._free):
            return super()._solve(k, error)
        self.counters["qp"] += 1
        self._plan = np.append(self._free, 0.0)
        return float(self._free[0])
