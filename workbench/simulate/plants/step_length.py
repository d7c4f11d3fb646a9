"""Whether a run's integration step was short enough for the plant where the run went: a stable run may be wrong too."""

from __future__ import annotations

import numpy as np
import sympy as sp

from workbench.compile.vector_code import numeric_vector
from workbench.simulate.plants.run import PlantRun
from workbench.systems.setting import Setting

POINTS = 200  # of a run at which the plant is linearised


def shortest_time(setting: Setting, run: PlantRun) -> tuple[float, float] | None:
    """The shortest time constant (s) that the plant had along a run, and when; None where nothing is known of it.

    One over the largest pole of the plant linearised at what was logged, jumps left out. A step longer than that is too
    long: the rule of Runge and Kutta then gains or loses some per cent a step.
    """
    plant = setting.plant
    slopes = [sp.diff(rate, x).replace(sp.DiracDelta, lambda *_: sp.Integer(0)) for rate in plant.rates
              for x in plant.states]
    if not len(run.log) or any(one.has(sp.Derivative, sp.Subs) for one in slopes):
        return None
    logged = (*plant.states, *plant.inputs, *plant.disturbances)
    at = numeric_vector((*logged, *plant.parameter_symbols), slopes)
    columns = [run.column("t_s"), *(run.column(str(one)) for one in logged)]
    constants = [setting.parameters[str(one)] for one in plant.parameter_symbols]
    n, found = len(plant.states), (np.inf, 0.0)
    for row in np.unique(np.linspace(0, len(run.log) - 1, POINTS).astype(int)):
        try:
            values = np.array(at(*(column[row] for column in columns), *constants), dtype=float)
        except (ArithmeticError, ValueError):  # beyond a function's domain
            continue
        if np.isfinite(values).all() and (pole := float(abs(np.linalg.eigvals(values.reshape(n, n))).max())) > 0:
            found = min(found, (1 / pole, float(columns[0][row])))
    return found if np.isfinite(found[0]) else None
