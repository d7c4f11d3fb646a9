"""What lies ahead of a train, a row a sample: the desired state, the command it needs, speed limit and disturbance."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from workbench.compile.kernel import numeric
from workbench.model.desired_curve import DesiredCurve
from workbench.mpc.problem import Array, Problem
from workbench.trains.resistance import davis_resistance
from workbench.trains.track import ResistanceTable, SpeedSection
from workbench.trains.train import a_star, b_star, c_star, x_2

COLUMNS = ("p_m", "v_mps", "F_mps2", "u_mps2", "speed_limit_mps", "f_mps2")
# Davis resistance per unit of mass of (v, a, b, c).
resistance = numeric((x_2, a_star, b_star, c_star), davis_resistance(x_2, a_star, b_star, c_star))


def preview(problem: Problem, curve: DesiredCurve, duration_s: float, speed_limit_mps: float = math.inf,
            line: ResistanceTable | None = None, limits: Sequence[SpeedSection] = (),
            late_s: float = 0.0, learned: Array | None = None) -> Array:
    """Rows (COLUMNS) for every sample of a run of duration_s, and of the horizon beyond it.

    line: the line's force (N/kg), where the controller is told it; met at the desired position. The force is what the
    model needs to stay on the curve, and the command what makes it through the actuator. limits: of the speed along
    the line, met at the desired position too. late_s: what lies ahead of commands that act so much after their sample.
    learned: further pushes (m/s^2), the mean over each sample, of the train where it is then.
    """
    steps = math.ceil(duration_s / problem.period_s) + problem.horizon + 2
    position, speed, acceleration = curve.at(np.arange(steps + 1, dtype=np.float64) * problem.period_s + late_s)
    told = np.zeros(steps + 1)
    if line is not None:
        told = -line.at(position)
    if learned is not None:
        samples = np.arange(len(learned), dtype=np.float64)
        told = told + np.interp(np.arange(steps + 1) + late_s / problem.period_s, samples, learned)
    needed = acceleration + resistance(speed, *problem.davis) - told
    if problem.actuator == "lag":
        kept = math.exp(-problem.period_s / problem.lag_s)
        force, command = needed, (np.append(needed[1:], needed[-1]) - kept * needed) / (1 - kept)
    else:
        force, command = np.concatenate((needed[:1], needed[:-1])), needed
    allowed = np.full(steps + 1, speed_limit_mps)
    for limit in limits:
        allowed[(position >= limit.start_m) & (position <= limit.end_m)] = limit.speed_mps
    rows = np.stack((position, speed, force, command, allowed, told), axis=1)
    return np.ascontiguousarray(rows[:steps])
