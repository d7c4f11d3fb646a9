"""lavretsky2009: wing rock, a roll that its own aerodynamics destabilise, p' = u + theta^T Phi(phi, p)."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Parameter, Plant

x_1, x_2, u, d = sp.symbols("x_1 x_2 u d", real=True)  # roll angle (rad), roll rate (rad/s), roll acceleration (rad/s^2)
thetas = sp.symbols("theta_1 theta_2 theta_3", real=True)
Phi = sp.Matrix([x_1, x_2, sp.Abs(x_1) * x_2])

wing = Plant(
    "lavretsky2009.wing", states=(x_1, x_2), rates=(x_2, u + (sp.Matrix(thetas).T * Phi)[0] + d), inputs=(u,),
    disturbances=(d,), title="wing rock", input_limits={u: (-20.0, 20.0)},
    parameters=tuple(Parameter(symbol, value, unit) for symbol, value, unit in zip(
        thetas, (-1.0, 0.8, -2.0), ("1/s^2", "1/s", "1/s"), strict=True)),
    units={x_1: "rad", x_2: "rad/s", u: "rad/s^2", d: "rad/s^2"})
