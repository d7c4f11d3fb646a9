"""The train of several cars as sympy expressions: car by car, coupled to its neighbours by springs and dampers.

Symbols with the index j have one value per car; car 1 leads. At an end of the train the missing neighbour stands for
the car itself (`compile.cars_source`), so that a coupler which is not there neither pulls nor stretches.
"""

from __future__ import annotations

import sympy as sp

car, cars = sp.symbols("j n", integer=True, positive=True)


def over_cars(summand: sp.Expr) -> sp.Expr:
    """Sum over the cars j = 1..n."""
    return sp.Sum(summand, (car, 1, cars))


def each_car(names: str) -> tuple[sp.Indexed, ...]:
    """Symbols with one value per car."""
    return tuple(sp.IndexedBase(name, real=True)[car] for name in names.split())


def ahead(symbol: sp.Indexed) -> sp.Indexed:
    """The value of the car in front."""
    return symbol.base[car - 1]


def behind(symbol: sp.Indexed) -> sp.Indexed:
    """The value of the car that follows."""
    return symbol.base[car + 1]


# Per car: position (m), speed (m/s), force of its own motor and brakes (N), additional resistance (N), mass (kg), and
# whether it is the first one (1) or not (0).
s, v, u, f_a, m, first = each_car("s v u f_a m first")
m_total = sp.Symbol("m_total", real=True)
c_0, c_v, c_a, c_k, c_d = coefficients = sp.symbols("c_0 c_v c_a c_k c_d", real=True)


def basic_resistance(mass: sp.Expr, speed: sp.Expr, pushing_air: sp.Expr = sp.S.Zero) -> sp.Expr:
    """Davis resistance of a car as a force along the motion, N; the first car pushes the air of the whole train."""
    return -mass * (c_0 + c_v * speed) - pushing_air * c_a * speed**2


def coupler_pull(front: tuple[sp.Expr, sp.Expr], rear: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    """Spring and damper: the force, N, with which the coupler between two cars, each (s, v), pulls the rear one."""
    return c_k * (front[0] - rear[0]) + c_d * (front[1] - rear[1])


def differences(x: sp.Indexed) -> sp.Expr:
    """Row j of the Laplacian of the chain of cars, applied to x."""
    return 2 * x - ahead(x) - behind(x)


# What acts on a car besides its own force u: its resistances and both couplers.
rest_force = (basic_resistance(m, v, first * m_total) + f_a
              + coupler_pull((ahead(s), ahead(v)), (s, v)) - coupler_pull((s, v), (behind(s), behind(v))))
rates: dict[sp.Expr, sp.Expr] = {s: v, v: (u + rest_force) / m}  # Newton's second law

# For trials: a wave of slopes along the line, and coefficients that change in time.
grade, wave, gravity = sp.symbols("grade wave g", real=True)
# The place at which a slope is met: the car's own (own = 1), or one that the line is read at for all cars (own = 0).
own, common_place = sp.symbols("own s_common", real=True)
place = own * s + (1 - own) * common_place
time, swing, beat = sp.symbols("t swing beat", real=True)
slope_force = -m * gravity * grade * sp.sin(2 * sp.pi * place / wave)
varied = tuple(mean * (1 + swing * sp.sin(2 * sp.pi * time / beat)) for mean in coefficients)
