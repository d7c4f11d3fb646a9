"""The single-particle train as sympy expressions: Newton's second law with the Davis equation, and per unit of mass."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from workbench.trains.resistance import davis_resistance

p, v, F, f_add, t = sp.symbols("p v F f_add t", real=True)
m = sp.Symbol("m", positive=True)
a_0, b_0, c_0 = sp.symbols("a_0 b_0 c_0", real=True)

x_1, x_2, u, f = sp.symbols("x_1 x_2 u f", real=True)
a_star, b_star, c_star = sp.symbols("a_star b_star c_star", real=True)


@dataclass(frozen=True)
class Plant:
    """A plant as expressions: d(state)/dt = rates[state], driven by `command` and `disturbance`."""

    rates: dict[sp.Symbol, sp.Expr]
    command: sp.Symbol
    disturbance: sp.Symbol
    parameters: tuple[sp.Symbol, ...]
    source: str


def single_particle() -> Plant:
    """The train as one mass with forces in N."""
    rates = {p: v, v: (F - davis_resistance(v, a_0, b_0, c_0) - f_add) / m}
    return Plant(rates, F, f_add, (m, a_0, b_0, c_0), "Newton's second law, Davis equation, in N")


def single_particle_per_mass() -> Plant:
    """The same train with u = F/m, g = -g(x_2)/m and f = -f_add/m, all in m/s^2."""
    g = -davis_resistance(x_2, a_star, b_star, c_star)
    rates = {x_1: x_2, x_2: u + g + f}
    return Plant(rates, u, f, (a_star, b_star, c_star), "Newton's second law, Davis equation, per kg")
