"""The train of several cars as MPC knows it, for any number of cars, and one period of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np
import sympy as sp
from scipy.linalg import expm

from workbench.compile.kernel import casadi_function
from workbench.errors import InputError
from workbench.mpc.problem import Array
from workbench.trains.multi_particle import ahead, behind, coefficients, f_a, first, m, m_total, rates, s, u, v

FEWEST, MOST = 2, 64


@dataclass(frozen=True)
class CarTrain:
    """Masses (kg) and limits of the force (N) of every car, shape (n,), and values of `multi_particle.coefficients`.

    Raises InputError for shapes that do not fit, too many cars or limits that are no range around zero.
    """

    mass_kg: Array
    lowest_n: Array
    highest_n: Array
    values: tuple[float, float, float, float, float]
    cars: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "cars", len(self.mass_kg))
        if not FEWEST <= self.cars <= MOST or not self.mass_kg.shape == self.lowest_n.shape == self.highest_n.shape:
            raise InputError("", "cars", f"{self.cars} masses, {len(self.lowest_n)} and {len(self.highest_n)} limits: "
                             f"give each for {FEWEST} to {MOST} cars")
        if not (self.mass_kg > 0).all() or not ((self.lowest_n <= 0) & (self.highest_n >= 0)).all():
            raise InputError("", "cars", "masses must be positive and every car's limits include no force: "
                             "correct them")
        if not (self.highest_n.sum() > 0 > self.lowest_n.sum()):
            raise InputError("", "cars", "the train cannot drive or cannot brake: give some car a motor and a brake")


def train_rates(train: CarTrain) -> Any:
    """casadi Function of (state, forces): its rates. State: positions then speeds, shape (2n,); forces in N, (n,).

    Positions are as in the paper: without the cars' lengths, so that couplers at rest mean equal positions.
    """
    around = [x for pair in ((ahead(s), ahead(v)), (behind(s), behind(v))) for x in pair]
    given = [s, v, u, f_a, m, first, *around]
    plain = {x: sp.Symbol(f"y_{i}", real=True) for i, x in enumerate(given)}
    exprs = [rates[x].xreplace(plain) for x in (s, v)]
    of_car = casadi_function("car", (*plain.values(), m_total, *coefficients), exprs)
    n, total = train.cars, float(train.mass_kg.sum())
    x, forces = ca.SX.sym("x", 2 * n), ca.SX.sym("u", n)
    found = []
    for j in range(n):
        # At an end of the train the missing neighbour is the car itself.
        front, back = max(j - 1, 0), min(j + 1, n - 1)
        found.append(of_car(x[j], x[n + j], forces[j], 0, train.mass_kg[j], float(j == 0), x[front], x[n + front],
                            x[back], x[n + back], total, *train.values))
    return ca.Function("rates", [x, forces], [ca.vertcat(*(r[0] for r in found), *(r[1] for r in found))])


@dataclass(frozen=True)
class Period:
    """One period around a speed, exact for forces that are held: e_next = A e + B u + C r.

    e: errors from the desired run, shape (2n,); u: forces per unit of the car's mass (m/s^2); r: what the resistances
    and the desired acceleration push, per car (m/s^2).
    """

    A: Array
    B: Array
    C: Array


def period(train: CarTrain, period_s: float, speed_mps: float) -> Period:
    """The train linearised at a speed, couplers at rest, and discretised."""
    n, of_rates = train.cars, train_rates(train)
    x, forces = ca.SX.sym("x", 2 * n), ca.SX.sym("u", n)
    slope = ca.Function("slope", [x, forces], [ca.jacobian(of_rates(x, forces), x)])
    inside = np.asarray(slope(np.concatenate([np.zeros(n), np.full(n, speed_mps)]), np.zeros(n)))
    push = np.vstack([np.zeros((n, n)), np.eye(n)])
    big = expm(period_s * np.block([[inside, push], [np.zeros((n, 3 * n))]]))
    held = big[: 2 * n, 2 * n :]
    return Period(big[: 2 * n, : 2 * n], held, held)


def resistance(train: CarTrain) -> Any:
    """casadi Function of a speed: what the resistances push, per car and unit of mass (m/s^2), couplers at rest."""
    n, speed = train.cars, ca.SX.sym("v")
    of_rates = train_rates(train)
    return ca.Function("resistance", [speed], [of_rates(ca.vertcat(ca.SX.zeros(n), speed * ca.SX.ones(n)),
                                                        ca.SX.zeros(n))[n:]])
