"""How the force of a train is shared by its cars: the split with the least squares of coupler forces.

The couplers carry the sums of what stands before them: behind car k the force is P_k = S_k + q_k, where S_k is the sum
of the first k commands and q_k that of their resistances and inertia. For a total S_n and limits of each car the rule

    minimise sum of P_k^2 over k < n   with   S_k - S_(k-1) between the limits of car k

is strictly convex in (S_1, ..., S_(n-1)), so there is one answer, and it is a piecewise linear, continuous function of
the total, the limits and q. Dynamic programming along the train finds it exactly: the cost of the first k cars is a
convex function of S_k whose slope is piecewise linear; adding a car cuts that slope where it is zero and moves the
parts apart by the car's limits. Beside it stands the plain rule that every device gives the same share of its limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from workbench.compile.package_kernels import compiled
from workbench.errors import InputError
from workbench.optimal.cars.car_train import CarLimits
from workbench.optimal.course import Array

Rule = Literal["least_coupler_forces", "equal_shares"]
RULES: tuple[Rule, ...] = ("least_coupler_forces", "equal_shares")


@dataclass(frozen=True)
class Shares:
    """What each car does, N, shape (times, cars): force_n, traction positive; electric_n <= 0, the part that returns.

    excess: shape (times,), by which share the whole asks for more than the cars give together; they give it anyway.
    """

    force_n: Array
    electric_n: Array
    excess: Array


def share_forces(rule: Rule, total_n: Array, limits: CarLimits, ahead_n: Array) -> Shares:
    """The cars' forces for a total of shape (times,); ahead_n: q_k above, shape (times, cars).

    The energy is that of the whole: no car brakes while another drives, and friction begins where all electric brakes
    are at their limit. Raises InputError for an unknown rule.
    """
    if rule not in RULES:
        raise InputError("", "rule", f"there is no rule '{rule}': choose one of {', '.join(RULES)}")
    pull, electric, friction = limits.traction_n, limits.electric_n, limits.friction_n
    most, regain, rub = (limit.sum(axis=1) for limit in (pull, electric, friction))
    over = np.maximum(total_n / np.maximum(most, 1e-9), -total_n / np.maximum(regain + rub, 1e-9))
    scale = np.maximum(over, 1.0)[:, None]
    drives, returns = (total_n >= 0)[:, None], (-total_n <= regain)[:, None]
    high = scale * np.where(drives, pull, np.where(returns, 0.0, -electric))
    low = scale * np.where(drives, 0.0, np.where(returns, -electric, -electric - friction))
    if rule == "equal_shares":
        room = (high - low).sum(axis=1)
        part = (total_n - low.sum(axis=1)) / np.where(room > 0, room, 1.0)
        force = low + part[:, None] * (high - low)
    else:
        force = _splits(total_n, low, high, ahead_n)
    return Shares(force, np.maximum(np.minimum(force, 0.0), -scale * electric), scale[:, 0] - 1)


@compiled()
def _least(x: Array, d: Array, points: int) -> tuple[float, int]:
    """Where a cost of slope d over x is least, and the first point from which it rises."""
    cut = 0
    while cut < points and d[cut] < 0.0:
        cut += 1
    if cut == 0:
        return x[0], cut
    if cut == points:
        return x[points - 1], cut
    return x[cut - 1] - d[cut - 1] * (x[cut] - x[cut - 1]) / (d[cut] - d[cut - 1]), cut


@compiled()
def _splits(total: Array, low: Array, high: Array, q: Array) -> Array:
    """The rule's forces, shape (times, cars)."""
    found, n = np.empty_like(low), low.shape[1]
    # Points (S, slope) of the cost of the cars so far, and where it is least.
    x, d, best = np.empty(2 * n + 2), np.empty(2 * n + 2), np.empty(n)
    for row in range(len(total)):
        x[0], d[0], points = 0.0, 0.0, 1
        for k in range(n - 1):
            best[k], cut = _least(x, d, points)
            for i in range(points - 1, cut - 1, -1):
                x[i + 2], d[i + 2] = x[i] + high[row, k], d[i]
            for i in range(cut):
                x[i] += low[row, k]
            x[cut], d[cut] = best[k] + low[row, k], 0.0
            x[cut + 1], d[cut + 1] = best[k] + high[row, k], 0.0
            points += 2
            for i in range(points):
                d[i] += 2.0 * (x[i] + q[row, k])
        best[n - 1] = _least(x, d, points)[0]
        reached = total[row]
        for k in range(n - 1, 0, -1):
            before = min(max(best[k], reached - high[row, k]), reached - low[row, k])
            found[row, k] = reached - before
            reached = before
        found[row, 0] = reached
    return found
