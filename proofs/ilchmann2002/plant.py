"""ilchmann2002: a reactor-like plant of one state, y' = a y - y^3 + b u + d."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Parameter, Plant

y, u, d = sp.symbols("y u d", real=True)
a = sp.Symbol("a", real=True)
b = sp.Symbol("b", positive=True)

plant = Plant("ilchmann2002.plant", states=(y,), rates=(a * y - y**3 + b * u + d,), inputs=(u,), disturbances=(d,),
              title="a nonlinear plant of one state", input_limits={u: (-200.0, 200.0)},
              parameters=(Parameter(a, 1.0, known=(0.0, 2.0)), Parameter(b, 2.0, known=(1.0, 3.0))))
