"""goodwin1980: a warmed tank, y' = -a y + b u, whose samples obey y(t+1) = theta_1 y(t) + theta_2 u(t) exactly."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Parameter, Plant

y, u = sp.symbols("y u", real=True)
a, b = sp.symbols("a b", positive=True)

tank = Plant("goodwin1980.tank", states=(y,), rates=(-a * y + b * u,), inputs=(u,), title="a warmed tank",
             parameters=(Parameter(a, 0.5, "1/s", known=(0.2, 1.0)), Parameter(b, 1.0, "1/s", known=(0.5, 2.0))),
             input_limits={u: (-20.0, 20.0)})
