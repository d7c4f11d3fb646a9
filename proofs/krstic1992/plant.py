"""krstic1992: a chain of three states with an unknown parameter in the first, x_1' = x_2 + theta phi(x_1)."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Parameter, Plant

x_1, x_2, x_3, u, d = sp.symbols("x_1 x_2 x_3 u d", real=True)
theta = sp.Symbol("theta", real=True)
# phi(x_1) and its derivatives by x_1.
phi, phi_1, phi_2, phi_3 = sp.symbols("phi phi_1 phi_2 phi_3", real=True)
RATES = (x_2 + theta * phi, x_3 + d, u)
SQUARE = {phi: x_1**2, phi_1: 2 * x_1, phi_2: sp.Integer(2), phi_3: sp.Integer(0)}

chain = Plant("krstic1992.chain", states=(x_1, x_2, x_3), rates=tuple(rate.xreplace(SQUARE) for rate in RATES), inputs=(u,),
              disturbances=(d,), title="a chain of three states with an unknown parameter in the first",
              parameters=(Parameter(theta, 1.0, known=(0.5, 1.5)),), input_limits={u: (-200.0, 200.0)})
