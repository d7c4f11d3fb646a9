"""The numbers of section IV and of Table 1, exactly as they are printed."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.trains.multi_particle import c_0, c_a, c_d, c_k, c_v

from .laws import c_1, c_2, c_3, gamma_a, gamma_v, learning_gains

stated_gains = {c_1: Fraction(1, 100), c_2: Fraction(100), c_3: Fraction(4, 100)}
at_stated = {symbol: sp.Rational(x.numerator, x.denominator) for symbol, x in stated_gains.items()}
stated_learning = {gamma_v: Fraction(10), gamma_a: Fraction(2, 100),
                   **dict.fromkeys(learning_gains[2:], Fraction(8000))}
printed_factors = (Fraction(4, 10), Fraction(8, 10**4), *[Fraction(320)] * 4)  # learning gain times c_3


table_1 = {c_0: Fraction(775, 10**5), c_v: Fraction(228, 10**6), c_a: Fraction(166, 10**7), c_k: Fraction(2 * 10**6),
           c_d: Fraction(10**5)}
mass_stated, limit_stated, cruise_stated = Fraction(5 * 10**4), Fraction(4 * 10**4), Fraction(835, 10)
MOTOR_CARS = (1, 3, 5)
