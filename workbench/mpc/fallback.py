"""What answers when the solver does not: the last feasible plan, shifted, then the LQR, then what the curve needs."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable

import numpy as np

from workbench.mpc.problem import Array
from workbench.mpc.solution import Solution, Tracker
from workbench.mpc.terminal import Lqr

# What a run counts. A solution that came too late, as one that failed, is answered by the others.
COUNTERS = ("qp", "qp_failed", "unconverged", "late", "shifted_plan", "lqr", "feedforward", "bad_measurement")
MEANING = {
    "qp": "samples at which the solver was asked",
    "qp_failed": "it answered no plan that may be used",
    "unconverged": "its plan keeps model and limits, but the iteration had not come to rest",
    "late": "its plan came after the deadline",
    "shifted_plan": "the last feasible plan answered, as many samples on as it is old",
    "lqr": "no plan was left, so the LQR answered, within the limits",
    "feedforward": "no plan was left and nothing was measured, so what the curve needs answered",
    "bad_measurement": "the measurement was no number or no train's",
}


class Fallback:
    """A solver with a deadline; `command` never raises and never answers NaN.

    deadline_s: seconds a solution may take; infinite for none. A deadline makes a run depend on the machine, so that
    it does not repeat bit for bit. trouble: how often the solver said what.
    """

    def __init__(self, tracker: Tracker, beyond: Lqr, ahead: Array, limits: tuple[float, float],
                 deadline_s: float = math.inf, clock: Callable[[], float] = time.perf_counter) -> None:
        self.tracker, self.lqr, self.ahead = tracker, beyond, ahead
        self._low, self._high = limits
        self._deadline_s, self._clock = deadline_s, clock
        self.counters = dict.fromkeys(COUNTERS, 0)
        self.trouble: Counter[str] = Counter()
        self._plan: Array | None = None
        self._planned_at = 0

    def command(self, sample: int, state: Array | None, disturbance: float = 0.0) -> float:
        """The command (m/s^2) at a sample; state (p, v, F), or None where nothing was measured."""
        if state is None:
            self.counters["bad_measurement"] += 1
        else:
            plan = self._solve(sample, state, disturbance)
            if plan is not None:
                self._plan, self._planned_at = plan, sample
                return self._within(float(plan[0]))
        age = sample - self._planned_at
        if self._plan is not None and 0 <= age < len(self._plan):
            self.counters["shifted_plan"] += 1
            return self._within(float(self._plan[age]))
        desired = self.ahead[min(sample, len(self.ahead) - 1)]
        feedforward = float(desired[3]) - disturbance
        if state is None:
            self.counters["feedforward"] += 1
            return self._within(feedforward)
        self.counters["lqr"] += 1
        gain, off = self.lqr.gain.tolist(), (state - desired[:3]).tolist()
        pull = gain[0] * off[0] + gain[1] * off[1] + gain[2] * (off[2] + disturbance)
        return self._within(feedforward - pull)

    def explain(self) -> list[str]:
        """A line for everything that went otherwise than planned."""
        lines = [f"{name}: {self.counters[name]} ({MEANING[name]})" for name in COUNTERS[1:] if self.counters[name]]
        return lines + [f"the solver said {count} times: {why}" for why, count in self.trouble.most_common()]

    def _solve(self, sample: int, state: Array, disturbance: float) -> Array | None:
        self.counters["qp"] += 1
        before = self._clock()
        try:
            solution = self.tracker.solve(sample, state, disturbance)
        except RuntimeError as trouble:  # what casadi raises where a solver gives up in its own way
            solution = Solution(np.full(1, math.nan), solved=False, why=str(trouble).splitlines()[-1])
        late = self._clock() - before > self._deadline_s
        if solution.solved and np.isfinite(solution.plan).all():
            if not late:
                if solution.why:
                    self.counters["unconverged"] += 1
                    self.trouble[solution.why] += 1
                return solution.plan
            self.counters["late"] += 1
            self.trouble["a solution after the deadline"] += 1
            return None
        self.counters["qp_failed"] += 1
        self.trouble[solution.why or "no reason"] += 1
        return None

    def _within(self, command: float) -> float:
        if not math.isfinite(command):
            command = 0.0
        return min(max(command, self._low), self._high)
