"""What MPC predicts with: one period of the single-particle train with its actuator, from the plant's expressions.

State (p, v, F): position (m), speed (m/s) and the force that acts, per unit of mass (m/s^2). Input u: the command,
per unit of mass. The actuator either lags behind the command or follows it at once; then F is the command before,
so that F v at the end of a period is the power drawn there, and u - F the change of the command.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import sympy as sp

from workbench.compile.code_cache import kept_texts
from workbench.compile.kernel import KERNEL_SOURCES, casadi_function, function_source
from workbench.trains.train import single_particle_per_mass

Actuator = Literal["direct", "lag"]
ACTUATORS: tuple[Actuator, ...] = ("direct", "lag")

p, v, F, u, f = sp.symbols("p v F u f", real=True)
T, tau = sp.symbols("T tau", positive=True)
p_r, p_band, v_limit, P_limit = sp.symbols("p_r p_band v_limit P_limit", real=True)
STATE = (p, v, F)

# What may be exceeded at a price, each as "at most zero": power, both sides of the position band, the speed limit.
SOFT = ("power", "band_above", "band_below", "speed_limit")
soft_rows = (F * v - P_limit, p - p_r - p_band, p_r - p_band - p, v - v_limit)


def rk4(rates: dict[sp.Symbol, sp.Expr], period: sp.Expr) -> dict[sp.Symbol, sp.Expr]:
    """The state one period later by one step of the classical Runge-Kutta method, the inputs held."""
    def at(stage: dict[sp.Symbol, sp.Expr], share: sp.Expr) -> dict[sp.Symbol, sp.Expr]:
        moved = {x: x + share * period * stage[x] for x in rates}
        return {x: rate.xreplace(moved) for x, rate in rates.items()}

    k1 = rates
    k2 = at(k1, sp.Rational(1, 2))
    k3 = at(k2, sp.Rational(1, 2))
    k4 = at(k3, sp.Integer(1))
    return {x: x + period / 6 * (k1[x] + 2 * k2[x] + 2 * k3[x] + k4[x]) for x in rates}


@dataclass(frozen=True)
class Model:
    """One period as expressions: the state that follows, and its derivatives.

    following: of (p, v, F).
    """

    actuator: Actuator
    following: tuple[sp.Expr, ...]
    parameters: tuple[sp.Symbol, ...]

    @functools.cached_property
    def entries(self) -> tuple[tuple[tuple[int, int], sp.Expr], ...]:
        """((row, column), expression) of the derivatives with respect to (p, v, F, u) that are not zero, those that are
        one included."""
        every = {(i, j): sp.diff(expr, x) for i, expr in enumerate(self.following) for j, x in enumerate((*STATE, u))}
        return tuple((at, d) for at, d in every.items() if d != 0)

    def casadi_step(self) -> Any:
        """casadi Function of (p, v, F, u, f, parameters...) that gives the following state."""
        return casadi_function("mpc_step", (*STATE, u, f, *self.parameters), list(self.following))


@functools.cache
def model(actuator: Actuator) -> Model:
    """The train of `train.py` with one of ACTUATORS, discretised by RK4."""
    plant = single_particle_per_mass()
    (position, position_rate), (speed, speed_rate) = plant.rates.items()
    acting = u if actuator == "direct" else F
    names = {position: p, speed: v, plant.command: acting, plant.disturbance: f}
    rates = {p: position_rate.xreplace(names), v: speed_rate.xreplace(names)}
    if actuator == "lag":
        rates[F] = (u - F) / tau
    after = rk4(rates, T)
    following = tuple(after.get(x, u) for x in STATE)
    return Model(actuator, following, (*plant.parameters, T, tau))


SHARED = "P00 P01 P02 P11 P12 P22"
_P = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"P{min(i, j)}{max(i, j)}", real=True))
_pushed = sp.Matrix(sp.symbols("y0 y1 y2", real=True))


@functools.cache
def kernel_functions(actuator: Actuator) -> tuple[str, ...]:
    """Python source of `follow`, `linearise`, `soften` and `backward`, which `solver_kernel.py` is joined with.

    `backward` is the step of Riccati's recursion before the command is chosen: B'PB, A'PB, A'PA, B'y, A'y.
    The zeros of the model are left out of it. The texts are kept: to find them takes longer than a short run.
    """
    plant = single_particle_per_mass()
    made_of = (actuator, sp.srepr(list(plant.rates.items())), sp.srepr([plant.command, plant.disturbance]),
               sp.srepr(plant.parameters))
    return kept_texts(made_of, (Path(__file__), *KERNEL_SOURCES), functools.partial(_kernel_functions, actuator))


def _kernel_functions(actuator: Actuator) -> tuple[str, ...]:
    of = model(actuator)
    symbols = {at: sp.Symbol(f"j{at[0]}{at[1]}", real=True) for at, _ in of.entries}
    one = {at for at, d in of.entries if d == 1}
    jacobian = sp.Matrix(3, 4, lambda i, j: (sp.Integer(1) if (i, j) in one else symbols.get((i, j), sp.Integer(0))))
    A, B = jacobian[:, :3], jacobian[:, 3:]
    every = [sp.Symbol(f"j{i}{j}", real=True) for i in range(3) for j in range(4)]
    PA, PB = _P * A, _P * B
    upper = [(A.T * PA)[i, j] for i in range(3) for j in range(i, 3)]
    backward = [(B.T * PB)[0], *(A.T * PB), *upper, (B.T * _pushed)[0], *(A.T * _pushed)]
    known = dict(of.entries)
    derivatives = [known.get((i, j), sp.Integer(0)) for i in range(3) for j in range(4)]
    gradients = [sp.diff(row, x) for row in soft_rows for x in STATE]
    given = [sp.Symbol(name, real=True) for name in SHARED.split()]
    return (
        function_source("follow", (*STATE, u, f), of.parameters, of.following),
        function_source("linearise", (*STATE, u, f), of.parameters, [*of.following, *derivatives]),
        function_source("soften", (*STATE, p_r, p_band, v_limit, P_limit), (), [*soft_rows, *gradients]),
        function_source("backward", (*given, *_pushed, *every), (), backward),
    )
