"""What a solver answers: a plan, whether it may be used, and what it took."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from workbench.mpc.problem import Array
from workbench.mpc.terminal import Lqr


@dataclass(frozen=True)
class Solution:
    """plan: commands of the horizon (m/s^2), shape (N,). solved: whether they may be used.

    programs: quadratic programs solved; interior: those of them by the interior point method; passes: passes of
    Riccati's recursion in all; why: the solver's words where it failed, or answered less than it should.
    """

    plan: Array
    solved: bool
    programs: int = 1
    interior: int = 0
    passes: int = 0
    why: str = ""


class Tracker(Protocol):
    """A solver of a problem along a run; it keeps what it learned from one sample to warm-start the next."""

    horizon: int
    lqr: Lqr

    def solve(self, sample: int, state: Array, disturbance: float = 0.0) -> Solution:
        """The plan from a state (p, v, F) at a sample, under a constant disturbance in m/s^2 beside what is told."""
        ...

    def forget(self) -> None:
        """Drop the warm start."""
        ...
