"""The plant and the control law of $name, typed once: what is proved of them is what is simulated."""

import sympy as sp

from workbench.model.law import (
    ControlLaw,
    LawState,
    desired_acceleration,
    desired_position,
    desired_speed,
    position,
    speed,
)

u, d, f = sp.symbols("u d f", real=True)  # command, unknown constant resistance, disturbance, all in m/s^2
d_hat = sp.Symbol("d_hat", real=True)
alpha, k, gamma = sp.symbols("alpha k gamma", positive=True)

# Plant and desired curve. The simulated train resists with a + b v + c v^2 and meets slopes: more than is proved here.
plant = {position: speed, speed: u - d + f, desired_position: desired_speed, desired_speed: desired_acceleration}

e = position - desired_position
s = speed - desired_speed + alpha * e

adaptive_pd = ControlLaw(
    id="$name.adaptive_pd", title="adaptive PD", source="$name (1), (2)", information="full state, model unknown",
    command=desired_acceleration - alpha * (speed - desired_speed) - k * s + d_hat,  # (1)
    states=(LawState(d_hat, rate=-gamma * s),),  # (2)
    parameters=(alpha, k, gamma), errors={"e": e, "s": s})

V = s**2 / 2 + (d_hat - d) ** 2 / (2 * gamma)
