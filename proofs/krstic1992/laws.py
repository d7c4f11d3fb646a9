"""krstic1992: the stabilising functions, the tuning functions and the law, for every phi and for the simulated one.

Step by step, for the regulation of x_1 to zero, with w_i = the regressor of z_i:
z_1 = x_1, z_2 = x_2 - alpha_1, z_3 = x_3 - alpha_2, theta_hat' = tau_3.
"""

from __future__ import annotations

import sympy as sp

from workbench.model.law import LawState
from workbench.systems.law import StateLaw
from workbench.systems.lyapunov import Lyapunov

from .plant import SQUARE, phi, phi_1, phi_2, theta, u, x_1, x_2, x_3

c_1, c_2, c_3, gamma = sp.symbols("c_1 c_2 c_3 gamma", positive=True)
theta_hat = sp.Symbol("theta_hat", real=True)


def by_x_1(expr: sp.Expr) -> sp.Expr:
    """The derivative by x_1, through phi and its derivatives too."""
    return sp.diff(expr, x_1) + sp.diff(expr, phi) * phi_1 + sp.diff(expr, phi_1) * phi_2


z_1 = x_1
alpha_1 = -c_1 * z_1 - theta_hat * phi
tau_1 = gamma * z_1 * phi

z_2 = x_2 - alpha_1
w_2 = -by_x_1(alpha_1) * phi
tau_2 = tau_1 + gamma * z_2 * w_2
alpha_2 = (-z_1 - c_2 * z_2 + by_x_1(alpha_1) * (x_2 + theta_hat * phi) + sp.diff(alpha_1, theta_hat) * tau_2)

z_3 = x_3 - alpha_2
w_3 = -by_x_1(alpha_2) * phi
tau_3 = tau_2 + gamma * z_3 * w_3
# What makes up for step 2, which counted on the adaptation tau_2 and gets tau_3.
compensation = z_2 * sp.diff(alpha_1, theta_hat) * gamma * w_3
certain = (-z_2 - c_3 * z_3 + by_x_1(alpha_2) * (x_2 + theta_hat * phi) + sp.diff(alpha_2, x_2) * x_3
           + sp.diff(alpha_2, theta_hat) * tau_3)
command = certain + compensation

z = (z_1, z_2, z_3)
V = sum((one**2 for one in z), sp.Integer(0)) / 2 + (theta - theta_hat) ** 2 / (2 * gamma)

GAINS = (c_1, c_2, c_3, gamma)


def of_square(expr: sp.Expr) -> sp.Expr:
    """The expression for phi(x_1) = x_1^2."""
    return expr.xreplace(SQUARE)


tuning_functions = StateLaw(
    "krstic1992.tuning_functions", title="tuning functions", information="full state, parameter unknown",
    source="the design in three steps", commands={u: of_square(command)},
    states=(LawState(theta_hat, rate=of_square(tau_3)),), parameters=GAINS)

uncompensated = StateLaw(
    "krstic1992.uncompensated", title="the same without compensation", information="full state, parameter unknown",
    source="the law without its last term", commands={u: of_square(certain)},
    states=(LawState(theta_hat, rate=of_square(tau_3)),), parameters=GAINS)

frozen = StateLaw(
    "krstic1992.frozen", title="the same without adaptation", information="full state, parameter unknown",
    source="backstepping with the estimate at zero", parameters=GAINS,
    commands={u: of_square(command.xreplace({theta_hat: sp.Integer(0)}))})

lyapunov = Lyapunov("V", of_square(V), tuning_functions)
