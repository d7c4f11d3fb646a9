"""The train of chen2019: (1)-(3) written out for a number of cars, and their compact form (7).

The train of any number of cars, as it is simulated, is `workbench.trains.multi_particle`.
"""

from __future__ import annotations

import sympy as sp

from workbench.trains.multi_particle import basic_resistance, c_0, c_a, c_d, c_k, c_v, coupler_pull


def compact_force(parameters: tuple[sp.Expr, ...], speed: sp.Expr, air: sp.Expr, As_j: sp.Expr,
                  Av_j: sp.Expr) -> sp.Expr:
    """The forces of (7) on one car besides u, for (Theta_v, theta_a, theta_k, theta_d, eta)."""
    rolling, aerodynamic, spring, damper, rest = parameters
    return rolling * speed + aerodynamic * air + spring * As_j + damper * Av_j + rest


def compact_parameters(mass: sp.Expr, total: sp.Expr, additional: sp.Expr) -> tuple[sp.Expr, ...]:
    """Theta_v, theta_a, theta_k, theta_d and eta of one car, below (7)."""
    return -c_v * mass, -c_a * total, -c_k, -c_d, additional - c_0 * mass


def car_forces(n: int) -> tuple[list[sp.Expr], list[sp.Expr], dict[str, tuple[sp.Symbol, ...]]]:
    """M v' - u of a train of n cars: by (1)-(3), by (7), and the symbols of its cars."""
    cars_of = {name: sp.symbols(f"{name}_1:{n + 1}", real=True) for name in ("s", "v", "f_a")}
    cars_of["m"] = sp.symbols(f"m_1:{n + 1}", positive=True)
    S, V, F, masses = (cars_of[name] for name in ("s", "v", "f_a", "m"))
    total = sp.Add(*masses)
    places = list(zip(S, V, strict=True))
    pulls = [sp.S.Zero, *(coupler_pull(places[j], places[j + 1]) for j in range(n - 1)), sp.S.Zero]
    newton = [basic_resistance(masses[j], V[j], total if j == 0 else sp.S.Zero) + pulls[j] - pulls[j + 1] + F[j]
              for j in range(n)]
    A = sp.Matrix(n, n, lambda i, j: (1 if i in (0, n - 1) else 2) if i == j else -1 if abs(i - j) == 1 else 0)
    air = [V[0] ** 2, *[sp.S.Zero] * (n - 1)]
    compact = [compact_force(compact_parameters(masses[j], total, F[j]), V[j], air[j], (A * sp.Matrix(S))[j],
                             (A * sp.Matrix(V))[j]) for j in range(n)]
    return newton, compact, cars_of
