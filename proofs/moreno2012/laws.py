"""moreno2012: the super-twisting law, and a linear law with an integrator for comparison."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import LawState
from workbench.systems.law import StateLaw

from .plant import u, x_1

k_1, k_2 = sp.symbols("k_1 k_2", positive=True)
w = sp.Symbol("w", real=True)  # the integral term; with the perturbation it is the algorithm's x_2
root = sp.sqrt(sp.Abs(x_1)) * sp.sign(x_1)

super_twisting = StateLaw(
    "moreno2012.super_twisting", title="super-twisting", information="the sliding variable alone",
    source="the algorithm of Levant 1993", commands={u: -k_1 * root + w}, states=(LawState(w, rate=-k_2 * sp.sign(x_1)),),
    parameters=(k_1, k_2))

linear = StateLaw(
    "moreno2012.linear", title="linear with integrator", information="the sliding variable alone",
    source="the same with x_1 in place of both nonlinear terms", commands={u: -k_1 * x_1 + w},
    states=(LawState(w, rate=-k_2 * x_1),), parameters=(k_1, k_2))
