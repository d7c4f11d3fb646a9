"""Points as far inside as can be of where assumptions hold and a relation fails, by quadratic programming.

The least room that an inequality has there, relative to the sizes of its terms, is made as large as it can be. Where
two curved borders nearly touch, what lies between them is narrow, and damped least squares creep along it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import minimize

from workbench.proof.decide.boundary_points import Family
from workbench.proof.decide.landscape import Landscape, Numbers

DIFFERENCE, STEPS = 1e-7, 40
MOST_ROOM = 0.1  # more is not asked for


def innermost(landscape: Landscape, family: Family, break_shown: bool, starts: Numbers) -> Numbers:
    """The points with most room that are reached from each start, of shape (points, free symbols of the family)."""
    reached = [_innermost(landscape, family, break_shown, start) for start in starts]
    return np.array([point for point in reached if point is not None]).reshape(-1, starts.shape[1])


def _innermost(landscape: Landscape, family: Family, break_shown: bool, start: Numbers) -> Numbers | None:
    operators, free = landscape.operators(), family.free
    equal = [k for k, (operator, shown) in enumerate(operators) if operator == "==" and not shown]
    turns = {k: -1.0 if shown else 1.0 for k, (operator, shown) in enumerate(operators)
             if operator in (">", ">=") and (break_shown or not shown)}
    bounded, signs = list(turns), np.array(list(turns.values()))
    if not bounded:
        return None

    def margins(points: Numbers) -> tuple[Numbers, Numbers]:
        return landscape.margins(family.columns({s: points[:, i] for i, s in enumerate(free)}))

    sizes = margins(start[None])[1][0] + 1e-9
    last: dict[bytes, tuple[Numbers, Numbers]] = {}

    def looked(values: Numbers) -> tuple[Numbers, Numbers]:
        """The relative margins at a point, and their derivatives."""
        if (key := values.tobytes()) not in last:
            last.clear()
            width = DIFFERENCE * (1 + np.abs(values[:-1]))
            around = np.concatenate([values[None, :-1], values[:-1] + np.diag(width)])
            with np.errstate(all="ignore"):
                found = margins(around)[0] / sizes
                last[key] = found[0], (found[1:] - found[0]) / width[:, None]
        return last[key]

    def room(values: Numbers) -> Numbers:
        return signs * looked(values)[0][bounded] - values[-1]

    def room_slopes(values: Numbers) -> Numbers:
        return np.column_stack([(signs * looked(values)[1][:, bounded]).T, -np.ones(len(bounded))])

    constraints: list[dict[str, Any]] = [{"type": "ineq", "fun": room, "jac": room_slopes}]
    if equal:
        still = np.zeros((len(equal), 1))
        constraints.append({"type": "eq", "fun": lambda values: looked(values)[0][equal],
                            "jac": lambda values: np.hstack([looked(values)[1][:, equal].T, still])})
    first = np.append(start, min(float(np.min(signs * looked(np.append(start, 0.0))[0][bounded])), 0.0))
    if not np.isfinite(first).all():
        return None
    towards = np.append(np.zeros(len(free)), -1.0)
    try:
        with np.errstate(all="ignore"):
            answer = minimize(lambda values: -values[-1], first, jac=lambda values: towards, method="SLSQP",
                              bounds=[(None, None)] * len(free) + [(None, MOST_ROOM)], constraints=constraints,
                              options={"maxiter": STEPS, "ftol": 1e-14})
    except ValueError:  # numbers beyond what it takes
        return None
    return answer.x[:-1] if np.isfinite(answer.x).all() else None
