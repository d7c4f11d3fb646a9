"""mao2018: the train (1)-(6) as expressions, and as a plant for the simulation.

Forces have the unit in which m_i = 1/M turns them into m/s^2. vartheta is the sine of the slope's angle, as in (5).
"""

from __future__ import annotations

import sympy as sp

from workbench.trains import train as particle
from workbench.trains.train import Plant

x_1, x_2, x_m, xdot_m, xddot_m, z_1, z_2 = sp.symbols("x_1 x_2 x_m xdot_m xddot_m z_1 z_2", real=True)
r_1, r_2, g = sp.symbols("r_1 r_2 g", positive=True)
F, s, t = sp.symbols("F s t", real=True)
curvature = sp.Rational(4, 1000)

M, d_force = sp.Symbol("M", positive=True), sp.Symbol("d", real=True)
a_r, b_r, c_r, vartheta, D_c = sp.symbols("a_r b_r c_r vartheta D_c", real=True)
F_g, F_c = M * g * vartheta, curvature * D_c * M  # (2), (3)
newton_1 = F - a_r - b_r * x_2 - c_r * x_2**2 - F_g - F_c + d_force  # the right side of (1)
Delta_b, Delta_c = sp.symbols("Delta_b Delta_c", real=True)
drag = Delta_b * x_2 + Delta_c * x_2**2  # what (59) adds to the resistance


def slope_ramp(rate: sp.Expr, start: sp.Expr) -> sp.Expr:
    """Section VIII's indicator of a slope that the train climbs onto from time `start` on: 0.25 (t - 800)."""
    return rate * (t - start)


train = Plant(
    {particle.p: particle.v, particle.v: newton_1.xreplace({
        F: particle.F, x_2: particle.v, M: particle.m, a_r: particle.a_0, b_r: particle.b_0, c_r: particle.c_0,
        vartheta: sp.Integer(0), D_c: sp.Integer(0), d_force: -particle.f_add}) / particle.m},
    particle.F, particle.f_add, (particle.m, particle.a_0, particle.b_0, particle.c_0), "mao2018 (1)",
)
