"""The plant moved by a solver of scipy, for stiff plants: same steps, inputs and signals as the compiled loop's."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from workbench.simulate.plants.arrays import Arrays, Compiled
from workbench.simulate.plants.plant_loop import DIVERGED, OUTSIDE, RUNNING
from workbench.systems.setting import Setting

NAMES = {"radau": "Radau", "bdf": "BDF", "lsoda": "LSODA"}
RELATIVE, ABSOLUTE = 1e-8, 1e-10
SOLVER_FAILED = 5
MOST_CALLS = 100_000  # of the rates in a step: where a state grows beyond every bound LSODA takes steps without end


class _EndlessError(ValueError):
    """More calls of the rates than MOST_CALLS."""


def advance_by_solver(found: Compiled, setting: Setting, first: int, count: int, a: Arrays) -> tuple[int, int]:
    """Move the plant by so many steps; (status, steps done), as the compiled `advance`.

    Within a step the solver takes as many of its own as it needs; it starts anew at each step, because inputs may jump
    there, so a stiff plant wants steps as long as its sampling.
    """
    h, n, loop, plant = setting.step_s, len(setting.plant.states), found.loop, found.plant
    lags = np.array([setting.lag_s.get(str(symbol), 0.0) for symbol in setting.plant.inputs])
    for k in range(first, first + count):
        t = k * h
        loop.signal_values(t, t, a.table, a.pieces, a.s)
        a.ring[k % len(a.ring)] = a.wanted
        held = np.array([a.ring[(k - delay) % len(a.ring), i] for i, delay in enumerate(a.delays)])
        a.u[:] = np.where(lags > 0, a.u, held)
        if k % a.log_every == 0:
            loop.record(t, n, a.x, a.u, a.wanted, a.s, a.told, a.log, k // a.log_every)
        if len(a.extremes):
            loop.add_extremes(plant, t, a.x, a.u, a.s, a.p, a.extremes, a.values)

        def input_at(at: float, held: NDArray[np.float64] = held, t: float = t) -> NDArray[np.float64]:
            fade = np.where(lags > 0, np.exp(-(at - t) / np.where(lags > 0, lags, 1.0)), 0.0)
            return held + fade * (a.u - held)

        left = [MOST_CALLS]

        def rates(at: float, x: NDArray[np.float64], t: float = t, input_at: object = input_at,
                  left: list[int] = left) -> object:
            left[0] -= 1
            if left[0] < 0:
                raise _EndlessError
            loop.signal_values(at, t, a.table, a.pieces, a.s_middle)
            out, u = np.zeros(len(x)), input_at(at)  # type: ignore[operator]
            x = np.ascontiguousarray(x)  # a plant is given addresses, which have no strides
            loop.asked(plant, loop.RATES, at, x, u, a.s_middle, a.p, out)
            return out

        try:
            with np.errstate(all="ignore"), warnings.catch_warnings():  # what it tries on its way is no message
                warnings.simplefilter("ignore")
                done = solve_ivp(rates, (t, t + h), a.x, method=NAMES[setting.integrator], rtol=RELATIVE,
                                  atol=ABSOLUTE)
        except ValueError:  # scipy's linear algebra takes no number that is not finite
            return SOLVER_FAILED, k - first
        if not done.success:
            return SOLVER_FAILED, k - first
        a.x[:] = done.y[:, -1]
        a.u[:] = input_at(t + h)
        if not np.all(np.abs(a.x[:n]) < 1e12):
            return DIVERGED, k + 1 - first
        if not loop.asked(plant, loop.MARGIN, t + h, a.x, a.u, a.s, a.p, a.x) > 0.0:
            return OUTSIDE, k + 1 - first
    return RUNNING, count
