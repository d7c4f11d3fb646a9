"""goodwin1980: the projection algorithm with the command that it makes certain, sample by sample."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import LawState, period
from workbench.systems.law import Reference, StateLaw

from .plant import u, y

desired = Reference("y_d")
gain, guard, least = sp.symbols("alpha c theta_min", positive=True)  # step, guard of the division, least input gain
hats = sp.symbols("theta_1_hat theta_2_hat", real=True)
y_1, u_1 = sp.symbols("y_1 u_1", real=True)  # the output and the command of the sample before


def moved(estimate: sp.Expr, value: sp.Expr, prediction_error: sp.Expr, square: sp.Expr) -> sp.Expr:
    """An estimate one step later: alpha phi e / (c + phi^T phi) more."""
    return estimate + gain * value * prediction_error / (guard + square)


regressor = (y_1, u_1)
square = y_1**2 + u_1**2
prediction_error = y - hats[0] * y_1 - hats[1] * u_1
new = tuple(moved(hat, value, prediction_error, square) for hat, value in zip(hats, regressor, strict=True))
input_gain = sp.Max(new[1], least)  # the estimate by which is divided stays away from zero
ahead = desired.value + period * desired.rate  # where the output shall be at the next sample
command = (ahead - new[0] * y) / input_gain

projection = StateLaw(
    "goodwin1980.projection", title="projection algorithm", information="the output alone, plant unknown",
    source="the algorithm with a lower bound on the input's gain", references=(desired,), commands={u: command},
    states=(LawState(hats[0], update=new[0]), LawState(hats[1], update=input_gain), LawState(y_1, update=y),
            LawState(u_1, update=command)), parameters=(gain, guard, least), initial={hats[1]: 1.0})

frozen = StateLaw(
    "goodwin1980.frozen", title="the same without adaptation", information="the output alone, plant unknown",
    source="the command of the estimates at the start", references=(desired,), commands={u: ahead / least},
    parameters=(least,))
