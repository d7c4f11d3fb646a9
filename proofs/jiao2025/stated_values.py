"""The values that jiao2025 states (Table 1, section 4), exactly, and the readings of what it leaves open."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import sympy as sp

from workbench.files.toml import read_toml
from workbench.proof.printed_values import exact_decimal

from .laws import K_d, K_p, epsilon, eta, lamda, mu, rho
from .plant import M, T_s, b_1k, b_2k, davis_newton

study = read_toml(Path(__file__).with_name("study.toml"))
learning, trials = study["learning"], study["trials"]
STATED: dict[sp.Expr, Fraction] = {
    **{symbol: exact_decimal(learning[str(symbol)]) for symbol in (rho, lamda, mu, eta, epsilon, K_p, K_d)},
    T_s: exact_decimal(study["readings"]["N"]["step_s"]), M: exact_decimal(study["train"]["mass_kg"])}
FIRST_INPUT = exact_decimal(learning["first_input"])
LENGTH, SHORTEST, TRIALS = trials["desired_length_k"], trials["shortest_length_k"], trials["count"]
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
