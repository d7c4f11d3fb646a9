"""The plant moved by a solver of scipy, for stiff plants: same steps, inputs and signals as the compiled loop's."""

from __future__ import annotations

import warnings
from types import ModuleType

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from workbench.simulate.plants.arrays import Arrays
from workbench.simulate.plants.plant_loop import DIVERGED, OUTSIDE, RUNNING
from workbench.systems.setting import Setting

NAMES = {"radau": "Radau", "bdf": "BDF", "lsoda": "LSODA"}
RELATIVE, ABSOLUTE = 1e-8, 1e-10
SOLVER_FAILED = 5
MOST_CALLS = 100_000  # of the rates in a step: where a state grows beyond every bound LSODA takes steps without end


class _EndlessError(ValueError):
    """More calls of the rates than MOST_CALLS."""


def advance_by_solver(module: ModuleType, setting: Setting, first: int, count: int, a: Arrays) -> tuple[int, int]:
    """Move the plant by so many steps; (status, steps done), as the compiled `advance`.

    Within a step the solver takes as many of its own as it needs; it starts anew at each step, because inputs may jump
    there, so a stiff plant wants steps as long as its sampling.
    """
    h, n = setting.step_s, len(setting.plant.states)
    lags = np.array([setting.lag_s.get(str(symbol), 0.0) for symbol in setting.plant.inputs])
    for k in range(first, first + count):
        t = k * h
        module.signal_values(t, t, a.table, a.pieces, a.s)
        a.ring[k % len(a.ring)] = a.wanted
        held = np.array([a.ring[(k - delay) % len(a.ring), i] for i, delay in enumerate(a.delays)])
        a.u[:] = np.where(lags > 0, a.u, held)
        if k % a.log_every == 0:
            module.record(t, n, a.x, a.u, a.wanted, a.s, a.told, a.log, k // a.log_every)
        if len(a.extremes):
            module.add_extremes(t, a.x, a.u, a.s, a.p, a.extremes, a.values)

        def input_at(at: float, held: NDArray[np.float64] = held, t: float = t) -> NDArray[np.float64]:
            fade = np.where(lags > 0, np.exp(-(at - t) / np.where(lags > 0, lags, 1.0)), 0.0)
            return held + fade * (a.u - held)

        left = [MOST_CALLS]

        def rates(at: float, x: NDArray[np.float64], t: float = t, input_at: object = input_at,
                  left: list[int] = left) -> object:
            left[0] -= 1
            if left[0] < 0:
                raise _EndlessError
            module.signal_values(at, t, a.table, a.pieces, a.s_middle)
            return module.plant_rates(at, *x, input_at(at), a.s_middle, a.p)  # type: ignore[operator]

        try:
            with np.errstate(all="ignore"), warnings.catch_warnings():  # what it tries on its way is no message
                warnings.simplefilter("ignore")
                found = solve_ivp(rates, (t, t + h), a.x, method=NAMES[setting.integrator], rtol=RELATIVE,
                                  atol=ABSOLUTE)
        except ValueError:  # scipy's linear algebra takes no number that is not finite
            return SOLVER_FAILED, k - first
        if not found.success:
            return SOLVER_FAILED, k - first
        a.x[:] = found.y[:, -1]
        a.u[:] = input_at(t + h)
        if not np.all(np.abs(a.x[:n]) < 1e12):
            return DIVERGED, k + 1 - first
        if not module.plant_margin(t + h, a.x, a.u, a.s, a.p) > 0.0:
            return OUTSIDE, k + 1 - first
    return RUNNING, count
