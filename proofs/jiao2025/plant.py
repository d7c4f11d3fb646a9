"""jiao2025: the train (1)-(3), the desired curve (16), and the coefficients (17) of its resistance.

k counts samples, i trials; `_i`, `_prev` stand for trials i, i-1 at the same sample. Forces in N, speeds in m/s.
"""

from __future__ import annotations

import sympy as sp

T_s, M = sp.symbols("T_s M", positive=True)
v_i, v_prev, u_i, u_prev, f_a = sp.symbols("v_i v_prev u_i u_prev f_a", real=True)
b_0k, b_1k, b_2k = sp.symbols("b_0k b_1k b_2k", nonnegative=True)
k = sp.Symbol("k", real=True)
s_i = sp.Symbol("s_i", real=True)
slope_coefficient = sp.Symbol("x", real=True)
slope_angle = sp.Symbol("theta_s", real=True)
# N per unit of u, and by what (17) is divided: M as printed, 1 kg for resistances in N.
unit, divisor = sp.symbols("u_unit M_17", positive=True)


def basic_resistance(speed: sp.Expr) -> sp.Expr:
    """The basic resistance (3)."""
    return b_0k + b_1k * speed + b_2k * speed**2


def next_speed(speed: sp.Expr, force: sp.Expr, additional: sp.Expr = f_a) -> sp.Expr:
    """(1) with (3); (2) enters by its value f_a."""
    return speed + T_s / M * (force - additional - basic_resistance(speed))


additional_resistance = slope_coefficient * sp.sin(slope_angle)  # (2)

davis_newton = {b_0k: (2977, 275), b_1k: (sp.Rational("25.17"), sp.Rational("2.5")),
                b_2k: (sp.Rational("0.2864"), sp.Rational("0.04"))}  # (17) times M: mean and swing with sin(0.0037 k)


def coefficients(at: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """(17), divided by `divisor`, at the instant `at`."""
    wave = sp.sin(sp.Rational("0.0037") * at)
    return {b: (mean + swing * wave) / divisor for b, (mean, swing) in davis_newton.items()}


# v(k+1) and the position at k + 1 of a train that gets `unit` times the input
step_speed = next_speed(v_i, unit * u_i).xreplace(coefficients(k))
step_position = s_i + T_s * v_i
# The same with a resistance that opposes the motion: as printed, (3) drives a train that rolls backwards.
against_motion = sp.sign(v_i) * basic_resistance(sp.Abs(v_i))
step_speed_opposed = next_speed(
    v_i, unit * u_i, f_a + against_motion - basic_resistance(v_i)).xreplace(coefficients(k))

desired_pieces: tuple[tuple[int, int, sp.Expr], ...] = (  # (16): from, to, v_d(k)
    (0, 338, -sp.Rational(35, 57122) * (k - 338) ** 2 + 70),
    (338, 700, k / 181 + sp.Rational(12332, 181)),
    (700, 1000, -k / 100 + 79),
    (1000, 1600, k / 600 + sp.Rational(202, 3)),
    (1600, 2000, -sp.Rational(7, 16000) * (k - 1600) ** 2 + 70),
)


def desired_speed(at: int, piece: int) -> sp.Expr:
    """v_d at a sample by one piece of (16)."""
    return desired_pieces[piece][2].subs(k, at)


desired_curve = sp.Piecewise(*((speed, k <= to) for _, to, speed in desired_pieces[:-1]),
                             (desired_pieces[-1][2], True))
