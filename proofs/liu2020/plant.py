"""The train of liu2020: model (9), general resistance (8), additional resistance (2)-(4)."""

from __future__ import annotations

from functools import cache

import sympy as sp

from workbench.trains.train import Plant

s, v, u, d, f_d = sp.symbols("s v u d f_d", real=True)
chi, M = sp.symbols("chi M", positive=True)

acceleration = chi / M * u - chi / M * f_d + d  # (9), and f of (12)

a_0, a_1, a_2 = sp.symbols("a_0 a_1 a_2", positive=True)


def davis(speed: sp.Expr) -> sp.Expr:
    """The general resistance (8), N."""
    return a_0 + a_1 * speed + a_2 * speed**2


# Additional resistance; angle of the slope in rad, centre angle of the curve in degrees, lengths in m, forces in N.
g = sp.Symbol("g", positive=True)
slope_angle, centre_angle = sp.symbols("alpha varphi", real=True)
curve_length, tunnel_length = sp.symbols("L_r L_s", positive=True)
slope_force = M * g * sp.sin(slope_angle)  # (2)
curve_force = sp.Rational("0.1029") * centre_angle / curve_length * M  # (3)
restricted_tunnel_force = v**2 / 10**9 * tunnel_length * M  # (4), restricted ramps in the tunnel
tunnel_force = sp.Rational("1.3") / 10**6 * tunnel_length * M  # (4), no restricted ramp in the tunnel

opposing = sp.Symbol("f_opposing", real=True)
additional = sp.Symbol("f_a", real=True)
opposing_force = additional - M / chi * d  # additional resistance and disturbance, as one force in N


@cache
def model() -> Plant:
    """(9) with (8), driven by u in N, against `opposing_force` in N."""
    speed_rate = acceleration.xreplace({f_d: davis(v) + opposing, d: sp.Integer(0)})
    return Plant({s: v, v: speed_rate}, u, opposing, (M, a_0, a_1, a_2, chi), "liu2020 (8), (9)")
