"""The values that jiao2025 states (Table 1, section 4), exactly, and the readings of what it leaves open."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import sympy as sp

from .laws import K_d, K_p, epsilon, eta, lamda, mu, rho
from .plant import M, T_s, b_1k, b_2k, davis_newton

STATED: dict[sp.Expr, Fraction] = {
    rho: Fraction("0.245"), lamda: Fraction("0.00005"), mu: Fraction("0.1"), eta: Fraction(1),
    epsilon: Fraction(1, 100000), K_p: Fraction("4.46"), K_d: Fraction(1000), T_s: Fraction(1, 10), M: Fraction(350000)}
FIRST_INPUT, LENGTH, TRIALS = 1500, 2000, 150
EVERY_LENGTH = "every length of the trial, time-varying train"


def stated(*symbols: sp.Expr) -> dict[sp.Expr, Fraction]:
    """Values of Table 1 and section 4."""
    return {s: STATED[s] for s in symbols}


@dataclass(frozen=True)
class Reading:
    """A unit of u and a meaning of k: speed gained in one step per unit of u."""

    suffix: str
    title: str
    step_s: Fraction
    unit_mps2: Fraction

    @property
    def gain(self) -> Fraction:
        """dv(k+1)/du(k)."""
        return self.step_s * self.unit_mps2


MASS = STATED[M]
SAMPLE_S, SECOND_S = STATED[T_s], Fraction(1)
newton = Reading("N", "u in N, k in samples of 0.1 s, as (1) is printed", SAMPLE_S, 1 / MASS)
newton_1s = Reading("N.1s", "u in N, k in seconds", SECOND_S, 1 / MASS)
kilonewton = Reading("kN", "u in kN, k in samples of 0.1 s", SAMPLE_S, 1000 / MASS)
kilonewton_1s = Reading("kN.1s", "u in kN, k in seconds", SECOND_S, 1000 / MASS)
per_mass = Reading("mass", "u in N/kg, as (17) is divided by M, k in samples of 0.1 s", SAMPLE_S, Fraction(1))
per_mass_1s = Reading("mass.1s", "u in N/kg, k in seconds", SECOND_S, Fraction(1))
SPEED_MAX = 72  # m/s, the largest desired speed, (16) at k = 700
damping_newton = sum(davis_newton[b_1k]) + 2 * SPEED_MAX * sum(davis_newton[b_2k])  # d f_b/dv at most, in N s/m


def secant_loss(step_s: Fraction) -> Fraction:
    """1 - a of claim 5.trials over one step, at the largest desired speed and the largest coefficients of (17)."""
    return step_s * Fraction(int(damping_newton.p), int(damping_newton.q)) / MASS
