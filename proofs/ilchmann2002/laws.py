"""ilchmann2002: the funnel controller, and a constant gain for comparison."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import time
from workbench.systems.law import Reference, StateLaw

from .plant import u, y

desired = Reference("y_d")
start, final, rate = sp.symbols("psi_0 psi_inf kappa", positive=True)  # the funnel: its width at first, at last, how fast
gain = sp.Symbol("k", positive=True)

e = y - desired.value
psi = (start - final) * sp.exp(-rate * time) + final
phi = 1 / psi

funnel = StateLaw(
    "ilchmann2002.funnel", title="funnel controller", information="the output alone", source="u = -e / (1 - phi^2 e^2)",
    references=(desired,), commands={u: -e / (1 - phi**2 * e**2)}, parameters=(start, final, rate),
    domain=(1 - phi**2 * e**2,))

constant = StateLaw(
    "ilchmann2002.constant", title="constant gain", information="the output alone", source="u = -k e",
    references=(desired,), commands={u: -gain * e}, parameters=(gain,))
