"""moreno2012: a sliding variable of relative degree one under a perturbation of bounded rate."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Plant

x_1, u, phi = sp.symbols("x_1 u phi", real=True)  # sliding variable, its input, what perturbs it

sliding = Plant("moreno2012.sliding", states=(x_1,), rates=(u + phi,), inputs=(u,), disturbances=(phi,),
                title="a sliding variable with a perturbed rate", input_limits={u: (-20.0, 20.0)})
