"""The law of $name, typed once: what is proved of it is what is simulated."""

import sympy as sp

from workbench.model.law import LawState
from workbench.systems.law import Reference, StateLaw
from workbench.systems.lyapunov import Lyapunov

from .plant import a, c, u, v, x

a_hat = sp.Symbol("a_hat", real=True)
alpha, k, gamma = sp.symbols("alpha k gamma", positive=True)
desired = Reference("x_d")  # x_d, x_d_dot, x_d_ddot

e = x - desired.value
s = v - desired.rate + alpha * e

adaptive = StateLaw(
    "$name.adaptive", title="adaptive damping", source="$name (1), (2)", references=(desired,),
    commands={u: desired.second_rate - alpha * (v - desired.rate) - k * s + a_hat * v + c * x**3},  # (1)
    states=(LawState(a_hat, rate=-gamma * s * v),),  # (2)
    parameters=(alpha, k, gamma, c))

V = s**2 / 2 + (a_hat - a) ** 2 / (2 * gamma)
lyapunov = Lyapunov("V", V, adaptive)  # held against every run by `workbench.check_paper`
