"""One car of the closed loop in plain symbols: its input by the acceleration, and its estimate of the mass (22)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import at_most, name_of

from .laws import c_3, gamma_mass, limited, mass_step


def one_car(expr: sp.Expr) -> sp.Expr:
    """The expression for one car: sums have that one term."""
    single = expr.replace(sp.Sum, lambda term, *_: term)
    return single.xreplace({s: sp.Symbol(name_of(s), real=True) for s in single.atoms(sp.Indexed)})


g, h, g_low, g_high = sp.symbols("g h g_low g_high", real=True)  # a number, and the bounds of its projection

# The algebraic loop: mu = kappa + (M_hat - 1/c_3) v', M v' = u + rho; a, b and u_a, u_b are two solutions.
kappa, rest, a, b, u_a, u_b, u_low, u_high = sp.symbols("kappa rho a b u_a u_b u_low u_high", real=True)
mass, mass_hat = sp.symbols("M M_hat", positive=True)
room = sp.Symbol("w", positive=True)  # m + 1/c_3 - m_hat, where the estimate is below the singular one

# The estimate of the mass (22), and how the integrand of its squared error changes from one iteration to the next.
m_before, z_car, a_car = sp.symbols("M_hat_prev z_2 v_dot", real=True)
unbounded_step = m_before + mass_step(z_car, a_car)
estimate = limited(unbounded_step, g_low, g_high)
mass_within = (at_most(g_low, mass), at_most(mass, g_high))
mass_change = ((estimate - mass) ** 2 - (m_before - mass) ** 2) / (2 * gamma_mass)
mass_bound = -c_3 * z_car * (estimate - mass) * a_car
