"""Linear loops of a plant under a law, opened at an input: what Bode plots and margins are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.model.law import time
from workbench.systems.derivatives import jacobian_at
from workbench.systems.law import StateLaw
from workbench.systems.lyapunov import closed_loop
from workbench.systems.plant import Plant
from workbench.systems.symbols import named_values


@dataclass(frozen=True)
class OpenedLoop:
    """x' = A x + B u, what comes back is -C x, with the states of plant and law; shapes (n, n), (n, 1) and (1, n).

    rates: how fast each state moves at the point itself, per second, by its name; zero where it is a point of rest.
    """

    A: NDArray[np.float64]
    B: NDArray[np.float64]
    C: NDArray[np.float64]
    rates: Mapping[str, float]

    @property
    def abscissa(self) -> float:
        """The largest real part of a pole of the closed loop, 1/s."""
        return float(np.linalg.eigvals(self.A - self.B @ self.C).real.max())


def opened_loops(plant: Plant, law: StateLaw, at: Mapping[Any, float] | None = None,
                 parameters: Mapping[str, Any] | None = None,
                 law_parameters: Mapping[str, Any] | None = None) -> dict[str, OpenedLoop]:
    """The loop at each input with the others closed, linear about a point, the law acting at every instant.

    at: states of plant and law and symbols of references, by name, zero where none is given; inputs are there as the
    law commands them, within no limits; disturbances are zero. Raises ValueError for a name that is none of them, a law
    that moves in steps, and a point where there is no derivative.
    """
    closed_loop(plant, law)  # refuses what does not fit
    values = plant.values(parameters)
    believed = law.values(plant, values, law_parameters or {})
    # What plant and law call alike may be another number in what the law believes.
    own = {symbol: sp.Dummy(str(symbol), **symbol.assumptions0) for symbol in law.parameters}
    measured = {symbol: value for symbol, value in plant.outputs.items() if symbol != value}
    commands = {u: law.commands[u].xreplace(own).xreplace(measured) for u in plant.inputs}
    states = (*plant.states, *law.state_symbols)
    moves = (*plant.rates, *(law.flow[s].xreplace(own).xreplace(measured) for s in law.state_symbols))
    where = {str(s): s for s in (*states, *law.reference_symbols)}
    point: dict[sp.Basic, sp.Expr] = dict.fromkeys((*where.values(), *plant.disturbances, time), sp.Integer(0))
    for name, value in named_values(at or {}, "at").items():
        if str(name) not in where:
            raise ValueError(f"at: '{name}' is no state and no reference of plant '{plant.id}' under law '{law.id}': "
                             f"name one of {', '.join(where)}")
        point[where[str(name)]] = sp.Float(value, 17)
    point |= {symbol: sp.Float(values[str(symbol)], 17) for symbol in plant.parameter_symbols}
    point |= {dummy: sp.Float(believed[str(symbol)], 17) for symbol, dummy in own.items()}
    found = {}
    for k in plant.inputs:
        others = {u: command for u, command in commands.items() if u != k}
        here = {**point, k: commands[k].xreplace(point)}
        rows = [move.xreplace(others) for move in moves]
        try:
            found[str(k)] = OpenedLoop(jacobian_at(rows, states, here), jacobian_at(rows, [k], here),
                                       -jacobian_at([commands[k]], states, here),
                                       {str(s): float(sp.N(row.xreplace(here))) for s, row in zip(
                                           states, rows, strict=True)})
        except ValueError as trouble:
            raise ValueError(f"plant '{plant.id}' under law '{law.id}': {trouble}") from None
    return found
