"""How large a disturbance trains and lines within stated bounds can be: what a tube's bound W has to cover.

w is what the nominal model lacks: true acceleration less the model's, at the same speed and command. For a train of
mu = nominal / true mass, resistance coefficients of factors f, and a line of factor r,

    w = (mu h - 1) u + mu F_failed - sum_i (mu f_i - 1) c_i v^i - r line(p) - gust,

h the share of the motors that work. It is linear in each of these numbers for the others fixed, and monotone in v >= 0
where all f are alike, so that its extremes are at corners.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np

from workbench.errors import InputError
from workbench.mpc.preview import resistance
from workbench.mpc.problem import Array, Problem
from workbench.mpc.tube import LARGEST_MPS2, tube
from workbench.trains.track import ResistanceTable

MOST_ROUNDS = 100
# A round of the search goes farther by this share, so that it ends, at most so much above the least bound.
FARTHER = 1 + 1e-3


@dataclass(frozen=True)
class Unknown:
    """What a tube is not told.

    line: nominal resistance of the line, N/kg; spread: of mass, resistance and line, each from 1 - spread to
    1 + spread, below 1; gust_mps2: largest further push; failed_share of the motors give failed_mps2 in all (of nominal
    mass) instead of following, from some time on.
    """

    line: ResistanceTable
    spread: float = 0.0
    gust_mps2: float = 0.0
    failed_share: float = 0.0
    failed_mps2: float = 0.0

    def __post_init__(self) -> None:
        if not (0 <= self.spread < 1 and 0 <= self.failed_share < 1 and 0 <= self.gust_mps2 < math.inf
                and math.isfinite(self.failed_mps2)):
            raise InputError("", "unknown", f"spread {self.spread:g} and share {self.failed_share:g} must be from 0 to "
                             f"below 1, pushes {self.gust_mps2:g} and {self.failed_mps2:g} finite: correct them")


def _line_between(line: ResistanceTable, low_m: Array, high_m: Array) -> tuple[Array, Array]:
    """Least and largest resistance of the line from low_m to high_m, a row each; its end values hold beyond it."""
    ends = line.at(low_m), line.at(high_m)
    least, most = np.minimum(*ends), np.maximum(*ends)
    for place, force in zip(line.position_m, line.specific_force, strict=True):
        met = (low_m <= place) & (place <= high_m)
        least[met], most[met] = np.minimum(least[met], force), np.maximum(most[met], force)
    return least, most


def largest_disturbance(problem: Problem, ahead: Array, unknown: Unknown, position_m: float = 0.0,
                        speed_mps: float = 0.0, command_mps2: float = 0.0) -> float:
    """Largest |w| (m/s^2) of any train within `unknown` whose errors from the run `ahead` are at most these."""
    now, after = ahead[:-1], ahead[1:]
    least, most = _line_between(unknown.line, now[:, 0] - position_m, after[:, 0] + position_m)
    speeds = (np.minimum(now[:, 1], after[:, 1]) - speed_mps, np.maximum(now[:, 1], after[:, 1]) + speed_mps)
    commands = (now[:, 3] - command_mps2, now[:, 3] + command_mps2)
    factors = (1 - unknown.spread, 1 + unknown.spread)
    motors = {(1.0, 0.0), (1 - unknown.failed_share, unknown.failed_mps2)}
    found = 0.0
    for mass, of_resistance, of_line, line, v, u, (healthy, failed) in product(
            factors, factors, factors, (least, most), speeds, commands, motors):
        mu = 1 / mass
        resisted = (mu * of_resistance - 1) * resistance(v, *problem.davis)
        w = (mu * healthy - 1) * u + mu * failed - resisted - of_line * line
        found = max(found, float(np.abs(w).max()))
    return found + unknown.gust_mps2


def needed_bound(problem: Problem, ahead: Array, unknown: Unknown) -> float:
    """A W (m/s^2) that covers every train within `unknown` while it stays in the tube of W; inf without one.

    The disturbance depends on the errors, since a heavier train answers the feedback's command by less, and the errors
    on the disturbance: their smallest common answer is found from below, to some thousandths.
    """
    bound = FARTHER * max(largest_disturbance(problem, ahead, unknown), 1e-6)
    for _ in range(MOST_ROUNDS):
        if not bound <= LARGEST_MPS2:
            break
        around = tube(problem, ahead, bound, problem.band_m)
        if not math.isfinite(around.position_m):
            break
        wider = largest_disturbance(problem, ahead, unknown, around.position_m, around.speed_mps, around.command_mps2)
        if wider <= bound:
            return bound
        bound = FARTHER * wider
    return math.inf


def largest_bound(problem: Problem, ahead: Array, start_m: float = 0.0) -> float:
    """The largest W (m/s^2) for which all premises of `tube` hold, to a thousandth of itself; 0 without one."""
    low, high = 0.0, LARGEST_MPS2
    while high - low > 1e-3 * high and high > 1e-6:
        middle = (low + high) / 2
        holds = tube(problem, ahead, middle, problem.band_m, start_m).holds
        low, high = (middle, high) if holds else (low, middle)
    return low
