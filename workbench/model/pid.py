"""PID on the position error, the textbook law that others are compared with."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import ControlLaw, LawState, desired_position, desired_speed, position, speed

K_p, K_i, K_d = sp.symbols("K_p K_i K_d", nonnegative=True)
error_integral = sp.Symbol("eta_e", real=True)

error = desired_position - position

pid = ControlLaw(
    id="pid",
    title="PID",
    source="textbook PID on the position error, derivative on the measured speed error",
    information="full state, model unknown",
    command=K_p * error + K_i * error_integral + K_d * (desired_speed - speed),
    states=(LawState(error_integral, rate=error),),
    parameters=(K_p, K_i, K_d),
)
