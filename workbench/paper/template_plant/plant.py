"""The plant of $name: a mass on a hardening spring with a damping that the law does not know."""

import sympy as sp

from workbench.systems.plant import Parameter, Plant

x, v, u, d = sp.symbols("x v u d", real=True)  # position (m), speed (m/s), force per mass and disturbance (m/s^2)
a, c = sp.symbols("a c", positive=True)

plant = Plant(
    "$name.mass", states=(x, v), rates=(v, u - a * v - c * x**3 + d), inputs=(u,), disturbances=(d,),
    parameters=(Parameter(a, 0.5, "1/s", known=(0.2, 0.8)), Parameter(c, 2.0, "1/(m^2 s^2)")),
    input_limits={u: (-20.0, 20.0)}, units={x: "m", v: "m/s", u: "m/s^2"})
