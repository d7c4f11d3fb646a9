"""The Lyapunov function (23), the composite energy function E_i of (25), and its rate along the closed loop."""

from __future__ import annotations

import sympy as sp

from workbench.trains.multi_particle import over_cars, v

from .error_dynamics import flow
from .laws import As, Av, c_1, c_2, c_3, halved, phi, squares, v_dot, z_1, z_2


def V_of(z: sp.Expr) -> sp.Expr:
    """Half the squared norm, as V_1 and V_2."""
    return over_cars(z**2) / 2


V = V_of(z_1) + V_of(z_2)  # (23)
J = sp.symbols("J_v J_a J_k J_d J_eta J_M", nonnegative=True)  # the integrals of (25)
E = V + sp.Add(*halved(J))  # (25)


cef_flow = flow | dict(zip(J, squares, strict=True))
decay = -c_1 * over_cars(z_1**2) - c_2 * over_cars(z_2**2)


def estimation_terms(z: sp.Expr, wrong: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    """The last six terms of (15) and (24), for the errors of Theta_v, theta_a, theta_k, theta_d, eta, M."""
    rolling, aerodynamic, spring, damper, rest, inertia = wrong
    return (-c_3 * over_cars(z * rolling * v), -c_3 * aerodynamic * over_cars(z * phi),
            -c_3 * spring * over_cars(z * As), -c_3 * damper * over_cars(z * Av), -c_3 * over_cars(z * rest),
            c_3 * over_cars(z * inertia * v_dot))


# At one instant, as plain symbols: V and E of the iterations i, i - 1 and 1, the integrals Z of z_1^2 and z_2^2, and
# the sums S of those integrals up to i - 1.
V_now, V_before, E_now, E_before, E_1 = sp.symbols("V_i V_prev E_i E_prev E_1", real=True)
Z_1, Z_2, S_1, S_2 = sp.symbols("Z_1 Z_2 S_1 S_2", real=True)
