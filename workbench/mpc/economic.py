"""Economic MPC: traction energy against time, within the limits; the desired run only says how late the train is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca

from workbench.errors import InputError, SolverError
from workbench.mpc.problem import Array, Problem
from workbench.mpc.terminal import Lqr, lqr
from workbench.mpc.transcription import CasadiMpc, StageCost, StageEnd, tracking_cost

# The programs are not convex where braking returns nothing: sqpmethod, with either of its solvers, finds no answer at
# some samples.
SOLVERS = ("ipopt", "fatrop")

# Below this force (m/s^2) driving and braking are blended, so that the cost has derivatives.
BLEND_MPS2 = 1e-2
# Where the desired run is slower, being early is worth less and less: a train that stands at its stop gains nothing.
SLOWEST_MPS = 5.0


@dataclass(frozen=True)
class Prices:
    """What a run costs: energy (1/(J/kg)), time (1/s), and the share of braking energy that is returned.

    Raises InputError for prices that are negative or a share outside 0 to 1.
    """

    energy: float = 1.0
    time: float = 1.0
    regenerated: float = 0.0

    def __post_init__(self) -> None:
        if not (0 <= self.energy < math.inf and 0 <= self.time < math.inf and 0 <= self.regenerated <= 1):
            raise InputError("", "prices", f"energy {self.energy:g} and time {self.time:g} must be finite and not "
                             f"negative, and what is regenerated, {self.regenerated:g}, be a share: correct them")


def power(force: Any, speed: Any, regenerated: float) -> Any:
    """Power drawn per unit of mass, W/kg: driving costs it all, braking returns a share; smooth."""
    driving = (force + ca.sqrt(force**2 + BLEND_MPS2**2)) / 2
    return (driving + regenerated * (force - driving)) * speed


def economic_mpc(problem: Problem, ahead: Array, prices: Prices, solver: str = "fatrop",
                 beyond: Lqr | None = None) -> CasadiMpc:
    """A solver of the economic problem.

    A stage costs its energy and the squares of the tracking problem, whose weights are to be small: they say how far
    from the desired run the train may be led by prices. The end of the horizon costs its lateness against the desired
    run, and is paid for the kinetic energy it has beyond the desired one. Raises SolverError for a solver that is not
    offered.
    """
    if solver not in SOLVERS:
        raise SolverError(f"no economic MPC with '{solver}': choose one of {', '.join(SOLVERS)}")
    after = beyond or lqr(problem)
    stage, end = _known_costs(problem, prices) if beyond is None else costs(problem, prices, after)
    return CasadiMpc(problem, ahead, solver, stage, end, after)


def costs(problem: Problem, prices: Prices, after: Lqr) -> tuple[StageCost, StageEnd]:
    """What a stage and the end of the horizon cost."""
    tracking = tracking_cost(problem)

    def stage(x: Any, u: Any, row: Any) -> Any:
        force = u if problem.actuator == "direct" else x[2]
        return prices.energy * problem.period_s * power(force, x[1], prices.regenerated) + tracking(x, u, row)

    def end(x: Any, row: Any) -> Any:
        late_s = (row[0] - x[0]) * row[1] / (row[1] ** 2 + SLOWEST_MPS**2)
        kinetic = (x[1] ** 2 - row[1] ** 2) / 2
        error = x - row[:3]
        return prices.time * late_s - prices.energy * kinetic + ca.bilin(after.cost, error, error)

    return stage, end


@lru_cache(maxsize=8)
def _known_costs(problem: Problem, prices: Prices) -> tuple[StageCost, StageEnd]:
    """The same functions for the same prices, so that their program is known again."""
    return costs(problem, prices, lqr(problem))
