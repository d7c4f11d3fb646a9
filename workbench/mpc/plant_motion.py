"""How a plant moves under a held input, with its nominal parameters: what its MPC and its observer calculate with."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import casadi as ca
import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.compile.casadi_tree import casadi_of
from workbench.mpc.plant_values import PlantMpcValues
from workbench.systems.plant import Plant
from workbench.systems.setting import Setting

Array = NDArray[np.float64]
LEAST_BASE = 1e-9  # of a root, logarithm or divisor in the model: below it they are of no use to a solver


def _free(plant: Plant) -> dict[sp.Symbol, sp.Dummy]:
    """State to a symbol of which nothing is known: what an observer or a solver tries may be anything."""
    return {state: sp.Dummy(str(state), real=True) for state in plant.states}


def _within_domain(plant: Plant) -> Plant:
    """The plant with roots, logarithms and positive divisors that go on beyond their domain.

    An empty tank's root has an endless slope there, and 1/T changes its sign where T is zero. The plant itself where
    none of them can leave its domain. A state that is declared positive is so in the plant, not in what is tried.
    """
    anything = _free(plant)

    def leaves(e: sp.Basic) -> bool:
        if isinstance(e, sp.log):
            return not e.args[0].xreplace(anything).is_positive
        if not isinstance(e, sp.Pow) or e.base.xreplace(anything).is_positive:
            return False
        return e.exp.is_integer is False or bool(e.exp.is_negative and e.base.is_positive)

    def kept(e: sp.Basic) -> sp.Expr:
        return e.func(sp.Max(e.args[0], sp.Float(LEAST_BASE)), *e.args[1:])

    moves = tuple(e.replace(leaves, kept) for e in plant.moves)
    if moves == plant.moves:
        return plant
    return replace(plant, updates=moves) if plant.updates else replace(plant, rates=moves)


def _overflows(plant: Plant) -> bool:
    """Whether an exponential of a state in the plant may grow beyond every number."""
    anything = _free(plant)
    powers = (e.args[0] for move in plant.moves for e in move.atoms(sp.exp, sp.sinh, sp.cosh))
    return any(power.free_symbols & {*plant.states} and not power.xreplace(anything).is_nonpositive for power in powers)


class PlantMotion:
    """A setting's plant as casadi functions; disturbances named for the observer are arguments, others are zero."""

    def __init__(self, how: PlantMpcValues, setting: Setting) -> None:
        self._how, self._setting = how, setting
        self.estimated = [d for d in setting.plant.disturbances if str(d) in how.observer]
        self._plant = _within_domain(setting.plant)
        self.function, self._with_slopes = cache(self._function), cache(self._slopes)
        x = ca.SX.sym("x", len(setting.plant.states))
        z = ca.vertcat(x, ca.SX.sym("w", len(self.estimated)))
        y = ca.vertcat(*casadi_of([*setting.plant.outputs.values()], self.known(x)))
        self._measured = ca.Function("measured", [z], [y, ca.jacobian(y, z)])

    @property
    def is_steep(self) -> bool:
        """Whether slopes may have no bound: at the edge of a function's domain, or where an exponential overflows."""
        return self._plant is not self._setting.plant or _overflows(self._setting.plant)

    def known(self, x: Any) -> dict[Any, Any]:
        """What a casadi expression of states and parameters is made with."""
        plant = self._setting.plant
        return {**dict(zip(plant.states, ca.vertsplit(x), strict=True)),
                **{symbol: self._setting.parameters[str(symbol)] for symbol in plant.parameter_symbols}}

    def __call__(self, x: Array, u: Array, disturbances: Array, seconds: float) -> Array:
        """The state after some seconds with the input held."""
        return np.asarray(self.function(seconds)(x, u, disturbances)).ravel()

    def slopes(self, x: Array, u: Array, disturbances: Array, seconds: float) -> Array:
        """The derivative of the state after some seconds by the state and the estimated disturbances."""
        return np.asarray(self._with_slopes(seconds)(x, u, disturbances))

    def measured(self, z: Array) -> tuple[Array, Array]:
        """The outputs of a state with its disturbances, and their derivatives by these."""
        y, by = self._measured(z)
        return np.asarray(y).ravel(), np.asarray(by)

    def _function(self, seconds: float) -> Any:
        x, u, w, at = self._moved(seconds)
        return ca.Function("moved", [x, u, w], [at])

    def _slopes(self, seconds: float) -> Any:
        x, u, w, at = self._moved(seconds)
        return ca.Function("slopes", [x, u, w], [ca.jacobian(at, ca.vertcat(x, w))])

    def _moved(self, seconds: float) -> tuple[Any, Any, Any, Any]:
        plant, how = self._setting.plant, self._how
        f = self._plant.to_casadi(self._setting.parameters)
        x, u, w = (ca.SX.sym(name, size) for name, size in (
            ("x", len(plant.states)), ("u", len(plant.inputs)), ("w", len(self.estimated))))
        d = ca.vertcat(*(w[self.estimated.index(s)] if s in self.estimated else 0.0 for s in plant.disturbances))
        at = x
        if plant.updates:
            for _ in range(self._setting.steps_of(seconds, "period_s")):
                at = f(0, at, u, d)
            return x, u, w, at
        h = seconds / how.substeps
        for _ in range(how.substeps):
            a = f(0, at, u, d)
            b = f(0, at + h / 2 * a, u, d)
            c = f(0, at + h / 2 * b, u, d)
            e = f(0, at + h * c, u, d)
            at = at + h / 6 * (a + 2 * b + 2 * c + e)
        return x, u, w, at
